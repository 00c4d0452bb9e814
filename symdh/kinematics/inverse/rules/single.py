"""One equation in one angle: ``A s + B c + C = 0``.

With ``h = sqrt(A^2 + B^2)``: ``theta = atan2(A, B) +- atan2(sqrt(h^2 - C^2), -C)``. Two values; one
where ``h = |C|``, none where ``h < |C|``, any angle where A, B and C are all zero. Where C is zero,
``theta = atan2(-B, A)`` and 180 degrees more.
"""

from __future__ import annotations

from collections.abc import Iterator

from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import Candidate, State, View

#: A branch costs as much as so many terms: where two equations give one value, one of two branches
#: would be false.
BRANCH = 40
#: An arcsine or arccosine loses half the digits where branches meet; a ratio never does.
_BRANCH_OF_RATIO = 36
_ALTERNATIVES = 3
#: Among equals the joint nearer to the base comes first.
EARLIER = 0.4

Linear = tuple[Element, Element, Element]


def linear_views(state: State) -> dict[int, list[tuple[int, Linear, View]]]:
    """Return the equations in one open angle and linear in its sine and cosine, by angle.

    They come shortest first; coefficients that vanish are zero.
    """
    found: dict[int, list[tuple[int, Linear, View]]] = {}
    for view in state.views:
        open_now = state.open(view.support)
        if len(open_now) != 1:
            continue
        (x,) = open_now
        if not state.ring.is_angle(x):
            continue
        parts = state.linear(view.element, x)
        if parts is None:
            continue
        a, b, c = (state.without_zero(part) for part in parts)
        if a or b:
            found.setdefault(x, []).append((len(a) + len(b) + len(c), (a, b, c), view))
    for equations in found.values():
        equations.sort(key=lambda entry: entry[0])
    return found


def single_candidates(state: State) -> Iterator[Candidate]:
    """Yield a step for each angle that one equation gives."""
    for x, equations in linear_views(state).items():
        best = min(equations, key=_cost)
        _, (a, b, c), view = best
        rule = _rule(a, b, c)
        if rule is Rule.RATIO:
            a, b = _with_few_signs(a, b)
        others = tuple(linear for _, linear, other in equations if other is not view)
        yield Candidate(
            _cost(best) + earliest(state, x),
            Step(x, rule, (view.used,), (a, b, c), others[:_ALTERNATIVES], branches=2),
        )


def earliest(state: State, angle: int) -> float:
    """Return what an angle costs for its place; a sum stands where its last joint does."""
    return EARLIER * state.ring.unknown_of(state.ring.forms[angle][-1][0])


def _cost(entry: tuple[int, Linear, View]) -> float:
    size, (_, _, c), view = entry
    return size + (BRANCH if c else _BRANCH_OF_RATIO) + view.equation.effort


def _with_few_signs(a: Element, b: Element) -> tuple[Element, Element]:
    """Return A and B, or both with the other sign: where ``atan2(-B, A)`` has fewer minus signs."""
    negative = sum(1 for x in (*(-b).values(), *a.values()) if x < 0)
    return (-a, -b) if 2 * negative > len(a) + len(b) else (a, b)


def _rule(a: Element, b: Element, c: Element) -> Rule:
    if not c:
        return Rule.RATIO
    if not b:
        return Rule.SINE
    return Rule.SINE_COSINE if a else Rule.COSINE
