"""Drawing -> SVG that reads in light and dark and needs nothing beside it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from markupsafe import Markup, escape

from symdh._version import __version__
from symdh.derivation.drawing import plane
from symdh.derivation.drawing.shapes import (
    Drawing,
    Ellipse,
    Label,
    Line,
    Point,
    Polygon,
    Shape,
)
from symdh.derivation.text import Inline
from symdh.notation.names import GREEK, split_name
from symdh.notation.nodes import Generic, Name
from symdh.render.drawing.text import figure, plain
from symdh.templating import asset, render

_HEAD_LENGTH, _HEAD_WIDTH = 5.6, 2.0
_DROP = 2.6  # of an index below its letter
_BASELINE = 3.2  # of a letter below the middle of its label


def render_svg(drawing: Drawing) -> str:
    """Write a drawing as SVG.

    Returns
    -------
    str
        One ``svg`` element with its title, description and style; it may stand in a web page.
    """
    writer = _Writer(drawing.height)
    return render(
        "drawing/arm.svg.jinja",
        width=figure(drawing.width),
        height=figure(drawing.height),
        title=drawing.title,
        description=plain(drawing.caption),
        style=Markup(asset("drawing/arm.css")),
        shapes=[Markup(line) for shape in drawing.shapes for line in writer.elements(shape)],
        version=__version__,
    )


class _Writer:
    """Writes shapes; y runs down in SVG."""

    def __init__(self, height: float) -> None:
        self._height = height

    def elements(self, shape: Shape) -> Iterator[str]:
        name = shape.pen.value
        match shape:
            case Line():
                yield from self._line(shape)
            case Polygon(points=points, outlined=outlined):
                bare = "" if outlined else " bare"
                yield f'<polygon class="{name}{bare}" points="{self._points(points)}"/>'
            case Ellipse(centre=centre, first=first, second=second, angle=angle):
                x, y = self._place(centre)
                turn = f' transform="rotate({figure(-angle)} {x} {y})"' if angle else ""
                size = f'rx="{figure(first)}" ry="{figure(second)}"'
                yield f'<ellipse class="{name}" cx="{x}" cy="{y}" {size}{turn}/>'
            case Label(text=text, centre=centre):
                x, y = self._place((centre[0], centre[1] - _BASELINE))
                parts = "".join(_inline(part) for part in text)
                yield f'<text class="{name}" x="{x}" y="{y}">{parts}</text>'

    def _line(self, line: Line) -> Iterator[str]:
        name, points = line.pen.value, list(line.points)
        heads = []
        if line.head:
            heads.append(self._head(points[-1], points[-2]))
            points[-1] = _short_of(points[-1], points[-2])
        if line.tail:
            heads.append(self._head(line.points[0], line.points[1]))
            points[0] = _short_of(line.points[0], line.points[1])
        yield f'<polyline class="{name}" points="{self._points(points)}"/>'
        yield from (f'<polygon class="head {name}" points="{head}"/>' for head in heads)

    def _head(self, tip: Point, before: Point) -> str:
        back = plane.direction((tip, before))
        foot = plane.onward(tip, _HEAD_LENGTH, back)
        side = plane.left_of(back)
        sides = (plane.onward(foot, w, side) for w in (_HEAD_WIDTH, -_HEAD_WIDTH))
        return self._points((tip, *sides))

    def _points(self, points: Sequence[Point]) -> str:
        return " ".join(",".join(self._place(point)) for point in points)

    def _place(self, point: Point) -> tuple[str, str]:
        return figure(point[0]), figure(self._height - point[1])


def _short_of(tip: Point, before: Point) -> Point:
    """Return where a stroke ends so that it does not blunt its arrow."""
    return plane.onward(tip, 0.8 * _HEAD_LENGTH, plane.direction((tip, before)))


def _inline(part: Inline) -> str:
    """Return a symbol with its index lowered; anything else as plain text."""
    match part:
        case Name(text=text):
            letter, index = split_name(text)
        case Generic(letter=letter, index=index):
            pass
        case _:
            return str(escape(plain((part,))))
    shown = f'<tspan class="letter">{escape(GREEK.get(letter, letter))}</tspan>'
    if not index:
        return shown
    # An empty character carries the line back up: the next part may be another symbol.
    lowered = f'<tspan class="index" dy="{_DROP}">{escape(index)}</tspan>'
    return f'{shown}{lowered}<tspan dy="-{_DROP}">\u200b</tspan>'
