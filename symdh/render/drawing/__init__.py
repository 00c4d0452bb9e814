"""Drawings as TikZ and as SVG."""

from __future__ import annotations

from collections.abc import Callable

from symdh.derivation.drawing.shapes import Drawing
from symdh.render.drawing.svg import render_svg
from symdh.render.drawing.tikz import tikz_file

#: The formats of a drawing alone in a file, by the ending of its name without the dot.
DRAWING_FORMATS: dict[str, Callable[[Drawing], str]] = {"svg": render_svg, "tex": tikz_file}
