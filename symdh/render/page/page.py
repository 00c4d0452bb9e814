"""Document and robot -> one web page that works offline: formulas, contents, the arm to move."""

from __future__ import annotations

from markupsafe import Markup, escape

from symdh._version import __version__
from symdh.derivation.blocks import Document
from symdh.kinematics.frame import first_frame, last_frame
from symdh.render.drawing.svg import render_svg
from symdh.render.latex_math import LatexWriter
from symdh.render.layout import Layout
from symdh.render.page.arm import arm_script
from symdh.render.page.katex import katex_script, katex_style
from symdh.robot import Robot
from symdh.templating import asset, render


def render_page(document: Document, robot: Robot) -> str:
    """Write a document with its robot as a web page.

    Returns
    -------
    str
        HTML with script, style and fonts inside; it requests nothing.
    """
    layout = page_layout()
    return render(
        "html/page.html.jinja",
        title=document.title,
        subtitle=Markup(layout.inline(document.subtitle)),
        sheet=document.sheet,
        preface=[item for block in document.preface for item in layout.items(block)],
        chapters=[
            (chapter.title, [item for block in chapter.blocks for item in layout.items(block)])
            for chapter in document.chapters
        ],
        pose_name=f"pose of frame {last_frame(robot)} in frame {first_frame(robot)}",
        version=__version__,
        katex_style=Markup(katex_style()),
        katex_script=Markup(katex_script()),
        style=Markup(asset("html/page.css")),
        typeset_script=Markup(asset("html/typeset.js")),
        arm=Markup(arm_script(robot)),
        view_script=Markup(asset("html/view.js")),
    )


def page_layout(math: LatexWriter | None = None) -> Layout:
    """Return the layout of whatever is HTML; `math` spells its formulas."""
    return Layout(lambda text: str(escape(text)), _inline_formula, math, picture=render_svg)


def _inline_formula(formula: str) -> str:
    return f'<span class="formula" data-tex="{escape(formula)}">${escape(formula)}$</span>'
