"""``symdh jacobian``: velocities as a matrix times the joint rates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symdh.cli import arguments, console, options, patience, tables

if TYPE_CHECKING:
    from symdh.derivation.blocks import Chapter

_FORMAT = options.format_option(
    "text", "latex", "json", what="Unicode to read, LaTeX to paste, or JSON for a program."
)
_OF = click.option(
    "--of", metavar="FRAME", help="Frame that moves: base, 0 .. n or tool. Default: tool."
)
_AT = click.option(
    "--at",
    metavar="X,Y,Z",
    help="Point of that frame, in its coordinates, with or without units. Default: its origin.",
)


@click.command(
    epilog=options.examples(
        "symdh jacobian scara.yaml",
        "symdh jacobian puma560.yaml --of 4 --in 3 --format json",
        'symdh jacobian arm.yaml --at "0, 0, 20 mm"',
    )
)
@options.table_argument
@_OF
@_AT
@click.option(
    "--in",
    "seen_from",
    metavar="FRAME",
    help="Frame whose axes the components are along: base, 0 .. n or tool. Default: base.",
)
@_FORMAT
def jacobian(table: str, of: str | None, at: str | None, seen_from: str | None, form: str) -> None:
    """Print the geometric Jacobian.

    Its rows give the linear velocity of a point of a frame, then the angular velocity of the
    frame; each column belongs to one joint variable.
    """
    from symdh.kinematics import velocity

    robot = tables.read_robot(table)
    in_, frame = tables.frames_between(robot, seen_from, of)
    point = arguments.point(robot, at)
    with patience.telling(f"differentiating {robot.name}"):
        found = velocity.jacobian(robot, frame, point, in_)
    if form == "json":
        from symdh.render.velocity_json import jacobian_json

        console.print_result(jacobian_json(found))
        return
    from symdh.derivation.style import Style
    from symdh.derivation.velocity import jacobian_chapter

    _print(jacobian_chapter(Style(robot), found), form)


@click.command(
    epilog=options.examples(
        "symdh singular puma560.yaml", "symdh singular planar_2r.yaml --of 2 --format json"
    )
)
@options.table_argument
@_OF
@_AT
@_FORMAT
def singular(table: str, of: str | None, at: str | None, form: str) -> None:
    """Print where the arm loses a direction of motion.

    The determinant of the Jacobian as a product of factors, the joint values at which each factor
    vanishes, and its name where it has one. An arm with fewer or more than six joints has
    conditions on the rank instead.
    """
    from symdh.kinematics.singular import singularities

    robot = tables.read_robot(table)
    _, frame = tables.frames_between(robot, None, of)
    point = arguments.point(robot, at)
    with patience.telling(f"looking for the singularities of {robot.name}"):
        found = singularities(robot, frame, point)
    if form == "json":
        from symdh.render.velocity_json import singularities_json

        console.print_result(singularities_json(found))
        return
    from symdh.derivation.singularity import chapter
    from symdh.derivation.style import Style

    _print(chapter(Style(robot), found), form)


def _print(chapter: Chapter, form: str) -> None:
    if form == "latex":
        from symdh.render.latex import render_chapter

        console.print_result(render_chapter(chapter))
        return
    from symdh.render.terminal import render_chapters

    console.print_result(render_chapters((chapter,), width=console.width()))
