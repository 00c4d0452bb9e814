"""``symdh code``: the numeric function in one language."""

from __future__ import annotations

from pathlib import Path

import click

from symdh.cli import console, files, options, tables
from symdh.cli.output import write_files
from symdh.codegen import TARGETS, generate


@click.command(epilog=options.examples("symdh code scara.yaml --target c -o src"))
@options.table_argument
@click.option(
    "--target",
    type=click.Choice([target.name for target in TARGETS]),
    required=True,
    help="; ".join(f"{target.name}: {target.description}" for target in TARGETS) + ".",
)
@options.folder_option("the current one")
@options.force_option
def code(table: str, target: str, folder: str | None, force: bool) -> None:
    """Write the numeric pose as a function in one language.

    The function gives the pose of the whole chain and drops into another project.
    """
    robot = tables.read_robot(table)
    generated = {file.name: file.text.encode() for file in generate(robot, target)}
    written = write_files(Path(folder or "."), generated, force=force)
    console.note(files.listing(written))
