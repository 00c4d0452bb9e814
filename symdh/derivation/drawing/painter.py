"""What is nearer covers what is farther: the links and the joints in the order of painting."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from symdh.derivation.drawing import plane, space
from symdh.derivation.drawing.shapes import Line, Pen, Shape
from symdh.derivation.drawing.solids import Body
from symdh.derivation.drawing.space import Vector
from symdh.derivation.drawing.view import View

#: Half the length of the gap in a link behind another one, on either side of it.
_GAP = 5.5


@dataclass(frozen=True, slots=True)
class Bar:
    """A straight piece of a link."""

    start: Vector
    end: Vector


def painted(view: View, bars: Sequence[Bar], bodies: Sequence[Body]) -> list[Shape]:
    """Return bars and bodies as shapes, far ones first; no bar is seen inside a body."""
    pieces = [piece for bar in bars for piece in _outside(bar, bodies)]
    things: list[Bar | Body] = [*pieces, *bodies]
    shapes: list[Shape] = []
    for thing in _far_to_near(view, things):
        if isinstance(thing, Body):
            shapes += thing.shapes(view)
            continue
        shapes += _gaps(view, thing, pieces)
        shapes.append(Line((view.point(thing.start), view.point(thing.end)), Pen.LINK))
    return shapes


def _outside(bar: Bar, bodies: Sequence[Body]) -> list[Bar]:
    """Return the parts of a bar that are in no body."""
    taken = sorted(span for body in bodies if (span := body.within(bar.start, bar.end)))
    free: list[tuple[float, float]] = []
    at = 0.0
    for low, high in taken:
        if low > at + 1e-6:
            free.append((at, low))
        at = max(at, high)
    if at < 1 - 1e-6:
        free.append((at, 1.0))
    step = space.subtract(bar.end, bar.start)
    return [
        Bar(space.along(bar.start, low, step), space.along(bar.start, high, step))
        for low, high in free
    ]


def _far_to_near(view: View, things: Sequence[Bar | Body]) -> list[Bar | Body]:
    """Order things so that none covers what is before it; where that goes round, by depth."""
    behind: list[set[int]] = [set() for _ in things]
    for i in range(len(things)):
        for k in range(i):
            nearer = _nearer(view, things[i], things[k])
            if nearer > 0:
                behind[i].add(k)
            elif nearer < 0:
                behind[k].add(i)
    left = set(range(len(things)))
    order: list[Bar | Body] = []
    while left:
        free = [i for i in sorted(left) if not behind[i] & left] or sorted(left)
        chosen = min(free, key=lambda i: (round(_depth(view, things[i]), 6), i))
        left.remove(chosen)
        order.append(things[chosen])
    return order


def _depth(view: View, thing: Bar | Body) -> float:
    if isinstance(thing, Body):
        return view.depth(thing.centre)
    return (view.depth(thing.start) + view.depth(thing.end)) / 2


def _nearer(view: View, a: Bar | Body, b: Bar | Body) -> float:
    """Return how much nearer `a` is than `b` where they cover each other; 0 where they do not."""
    if isinstance(a, Bar) and isinstance(b, Bar):
        found = plane.crossing(_stroke(view, a), _stroke(view, b))
        return 0.0 if found is None else _at(view, a, found[0]) - _at(view, b, found[1])
    assert isinstance(a, Body)  # bodies stand behind the bars in what is ordered
    centre = view.point(a.centre)
    if isinstance(b, Body):
        close = math.dist(centre, view.point(b.centre)) < a.size + b.size
        return view.depth(a.centre) - view.depth(b.centre) if close else 0.0
    stroke = _stroke(view, b)
    part = plane.nearest(centre, stroke)
    if math.dist(centre, plane.between(stroke, part)) > a.size:
        return 0.0
    # A bar that leaves the body begins at its surface: what counts is how it goes on.
    reach = min(1.0, a.size / max(math.dist(*stroke), 1e-6))
    part = part + reach if part < 0.5 else part - reach
    return view.depth(a.centre) - _at(view, b, min(max(part, 0.0), 1.0))


def _stroke(view: View, bar: Bar) -> plane.Stroke:
    return view.point(bar.start), view.point(bar.end)


def _at(view: View, bar: Bar, part: float) -> float:
    step = space.subtract(bar.end, bar.start)
    return view.depth(space.along(bar.start, part, step))


def _gaps(view: View, bar: Bar, others: Sequence[Bar]) -> list[Shape]:
    """Return gaps around a bar where it passes in front of others."""
    stroke = _stroke(view, bar)
    along = plane.direction(stroke)
    gaps: list[Shape] = []
    for other in others:
        found = plane.crossing(stroke, _stroke(view, other))
        if found is None or not (0.02 < found[0] < 0.98 and 0.02 < found[1] < 0.98):
            continue
        if _at(view, bar, found[0]) <= _at(view, other, found[1]) + 1e-6:
            continue
        middle = plane.between(stroke, found[0])
        ends = tuple(plane.onward(middle, side * _GAP, along) for side in (-1, 1))
        gaps.append(Line(ends, Pen.GAP))
    return gaps
