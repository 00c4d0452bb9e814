"""Two linear equations in the sine and the cosine of one angle.

``A_1 s + B_1 c + C_1 = 0`` and ``A_2 s + B_2 c + C_2 = 0`` give with ``D = A_1 B_2 - A_2 B_1``:
``theta = atan2((B_1 C_2 - B_2 C_1) / D, (A_2 C_1 - A_1 C_2) / D)``. One value; nothing where D is
zero, which another pair of equations may cure.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.rules.single import EARLIER, linear_views
from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import Candidate, State

_MOST_EQUATIONS = 9
_ALTERNATIVES = 4
#: What it costs that D is zero at some poses.
_MAY_VANISH = 8


def pair_candidates(state: State) -> Iterator[Candidate]:
    """Yield a step for each angle that two equations give."""
    for x, equations in linear_views(state).items():
        pairs = []
        for first, second in combinations(equations[:_MOST_EQUATIONS], 2):
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
    effort = sum(equation.effort for equation in equations) + EARLIER * step.unknown
    return effort + (0.0 if alike else 1.5) + (0.0 if _is_safe(state, step) else _MAY_VANISH)


def _is_safe(state: State, step: Step) -> bool:
    """Say whether D is a sum of two squares, or free of joint variables."""
    a_1, b_1, _, a_2, b_2, _ = step.coefficients
    if (a_1 == b_2 and a_2 == -b_1) or (a_1 == -b_2 and a_2 == b_1):
        return True
    return state.ring.is_constant(state.ring.reduced(a_1 * b_2 - a_2 * b_1))


def _determinant(
    state: State, a_1: Element, b_1: Element, a_2: Element, b_2: Element, k: int
) -> int:
    point = state.points[k]
    value = point.value
    return (value(a_1) * value(b_2) - value(a_2) * value(b_1)) % point.prime
