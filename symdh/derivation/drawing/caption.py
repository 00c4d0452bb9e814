"""What a drawing does not show by itself: the numbers that it was drawn with."""

from __future__ import annotations

import math
from collections.abc import Mapping

from sympy import Rational, Symbol

from symdh.derivation.drawing.view import View
from symdh.derivation.numbers import angles
from symdh.derivation.text import Inline, Text
from symdh.notation import Notation
from symdh.notation.nodes import Degrees, Equation, Negative, Node
from symdh.robot import Robot


def caption(robot: Robot, drawn: Mapping[Symbol, float], view: View, to_scale: bool) -> Text:
    """Return the caption: the angles, and what is not to scale.

    Parameters
    ----------
    robot : Robot
    drawn : mapping of Symbol to float
        The angles that a reader cannot know.
    view : View
    to_scale : bool
    """
    notation, turning = Notation(robot), angles(robot)
    symbols = (*robot.parameters, *robot.variables)
    at = [
        Equation((notation.write(symbol), _degrees(drawn[symbol])))
        for symbol in symbols
        if symbol in drawn and symbol in turning
    ]
    scale = "to scale" if to_scale else "lengths not to scale"
    parts: list[Inline] = ["Drawn at ", *_listed(at), f", {scale}."]
    if not at:
        parts = [f"{scale.capitalize()}."]
    if view.flat:
        parts.append(" The z axes are perpendicular to the page.")
    return tuple(parts)


def _listed(equations: list[Equation]) -> list[Inline]:
    parts: list[Inline] = []
    for position, equation in enumerate(equations):
        if position:
            parts.append(" and " if position == len(equations) - 1 else ", ")
        parts.append(equation)
    return parts


def _degrees(angle: float) -> Node:
    value = Rational(round(math.degrees(angle) * 10), 10)
    return Negative(Degrees(-value)) if value < 0 else Degrees(value)
