"""Write a set of files whole or not at all.

The files are staged in a hidden folder inside the target folder, so on the same file system, and
then renamed into place. Whatever goes wrong on the way, the target folder is left as it was.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import stat
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from symdh.errors import OutputError, UnsupportedError

if sys.platform != "win32":
    import fcntl

LOCK_PATIENCE = 30.0
"""Seconds to wait for another run that writes into the same folder."""

_MARKER = re.compile(rb"(?:generated|written) by symdh", re.IGNORECASE)
_MARKER_REACH = 2048
_PDF_MARKER = b"symdh"
_STAGE_NAME = re.compile(r"\.symdh-(\d+)-[0-9a-f]{8}")


@dataclass(frozen=True, slots=True)
class WrittenFile:
    """A file that is in place now.

    Attributes
    ----------
    path : Path
    size : int
        Bytes.
    changed : bool
        False when the same bytes were there before; the file was then not touched.
    """

    path: Path
    size: int
    changed: bool


def write_files(
    folder: Path, files: Mapping[str, bytes], *, force: bool = False
) -> tuple[WrittenFile, ...]:
    """Put files into a folder, all of them or none.

    Parameters
    ----------
    folder : Path
        Made, with its parents, when it is not there.
    files : mapping of str to bytes
        File names and contents.
    force : bool
        Also replace a file that symdh did not write. A link, a folder or a device is never
        replaced.

    Raises
    ------
    OutputError
        When a file cannot or must not be written.
    UnsupportedError
        When a name differs only in case from another one: some file systems take the two for one.
    """
    # Signals are held last: while it waits for its turn, a run can be stopped.
    with _made(folder), _turn(folder), _signals_held():
        _remove_stale_stages(folder)
        _refuse_case_twins(folder, files)
        old = {name: _replaceable(folder / name, force) for name in files}
        new = {name: content for name, content in files.items() if old[name] != content}
        if new:
            with _staging_folder(folder) as stage:
                for name, content in new.items():
                    with _blaming(folder / name):
                        _write_through(stage / name, content)
                _move_into_place(stage, folder, tuple(new))
    return tuple(
        WrittenFile(folder / name, len(content), name in new) for name, content in files.items()
    )


@contextmanager
def _blaming(path: Path) -> Iterator[None]:
    """Turn a failure of the operating system into an `OutputError` that names `path`."""
    try:
        yield
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise OutputError(f"cannot write {path}: {reason}") from error


@contextmanager
def _made(folder: Path) -> Iterator[None]:
    """Make a folder and its missing parents; when the block fails, remove them again."""
    with _blaming(folder):
        if folder.exists() and not folder.is_dir():
            raise OutputError(f"cannot write into {folder}: not a directory")
        missing = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        for each in reversed(missing):
            with _blaming(each):
                each.mkdir(exist_ok=True)
        yield
    except BaseException:
        for each in missing:
            with suppress(OSError):
                each.rmdir()
        raise


@contextmanager
def _turn(folder: Path) -> Iterator[None]:
    """Wait while another run writes into the folder, so that two sets are never mixed.

    The folder itself is locked, which leaves nothing behind. Where the system has no such locks,
    files are still whole.
    """
    descriptor = None
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
    try:
        if descriptor is not None:
            _lock(descriptor, folder)
        yield
    finally:
        if descriptor is not None:
            os.close(descriptor)


def _lock(descriptor: int, folder: Path) -> None:
    """Lock an open folder until it is closed."""
    if sys.platform == "win32":
        return
    deadline = time.monotonic() + LOCK_PATIENCE
    while True:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > deadline:
                raise OutputError(f"cannot write into {folder}: another run holds it") from None
            time.sleep(0.01)
        except OSError:  # a file system without locks
            return
        else:
            return


def _refuse_case_twins(folder: Path, names: Mapping[str, bytes]) -> None:
    with _blaming(folder):
        present = {each.name for each in folder.iterdir()}
    for name in names:
        for other in sorted(present | set(names)):
            if other != name and other.casefold() == name.casefold():
                raise UnsupportedError(
                    f"{folder / name} and {other} differ only in case; "
                    "rename the table or choose another folder with -o"
                )


def _replaceable(path: Path, force: bool) -> bytes | None:
    """Return what stands at `path` now, None when nothing does; refuse what must stay."""
    with _blaming(path):
        try:
            mode = path.lstat().st_mode
        except FileNotFoundError:
            return None
        if not stat.S_ISREG(mode):
            raise OutputError(f"refuses to replace {path}: it is {_kind(mode)}")
        content = path.read_bytes()
    if not force and not is_marked(path.name, content):
        raise OutputError(f"refuses to replace {path}: symdh did not write it; --force does it")
    return content


def _kind(mode: int) -> str:
    if stat.S_ISLNK(mode):
        return "a symbolic link"
    if stat.S_ISDIR(mode):
        return "a directory"
    return "not a regular file"


def is_marked(name: str, content: bytes) -> bool:
    """Tell whether a file says that symdh made it: in its head, a PDF in its metadata."""
    if name.endswith(".pdf"):
        return _PDF_MARKER in content
    return not content or _MARKER.search(content, 0, _MARKER_REACH) is not None


@contextmanager
def _staging_folder(folder: Path) -> Iterator[Path]:
    """Give a fresh folder inside `folder` and remove it at the end."""
    stage = folder / f".symdh-{os.getpid()}-{os.urandom(4).hex()}"
    try:
        with _blaming(folder):
            stage.mkdir(mode=0o700)
        yield stage
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def _remove_stale_stages(folder: Path) -> None:
    """Remove what a killed run left behind."""
    with _blaming(folder):
        present = list(folder.iterdir())
    for each in present:
        match = _STAGE_NAME.fullmatch(each.name)
        if match and each.is_dir() and not each.is_symlink() and not _is_alive(int(match[1])):
            shutil.rmtree(each, ignore_errors=True)


def _is_alive(pid: int) -> bool:
    if sys.platform == "win32":  # os.kill would end the process there
        return True
    try:
        os.kill(pid, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


def _write_through(path: Path, content: bytes) -> None:
    """Write a new file and wait until the disk has it, so that a full disk is noticed now."""
    with path.open("xb") as stream:
        stream.write(content)
        stream.flush()
        os.fsync(stream.fileno())


def _move_into_place(stage: Path, folder: Path, names: tuple[str, ...]) -> None:
    """Rename staged files over their targets; when one fails, put the earlier ones back."""
    for name in names:
        with _blaming(folder / name):
            _keep_copy(folder / name, stage / f"{name}.old")
    moved: list[str] = []
    try:
        for name in names:
            with _blaming(folder / name):
                (stage / name).replace(folder / name)
            moved.append(name)
    except OutputError:
        for name in moved:
            _put_back(stage / f"{name}.old", folder / name)
        raise


def _keep_copy(path: Path, copy: Path) -> None:
    if not path.exists():
        return
    try:
        os.link(path, copy)
    except OSError:  # a file system without hard links
        shutil.copy2(path, copy)


def _put_back(copy: Path, path: Path) -> None:
    with suppress(OSError):
        if copy.exists():
            copy.replace(path)
        else:
            path.unlink()


@contextmanager
def _signals_held() -> Iterator[None]:
    """Let SIGINT and SIGTERM wait, so that they find the set all old or all new, and no litter.

    A mask would not do: a thread of a library takes the signal that this thread masks, and Python
    then runs the handler here.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    arrived: list[int] = []
    before = {
        number: signal.signal(number, lambda number, frame: arrived.append(number))
        for number in (signal.SIGINT, signal.SIGTERM)
    }
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
        if arrived:
            signal.raise_signal(arrived[0])
