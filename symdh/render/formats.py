"""The formats that a whole document can be written in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from symdh.render.latex import render_latex


@dataclass(frozen=True)
class Format:
    """A format of documents.

    Attributes
    ----------
    name : str
    extension : str
        With its dot.
    render : callable
        ``render(document, paper=...)`` returns the text.
    """

    name: str
    extension: str
    render: Callable[..., str]


FORMATS = (Format("latex", ".tex", render_latex),)
