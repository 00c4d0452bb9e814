"""What a drawing is made of: lines, polygons, ellipses and labels in a plane, in points.

x runs to the right and y up, both from the lower left corner. A shape says what it is, its pen,
and never how it looks; a writer decides that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from symdh.derivation.text import Text

Point = tuple[float, float]

#: Lower left and upper right corner.
Box = tuple[float, float, float, float]


class Pen(Enum):
    """What a shape is part of."""

    LINK = "link"
    GAP = "gap"  # the gap in a link that runs behind another one
    BODY = "body"  # a joint
    BACK = "back"  # a face of a joint that is turned away from the light
    GROUND = "ground"
    TOOL = "tool"
    X_AXIS = "x-axis"
    Y_AXIS = "y-axis"
    Z_AXIS = "z-axis"
    MIXED_AXIS = "mixed-axis"  # an x axis of one frame and a z axis of another in one arrow
    ORIGIN = "origin"
    TURN = "turn"  # the angle of a joint
    DIMENSION = "dimension"
    GUIDE = "guide"  # thin lines that lead to a dimension or an angle
    MARK = "mark"
    AXIS_LINE = "axis-line"  # the line that a joint turns about or slides along


@dataclass(frozen=True, slots=True)
class Line:
    """A chain of straight strokes; `head` and `tail` ask for arrows at its end and its start."""

    points: tuple[Point, ...]
    pen: Pen
    head: bool = False
    tail: bool = False


@dataclass(frozen=True, slots=True)
class Polygon:
    """A closed and filled shape; `outlined` strokes its border too."""

    points: tuple[Point, ...]
    pen: Pen
    outlined: bool = True


@dataclass(frozen=True, slots=True)
class Ellipse:
    """A filled ellipse: half axes, and the angle of the first of them in degrees."""

    centre: Point
    first: float
    second: float
    angle: float
    pen: Pen


@dataclass(frozen=True, slots=True)
class Label:
    """A text with formulas, by its centre and the size that is kept free for it."""

    text: Text
    centre: Point
    width: float
    height: float
    pen: Pen


Shape = Line | Polygon | Ellipse | Label


@dataclass(frozen=True, slots=True)
class Drawing:
    """A line drawing.

    Attributes
    ----------
    width, height : float
        In points.
    shapes : tuple of Shape
        Later ones cover earlier ones.
    title : str
        What is drawn, for people who cannot see it.
    caption : Text
        What the drawing does not show: the numbers that it was drawn with.
    """

    width: float
    height: float
    shapes: tuple[Shape, ...]
    title: str
    caption: Text


def moved(shape: Shape, right: float, up: float) -> Shape:
    """Return a shape that is moved."""

    def move(point: Point) -> Point:
        return point[0] + right, point[1] + up

    match shape:
        case Line(points=points) | Polygon(points=points):
            return replace(shape, points=tuple(move(point) for point in points))
        case Ellipse(centre=centre) | Label(centre=centre):
            return replace(shape, centre=move(centre))


def corners(shape: Shape) -> Iterator[Point]:
    """Yield points whose bounding box is that of the shape."""
    match shape:
        case Line(points=points) | Polygon(points=points):
            yield from points
        case Ellipse(centre=(x, y), first=a, second=b, angle=angle):
            c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            right, up = math.hypot(a * c, b * s), math.hypot(a * s, b * c)
            yield from ((x - right, y - up), (x + right, y + up))
        case Label(centre=(x, y), width=width, height=height):
            yield from ((x - width / 2, y - height / 2), (x + width / 2, y + height / 2))


def bounds(points: Sequence[Point]) -> Box:
    """Return the box around points."""
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)
