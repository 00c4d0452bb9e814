"""The rows of a table as CSV, as Markdown, and as a LaTeX table to paste."""

from __future__ import annotations

import csv
from io import StringIO

from symdh.derivation.blocks import Chapter
from symdh.derivation.style import Style
from symdh.derivation.table import chapter
from symdh.render.interchange.exported import Exported
from symdh.render.interchange.table import ORDERS, TableText, table_text
from symdh.render.latex import render_chapter
from symdh.render.table_yaml import MARK, first_settings, last_settings
from symdh.robot import Convention, Robot

_ESCAPED = "\\`*_{}[]<>#|"


def table_csv(robot: Robot) -> Exported:
    """Write a table as CSV, as symdh reads it: the keys of the table in comments, then the rows.

    The header names the columns as books do, alpha_{i-1} say.
    """
    table = table_text(robot)
    keys = _keys(robot.convention, table)
    stream = StringIO()
    stream.writelines(f"{line}\n" for line in (MARK, *(f"# {line}" for line in _settings(robot))))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(_heading(key, robot.convention) for key in keys)
    writer.writerows([row.get(key, "") for key in keys] for row in table.joints)
    return Exported(stream.getvalue())


def table_markdown(robot: Robot) -> Exported:
    """Write a table as Markdown, as symdh reads it: the keys of the table on top, then the rows."""
    table = table_text(robot)
    keys = _keys(robot.convention, table)
    cells = [["i", *(_heading(key, robot.convention) for key in keys)]]
    cells += [
        [str(i), *(row.get(key, "") for key in keys)] for i, row in enumerate(table.joints, start=1)
    ]
    escaped = [[_escape(cell, "*|") for cell in row] for row in cells]
    # A rule of three dashes is one in every dialect.
    widths = [max(3, *map(len, column)) for column in zip(*escaped, strict=True)]
    lines = [_markdown_row(row, widths) for row in escaped]
    lines.insert(1, _markdown_row(["-" * width for width in widths], widths))
    head = ["---", MARK, *_settings(robot), "---", ""]
    title = [f"**{_escape(robot.title or robot.name, _ESCAPED)}**", ""]
    return Exported("\n".join([*head, *title, *lines]) + "\n")


def table_latex(robot: Robot) -> Exported:
    """Write the table as LaTeX to paste; it needs the packages amsmath and booktabs."""
    # The first block of the chapter on the table is the table itself.
    rows = chapter(Style(robot)).blocks[0]
    needs = "% needs \\usepackage{amsmath,booktabs}\n"
    return Exported(needs + render_chapter(Chapter("", (rows,))))


def _settings(robot: Robot) -> list[str]:
    return [*first_settings(robot), *last_settings(robot)]


def _keys(convention: Convention, table: TableText) -> list[str]:
    """Return the columns; type and variable only where some row has them."""
    more = [key for key in ("type", "variable") if any(key in row for row in table.joints)]
    return [*ORDERS[convention], *more]


def _heading(key: str, convention: Convention) -> str:
    if key in ("theta", "d"):
        return f"{key}_i"
    if key in ("a", "alpha"):
        return f"{key}_i" if convention is Convention.STANDARD else f"{key}_{{i-1}}"
    return key


def _markdown_row(cells: list[str], widths: list[int]) -> str:
    return "| " + " | ".join(c.ljust(w) for c, w in zip(cells, widths, strict=True)) + " |"


def _escape(text: str, special: str) -> str:
    return "".join("\\" + character if character in special else character for character in text)
