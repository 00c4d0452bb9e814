"""A position in which no part of the arm hides another, for joints without a value.

Joint by joint the angles that leave the picture clearest are kept (a beam search): what a joint
does shows only in the links behind it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from sympy import Symbol

from symdh.derivation.drawing import plane, space
from symdh.derivation.drawing.plane import Stroke
from symdh.derivation.drawing.skeleton import Chain, Stretch
from symdh.derivation.drawing.space import WORLD, Placement, Vector
from symdh.derivation.drawing.view import View
from symdh.robot import JointType

_BEAM = 12
#: Angles in degrees that are tried, with what they cost. In space right angles keep the axes
#: parallel to those of the paper's three directions; in a plane an arm is bent.
_IN_SPACE = {0: 0.0, 90: 0.12, -90: 0.15, 180: 0.5, 45: 1.0, -45: 1.0}
_IN_A_PLANE = {
    30: 0.0,
    45: 0.02,
    60: 0.1,
    -30: 0.15,
    -45: 0.12,
    -60: 0.15,
    90: 0.35,
    -90: 0.4,
    20: 0.3,
    -20: 0.3,
}
#: Strokes that are nearer to each other than this, in longest lengths, get in each other's way.
_ROOM = 0.4


@dataclass(frozen=True)
class _Part:
    """A stretch on paper."""

    stroke: Stroke
    ends: tuple[Vector, Vector]
    row: int | None


@dataclass(frozen=True)
class _State:
    """An arm that is put into position up to some link."""

    cost: float
    values: tuple[float, ...]
    at: Placement
    parts: tuple[_Part, ...]


def readable_pose(chain: Chain, view: View, given: dict[Symbol, float]) -> dict[Symbol, float]:
    """Return values for the joints that turn: those given, and for the others clear ones.

    Parameters
    ----------
    chain : Chain
    view : View
    given : mapping of Symbol to float
        Radians.
    """
    joints = [j for j in chain.robot.joints if j.type is JointType.REVOLUTE]
    variables = [joint.variable for joint in joints if joint.variable is not None]
    states = [_State(0.0, (), WORLD, ())]
    for index in range(len(chain.links)):
        own = next((d.variable for d in chain.links[index] if d.variable), None)
        grown = [
            state
            for before in states
            for state in _grown(chain, view, index, before, variables, own, given)
        ]
        # The number in the list breaks a tie, and rounding keeps it the same on every machine.
        ranked = sorted(enumerate(grown), key=lambda pair: (round(pair[1].cost, 6), pair[0]))
        states = [state for _, state in ranked[:_BEAM]]
    return dict(zip(variables, states[0].values, strict=True))


def _grown(
    chain: Chain,
    view: View,
    index: int,
    before: _State,
    variables: Sequence[Symbol],
    own: Symbol | None,
    given: dict[Symbol, float],
) -> Iterator[_State]:
    """Yield what one more link makes of a state, for each angle of its joint."""
    for value, price in _choices(view, own, given, chain):
        values = before.values if own is None else (*before.values, value)
        known = dict(zip(variables, values, strict=False))
        stretches, _, at = chain.link(index, before.at, known)
        parts = tuple(_part(view, stretch) for stretch in stretches)
        cost = before.cost + price
        cost += sum(_cost(view, part, before.parts + parts[:k]) for k, part in enumerate(parts))
        cost += _foreshortening(view, at.axes[2]) if not view.flat else 0.0
        yield _State(cost, values, at, before.parts + parts)


def _choices(
    view: View, own: Symbol | None, given: dict[Symbol, float], chain: Chain
) -> list[tuple[float, float]]:
    if own is None:
        return [(0.0, 0.0)]
    if own in given:
        return [(given[own], 0.0)]
    angles = _IN_A_PLANE if view.flat else _IN_SPACE
    choices = [(math.radians(angle), price) for angle, price in angles.items()]
    if own in chain.robot.limits:
        limits = chain.robot.limits[own]
        low, high = float(limits.lower.evalf()), float(limits.upper.evalf())
        inside = [(angle, price) for angle, price in choices if low <= angle <= high]
        return inside or [((low + high) / 2, 0.0)]
    return choices


def _part(view: View, stretch: Stretch) -> _Part:
    ends = (stretch.start, stretch.end)
    return _Part((view.point(ends[0]), view.point(ends[1])), ends, stretch.row)


def _cost(view: View, part: _Part, others: Sequence[_Part]) -> float:
    """Return what a stretch spoils beside those that are there."""
    low = min(end[2] for end in part.ends)
    cost = 3.0 * min(-low, 1.0) if low < -0.01 and not view.flat else 0.0
    way = space.unit(space.subtract(part.ends[1], part.ends[0]))
    cost += _foreshortening(view, way)
    # An arm is expected to reach up and to the right.
    right, up = view.point(way)
    cost += 0.3 * max(0.0, -right) + 0.2 * max(0.0, -up)
    return cost + sum(_clash(part, other) for other in others)


def _foreshortening(view: View, direction: Vector) -> float:
    size = math.hypot(*view.point(direction)) / space.length(direction)
    return 5.0 * max(0.0, 0.45 - size) + 0.9 * (1 - size)


def _clash(a: _Part, b: _Part) -> float:
    joint = next(
        ((p, q) for p in (0, 1) for q in (0, 1) if math.dist(a.ends[p], b.ends[q]) < 1e-6), None
    )
    if joint is None:
        return 2.5 * max(0.0, 1 - plane.apart(a.stroke, b.stroke) / _ROOM)
    p, q = joint
    away = plane.direction((a.stroke[p], a.stroke[1 - p]))
    other = plane.direction((b.stroke[q], b.stroke[1 - q]))
    cosine = away[0] * other[0] + away[1] * other[1]
    # Two stretches that leave a point the same way lie on each other; in line they look like one.
    return 4.0 * max(0.0, cosine - 0.6) + (0.7 if cosine < -0.98 else 0.0)
