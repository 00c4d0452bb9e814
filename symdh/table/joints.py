"""From rows to joints."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sympy import Symbol

from symdh.robot import Joint, JointType
from symdh.table.cells import Cell, CellReader
from symdh.table.headers import PARAMETERS
from symdh.table.joint_type import HOMES, read_type
from symdh.table.report import Report
from symdh.table.rows import Row
from symdh.table.units import ANGLE, LENGTH
from symdh.table.variables import VariableError, choose_variable, read_named_variable

DIMENSIONS = {"theta": ANGLE, "d": LENGTH, "a": LENGTH, "alpha": ANGLE}


@dataclass(frozen=True, slots=True)
class ParsedRow:
    """A row whose expressions are read; a cell that could not be read is missing.

    Attributes
    ----------
    row : Row
    cells : mapping of str to Cell
    type : JointType or None
        None when an error leaves it open.
    variable : Symbol or None
        None for a fixed joint, and when an error leaves it open.
    """

    row: Row
    cells: Mapping[str, Cell]
    type: JointType | None = None
    variable: Symbol | None = None

    @property
    def home(self) -> str | None:
        """The parameter that holds the variable; None when there is no variable."""
        return HOMES[self.type] if self.type and self.variable else None

    def joint(self) -> Joint:
        """Return the joint of a row without errors."""
        assert self.type is not None
        values = {name: self.cells[name].value for name in PARAMETERS}
        return Joint(type=self.type, variable=self.variable, **values)


def read_joints(rows: Sequence[Row], others: Sequence[Cell], reader: CellReader) -> list[ParsedRow]:
    """Read the rows and find every joint's type and variable.

    Parameters
    ----------
    rows : sequence of Row
    others : sequence of Cell
        The cells of base and tool, in which no joint variable may stand.
    reader : CellReader

    Returns
    -------
    list of ParsedRow
        With errors in the report where a row is wrong.
    """
    cells = [_read_cells(row, reader) for row in rows]
    places = _places(cells, others)
    parsed = [
        _read_joint(row, row_cells, places, reader.report)
        for row, row_cells in zip(rows, cells, strict=True)
    ]
    _refuse_second_places(parsed, others, reader.report)
    return parsed


def _read_cells(row: Row, reader: CellReader) -> dict[str, Cell]:
    found = {}
    for name in PARAMETERS:
        if name in row.cells:
            cell = reader.read(row.cells[name], DIMENSIONS[name], row.units.get(name))
            if cell is not None:
                found[name] = cell
    return found


def _places(cells: Sequence[Mapping[str, Cell]], others: Sequence[Cell]) -> Counter[Symbol]:
    """Return in how many cells of the table each symbol stands."""
    counted: Counter[Symbol] = Counter()
    for cell in [*others, *(cell for row in cells for cell in row.values())]:
        counted.update(cell.names.keys())
    return counted


def _read_joint(
    row: Row, cells: Mapping[str, Cell], places: Mapping[Symbol, int], report: Report
) -> ParsedRow:
    named = read_named_variable(row, report)
    kind = read_type(row, cells, named.symbol if named else None, report)
    if kind is JointType.FIXED and named is not None:
        report.error(named.place, f"joint {row.number} is fixed and has no variable")
    home = HOMES.get(kind) if kind else None
    if home is None or home not in cells:
        return ParsedRow(row, cells, kind)
    try:
        elsewhere = {symbol for symbol in cells[home].names if places[symbol] > 1}
        variable = choose_variable(cells[home], home, row.number, named, elsewhere)
    except VariableError as problem:
        report.error(problem.place, problem.message)
        return ParsedRow(row, cells, kind)
    return ParsedRow(row, cells, kind, variable)


def _refuse_second_places(
    rows: Sequence[ParsedRow], others: Sequence[Cell], report: Report
) -> None:
    """Note every joint variable that stands anywhere but in its own place."""
    owners: dict[Symbol, ParsedRow] = {}
    for row in rows:
        if row.variable is not None:
            owners.setdefault(row.variable, row)
    for row in rows:
        for name, cell in row.cells.items():
            for symbol, place in cell.names.items():
                owner = owners.get(symbol)
                if owner is not None and not (owner is row and name == row.home):
                    report.error(place, _why_not_there(symbol, owner, row, name))
    for cell in others:
        for symbol, place in cell.names.items():
            if symbol in owners:
                number = owners[symbol].row.number
                message = f"joint variable {symbol} of joint {number} cannot stand in base or tool"
                report.error(place, message)


def _why_not_there(symbol: Symbol, owner: ParsedRow, row: ParsedRow, name: str) -> str:
    assert owner.home is not None
    number = owner.row.number
    if row.variable == symbol and name == row.home:
        line = owner.cells[owner.home].place.line
        return f"{symbol} already drives joint {number} (line {line}); use another symbol"
    if owner is row:
        return f"joint variable {symbol} stands in {name}; it may stand only in {owner.home}"
    return (
        f"joint variable {symbol} of joint {number} stands in {name} of joint {row.row.number}; "
        f"if it is a constant, give joint {number} its `type` or `variable`"
    )
