"""Joints as bodies: a cylinder where one turns, a box where one slides."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from symdh.derivation.drawing import space
from symdh.derivation.drawing.shapes import Ellipse, Line, Pen, Point, Polygon
from symdh.derivation.drawing.space import Vector
from symdh.derivation.drawing.view import View
from symdh.robot import JointType

Interval = tuple[float, float]

#: What a body is drawn with.
Outline = Line | Polygon | Ellipse


@dataclass(frozen=True, slots=True)
class Body:
    """The body of a joint.

    Attributes
    ----------
    row : int
    type : JointType
    centre, axis, across : Vector
        The axis of the joint and a direction at right angles to it.
    radius, half : float
        Of the cylinder, or half the side of the box; half the height.
    """

    row: int
    type: JointType
    centre: Vector
    axis: Vector
    across: Vector
    radius: float
    half: float

    @property
    def size(self) -> float:
        """The radius of the ball around it."""
        return math.hypot(self.radius, self.half)

    def end(self, side: float) -> Vector:
        """Return the middle of the end that the axis points to (1) or comes from (-1)."""
        return space.along(self.centre, side * self.half, self.axis)

    def shapes(self, view: View) -> Iterator[Outline]:
        """Yield what is seen of it."""
        return self._cylinder(view) if self.type is JointType.REVOLUTE else self._box(view)

    def within(self, start: Vector, end: Vector) -> Interval | None:
        """Return the part of a stroke that is inside, as parts of its way; None for none."""
        step, begin = space.subtract(end, start), space.subtract(start, self.centre)
        if self.type is JointType.REVOLUTE:
            slabs = [_slab(begin, step, self.axis, self.half), self._round(begin, step)]
        else:
            third = space.cross(self.axis, self.across)
            slabs = [
                _slab(begin, step, self.axis, self.half),
                _slab(begin, step, self.across, self.radius),
                _slab(begin, step, third, self.radius),
            ]
        low = max(0.0, *(slab[0] for slab in slabs))
        high = min(1.0, *(slab[1] for slab in slabs))
        return (low, high) if high - low > 1e-6 else None

    def _round(self, begin: Vector, step: Vector) -> Interval:
        """Return the part of a line that is within the radius of the axis."""
        flat = space.along(step, -space.dot(step, self.axis), self.axis)
        off = space.along(begin, -space.dot(begin, self.axis), self.axis)
        a, b = space.dot(flat, flat), space.dot(flat, off)
        c = space.dot(off, off) - self.radius**2
        if a < 1e-9:
            return (-math.inf, math.inf) if c < 0 else (math.inf, -math.inf)
        root = b * b - a * c
        if root <= 0:
            return math.inf, -math.inf
        return (-b - math.sqrt(root)) / a, (-b + math.sqrt(root)) / a

    def _cylinder(self, view: View) -> Iterator[Outline]:
        near = 1.0 if view.depth(self.axis) >= 0 else -1.0
        first, second = view.point(self.end(-near)), view.point(self.end(near))
        right, up = view.point(self.axis)
        seen = math.hypot(right, up)
        if seen < 0.02:  # along the axis: a circle
            yield Ellipse(second, self.radius, self.radius, 0.0, Pen.BODY)
            return
        angle = math.degrees(math.atan2(right, -up))
        flat = self.radius * abs(view.depth(self.axis))
        side = (-self.radius * up / seen, self.radius * right / seen)
        yield Ellipse(first, self.radius, flat, angle, Pen.BACK)
        quad = (
            (first[0] + side[0], first[1] + side[1]),
            (second[0] + side[0], second[1] + side[1]),
            (second[0] - side[0], second[1] - side[1]),
            (first[0] - side[0], first[1] - side[1]),
        )
        yield Polygon(quad, Pen.BACK, outlined=False)
        yield Line(quad[:2], Pen.BODY)
        yield Line(quad[2:], Pen.BODY)
        yield Ellipse(second, self.radius, flat, angle, Pen.BODY)

    def _box(self, view: View) -> Iterator[Outline]:
        edges = (
            (self.axis, self.half),
            (self.across, self.radius),
            (space.cross(self.axis, self.across), self.radius),
        )
        for k, (normal, reach) in enumerate(edges):
            facing = view.depth(normal)
            if abs(facing) < 0.02:
                continue
            middle = space.along(self.centre, math.copysign(reach, facing), normal)
            (u, a), (v, b) = edges[(k + 1) % 3], edges[(k + 2) % 3]
            face = tuple(
                view.point(space.along(space.along(middle, p * a, u), q * b, v))
                for p, q in ((1, 1), (-1, 1), (-1, -1), (1, -1))
            )
            yield Polygon(face, Pen.BODY if k == 0 or view.flat else Pen.BACK)


def _slab(begin: Vector, step: Vector, normal: Vector, half: float) -> Interval:
    """Return the part of a line between two parallel planes."""
    offset, speed = space.dot(begin, normal), space.dot(step, normal)
    if abs(speed) < 1e-9:
        return (-math.inf, math.inf) if abs(offset) < half else (math.inf, -math.inf)
    ends = sorted(((-half - offset) / speed, (half - offset) / speed))
    return ends[0], ends[1]


def outline(body: Body, view: View) -> list[Point]:
    """Return points around a body on paper, for what must keep clear of it."""
    return [point for shape in body.shapes(view) for point in _border(shape)]


def _border(shape: Outline) -> list[Point]:
    match shape:
        case Line(points=points) | Polygon(points=points):
            return list(points)
        case Ellipse(centre=(x, y), first=a, second=b, angle=angle):
            c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            turns = [k * math.pi / 4 for k in range(8)]
            return [
                (
                    x + a * math.cos(t) * c - b * math.sin(t) * s,
                    y + a * math.cos(t) * s + b * math.sin(t) * c,
                )
                for t in turns
            ]
