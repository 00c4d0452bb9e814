"""Where results go: a file, a folder or standard output, and what is said about it."""

from __future__ import annotations

from collections.abc import Iterable
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


def _size(count: int) -> str:
    """Write a number of bytes for people."""
    if count < 1000:
        return f"{count} B"
    if count < 1_000_000:
        return f"{count / 1000:.1f} kB"
    return f"{count / 1_000_000:.1f} MB"
