"""What the template of the inlined sines and cosines is filled with."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from symdh.codegen.precision import Precision


@dataclass(frozen=True)
class Kernel:
    """Numbers and choices of the kernel, as text.

    Attributes
    ----------
    real : str
        Type of the numbers.
    takes_two, takes_four : bool
        Whether anything takes so many angles at once.
    loses : bool
        Whether any angle is a sum, whose rounding error is then taken in.
    bits : str
        An unsigned integer as wide as the number.
    sign_shift : int
        From bit 1 to the sign bit.
    wide : tuple of int
        How many poses of a batch may stand side by side, from the widest registers to the
        narrowest.
    ulps : int
        The largest error for angles up to 100 rad; tests/test_codegen_trig.py measures it.
    offset : int
        Above the quotient of any angle by pi/2.
    sine, cosine : tuple of str
        The lines of the polynomials.
    """

    real: str
    takes_two: bool
    takes_four: bool
    loses: bool
    bits: str
    sign_shift: int
    wide: tuple[int, ...]
    limit: str
    ulps: int
    shift: str
    shift_text: str
    offset: int
    two_over_pi: str
    zero: str
    half: str
    one: str
    half_pi: tuple[str, ...]
    sine: tuple[str, ...]
    cosine: tuple[str, ...]

    @property
    def remark(self) -> str:
        """Say what each angle comes with."""
        return ", each with what its sum has lost" if self.loses else ""

    def arguments(self, width: int) -> str:
        """Write the arguments of a function of so many angles."""
        names = [f"x{i}" for i in range(width)]
        if self.loses:
            names += [f"lost{i}" for i in range(width)]
        return ", ".join(f"{self.real} {name}" for name in names)

    def sum_of(self, pack: str, width: int) -> str:
        """Write the sum of the elements of a pack, by halving."""
        terms = [f"{pack}[{i}]" for i in range(width)]
        while len(terms) > 2:
            pairs = zip(terms[::2], terms[1::2], strict=True)
            terms = [f"({first} + {second})" for first, second in pairs]
        return " + ".join(terms)

    def lost(self, place: int) -> str:
        """Write what the sum of an angle has lost."""
        return f"lost{place}" if self.loses else self.zero


def kernel(precision: Precision, widths: Collection[int], *, loses: bool) -> Kernel:
    """Write the kernel of a kind of number."""
    is_double = precision.bits == 53
    number = precision.number
    return Kernel(
        real=precision.name,
        takes_two=2 in widths,
        takes_four=4 in widths,
        loses=loses,
        bits="__UINT64_TYPE__" if is_double else "__UINT32_TYPE__",
        sign_shift=62 if is_double else 30,
        wide=(8, 4, 2) if is_double else (16, 8, 4),
        limit=number(precision.limit),
        ulps=2 if is_double else 3,
        # Half of what is just too large for fractions, so that the sum stays above it.
        shift=number(1.5 * 2.0 ** (precision.bits - 1)),
        shift_text=f"1.5 * 2^{precision.bits - 1}",
        offset=2 ** math.ceil(math.log2(precision.limit)),
        two_over_pi=number(0.6366197723675814),
        zero=number(0.0),
        half=number(0.5),
        one=number(1.0),
        half_pi=tuple(map(number, precision.half_pi)),
        sine=tuple(_polynomial(precision, precision.sine)),
        cosine=tuple(_polynomial(precision, precision.cosine)),
    )


def _polynomial(precision: Precision, coefficients: Sequence[float]) -> list[str]:
    """Write a polynomial in z with pairs and zz = z**2, which takes fewer steps in a row."""
    number = precision.number
    powers = ["", "zz * ", "(zz * zz) * "]
    lines = []
    for place in range(0, len(coefficients), 2):
        pair = coefficients[place : place + 2]
        term = number(pair[0])
        if len(pair) == 2:
            term = f"({term} + (z * {number(pair[1])}))"
        power = powers[place // 2]
        plus = "+ " if place else ""
        lines.append(f"{plus}({power}{term})" if power else f"{plus}{term}")
    return lines
