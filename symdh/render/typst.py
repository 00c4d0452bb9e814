"""Document -> Typst, for a PDF where there is no TeX; the shape is that of the LaTeX handout."""

from __future__ import annotations

from symdh._version import __version__
from symdh.derivation.blocks import Document
from symdh.render.drawing.typst import typst_picture
from symdh.render.layout import Layout
from symdh.render.typst_math import TypstWriter
from symdh.render.typst_text import typst_text
from symdh.templating import render

#: Typst's name of the paper, and the margin that leaves 160 mm for the text.
PAPERS = {"a4": ("a4", "25mm"), "letter": ("us-letter", "27.95mm")}


def render_typst(document: Document, paper: str = "a4") -> str:
    """Write a document in Typst.

    Parameters
    ----------
    document : Document
    paper : str
        ``"a4"`` or ``"letter"``.

    Returns
    -------
    str
        Compiles with Typst 0.13 or newer and the fonts that are part of it.
    """
    layout = Layout(typst_text, lambda formula: f"${formula}$", TypstWriter(), typst_picture)
    name, margin = PAPERS[paper]
    return render(
        "typst/document.typ.jinja",
        title=typst_text(document.title),
        subtitle=layout.inline(document.subtitle),
        sheet=document.sheet,
        fields=[typst_text(field) for field in document.sheet.fields] if document.sheet else [],
        preface=[item for block in document.preface for item in layout.items(block)],
        chapters=[
            (
                typst_text(chapter.title),
                [item for block in chapter.blocks for item in layout.items(block)],
            )
            for chapter in document.chapters
        ],
        paper=name,
        margin=margin,
        version=__version__,
    )
