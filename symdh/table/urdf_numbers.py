"""The decimals of a URDF file: exact, and read as the multiples of pi that they stand for."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from sympy import Expr, Integer, Rational, pi, sqrt

from symdh.robot import ZERO
from symdh.table.report import Report
from symdh.table.suggest import brief
from symdh.table.xml_nodes import Attribute

TOLERANCE = Rational(1, 100_000)
"""How far from a multiple of 15 deg a decimal may be that is read as one, in radians.

1.5708 and 3.1416 are off by 3.7e-6 and 7.3e-6; 1.57 is off by 8e-4 and stays what it is.
"""

NOISE = Rational(1, 10**9)
"""Lengths below a nanometre are the rounding of whatever program wrote the file."""

MAX_DIGITS = 40
MAX_EXPONENT = 30
MIN_EXPONENT = -330
"""What a double rounds to zero; programs write their noise out to 1e-300."""

_STEPS = 12  # to half a turn: 15 deg
_MAX_TURNS = 2
_DECIMAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE]([-+]?\d+))?")
_WORD = re.compile(r"\S+")
#: How far from 1 the length of an axis may be: three digits of 0.577 or 0.707 make 8e-4.
_UNIT_ERROR = 1e-3
#: Axes along the diagonals of a cube, a square or a hexagon have the roots of such parts of 1.
_SIMPLE = 12

Reader = Callable[[str], Expr]
Triple = tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Snap:
    """A decimal that was read as something exact.

    Attributes
    ----------
    written : str
    value : Expr
    change : float
        Distance between the two, in radians or metres.
    count : int
        How often it stands in the chain.
    """

    written: str
    value: Expr
    change: float
    count: int


class NumberReader:
    """Reads the numbers of one file and remembers which of them it took for something else."""

    def __init__(self, report: Report, tolerance: Expr) -> None:
        self.report = report
        self.tolerance = tolerance
        self._snapped: dict[str, tuple[Expr, float, int]] = {}

    def snaps(self) -> tuple[Snap, ...]:
        """Return what was taken for something else, in the order of the file."""
        return tuple(Snap(text, *found) for text, found in self._snapped.items())

    # -- what a single number may be ---------------------------------------------------------------

    def plain(self, text: str) -> Expr:
        """Return a number as it is written."""
        return Rational(text)

    def length(self, text: str) -> Expr:
        """Return metres; less than a nanometre is nothing."""
        value = Rational(text)
        if 0 < abs(value) < NOISE and self.tolerance > 0:
            return self._snap(text, ZERO, float(abs(value)))
        return value

    def angle(self, text: str) -> Expr:
        """Return radians; a multiple of 15 deg where the decimal is near one."""
        value = self.bound(text)
        if value != Rational(text):
            self._snap(text, value, abs(float(value) - float(Rational(text))))
        return value

    def bound(self, text: str) -> Expr:
        """Return an angle like `angle`, one that no pose depends on."""
        value = Rational(text)
        multiple = round(float(value) / math.pi * _STEPS)
        if abs(multiple) > 2 * _MAX_TURNS * _STEPS:
            return value
        exact = Integer(multiple) * pi / _STEPS
        near = abs((exact - value).evalf(MAX_DIGITS)) <= self.tolerance
        return exact if near and self.tolerance > 0 else value

    def _snap(self, text: str, value: Expr, change: float) -> Expr:
        _, _, count = self._snapped.get(text, (value, change, 0))
        self._snapped[text] = (value, change, count + 1)
        return value

    # -- numbers at their places -------------------------------------------------------------------

    def triple(self, given: Attribute, read: Reader) -> Triple | None:
        """Return three numbers; None, and an error in the report, where they are not."""
        words = list(_WORD.finditer(given.text))
        if len(words) != 3:
            self.report.error(given.place(), f"three numbers are wanted here, not {len(words)}")
            return None
        values = [self._number(given, word.start(), word[0], read) for word in words]
        x, y, z = values
        return None if x is None or y is None or z is None else (x, y, z)

    def single(self, given: Attribute, read: Reader) -> Expr | None:
        """Return one number; None, and an error in the report, where it is none."""
        lead = len(given.text) - len(given.text.lstrip())
        return self._number(given, lead, given.text.strip(), read)

    def _number(self, given: Attribute, offset: int, text: str, read: Reader) -> Expr | None:
        reason = _why_no_number(text)
        if reason is None:
            return read(text)
        self.report.error(given.place(offset), reason)
        return None

    def unit_vector(self, vector: Triple, given: Attribute) -> Triple:
        """Return a vector brought to length 1.

        One that is off by a few rounded digits gets a warning; one that is far off is an error,
        because nobody can say what was meant.
        """
        square = sum((entry**2 for entry in vector), ZERO)
        if square == 1:
            return vector
        if square == 0:
            self.report.error(given.place(), "the axis is zero and has no direction")
            return vector
        size = sqrt(square)
        miss = abs(float(size) - 1)
        if miss > _UNIT_ERROR:
            message = f"the axis has length {float(size):.6g}, and a unit vector is wanted"
            self.report.error(given.place(), message)
        elif miss > self.tolerance:
            message = f"the axis has length {float(size):.6g}; read as a unit vector"
            self.report.warning(given.place(), message)
        return self._simple(vector, square) or (
            vector[0] / size,
            vector[1] / size,
            vector[2] / size,
        )

    def _simple(self, vector: Triple, square: Expr) -> Triple | None:
        """Return the roots of simple fractions that the entries of a unit vector stand for."""
        parts = [(entry**2 / square).limit_denominator(_SIMPLE) for entry in vector]
        x, y, z = (root_of(part, entry) for part, entry in zip(parts, vector, strict=True))
        if sum(parts, ZERO) != 1:
            return None
        for exact, entry in zip((x, y, z), vector, strict=True):
            near = abs(float(exact) - float(entry) / math.sqrt(square)) <= self.tolerance
            if not near or (exact == 0) != (entry == 0):
                return None
        return x, y, z


def root_of(part: Expr, entry: Expr) -> Expr:
    """Return the square root of `part` with the sign of `entry`."""
    return sqrt(part) if entry > 0 else -sqrt(part)


def _why_no_number(text: str) -> str | None:
    match = _DECIMAL.fullmatch(text)
    if match is None:
        if re.search(r"\$[({]", text):
            return "this is xacro; turn the file into URDF first: xacro FILE > arm.urdf"
        return f"{brief(text)} is not a number"
    if len(text) > MAX_DIGITS:
        return f"number has {len(text)} characters, over {MAX_DIGITS}"
    if match[1] and not MIN_EXPONENT <= int(match[1]) <= MAX_EXPONENT:
        return f"decimal exponent is not between {MIN_EXPONENT} and {MAX_EXPONENT}"
    return None
