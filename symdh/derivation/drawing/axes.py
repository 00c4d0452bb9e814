"""The axes of the frames as arrows; frames at one point share those that point the same way."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from symdh.derivation.drawing import plane, space
from symdh.derivation.drawing.labels import HEIGHT, Candidate, centre_beside, text_width
from symdh.derivation.drawing.shapes import Ellipse, Label, Line, Pen, Point, Shape
from symdh.derivation.drawing.space import Placement, Vector
from symdh.derivation.drawing.view import View
from symdh.derivation.text import Text
from symdh.notation.nodes import Generic

_PENS = {"x": Pen.X_AXIS, "y": Pen.Y_AXIS, "z": Pen.Z_AXIS}
#: An arrow shorter than this part of its length points at whoever looks and is drawn as a ring.
_HEAD_ON = 0.2
_SAME_POINT, _SAME_WAY = 1e-3, 1e-6


@dataclass(frozen=True, slots=True)
class Arrow:
    """Axes that coincide.

    Attributes
    ----------
    names : tuple of (str, str)
        Letter and frame of each.
    origin, direction : Vector
    length : float
        In points.
    """

    names: tuple[tuple[str, str], ...]
    origin: Vector
    direction: Vector
    length: float

    @property
    def pen(self) -> Pen:
        """What it is drawn with: that of its letter, or one for arrows of several letters."""
        letters = {letter for letter, _ in self.names}
        return _PENS[letters.pop()] if len(letters) == 1 else Pen.MIXED_AXIS

    @property
    def text(self) -> Text:
        """Its label: ``x_4, z_3``."""
        parts: list[str | Generic] = []
        for letter, frame in self.names:
            parts += [", "] if parts else []
            parts.append(Generic(letter, frame))
        return tuple(parts)

    def shapes(self, view: View) -> Iterator[Shape]:
        """Yield the arrow, or a ring with a dot or a cross where it points to or from the eye."""
        start, tip = self.ends(view)
        if not self.head_on(view):
            yield Line((start, tip), self.pen, head=True)
            return
        yield Ellipse(start, 3.6, 3.6, 0.0, self.pen)
        if view.depth(self.direction) > 0:
            yield Ellipse(start, 0.9, 0.9, 0.0, Pen.ORIGIN)
            return
        for side in (-1.0, 1.0):
            a = plane.onward(start, 2.5, (math.sqrt(0.5), side * math.sqrt(0.5)))
            b = plane.onward(start, -2.5, (math.sqrt(0.5), side * math.sqrt(0.5)))
            yield Line((a, b), self.pen)

    def head_on(self, view: View) -> bool:
        """Say whether it points at whoever looks, or away."""
        return math.hypot(*view.point(self.direction)) < _HEAD_ON

    def ends(self, view: View) -> tuple[Point, Point]:
        """Return its start and its tip on paper."""
        tip = space.along(self.origin, self.length, self.direction)
        return view.point(self.origin), view.point(tip)

    def candidates(self, view: View) -> list[Candidate]:
        """Return places for its label: ahead of the tip, then beside it."""
        start, tip = self.ends(view)
        ring = self.head_on(view)
        ahead = (0.7, 0.7) if ring else plane.direction((start, tip))
        text = self.text
        width = text_width(text)
        found = []
        for degrees in (0, 40, -40, 75, -75, 110, -110, *((150, -150, 180) if ring else ())):
            turn = math.radians(degrees)
            way = (
                ahead[0] * math.cos(turn) - ahead[1] * math.sin(turn),
                ahead[0] * math.sin(turn) + ahead[1] * math.cos(turn),
            )
            for gap, price in ((1.5, 0.0), (6.0, 0.5)):
                anchor = start if ring else tip
                centre = centre_beside(anchor, gap + (4.0 if ring else 0.0), way, width)
                label = Label(text, centre, width, HEIGHT, self.pen)
                found.append(Candidate(label, price + abs(degrees) / 200))
        if not ring:
            middle = plane.between((start, tip), 0.7)
            left = plane.left_of(ahead)
            for way in (left, (-left[0], -left[1])):
                centre = centre_beside(middle, 3.0, way, width)
                found.append(Candidate(Label(text, centre, width, HEIGHT, self.pen), 0.7))
        return found


def arrows(frames: Sequence[tuple[str, Placement]], letters: str, length: float) -> list[Arrow]:
    """Return the axes of frames, those that coincide in one.

    Parameters
    ----------
    frames : sequence of (str, Placement)
    letters : str
        Which axes: ``"xz"``.
    length : float
        Of an arrow, in points.
    """
    found: list[Arrow] = []
    for letter in letters:
        for name, placement in frames:
            axis = placement.axes["xyz".index(letter)]
            match = next((k for k, a in enumerate(found) if _same(a, placement.origin, axis)), None)
            if match is None:
                found.append(Arrow(((letter, name),), placement.origin, axis, length))
            else:
                names = (*found[match].names, (letter, name))
                found[match] = replace(found[match], names=names)
    return found


def _same(arrow: Arrow, origin: Vector, axis: Vector) -> bool:
    near = space.distance(arrow.origin, origin) < _SAME_POINT
    return near and space.dot(arrow.direction, axis) > 1 - _SAME_WAY
