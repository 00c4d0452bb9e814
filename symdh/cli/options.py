"""Arguments and options that several commands share, so that they look alike everywhere."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])


class NumberRange(click.FloatRange):
    """A range of real numbers: click's own lets through what is no number, nan, in every range."""

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number, or refuse what is none."""
        number: float = super().convert(value, param, ctx)
        if math.isnan(number):
            self.fail(f"{value!r} is not a number.", param, ctx)
        return number


def examples(*commands: str) -> str:
    """Return the end of a help text: commands to copy."""
    # The control character tells click to leave the line ends alone.
    return "\b\nExample:\n" + "\n".join(f"  {command}" for command in commands)


def table_argument(function: F) -> F:
    """Add the argument TABLE."""
    return click.argument("table", type=click.Path(allow_dash=True, readable=False))(function)


def tables_argument(function: F) -> F:
    """Add the argument TABLE..., one or more."""
    kind = click.Path(allow_dash=True, readable=False)
    return click.argument("tables", metavar="TABLE...", nargs=-1, required=True, type=kind)(
        function
    )


def _number_of_jobs(ctx: click.Context, param: click.Parameter, value: str) -> int:
    if value == "auto":
        return 0
    if not (value.isascii() and value.isdigit() and len(value) < 4):
        raise click.BadParameter(f"{value!r} is not a number from 0 to 999 and not auto.")
    return int(value)


def jobs_option(function: F) -> F:
    """Add --jobs; the command gets 0 for as many as there are cores."""
    return click.option(
        "-j",
        "--jobs",
        callback=_number_of_jobs,
        default="auto",
        show_default=True,
        metavar="N",
        help="Tables to derive at the same time, if there are several; auto or 0: one a core.",
    )(function)


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


def set_option(what: str) -> Callable[[F], F]:
    """Make the option --set; `what` says what its values are."""
    return click.option(
        "--set",
        "settings",
        metavar="NAME=VALUE",
        multiple=True,
        help=f"{what} Repeatable.",
    )


def format_option(*forms: str, what: str) -> Callable[[F], F]:
    """Make the option --format with some formats, of which the first is the default."""
    return click.option(
        "--format",
        "form",
        type=click.Choice(forms),
        default=forms[0],
        show_default=True,
        help=what,
    )


def time_limit_option(seconds: float, what: str) -> Callable[[F], F]:
    """Return the option ``--time-limit`` with its default and its line of help."""
    return click.option(
        "--time-limit",
        type=NumberRange(min=0, min_open=True),
        default=seconds,
        show_default=True,
        metavar="SECONDS",
        help=what,
    )


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


def paper_option(function: F) -> F:
    """Add --paper."""
    return click.option(
        "--paper",
        type=click.Choice(["a4", "letter"]),
        default="a4",
        show_default=True,
        help="Paper of the handout.",
    )(function)


def document_options(function: F) -> F:
    """Add --order, --notation and --paper."""
    return order_option(notation_option(paper_option(function)))


def sheet_options(function: F) -> F:
    """Add --sheet, --points and --ask-table."""
    sheet = click.option(
        "--sheet",
        type=click.Choice(["problem", "solution"]),
        help="A sheet of homework in place of the handout: problem leaves room for the answers, "
        "solution gives them at the same places.",
    )
    points = click.option(
        "--points", is_flag=True, help="On a sheet, leave a place for points at each exercise."
    )
    table = click.option(
        "--ask-table",
        is_flag=True,
        help="On a sheet, give the drawing alone and ask for the table first.",
    )
    return sheet(points(table(function)))


def preamble_option(function: F) -> F:
    """Add --preamble."""
    return click.option(
        "--preamble",
        metavar="FILE",
        help="LaTeX of your own for the preamble: packages, fonts, a header.",
    )(function)


def templates_option(function: F) -> F:
    """Add --templates; the templates are in force while the command runs."""
    return click.option(
        "--templates",
        metavar="DIR",
        expose_value=False,
        callback=_use_templates,
        help="Folder of templates of your own, in place of symdh's of the same names; "
        "see symdh templates --help.",
    )(function)


def _use_templates(context: click.Context, option: click.Parameter, folder: str | None) -> None:
    if folder is None or context.resilient_parsing:
        return
    from symdh.cli import console
    from symdh.templating import own_templates

    console.show_diagnostics(context.with_resource(own_templates(folder)).warnings)


def no_ik_option(function: F) -> F:
    """Add --no-ik."""
    return click.option(
        "--no-ik",
        is_flag=True,
        help="Leave the inverse kinematics out of the code; without its search this takes less "
        "time, and the files are smaller.",
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
