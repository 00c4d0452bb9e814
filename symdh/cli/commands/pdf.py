"""``symdh pdf``: the handout, typeset."""

from __future__ import annotations

import click

from symdh.cli import files, options, tables
from symdh.errors import OutputError


@click.command(
    epilog=options.examples(
        "symdh pdf scara.yaml", "symdh pdf scara.yaml -o sheet.pdf --paper letter"
    )
)
@options.table_argument
@options.file_option("NAME.pdf")
@click.option(
    "--engine",
    type=click.Choice(["latexmk", "pdflatex"]),
    help="Program to run. Default: the one that is there.",
)
@click.option(
    "--time-limit",
    type=click.FloatRange(min=0, min_open=True),
    default=60.0,
    show_default=True,
    metavar="SECONDS",
    help="Stop typesetting after this time.",
)
@options.document_options
@options.preamble_option
@options.force_option
def pdf(
    table: str,
    output: str | None,
    engine: str | None,
    time_limit: float,
    order: str,
    notation: str,
    paper: str,
    preamble: str | None,
    force: bool,
) -> None:
    """Typeset the derivation as a PDF."""
    from symdh.codegen.names import file_stem
    from symdh.render.latex import render_latex
    from symdh.render.pdf import compile_pdf

    robot = tables.read_robot(table)
    own = tables.read_preamble(preamble)
    document = tables.derived(robot, order, notation)
    tex = render_latex(document, paper=paper, preamble=own)
    stem = file_stem(robot.name)
    output = output or f"{stem}.pdf"
    try:
        content = compile_pdf(tex, engine=engine, time_limit=time_limit)
    except OutputError as error:
        kept = (
            f"{file_stem(robot.name)}.tex"
            if output == "-"
            else f"{output.removesuffix('.pdf')}.tex"
        )
        files.save(kept, tex.encode(), force=force)
        raise OutputError(f"{error}; the LaTeX is kept in {kept}") from error
    files.save(output, content, force=force)
