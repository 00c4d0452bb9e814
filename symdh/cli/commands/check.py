"""``symdh check``: diagnostics only."""

from __future__ import annotations

import click

from symdh.cli import console, options
from symdh.errors import ReadError, SymdhError, TableError


@click.command(epilog=options.examples("symdh check scara.yaml puma560.yaml"))
@click.argument("tables", metavar="TABLE...", nargs=-1, required=True)
def check(tables: tuple[str, ...]) -> None:
    """Check tables and say what is wrong, all of it at once.

    Every mistake comes with its line, its column and what to write instead.

    TABLE is a file, or - for standard input. Nothing is written.
    """
    failures = [failure for table in tables if (failure := _failure(table)) is not None]
    console.note(_summary(len(tables), len(failures)))
    if failures:
        wrong = any(isinstance(failure, TableError) for failure in failures)
        raise click.exceptions.Exit(TableError.exit_status if wrong else ReadError.exit_status)


def _failure(table: str) -> SymdhError | None:
    """Load one table, print its diagnostics and return what stopped it, if anything did."""
    from symdh.table import load_table

    try:
        loaded = load_table(table)
    except SymdhError as error:
        console.show_error(error)
        return error
    console.show_diagnostics(loaded.warnings)
    return None


def _summary(total: int, bad: int) -> str:
    good = f"{console.plural(total, 'file')}: {total - bad} good"
    return f"{good}, {bad} with errors" if bad else good
