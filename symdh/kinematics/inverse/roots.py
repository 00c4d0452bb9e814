"""Real angles at which a trigonometric polynomial vanishes."""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Mapping
from math import pi

_ROUNDS = 200
#: How far from the unit circle a root may lie that two real ones have met at.
_MARGIN = 2e-4


def real_angles(coefficients: Mapping[int, complex]) -> list[float]:
    """Return the angles y in [-pi, pi) with ``sum f_k e^(i k y) = 0``, sorted.

    Parameters
    ----------
    coefficients : mapping of int to complex
        f_k, with f_-k the conjugate of f_k.

    Returns
    -------
    list of float
        A double root may come twice; a pair of complex roots that is nearly real comes as well,
        and what uses the angles has to check them.
    """
    largest = max((abs(x) for x in coefficients.values()), default=0.0)
    if not largest:
        return []
    degree = max(abs(k) for k, x in coefficients.items() if abs(x) > 1e-15 * largest)
    if not degree:
        return []
    polynomial = [complex(coefficients.get(k, 0)) for k in range(-degree, degree + 1)]
    angles = []
    for root in _roots(polynomial):
        size = abs(root)
        if size and abs(size - 1) < _MARGIN:
            angles.append(_polished(coefficients, phase(root)))
    return sorted(angles)


def _roots(polynomial: list[complex]) -> list[complex]:
    """Return the roots of a polynomial, lowest power first (Durand & Kerner)."""
    lead = polynomial[-1]
    monic = [x / lead for x in polynomial]
    degree = len(monic) - 1
    roots = [1.1 * exp(2j * pi * (k + 0.35) / degree) for k in range(degree)]
    for _ in range(_ROUNDS):
        moved = 0.0
        for k, root in enumerate(roots):
            value = 0j
            for x in reversed(monic):
                value = value * root + x
            below = 1 + 0j
            for other_place, other in enumerate(roots):
                if other_place != k:
                    below *= root - other
            if not below:
                below = 1e-30 + 0j
            step = value / below
            roots[k] = root - step
            moved = max(moved, abs(step))
        if moved < 1e-15:
            break
    return roots


def _polished(coefficients: Mapping[int, complex], angle: float) -> float:
    """Improve a real angle by a few steps of Newton's method, where they make it better."""
    best, least = angle, abs(_value(coefficients, angle)[0])
    for _ in range(3):
        value, slope = _value(coefficients, best)
        if not slope:
            break
        trial = best - value / slope
        size = abs(_value(coefficients, trial)[0])
        if size >= least:
            break
        best, least = trial, size
    return (best + pi) % (2 * pi) - pi


def _value(coefficients: Mapping[int, complex], angle: float) -> tuple[float, float]:
    value = slope = 0.0
    for k, x in coefficients.items():
        term = x * exp(1j * k * angle)
        value += term.real
        slope += (1j * k * term).real
    return value, slope
