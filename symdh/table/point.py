"""A point on the command line: three lengths with commas between."""

from __future__ import annotations

import re
from collections.abc import Collection

from sympy import Expr, Symbol

from symdh.errors import Diagnostic, TableError
from symdh.robot import Units
from symdh.table.lexer import ExpressionError
from symdh.table.parser import parse
from symdh.table.quantity import resolve
from symdh.table.units import LENGTH


def parse_point(
    text: str, units: Units, name: str, joints: Collection[Symbol] = ()
) -> tuple[Expr, Expr, Expr]:
    """Read ``0, 0, L``, ``10 mm, 0, a4/2`` or ``[0, 0, L]``.

    Parameters
    ----------
    text : str
    units : Units
        What a bare number means.
    name : str
        The file name in diagnostics: the option that holds the point.
    joints : collection of Symbol
        Joint variables; none may stand in a point that is fixed in its frame.

    Returns
    -------
    tuple of 3 Expr
        Exact, in the length unit of `units`; any other symbol may stand in it.

    Raises
    ------
    TableError
        When the text is not such a point; its line is 1.
    """
    parts = _parts(text)
    try:
        if len(parts) != 3:
            message = f"a point has three coordinates, x,y,z; here are {len(parts)}"
            raise ExpressionError(len(text), message)
        x, y, z = (_length(offset, part, units, joints) for offset, part in parts)
    except ExpressionError as problem:
        column = problem.offset + 1
        raise TableError([Diagnostic(problem.message, name, 1, column, text, column)]) from None
    return x, y, z


def _length(offset: int, part: str, units: Units, joints: Collection[Symbol]) -> Expr:
    # Blanks in place of what stands before keep the columns of a diagnostic those of the text.
    try:
        parsed = parse(" " * offset + part, units)
        for symbol, place in parsed.names.items():
            if symbol in joints:
                message = f"{symbol} moves a joint; a point is fixed in its frame"
                raise ExpressionError(place, message)
        return resolve(parsed.quantity, LENGTH, units)[0]
    except ExpressionError as problem:
        start = offset + len(part) - len(part.lstrip())
        raise ExpressionError(max(problem.offset, start), problem.message) from None


def _parts(text: str) -> list[tuple[int, str]]:
    """Split at the commas outside parentheses, each part with its offset.

    All of it may stand in square brackets.
    """
    if re.fullmatch(r"\s*\[[^\[\]]*\]\s*", text):
        text = text.replace("[", " ").replace("]", " ")
    parts: list[tuple[int, str]] = []
    start = depth = 0
    for offset, character in enumerate(text):
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append((start, text[start:offset]))
            start = offset + 1
    return [*parts, (start, text[start:])]
