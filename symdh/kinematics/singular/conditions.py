"""Products that vanish together, as the sets of factors that do it.

Several minors vanish at once where one factor of each does. Written out that is a list of
alternatives, each a few factors: ``s_2 = 0 and c_3 = 0``, or ``s_2 = 0 and s_6 = 0``, ...
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import product

from symdh.kinematics.singular.trig_ring import Element, TooLargeError, TrigRing

#: Alternatives past which they are not written out.
MAX_ALTERNATIVES = 100

Alternative = frozenset[Element]
Pair = tuple[Fraction, Fraction]
_ONE, _ZERO = Fraction(1), Fraction(0)


def alternatives(
    ring: TrigRing, products: Iterable[Iterable[Element]], covered: Iterable[Element]
) -> list[Alternative]:
    """Return the smallest sets of factors that make all products vanish.

    Parameters
    ----------
    ring : TrigRing
    products : iterable of iterable of Element
        The factors of each product.
    covered : iterable of Element
        Where one of these vanishes, all is said already.

    Raises
    ------
    TooLargeError
        When there would be more than `MAX_ALTERNATIVES`.
    """
    known = list(covered)
    found: set[Alternative] = {frozenset()}
    for factors in products:
        choices = list(factors)
        found = _smallest(
            extended
            for each in found
            for extended in _extended(ring, each, choices)
            if not any(_follows(ring, each_known, extended) for each_known in known)
        )
        if len(found) > MAX_ALTERNATIVES:
            raise TooLargeError
    return sorted(_smallest(_without_repetition(ring, each) for each in found), key=_sorting)


def _extended(ring: TrigRing, chosen: Alternative, choices: list[Element]) -> Iterator[Alternative]:
    """Yield the alternative with each factor that makes one more product vanish and can."""
    if any(_follows(ring, factor, chosen) for factor in choices):
        yield chosen
        return
    for factor in choices:
        more = chosen | {factor}
        if all(_places(ring, more, k) != [] for k in range(len(ring.angles))):
            yield more


def _follows(ring: TrigRing, factor: Element, chosen: Alternative) -> bool:
    """Say whether a factor vanishes wherever the chosen ones do, as far as that is easy to see.

    The joints that are held by a chosen factor alone take each of their values, all else is
    generic.
    """
    if factor in chosen:
        return True
    held = {k: places for k in range(len(ring.angles)) if (places := _places(ring, chosen, k))}
    if not held:
        return False
    for pairs in product(*held.values()):
        point = ring.generic_point()
        for k, (c, s) in zip(held, pairs, strict=True):
            point[2 * k], point[2 * k + 1] = c, s
        if ring.value(factor, point):
            return False
    return True


def _places(ring: TrigRing, chosen: Alternative, k: int) -> list[Pair] | None:
    """Return cosine and sine of angle k where the chosen factors hold it; None where it is free."""
    c, s = ring.ring.gens[2 * k], ring.ring.gens[2 * k + 1]
    holding = {
        c: [(_ZERO, _ONE), (_ZERO, -_ONE)],
        s: [(_ONE, _ZERO), (-_ONE, _ZERO)],
        c + 1: [(-_ONE, _ZERO)],
        c - 1: [(_ONE, _ZERO)],
    }
    places: list[Pair] | None = None
    for factor, pairs in holding.items():
        if factor in chosen:
            places = pairs if places is None else [pair for pair in places if pair in pairs]
    return places


def _without_repetition(ring: TrigRing, chosen: Alternative) -> Alternative:
    """Drop the factors that vanish with the others."""
    for factor in sorted(chosen, key=lambda f: -len(f)):
        if _follows(ring, factor, chosen - {factor}):
            chosen = chosen - {factor}
    return chosen


def _smallest(found: Iterable[Alternative]) -> set[Alternative]:
    """Drop each alternative that contains another one."""
    kept: list[Alternative] = []
    for each in sorted(set(found), key=_sorting):
        if not any(other <= each for other in kept):
            kept.append(each)
    return set(kept)


def _sorting(chosen: Alternative) -> tuple[int, list[str]]:
    return len(chosen), sorted(str(sorted(factor.terms(), reverse=True)) for factor in chosen)
