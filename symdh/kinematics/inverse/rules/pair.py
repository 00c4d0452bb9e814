"""Two linear equations in the sine and the cosine of one angle.

``A_1 s + B_1 c + C_1 = 0`` and ``A_2 s + B_2 c + C_2 = 0`` give with ``D = A_1 B_2 - A_2 B_1``:
``theta = atan2((B_1 C_2 - B_2 C_1) / D, (A_2 C_1 - A_1 C_2) / D)``. One value; nothing where D is
zero, which another pair of equations may cure.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.rules.single import Linear, earliest, linear_views
from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import Candidate, State, View

_MOST_EQUATIONS = 9
_ALTERNATIVES = 4
#: What it costs that D is zero at some poses.
_MAY_VANISH = 8
#: What it costs to put two known parts as rho and psi, or to solve by Cramer's rule, in terms to
#: read; an equation in the sine alone and one in the cosine alone need neither.
_POLAR = 3
_CRAMER = 6


def pair_candidates(state: State) -> Iterator[Candidate]:
    """Yield a step for each angle that two equations give."""
    for x, equations in linear_views(state).items():
        pairs = []
        for first, second in combinations(_short_ones(state, equations), 2):
            (n_1, (a_1, b_1, c_1), view_1), (n_2, (a_2, b_2, c_2), view_2) = first, second
            determinants = tuple(_determinant(state, a_1, b_1, a_2, b_2, k) for k in (0, 1))
            if any(determinants):
                step = Step(
                    x,
                    Rule.PAIR,
                    (view_1.used, view_2.used),
                    (a_1, b_1, c_1, a_2, b_2, c_2),
                )
                pairs.append((n_1 + n_2 + _surcharge(state, step), determinants, step))
        if pairs:
            yield _with_alternatives(pairs)


def _short_ones(
    state: State, equations: list[tuple[int, Linear, View]]
) -> list[tuple[int, Linear, View]]:
    """Return the shortest equations, and all that give a sine or a cosine as it stands."""
    constant = state.ring.is_constant
    direct = [
        entry
        for entry in equations[_MOST_EQUATIONS:]
        if any(not a and constant(b) for a, b in (entry[1][:2], entry[1][1::-1]))
    ]
    return [*equations[:_MOST_EQUATIONS], *direct]


def _with_alternatives(
    pairs: list[tuple[float, tuple[int, ...], Step]],
) -> Candidate:
    """Return the cheapest pair; others whose determinant is another one stand by."""
    pairs.sort(key=lambda pair: pair[0])
    cost, determinants, best = pairs[0]
    seen = {determinants}
    others: list[tuple[Element, ...]] = []
    for _, values, step in pairs[1:]:
        if values not in seen and len(others) < _ALTERNATIVES:
            seen.add(values)
            others.append(step.coefficients)
    step = Step(best.unknown, best.rule, best.equations, best.coefficients, tuple(others))
    return Candidate(cost, step)


def _surcharge(state: State, step: Step) -> float:
    """Prefer pairs that never degenerate, entries of one matrix equation, few moved joints."""
    equations = [used.equation for used in step.equations]
    first, second = (equation.source for equation in equations)
    alike = (first.i, first.j, first.inverted) == (second.i, second.j, second.inverted)
    effort = sum(equation.effort for equation in equations) + earliest(state, step.unknown)
    effort += 0 if _is_apart(step) else _POLAR if _is_polar(step) else _CRAMER
    return effort + (0.0 if alike else 1.5) + (0.0 if _is_safe(state, step) else _MAY_VANISH)


def _is_apart(step: Step) -> bool:
    """Say whether one equation holds the sine alone and the other the cosine alone."""
    a_1, b_1, _, a_2, b_2, _ = step.coefficients
    return not (a_1 or b_2) or not (b_1 or a_2)


def _is_polar(step: Step) -> bool:
    """Say whether both equations have the same two coefficients, and neither is zero."""
    a_1, b_1, _, a_2, b_2, _ = step.coefficients
    turned = (a_1 == b_2 and a_2 == -b_1) or (a_1 == -b_2 and a_2 == b_1)
    return turned and bool(a_1) and bool(b_1)


def _is_safe(state: State, step: Step) -> bool:
    """Say whether D is free of joint variables, or the square of a distance.

    Two squares may vanish together; those of a distance do so where the angle is free, those of
    direction cosines also where it is not.
    """
    a_1, b_1, _, a_2, b_2, _ = step.coefficients
    if _is_polar(step) and not all(_is_direction(state, part) for part in (a_1, b_1)):
        return True
    return state.ring.is_constant(state.ring.reduced(a_1 * b_2 - a_2 * b_1))


def _is_direction(state: State, element: Element) -> bool:
    """Say whether an element is made of directions alone: sines, cosines, entries of rotations."""
    ring = state.ring
    angles = range(2 * len(ring.forms))
    goal = range(ring.first_goal, ring.first_goal + 9)
    return all(
        k in angles or k in goal or (k >= ring.first_name and (k - ring.first_name) % 12 < 9)
        for powers in element
        for k, power in enumerate(powers)
        if power
    )


def _determinant(
    state: State, a_1: Element, b_1: Element, a_2: Element, b_2: Element, k: int
) -> int:
    point = state.points[k]
    value = point.value
    return (value(a_1) * value(b_2) - value(a_2) * value(b_1)) % point.prime
