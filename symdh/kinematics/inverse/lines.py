"""Joint axes as lines in space, in floating point: which of them are parallel, which meet."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin, sqrt

from symdh.kinematics.chain import link_word
from symdh.robot import Axis, Convention, JointType, MotionKind, Robot

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
    drawn = random.Random(3)
    numbers = {s: float(v) for s, v in robot.values.items() if s in robot.parameters}
    for symbol in robot.parameters:
        numbers.setdefault(symbol, drawn.uniform(0.4, 1.6))
    numbers |= dict(zip(robot.variables, q, strict=True))
    axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    place = [0.0, 0.0, 0.0]
    lines = []
    for i, joint in enumerate(robot.joints, start=1):
        word = link_word(robot, i)
        # The z axis that the joint turns about stands before its own rotation.
        skip = 0 if robot.convention is Convention.STANDARD else 2
        for k, motion in enumerate(word):
            if k == skip and joint.variable is not None:
                point, z = place, axes[Axis.Z]
                lines.append(
                    Line(i, joint.type, (point[0], point[1], point[2]), (z[0], z[1], z[2]))
                )
            amount = float(motion.amount.xreplace(numbers))
            if motion.kind is MotionKind.TRANSLATION:
                place = [x + amount * d for x, d in zip(place, axes[motion.axis], strict=True)]
                continue
            first, second = (motion.axis + 1) % 3, (motion.axis + 2) % 3
            c, s = cos(amount), sin(amount)
            x, y = axes[first], axes[second]
            axes[first] = [c * a + s * b for a, b in zip(x, y, strict=True)]
            axes[second] = [c * b - s * a for a, b in zip(x, y, strict=True)]
    return tuple(lines)


def are_parallel(a: Line, b: Line) -> bool:
    """Say whether two axes are parallel."""
    return _length(_cross(a.direction, b.direction)) < 1e-9


def meet(a: Line, b: Line) -> bool:
    """Say whether two axes that are not parallel intersect."""
    normal = _cross(a.direction, b.direction)
    between = (b.point[0] - a.point[0], b.point[1] - a.point[1], b.point[2] - a.point[2])
    scale = 1 + _length(between)
    return not are_parallel(a, b) and abs(_dot(normal, between)) < 1e-9 * scale


def meet_in_one_point(a: Line, b: Line, c: Line) -> bool:
    """Say whether three axes pass through one point."""
    if not (meet(a, b) and meet(b, c)):
        return False
    p, q = crossing(a, b), crossing(b, c)
    return _length((p[0] - q[0], p[1] - q[1], p[2] - q[2])) < 1e-9 * (1 + _length(p))


def crossing(a: Line, b: Line) -> Vector:
    """Return the point of `a` that is nearest to `b`."""
    normal = _cross(a.direction, b.direction)
    between = (b.point[0] - a.point[0], b.point[1] - a.point[1], b.point[2] - a.point[2])
    along = _dot(_cross(between, b.direction), normal) / _dot(normal, normal)
    x, y, z = (p + along * d for p, d in zip(a.point, a.direction, strict=True))
    return x, y, z


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _dot(a: Vector, b: Vector) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _length(a: Vector) -> float:
    return sqrt(_dot(a, a))
