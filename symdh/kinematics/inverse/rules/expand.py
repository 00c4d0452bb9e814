"""Angle-sum expansion: of two open angles that differ by a known one, only one is left.

``c_{23} = c_2 c_3 - s_2 s_3`` and ``s_{23} = s_2 c_3 + c_2 s_3``, used where theta_3 is known.
"""

from __future__ import annotations

from itertools import permutations

from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.kinematics.inverse.state import State, View

#: Equations in more open unknowns than this are left as they are.
_MOST_OPEN = 3


def expand_known(state: State) -> None:
    """Expand sums in every equation where that leaves fewer open angles."""
    for view in state.views:
        open_now = state.open(view.support)
        if 1 < len(open_now) <= _MOST_OPEN:
            _expand(state, view)


def _expand(state: State, view: View) -> None:
    ring = state.ring
    while True:
        angles = sorted(k for k in state.open(view.support) if ring.is_angle(k))
        relation = next(
            (found for x, y in permutations(angles, 2) if (found := _relation(state, y, x))), None
        )
        if relation is None:
            return
        view.element = substituted(ring, view.element, *relation)
        view.support = state.support(view.element)


Relation = tuple[int, tuple[int, int], tuple[int, int]]


def _relation(state: State, x: int, y: int) -> Relation | None:
    """Return x = sign y + sign k with a known k, as (x, (sign, y), (sign, k))."""
    ring = state.ring
    vectors = ring.vectors
    for k in sorted(state.known):
        if not ring.is_angle(k):
            continue
        for a in (1, -1):
            for b in (1, -1):
                if _combined(vectors[y], a, vectors[k], b) == vectors[x]:
                    return x, (a, y), (b, k)
    return None


def substituted(
    ring: InverseRing, element: Element, x: int, first: tuple[int, int], second: tuple[int, int]
) -> Element:
    """Put the sum of two signed angles for angle x."""
    (a, y), (b, k) = first, second
    c_y, s_y = ring.gens[2 * y], a * ring.gens[2 * y + 1]
    c_k, s_k = ring.gens[2 * k], b * ring.gens[2 * k + 1]
    cosine, sine = c_y * c_k - s_y * s_k, s_y * c_k + c_y * s_k
    total = ring.zero
    by_powers: dict[tuple[int, int], dict[tuple[int, ...], object]] = {}
    for powers, coefficient in element.terms():
        key = powers[2 * x], powers[2 * x + 1]
        rest = (*powers[: 2 * x], 0, 0, *powers[2 * x + 2 :])
        by_powers.setdefault(key, {})[rest] = coefficient
    for (in_c, in_s), part in by_powers.items():
        total = total + ring.ring.from_dict(part) * cosine**in_c * sine**in_s
    return ring.reduced(total)


def base_angles(ring: InverseRing, element: Element, known: set[int]) -> Element:
    """Write the sums of angles that are not known by the joints' own angles."""
    for x in range(len(ring.forms) - 1, -1, -1):
        form = ring.forms[x]
        if len(form) < 2 or x in known:
            continue
        if not any(powers[2 * x] or powers[2 * x + 1] for powers in element):
            continue
        cosine, sine = ring.one, ring.zero
        for row, sign in form:
            k = 2 * ring.unknown_of(row)
            c, s = ring.gens[k], sign * ring.gens[k + 1]
            cosine, sine = cosine * c - sine * s, sine * c + cosine * s
        element = element.compose([(ring.gens[2 * x], cosine), (ring.gens[2 * x + 1], sine)])
        element = ring.reduced(element)
    return element


def _combined(x: dict[int, int], a: int, y: dict[int, int], b: int) -> dict[int, int]:
    total = {row: a * sign for row, sign in x.items()}
    for row, sign in y.items():
        total[row] = total.get(row, 0) + b * sign
        if not total[row]:
            del total[row]
    return total
