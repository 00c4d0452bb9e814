"""``symdh draw``: the arm as a line drawing for paper."""

from __future__ import annotations

from pathlib import Path

import click

from symdh.cli import arguments, files, options, tables

#: What --format calls a format, and how a file of it ends.
_ENDINGS = {"svg": "svg", "tikz": "tex"}
#: Behind the robot's name; NAME.tex is the handout.
_NAMES = {"svg": ".svg", "tex": "_drawing.tex"}


@click.command(
    epilog=options.examples(
        "symdh draw scara.yaml -o arm.svg",
        "symdh draw scara.yaml -o arm.tex --to-scale",
        'symdh draw arm.yaml --set theta1="30 deg" --azimuth 20 -o - > arm.svg',
    )
)
@options.table_argument
@options.file_option("NAME.svg or NAME_drawing.tex")
@click.option(
    "--format",
    "form",
    type=click.Choice(list(_ENDINGS)),
    help="SVG, or TikZ for LaTeX. Default: what the file's name says, else svg.",
)
@options.set_option("Value of a symbol to draw with, with or without its unit.")
@click.option(
    "--azimuth",
    type=options.NumberRange(-360, 360),
    metavar="DEGREES",
    help="Where to look from, about z from the x axis. Default: a planar arm is drawn in its "
    "plane, any other from -60.",
)
@click.option(
    "--elevation",
    type=options.NumberRange(-90, 90),
    metavar="DEGREES",
    help="How far above the xy plane to look from. Default: 27.",
)
@click.option("--to-scale", is_flag=True, help="Keep the ratios of the lengths.")
@click.option("--y-axes", is_flag=True, help="Draw the y axes too.")
@options.templates_option
@options.force_option
def draw(
    table: str,
    output: str | None,
    form: str | None,
    settings: tuple[str, ...],
    azimuth: float | None,
    elevation: float | None,
    to_scale: bool,
    y_axes: bool,
    force: bool,
) -> None:
    """Draw the arm: links, joints, frames and dimensions.

    Symbols take their values from the table and from --set. A length without a value is drawn as
    long as the others, a joint without one where no link hides another. Unless --to-scale is
    given, short lengths are drawn longer, so that small offsets are seen.

    TABLE is a file, or - for standard input.
    """
    from symdh.codegen.names import file_stem
    from symdh.derivation.drawing.choices import Choices
    from symdh.derivation.drawing.draw import draw as drawing_of
    from symdh.render.drawing import DRAWING_FORMATS

    robot = tables.read_robot(table)
    choices = Choices(azimuth, elevation, to_scale, y_axes)
    drawing = drawing_of(robot, arguments.assignment(robot, settings), choices)
    ending = _ending(output, form)
    text = DRAWING_FORMATS[ending](drawing)
    files.save(output or f"{file_stem(robot.name)}{_NAMES[ending]}", text.encode(), force=force)


def _ending(output: str | None, form: str | None) -> str:
    """Return the ending of the format that was asked for.

    Raises
    ------
    click.BadParameter
        When the name of the file is of no known format, and no format was given.
    """
    if form is not None:
        return _ENDINGS[form]
    if output is None or output == "-":
        return "svg"
    ending = Path(output).suffix.lower().removeprefix(".")
    if ending not in _ENDINGS.values():
        raise click.BadParameter(
            f"no format is known by the ending of {output!r}: use .svg or .tex, or give --format.",
            param_hint="'-o' / '--output'",
        )
    return ending
