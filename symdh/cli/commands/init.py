"""``symdh init``: a commented starter table."""

from __future__ import annotations

from pathlib import Path

import click

from symdh.cli import console, files, options
from symdh.errors import OutputError


@click.command(
    epilog=options.examples("symdh init arm.yaml", "symdh init --schema > dh_table.schema.json")
)
@click.argument("file", default="dh_table.yaml")
@click.option(
    "--schema", is_flag=True, help="Print the JSON Schema of a table, for editors; write nothing."
)
@options.force_option
def init(file: str, schema: bool, force: bool) -> None:
    """Write a commented starter table to fill in.

    It works as it stands and says what may be changed.

    FILE is dh_table.yaml unless another name is given; - is standard output.
    """
    from symdh.table.schema import schema_text
    from symdh.table.starter import STARTER

    if schema:
        console.print_result(schema_text())
        return
    if file != "-" and Path(file).exists() and not force:
        raise OutputError(f"{file} is there already; --force replaces it")
    # A table is the user's own file from now on, so it carries no mark that symdh made it.
    files.save(file, STARTER.encode(), force=True)
    if file != "-":
        console.note(f"next: symdh derive {file}")
