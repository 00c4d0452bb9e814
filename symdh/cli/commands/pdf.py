"""``symdh pdf``: the handout, typeset."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symdh.cli import files, options, tables
from symdh.errors import OutputError, UnsupportedError

if TYPE_CHECKING:
    from symdh.derivation.blocks import Document


@click.command(
    epilog=options.examples(
        "symdh pdf scara.yaml",
        "symdh pdf scara.yaml -o sheet.pdf --paper letter",
        "symdh pdf scara.yaml --sheet problem",
    )
)
@options.table_argument
@options.file_option("NAME.pdf")
@click.option(
    "--engine",
    type=click.Choice(["auto", "latexmk", "pdflatex", "lualatex", "typst"]),
    default="auto",
    show_default=True,
    help="What typesets; auto: TeX where it is installed, else the package typst.",
)
@options.time_limit_option(60.0, "Stop typesetting after this time.")
@options.document_options
@options.sheet_options
@options.preamble_option
@options.templates_option
@options.force_option
def pdf(
    table: str,
    output: str | None,
    engine: str,
    time_limit: float,
    order: str,
    notation: str,
    paper: str,
    sheet: str | None,
    points: bool,
    ask_table: bool,
    preamble: str | None,
    force: bool,
) -> None:
    """Typeset the derivation as a PDF.

    With TeX where it is installed, else with the package typst: pip install 'symdh[pdf]'.
    """
    from symdh.render.pdf import TYPST, compile_pdf, compile_typst, find_engine

    robot = tables.read_robot(table)
    own = tables.read_preamble(preamble)
    if engine == "auto":
        engine = find_engine()
    if engine == TYPST and preamble is not None:
        raise UnsupportedError("--preamble is LaTeX, and the PDF would be made by typst")
    document = tables.derived(robot, order, notation, tables.Homework(sheet, points, ask_table))
    stem = tables.stem(robot, tables.Homework(sheet))
    output = output or f"{stem}.pdf"
    source, suffix = _source(document, engine, paper, own)
    try:
        if engine == TYPST:
            content = compile_typst(source, time_limit=time_limit)
        else:
            content = compile_pdf(source, engine=engine, time_limit=time_limit)
    except OutputError as error:
        kept = (stem if output == "-" else output.removesuffix(".pdf")) + suffix
        files.save(kept, source.encode(), force=force)
        language = "Typst" if engine == TYPST else "LaTeX"
        raise OutputError(f"{error}; the {language} is kept in {kept}") from error
    files.save(output, content, force=force)


def _source(document: Document, engine: str, paper: str, preamble: str) -> tuple[str, str]:
    """Return the document in the language of an engine, and the suffix of its files."""
    from symdh.render.pdf import TYPST

    if engine == TYPST:
        from symdh.render.typst import render_typst

        return render_typst(document, paper), ".typ"
    from symdh.render.latex import render_latex

    return render_latex(document, paper=paper, preamble=preamble), ".tex"
