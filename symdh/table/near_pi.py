"""Common angles in words, and decimals that stand for one of them, such as 1.5708 for pi/2."""

from __future__ import annotations

import math
from dataclasses import dataclass

from sympy import Expr, Rational

CLOSE = 2e-3
"""How far a decimal may be from the angle that it seems to stand for, in radians."""

_DENOMINATORS = (1, 2, 3, 4, 6)
_LARGEST = 4  # times pi: two turns


@dataclass(frozen=True, slots=True)
class NearMultiple:
    """A common angle near a decimal.

    Attributes
    ----------
    multiple : sympy.Rational
        The angle divided by pi.
    difference : float
        Distance between the angle and the decimal, in radians.
    """

    multiple: Rational
    difference: float

    @property
    def name(self) -> str:
        """The angle as a multiple of pi: ``pi/2``."""
        return pi_text(self.multiple)

    @property
    def exact(self) -> str:
        """The angle as one would write it: ``pi/2 or 90 deg``."""
        return f"{self.name} or {self.multiple * 180} deg"

    @property
    def difference_text(self) -> str:
        """The distance with two digits: ``3.7e-6``."""
        digits, exponent = f"{self.difference:.1e}".split("e")
        return f"{digits}e{int(exponent)}"


def near_multiple(number: Expr) -> NearMultiple | None:
    """Return the multiple of pi, pi/2, pi/3, pi/4 or pi/6 within `CLOSE` of a decimal, if any.

    Integers and angles beyond two turns are never taken for one.
    """
    if not number.is_Rational or number.is_Integer:
        return None
    value = float(number)
    for denominator in _DENOMINATORS:
        count = round(value / math.pi * denominator)
        difference = abs(count * math.pi / denominator - value)
        if count and difference < CLOSE and abs(count) <= _LARGEST * denominator:
            return NearMultiple(Rational(count, denominator), difference)
    return None


def pi_text(multiple: Rational) -> str:
    """Write a rational multiple of pi: ``pi/2``, ``-3*pi/4``."""
    sign = "-" if multiple < 0 else ""
    factor = "" if abs(multiple.p) == 1 else f"{abs(multiple.p)}*"
    divisor = "" if multiple.q == 1 else f"/{multiple.q}"
    return f"{sign}{factor}pi{divisor}"


def angle_in_words(number: Expr) -> str:
    """Say how a bare number could be written as an angle: ``90 deg or pi/2``."""
    if not number.is_Rational:
        return "it with deg or rad"
    written = str(number) if number.is_Integer else f"({number})"
    if abs(number) <= 360 and number % 15 == 0:
        return f"{written} deg or {pi_text(number / 180)}"
    return f"{written} deg or {written} rad"
