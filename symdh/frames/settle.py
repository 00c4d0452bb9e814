"""Axes as they were measured -> axes as they are meant: near-parallel is parallel.

Directions and points that were given exactly pass through as they are. What is off by rounding,
up to the tolerance, is put right here, so that all that follows finds exact relations; every such
change is reported.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from sympy import Expr, Float, Rational

from symdh.frames import vectors as v
from symdh.frames.exact import is_zero
from symdh.frames.faults import AssignmentError, Fault, Subject
from symdh.frames.geometry import Line, is_small, number
from symdh.mechanism import ZERO, Mechanism, Vector

#: Digits that rounded numbers are carried with, and what a table keeps of them.
CARRIED = 30
KEPT = 15
ROUNDING = 1e-12
_NOTHING = Rational(1, 10**25)


@dataclass(frozen=True, slots=True)
class Snap:
    """A number that was taken for another one within the tolerance.

    Attributes
    ----------
    subject : Subject
    taken_as : str
        What the axis, or the tool, counts as: ``parallel to axis 1``.
    miss : float
        How far it was off: radians, or the length unit.
    angular : bool
        Whether `miss` is an angle.
    plain : bool
        Whether `miss` is a plain number: that of a unit vector's length.
    """

    subject: Subject
    taken_as: str
    miss: float
    angular: bool
    plain: bool = False

    def unit(self, length: str) -> str:
        """Return the unit of `miss`, where `length` is that of lengths."""
        return "" if self.plain else "rad" if self.angular else length


@dataclass(frozen=True, slots=True)
class Settled:
    """The lines of the z axes, and what had to be changed.

    Attributes
    ----------
    lines : tuple of Line
        Line i - 1 is axis i, its direction that of the frame's z.
    snaps : tuple of Snap
    angular, linear : Expr
        The limits in radians and in the length unit.
    exact : bool
        False where directions were rounded numbers; then parameters are rounded, too.
    """

    lines: tuple[Line, ...]
    snaps: tuple[Snap, ...]
    angular: Expr
    linear: Expr
    exact: bool


def settle(mechanism: Mechanism) -> Settled:
    """Check the axes of a mechanism and put right what rounding has bent.

    Raises
    ------
    AssignmentError
        When directions are zero or no unit vectors.
    """
    angular = mechanism.tolerance
    linear = angular * _size(mechanism)
    lines, snaps = [], []
    faults: list[Fault] = []
    for joint, axis in enumerate(mechanism.axes, start=1):
        subject: Subject = ("joint", joint, "direction")
        try:
            direction, miss = checked_unit(axis.direction, subject, angular)
        except AssignmentError as problem:
            faults += problem.faults
            continue
        if miss:
            taken_as = f"axis {joint}: a unit vector"
            snaps.append(Snap(subject, taken_as, miss, angular=False, plain=True))
        lines.append(Line(axis.point, v.negate(direction) if axis.reverse else direction))
    if faults:
        raise AssignmentError(faults)
    settled = lines[:1]
    for joint, line in enumerate(lines[1:], start=2):
        settled.append(_beside(settled[-1], line, joint, angular, linear, snaps))
    # What double precision leaves is rounding, but nothing that anybody needs to be told.
    told = tuple(snap for snap in snaps if snap.miss > ROUNDING)
    exact = not snaps and _has_exact_vectors(mechanism)
    return Settled(tuple(settled), told, angular, linear, exact)


def checked_unit(direction: Vector, subject: Subject, tolerance: Expr) -> tuple[Vector, float]:
    """Return a direction as a unit vector, and by how much its length missed 1.

    Raises
    ------
    AssignmentError
        When it is zero, or its length misses 1 by more than the tolerance.
    """
    square = v.dot(direction, direction)
    if is_zero(square):
        raise AssignmentError([Fault(subject, "direction is zero; it must be a unit vector")])
    miss = square - 1
    if is_zero(miss):
        return direction, 0.0
    if not is_small(miss, 2 * tolerance):
        message = f"direction is no unit vector: its length is {_shown(v.length(direction))}"
        raise AssignmentError([Fault(subject, message + _hint(direction))])
    size = number(v.length(direction))
    rounded = shortened(tuple(number(entry) / size for entry in direction))
    return rounded, float(abs(size - 1))


def shortened(vector: Vector) -> Vector:
    """Return a vector of numbers with entries of `CARRIED` digits, noise as 0."""
    x, y, z = (ZERO if is_small(entry, _NOTHING) else rounded(entry, CARRIED) for entry in vector)
    return x, y, z


def rounded(e: Expr, digits: int = KEPT) -> Expr:
    """Round a number to significant digits; what holds symbols stays as it is."""
    if e.is_Integer or e.free_symbols:
        return e
    return Rational(str(Float(e.evalf(digits + 10), digits)))


def _beside(
    first: Line, second: Line, joint: int, angular: Expr, linear: Expr, snaps: list[Snap]
) -> Line:
    """Return the line of axis `joint`, exactly parallel to or in line with its neighbour."""
    crossed = v.cross(first.direction, second.direction)
    subject: Subject = ("joint", joint, "direction")
    if not all(is_small(entry, angular) for entry in crossed):
        _note_near_relations(first, second, crossed, joint, (angular, linear), snaps)
        return second
    if not v.is_null(crossed):
        taken_as = f"axis {joint}: parallel to axis {joint - 1}"
        snaps.append(Snap(subject, taken_as, _largest(crossed), angular=True))
        same = v.dot(first.direction, second.direction)
        along = number(same) > 0
        second = Line(second.point, first.direction if along else v.negate(first.direction))
    offset = v.subtract(second.point, first.nearest(second.point))
    if v.is_null(offset) or not all(is_small(entry, linear) for entry in offset):
        return second
    taken_as = f"axis {joint}: in line with axis {joint - 1}"
    snaps.append(Snap(("joint", joint, "point"), taken_as, _largest(offset), angular=False))
    return Line(first.nearest(second.point), second.direction)


def _note_near_relations(
    first: Line,
    second: Line,
    crossed: Vector,
    joint: int,
    limits: tuple[Expr, Expr],
    snaps: list[Snap],
) -> None:
    """Note where two axes nearly meet or are nearly at right angles; the lines stay."""
    angular, linear = limits
    cosine = v.dot(first.direction, second.direction)
    if not is_zero(cosine) and is_small(cosine, angular):
        taken_as = f"axis {joint}: at right angles to axis {joint - 1}"
        miss = float(abs(number(cosine)))
        snaps.append(Snap(("joint", joint, "direction"), taken_as, miss, angular=True))
    side = v.dot(v.subtract(second.point, first.point), crossed)
    if linear == 0 or is_zero(side):
        return
    distance = side / v.length(crossed)
    if is_small(distance, linear):
        taken_as = f"axis {joint}: meets axis {joint - 1}"
        miss = float(abs(number(distance)))
        snaps.append(Snap(("joint", joint, "point"), taken_as, miss, angular=False))


def _has_exact_vectors(mechanism: Mechanism) -> bool:
    """Say whether tool and choices hold exact unit vectors, the tool's at right angles."""
    tool = mechanism.tool
    given = [choice.x for choice in mechanism.choices.values()]
    if tool is not None:
        given += [tool.approach, tool.sliding]
        if tool.approach and tool.sliding and not is_zero(v.dot(tool.approach, tool.sliding)):
            return False
    return all(is_zero(v.dot(each, each) - 1) for each in given if each is not None)


def _size(mechanism: Mechanism) -> Expr:
    """Return the largest distance of a coordinate along the chain; 0 where there are symbols."""
    points = [axis.point for axis in mechanism.axes]
    if mechanism.tool is not None:
        points.append(mechanism.tool.point)
    steps = [abs(entry) for a, b in pairwise(points) for entry in v.subtract(b, a)]
    numbers = [step for step in steps if not step.free_symbols]
    return max(numbers, default=ZERO)


def _largest(vector: Vector) -> float:
    return max(abs(float(number(entry))) for entry in vector)


def _shown(size: Expr) -> str:
    return str(size) if size.free_symbols or size.is_Integer else f"{float(number(size)):.6g}"


def _hint(direction: Vector) -> str:
    """Say how the unit vector of a direction of whole numbers is written."""
    if not all(entry.is_Integer for entry in direction):
        return ""
    size = v.length(direction)
    divisor = str(size) if size.is_Integer else f"sqrt({v.dot(direction, direction)})"
    entries = ", ".join(str(entry) if entry == 0 else f"{entry}/{divisor}" for entry in direction)
    if sum(entry != 0 for entry in direction) == 1:
        entries = ", ".join(str(int(entry / size)) for entry in direction)
    return f"; write [{entries}]"
