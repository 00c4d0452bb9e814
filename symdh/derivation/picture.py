"""The drawing of a robot as a part of its document."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Expr, Symbol

from symdh.derivation.blocks import Figure
from symdh.derivation.drawing.choices import DEFAULT, NO_VALUES, Choices
from symdh.derivation.drawing.draw import MAX_ROWS, draw
from symdh.errors import UnsupportedError
from symdh.robot import Robot


def drawings(
    robot: Robot, values: Mapping[Symbol, Expr] = NO_VALUES, choices: Choices = DEFAULT
) -> tuple[Figure, ...]:
    """Return the drawing of a robot; none where the robot is too long, or its numbers not real.

    Parameters
    ----------
    robot : Robot
    values : mapping of Symbol to Expr
    choices : Choices
        See `draw`.
    """
    if robot.n > MAX_ROWS:
        return ()
    try:
        return (Figure(draw(robot, values, choices)),)
    except UnsupportedError:
        return ()
