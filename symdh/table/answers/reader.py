"""From the text of an answer file to an `AnswerSheet`, every cell through symdh's own parser."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Protocol

from sympy import Expr, Symbol

from symdh.robot import Convention, Robot
from symdh.table.answers.model import AnswerSheet, Claim, Entry, RowClaim
from symdh.table.answers.targets import EXAMPLES, KEYS, Cells, Target, read_target
from symdh.table.cells import Cell, CellReader, scalar
from symdh.table.headers import PARAMETERS, Columns, read_columns
from symdh.table.lexer import ExpressionError
from symdh.table.nodes import MAX_SCALAR, MappingNode, Node, ScalarNode, SequenceNode, parse_nodes
from symdh.table.numbers import read_values
from symdh.table.report import Report
from symdh.table.rows import Row, rows_of_columns, rows_of_joints
from symdh.table.source import START, Source
from symdh.table.suggest import brief, did_you_mean_symbol
from symdh.table.units import ANGLE, LENGTH, Dimension, Unit
from symdh.table.uses import symbol_dimension

#: What a student leaves who does not know.
BLANKS = ("", "_", "?", "~", "null")
MAX_CLAIMS = 200


class ShortForms(Protocol):
    """What names mean that are no symbols of the table, such as c12.

    Attributes
    ----------
    names : tuple of str
        The commonest of them, for the "did you mean".
    """

    names: tuple[str, ...]

    def __call__(self, name: str) -> Expr | None:
        """Return what a name means; None for nothing."""


_BRACED = re.compile(r"(\b[csCS])_\{(\d+(?:[-,]\d+)*)\}")
_COLUMNS = {
    Convention.STANDARD: ("theta", "d", "a", "alpha"),
    Convention.MODIFIED: ("alpha", "a", "d", "theta"),
}
_DIMENSIONS = {"theta": ANGLE, "d": LENGTH, "a": LENGTH, "alpha": ANGLE}


def read_answers(source: Source, robot: Robot, meaning: ShortForms) -> AnswerSheet:
    """Read an answer file.

    Parameters
    ----------
    source : Source
    robot : Robot
        The table that is asked about.
    meaning : ShortForms

    Raises
    ------
    TableError
        With every mistake of form at its place: what is no expression, a name that the table does
        not have, a matrix of the wrong size. A wrong answer is no mistake of form.
    """
    report = Report(source)
    reader = _Reader(robot, meaning, report)
    sections = {key.text: (key, node) for key, node in parse_nodes(source).items}
    claims: list[Claim] = []
    values: dict[Symbol, Expr] = {}
    for key, node in sections.values():
        if key.text == "numbers":
            found, values = reader.numbers(node)
            claims += found
        elif key.text not in KEYS:
            claims += reader.claim(key, node, numeric=False)
    rows = reader.rows(_node(sections, "columns"), _node(sections, "rows"))
    student = scalar(sections["name"][1], "a name", report) if "name" in sections else None
    if len(claims) > MAX_CLAIMS:
        report.error(START, f"{len(claims)} answers, over {MAX_CLAIMS}")
    if not claims and not rows and "name" in sections:
        report.error(START, f"there is no answer here (such as {EXAMPLES})")
    report.raise_errors()
    name = student.text.strip() if student else ""
    return AnswerSheet(source.filename, "" if name in BLANKS else name, tuple(claims), rows, values)


def _node(sections: Mapping[str, tuple[ScalarNode, Node]], key: str) -> Node | None:
    return sections[key][1] if key in sections else None


class _Reader:
    """Reads the cells of one answer file."""

    def __init__(self, robot: Robot, meaning: ShortForms, report: Report) -> None:
        self._robot = robot
        self._meaning = meaning
        self._report = report
        self._cells = CellReader(report, robot.units, MAX_SCALAR)
        self._known = {*robot.variables, *robot.parameters}

    def numbers(self, node: Node) -> tuple[list[Claim], dict[Symbol, Expr]]:
        """Read the section of numeric entries, and the values that they are for."""
        if not isinstance(node, MappingNode):
            self._report.error(node.place(), "numbers must be a mapping, such as {px: 0.671}")
            return [], {}
        claims: list[Claim] = []
        values: dict[Symbol, Expr] = {}
        for key, each in node.items:
            if key.text == "at":
                uses = {s: {d} for s in self._known if (d := symbol_dimension(self._robot, s))}
                values = read_values(each, self._known, uses, self._cells)
            else:
                claims += self.claim(key, each, numeric=True)
        return claims, values

    def claim(self, key: ScalarNode, node: Node, *, numeric: bool) -> list[Claim]:
        """Read what stands under one key; nothing, and an error in the report, if it is wrong."""
        try:
            target = read_target(key.text, self._robot.n, len(self._robot.variables))
        except ExpressionError as problem:
            self._report.error(key.place(), problem.message)
            return []
        entries = self._entries(key, node, target)
        name = " ".join(key.text.split()) + (" in numbers" if numeric else "")
        return [Claim(name, target.subject, tuple(entries), numeric)] if entries else []

    def _entries(self, key: ScalarNode, node: Node, target: Target) -> list[Entry]:
        rows = _rows(node)
        sizes = [len(row) for row in rows]
        cells = next((s for s in target.shapes if [len(row) for row in s] == sizes), None)
        if cells is None and len(rows) == 1 and sizes[0] == len(target.shapes[0]):
            # A column vector may be written on one line.
            rows = [[each] for each in rows[0]]
            cells = target.shapes[0] if len(target.shapes[0][0]) == 1 else None
        if cells is None:
            self._report.error(node.place(), _why_wrong_size(key.text, target.shapes[0], sizes))
            return []
        pairs = [
            (place, each)
            for places, row in zip(cells, rows, strict=True)
            for place, each in zip(places, row, strict=True)
        ]
        read = (self._entry(each, row, column) for (row, column), each in pairs)
        return [entry for entry in read if entry is not None]

    def _entry(
        self,
        node: Node,
        row: int,
        column: int,
        dimension: Dimension | None = None,
        unit: Unit | None = None,
    ) -> Entry | None:
        text = scalar(node, "an expression", self._report)
        if text is None:
            return None
        if text.text.strip() in BLANKS:
            return Entry(row, column, None, "", text.place())
        plain = replace(text, text=_without_braces(text.text))
        cell = self._cells.read(plain, dimension, unit)
        if cell is None:
            return None
        self._note_unknown(cell)
        meanings = {s: m for s in cell.names if (m := self._meant(s)) is not None}
        return Entry(row, column, cell.value.xreplace(meanings), text.text.strip(), cell.place)

    def _meant(self, symbol: Symbol) -> Expr | None:
        return None if symbol in self._known else self._meaning(symbol.name)

    def _note_unknown(self, cell: Cell) -> None:
        """Note every name that neither stands in the table nor is a short form."""
        for symbol, place in cell.names.items():
            if symbol not in self._known and self._meant(symbol) is None:
                known = [*self._meaning.names, *sorted(s.name for s in self._known)]
                hint = did_you_mean_symbol(symbol.name, known)
                message = f"{brief(symbol.name)} is neither in the table nor a short form of it"
                self._report.error(place, message + hint)

    def rows(self, columns: Node | None, rows: Node | None) -> tuple[RowClaim, ...]:
        """Read rows of a table, as mappings or as lists in the order of the columns."""
        if rows is None:
            if columns is not None:
                self._report.error(columns.place(), "columns without rows")
            return ()
        claims = []
        for row in self._written_rows(columns, rows):
            cells = {}
            for place, name in enumerate(PARAMETERS):
                if name in row.cells:
                    node = row.cells[name]
                    unit = row.units.get(name)
                    entry = self._entry(node, row.number - 1, place, _DIMENSIONS[name], unit)
                    if entry is not None:
                        cells[name] = entry
            claims.append(RowClaim(row.number, cells))
        return tuple(claims)

    def _written_rows(self, columns: Node | None, rows: Node) -> list[Row]:
        lists = isinstance(rows, SequenceNode) and all(
            isinstance(row, SequenceNode) for row in rows.items
        )
        if not lists:
            return rows_of_joints(rows, self._report)
        header = Columns(_COLUMNS[self._robot.convention])
        if columns is not None:
            header = read_columns(columns, self._report)
        return rows_of_columns(header, rows, self._report)


def _rows(node: Node) -> list[list[Node]]:
    """Return what stands under a key as rows: one entry, one list, or a list of lists."""
    if not isinstance(node, SequenceNode):
        return [[node]]
    if node.items and all(isinstance(row, SequenceNode) for row in node.items):
        return [list(row.items) for row in node.items if isinstance(row, SequenceNode)]
    return [list(node.items)]


def _why_wrong_size(name: str, cells: Cells, sizes: list[int]) -> str:
    """Say what size a matrix must have, and which row is at fault."""
    rows, columns = len(cells), len(cells[0])
    if rows == columns == 1:
        return f"{brief(name)} is one entry, not a list"
    if columns == 1:
        return f"{brief(name)} is a list of {rows}: [..., ..., ...]"
    wanted = f"{brief(name)} has {rows} rows of {columns}"
    if len(sizes) in (rows, 3) and len(sizes) > 1:
        wrong = next((k for k, size in enumerate(sizes, start=1) if size != columns), 1)
        return f"{wanted}; here row {wrong} has {sizes[wrong - 1]}"
    return f"{wanted}; here are {len(sizes)}"


def _without_braces(text: str) -> str:
    """Return an expression with ``c_{12}`` as ``c12`` and ``c_{1-2}`` as ``c1_m2``.

    Blanks fill up what is left out, so that every character stays in its column.
    """
    return _BRACED.sub(_plain, text)


def _plain(found: re.Match[str]) -> str:
    label = found[2].replace(",-", "-").replace("-", "_m").replace(",", "_")
    return f"{found[1]}{label}".ljust(len(found[0]))
