"""Drawing -> Typst, which reads SVG itself."""

from __future__ import annotations

from symdh.derivation.drawing.shapes import Drawing
from symdh.render.drawing.svg import render_svg
from symdh.render.drawing.text import figure


def typst_picture(drawing: Drawing) -> str:
    """Write a drawing as an image with its SVG inside."""
    svg = render_svg(drawing).replace("\\", "\\\\").replace('"', '\\"')
    return f'#image(bytes("{svg}"), format: "svg", width: {figure(drawing.width)}pt)'
