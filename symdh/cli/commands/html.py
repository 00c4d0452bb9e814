"""``symdh html``: the handout as a web page."""

from __future__ import annotations

import click

from symdh.cli import files, options, tables


@click.command(
    epilog=options.examples("symdh html scara.yaml", "symdh html scara.yaml -o - > a.html")
)
@options.table_argument
@options.file_option("NAME.html")
@options.order_option
@options.notation_option
@options.force_option
def html(table: str, output: str | None, order: str, notation: str, force: bool) -> None:
    """Write the derivation as a web page with the arm to move.

    One file that works offline: the formulas typeset, and the arm in three dimensions with a
    slider for each joint.

    TABLE is a file, or - for standard input.
    """
    from symdh.codegen.names import file_stem
    from symdh.render.page.page import render_page

    robot = tables.read_robot(table)
    page = render_page(tables.derived(robot, order, notation), robot)
    files.save(output or f"{file_stem(robot.name)}.html", page.encode(), force=force)
