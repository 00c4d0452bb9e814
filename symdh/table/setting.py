"""One ``name=value``, as ``--set`` on the command line takes it."""

from __future__ import annotations

from sympy import Expr, Symbol

from symdh.errors import Diagnostic, TableError
from symdh.robot import Robot
from symdh.table.expression import SETTING, parse_quantity
from symdh.table.names import canonical_name
from symdh.table.suggest import brief, did_you_mean_symbol
from symdh.table.uses import symbol_dimension


def parse_setting(robot: Robot, text: str, source: str = SETTING) -> tuple[Symbol, Expr]:
    """Read ``theta1=30 deg`` or ``a1=0.4``; a bare number means what the table's units say.

    Parameters
    ----------
    robot : Robot
    text : str
    source : str
        The option that it was given to, for messages.

    Returns
    -------
    symbol : sympy.Symbol
        One that stands in the table.
    value : sympy.Expr
        Radians, or the table's length unit; exact.

    Raises
    ------
    TableError
        When the name is not in the table or the value is not a number; its line is 1.
    """
    written, equals, value = text.partition("=")
    if not equals:
        raise _error(source, text, len(text), "missing =; write name=value")
    symbol = Symbol(canonical_name(written.strip()), real=True)
    known = (*robot.variables, *robot.parameters)
    if symbol not in known:
        hint = did_you_mean_symbol(symbol.name, [name.name for name in known])
        raise _error(source, text, 0, f"{brief(written)} is not in the table{hint}")
    # Blanks in place of the name keep the columns of a diagnostic those of the whole text.
    padded = " " * (len(text) - len(value)) + value
    try:
        return symbol, parse_quantity(padded, robot.units, symbol_dimension(robot, symbol))
    except TableError as problem:
        found = problem.diagnostics[0]
        raise _error(source, text, max(found.column - 1, 0), found.message) from None


def _error(source: str, text: str, offset: int, message: str) -> TableError:
    return TableError([Diagnostic(message, source, 1, offset + 1, text, offset + 1)])
