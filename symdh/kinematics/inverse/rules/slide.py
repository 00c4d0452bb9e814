"""One equation in one slide: linear ``A q + C = 0``, or quadratic ``A q^2 + B q + C = 0``.

Linear: one value, none where A is zero. Quadratic: two values, one where the root is zero, none
where the radicand is negative; any value where A and B are zero, as with a twist of that value.
"""

from __future__ import annotations

from collections.abc import Iterator

from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.rules.single import BRANCH
from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import Candidate, State, View

#: What it costs that a coefficient is zero at some poses.
_MAY_VANISH = 4


def slide_candidates(state: State) -> Iterator[Candidate]:
    """Yield a step for each slide that one equation gives."""
    linear: dict[int, list[tuple[float, tuple[Element, ...], View]]] = {}
    for view in state.views:
        open_now = state.open(view.support)
        if len(open_now) != 1:
            continue
        (x,) = open_now
        if state.ring.is_angle(x):
            continue
        c, b, a = powers_of_slide(state, view.element, x)
        if a:
            if all(coefficient < 0 for coefficient in a.values()):
                a, b, c = -a, -b, -c
            step = Step(x, Rule.SLIDE_SQUARE, (view.used,), (a, b, c), branches=2)
            yield Candidate(len(a) + len(b) + len(c) + BRANCH, step)
        elif b:
            cost = (
                view.equation.source.effort
                + 2 * len(b)
                + len(c)
                + (0 if state.ring.is_constant(b) else _MAY_VANISH)
            )
            linear.setdefault(x, []).append((cost, (b, c), view))
    for x, equations in linear.items():
        equations.sort(key=lambda entry: entry[0])
        cost, coefficients, view = equations[0]
        others = tuple(entry[1] for entry in equations[1:4])
        yield Candidate(cost, Step(x, Rule.SLIDE, (view.used,), coefficients, others))


def powers_of_slide(state: State, element: Element, x: int) -> list[Element]:
    """Return the coefficients of 1, q and q^2; an open slide has no higher powers.

    The entries of a matrix equation are linear in each slide, which stands in one row of the chain.
    Only sums of their squares are not; they are combined with nothing that holds a slide.
    """
    k = state.ring.slide_gen(x)
    parts: list[dict[tuple[int, ...], object]] = [{}, {}, {}]
    for powers, coefficient in element.terms():
        parts[powers[k]][(*powers[:k], 0, *powers[k + 1 :])] = coefficient
    return [state.without_zero(state.ring.ring.from_dict(part)) for part in parts]
