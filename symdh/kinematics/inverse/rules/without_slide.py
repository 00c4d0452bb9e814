"""Eliminate a slide: of two equations that hold it, one is left that does not.

``A_1 q + C_1 = 0`` and ``A_2 q + C_2 = 0`` give ``A_1 C_2 - A_2 C_1 = 0``, in which q is no more:
the component across the slide's axis, which is an entry by itself only where the twist before the
slide is a right angle. It has no branches. It never degenerates where A_1 and A_2 are numbers of
the table, which is tried first; where they hold an angle, it is empty at poses at which both are
zero. What is left in one or two angles is for the other rules.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from symdh.kinematics.inverse.pool import Combination
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.rules.slide import powers_of_slide
from symdh.kinematics.inverse.state import State, View

#: Open unknowns of an equation at most, the slide among them, and of what may be left.
_MOST_OPEN, _MOST_LEFT = 3, 2
_MOST_EQUATIONS = 6
#: Longer results make no equation that anybody would read.
_LONGEST = 40


def add_without_slides(state: State) -> bool:
    """Add the equations that are left of two when a slide drops out; say whether there are any."""
    for constant in (True, False):
        added = False
        for x in range(len(state.ring.forms), state.ring.unknowns):
            if x not in state.known:
                linear = _linear(state, x, constant=constant)[:_MOST_EQUATIONS]
                for first, second in combinations(linear, 2):
                    added |= _eliminated(state, first, second)
        if added:
            return True
    return False


Linear = tuple[Element, Element, View]


def _linear(state: State, x: int, *, constant: bool) -> list[Linear]:
    """Return A, C and the view of the equations ``A q + C = 0``, shortest first."""
    found: list[Linear] = []
    for view in state.views:
        open_now = state.open(view.support)
        if x in open_now and 1 < len(open_now) <= _MOST_OPEN:
            parts = powers_of_slide(state, view.element, x)
            if parts[2] or not parts[1]:
                continue
            if state.ring.is_constant(parts[1]) or not constant:
                found.append((parts[1], parts[0], view))
    return sorted(found, key=lambda linear: len(linear[2].element))


def _eliminated(state: State, first: Linear, second: Linear) -> bool:
    (a_1, c_1, view_1), (a_2, c_2, view_2) = first, second
    element = state.ring.reduced(a_1 * c_2 - a_2 * c_1)
    left = state.open(state.support(element))
    if not 0 < len(left) <= _MOST_LEFT or len(element) > _LONGEST:
        return False
    parents = view_1.equation, view_2.equation
    source = replace(parents[0].source, entries=(), inverted=False)
    made = Combination.WITHOUT_SLIDE
    return state.pool.add(element, source, (), parents, made) is not None
