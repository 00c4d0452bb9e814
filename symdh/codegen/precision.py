"""The two kinds of floating-point number that C computes with, and what depends on the kind."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from sympy import Expr

from symdh.codegen import minimax
from symdh.codegen.literals import literal, nearest_double
from symdh.errors import UnsupportedError


@dataclass(frozen=True)
class Precision:
    """A kind of floating-point number in C.

    Attributes
    ----------
    name : str
        The type.
    suffix : str
        What functions of <math.h> and literals end with.
    bits : int
        Bits of the significand, the hidden one included.
    limit : float
        Angles up to here are reduced exactly: k, their quotient by pi/2, times the first two parts
        of pi/2 does not round.
    half_pi, sine, cosine : tuple of float
        Parts of pi/2 and coefficients (see `symdh.codegen.minimax`).
    """

    name: str
    suffix: str
    bits: int
    limit: float
    half_pi: tuple[float, ...]
    sine: tuple[float, ...]
    cosine: tuple[float, ...]

    @property
    def epsilon(self) -> float:
        """Distance from 1 to the next number."""
        return float(2.0 ** (1 - self.bits))

    def literal(self, value: Expr) -> str:
        """Write an exact number as a literal of this kind (see `symdh.codegen.literals`).

        Raises
        ------
        UnsupportedError
            When it is no number that this kind can hold.
        """
        if not self.suffix:
            return literal(value)
        try:
            return self.number(nearest_double(value))
        except OverflowError:
            raise UnsupportedError(f"{value} is too large for a float") from None

    def number(self, value: float) -> str:
        """Write the nearest number of this kind with the fewest digits that give it back."""
        text = shortest_single(value) if self.suffix else repr(value)
        mantissa, _, exponent = text.partition("e")
        if "." not in mantissa:
            mantissa += ".0"
        return (f"{mantissa}e{int(exponent)}" if exponent else mantissa) + self.suffix


def single(value: float) -> float:
    """Round a number to single precision.

    Raises
    ------
    OverflowError
        When it is too large for that.
    """
    rounded: float = struct.unpack("<f", struct.pack("<f", value))[0]
    return rounded


def shortest_single(value: float) -> str:
    """Write the nearest float with the fewest digits that give it back."""
    rounded = single(value)
    # Nine digits always do.
    digits = next(d for d in range(1, 10) if single(float(f"{rounded:.{d}g}")) == rounded)
    return repr(float(f"{rounded:.{digits}g}"))


DOUBLE = Precision(
    "double",
    "",
    53,
    1.0e6,
    minimax.DOUBLE_HALF_PI,
    minimax.DOUBLE_SIN,
    minimax.DOUBLE_COS,
)
FLOAT = Precision(
    "float",
    "f",
    24,
    500.0,
    minimax.FLOAT_HALF_PI,
    minimax.FLOAT_SIN,
    minimax.FLOAT_COS,
)
PRECISIONS = {precision.name: precision for precision in (DOUBLE, FLOAT)}
