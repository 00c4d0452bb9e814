"""Exact quantities whose bare numbers are still waiting for a unit.

A bare number in a table means different things in different places: in `theta1 + 90` it is an
angle in the table's unit, in `2*theta1` a factor. So a quantity keeps the sum of its bare numbers
apart from the rest until its place says what is measured there (`resolve`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from sympy import AccumBounds, Expr, I, Integer, Rational, nan, oo, pi, zoo

from symdh.robot import AngleUnit, LengthUnit, Units
from symdh.table.lexer import ExpressionError
from symdh.table.near_pi import angle_in_words, near_multiple, pi_text
from symdh.table.units import (
    ANGLE,
    ANGLE_UNITS,
    LENGTH,
    LENGTH_UNITS,
    NUMBER,
    Dimension,
    convert_length,
    radians,
)

MAX_BITS = 256
MAX_EXPONENT = 32
MAX_ROOT = 8

ZERO = Integer(0)
#: What a division by zero leaves in an expression; an arctangent makes bounds of it.
NOT_FINITE = (zoo, nan, oo, -oo, AccumBounds)


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value on its way from text to an exact expression.

    Attributes
    ----------
    bare : sympy.Expr
        Sum of the numbers written without a unit; no symbol stands in it.
    rest : sympy.Expr
        Everything else: radians, lengths in the table's unit, symbols, pi.
    dimension : Dimension or None
        What `rest` measures; None when there is no rest, or symbols or pi leave it open.
    start : int
        Offset of the bare part in the text.
    mixed_at : int or None
        Offset of an operation that multiplied a bare number standing beside a symbol, as in
        ``k*(theta1 + 90)``: nothing tells whether the number is an angle or a factor.
    """

    bare: Expr = ZERO
    rest: Expr = ZERO
    dimension: Dimension | None = None
    start: int = 0
    mixed_at: int | None = None

    @property
    def total(self) -> Expr:
        """Both parts together, bare numbers taken as they stand."""
        return self.bare + self.rest

    @property
    def is_number(self) -> bool:
        """Whether this is a plain number: no unit, no symbol, no pi."""
        return self.rest == 0 and self.dimension is None

    @property
    def is_mixed(self) -> bool:
        """Whether a bare number stands beside something else."""
        return self.bare != 0 and not self.is_number


def add(left: Quantity, right: Quantity, offset: int) -> Quantity:
    """Add two quantities; the operator stands at `offset`."""
    dimension = left.dimension or right.dimension
    if right.dimension not in (None, dimension):
        raise ExpressionError(offset, f"cannot add {left.dimension} and {right.dimension}")
    return Quantity(
        bare=checked(left.bare + right.bare, offset),
        rest=checked(left.rest + right.rest, offset),
        dimension=dimension,
        start=left.start if left.bare != 0 else right.start,
        mixed_at=_first(left.mixed_at, right.mixed_at),
    )


def negate(quantity: Quantity, offset: int) -> Quantity:
    """Change the sign of a quantity; the sign stands at `offset`."""
    return replace(quantity, bare=-quantity.bare, rest=-quantity.rest, start=offset)


def multiply(left: Quantity, right: Quantity, offset: int) -> Quantity:
    """Multiply two quantities; the operator stands at `offset`."""
    if left.is_number:
        return replace(_scaled(right, left.bare, offset), start=left.start)
    if right.is_number:
        return _scaled(left, right.bare, offset)
    dimension = _sum_of_powers(left.dimension, right.dimension)
    mixed_at = offset if left.is_mixed or right.is_mixed else None
    return _product(
        checked(left.total * right.total, offset),
        dimension,
        left.start,
        _first(left.mixed_at, right.mixed_at, mixed_at),
    )


def divide(left: Quantity, right: Quantity, offset: int) -> Quantity:
    """Divide two quantities; the operator stands at `offset`."""
    if right.total.is_zero:
        raise ExpressionError(offset, "division by zero")
    if right.is_number:
        return _scaled(left, 1 / right.bare, offset)
    inverse = replace(right, bare=ZERO, rest=1 / right.total, dimension=_inverse(right.dimension))
    product = multiply(left, inverse, offset)
    return replace(product, mixed_at=offset) if right.is_mixed else product


def power(base: Quantity, exponent: Quantity, offset: int) -> Quantity:
    """Raise a quantity to a constant power; the operator stands at `offset`."""
    if not (exponent.is_number and exponent.bare.is_Rational):
        raise ExpressionError(offset, "exponent must be a constant number")
    n = exponent.bare
    if abs(n.p) > MAX_EXPONENT or n.q > MAX_ROOT:
        message = f"exponent is over the limit of {MAX_EXPONENT}, or a root over {MAX_ROOT}"
        raise ExpressionError(offset, message)
    total = base.total
    if total.is_zero and n < 0:
        raise ExpressionError(offset, "division by zero")
    if total.is_Rational and _bits(total) * abs(n.p) > 4 * MAX_BITS:
        raise ExpressionError(offset, f"value is over the limit of {MAX_BITS} bits")
    result = checked(total**n, offset)
    if base.is_number:
        return replace(base, bare=result)
    dimension = base.dimension and base.dimension.to_power(Fraction(n.p, n.q))
    mixed_at = offset if base.is_mixed else base.mixed_at
    return _product(result, dimension, base.start, mixed_at)


def with_unit(number: Quantity, unit: str, units: Units, offset: int) -> Quantity:
    """Attach the unit named `unit` to a number that starts at `offset`."""
    if not number.is_number:
        raise _unit_on_no_number(number, unit, offset)
    if unit in ANGLE_UNITS:
        return Quantity(rest=radians(number.bare, ANGLE_UNITS[unit]), dimension=ANGLE)
    target = units.length or LengthUnit.METRE
    amount = convert_length(number.bare, LENGTH_UNITS[unit], target)
    return Quantity(rest=amount, dimension=LENGTH)


def constant_or_rest(value: Expr, dimension: Dimension | None, start: int) -> Quantity:
    """Return the value of a function: a bare number when it is a constant without dimension."""
    if dimension in (None, NUMBER) and not value.free_symbols:
        return Quantity(bare=value, start=start)
    return Quantity(rest=value, dimension=None if dimension == NUMBER else dimension, start=start)


def measured_in(quantity: Quantity, unit: LengthUnit, units: Units) -> Quantity:
    """Take the bare numbers of a length for numbers of `unit`, in a table with `units`.

    Raises
    ------
    ExpressionError
        When a bare number is part of a product, and could be a length or a factor.
    """
    target = units.length or LengthUnit.METRE
    if unit is target:
        return quantity
    if quantity.mixed_at is not None:
        message = f"write the unit of this product's numbers; the table is in {target.value}"
        raise ExpressionError(quantity.mixed_at, message)
    rest = quantity.rest
    if quantity.dimension is None and not rest.free_symbols:
        rest = convert_length(rest, unit, target)
    return replace(quantity, bare=convert_length(quantity.bare, unit, target), rest=rest)


def resolve(quantity: Quantity, wanted: Dimension | None, units: Units) -> tuple[Expr, str]:
    """Give the bare numbers the unit that they have where `wanted` is measured.

    Parameters
    ----------
    quantity : Quantity
    wanted : Dimension or None
        None where nothing is known, and bare numbers are plain numbers.
    units : Units
        Those of the table.

    Returns
    -------
    value : sympy.Expr
        Radians for an angle, the table's length unit for a length.
    remark : str
        A warning about ``quantity.start``, or ``""``.

    Raises
    ------
    ExpressionError
        When the quantity measures something else, or an angle has no unit.
    """
    if wanted is not None and quantity.dimension not in (None, wanted):
        raise ExpressionError(0, f"this is {quantity.dimension}, where {wanted} is wanted")
    if wanted != ANGLE:
        return quantity.total, ""
    if quantity.mixed_at is not None and units.angle is not AngleUnit.RADIAN:
        raise ExpressionError(
            quantity.mixed_at,
            "this multiplies a bare number that stands beside a symbol, and it could be an angle "
            "or a factor; give it a unit or multiply out",
        )
    if quantity.bare == 0:
        return quantity.rest, ""
    angle, remark = _bare_angle(quantity.bare, quantity.start, units.angle)
    return quantity.rest + angle, remark


def _bare_angle(bare: Expr, start: int, unit: AngleUnit | None) -> tuple[Expr, str]:
    near = near_multiple(bare)
    if unit is AngleUnit.DEGREE:
        remark = f"this is read as degrees; did you mean {near.exact}?" if near else ""
        return radians(bare, unit), remark
    if near is not None:
        remark = f"near {near.name} but not equal ({near.difference_text}); write {near.exact}"
        return bare, remark
    if unit is None:
        message = f"an angle needs a unit: write {angle_in_words(bare)}"
        raise ExpressionError(start, f"{message}, or say `units: {{angle: deg}}` in the table")
    return bare, ""


def _scaled(quantity: Quantity, factor: Expr, offset: int) -> Quantity:
    return replace(
        quantity,
        bare=checked(quantity.bare * factor, offset),
        rest=checked(quantity.rest * factor, offset),
    )


def _product(
    value: Expr, dimension: Dimension | None, start: int, mixed_at: int | None
) -> Quantity:
    """Return a product, as a bare number where all dimensions have cancelled."""
    if (dimension == NUMBER and not value.free_symbols) or (
        dimension is None and value.is_Rational
    ):
        return Quantity(bare=value, start=start)
    return Quantity(
        rest=value,
        dimension=None if dimension == NUMBER else dimension,
        start=start,
        mixed_at=mixed_at,
    )


def checked(value: Expr, offset: int) -> Expr:
    """Return `value` if it is finite, real and of bearable size, else raise at `offset`."""
    if value.has(*NOT_FINITE):
        raise ExpressionError(offset, "value is not finite (a division by zero?)")
    if value.has(I) or value.is_real is False:
        raise ExpressionError(offset, "value is not real")
    if _bits(value.as_coeff_Mul()[0]) > MAX_BITS:
        raise ExpressionError(offset, f"value is over the limit of {MAX_BITS} bits")
    return value


def _bits(number: Rational) -> int:
    return max(int(number.p).bit_length(), int(number.q).bit_length())


def _sum_of_powers(left: Dimension | None, right: Dimension | None) -> Dimension | None:
    return None if left is None or right is None else left.times(right)


def _inverse(dimension: Dimension | None) -> Dimension | None:
    return None if dimension is None else dimension.to_power(Fraction(-1))


def _first(*offsets: int | None) -> int | None:
    return min((offset for offset in offsets if offset is not None), default=None)


def _unit_on_no_number(quantity: Quantity, unit: str, offset: int) -> ExpressionError:
    if quantity.dimension is not None:
        return ExpressionError(offset, f"this already has a unit; take away one of them ({unit})")
    if quantity.rest.has(pi) and not quantity.rest.free_symbols and unit in ANGLE_UNITS:
        multiple = quantity.total / pi
        instead = f"take {unit} away"
        if multiple.is_Rational:
            instead = f"write {multiple * 180} deg or {pi_text(multiple)}"
        return ExpressionError(offset, f"pi is already radians; {instead}")
    return ExpressionError(offset, f"a unit follows a number; take {unit} away")
