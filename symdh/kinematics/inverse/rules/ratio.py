"""Ratio of two equations: ``K_1 = f c`` and ``K_2 = f s`` give ``K_1 s - K_2 c = 0``.

The common factor f may hold another open angle or slide, such as the sine of a wrist's second
angle. Two values, 180 degrees apart; f is positive for one of them and negative for the other.
Once the angle is known, ``f = K_1 c + K_2 s``, whose factor never vanishes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

from symdh.kinematics.inverse.pool import Combination, Equation
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.state import State, View

_LONGEST = 12


def add_ratios(state: State) -> None:
    """Add the ratio of every two short equations that share a factor."""
    by_unknowns: dict[tuple[frozenset[int], tuple[int, int]], list[_Parted]] = {}
    for view in state.views:
        open_now = state.open(view.support)
        if len(open_now) == 2 and len(view.element) <= _LONGEST:
            parted = _parted(state, view)
            if parted is not None:
                key = open_now, view.equation.source.base
                by_unknowns.setdefault(key, []).append(parted)
    for (unknowns, _), members in by_unknowns.items():
        for x in sorted(unknowns):
            if state.ring.is_angle(x):
                for first, second in combinations(members, 2):
                    _ratio(state, x, first, second)


@dataclass(frozen=True, slots=True)
class _Parted:
    """An equation ``p f + k = 0`` with a number p and f the only product of open unknowns."""

    equation: Equation
    number: Element
    factor: tuple[int, ...]
    known: Element


def _ratio(state: State, x: int, first: _Parted, second: _Parted) -> None:
    """Add ``p_1 c k_2 - p_2 s k_1 = 0`` of ``p_1 c f + k_1 = 0`` and ``p_2 s f + k_2 = 0``."""
    ring = state.ring
    c, s = 2 * x, 2 * x + 1
    for own_1, own_2 in ((c, s), (s, c)):
        if first.factor[own_1] != 1 or second.factor[own_2] != 1:
            continue
        rest = _without(first.factor, own_1)
        if rest != _without(second.factor, own_2) or rest[c] or rest[s]:
            continue
        letter_1, letter_2 = ring.gens[own_1], ring.gens[own_2]
        p_1, p_2 = first.number, second.number
        element = ring.reduced(p_1 * letter_1 * second.known - p_2 * letter_2 * first.known)
        parents = first.equation, second.equation
        source = replace(first.equation.source, entries=(), inverted=False)
        state.pool.add(element, source, (), parents, Combination.RATIO)
        factor = ring.ring.from_dict({rest: ring.ring.domain.one})
        whole = p_1 * p_2 * factor + p_2 * first.known * letter_1 + p_1 * second.known * letter_2
        state.projections.append((x, whole, source, parents))


def _without(powers: tuple[int, ...], place: int) -> tuple[int, ...]:
    return (*powers[:place], powers[place] - 1, *powers[place + 1 :])


def add_projections(state: State) -> None:
    """Add ``f = K_1 c + K_2 s`` for every ratio whose angle has been found since."""
    for entry in list(state.projections):
        x, element, source, parents = entry
        if x in state.known:
            state.projections.remove(entry)
            state.pool.add(state.ring.reduced(element), source, (), parents, Combination.PROJECTION)


def _parted(state: State, view: View) -> _Parted | None:
    """Part an equation; None where it is not of that form."""
    ring = state.ring
    first, last = 2 * len(ring.forms), ring.unknown_gens
    angles = len(ring.forms)
    letters = [
        k for k in range(last) if (k // 2 if k < first else k - first + angles) not in state.known
    ]
    factor: dict[int, int] | None = None
    number = ring.zero
    without: dict[tuple[int, ...], object] = {}
    for powers, coefficient in view.element.items():
        own = {k: powers[k] for k in letters if powers[k]}
        if not own:
            without[powers] = coefficient
            continue
        if (factor is not None and own != factor) or sum(powers) != 2 or len(own) != 2:
            return None
        factor = own
        number = number + coefficient
    assert factor is not None  # there are open unknowns in it
    whole = tuple(factor.get(k, 0) for k in range(len(ring.letters)))
    return _Parted(view.equation, number, whole, ring.ring.from_dict(without))
