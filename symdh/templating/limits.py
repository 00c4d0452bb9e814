"""Bounds on what a user's template may take: time, memory, length of the output."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

TIME_LIMIT = 20.0
#: Seconds after which a template is stopped again: an exception that is raised while garbage is
#: collected, or while jinja2 tries what is constant, goes no further.
_AGAIN = 1.0
LENGTH_LIMIT = 50_000_000
_MEMORY = 1 << 28


class OutOfTimeError(Exception):
    """A template takes longer than it may."""


class TooLongError(Exception):
    """A template writes more than it may."""


def bounded(parts: Iterable[str]) -> Iterator[str]:
    """Pass on the parts of an output as long as it is not too long.

    Raises
    ------
    TooLongError
    """
    length = 0
    for part in parts:
        length += len(part)
        if length > LENGTH_LIMIT:
            raise TooLongError(f"the template writes over {LENGTH_LIMIT // 10**6} million signs")
        yield part


@contextmanager
def limited() -> Iterator[None]:
    """Bound the time and the memory of a block, as far as the system and the thread allow.

    Raises
    ------
    OutOfTimeError, MemoryError
    """
    with _within_memory(), _within_time():
        yield


@contextmanager
def _within_time() -> Iterator[None]:
    if sys.platform == "win32" or threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(number: int, frame: FrameType | None) -> None:
        raise OutOfTimeError(f"the template did not end within {TIME_LIMIT:g} s and was stopped")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, TIME_LIMIT, _AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def _within_memory() -> Iterator[None]:
    pages = Path("/proc/self/statm")
    if not pages.is_file():
        yield
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    room = int(pages.read_text().split()[0]) * resource.getpagesize() + _MEMORY
    if soft != resource.RLIM_INFINITY and soft <= room:
        yield
        return
    resource.setrlimit(resource.RLIMIT_AS, (room, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
