"""The two ends of an arm: the ground that it stands on, and the tool that it carries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symdh.derivation.drawing import space
from symdh.derivation.drawing.painter import Bar
from symdh.derivation.drawing.shapes import Line, Pen, Polygon, Shape
from symdh.derivation.drawing.skeleton import Skeleton
from symdh.derivation.drawing.solids import Body
from symdh.derivation.drawing.space import Vector
from symdh.derivation.drawing.view import View
from symdh.robot import Axis

_PLATE, _HATCHES = 15.0, 6


@dataclass(frozen=True, slots=True)
class End:
    """What stands at one end: its shapes, and the bar that leads to it."""

    shapes: tuple[Shape, ...]
    bar: Bar | None = None


def ground(skeleton: Skeleton, bodies: Sequence[Body], view: View) -> End:
    """Return the ground below the base, with the post between them where one is needed."""
    origin = skeleton.frames[0][1].origin
    body = next((b for b in bodies if space.distance(b.centre, origin) < 2.5 * b.size), None)
    own_base = skeleton.frames[0][0] == "base"
    if body is None or own_base:
        return _ground_at(origin, None, view)
    if view.flat:
        foot = space.along(body.centre, -1.9 * body.radius, view.up)
        return End((*_support(body, foot, view), *_hatch(foot, view)))
    if abs(body.axis[2]) > 0.9:
        way = 1.0 if body.axis[2] > 0 else -1.0
        low = min((origin, body.end(-way)), key=lambda point: round(point[2], 6))
        return _ground_at(low, Bar(low, body.centre), view)
    low = space.along(body.centre, -(body.radius + 10), space.Z)
    return _ground_at(low, Bar(low, body.centre), view)


def _ground_at(point: Vector, bar: Bar | None, view: View) -> End:
    return End(_hatch(point, view) if view.flat else _plate(point, view), bar)


def _plate(centre: Vector, view: View) -> tuple[Shape, ...]:
    """Return a hatched square that lies flat."""

    def corner(p: float, q: float) -> Vector:
        return centre[0] + p * _PLATE, centre[1] + q * _PLATE, centre[2]

    square = tuple(view.point(corner(p, q)) for p, q in ((1, 1), (-1, 1), (-1, -1), (1, -1)))
    hatches = []
    for k in range(1, 2 * _HATCHES):
        s = 2 * k / (2 * _HATCHES) * 2 - 2  # the hatch lies where p + q = s
        low, high = max(-1.0, s - 1), min(1.0, s + 1)
        ends = (corner(low, s - low), corner(high, s - high))
        hatches.append(Line((view.point(ends[0]), view.point(ends[1])), Pen.GUIDE))
    return Polygon(square, Pen.GROUND), *hatches


def _support(body: Body, foot: Vector, view: View) -> tuple[Shape, ...]:
    """Return the triangle that a pin is held by."""
    tip, (x, y) = view.point(body.centre), view.point(foot)
    return (Polygon((tip, (x - 8, y), (x + 8, y)), Pen.BACK),)


def _hatch(foot: Vector, view: View) -> tuple[Shape, ...]:
    """Return a level line with hatches below."""
    x, y = view.point(foot)
    line = Line(((x - _PLATE, y), (x + _PLATE, y)), Pen.GROUND)
    step = 2 * _PLATE / _HATCHES
    hatches = (
        Line(((x - _PLATE + (k + 1) * step, y), (x - _PLATE + k * step, y - step)), Pen.GUIDE)
        for k in range(_HATCHES)
    )
    return line, *hatches


def tool(skeleton: Skeleton, bodies: Sequence[Body], view: View) -> End:
    """Return a gripper at the last frame.

    It reaches along the last stretch where that is along x, as in a planar arm, else along z.
    """
    frame = skeleton.frames[-1][1]
    reach = _approach(skeleton, view)
    sliding = frame.axes[1] if abs(space.dot(reach, frame.axes[1])) < 0.5 else frame.axes[0]
    start = frame.origin
    for body in bodies:
        ahead = space.dot(space.subtract(body.centre, start), reach)
        beside = space.distance(space.along(start, ahead, reach), body.centre)
        if beside < body.radius and -body.half < ahead < 3 * body.size:
            extent = body.half if abs(space.dot(body.axis, reach)) > 0.9 else body.radius
            start = space.along(start, ahead + extent, reach)
    palm = space.along(start, 5.0, reach)
    if view.flat:
        sliding = space.cross(view.toward, reach)
    fingers = []
    for side in (-1.0, 1.0):
        root = space.along(palm, side * 6.0, sliding)
        fingers.append((root, space.along(root, 10.0, reach)))
    (a, b), (c, d) = fingers
    points = tuple(view.point(point) for point in (b, a, c, d))
    return End((Line(points, Pen.TOOL),), Bar(frame.origin, palm))


def _approach(skeleton: Skeleton, view: View) -> Vector:
    frame = skeleton.frames[-1][1]
    last = skeleton.stretches[-1] if skeleton.stretches else None
    at_end = last is not None and space.distance(last.end, frame.origin) < 1e-6
    if last is not None and at_end:
        way = space.unit(space.subtract(last.end, last.start))
        if last.motion.axis is Axis.X and abs(space.dot(way, frame.axes[0])) > 0.9:
            return way
        if abs(space.dot(way, frame.axes[2])) > 0.9:
            return way
    return frame.axes[0] if view.flat else frame.axes[2]
