"""Drawing -> TikZ for a handout; nothing beyond the package itself."""

from __future__ import annotations

from collections.abc import Sequence

from symdh._version import __version__
from symdh.derivation.drawing.shapes import Drawing, Ellipse, Label, Line, Point, Polygon, Shape
from symdh.derivation.text import Inline
from symdh.render.drawing.text import figure
from symdh.render.latex_math import LatexWriter
from symdh.render.latex_text import latex_text
from symdh.templating import render

_MATH = LatexWriter()
_ARROWS = {(False, False): "", (True, False): ", ->", (False, True): ", <-", (True, True): ", <->"}


def render_tikz(drawing: Drawing) -> str:
    r"""Write a drawing as a ``tikzpicture``.

    Returns
    -------
    str
        Needs ``\usepackage{tikz}`` where it is put.
    """
    return render(
        "drawing/arm.tex.jinja",
        width=figure(drawing.width),
        height=figure(drawing.height),
        shapes=[_path(shape) for shape in drawing.shapes],
    )


def tikz_file(drawing: Drawing) -> str:
    r"""Write a drawing as a file to ``\input``."""
    head = (
        f"% Written by symdh {__version__}. Generated from a Denavit-Hartenberg table; "
        "edit the table instead.\n"
    )
    return f"{head}% Needs \\usepackage{{tikz}}.\n{render_tikz(drawing)}"


def _path(shape: Shape) -> str:
    style = f"arm {shape.pen.value}"
    match shape:
        case Line(points=points, head=head, tail=tail):
            return rf"\path[{style}{_ARROWS[head, tail]}] {_chain(points)};"
        case Polygon(points=points, outlined=outlined):
            bare = "" if outlined else ", draw=none"
            return rf"\path[{style}{bare}] {_chain(points)} -- cycle;"
        case Ellipse(centre=centre, first=first, second=second, angle=angle):
            place = _place(centre)
            turn = f", rotate around={{{figure(angle)}:{place}}}" if angle else ""
            size = f"x radius={figure(first)}, y radius={figure(second)}"
            return rf"\path[{style}{turn}] {place} ellipse [{size}];"
        case Label(text=text, centre=centre):
            parts = "".join(_inline(part) for part in text)
            return rf"\node[{style} label] at {_place(centre)} {{{parts}}};"


def _inline(part: Inline) -> str:
    return latex_text(part) if isinstance(part, str) else f"${_MATH.text(part)}$"


def _chain(points: Sequence[Point]) -> str:
    return " -- ".join(_place(point) for point in points)


def _place(point: Point) -> str:
    return f"({figure(point[0])},{figure(point[1])})"
