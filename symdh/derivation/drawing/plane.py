"""Distances between points and strokes on paper."""

from __future__ import annotations

import math

from symdh.derivation.drawing.shapes import Point

Stroke = tuple[Point, Point]


def minus(a: Point, b: Point) -> Point:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1]


def onward(point: Point, distance: float, direction: Point) -> Point:
    """Return the point that is so far from another one in a direction."""
    return point[0] + distance * direction[0], point[1] + distance * direction[1]


def direction(stroke: Stroke) -> Point:
    """Return the unit vector along a stroke; to the right where it has no length."""
    dx, dy = minus(stroke[1], stroke[0])
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size > 1e-9 else (1.0, 0.0)


def left_of(vector: Point) -> Point:
    """Return a vector turned by a quarter to the left."""
    return -vector[1], vector[0]


def crossing(a: Stroke, b: Stroke) -> tuple[float, float] | None:
    """Return where two strokes cross, as parts of the way along each; None where they do not."""
    (px, py), (ax, ay) = a
    (qx, qy), (bx, by) = b
    if max(px, ax) < min(qx, bx) or max(qx, bx) < min(px, ax):
        return None
    if max(py, ay) < min(qy, by) or max(qy, by) < min(py, ay):
        return None
    rx, ry, sx, sy = ax - px, ay - py, bx - qx, by - qy
    turn = rx * sy - ry * sx
    if abs(turn) < 1e-9:
        return None
    t = ((qx - px) * sy - (qy - py) * sx) / turn
    u = ((qx - px) * ry - (qy - py) * rx) / turn
    return (t, u) if 0 <= t <= 1 and 0 <= u <= 1 else None


def nearest(point: Point, stroke: Stroke) -> float:
    """Return how far along a stroke, 0 to 1, its point nearest to another point is."""
    (dx, dy), (px, py) = minus(stroke[1], stroke[0]), minus(point, stroke[0])
    size = dx * dx + dy * dy
    return min(max((px * dx + py * dy) / size, 0.0), 1.0) if size > 1e-12 else 0.0


def between(stroke: Stroke, part: float) -> Point:
    """Return the point at a part of the way along a stroke."""
    (ax, ay), (bx, by) = stroke
    return ax + part * (bx - ax), ay + part * (by - ay)


def to_stroke(point: Point, stroke: Stroke) -> float:
    """Return the distance of a point from a stroke."""
    return math.dist(point, between(stroke, nearest(point, stroke)))


def apart(a: Stroke, b: Stroke) -> float:
    """Return the distance of two strokes, 0 where they cross."""
    if crossing(a, b) is not None:
        return 0.0
    return min(to_stroke(a[0], b), to_stroke(a[1], b), to_stroke(b[0], a), to_stroke(b[1], a))
