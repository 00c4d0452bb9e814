"""Document -> LaTeX. What fits where is decided here; the templates only lay it out."""

from __future__ import annotations

from symdh._version import __version__
from symdh.derivation.blocks import (
    Chapter,
    Document,
    Figure,
)
from symdh.derivation.style import Naming, Style
from symdh.kinematics.forward import transform
from symdh.kinematics.frame import Frame
from symdh.notation.nodes import Equation
from symdh.render.latex_math import LatexWriter
from symdh.render.latex_text import latex_text
from symdh.render.layout import Layout
from symdh.robot import Robot
from symdh.templating import render

PAPERS = {"a4": "a4paper", "letter": "letterpaper"}


def render_latex(
    document: Document, fragment: bool = False, paper: str = "a4", preamble: str = ""
) -> str:
    r"""Write a document as LaTeX.

    Parameters
    ----------
    document : Document
    fragment : bool
        Leave out the preamble, for ``\input`` into a document of one's own.
    paper : str
        ``"a4"`` or ``"letter"``.
    preamble : str
        LaTeX of the user's own, put behind the packages as it is.

    Returns
    -------
    str
        Compiles with pdflatex and the packages amsmath, mathtools, booktabs, geometry, lmodern
        and hyperref, and tikz where there is a drawing.
    """
    layout = _layout()
    return render(
        "latex/fragment.tex.jinja" if fragment else "latex/document.tex.jinja",
        title=latex_text(document.title),
        subtitle=layout.inline(document.subtitle),
        sheet=document.sheet,
        preface=[item for block in document.preface for item in layout.items(block)],
        chapters=[
            (
                latex_text(chapter.title),
                [item for block in chapter.blocks for item in layout.items(block)],
            )
            for chapter in document.chapters
        ],
        paper=PAPERS[paper],
        preamble=preamble.strip(),
        drawn=any(isinstance(block, Figure) for block in document.blocks),
        version=__version__,
    )


def render_chapter(chapter: Chapter) -> str:
    """Write the blocks of one chapter as LaTeX to paste, without its heading."""
    layout = _layout()
    items = [item for block in chapter.blocks for item in layout.items(block)]
    text = render("latex/chapter.tex.jinja", items=items)
    return text.strip() + "\n"


def render_transform(
    robot: Robot, start: Frame, end: Frame, naming: Naming | str = Naming.AUTO
) -> str:
    """Return one exact pose as a LaTeX formula, its name and the matrix.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    LimitError
        When the closed form would be too large.
    """
    style = Style(robot, naming=Naming(naming))
    matrix = style.notation.matrix(transform(robot, start, end))
    return LatexWriter().text(Equation((style.pose_name(start, end), matrix)))


def _layout() -> Layout:
    return Layout(latex_text, lambda formula: f"${formula}$")
