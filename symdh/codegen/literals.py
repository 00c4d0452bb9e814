"""Exact numbers as floating-point literals, in the spelling that C and Python share."""

from __future__ import annotations

import math
from functools import lru_cache

from sympy import Expr, Float

from symdh.errors import UnsupportedError

#: Enough that rounding to 40 digits and then to a double is rounding to a double.
_DIGITS = 40


@lru_cache(maxsize=4096)
def nearest_double(value: Expr) -> float:
    """Return the double nearest to an exact number.

    Raises
    ------
    UnsupportedError
        When the value is not a real number, passes the range of a double, or is not exact.
    """
    if value.has(Float):
        raise UnsupportedError(f"{value} is not exact; symdh computes with exact numbers")
    try:
        number = value.p / value.q if value.is_Rational else float(value.evalf(_DIGITS))
    except (TypeError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise UnsupportedError(f"{value} is not a real number that a double can hold")
    return number


def literal(value: Expr) -> str:
    """Write the double nearest to an exact number with the fewest digits that give it back.

    The literal is always floating: ``2.0``, ``0.4318``, ``1.0e30``.

    Raises
    ------
    UnsupportedError
        As `nearest_double`.
    """
    mantissa, _, exponent = repr(nearest_double(value)).partition("e")
    if "." not in mantissa:
        mantissa += ".0"
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa
