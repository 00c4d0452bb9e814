"""The rows of a table in both spellings: a list of mappings, or columns once and then lists."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from symdh.table.headers import COLUMN_ALIASES, COLUMNS, PARAMETERS, Columns, column_name
from symdh.table.nodes import MappingNode, Node, ScalarNode, SequenceNode
from symdh.table.report import Report
from symdh.table.source import Place
from symdh.table.suggest import brief, nearest, question
from symdh.table.units import Unit

MAX_JOINTS = 200


@dataclass(frozen=True, slots=True)
class Row:
    """One row as it stands in the file.

    Attributes
    ----------
    number : int
        Counted from 1.
    place : Place
    cells : mapping of str to Node
        Every one of theta, d, a and alpha, where the row was complete.
    units : mapping of str to AngleUnit or LengthUnit
        What bare numbers of a parameter mean, where the name of its column says so.
    """

    number: int
    place: Place
    cells: Mapping[str, Node] = field(default_factory=dict)
    units: Mapping[str, Unit] = field(default_factory=dict)


def rows_of_joints(node: Node, report: Report) -> list[Row]:
    """Read the rows under ``joints``, each a mapping."""
    if not isinstance(node, SequenceNode):
        _refuse_no_list("joints", node, report)
        return []
    rows = []
    for number, item in enumerate(_counted(node, "joints", report), start=1):
        if isinstance(item, MappingNode):
            rows.append(_row_of_mapping(number, item, report))
        else:
            message = f"row {number} must be a mapping: {{theta: ..., d: ..., a: ..., alpha: ...}}"
            report.error(item.place(), message)
    return rows


def rows_of_columns(columns: Columns, rows: Node, report: Report) -> list[Row]:
    """Read ``rows``, each a list in the order of the columns."""
    if not isinstance(rows, SequenceNode):
        _refuse_no_list("rows", rows, report)
        return []
    if not columns.names:
        return []
    read = []
    for number, item in enumerate(_counted(rows, "rows", report), start=1):
        if not isinstance(item, SequenceNode):
            report.error(item.place(), f"row {number} must be a list: [...]")
        elif len(item.items) != len(columns.names):
            message = (
                f"row {number} has {len(item.items)} cells, "
                f"and there are {len(columns.names)} columns"
            )
            report.error(item.place(), message + _hint_of_commas(item, len(columns.names)))
        else:
            pairs = zip(columns.names, item.items, strict=True)
            cells = {name: cell for name, cell in pairs if name is not None}
            read.append(Row(number, item.place(), cells, columns.units))
    return read


def _hint_of_commas(row: SequenceNode, wanted: int) -> str:
    """Say where the decimal point is in a row that a decimal comma may have cut."""
    numbers = [isinstance(cell, ScalarNode) and cell.text.isdigit() for cell in row.items]
    cut = len(numbers) > wanted and any(both == (True, True) for both in pairwise(numbers))
    return "; a decimal point is a point, not a comma" if cut else ""


def _counted(node: SequenceNode, key: str, report: Report) -> tuple[Node, ...]:
    """Return the rows of a list, and note it when there are none or too many."""
    if not node.items:
        report.error(node.place(), f"{key} is empty; a table has at least one row")
    if len(node.items) > MAX_JOINTS:
        place = node.items[MAX_JOINTS].place()
        report.error(place, f"{key} has {len(node.items)} rows, over {MAX_JOINTS}")
    return node.items[:MAX_JOINTS]


def _refuse_no_list(key: str, node: Node, report: Report) -> None:
    if isinstance(node, ScalarNode) and not node.text:
        report.error(node.place(), f"{key} is empty; a table has at least one row")
    else:
        report.error(node.place(), f"{key} must be a list of rows, each starting with -")


def _row_of_mapping(number: int, node: MappingNode, report: Report) -> Row:
    cells: dict[str, Node] = {}
    meant = set()
    for key, value in node.items:
        name = column_name(key.text)
        if name is None:
            right = nearest(key.text, COLUMNS, COLUMN_ALIASES)
            meant.add(right)
            report.error(key.place(), f"key {brief(key.text)} unknown in a row{question(right)}")
        elif name in cells:
            report.error(key.place(), f"key {key.text} is given twice; both are {name}")
        else:
            cells[name] = value
    missing = [name for name in PARAMETERS if name not in cells and name not in meant]
    if missing:
        noun = "key" if len(missing) == 1 else "keys"
        report.error(node.place(), f"missing {noun} {', '.join(missing)} in row {number}")
    return Row(number, node.place(), cells)
