"""A robot in place of plain rotations, so that their symbols are written and set like an arm's."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from sympy import Expr, Integer, Symbol, cos, default_sort_key, sin

from symdh.motion import translation
from symdh.robot import Axis, Convention, Joint, JointType, Robot, Units, in_name_order

_ZERO = Integer(0)
_NO_UNITS = Units()


def stand_in(
    angles: Iterable[Expr] = (),
    point: Sequence[Expr] | None = None,
    units: Units = _NO_UNITS,
    values: Mapping[Symbol, Expr] | None = None,
    title: str | None = None,
    entries: Iterable[Expr] = (),
) -> Robot:
    """Return a robot whose rows hold the symbols of rotations and whose tool holds a point.

    The rotations are given by angles or by the entries of a matrix. Angles with numbered names
    such as theta1 count as joint variables, so that their cosines are written ``c_1``; others are
    spelt out.
    """
    entries = tuple(entries)
    turned = {x for entry in entries for function in entry.atoms(cos, sin) for x in function.args}
    measured = _symbols([*angles, *sorted(turned, key=default_sort_key)])
    numbers = [re.search(r"(?<!\d)[1-9]\d{0,2}$", symbol.name) for symbol in measured]
    told_apart = {found[0] for found in numbers if found}
    numbered = len(told_apart) == len(measured)
    others = [symbol for symbol in _symbols(entries) if symbol not in measured]
    slides = [translation(axis, x) for axis, x in zip(Axis, point or (), strict=False)]
    return Robot(
        "rotation",
        Convention.STANDARD,
        # A square does not say what its root measures: the entries of a matrix are plain numbers.
        (*(_row(x, numbered) for x in measured), *(_row(x**2, numbered=False) for x in others)),
        tool=tuple(slides),
        values=values or {},
        title=title,
        units=units,
    )


def _symbols(expressions: Iterable[Expr]) -> list[Symbol]:
    """Return each symbol once, in the order of the expressions."""
    found: dict[Symbol, None] = {}
    for expression in expressions:
        found |= dict.fromkeys(in_name_order(expression.free_symbols))
    return list(found)


def _row(angle: Expr, numbered: bool) -> Joint:
    if numbered:
        return Joint(JointType.REVOLUTE, angle, _ZERO, _ZERO, _ZERO, angle)
    return Joint(JointType.FIXED, angle, _ZERO, _ZERO, _ZERO, None)
