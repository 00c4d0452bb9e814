"""Points and frames in space as plain numbers, for drawing alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

from symdh.robot import MotionKind

Vector = tuple[float, float, float]

ORIGIN: Vector = (0.0, 0.0, 0.0)
X: Vector = (1.0, 0.0, 0.0)
Y: Vector = (0.0, 1.0, 0.0)
Z: Vector = (0.0, 0.0, 1.0)


def along(point: Vector, distance: float, direction: Vector) -> Vector:
    """Return the point that is so far from another one in a direction."""
    return (
        point[0] + distance * direction[0],
        point[1] + distance * direction[1],
        point[2] + distance * direction[2],
    )


def subtract(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def combine(p: float, a: Vector, q: float, b: Vector) -> Vector:
    """Return p a + q b."""
    return p * a[0] + q * b[0], p * a[1] + q * b[1], p * a[2] + q * b[2]


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def length(a: Vector) -> float:
    """Return the length of a vector."""
    return math.hypot(*a)


def distance(a: Vector, b: Vector) -> float:
    """Return the distance of two points."""
    return math.dist(a, b)


def unit(a: Vector) -> Vector:
    """Return a vector of length 1 in the same direction."""
    size = length(a)
    return a[0] / size, a[1] / size, a[2] / size


@dataclass(frozen=True, slots=True)
class Placement:
    """A frame in space: its origin and its three axes."""

    origin: Vector
    axes: tuple[Vector, Vector, Vector]

    def moved(self, kind: MotionKind, axis: int, amount: float) -> Placement:
        """Return the frame that an elementary motion of this one's own axes leads to."""
        if kind is MotionKind.TRANSLATION:
            return Placement(along(self.origin, amount, self.axes[axis]), self.axes)
        first, second = (axis + 1) % 3, (axis + 2) % 3
        c, s = math.cos(amount), math.sin(amount)
        axes = list(self.axes)
        axes[first] = combine(c, self.axes[first], s, self.axes[second])
        axes[second] = combine(c, self.axes[second], -s, self.axes[first])
        return Placement(self.origin, (axes[0], axes[1], axes[2]))


WORLD = Placement(ORIGIN, (X, Y, Z))
