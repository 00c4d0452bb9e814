"""Whether two expressions are equal: by number first, then proven in a ring."""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import Enum

from sympy import Expr

from symdh.kinematics.answers.circle import UndecidedError, equal_in_ring
from symdh.kinematics.answers.numbers import Point, close, precise, value

#: What two numbers of 50 digits may differ by, as a part of their size.
_LAST_DIGITS = 1e-30


class Sameness(Enum):
    """How two expressions compare."""

    PROVEN = "equal, proven"
    BY_NUMBER = "equal to 50 digits at every point tried"
    POSITIVE = "equal where all symbols are positive"
    DIFFERENT = "different"


def compare(first: Expr, second: Expr, points: Sequence[Point]) -> Sameness:
    """Compare two expressions.

    They are different when they have different values at a point. Else the ring is asked for a
    proof; where it has none, 50 digits at all points decide.

    Parameters
    ----------
    first, second : Expr
    points : sequence of mapping
        Numbers for all symbols; the first half of them positive.
    """
    if first == second:
        return Sameness.PROVEN
    if not _equal_at(first, second, points[0]):
        return Sameness.DIFFERENT
    if all(_equal_at(first, second, point) for point in points[1:]):
        if _proven(first, second):
            return Sameness.PROVEN
        if all(_precisely_equal(first, second, point) for point in points):
            return Sameness.BY_NUMBER
        return Sameness.DIFFERENT
    positive = len(points) // 2
    if positive > 1 and all(_precisely_equal(first, second, point) for point in points[:positive]):
        return Sameness.POSITIVE
    return Sameness.DIFFERENT


def _proven(first: Expr, second: Expr) -> bool:
    try:
        return equal_in_ring(first, second)
    except UndecidedError:
        return False


def _equal_at(first: Expr, second: Expr, point: Point) -> bool:
    x, y = value(first, point), value(second, point)
    if math.isfinite(x) and math.isfinite(y) and close(x, y):
        return True
    # Large terms that cancel leave few digits in double precision.
    return _precisely_equal(first, second, point)


def _precisely_equal(first: Expr, second: Expr, point: Point) -> bool:
    x, y = precise(first, point), precise(second, point)
    if not (x.is_real and y.is_real and x.is_finite and y.is_finite):
        return False
    return bool(abs(x - y) <= _LAST_DIGITS * (1 + abs(x) + abs(y)))
