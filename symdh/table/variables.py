"""Which symbol of a row is the joint's variable."""

from __future__ import annotations

import re
from collections.abc import Set
from dataclasses import dataclass

from sympy import Add, Symbol

from symdh.table.cells import Cell, scalar
from symdh.table.headers import VARIABLE
from symdh.table.names import canonical_name
from symdh.table.report import Report
from symdh.table.rows import Row
from symdh.table.source import Place
from symdh.table.suggest import brief

_USUAL_NAMES = {"theta": re.compile(r"(?:theta|q)[0-9]*"), "d": re.compile(r"[dq][0-9]*")}


@dataclass(frozen=True, slots=True)
class NamedVariable:
    """The symbol under the key ``variable`` of a row."""

    symbol: Symbol
    place: Place


def read_named_variable(row: Row, report: Report) -> NamedVariable | None:
    """Return the variable that a row names itself, if it does."""
    node = row.cells.get(VARIABLE)
    text = scalar(node, "the name of a symbol", report) if node is not None else None
    # An empty cell of a compact table leaves the choice open.
    if text is None or not text.text.strip():
        return None
    return NamedVariable(Symbol(canonical_name(text.text.strip()), real=True), text.place())


def choose_variable(
    cell: Cell, home: str, number: int, named: NamedVariable | None, elsewhere: Set[Symbol]
) -> Symbol:
    """Return the symbol that moves a joint: the one named, or the one that can only be it.

    Parameters
    ----------
    cell : Cell
        The theta of a revolute joint or the d of a prismatic one.
    home : str
        Which of the two it is.
    number : int
        That of the joint, for messages.
    named : NamedVariable or None
        The variable that the row names.
    elsewhere : set of Symbol
        Those of the cell's symbols that stand in other cells of the table too, among which a
        variable cannot be.

    Raises
    ------
    VariableError
        When there is no such symbol, or several, or the cell is not linear in it.
    """
    if named is not None:
        if named.symbol not in cell.names:
            name = brief(named.symbol.name)
            raise VariableError(
                named.place, f"variable {name} does not stand in {home} of joint {number}"
            )
        return _linear(named.symbol, cell, home)
    candidates = _candidates(list(cell.names), home, elsewhere)
    if not candidates:
        message = f"joint {number} has no variable: no symbol stands in its {home}"
        raise VariableError(cell.place, message)
    if len(candidates) > 1:
        names = " or ".join(symbol.name for symbol in candidates)
        raise VariableError(
            cell.place,
            f"which symbol moves joint {number}, {names}? "
            f"Add `variable: {candidates[0]}` to the row",
        )
    return _linear(candidates[0], cell, home)


class VariableError(Exception):
    """A row's variable cannot be told or used; `place` says where that shows."""

    def __init__(self, place: Place, message: str) -> None:
        super().__init__(message)
        self.place = place
        self.message = message


def _candidates(names: list[Symbol], home: str, elsewhere: Set[Symbol]) -> list[Symbol]:
    """Narrow the symbols of a cell down: those of no other cell, then those with a usual name."""
    if len(names) < 2:
        return names
    own = [name for name in names if name not in elsewhere] or names
    usual = [name for name in own if _USUAL_NAMES[home].fullmatch(name.name)]
    return usual if len(usual) == 1 else own


def _linear(variable: Symbol, cell: Cell, home: str) -> Symbol:
    """Return `variable` if the cell is a rational multiple of it plus an offset."""
    terms = [term for term in Add.make_args(cell.value) if term.has(variable)]
    if len(terms) != 1 or terms[0].as_coeff_Mul()[1] != variable:
        raise VariableError(
            cell.names[variable],
            f"joint variable {variable} must stand in {home} by itself or times a number; "
            "an offset may be added",
        )
    return variable
