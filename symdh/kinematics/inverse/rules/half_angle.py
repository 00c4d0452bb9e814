"""Eliminate one of two angles: what is left is a polynomial in the tangent of half the other.

Two equations ``A_k s + B_k c + C_k = 0`` whose coefficients hold one other angle y: where the
directions (A_1, B_1) and (A_2, B_2) are perpendicular, and l_1 and l_2 times one length,
``(C_1 / l_1)^2 + (C_2 / l_2)^2`` is the square of that length (Pieper 1968); else Cramer's rule and
``s^2 + c^2 = 1``. With ``t = tan(y/2)`` the result is a quartic in t where it is quadratic in
the cosine and the sine of y. One that is linear in them is an equation like any other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import Any

from symdh.kinematics.inverse.point import Point
from symdh.kinematics.inverse.pool import Combination
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.rules.laurent import Laurent, eliminated, laurent
from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import State, View

#: Degree in sine and cosine: 2 gives a quartic, which still has a solution by roots.
MOST_DEGREE = 2
_MOST_EQUATIONS = 8
_LONGEST = 80

Linear = tuple[Element, Element, Element]


def eliminate(state: State) -> tuple[Step, ...]:
    """Return the step with the polynomial of lowest degree, and the one for the other angle.

    Equations that turn out linear in the other angle's sine and cosine are added to the pool
    instead, and nothing is returned.
    """
    best: tuple[tuple[int, int], Step] | None = None
    added = False
    for x, y, (first, view_1), (second, view_2) in _pairs(state):
        parents = view_1.equation, view_2.equation
        determinant = state.ring.reduced(first[0] * second[1] - second[0] * first[1])
        if not determinant:
            element = _difference(state, first, second)
            if _degree(state, y, (element,), ()) == 1 and len(element) <= _LONGEST:
                source = replace(parents[0].source, entries=(), inverted=False)
                made = Combination.DIFFERENCE
                added |= state.pool.add(element, source, (), parents, made) is not None
        if state.vanishes(determinant):
            continue
        scales = _scales(y, first, second)
        degree = _degree(state, y, (*first, *second), scales)
        size = sum(map(len, (*first, *second)))
        if 0 < degree <= MOST_DEGREE and (best is None or (degree, size) < best[0]):
            step = Step(
                y,
                Rule.HALF_ANGLE,
                (view_1.used, view_2.used),
                (*first, *second),
                branches=2 * degree,
                eliminated=x,
                scales=scales,
            )
            best = (degree, size), step
    if added or best is None:
        return ()
    step = best[1]
    assert step.eliminated is not None
    other = Step(step.eliminated, Rule.PAIR, step.equations, step.coefficients)
    return step, other


def _degree(
    state: State, y: int, elements: tuple[Element, ...], scales: tuple[Element, ...]
) -> int:
    """Return the degree in cosine and sine of y of what elimination leaves, 0 for nothing."""
    degrees = []
    for point in state.points:
        parts = tuple(_at(point, element, y) for element in elements)
        left = parts[0]
        if len(parts) == 6:
            left = eliminated(parts, tuple(point.value(scale) for scale in scales))
        degrees.append(max((abs(k) for k, x in left.items() if x % point.prime), default=0))
    return min(degrees)


def _at(point: Point, element: Element, y: int) -> Laurent:
    """Write an element by powers of e^(iy), all else having the values of a point."""

    def term(powers: tuple[int, ...], coefficient: Any) -> int:
        return point.term(powers, coefficient)

    half = pow(2, -1, point.prime)
    found = laurent(element, y, term, half, point.imaginary)
    return {k: x % point.prime for k, x in found.items()}


def _pairs(
    state: State,
) -> Iterator[tuple[int, int, tuple[Linear, View], tuple[Linear, View]]]:
    """Yield x, y and two equations in these two angles alone, linear in x."""
    by_unknowns: dict[frozenset[int], list[View]] = {}
    for view in state.views:
        open_now = state.open(view.support)
        if len(open_now) == 2 and all(state.ring.is_angle(k) for k in open_now):
            by_unknowns.setdefault(open_now, []).append(view)
    for unknowns, views in by_unknowns.items():
        views.sort(key=lambda view: len(view.element))
        for x in sorted(unknowns):
            (y,) = unknowns - {x}
            linear = []
            for view in views[:_MOST_EQUATIONS]:
                parts = state.linear(view.element, x)
                if parts is not None:
                    linear.append((parts, view))
            for first, second in combinations(linear, 2):
                yield x, y, first, second


def _difference(state: State, first: Linear, second: Linear) -> Element:
    """Subtract two equations in which x stands in the same way: x drops out."""
    (a_1, b_1, c_1), (a_2, b_2, c_2) = first, second
    return state.ring.reduced(a_1 * c_2 - a_2 * c_1 if a_1 and a_2 else b_1 * c_2 - b_2 * c_1)


def _scales(y: int, first: Linear, second: Linear) -> tuple[Element, ...]:
    """Return l_1 and l_2, free of y, where Pieper's combination serves, else nothing."""
    (a_1, b_1, _), (a_2, b_2, _) = first, second
    if not (a_1 and b_1 and a_2 and b_2):
        return ()
    l_1, (p_1, q_1) = _content(y, a_1, b_1)
    l_2, (p_2, q_2) = _content(y, a_2, b_2)
    crosswise = (p_1 == q_2 and q_1 == -p_2) or (p_1 == -q_2 and q_1 == p_2)
    return (l_1, l_2) if crosswise else ()


def _content(y: int, a: Element, b: Element) -> tuple[Element, tuple[Element, Element]]:
    """Take the common monomial, with a rational factor, out of two elements.

    The cosine and the sine of y stay where they are, for y is not known yet.
    """
    terms = [*a.terms(), *b.terms()]
    least = tuple(map(min, zip(*(powers for powers, _ in terms), strict=True)))
    common = (*least[: 2 * y], 0, 0, *least[2 * y + 2 :])
    domain = a.ring.domain
    factor = abs(terms[0][1])
    for _, coefficient in terms[1:]:
        factor = domain.gcd(factor, coefficient)

    def divided(element: Element) -> Element:
        return a.ring.from_dict(
            {
                tuple(x - y for x, y in zip(powers, common, strict=True)): coefficient / factor
                for powers, coefficient in element.terms()
            }
        )

    return a.ring.from_dict({common: factor}), (divided(a), divided(b))
