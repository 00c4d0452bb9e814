"""A word to a person at the terminal while something takes long."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer

from symdh.cli import console

#: Seconds after which a person wonders whether anything happens.
PATIENCE = 2.0


@contextmanager
def telling(what: str) -> Iterator[None]:
    """Say `what` on the terminal once the block has taken over two seconds; nothing in a pipe."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    timer = Timer(PATIENCE, console.note, [f"{what} ..."])
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
