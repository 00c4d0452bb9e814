"""The functions that an expression may call, with what they take and give."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from sympy import Abs, Expr, acos, asin, atan, atan2, cos, sin, sqrt, tan

from symdh.robot import Units
from symdh.table.lexer import ExpressionError
from symdh.table.quantity import Quantity, checked, constant_or_rest, resolve
from symdh.table.units import ANGLE, NUMBER, Dimension

_OF_AN_ANGLE: dict[str, Callable[[Expr], Expr]] = {"sin": sin, "cos": cos, "tan": tan}
_TO_AN_ANGLE: dict[str, Callable[[Expr], Expr]] = {"asin": asin, "acos": acos, "atan": atan}


def apply(
    name: str, arguments: Sequence[Quantity], units: Units, offset: int
) -> tuple[Quantity, str]:
    """Apply the function `name`, which stands at `offset`.

    Returns
    -------
    value : Quantity
    remark : str
        A warning about ``arguments[0].start``, or ``""``.

    Raises
    ------
    ExpressionError
        When the number of arguments, what they measure, or the value is wrong.
    """
    wanted = 2 if name == "atan2" else 1
    if len(arguments) != wanted:
        noun = "argument" if wanted == 1 else "arguments"
        raise ExpressionError(offset, f"{name} takes {wanted} {noun}, and got {len(arguments)}")
    first = arguments[0]
    if name in _OF_AN_ANGLE:
        return _of_an_angle(name, first, units, offset)
    if name in _TO_AN_ANGLE:
        return _to_an_angle(name, first, offset), ""
    if name == "atan2":
        return _atan2(first, arguments[1], offset), ""
    if name == "sqrt":
        return _sqrt(first, offset), ""
    return _abs(first, offset), ""


def _of_an_angle(name: str, argument: Quantity, units: Units, offset: int) -> tuple[Quantity, str]:
    if argument.dimension not in (None, ANGLE):
        raise ExpressionError(offset, f"{name} takes an angle, and this is {argument.dimension}")
    angle, remark = resolve(argument, ANGLE, units)
    return constant_or_rest(checked(_OF_AN_ANGLE[name](angle), offset), NUMBER, offset), remark


def _to_an_angle(name: str, argument: Quantity, offset: int) -> Quantity:
    if argument.dimension is not None:
        raise ExpressionError(offset, f"{name} takes a number, and this is {argument.dimension}")
    return Quantity(rest=checked(_TO_AN_ANGLE[name](argument.total), offset), dimension=ANGLE)


def _atan2(y: Quantity, x: Quantity, offset: int) -> Quantity:
    if None not in (y.dimension, x.dimension) and y.dimension != x.dimension:
        raise ExpressionError(offset, f"atan2 of {y.dimension} and {x.dimension}")
    if y.total.is_zero and x.total.is_zero:
        raise ExpressionError(offset, "value is not finite: atan2(0, 0)")
    return Quantity(rest=checked(atan2(y.total, x.total), offset), dimension=ANGLE)


def _sqrt(argument: Quantity, offset: int) -> Quantity:
    dimension = argument.dimension and argument.dimension.to_power(Fraction(1, 2))
    return _homogeneous(sqrt(argument.total), argument, dimension, offset)


def _abs(argument: Quantity, offset: int) -> Quantity:
    return _homogeneous(Abs(argument.total), argument, argument.dimension, offset)


def _homogeneous(
    value: Expr, argument: Quantity, dimension: Dimension | None, offset: int
) -> Quantity:
    """Return a root or an absolute value: a bare number of a bare number."""
    checked(value, offset)
    if argument.is_number:
        return Quantity(bare=value, start=offset)
    mixed_at = offset if argument.is_mixed else argument.mixed_at
    return Quantity(rest=value, dimension=dimension, start=offset, mixed_at=mixed_at)
