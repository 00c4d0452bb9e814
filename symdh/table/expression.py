"""Single expressions and numbers from outside a table."""

from __future__ import annotations

from sympy import Expr

from symdh.errors import Diagnostic, TableError
from symdh.robot import AngleUnit, Units
from symdh.table.lexer import ExpressionError
from symdh.table.parser import parse
from symdh.table.quantity import resolve
from symdh.table.units import Dimension

SETTING = "--set"
"""The file name in diagnostics of `parse_quantity`."""


def parse_expression(text: str) -> Expr:
    """Read an expression with plain numbers and radians, such as ``cos(theta1 + theta2)``.

    This reads back what symdh writes: symbols are real `Symbol`, decimals are exact.

    Raises
    ------
    TableError
        When the text is not such an expression.
    """
    try:
        return parse(text, Units(angle=AngleUnit.RADIAN)).quantity.total
    except ExpressionError as problem:
        raise _on_one_line(text, "<expression>", problem) from None


def parse_quantity(text: str, units: Units, dimension: Dimension | None) -> Expr:
    """Read one number with an optional unit, as in ``--set theta1=30`` on the command line.

    Parameters
    ----------
    text : str
    units : Units
        Those of the table, for a number without a unit.
    dimension : Dimension or None
        ``ANGLE`` or ``LENGTH``; None for a plain number.

    Returns
    -------
    sympy.Expr
        Radians, or the table's length unit; exact and without symbols.

    Raises
    ------
    TableError
        When the text is not such a number.
    """
    try:
        parsed = parse(text, units)
        for symbol, offset in parsed.names.items():
            raise ExpressionError(offset, f"a number is wanted here, and {symbol} is a name")
        return resolve(parsed.quantity, dimension, units)[0]
    except ExpressionError as problem:
        raise _on_one_line(text, SETTING, problem) from None


def _on_one_line(text: str, filename: str, problem: ExpressionError) -> TableError:
    column = problem.offset + 1
    return TableError([Diagnostic(problem.message, filename, 1, column, text, column)])
