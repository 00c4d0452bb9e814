"""A robot in place of plain rotations, so that their symbols are written and set like an arm's."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from sympy import Expr, Integer, Symbol

from symdh.kinematics.rotation.composing import Step
from symdh.motion import translation
from symdh.robot import Axis, Convention, Joint, JointType, Robot, Units, in_name_order

_ZERO = Integer(0)
_NO_UNITS = Units()


def stand_in(
    steps: Sequence[Step],
    point: Sequence[Expr] | None = None,
    units: Units = _NO_UNITS,
    values: Mapping[Symbol, Expr] | None = None,
    title: str | None = None,
) -> Robot:
    """Return a robot whose rows hold the angles of rotations and whose tool holds a point.

    Angles with numbered names such as theta1 count as joint variables, so that their cosines are
    written ``c_1``; others are spelt out.
    """
    angles: dict[Symbol, None] = {}
    for step in steps:
        angles |= dict.fromkeys(in_name_order(step.angle.free_symbols))
    numbers = [re.search(r"(?<!\d)[1-9]\d{0,2}$", symbol.name) for symbol in angles]
    told_apart = {found[0] for found in numbers if found}
    numbered = len(told_apart) == len(angles)
    slides = [translation(axis, x) for axis, x in zip(Axis, point or (), strict=False)]
    return Robot(
        "rotation",
        Convention.STANDARD,
        tuple(_row(symbol, numbered) for symbol in angles),
        tool=tuple(slides),
        values=values or {},
        title=title,
        units=units,
    )


def _row(symbol: Symbol, numbered: bool) -> Joint:
    if numbered:
        return Joint(JointType.REVOLUTE, symbol, _ZERO, _ZERO, _ZERO, symbol)
    return Joint(JointType.FIXED, symbol, _ZERO, _ZERO, _ZERO, None)
