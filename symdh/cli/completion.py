"""Completion in the shell: the script that a shell loads, and the answers that it asks for."""

from __future__ import annotations

import os

import click
from click.shell_completion import ShellComplete, get_completion_class

from symdh.cli import console

SHELLS = ("bash", "zsh", "fish")

_VARIABLE = "_SYMDH_COMPLETE"


def script(program: click.Command, shell: str) -> str:
    """Return the script that teaches a shell to complete symdh's command line."""
    return _completer(program, shell).source()


def is_requested() -> bool:
    """Say whether this process was started by such a script."""
    return _VARIABLE in os.environ


def answer(program: click.Command) -> int:
    """Print the completions that the shell asks for and return the exit status."""
    shell = os.environ[_VARIABLE].removesuffix("_complete")
    if shell not in SHELLS:
        return 1
    console.print_result(_completer(program, shell).complete())
    return 0


def _completer(program: click.Command, shell: str) -> ShellComplete:
    completer = get_completion_class(shell)
    assert completer is not None, shell
    return completer(program, {}, "symdh", _VARIABLE)
