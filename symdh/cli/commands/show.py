"""``symdh show``: one transform, on the terminal."""

from __future__ import annotations

import click

from symdh.cli import console, options, tables


@click.command(
    epilog=options.examples(
        "symdh show scara.yaml", "symdh show scara.yaml --from 2 --to 4 --format json"
    )
)
@options.table_argument
@options.frame_options
@options.notation_option
@options.format_option(
    "text", "latex", "json", what="Unicode to read, LaTeX to paste, or JSON for a program."
)
def show(table: str, start: str | None, end: str | None, notation: str, form: str) -> None:
    """Print the exact pose of one frame in another.

    Frames count from 0 to n; base and tool stand before and behind them. Going backwards gives
    the inverse.
    """
    robot = tables.read_robot(table)
    first, last = tables.frames_between(robot, start, end)
    if form == "json":
        from symdh.render.json_form import show_json

        console.print_result(show_json(robot, first, last))
    elif form == "latex":
        from symdh.render.latex import render_transform

        console.print_result(render_transform(robot, first, last, naming=notation))
    else:
        from symdh.render.terminal import render_result

        console.print_result(
            render_result(robot, first, last, width=console.width(), naming=notation)
        )
