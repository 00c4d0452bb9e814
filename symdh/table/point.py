"""A point on the command line: three lengths with commas between."""

from __future__ import annotations

from sympy import Expr

from symdh.errors import Diagnostic, TableError
from symdh.robot import Robot
from symdh.table.lexer import ExpressionError
from symdh.table.parser import parse
from symdh.table.quantity import resolve
from symdh.table.units import LENGTH

POINT = "--at"
"""The file name in diagnostics of `parse_point`."""


def parse_point(robot: Robot, text: str) -> tuple[Expr, Expr, Expr]:
    """Read ``0, 0, L`` or ``10 mm, 0, a4/2``; a bare number means what the table's units say.

    Returns
    -------
    tuple of 3 Expr
        Exact, in the table's length unit. Symbols may be the table's parameters or new ones.

    Raises
    ------
    TableError
        When the text is not such a point, or a joint variable stands in it; its line is 1.
    """
    parts = _parts(text)
    if len(parts) != 3:
        raise _error(
            text, len(text), f"a point has three coordinates, x,y,z; here are {len(parts)}"
        )
    x, y, z = (_length(robot, text, offset, part) for offset, part in parts)
    return x, y, z


def _length(robot: Robot, text: str, offset: int, part: str) -> Expr:
    # Blanks in place of what stands before keep the columns of a diagnostic those of the text.
    try:
        parsed = parse(" " * offset + part, robot.units)
        for symbol, place in parsed.names.items():
            if symbol in robot.variables:
                message = f"{symbol} moves a joint; a point is fixed in its frame"
                raise ExpressionError(place, message)
        return resolve(parsed.quantity, LENGTH, robot.units)[0]
    except ExpressionError as problem:
        start = offset + len(part) - len(part.lstrip())
        raise _error(text, max(problem.offset, start), problem.message) from None


def _parts(text: str) -> list[tuple[int, str]]:
    """Split at the commas outside brackets, each part with its offset."""
    parts: list[tuple[int, str]] = []
    start = depth = 0
    for offset, character in enumerate(text):
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append((start, text[start:offset]))
            start = offset + 1
    return [*parts, (start, text[start:])]


def _error(text: str, offset: int, message: str) -> TableError:
    return TableError([Diagnostic(message, POINT, 1, offset + 1, text, offset + 1)])
