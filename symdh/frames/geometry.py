"""How two lines in space lie to each other, exactly or within a tolerance."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from sympy import Expr, Float

from symdh.frames import vectors as v
from symdh.frames.exact import is_positive, is_zero, tidy
from symdh.mechanism import ZERO, Vector


class Relation(Enum):
    """The four ways in which two lines lie to each other; the value is how one says it."""

    SKEW = "skew"
    INTERSECTING = "intersecting"
    PARALLEL = "parallel"
    COINCIDENT = "coincident"


@dataclass(frozen=True, slots=True)
class Line:
    """A line in space; `direction` is a unit vector."""

    point: Vector
    direction: Vector

    def nearest(self, point: Vector) -> Vector:
        """Return the point of the line that is nearest to another point."""
        offset = v.dot(v.subtract(point, self.point), self.direction)
        return v.along(self.point, offset, self.direction)

    def holds(self, point: Vector, within: Expr = ZERO) -> bool:
        """Say whether a point is on the line."""
        return all(is_small(entry, within) for entry in v.subtract(point, self.nearest(point)))


@dataclass(frozen=True, slots=True)
class Pair:
    """Two lines and what lies between them.

    Attributes
    ----------
    relation : Relation
    first, second : Line
    normal : Vector or None
        A direction, of any length, at right angles to both: from the first to the second line,
        or, where they meet, first x second. None where they coincide.
    feet : (Vector, Vector) or None
        The points of both lines that are nearest to each other; None where no two are alone.
    """

    relation: Relation
    first: Line
    second: Line
    normal: Vector | None
    feet: tuple[Vector, Vector] | None


def relate(first: Line, second: Line, angular: Expr = ZERO, linear: Expr = ZERO) -> Pair:
    """Find how two lines lie to each other, and their common normal.

    Parameters
    ----------
    first, second : Line
    angular, linear : Expr
        Numbers up to these count as zero, in radians and in the length unit.
    """
    between = v.subtract(second.point, first.point)
    crossed = v.cross(first.direction, second.direction)
    if all(is_small(entry, angular) for entry in crossed):
        offset = v.subtract(second.point, first.nearest(second.point))
        if all(is_small(entry, linear) for entry in offset):
            return Pair(Relation.COINCIDENT, first, second, None, None)
        return Pair(Relation.PARALLEL, first, second, v.ray(offset), None)
    square = v.dot(crossed, crossed)
    feet = (
        v.along(
            first.point,
            tidy(v.dot(v.cross(between, second.direction), crossed) / square),
            first.direction,
        ),
        v.along(
            second.point,
            tidy(v.dot(v.cross(between, first.direction), crossed) / square),
            second.direction,
        ),
    )
    side = v.dot(between, crossed)
    normal = v.ray(crossed)
    if is_zero(side) or (linear != 0 and is_small(side / v.length(crossed), linear)):
        return Pair(Relation.INTERSECTING, first, second, normal, feet)
    normal = normal if is_positive(side) else v.negate(normal)
    return Pair(Relation.SKEW, first, second, normal, feet)


def is_small(e: Expr, limit: Expr) -> bool:
    """Say whether a number is zero, or at most `limit`; symbols must vanish exactly."""
    if is_zero(e):
        return True
    return limit != 0 and not e.free_symbols and bool(abs(number(e)) <= limit)


def plain(e: Expr) -> str:
    """Write a number for a message: short ones exactly, others rounded."""
    exact = str(e)
    return exact if e.free_symbols or len(exact) < 12 else f"{float(number(e)):.6g}"


def number(e: Expr) -> Float:
    """Return the value of a constant."""
    return e.evalf(30)
