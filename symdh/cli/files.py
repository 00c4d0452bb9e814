"""Where results go: a file, a folder or standard output, and what is said about it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from click import format_filename

from symdh.cli import console
from symdh.cli.output import WrittenFile, write_files


def save(output: str, content: bytes, *, force: bool) -> None:
    """Write one result to a file and say so, or to standard output for ``-``."""
    if output == "-":
        console.print_bytes(content)
        return
    path = Path(output)
    written = write_files(path.parent, {path.name: content}, force=force)
    console.note(listing(written))


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
