"""Strike symdh at each of its calls that change the disk: `python faults.py KIND OLD NEW [STEP]`.

KIND is `fail` (the call raises what a full or broken disk raises) or the name of a signal that
arrives just before or just after the call. In an empty working folder, the table OLD is derived
into ``out``; for each point the table NEW is derived over it by a process of its own, struck
there. One line of JSON a point says what happened. STEP strikes at every STEP-th point only.

The processes are forked from one that has already derived both tables, so that hundreds of
points take seconds; each forked process runs the whole command with its own signal handlers.
"""

from __future__ import annotations

import errno
import io
import json
import os
import shutil
import signal
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

#: What each call says when a disk lets it down.
FAILURES = {
    "open": errno.EMFILE,
    "write": errno.ENOSPC,
    "fsync": errno.EIO,
    "link": errno.ENOSPC,
    "mkdir": errno.ENOSPC,
    "rename": errno.EIO,
    "replace": errno.EIO,
    "unlink": errno.EIO,
    "rmdir": errno.EIO,
}


class Strike:
    """Counts the calls that change the disk and does harm at one of them."""

    def __init__(self, kind: str, point: int) -> None:
        self.kind = kind
        self.point = point
        self.count = 0

    def around(self, name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def struck(*arguments: Any, **options: Any) -> Any:
            self._tick(name)
            result = call(*arguments, **options)
            if self.kind != "fail":
                self._tick(name)
            return result

        return struck

    def _tick(self, name: str) -> None:
        self.count += 1
        if self.count != self.point:
            return
        os.write(3, f"{name}\n".encode())
        if self.kind == "fail":
            number = FAILURES[name]
            raise OSError(number, os.strerror(number))
        os.kill(os.getpid(), getattr(signal, self.kind))

    def install(self) -> None:
        """Put the strike around every call that changes the disk."""
        for name in ("fsync", "link", "mkdir", "rename", "replace", "unlink", "rmdir"):
            setattr(os, name, self.around(name, getattr(os, name)))
        os.remove = os.unlink
        plain_os_open, plain_open = os.open, io.open
        creating = self.around("open", plain_os_open)

        def open_descriptor(path: Any, flags: int, *rest: Any, **options: Any) -> int:
            called = creating if flags & os.O_CREAT else plain_os_open
            return called(path, flags, *rest, **options)  # type: ignore[no-any-return]

        def open_stream(file: Any, mode: str = "r", *rest: Any, **options: Any) -> Any:
            if not set(mode) & set("wxa+"):
                return plain_open(file, mode, *rest, **options)
            stream = self.around("open", plain_open)(file, mode, *rest, **options)
            return Stream(stream, self.around("write", stream.write))

        os.open = open_descriptor
        io.open = open_stream


class Stream:
    """A file whose `write` can be struck."""

    def __init__(self, stream: Any, write: Callable[..., Any]) -> None:
        self._stream = stream
        self.write = write

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, *error: object) -> None:
        self._stream.close()


def run_symdh(table: str, strike: Strike | None, said: Any, hit: Any) -> int:
    """Derive a table into ``out`` in a process of its own; return the wait status."""
    child = os.fork()
    if child:
        return os.waitpid(child, 0)[1]
    sink = os.open(os.devnull, os.O_WRONLY)
    for source, target in ((sink, 1), (said.fileno(), 2), (hit.fileno(), 3)):
        os.dup2(source, target)
    from symdh.cli import main

    sys.argv = ["symdh", "derive", table, "-o", "out"]
    if strike:
        strike.install()
    try:
        main.main()
    except SystemExit as end:
        sys.stdout.flush()
        os._exit(end.code if isinstance(end.code, int) else 1)
    os._exit(99)


def files_in(folder: Path) -> dict[str, bytes]:
    return {each.name: each.read_bytes() for each in folder.iterdir() if each.is_file()}


def outcome(status: int) -> int:
    """Return the exit status as a shell shows it."""
    return 128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)


def points(kind: str, old: str, new: str, step: int) -> Iterator[dict[str, object]]:
    """Strike at one point after another until a run ends before it gets there."""
    out = Path("out")
    sets = {}
    with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as hit:
        for table in (old, new):
            assert run_symdh(table, None, said, hit) == 0, table
            sets[table] = files_in(out)
            shutil.rmtree(out)
    for point in range(1, 100_000, step):
        out.mkdir()
        for name, content in sets[old].items():
            (out / name).write_bytes(content)
        with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as hit:
            status = outcome(run_symdh(new, Strike(kind, point), said, hit))
            said.seek(0)
            hit.seek(0)
            call, message = hit.read().decode().strip(), said.read().decode()
        left = files_in(out)
        whole = {
            name: content in (sets[old][name], sets[new][name]) for name, content in left.items()
        }
        litter = sorted(each.name for each in out.iterdir() if not each.is_file())
        with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as hit:
            again = outcome(run_symdh(new, None, said, hit))
        if not call:
            return
        yield {
            "point": point,
            "call": call,
            "status": status,
            "said": message,
            "files": "old" if left == sets[old] else "new" if left == sets[new] else "mixed",
            "whole": all(whole.values()) and set(left) == set(sets[old]),
            "litter": litter,
            "next": again == 0 and files_in(out) == sets[new],
            "litter after the next run": sorted(
                each.name for each in out.iterdir() if not each.is_file()
            ),
        }
        shutil.rmtree(out)


def warm(*tables: str) -> None:
    """Load all that a derivation needs, so that the forked processes need not."""
    from symdh.cli.main import run

    for table in tables:
        run(["derive", table, "-o", "-"])


def main(kind: str, old: str, new: str, step: str = "1") -> None:
    """Print what happens at each point."""
    results = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    warm(old, new)
    sys.stdout.flush()
    with os.fdopen(results, "w") as stream:
        for each in points(kind, old, new, int(step)):
            stream.write(json.dumps(each) + "\n")
            # Nothing may wait in a buffer that a forked process would write again.
            stream.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
