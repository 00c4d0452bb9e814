"""``symdh latex``: the handout as LaTeX."""

from __future__ import annotations

import click

from symdh.cli import files, options, tables


@click.command(
    epilog=options.examples(
        "symdh latex scara.yaml -o scara.tex",
        "symdh latex scara.yaml --fragment -o chapter/scara.tex",
        "symdh latex scara.yaml --sheet problem -o homework3.tex",
    )
)
@options.table_argument
@options.file_option("standard output")
@click.option(
    "--fragment", is_flag=True, help="Leave out the preamble, to \\input into a document of yours."
)
@options.document_options
@options.sheet_options
@options.preamble_option
@options.templates_option
@options.force_option
def latex(
    table: str,
    output: str | None,
    fragment: bool,
    order: str,
    notation: str,
    paper: str,
    sheet: str | None,
    points: bool,
    ask_table: bool,
    preamble: str | None,
    force: bool,
) -> None:
    """Write the derivation, step by step, as LaTeX."""
    from symdh.render.latex import render_latex

    document = tables.derived(
        tables.read_robot(table), order, notation, tables.Homework(sheet, points, ask_table)
    )
    text = render_latex(
        document, fragment=fragment, paper=paper, preamble=tables.read_preamble(preamble)
    )
    files.save(output or "-", text.encode(), force=force)
