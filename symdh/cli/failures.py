"""Whatever a run ends with, as an error that has an exit status and a text for people."""

from __future__ import annotations

import os
import sys

from symdh.cli import console
from symdh.errors import LimitError, SymdhError


class InternalError(SymdhError):
    """A defect of symdh."""

    exit_status = 70


def as_symdh_error(error: Exception) -> SymdhError:
    """Return an error that symdh raised as it is, and say what another one means."""
    if isinstance(error, SymdhError):
        return error
    if isinstance(error, MemoryError):
        return LimitError("out of memory")
    if isinstance(error, RecursionError):
        return LimitError("an expression is nested too deeply")
    if os.environ.get("SYMDH_DEBUG") == "1":
        sys.excepthook(type(error), error, error.__traceback__)
    return InternalError(
        f"internal error: {type(error).__name__}: {error}\n"
        "This is a defect of symdh: please report it with the table; "
        "SYMDH_DEBUG=1 shows where it happened."
    )


def show(error: SymdhError) -> None:
    """Print an error."""
    if isinstance(error, InternalError):
        console.note(str(error))
    else:
        console.show_error(error)
