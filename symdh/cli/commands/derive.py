"""``symdh derive``: the main job, everything for one table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from symdh.cli import console, files, options, tables
from symdh.cli.output import write_files
from symdh.codegen import TARGETS, generate

if TYPE_CHECKING:
    from symdh.derivation.blocks import Document
    from symdh.robot import Robot


@click.command(
    epilog=options.examples(
        "symdh derive scara.yaml", "symdh derive scara.yaml -o out --order left --paper letter"
    )
)
@options.table_argument
@options.folder_option("one named after the table; - prints the LaTeX and writes nothing")
@options.document_options
@options.force_option
def derive(
    table: str, folder: str | None, order: str, notation: str, paper: str, force: bool
) -> None:
    """Derive a table: result, handout and code.

    Prints the pose of the whole chain and writes the handout (.tex) and the numeric functions
    (.py, .h and .c) into a folder.

    TABLE is a file, or - for standard input.
    """
    from symdh.codegen.names import file_stem
    from symdh.kinematics.frame import first_frame, last_frame
    from symdh.render.latex import render_latex
    from symdh.render.terminal import render_result

    robot = tables.read_robot(table)
    document = tables.derived(robot, order, notation)
    if folder == "-":
        console.print_result(render_latex(document, paper=paper))
        return
    result = render_result(
        robot, first_frame(robot), last_frame(robot), width=console.width(), naming=notation
    )
    stem = file_stem(robot.name)
    everything = _everything(stem, robot, document, paper)
    written = write_files(Path(folder or stem), everything, force=force)
    console.print_result(f"{result}\n\n{files.listing(written)}")


def _everything(stem: str, robot: Robot, document: Document, paper: str) -> dict[str, bytes]:
    """Return every file that a table gives, by name: each document format, each code target."""
    from symdh.render.formats import FORMATS

    contents = {
        f"{stem}{form.extension}": form.render(document, robot, paper).encode() for form in FORMATS
    }
    for target in TARGETS:
        for file in generate(robot, target.name):
            contents[file.name] = file.text.encode()
    return contents
