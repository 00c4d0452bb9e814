"""The entry point: runs a command and turns whatever happens into an exit status.

0 done, 2 usage or input, 3 input/output, 4 a limit was reached, 70 a defect of symdh,
130 interrupted, 141 the reader of a pipe went away, 143 terminated.
"""

from __future__ import annotations

import gc
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from types import FrameType
from typing import NoReturn

import click

from symdh.cli import completion, console, failures
from symdh.cli.program import program
from symdh.errors import SymdhError

_CLOSED_PIPE = 128 + 13


class Stopped(KeyboardInterrupt):
    """A signal asked symdh to stop; on its way out it lets every clean-up run."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


def main() -> NoReturn:
    """Run the command that the process was started with."""
    # sympy makes many objects and hardly a cycle; a run is short. Not to look saves a tenth of it.
    gc.disable()
    console.use_utf8()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _stop)
    status = run(sys.argv[1:])
    console.settle_stdout()
    sys.exit(status)


def run(arguments: Sequence[str]) -> int:
    """Run one command and return its exit status; every message has then been printed."""
    try:
        return _invoke(list(arguments))
    except click.ClickException as error:
        with suppress(OSError):
            error.show()
        return error.exit_code
    except Stopped as stop:
        return 128 + stop.number
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except BrokenPipeError:
        return _CLOSED_PIPE
    except OSError as error:  # from click's own printing of a help text
        return _failed(console.stdout_failure(error))
    except Exception as error:
        return _failed(failures.as_symdh_error(error))


def _invoke(arguments: list[str]) -> int:
    if completion.is_requested():
        return completion.answer(program)
    try:
        with program.make_context("symdh", arguments) as context:
            program.invoke(context)
    except click.exceptions.Exit as stop:
        return stop.exit_code
    return 0


def _stop(number: int, frame: FrameType | None) -> NoReturn:
    """Stop once; a second signal must not cut the clean-up short."""
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, signal.SIG_IGN)
    raise Stopped(number)


def _failed(error: SymdhError) -> int:
    failures.show(error)
    return error.exit_status
