"""Known sums: an angle that is the sum or the difference of two that are known.

``theta_2 = theta_{23} - theta_3``. One value, never degenerate.
"""

from __future__ import annotations

from itertools import combinations

from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import State


def take_sums(state: State) -> None:
    """Take every step that is a sum of two known angles."""
    while True:
        step = _next_sum(state)
        if step is None:
            return
        state.take(step)


def _next_sum(state: State) -> Step | None:
    ring = state.ring
    known = sorted(k for k in state.known if ring.is_angle(k))
    for x, form in enumerate(ring.forms):
        if x in state.known:
            continue
        for y, z in combinations(known, 2):
            for a in (1, -1):
                for b in (1, -1):
                    total = {row: a * sign for row, sign in ring.forms[y]}
                    for row, sign in ring.forms[z]:
                        total[row] = total.get(row, 0) + b * sign
                    if {row: sign for row, sign in total.items() if sign} == dict(form):
                        return Step(x, Rule.SUM, parts=((a, y), (b, z)))
    return None
