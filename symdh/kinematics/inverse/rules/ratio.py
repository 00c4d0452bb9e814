"""Ratio of two equations: ``K_1 = f c`` and ``K_2 = f s`` give ``K_1 s - K_2 c = 0``.

The common factor f may hold another open angle or slide, such as the sine of a wrist's second
angle. Two values, 180 degrees apart; f is positive for one of them and negative for the other.
Once the angle is known, ``f = K_1 c + K_2 s``, whose factor never vanishes.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from symdh.kinematics.inverse.pool import Combination
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.state import State, View

_LONGEST = 12


def add_ratios(state: State) -> None:
    """Add the ratio of every two short equations that share a factor."""
    by_unknowns: dict[frozenset[int], list[View]] = {}
    for view in state.views:
        open_now = state.open(view.support)
        if len(open_now) == 2 and len(view.element) <= _LONGEST:
            by_unknowns.setdefault(open_now, []).append(view)
    for views in by_unknowns.values():
        for first, second in combinations(views, 2):
            if first.equation.source.base == second.equation.source.base:
                _ratio(state, first, second)


def _ratio(state: State, first: View, second: View) -> None:
    """Add ``P_1 c K_2 - P_2 s K_1 = 0`` where ``P_1 c f + K_1 = 0`` and ``P_2 s f + K_2 = 0``."""
    ring = state.ring
    parts_1, parts_2 = _parted(state, first.element), _parted(state, second.element)
    if parts_1 is None or parts_2 is None:
        return
    if not (_is_number(parts_1[0]) and _is_number(parts_2[0])):
        return
    (p_1, factor_1, k_1), (p_2, factor_2, k_2) = parts_1, parts_2
    for x in sorted(state.open(first.support)):
        if not ring.is_angle(x):
            continue
        c, s = ring.gens[2 * x], ring.gens[2 * x + 1]
        for own_1, own_2 in ((c, s), (s, c)):
            if factor_1 % own_1 or factor_2 % own_2:
                continue
            if factor_1.exquo(own_1) != factor_2.exquo(own_2):
                continue
            element = ring.reduced(p_1 * own_1 * k_2 - p_2 * own_2 * k_1)
            parents = first.equation, second.equation
            source = replace(first.equation.source, entries=(), inverted=False)
            state.pool.add(element, source, (), parents, Combination.RATIO)
            whole = p_1 * p_2 * factor_1.exquo(own_1) + p_2 * k_1 * own_1 + p_1 * k_2 * own_2
            state.projections.append((x, whole, source, parents))


def add_projections(state: State) -> None:
    """Add ``f = K_1 c + K_2 s`` for every ratio whose angle has been found since."""
    for entry in list(state.projections):
        x, element, source, parents = entry
        if x in state.known:
            state.projections.remove(entry)
            state.pool.add(state.ring.reduced(element), source, (), parents, Combination.PROJECTION)


def _parted(state: State, element: Element) -> tuple[Element, Element, Element] | None:
    """Return P, f and K of ``P f + K``, with f the only product of open unknowns; else None."""
    ring = state.ring
    first, last = 2 * len(ring.forms), ring.unknown_gens
    angles = len(ring.forms)
    factor: tuple[int, ...] | None = None
    with_factor: dict[tuple[int, ...], object] = {}
    without: dict[tuple[int, ...], object] = {}
    for powers, coefficient in element.terms():
        own = [0] * len(powers)
        for k in range(last):
            if powers[k] and (k // 2 if k < first else k - first + angles) not in state.known:
                own[k] = powers[k]
        if not any(own):
            without[powers] = coefficient
            continue
        if factor is None:
            factor = tuple(own)
        if tuple(own) != factor:
            return None
        with_factor[tuple(p - o for p, o in zip(powers, own, strict=True))] = coefficient
    if factor is None or sum(factor) != 2:
        return None
    make = ring.ring.from_dict
    return make(with_factor), make({factor: ring.ring.domain.one}), make(without)


def _is_number(element: Element) -> bool:
    return all(not any(powers) for powers in element)
