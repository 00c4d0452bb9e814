"""The formats that a whole document can be written in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from symdh.derivation.blocks import Document
from symdh.render.latex import render_latex
from symdh.render.page.page import render_page
from symdh.robot import Robot


@dataclass(frozen=True)
class Format:
    """A format of documents.

    Attributes
    ----------
    name : str
    extension : str
        With its dot.
    render : callable
        ``render(document, robot, paper)`` returns the text.
    """

    name: str
    extension: str
    render: Callable[[Document, Robot, str], str]


FORMATS = (
    Format("latex", ".tex", lambda document, _, paper: render_latex(document, paper=paper)),
    Format("html", ".html", lambda document, robot, _: render_page(document, robot)),
)
