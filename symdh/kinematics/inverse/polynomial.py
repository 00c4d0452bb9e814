"""Elements of a ring with numbers for their coefficients."""

from __future__ import annotations

from collections.abc import Sequence

from symdh.kinematics.inverse.ring import Element


class Polynomial:
    """An element that is evaluated often.

    Parameters
    ----------
    element : Element
    constants : sequence of float or None
        The values of letters that never change; None for the others.

    Attributes
    ----------
    size : float
        What it could be at most if every cosine and sine were 1: the scale of its zeros.
    """

    def __init__(self, element: Element, constants: Sequence[float | None]) -> None:
        self.terms = [
            (
                int(c.numerator) / int(c.denominator),
                tuple((k, power) for k, power in enumerate(powers) if power),
            )
            for powers, c in element.terms()
        ]
        self.size = 0.0
        for coefficient, factors in self.terms:
            size = abs(coefficient)
            for k, power in factors:
                known = constants[k]
                size *= 1.0 if known is None else abs(known) ** power
            self.size += size

    def __call__(self, letters: Sequence[float]) -> float:
        """Return the value."""
        total = 0.0
        for coefficient, factors in self.terms:
            for k, power in factors:
                coefficient *= letters[k] if power == 1 else letters[k] ** power
            total += coefficient
        return total
