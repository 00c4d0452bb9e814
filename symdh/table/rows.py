"""The rows of a table in both spellings: a list of mappings, or columns once and then lists."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from symdh.table.cells import scalar
from symdh.table.nodes import MappingNode, Node, ScalarNode, SequenceNode
from symdh.table.report import Report
from symdh.table.source import Place
from symdh.table.suggest import brief, did_you_mean

MAX_JOINTS = 200

PARAMETERS = ("theta", "d", "a", "alpha")
TYPE = "type"
VARIABLE = "variable"
LABELS = ("i", "joint", "link", "notes")
"""Columns that are for people: read and left alone."""

_COLUMNS = (*PARAMETERS, TYPE, VARIABLE, *LABELS)
_COLUMN_ALIASES = {
    "twist": "alpha",
    "length": "a",
    "r": "a",
    "offset": "d",
    "angle": "theta",
    "q": "theta",
}
_GREEK = str.maketrans({"θ": "theta", "ϑ": "theta", "α": "alpha", "$": "", "\\": "", " ": ""})
_INDEX = re.compile(r"(?:_?(?:\{i(?:[-−]1)?\}|\(i(?:[-−]1)?\)|i(?:[-−]1)?)|ᵢ(?:₋₁)?)\Z")


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
    """

    number: int
    place: Place
    cells: Mapping[str, Node] = field(default_factory=dict)


def column_name(written: str) -> str | None:
    """Return the column that a header means, or None.

    Accepts what textbooks print: ``θ``, ``theta_i``, ``alpha_{i-1}``, ``$a_{i-1}$``, ``αᵢ₋₁``.
    """
    name = written.translate(_GREEK)
    if name in _COLUMNS:
        return name
    bare = _INDEX.sub("", name)
    return bare if bare in PARAMETERS else None


def rows_of_joints(node: Node, report: Report) -> list[Row]:
    """Read the rows under ``joints``, each a mapping."""
    if not isinstance(node, SequenceNode):
        _refuse_no_list("joints", node, report)
        return []
    rows = []
    for number, item in enumerate(_counted(node, "joints", report), start=1):
        if isinstance(item, MappingNode):
            cells = _cells_of_mapping(item, report)
            rows.append(_complete_row(number, item.place(), cells, report))
        else:
            message = f"row {number} must be a mapping: {{theta: ..., d: ..., a: ..., alpha: ...}}"
            report.error(item.place(), message)
    return rows


def rows_of_columns(columns: Node, rows: Node, report: Report) -> list[Row]:
    """Read ``columns`` and ``rows``, each row a list in the order of the columns."""
    names = _column_names(columns, report)
    if not isinstance(rows, SequenceNode):
        _refuse_no_list("rows", rows, report)
        return []
    if not names:
        return []
    read = []
    for number, item in enumerate(_counted(rows, "rows", report), start=1):
        if not isinstance(item, SequenceNode):
            report.error(item.place(), f"row {number} must be a list: [...]")
        elif len(item.items) != len(names):
            message = (
                f"row {number} has {len(item.items)} cells, and there are {len(names)} columns"
            )
            report.error(item.place(), message)
        else:
            pairs = zip(names, item.items, strict=True)
            cells = {name: cell for name, cell in pairs if name is not None}
            read.append(Row(number, item.place(), cells))
    return read


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


def _cells_of_mapping(node: MappingNode, report: Report) -> dict[str, Node]:
    cells: dict[str, Node] = {}
    for key, value in node.items:
        name = column_name(key.text)
        if name is None:
            hint = did_you_mean(key.text, _COLUMNS, _COLUMN_ALIASES)
            report.error(key.place(), f"key {brief(key.text)} unknown in a row{hint}")
        elif name in cells:
            report.error(key.place(), f"key {key.text} is given twice; both are {name}")
        else:
            cells[name] = value
    return cells


def _complete_row(number: int, place: Place, cells: Mapping[str, Node], report: Report) -> Row:
    missing = [name for name in PARAMETERS if name not in cells]
    if missing:
        noun = "key" if len(missing) == 1 else "keys"
        report.error(place, f"missing {noun} {', '.join(missing)} in row {number}")
    return Row(number, place, cells)


def _column_names(node: Node, report: Report) -> list[str | None]:
    """Return the column of every header, None for one that is wrong and already noted."""
    if not isinstance(node, SequenceNode):
        report.error(node.place(), "columns must be a list such as [alpha, a, d, theta]")
        return []
    names: list[str | None] = []
    for item, name in _headers(node, report):
        if name is not None and name in names:
            report.error(item.place(), f"column {name} is given twice")
        names.append(name)
    missing = [name for name in PARAMETERS if name not in names]
    if missing and None not in names:
        noun = "column" if len(missing) == 1 else "columns"
        report.error(node.place(), f"missing {noun} {', '.join(missing)}")
    return names


def _headers(node: SequenceNode, report: Report) -> Iterator[tuple[Node, str | None]]:
    for item in node.items:
        text = scalar(item, "the name of a column", report)
        name = column_name(text.text) if text else None
        if text is not None and name is None:
            hint = did_you_mean(text.text, _COLUMNS, _COLUMN_ALIASES)
            report.error(text.place(), f"column {brief(text.text)} unknown{hint}")
        yield item, name
