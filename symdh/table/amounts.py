"""Amounts of a table with numbers for their symbols: real, and of bearable size."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sympy import Expr, Integer, Pow, Symbol

from symdh.errors import UnsupportedError
from symdh.robot import Robot
from symdh.table.cells import Cell
from symdh.table.extent import extent
from symdh.table.quantity import NOT_FINITE
from symdh.table.report import Report

MAX_VALUE_BITS = 14_000
"""How long a number may become: about what Python still prints, 4,300 digits."""
MAX_VALUE = Integer(10) ** 77
"""About as large as a number can be that is written in a table."""


def with_values(amount: Expr, known: Mapping[Symbol, Expr]) -> Expr:
    """Put numbers in for the symbols of an amount.

    Parameters
    ----------
    amount : sympy.Expr
    known : mapping of Symbol to Expr
        Real numbers. Symbols that are not among them stay, as real ones.

    Raises
    ------
    UnsupportedError
        When the result is infinite, complex, too large or too long.
    """
    if amount.free_symbols.isdisjoint(known):
        return amount
    if _bits(amount, known) > MAX_VALUE_BITS:
        raise UnsupportedError(
            f"these values make {amount} a number of over {MAX_VALUE_BITS:,} bits"
        )
    found = amount.xreplace(dict(known))
    # Of sqrt(sin(x)^2 + cos(x)^2 - 1) the digits alone tell that it is real.
    number = found if found.free_symbols else digits_of(found, 15)
    too_large = number.is_number and number.is_finite and abs(number) > MAX_VALUE
    infinite = found.has(*NOT_FINITE) or number.has(*NOT_FINITE)
    if infinite or (too_large and _divides_by_nothing(found)):
        raise UnsupportedError(f"these values make {amount} infinite: a division by zero")
    if number.is_real is False:
        raise UnsupportedError(
            f"these values make {amount} equal to {found}, which is not a real number"
        )
    if too_large:
        raise UnsupportedError(
            f"these values make {amount} equal to {number.evalf(3)!s}, over the limit of 1e77"
        )
    return found


def digits_of(number: Expr, count: int) -> Expr:
    """Return a number in digits, without an imaginary part that rounding has left.

    Chopped is the result alone: on the way it would make nothing of ``tan(1e-30)``, and something
    infinite of 1 divided by it.
    """
    return number.evalf(count).evalf(count, chop=True)


def _divides_by_nothing(amount: Expr) -> bool:
    """Say whether something is divided by what is zero, but for sympy to see it."""
    powers = amount.atoms(Pow)
    return any(p.exp.is_negative and not digits_of(p.base, 15) for p in powers)


def check_settings(robot: Robot, settings: Mapping[Symbol, Expr]) -> None:
    """Check the amounts of an arm with the numbers that a user sets.

    Raises
    ------
    UnsupportedError
        As in `with_values`.
    """
    known = {**robot.values, **settings}
    for amount in robot.amounts:
        if not amount.free_symbols.isdisjoint(settings):
            with_values(amount, known)


def refuse_values(cells: Iterable[Cell], values: Mapping[Symbol, Expr], report: Report) -> None:
    """Note the cells that the values of their own table make no numbers of."""
    for cell in cells:
        try:
            with_values(cell.value, values)
        except UnsupportedError as problem:
            report.error(cell.place, str(problem))


def _bits(amount: Expr, known: Mapping[Symbol, Expr]) -> int:
    """Return how long an amount may become with numbers in it, a bound."""

    def of_leaf(leaf: Expr) -> int:
        if leaf.is_Symbol:
            return _bits(known[leaf], {}) if leaf in known else 0
        return int(leaf.p).bit_length() + int(leaf.q).bit_length() if leaf.is_Rational else 0

    return extent(amount, of_leaf)
