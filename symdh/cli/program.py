"""The `symdh` command group. Nothing imported here may import sympy: `--help` must be instant."""

from __future__ import annotations

import difflib
from pathlib import Path

import click

from symdh._version import __version__
from symdh.cli.commands.answer import answer
from symdh.cli.commands.check import check
from symdh.cli.commands.code import code
from symdh.cli.commands.completion import completion
from symdh.cli.commands.convert import convert
from symdh.cli.commands.derive import derive
from symdh.cli.commands.draw import draw
from symdh.cli.commands.evaluate import evaluate
from symdh.cli.commands.frames import frames
from symdh.cli.commands.html import html
from symdh.cli.commands.ik import ik
from symdh.cli.commands.init import init
from symdh.cli.commands.jacobian import jacobian, singular
from symdh.cli.commands.latex import latex
from symdh.cli.commands.pdf import pdf
from symdh.cli.commands.rotate import rotate
from symdh.cli.commands.show import show
from symdh.cli.commands.task import task
from symdh.cli.commands.templates import templates
from symdh.cli.options import examples

#: In the order in which a newcomer meets them.
COMMANDS = (
    init,
    check,
    derive,
    show,
    evaluate,
    jacobian,
    singular,
    ik,
    task,
    rotate,
    frames,
    convert,
    latex,
    html,
    pdf,
    draw,
    answer,
    code,
    templates,
    completion,
)


class Program(click.Group):
    """A group that lists its commands in the order given and guesses what a misspelt one meant."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the commands, first things first."""
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that the arguments name."""
        name = args[0]
        if name not in self.commands and not name.startswith("-") and not ctx.resilient_parsing:
            ctx.fail(f"there is no command {name!r}. {self._advice(name)}")
        return super().resolve_command(ctx, args)

    def _advice(self, name: str) -> str:
        close = difflib.get_close_matches(name, self.commands, n=1)
        if close:
            return f"Did you mean {close[0]}?"
        if Path(name).suffix in (".yaml", ".yml", ".csv", ".md"):
            return f"Did you mean symdh derive {name}?"
        return f"The commands are {', '.join(self.commands)}."


@click.group(
    cls=Program,
    commands={command.name: command for command in COMMANDS if command.name is not None},
    epilog=examples(
        "symdh init arm.yaml        write a commented starter table",
        "symdh derive arm.yaml      derive it: result, LaTeX, Python and C",
    ),
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, prog_name="symdh", message="%(prog)s %(version)s")
def program() -> None:
    """Derive the kinematics of a serial arm from its Denavit-Hartenberg table.

    Exit status: 0 done, 1 a checked answer is wrong, 2 wrong usage or input, 3 a file cannot be
    read or written, 4 a limit was reached, 130 interrupted.
    """
