"""``symdh completion``: the script that teaches a shell to complete."""

from __future__ import annotations

import click

from symdh.cli import console, options
from symdh.cli.completion import SHELLS, script


@click.command(
    epilog=options.examples(
        "symdh completion bash > ~/.local/share/bash-completion/completions/symdh"
    )
)
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def completion(ctx: click.Context, shell: str) -> None:
    """Print the script for completion in the shell."""
    console.print_result(script(ctx.find_root().command, shell))
