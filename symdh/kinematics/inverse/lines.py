"""Joint axes as lines in space, in floating point: which of them are parallel, which meet."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin, sqrt

from sympy import Symbol

from symdh.kinematics.chain import link_word
from symdh.kinematics.inverse.lengths import drawn_lengths
from symdh.robot import Axis, Convention, JointType, Motion, MotionKind, Robot

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Line:
    """The axis of a joint.

    Attributes
    ----------
    row : int
        The joint's row in the table, from 1.
    type : JointType
    point, direction : three float
    """

    row: int
    type: JointType
    point: Vector
    direction: Vector


def joint_lines(robot: Robot, q: Sequence[float]) -> tuple[Line, ...]:
    """Return the axes of the joints that move; free lengths are drawn at random."""
    return Axes(robot).lines(q)


@dataclass(frozen=True, slots=True)
class _Part:
    """A motion: its kind and axis, the joint variable in it and its factor, and a constant."""

    turns: bool
    axis: int
    place: int | None
    factor: float
    constant: float


class Axes:
    """The axes of a robot's joints in frame 0, for any joint values.

    Parameters
    ----------
    robot : Robot
        Lengths without a value are drawn at random.

    Raises
    ------
    UnsupportedError
        When a length is no real number.
    """

    def __init__(self, robot: Robot) -> None:
        numbers = drawn_lengths(robot, random.Random(3), 0.4, 1.6)
        numbers |= {s: float(v) for s, v in robot.values.items() if s in robot.parameters}
        # The z axis that the joint turns about stands before its own rotation.
        self._skip = 0 if robot.convention is Convention.STANDARD else 2
        self._joints = robot.joints
        places = {variable: k for k, variable in enumerate(robot.variables)}
        self._rows = [
            [_part(motion, numbers, places) for motion in link_word(robot, i)]
            for i in range(1, robot.n + 1)
        ]

    def lines(self, q: Sequence[float]) -> tuple[Line, ...]:
        """Return the axes of the joints that move."""
        axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        place = [0.0, 0.0, 0.0]
        lines = []
        for i, (joint, row) in enumerate(zip(self._joints, self._rows, strict=True), start=1):
            for k, part in enumerate(row):
                if k == self._skip and joint.variable is not None:
                    point, z = place, axes[Axis.Z]
                    lines.append(
                        Line(i, joint.type, (point[0], point[1], point[2]), (z[0], z[1], z[2]))
                    )
                amount = part.constant
                if part.place is not None:
                    amount += part.factor * q[part.place]
                if not part.turns:
                    place = [x + amount * d for x, d in zip(place, axes[part.axis], strict=True)]
                    continue
                first, second = (part.axis + 1) % 3, (part.axis + 2) % 3
                c, s = cos(amount), sin(amount)
                x, y = axes[first], axes[second]
                axes[first] = [c * a + s * b for a, b in zip(x, y, strict=True)]
                axes[second] = [c * b - s * a for a, b in zip(x, y, strict=True)]
        return tuple(lines)


def _part(motion: Motion, numbers: Mapping[Symbol, float], places: Mapping[Symbol, int]) -> _Part:
    place, factor, constant = None, 0.0, motion.amount
    for symbol in motion.amount.free_symbols & set(places):
        slope = motion.amount.diff(symbol)
        place, factor = places[symbol], float(slope)
        constant = constant - slope * symbol
    turns = motion.kind is MotionKind.ROTATION
    return _Part(turns, int(motion.axis), place, factor, float(constant.xreplace(dict(numbers))))


def are_parallel(a: Line, b: Line) -> bool:
    """Say whether two axes are parallel."""
    return length(cross(a.direction, b.direction)) < 1e-9


def meet(a: Line, b: Line) -> bool:
    """Say whether two axes that are not parallel intersect."""
    normal = cross(a.direction, b.direction)
    between = span(a.point, b.point)
    scale = length(a.point) + length(b.point)
    return not are_parallel(a, b) and abs(dot(normal, between)) <= 1e-9 * scale


def meet_in_one_point(a: Line, b: Line, c: Line) -> bool:
    """Say whether three axes pass through one point."""
    if not (meet(a, b) and meet(b, c)):
        return False
    p, q = crossing(a, b), crossing(b, c)
    scale = length(p) + sum(length(line.point) for line in (a, b, c))
    return length(span(p, q)) <= 1e-9 * scale


def crossing(a: Line, b: Line) -> Vector:
    """Return the point of `a` that is nearest to `b`."""
    normal = cross(a.direction, b.direction)
    between = span(a.point, b.point)
    along = dot(cross(between, b.direction), normal) / dot(normal, normal)
    x, y, z = (p + along * d for p, d in zip(a.point, a.direction, strict=True))
    return x, y, z


def span(a: Vector, b: Vector) -> Vector:
    """Return the vector from one point to another."""
    return (b[0] - a[0], b[1] - a[1], b[2] - a[2])


def across(vector: Vector, axis: Vector) -> Vector:
    """Return a vector without its component along an axis."""
    along = dot(vector, axis) / dot(axis, axis)
    x, y, z = (part - along * d for part, d in zip(vector, axis, strict=True))
    return x, y, z


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def length(a: Vector) -> float:
    """Return the length of a vector."""
    return sqrt(dot(a, a))
