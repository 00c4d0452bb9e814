"""``symdh html``: the handout as a web page."""

from __future__ import annotations

import click

from symdh.cli import files, options, tables


@click.command(
    epilog=options.examples(
        "symdh html scara.yaml",
        "symdh html scara.yaml -o - > a.html",
        "symdh html scara.yaml --sheet problem",
    )
)
@options.table_argument
@options.file_option("NAME.html")
@options.order_option
@options.notation_option
@options.sheet_options
@options.templates_option
@options.force_option
def html(
    table: str,
    output: str | None,
    order: str,
    notation: str,
    sheet: str | None,
    points: bool,
    ask_table: bool,
    force: bool,
) -> None:
    """Write the derivation as a web page with the arm to move.

    One file that works offline: the formulas typeset, and the arm in three dimensions with a
    slider for each joint. A problem sheet comes without the arm, whose pose would tell the answer.

    TABLE is a file, or - for standard input.
    """
    from symdh.render.page.page import render_page

    robot = tables.read_robot(table)
    page = render_page(
        tables.derived(robot, order, notation, tables.Homework(sheet, points, ask_table)), robot
    )
    files.save(
        output or f"{tables.stem(robot, tables.Homework(sheet))}.html", page.encode(), force=force
    )
