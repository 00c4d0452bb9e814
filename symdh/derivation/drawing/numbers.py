"""The numbers that an arm is drawn with where its table has symbols."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from statistics import median

from sympy import Expr, Float, Symbol, pi

from symdh.derivation.numbers import angles
from symdh.errors import UnsupportedError
from symdh.robot import JointType, MotionKind, Robot
from symdh.table.quantity import NOT_FINITE

#: A twist without a value, in radians: no right angle, which would say more than the table does.
UNKNOWN_ANGLE = float(pi / 3)
#: A length without a value where no other has one.
UNKNOWN_LENGTH = 1.0

Numbers = Mapping[Symbol, float]


def known_numbers(robot: Robot, given: Mapping[Symbol, Expr]) -> dict[Symbol, float]:
    """Return the symbols that have a value, those of `given` first, as floats."""
    symbols = (*robot.parameters, *robot.variables)
    exact = {**robot.values, **given}
    return {symbol: number(exact[symbol], {}) for symbol in symbols if symbol in exact}


def stand_ins(robot: Robot, known: Numbers) -> dict[Symbol, float]:
    """Return numbers for the symbols without a value, joint variables that turn left out.

    A length is as long as the others are, a twist is 60 degrees; a joint that slides is out by
    about a length, as far as its limits allow.
    """
    turning = angles(robot)
    usual = usual_length(robot, known)
    found: dict[Symbol, float] = {}
    for symbol in robot.parameters:
        if symbol not in known:
            found[symbol] = UNKNOWN_ANGLE if symbol in turning else usual
    for joint in robot.joints:
        if joint.type is JointType.PRISMATIC and joint.variable not in known:
            assert joint.variable is not None
            found[joint.variable] = _slide(robot, joint.variable, joint.d, {**known, **found})
    return found


def usual_length(robot: Robot, known: Numbers) -> float:
    """Return the middle one of the lengths that are known; 1 where there is none."""
    lengths = [abs(size) for size in _lengths(robot, known) if size]
    return median(lengths) if lengths else UNKNOWN_LENGTH


def _lengths(robot: Robot, known: Numbers) -> Iterator[float]:
    for amount in (
        *(amount for joint in robot.joints for amount in (joint.d, joint.a)),
        *(m.amount for m in (*robot.base, *robot.tool) if m.kind is MotionKind.TRANSLATION),
    ):
        if amount.free_symbols <= set(known):
            with suppress(UnsupportedError):
                yield number(amount, known)


def _slide(robot: Robot, variable: Symbol, d: Expr, known: Numbers) -> float:
    """Return the value of a variable that slides its joint out by a usual length."""
    usual = usual_length(robot, known)
    start, slope = 0.0, 0.0
    with suppress(UnsupportedError):
        start, slope = line(d, variable, known)
    value = (usual - start) / slope if slope else usual
    if variable in robot.limits:
        limits = robot.limits[variable]
        low, high = number(limits.lower, {}), number(limits.upper, {})
        return min(max(value, low + 0.3 * (high - low)), low + 0.7 * (high - low))
    return value


def line(amount: Expr, variable: Symbol, known: Numbers) -> tuple[float, float]:
    """Return p and q of an amount that is p + q times its variable."""
    start = number(amount, {**known, variable: 0.0})
    return start, number(amount, {**known, variable: 1.0}) - start


def number(amount: Expr, known: Numbers) -> float:
    """Return an expression as a float.

    Raises
    ------
    UnsupportedError
        When the numbers make it infinite or complex.
    """
    value = amount.xreplace({symbol: Float(size) for symbol, size in known.items()}).evalf()
    if value.has(*NOT_FINITE) or not (value.is_real and value.is_finite):
        raise UnsupportedError(
            f"{amount} has no real value with these numbers, so there is nothing to draw"
        )
    return float(value)
