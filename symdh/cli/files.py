"""Where results go: a file, a folder or standard output, and what is said about it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path

import click
from click import format_filename

from symdh.cli import console
from symdh.cli.output import WrittenFile, write_files
from symdh.errors import OutputError


def save(output: str, content: bytes, *, force: bool) -> None:
    """Write one result to a file and say so, or to standard output for ``-``.

    Raises
    ------
    OutputError
        When the file cannot or must not be written. Without `force` neither is what the command
        was given to read: a table that symdh wrote and a user went on with bears symdh's mark.
    """
    if output == "-":
        console.print_bytes(content)
        return
    path = Path(output)
    if not force and any(_is_same_file(path, given) for given in _given()):
        raise OutputError(f"refuses to replace {path}: it is read here; --force does it")
    written = write_files(path.parent, {path.name: content}, force=force)
    console.note(listing(written))


def _given() -> Iterator[str]:
    """Yield what the command was given besides the name of its output; files are among it."""
    context = click.get_current_context(silent=True)
    for name, value in context.params.items() if context else ():
        if name != "output":
            several = value if isinstance(value, tuple) else (value,)
            yield from (each for each in several if isinstance(each, str))


def _is_same_file(path: Path, given: str) -> bool:
    with suppress(OSError, ValueError):  # what was given need not be the name of a file
        return path.samefile(given)
    return False


def listing(files: Iterable[WrittenFile]) -> str:
    """Name the files that are in place now, with their sizes."""
    rows = [(format_filename(file.path), _size(file.size), file.changed) for file in files]
    longest = max(len(name) for name, _, _ in rows)
    return "\n".join(
        f"{'wrote' if changed else 'kept '} {name:{longest}}  {size:>8}"
        + ("" if changed else "  (unchanged)")
        for name, size, changed in rows
    )


def line_of_set(files: Sequence[WrittenFile], longest: int) -> str:
    """Name the folder of a set of files on one line, with their number and size.

    Parameters
    ----------
    files : sequence of WrittenFile
    longest : int
        Length of the longest name among the folders of all sets, so that their lines are columns.
    """
    folder = f"{format_filename(files[0].path.parent)}{os.sep}"
    changed = any(file.changed for file in files)
    size = _size(sum(file.size for file in files))
    return (
        f"{'wrote' if changed else 'kept '} {folder:{longest + 1}}  {len(files)} files  {size:>8}"
        + ("" if changed else "  (unchanged)")
    )


def _size(count: int) -> str:
    """Write a number of bytes for people."""
    if count < 1000:
        return f"{count} B"
    if count < 1_000_000:
        return f"{count / 1000:.1f} kB"
    return f"{count / 1_000_000:.1f} MB"
