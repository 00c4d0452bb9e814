"""Where the body of each joint goes along its axis, so that no two of them are in one place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from symdh.derivation.drawing import space
from symdh.derivation.drawing.skeleton import JointPlace
from symdh.derivation.drawing.solids import Body
from symdh.derivation.drawing.view import View

#: Space between two bodies, as a part of their size.
_APART = 0.3
_ROUNDS = 4
#: Half the height of a body, for each point of its radius.
_SLENDER = 1.25


@dataclass(frozen=True, slots=True)
class _Place:
    """One place for a body: how far along the axis, and what it costs."""

    offset: float
    price: float


def joint_bodies(joints: Sequence[JointPlace], view: View, radius: float) -> list[Body]:
    """Return the bodies of joints.

    A body may sit anywhere on its axis: in the middle of its stretch d where that is long enough,
    else at the point where the joint is, else beside it.

    Parameters
    ----------
    joints : sequence of JointPlace
    view : View
    radius : float
        Of a cylinder, in points.
    """
    half = _SLENDER * radius
    places = [_places(joint, k, len(joints), view, radius) for k, joint in enumerate(joints)]
    chosen = [_body(joint, own[0], radius, half) for joint, own in zip(joints, places, strict=True)]
    if view.flat:
        return chosen
    # From both ends inwards: of two joints at one point the outer one gives way.
    order = sorted(range(len(joints)), key=lambda k: (-abs(2 * k - len(joints) + 1), -k))
    for _ in range(_ROUNDS):
        for k in order:
            joint = joints[k]
            others = chosen[:k] + chosen[k + 1 :]
            bodies = [(_body(joint, each, radius, half), each.price) for each in places[k]]
            costs = [round(_cost(view, body, others) + price, 6) for body, price in bodies]
            chosen[k] = bodies[costs.index(min(costs))][0]
    return chosen


def _places(joint: JointPlace, number: int, count: int, view: View, radius: float) -> list[_Place]:
    half = _SLENDER * radius
    # A step that clears another body on paper too, where the axis is seen at an angle.
    step = (radius + half + _APART * radius) / max(math.hypot(*view.point(joint.axis)), 0.5)
    # Joints near the hand move outwards along their axes, those near the base back.
    way = 1.0 if 2 * number + 1 > count else -1.0
    if abs(joint.d) > 2.6 * half:
        parts = ((0.6, 0.0), (0.5, 0.1), (0.4, 0.3), (0.7, 0.3), (0.25, 0.7), (0.8, 0.7))
        return [_Place(part * joint.d, price) for part, price in (*parts, (0.0, 1.2))]
    if joint.d:
        beyond = math.copysign(half + radius, joint.d)
        return [
            _Place(0.5 * joint.d, 0.0),
            _Place(-beyond, 0.8),
            _Place(joint.d + beyond, 0.8),
        ]
    return [
        _Place(0.0, 0.0),
        _Place(way * step, 0.6),
        _Place(-way * step, 0.8),
        _Place(2 * way * step, 1.6),
        _Place(-2 * way * step, 1.8),
    ]


def _body(joint: JointPlace, place: _Place, radius: float, half: float) -> Body:
    centre = space.along(joint.point, place.offset, joint.axis)
    return Body(joint.row, joint.type, centre, joint.axis, joint.across, radius, half)


def _cost(view: View, body: Body, others: Sequence[Body]) -> float:
    return sum(_overlap(view, body, other) for other in others)


def _overlap(view: View, a: Body, b: Body) -> float:
    """Return how much two bodies are in each other's way, in space and on paper."""
    reach = a.radius + b.half + _APART * a.radius
    in_space = max(0.0, 1 - space.distance(a.centre, b.centre) / reach)
    on_paper = max(0.0, 1 - math.dist(view.point(a.centre), view.point(b.centre)) / reach)
    return 6.0 * in_space + 2.0 * on_paper


def stub(joint: JointPlace, body: Body) -> tuple[space.Vector, space.Vector] | None:
    """Return the stroke from a body to the stretch that it stands away from, if it does."""
    offset = space.dot(space.subtract(body.centre, joint.point), joint.axis)
    low, high = sorted((0.0, joint.d))
    if low - 1e-9 <= offset <= high + 1e-9:
        return None
    nearest = low if offset < low else high
    return space.along(joint.point, nearest, joint.axis), body.centre
