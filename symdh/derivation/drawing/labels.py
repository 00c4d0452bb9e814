"""Where labels go: each has places to choose from, and takes the one that covers least."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from symdh.derivation.drawing import plane
from symdh.derivation.drawing.plane import Stroke
from symdh.derivation.drawing.shapes import Box, Label, Line, Point, Shape
from symdh.derivation.text import Inline, Text
from symdh.notation.names import GREEK, split_name
from symdh.notation.nodes import Generic, Name, Node, leaves

#: Size of a label's characters, a little over what either writer's font takes.
_LETTER, _SMALL, _TEXT, HEIGHT = 6.0, 4.2, 4.6, 11.0
_ROUNDS = 3


@dataclass(frozen=True, slots=True)
class Candidate:
    """One place for a label, with the lines that come with it."""

    label: Label
    price: float
    lines: tuple[Line, ...] = ()


@dataclass(frozen=True, slots=True)
class Obstacles:
    """What labels keep clear of, with what it costs to cover it.

    Attributes
    ----------
    strokes : sequence of (Stroke, float)
        The price is for 10 points of length.
    boxes : sequence of (Box, float)
        The price is for a label that is covered whole.
    """

    strokes: Sequence[tuple[Stroke, float]]
    boxes: Sequence[tuple[Box, float]]


def text_width(text: Text) -> float:
    """Return about how wide a label is."""
    return sum(_width(part) for part in text)


def _width(part: Inline) -> float:
    if isinstance(part, str):
        return _TEXT * len(part) * 0.75
    return sum(_leaf_width(leaf) for leaf in leaves(part))


def _leaf_width(leaf: Node) -> float:
    match leaf:
        case Name(text=text):
            letter, index = split_name(text)
        case Generic(letter=letter, index=index):
            pass
        case _:
            return 3 * _LETTER
    return _LETTER * (1 if letter in GREEK else len(letter)) + _SMALL * len(index)


def centre_beside(anchor: Point, gap: float, direction: Point, width: float) -> Point:
    """Return the centre of a label of some width that stands off a point in a direction."""
    dx, dy = direction
    # How far the box reaches from its centre in that direction: to its side or to its edge.
    reach = min(
        width / 2 / abs(dx) if abs(dx) > 1e-6 else math.inf,
        HEIGHT / 2 / abs(dy) if abs(dy) > 1e-6 else math.inf,
    )
    return plane.onward(anchor, gap + reach, direction)


def box_of(label: Label, margin: float = 0.0) -> Box:
    """Return the corners of a label's box, lower left and upper right."""
    (x, y), w, h = label.centre, label.width / 2 + margin, label.height / 2 + margin
    return x - w, y - h, x + w, y + h


def place(wishes: Sequence[Sequence[Candidate]], obstacles: Obstacles) -> list[Candidate]:
    """Choose a place for each label; the first ones have the first choice, then all once more."""
    alone = [[each.price + _covered(each, obstacles) for each in wish] for wish in wishes]
    chosen: list[Candidate | None] = [None] * len(wishes)
    for _ in range(_ROUNDS):
        for k, wish in enumerate(wishes):
            others = [each for i, each in enumerate(chosen) if each is not None and i != k]
            chosen[k] = _cheapest(wish, alone[k], others)
    return [each for each in chosen if each is not None]


def _cheapest(
    wish: Sequence[Candidate], alone: Sequence[float], others: Sequence[Candidate]
) -> Candidate:
    """Return the candidate that costs least; none is looked at that alone costs more already."""
    best, least = wish[0], math.inf
    for price, candidate in sorted(zip(alone, wish, strict=True), key=lambda pair: pair[0]):
        if price >= least:
            break
        cost = round(price + sum(_clash(candidate, other) for other in others), 6)
        if cost < least:
            best, least = candidate, cost
    return best


def _covered(candidate: Candidate, obstacles: Obstacles) -> float:
    """Return what a label with its lines covers of the drawing."""
    box = box_of(candidate.label, 1.0)
    cost = sum(price * inside(stroke, box) / 10 for stroke, price in obstacles.strokes)
    cost += sum(price * overlap(box, other) for other, price in obstacles.boxes)
    for stroke in strokes(candidate.lines):
        cost += sum(0.12 * price * inside(stroke, other) for other, price in obstacles.boxes)
        cost += 0.25 * sum(
            price for other, price in obstacles.strokes if plane.crossing(stroke, other)
        )
    return cost


def _clash(a: Candidate, b: Candidate) -> float:
    """Return how much two labels with their lines are in each other's way."""
    box, other = box_of(a.label, 1.0), box_of(b.label, 1.0)
    cost = 12 * overlap(box, other)
    cost += sum(_struck(stroke, box) for stroke in strokes(b.lines))
    cost += sum(_struck(stroke, other) for stroke in strokes(a.lines))
    if a.lines and b.lines:
        cost += 0.5 * sum(
            plane.apart(p, q) < 2.5 for p in strokes(a.lines) for q in strokes(b.lines)
        )
    return cost


def _struck(stroke: Stroke, box: Box) -> float:
    length = inside(stroke, box)
    return 0.4 + 0.08 * length if length else 0.0


def strokes(shapes: Iterable[Shape]) -> list[Stroke]:
    """Return the straight strokes of lines."""
    return [
        (a, b)
        for shape in shapes
        if isinstance(shape, Line)
        for a, b in zip(shape.points, shape.points[1:], strict=False)
    ]


def overlap(a: Box, b: Box) -> float:
    """Return the part of box `a` that box `b` covers."""
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    if width <= 0 or height <= 0:
        return 0.0
    return width * height / ((a[2] - a[0]) * (a[3] - a[1]))


def inside(stroke: Stroke, box: Box) -> float:
    """Return the length of a stroke inside a box (Liang and Barsky)."""
    (x, y), (u, v) = stroke
    if (
        (x < box[0] and u < box[0])
        or (x > box[2] and u > box[2])
        or (y < box[1] and v < box[1])
        or (y > box[3] and v > box[3])
    ):
        return 0.0
    dx, dy = u - x, v - y
    low, high = 0.0, 1.0
    for start, step, least, most in ((x, dx, box[0], box[2]), (y, dy, box[1], box[3])):
        if abs(step) < 1e-12:  # level or upright, and not beside the box
            continue
        first, second = sorted(((least - start) / step, (most - start) / step))
        low, high = max(low, first), min(high, second)
    return max(0.0, high - low) * math.hypot(dx, dy)
