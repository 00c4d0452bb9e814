"""From the text of a table to a robot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from symdh.errors import Diagnostic
from symdh.robot import LengthUnit, Robot, Units
from symdh.table.amounts import refuse_values
from symdh.table.cells import CellReader
from symdh.table.form import form_of
from symdh.table.headers import Columns, read_columns
from symdh.table.joints import DIMENSIONS, read_joints
from symdh.table.keys import Keys, read_keys
from symdh.table.labels import default_name, read_name, read_title
from symdh.table.nodes import Node
from symdh.table.numbers import read_limits, read_values
from symdh.table.report import Report
from symdh.table.rows import Row, rows_of_columns, rows_of_joints
from symdh.table.settings import read_convention, read_units, units_of_columns
from symdh.table.source import START, Source
from symdh.table.uses import dimensions_of_symbols
from symdh.table.words import PlacedMotion, read_word

KEYS = (
    "name",
    "title",
    "convention",
    "units",
    "joints",
    "columns",
    "rows",
    "base",
    "tool",
    "values",
    "limits",
    "notes",
)
_KEY_ALIASES = {
    "links": "joints",
    "table": "joints",
    "dh": "joints",
    "parameters": "values",
    "description": "notes",
    "comment": "notes",
}


@dataclass(frozen=True, slots=True)
class LoadedTable:
    """A table that could be read.

    Attributes
    ----------
    robot : Robot
    warnings : tuple of Diagnostic
        In the order of the file.
    """

    robot: Robot
    warnings: tuple[Diagnostic, ...]


def read_table(source: Source) -> LoadedTable:
    """Read a table.

    Raises
    ------
    TableError
        With every error and warning, in the order of the file.
    """
    report = Report(source)
    form = form_of(source)
    keys = read_keys(form.nodes(source), KEYS, report, _KEY_ALIASES)
    sections = keys.nodes
    columns = _read_columns(sections, report)
    # A misspelt key has its own message.
    advice = "" if "convention" in keys.meant else form.convention
    convention = read_convention(sections.get("convention"), report, columns.teller, advice)
    name = read_name(sections["name"], report) if "name" in sections else None
    title = read_title(sections["title"], report) if "title" in sections else None
    units = units_of_columns(read_units(sections.get("units"), report), columns.units)
    reader = CellReader(report, units)

    base = _read_motions("base", sections, reader)
    tool = _read_motions("tool", sections, reader)
    outer = [placed.cell for placed in (*base, *tool)]
    rows = read_joints(_read_rows(keys, columns, report), outer, reader)

    cells = [*outer, *(cell for row in rows for cell in row.cells.values())]
    uses = dimensions_of_symbols((cell.value, cell.dimension) for cell in cells)
    symbols = {symbol for cell in cells for symbol in cell.names}
    values = read_values(sections.get("values"), symbols, uses, reader)
    refuse_values(cells, values, report)
    variables = {row.variable: DIMENSIONS[row.home] for row in rows if row.variable and row.home}
    limits = read_limits(sections.get("limits"), variables, reader)

    reader.warn_of_bare_lengths()
    report.raise_errors()
    robot = Robot(
        name=name or default_name(source.filename),
        convention=convention,
        joints=tuple(row.joint() for row in rows),
        base=tuple(placed.motion for placed in base),
        tool=tuple(placed.motion for placed in tool),
        values=values,
        limits=limits,
        title=title,
        units=_units_of(reader),
    )
    return LoadedTable(robot, report.diagnostics())


def _read_columns(sections: Mapping[str, Node], report: Report) -> Columns:
    if "columns" in sections and "rows" in sections and "joints" not in sections:
        return read_columns(sections["columns"], report)
    return Columns()


def _read_rows(keys: Keys, header: Columns, report: Report) -> list[Row]:
    """Read the rows in whichever spelling the table has them."""
    joints, columns, rows = (keys.nodes.get(key) for key in ("joints", "columns", "rows"))
    if joints is not None:
        for other in (columns, rows):
            if other is not None:
                report.error(other.place(), "give the rows once: as joints, or as columns and rows")
        return rows_of_joints(joints, report)
    if columns is not None and rows is not None:
        return rows_of_columns(header, rows, report)
    if columns is not None and keys.lack("rows"):
        report.error(columns.place(), "columns without rows")
    elif rows is not None and keys.lack("columns"):
        report.error(rows.place(), "rows without columns: say `columns: [alpha, a, d, theta]`")
    elif keys.lack("joints", "columns", "rows"):
        report.error(START, "joints is missing: the list of rows (or columns and rows)")
    return []


def _read_motions(key: str, sections: Mapping[str, Node], reader: CellReader) -> list[PlacedMotion]:
    node = sections.get(key)
    return [] if node is None else read_word(key, node, reader)


def _units_of(reader: CellReader) -> Units:
    """Return the table's units; lengths that carry their own make metre the unit of the rest."""
    if reader.units.length is None and reader.uses_length_unit:
        return replace(reader.units, length=LengthUnit.METRE)
    return reader.units
