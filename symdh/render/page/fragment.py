"""Documents and tables as HTML inside somebody else's page, such as a notebook's.

Formulas stand in dollars, as MathJax reads them; there is no script and no style but that of the
drawing.
"""

from __future__ import annotations

from markupsafe import Markup

from symdh.derivation import table
from symdh.derivation.blocks import Chapter, Document
from symdh.derivation.derive import subtitle
from symdh.derivation.style import Style
from symdh.render.latex_math import LatexWriter
from symdh.render.page.page import page_layout
from symdh.robot import Robot
from symdh.templating import render


class _ForMathJax(LatexWriter):
    """Spells text in formulas as MathJax takes it: it shows a command there as it is written."""

    def remark(self, text: str) -> str:
        """Return a short text beside a formula."""
        return rf"\text{{{text}}}"


def document_fragment(document: Document) -> str:
    """Write a document as one ``div`` with all its chapters."""
    layout = page_layout(_ForMathJax())
    return render(
        "html/fragment.html.jinja",
        title=document.title,
        subtitle=Markup(layout.inline(document.subtitle)),
        preface=[item for block in document.preface for item in layout.items(block)],
        chapters=[
            (chapter.title, [item for block in chapter.blocks for item in layout.items(block)])
            for chapter in document.chapters
        ],
    )


def chapter_fragment(chapter: Chapter) -> str:
    """Write one chapter as a ``div``, with its heading."""
    return document_fragment(Document(title="", subtitle=(), chapters=(chapter,)))


def table_fragment(robot: Robot) -> str:
    """Write the table of a robot as one ``div``, with its title and convention."""
    layout = page_layout(_ForMathJax())
    return render(
        "html/fragment.html.jinja",
        title=robot.title or robot.name,
        subtitle=Markup(layout.inline(subtitle(robot))),
        preface=layout.items(table.parameters(Style(robot))),
        chapters=[],
    )
