"""Expressions at their places in the file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from sympy import Expr, Symbol

from symdh.robot import AngleUnit, LengthUnit, Units
from symdh.table.budget import Budget
from symdh.table.lexer import MAX_EXPRESSION, ExpressionError
from symdh.table.nodes import MappingNode, Node, ScalarNode
from symdh.table.parser import parse
from symdh.table.quantity import measured_in, resolve
from symdh.table.report import Report
from symdh.table.source import Place
from symdh.table.units import LENGTH, Dimension, Unit


@dataclass(frozen=True, slots=True)
class Cell:
    """An exact value and where it stands.

    Attributes
    ----------
    value : sympy.Expr
        Radians, or the table's length unit.
    dimension : Dimension or None
        What is measured there.
    place : Place
        Where the expression starts.
    names : mapping of Symbol to Place
        Its symbols, and where each stands first.
    """

    value: Expr
    dimension: Dimension | None
    place: Place
    names: Mapping[Symbol, Place]


class CellReader:
    """Reads the expressions of one table and remembers how they use units of length.

    Parameters
    ----------
    report : Report
    units : Units
        Those of the table.
    longest : int
        How many characters an expression may have.

    Attributes
    ----------
    uses_length_unit : bool
        Whether some number so far carries a unit of length.
    complete : bool
        Whether every expression so far could be parsed, so that all symbols are known.
    """

    def __init__(self, report: Report, units: Units, longest: int = MAX_EXPRESSION) -> None:
        self.report = report
        self.units = units
        self.longest = longest
        self.uses_length_unit = False
        self.complete = True
        self._budget = Budget()
        self._bare_lengths: list[Place] = []

    def read(
        self, node: Node, dimension: Dimension | None, unit: Unit | None = None
    ) -> Cell | None:
        """Read the expression of a node; None, and an error in the report, if it is none.

        A `unit` is what bare numbers mean in this place, whatever they mean in the table.
        """
        text = scalar(node, "an expression", self.report)
        if text is None:
            self.complete = False
            return None
        return self.read_part(text, 0, len(text.text), dimension, unit)

    def read_part(
        self,
        node: ScalarNode,
        start: int,
        end: int,
        dimension: Dimension | None,
        unit: Unit | None = None,
    ) -> Cell | None:
        """Read the expression between two offsets of a text; see `read`."""
        if self._budget.is_spent:
            self.complete = False
            return None
        units = replace(self.units, angle=unit) if isinstance(unit, AngleUnit) else self.units
        try:
            parsed = parse(node.text[start:end], units, self.longest, self._budget)
        except ExpressionError as problem:
            self.report.error(node.place(start + problem.offset), problem.message)
            self.complete = False
            return None
        self.uses_length_unit |= parsed.has_length_unit
        for remark in parsed.remarks:
            self.report.warning(node.place(start + remark.offset), remark.message)
        quantity = parsed.quantity
        place = node.place(start + quantity.start)
        if isinstance(unit, LengthUnit):
            self.uses_length_unit = True
        elif dimension == LENGTH and quantity.bare != 0:
            self._bare_lengths.append(place)
        try:
            if isinstance(unit, LengthUnit):
                quantity = measured_in(quantity, unit, units)
            value, remark_on_bare = resolve(quantity, dimension, units)
        except ExpressionError as problem:
            self.report.error(node.place(start + problem.offset), problem.message)
            # The value as written is good enough to look for further errors.
            value, remark_on_bare = quantity.total, ""
        if remark_on_bare:
            self.report.warning(place, remark_on_bare)
        names = {symbol: node.place(start + offset) for symbol, offset in parsed.names.items()}
        return Cell(value, dimension, node.place(start), names)

    def warn_of_bare_lengths(self) -> None:
        """Say that bare lengths are metres, where the table's lengths have units but it has none.

        A table without any unit of length needs none: all its lengths are in one unknown unit.
        """
        if self.units.length is None and self.uses_length_unit:
            for place in self._bare_lengths:
                self.report.warning(
                    place,
                    "this length has no unit and is read as metre, as other lengths have one; "
                    "write the unit, or add `units: {length: m}` to the table",
                )


def scalar(node: Node, wanted: str, report: Report) -> ScalarNode | None:
    """Return `node` if it is a text on one line; else note that `wanted` is missing there."""
    if isinstance(node, ScalarNode):
        if node.one_line:
            return node
        report.error(node.place(), f"{wanted} must stand on one line")
    elif isinstance(node, MappingNode):
        report.error(
            node.place(), f"{wanted} is wanted here, not a mapping; quote a text with {{}}"
        )
    else:
        report.error(node.place(), f"{wanted} is wanted here, not a list; quote a text with []")
    return None
