"""``symdh derive``: the main job, everything for one table or for many."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from symdh.cli import console, files, options
from symdh.cli import tables as table_files
from symdh.cli.output import WrittenFile, write_files
from symdh.codegen import TARGETS, generate

if TYPE_CHECKING:
    from symdh.cli import batch
    from symdh.derivation.blocks import Document
    from symdh.robot import Robot


@dataclass(frozen=True, slots=True)
class Wishes:
    """The options of the command, the same for all tables; they travel between processes."""

    order: str
    notation: str
    paper: str
    force: bool
    templates: str | None
    homework: table_files.Homework
    ik: bool


@click.command(
    epilog=options.examples(
        "symdh derive scara.yaml",
        "symdh derive scara.yaml -o out --order left --paper letter",
        "symdh derive homework/*.yaml -o sheets -j 4",
    )
)
@options.tables_argument
@options.folder_option(
    "one named after the table; - prints the LaTeX and writes nothing. "
    "For several tables, the folder in which each gets one of its own. Default: the current one"
)
@options.jobs_option
@options.document_options
@options.sheet_options
@options.no_ik_option
@options.templates_option
@options.force_option
def derive(
    tables: tuple[str, ...],
    folder: str | None,
    jobs: int,
    order: str,
    notation: str,
    paper: str,
    sheet: str | None,
    points: bool,
    ask_table: bool,
    no_ik: bool,
    force: bool,
) -> None:
    """Derive tables: result, handout and code.

    Prints the pose of the whole chain and writes the handout (.tex, .html) and the numeric
    functions (.py, .h and .c) into a folder.

    With --sheet, only the documents are written, NAME_problem or NAME_solution.

    With several tables, each gets a folder named after it, DIR/NAME/, and a line says so in place
    of the pose. A table that is wrong does not stop the others; the exit status is the highest of
    all. Two tables of the same name are refused before anything is written.

    TABLE is a file, or - for standard input.
    """
    from symdh.templating import folder_in_force

    homework = table_files.Homework(sheet, points, ask_table)
    wishes = Wishes(order, notation, paper, force, folder_in_force(), homework, not no_ik)
    if len(tables) == 1:
        _derive_one(tables[0], folder, wishes)
    elif folder == "-":
        raise click.UsageError("-o - takes one table.")
    else:
        _derive_all(tables, folder, wishes, jobs)


def _derive_all(tables: Sequence[str], folder: str | None, wishes: Wishes, jobs: int) -> None:
    """Derive several tables, a folder each, on as many cores as asked; 0 is all of them."""
    from symdh.cli import batch, workers

    batch.write_tables(tables, Path(folder or "."), wishes, write_job, jobs or workers.cores())


def _derive_one(table: str, folder: str | None, wishes: Wishes) -> None:
    """Derive a table, print its pose and the files."""
    from symdh.codegen.names import file_stem
    from symdh.kinematics.frame import first_frame, last_frame
    from symdh.render.latex import render_latex
    from symdh.render.terminal import render_result

    robot = table_files.read_robot(table)
    document = table_files.derived(robot, wishes.order, wishes.notation, wishes.homework)
    if folder == "-":
        console.print_result(render_latex(document, paper=wishes.paper))
        return
    written = _write(robot, document, Path(folder or file_stem(robot.name)), wishes)
    if wishes.homework.sheet is not None:
        console.print_result(files.listing(written))
        return
    result = render_result(
        robot, first_frame(robot), last_frame(robot), width=console.width(), naming=wishes.notation
    )
    console.print_result(f"{result}\n\n{files.listing(written)}")


def write_job(job: batch.Job) -> tuple[WrittenFile, ...]:
    """Derive one table of many and write its files."""
    from symdh.table.reader import read_table
    from symdh.templating import own_templates

    robot = read_table(job.source).robot
    wishes: Wishes = job.wishes
    document = table_files.document(robot, wishes.order, wishes.notation, wishes.homework)
    with own_templates(wishes.templates) if wishes.templates else nullcontext():
        return _write(robot, document, job.folder, wishes)


def _write(
    robot: Robot, document: Document, folder: Path, wishes: Wishes
) -> tuple[WrittenFile, ...]:
    return write_files(folder, _everything(robot, document, wishes), force=wishes.force)


def _everything(robot: Robot, document: Document, wishes: Wishes) -> dict[str, bytes]:
    """Return every file that a table gives, by name: each document format, each code target.

    Homework comes without code, which would tell the answers.
    """
    from symdh.render.formats import FORMATS

    stem = table_files.stem(robot, wishes.homework)
    contents = {
        f"{stem}{form.extension}": form.render(document, robot, wishes.paper).encode()
        for form in FORMATS
    }
    if wishes.homework.sheet is not None:
        return contents
    for target in (target for target in TARGETS if target.in_derive):
        for file in generate(robot, target.name, ik=wishes.ik):
            contents[file.name] = file.text.encode()
    return contents
