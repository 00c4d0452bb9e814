"""Trigonometric polynomials of one angle as polynomials in z = e^(i angle) and 1/z.

``c = (z + 1/z) / 2`` and ``s = (z - 1/z) / (2 i)``. What is zero at a real angle is zero at a
point of the unit circle, angles of 180 degrees included, where the tangent of the half angle is
infinite. It works in any field that has a square root of -1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from symdh.kinematics.inverse.ring import Element

#: Coefficients by the power of z.
Laurent = dict[int, Any]

Evaluate = Callable[[tuple[int, ...], Any], Any]


def laurent(element: Element, angle: int, term: Evaluate, half: Any, imaginary: Any) -> Laurent:
    """Write an element by powers of z.

    Parameters
    ----------
    element : Element
    angle : int
        Its number in the ring.
    term : callable
        Gives the value of a monomial with its coefficient, all other letters put in.
    half, imaginary : number
        1/2 and a square root of -1.
    """
    cosine: Laurent = {1: half, -1: half}
    sine: Laurent = {1: -half * imaginary, -1: half * imaginary}
    c, s = 2 * angle, 2 * angle + 1
    total: Laurent = {}
    for powers, coefficient in element.terms():
        rest = (*powers[:c], 0, 0, *powers[s + 1 :])
        part: Laurent = {0: term(rest, coefficient)}
        for factor, times in ((cosine, powers[c]), (sine, powers[s])):
            for _ in range(times):
                part = product(part, factor)
        total = added(total, part)
    return total


def product(a: Mapping[int, Any], b: Mapping[int, Any]) -> Laurent:
    """Return the product of two."""
    total: Laurent = {}
    for i, x in a.items():
        for j, y in b.items():
            total[i + j] = total.get(i + j, 0) + x * y
    return total


def added(a: Mapping[int, Any], b: Mapping[int, Any], factor: Any = 1) -> Laurent:
    """Return a + factor b."""
    total = dict(a)
    for k, x in b.items():
        total[k] = total.get(k, 0) + factor * x
    return total


def eliminated(coefficients: tuple[Laurent, ...], scales: tuple[Any, ...]) -> Laurent:
    """Return what is left of two equations ``A s + B c + C = 0`` in another angle.

    Parameters
    ----------
    coefficients : six Laurent
        A_1, B_1, C_1, A_2, B_2, C_2.
    scales : tuple
        l_1 and l_2 of Pieper's combination, or empty for Cramer's rule.
    """
    a_1, b_1, c_1, a_2, b_2, c_2 = coefficients
    if scales:
        square_1, square_2 = scales[0] * scales[0], scales[1] * scales[1]
        left = added({}, product(c_1, c_1), square_2)
        left = added(left, product(c_2, c_2), square_1)
        lengths = added(product(a_1, a_1), product(b_1, b_1))
        return added(left, lengths, -square_2)
    sine = added(product(b_1, c_2), product(b_2, c_1), -1)
    cosine = added(product(a_2, c_1), product(a_1, c_2), -1)
    determinant = added(product(a_1, b_2), product(a_2, b_1), -1)
    squares = added(product(sine, sine), product(cosine, cosine))
    return added(squares, product(determinant, determinant), -1)
