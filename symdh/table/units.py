"""Units of angle and length, exact, and what a quantity measures."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from sympy import Expr, Integer, Rational, pi

from symdh.robot import AngleUnit, LengthUnit


class Dimension(NamedTuple):
    """What a quantity measures: the powers of angle and of length in it."""

    angle: Fraction
    length: Fraction

    def times(self, other: Dimension) -> Dimension:
        """Return what the product of two quantities measures."""
        return Dimension(self.angle + other.angle, self.length + other.length)

    def to_power(self, exponent: Fraction) -> Dimension:
        """Return what a power of a quantity measures."""
        return Dimension(self.angle * exponent, self.length * exponent)

    def __str__(self) -> str:
        return _DIMENSION_NAMES.get(self, "neither an angle nor a length")


NUMBER = Dimension(Fraction(0), Fraction(0))
ANGLE = Dimension(Fraction(1), Fraction(0))
LENGTH = Dimension(Fraction(0), Fraction(1))
_DIMENSION_NAMES = {NUMBER: "a number", ANGLE: "an angle", LENGTH: "a length"}

ANGLE_UNITS = {"deg": AngleUnit.DEGREE, "°": AngleUnit.DEGREE, "rad": AngleUnit.RADIAN}
LENGTH_UNITS = {unit.value: unit for unit in LengthUnit}
Unit = AngleUnit | LengthUnit
UNIT_NAMES = (*ANGLE_UNITS, *LENGTH_UNITS)

UNIT_ALIASES = {
    "degree": "deg",
    "degrees": "deg",
    "radian": "rad",
    "radians": "rad",
    "meter": "m",
    "meters": "m",
    "metre": "m",
    "metres": "m",
    "centimeter": "cm",
    "centimeters": "cm",
    "centimetre": "cm",
    "centimetres": "cm",
    "millimeter": "mm",
    "millimeters": "mm",
    "millimetre": "mm",
    "millimetres": "mm",
    "inch": "in",
    "inches": "in",
    "foot": "ft",
    "feet": "ft",
}
"""Words that people write for a unit, for the "did you mean"."""

_METRES = {
    LengthUnit.METRE: Integer(1),
    LengthUnit.CENTIMETRE: Rational(1, 100),
    LengthUnit.MILLIMETRE: Rational(1, 1000),
    LengthUnit.INCH: Rational(254, 10_000),
    LengthUnit.FOOT: Rational(3048, 10_000),
}


def radians(amount: Expr, unit: AngleUnit) -> Expr:
    """Convert `amount` of `unit` to radians, exactly."""
    return amount * pi / 180 if unit is AngleUnit.DEGREE else amount


def convert_length(amount: Expr, unit: LengthUnit, target: LengthUnit) -> Expr:
    """Convert `amount` of `unit` to `target`, exactly."""
    return amount * _METRES[unit] / _METRES[target]
