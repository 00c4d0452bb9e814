"""Square and add: two or three coordinates of one matrix equation, so that an angle drops out.

``p_x = a_1 c_1 + a_2 c_12`` and ``p_y = a_1 s_1 + a_2 s_12`` give
``p_x^2 + p_y^2 = a_1^2 + a_2^2 + 2 a_1 a_2 c_2``. The planes xy, yz and xz are tried, and the
whole space. Known terms are moved to the known side before.
"""

from __future__ import annotations

from symdh.kinematics.inverse.pool import Source, Split
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.rules.expand import base_angles
from symdh.kinematics.inverse.state import State

_CHOICES = ((0, 1), (1, 2), (0, 2), (0, 1, 2))
#: Longer sides than this make no equation that anybody would read.
_LONGEST_SIDE = 30
_MOST_OPEN = 2

Sides = tuple[tuple[Element, Element], ...]
Found = tuple[int, int, Element, Source, Sides]


def add_squares(state: State) -> None:
    """Add equations in fewer open unknowns than the coordinates have.

    Matrix equations whose one side is known come first. Equations in one unknown are enough where
    there are any; else those in two are added.
    """
    known: list[Split] = []
    others: list[Split] = []
    for split in state.pool.splits:
        sides = frozenset().union(*(state.support(x) for x in split.left.position))
        (others if state.open(sides) else known).append(split)
    found: list[Found] = []
    for group in (known, others):
        for split in group:
            found += _of_split(state, split)
        if any(count == 1 for count, *_ in found):
            break
    found.sort(key=lambda entry: entry[:2])
    for count, _, element, source, shown in found:
        if count == found[0][0]:
            state.pool.add(element, source, shown)


def _of_split(state: State, split: Split) -> list[Found]:
    if max(map(len, (*split.left.position, *split.right.position))) > _LONGEST_SIDE:
        return []
    compared = [
        _known_moved(state, left, right)
        for left, right in zip(split.left.position, split.right.position, strict=True)
    ]
    whole = list(zip(split.left.position, split.right.position, strict=True))
    found = _of_sides(state, split, whole)
    if compared != whole:
        found += _of_sides(state, split, compared)
    return found


def _of_sides(state: State, split: Split, compared: list[tuple[Element, Element]]) -> list[Found]:
    ring = state.ring
    sides = [(left, base_angles(ring, right, state.known)) for left, right in compared]
    opened = [
        state.open(state.support(left) | state.support(right)) if left or right else frozenset()
        for left, right in sides
    ]
    squares: dict[int, tuple[Element, Element]] = {}
    found = []
    for choice in _CHOICES:
        before = frozenset().union(*(opened[k] for k in choice))
        if len(before) < 2:
            continue
        for k in choice:
            if k not in squares:
                left, right = sides[k]
                squares[k] = left**2, ring.reduced(right**2)
        left = sum((squares[k][0] for k in choice), ring.zero)
        right = sum((squares[k][1] for k in choice), ring.zero)
        element = ring.orthonormal(ring.reduced(left)) - right
        after = state.open(state.support(element))
        useful = after and len(after) < len(before) and len(after) <= _MOST_OPEN
        if useful and state.pool.is_given(element):
            entries = tuple((k, 3) for k in choice)
            source = Source(split.i, split.j, entries, split.inverted, split.base)
            shown = tuple(compared[k] for k in choice)
            found.append((len(after), len(element) + source.moved, element, source, shown))
    return found


def _known_moved(state: State, left: Element, right: Element) -> tuple[Element, Element]:
    """Move what is known from the right side to the left."""
    ring = state.ring
    known: dict[tuple[int, ...], object] = {}
    rest: dict[tuple[int, ...], object] = {}
    for powers, coefficient in right.terms():
        one = ring.ring.from_dict({powers: coefficient})
        (rest if state.open(state.support(one)) else known)[powers] = coefficient
    make = ring.ring.from_dict
    return left - make(known), make(rest)
