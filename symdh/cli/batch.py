"""Many tables in one run: each in a folder of its own, none stopped by another, then a summary."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symdh.cli import console, failures, files, workers
from symdh.cli.output import WrittenFile
from symdh.errors import (
    Diagnostic,
    LimitError,
    ReadError,
    SymdhError,
    TableError,
    UnsupportedError,
)

if TYPE_CHECKING:
    from symdh.table.source import Source

Written = tuple[WrittenFile, ...]


@dataclass(frozen=True, slots=True)
class Job:
    """One good table and the folder for its files; `wishes` are the options of the command."""

    source: Source
    folder: Path
    wishes: Any


Write = Callable[[Job], Written]


@dataclass(frozen=True, slots=True)
class _Table:
    """A table as it was read: with its job when it is good, else with its error."""

    path: str
    job: Job | None = None
    warnings: tuple[Diagnostic, ...] = ()
    error: SymdhError | None = None


def write_tables(
    paths: Sequence[str], parent: Path, wishes: object, write: Write, processes: int
) -> None:
    """Write the files of many tables and say what came of each, in the order of the tables.

    Parameters
    ----------
    paths : sequence of str
        Tables; one of them may be ``-``.
    parent : Path
        Folder in which each table gets one that is named after it.
    wishes : object
        Handed on to `write`.
    write : callable
        A function of a module that writes the files of one table.
    processes : int
        How many work at the same time.

    Raises
    ------
    UnsupportedError
        When two tables would write into one folder; nothing is written then.
    click.exceptions.Exit
        With the highest exit status of all tables, when one has failed.
    """
    # A run over many tables is long enough for garbage to matter; see `main`.
    gc.enable()
    tables = [_read(path, parent, wishes) for path in paths]
    _refuse_twins(tables)
    teller = _Teller(tables)
    good = [index for index, table in enumerate(tables) if table.job is not None]
    jobs = [(write, tables[index].job) for index in good]
    with _progress(len(jobs)) as advance, closing(_run(jobs, processes)) as done:
        for index, outcome in done:
            teller.outcomes[good[index]] = outcome
            # Lines between the steps of a progress bar would tear it to pieces.
            if advance is None:
                teller.tell()
            else:
                advance()
    teller.tell()
    teller.sum_up()


def _read(path: str, parent: Path, wishes: object) -> _Table:
    from symdh.codegen.names import file_stem
    from symdh.table.reader import read_table
    from symdh.table.source import read_source

    try:
        source = read_source(path)
        loaded = read_table(source)
        job = Job(source, parent / file_stem(loaded.robot.name), wishes)
        return _Table(path, job, loaded.warnings)
    except Exception as error:
        return _Table(path, error=failures.as_symdh_error(error))


def _refuse_twins(tables: Sequence[_Table]) -> None:
    """Refuse tables of one name; some file systems take names for one that differ in case."""
    owners: dict[str, list[_Table]] = {}
    for table in tables:
        if table.job is not None:
            owners.setdefault(str(table.job.folder).casefold(), []).append(table)
    twins = [
        f"{' and '.join(click.format_filename(table.path) for table in shared)} "
        f"would all be written into {shared[0].job.folder}"
        for shared in owners.values()
        if len(shared) > 1 and shared[0].job is not None
    ]
    if twins:
        raise UnsupportedError(
            "; ".join(twins) + ". Give each table a `name` of its own; nothing was written"
        )


def _run(
    jobs: Sequence[tuple[Write, Job | None]], processes: int
) -> Generator[tuple[int, Written | SymdhError], None, None]:
    for index, outcome in workers.results_of(_outcome, jobs, processes):
        if isinstance(outcome, workers.Lost):
            why = f"its process was ended (status {outcome.status}), for want of memory perhaps"
            yield index, LimitError(why)
        else:
            yield index, outcome


def _outcome(job: tuple[Write, Job]) -> Written | SymdhError:
    write, details = job
    try:
        return write(details)
    except Exception as error:
        return failures.as_symdh_error(error)


@contextmanager
def _progress(length: int) -> Iterator[Callable[[], None] | None]:
    """Show a progress bar to a person at the terminal and give what moves it on; else None."""
    if length == 0 or sys.stderr is None or not sys.stderr.isatty():
        yield None
        return
    with click.progressbar(
        length=length, label="deriving", show_pos=True, file=sys.stderr
    ) as shown:
        yield lambda: shown.update(1)


@dataclass(slots=True)
class _Teller:
    """Says what came of each table, in the order of the tables."""

    tables: Sequence[_Table]
    outcomes: dict[int, Written | SymdhError] = field(init=False)
    longest: int = field(init=False)
    told: int = 0
    failed: list[tuple[_Table, SymdhError]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.longest = max(
            (len(str(table.job.folder)) for table in self.tables if table.job), default=0
        )
        self.outcomes = {
            index: table.error for index, table in enumerate(self.tables) if table.error is not None
        }

    def tell(self) -> None:
        """Speak of the tables that are done, up to the first one that is not."""
        while self.told in self.outcomes:
            table, outcome = self.tables[self.told], self.outcomes[self.told]
            console.show_diagnostics(table.warnings)
            if isinstance(outcome, SymdhError):
                self.failed.append((table, outcome))
                _show(table.path, outcome)
            else:
                console.print_result(files.line_of_set(outcome, self.longest))
            self.told += 1

    def sum_up(self) -> None:
        """Count, name the tables that failed, and leave with the status of the worst."""
        good = len(self.tables) - len(self.failed)
        summary = f"{console.plural(len(self.tables), 'table')}: {good} derived"
        if not self.failed:
            console.note(summary)
            return
        console.note(f"{summary}, {len(self.failed)} failed")
        for table, error in self.failed:
            console.note(f"  {_in_brief(table.path, error)}")
        raise click.exceptions.Exit(max(error.exit_status for _, error in self.failed))


def _show(path: str, error: SymdhError) -> None:
    """Print an error of one table, which must say of which."""
    if not isinstance(error, (TableError, ReadError)):
        error = type(error)(f"{click.format_filename(path)}: {error}")
    failures.show(error)


def _in_brief(path: str, error: SymdhError) -> str:
    """Say on one line what a table failed of."""
    name = click.format_filename(path)
    if isinstance(error, TableError):
        return f"{name}: {console.counted(error.diagnostics)}"
    reason = str(error).split("\n")[0].removeprefix(f"{path}: ")
    return f"{name}: {reason}"
