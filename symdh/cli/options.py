"""Arguments and options that several commands share, so that they look alike everywhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])


def examples(*commands: str) -> str:
    """Return the end of a help text: commands to copy."""
    # The control character tells click to leave the line ends alone.
    return "\b\nExample:\n" + "\n".join(f"  {command}" for command in commands)


def table_argument(function: F) -> F:
    """Add the argument TABLE."""
    return click.argument("table", type=click.Path(allow_dash=True, readable=False))(function)


def frame_options(function: F) -> F:
    """Add --from and --to."""
    start = click.option(
        "--from",
        "start",
        metavar="FRAME",
        help="Frame to start from: base, 0 .. n or tool. Default: base.",
    )
    end = click.option(
        "--to",
        "end",
        metavar="FRAME",
        help="Frame to go to: base, 0 .. n or tool. Default: tool.",
    )
    return start(end(function))


def notation_option(function: F) -> F:
    """Add --notation."""
    return click.option(
        "--notation",
        type=click.Choice(["auto", "standard", "craig"]),
        default="auto",
        show_default=True,
        help="How a pose is written: standard ⁰T₃, craig ⁰₃T; auto: craig for a modified table.",
    )(function)


def order_option(function: F) -> F:
    """Add --order."""
    return click.option(
        "--order",
        type=click.Choice(["right", "left"]),
        default="right",
        show_default=True,
        help="End of the chain that the products begin at.",
    )(function)


def document_options(function: F) -> F:
    """Add --order, --notation and --paper."""
    paper = click.option(
        "--paper",
        type=click.Choice(["a4", "letter"]),
        default="a4",
        show_default=True,
        help="Paper of the handout.",
    )
    return order_option(notation_option(paper(function)))


def preamble_option(function: F) -> F:
    """Add --preamble."""
    return click.option(
        "--preamble",
        metavar="FILE",
        help="LaTeX of your own for the preamble: packages, fonts, a header.",
    )(function)


def force_option(function: F) -> F:
    """Add --force."""
    return click.option(
        "--force", is_flag=True, help="Also replace a file that symdh did not write."
    )(function)


def folder_option(default: str) -> Callable[[F], F]:
    """Make the option -o for a folder."""
    return click.option(
        "-o",
        "--output",
        "folder",
        metavar="DIR",
        help=f"Folder to write into; made if need be. Default: {default}.",
    )


def file_option(default: str) -> Callable[[F], F]:
    """Make the option -o for a file."""
    return click.option(
        "-o",
        "--output",
        "output",
        metavar="FILE",
        help=f"File to write; - is standard output. Default: {default}.",
    )
