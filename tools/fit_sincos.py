"""Fit the polynomials of the sine and cosine that the generated C inlines.

    python tools/fit_sincos.py            # writes symdh/codegen/minimax.py
    python tools/fit_sincos.py --check    # compares with it; exit status 1 if unlike

An angle is reduced to r = x - k pi/2, |r| <= pi/4, and with z = r**2

    sin r = r + r z (S0 + S1 z + ...),    cos r = 1 - z/2 + z**2 (C0 + C1 z + ...).

The polynomials are minimax: Remez' exchange at 60 digits, for the relative error of the sine and
the absolute error of the cosine. Coefficients are rounded one after the other, the lowest first,
and the rest is fitted again each time, so that the rounding of one is made good by the others.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mpmath
from mpmath import mp, mpf

mp.dps = 60

TARGET = Path(__file__).resolve().parent.parent / "symdh" / "codegen" / "minimax.py"

#: Bits of the significand, coefficients of each polynomial, bits of the first parts of pi/2.
FORMATS = {"DOUBLE": (53, 6, 6, 33), "FLOAT": (24, 3, 3, 15)}


@dataclass(frozen=True)
class Problem:
    """Find P of some degree that makes the largest abs(weight(z) (target(z) - P(z))) least."""

    target: Callable[[Any], Any]
    weight: Callable[[Any], Any]
    end: Any


def sine(end: Any) -> Problem:
    """Return the problem of S: relative error of r + r z S(z)."""
    return Problem(
        target=lambda z: (mpmath.sin(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z,
        weight=lambda z: z * mpmath.sqrt(z) / mpmath.sin(mpmath.sqrt(z)),
        end=end,
    )


def cosine(end: Any) -> Problem:
    """Return the problem of C: absolute error of 1 - z/2 + z**2 C(z)."""
    return Problem(
        target=lambda z: (mpmath.cos(mpmath.sqrt(z)) - 1 + z / 2) / z**2,
        weight=lambda z: z**2,
        end=end,
    )


def remez(problem: Problem, fixed: list[Any], count: int) -> tuple[list[Any], Any]:
    """Fit the coefficients behind `fixed`, `count` in all; return those and the largest error."""
    first = len(fixed)
    unknowns = count - first
    # Chebyshev points, kept off z = 0, where target and weight are 0/0.
    points = [
        problem.end * (1 - mpmath.cos(mpmath.pi * (2 * i + 1) / (2 * unknowns + 2))) / 2
        for i in range(unknowns + 1)
    ]
    coefficients: list[Any] = []
    for _ in range(30):
        rows, values = [], []
        for i, z in enumerate(points):
            rest = problem.target(z) - mpmath.polyval(fixed[::-1] or [0], z)
            powers = [z**k for k in range(first, count)]
            rows.append([*powers, (-1) ** i / problem.weight(z)])
            values.append(rest)
        *coefficients, level = mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(values))
        found, largest = extrema(problem, [*fixed, *coefficients], unknowns + 1)
        points = found
        if largest <= abs(level) * (1 + mpf(10) ** -6):
            break
    return coefficients, largest


def error_at(problem: Problem, coefficients: list[Any], z: Any) -> Any:
    """Return the weighted error at a point."""
    return problem.weight(z) * (problem.target(z) - mpmath.polyval(coefficients[::-1], z))


def extrema(problem: Problem, coefficients: list[Any], wanted: int) -> tuple[list[Any], Any]:
    """Return the points where the error is largest in turn, and the largest error."""
    grid = [problem.end * (mpf(i) / 2000) ** 2 for i in range(20, 2001)]
    errors = [error_at(problem, coefficients, z) for z in grid]
    peaks: list[tuple[Any, Any]] = []
    for z, error in zip(grid, errors, strict=True):
        if peaks and (peaks[-1][1] > 0) == (error > 0):
            if abs(error) > abs(peaks[-1][1]):
                peaks[-1] = (z, error)
        else:
            peaks.append((z, error))
    # Rounded leading coefficients leave small ripples near zero: the largest run is what counts.
    while len(peaks) > wanted:
        peaks.pop(0 if abs(peaks[0][1]) < abs(peaks[-1][1]) else -1)
    if len(peaks) < wanted:
        raise SystemExit("the exchange lost a point: more digits or a finer grid are needed")
    return [z for z, _ in peaks], max(abs(error) for _, error in peaks)


def rounded(value: Any, bits: int) -> Any:
    """Round a number to so many bits."""
    with mpmath.workprec(bits):
        return +value


def fit(problem: Problem, count: int, bits: int) -> tuple[list[Any], Any]:
    """Fit all coefficients, each a number of the format, and say the largest error that is left."""
    fixed: list[Any] = []
    for _ in range(count):
        coefficients, _error = remez(problem, fixed, count)
        fixed.append(rounded(coefficients[0], bits))
    grid = (problem.end * mpf(i) / 4000 for i in range(1, 4001))
    return fixed, max(abs(error_at(problem, fixed, z)) for z in grid)


def parts_of_half_pi(bits: int, short: int) -> list[Any]:
    """Split pi/2 into three: products of the first two with a small integer are exact."""
    rest, parts = mpmath.pi / 2, []
    for width in (short, short, bits):
        exponent = mpmath.floor(mpmath.log(abs(rest), 2))
        # Cut off, not rounded: all parts are positive.
        cut = bits if width == bits else width
        scale = mpf(2) ** (cut - 1 - exponent)
        parts.append(rounded(rest, bits) if width == bits else mpmath.floor(rest * scale) / scale)
        rest -= parts[-1]
    return parts


def module_text() -> str:
    """Return symdh/codegen/minimax.py."""
    lines = [
        '"""Coefficients of sine and cosine in generated C; tools/fit_sincos.py writes this file.',
        "",
        "For an angle x = k pi/2 + r with abs(r) <= pi/4, and z = r**2:",
        "sin r = r + r z (S0 + S1 z + ...), cos r = 1 - z/2 + z**2 (C0 + C1 z + ...).",
        '"""',
        "",
        "from __future__ import annotations",
    ]
    for name, (bits, sines, cosines, short) in FORMATS.items():
        # A little beyond pi/4: the quotient that k is rounded from is itself rounded.
        end = (mpmath.pi / 4 * (1 + mpf(2) ** -16)) ** 2
        s, s_error = fit(sine(end), sines, bits)
        c, c_error = fit(cosine(end), cosines, bits)
        parts = (
            (
                "HALF_PI",
                parts_of_half_pi(bits, short),
                f"in three; integers times a part of {short} bits are exact",
            ),
            ("SIN", s, f"relative error at most {mpmath.nstr(s_error, 2)}"),
            ("COS", c, f"error at most {mpmath.nstr(c_error, 2)}"),
        )
        for what, values, remark in parts:
            lines += ["", f"#: {remark[0].upper()}{remark[1:]}.", f"{name}_{what} = ("]
            lines += [f"    {float(value)!r}," for value in values]
            lines.append(")")
    return "\n".join(lines) + "\n"


def main() -> int:
    """Write the coefficients, or check those that are there."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only compare")
    arguments = parser.parse_args()
    text = module_text()
    if not arguments.check:
        TARGET.write_text(text, encoding="utf-8")
        return 0
    return 0 if TARGET.read_text(encoding="utf-8") == text else 1


if __name__ == "__main__":
    sys.exit(main())
