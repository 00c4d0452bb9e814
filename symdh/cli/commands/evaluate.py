"""``symdh eval``: the numeric pose."""

from __future__ import annotations

import click

from symdh.cli import arguments, console, options, tables


@click.command(
    "eval",
    epilog=options.examples(
        'symdh eval scara.yaml --set theta1="30 deg" --set q3=0.1',
        "symdh eval scara.yaml --to 2 --format json",
    ),
)
@options.table_argument
@options.set_option("Value of a symbol, with or without its unit; wins over the table's own.")
@options.frame_options
@options.format_option("text", "json", what="Aligned numbers to read, or JSON for a program.")
def evaluate(
    table: str, settings: tuple[str, ...], start: str | None, end: str | None, form: str
) -> None:
    """Print the pose of one frame in another as numbers.

    Symbols take their values from the table and from --set. A bare number means what the table's
    units say.
    """
    from symdh.kinematics.numeric import pose
    from symdh.render.json_form import eval_json
    from symdh.render.terminal import render_numbers

    robot = tables.read_robot(table)
    first, last = tables.frames_between(robot, start, end)
    matrix = pose(robot, first, last, arguments.assignment(robot, settings))
    show = eval_json if form == "json" else render_numbers
    console.print_result(show(first, last, matrix))
