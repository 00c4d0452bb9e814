"""Factors of trigonometric polynomials, found where factors are unique: in half angles.

With ``s^2 + c^2 = 1`` one product can be written in many ways, and a factor need not divide what
is written. With t = tan(theta/2), ``c = (1 - t^2)/(1 + t^2)`` and ``s = 2t/(1 + t^2)``, numerators
are ordinary polynomials: their factors are found by greatest common divisors and read back.
A factor may then be half of one: t and the point at infinity together make ``s_i``, and
``1 - t`` and ``1 + t`` make ``c_i``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial, reduce
from math import prod
from typing import Any

from sympy import Dummy, Symbol
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from symdh.kinematics.singular.trig_ring import Element, TooLargeError, TrigRing

Powers = tuple[int, ...]

#: Terms of a polynomial in half angles past which it is no longer taken apart; it then stays one
#: factor. Past the second number it is not even read.
MAX_TERMS = 600
MAX_READ = 6000
#: Monomials that a polynomial of these degrees could have, past which it stays one factor as well:
#: with ten letters the search for factors takes minutes.
MAX_MONOMIALS = 40_000


@dataclass(frozen=True)
class Pieces:
    """A product in half angles.

    Attributes
    ----------
    finite : Counter
        Primitive polynomials in t_k and the ring's other generators, with their multiplicities.
    infinite : Counter
        How often the product vanishes at theta_k = 180 deg by way of t_k = infinity.
    """

    finite: Counter[Element]
    infinite: Counter[int]

    @property
    def support(self) -> frozenset[object]:
        """What the product vanishes with, without multiplicities."""
        return frozenset((*self.finite, *self.infinite))

    @property
    def terms(self) -> int:
        """How many terms the largest of the finite pieces has."""
        return max((len(piece) for piece in self.finite), default=0)

    def __and__(self, other: Pieces) -> Pieces:
        return Pieces(self.finite & other.finite, self.infinite & other.infinite)

    def __sub__(self, other: Pieces) -> Pieces:
        return Pieces(self.finite - other.finite, self.infinite - other.infinite)

    def __add__(self, other: Pieces) -> Pieces:
        return Pieces(self.finite + other.finite, self.infinite + other.infinite)


class HalfAngles:
    """The ring of t_k = tan(angle_k / 2), slides and lengths that belongs to a `TrigRing`."""

    def __init__(self, trig: TrigRing) -> None:
        self.trig = trig
        self.count = len(trig.angles)
        names = [Dummy("t") for _ in trig.angles] + [Dummy("x") for _ in trig.others]
        self.ring = PolyRing(names or [Dummy("x")], QQ, lex)

    def pieces(self, factors: Iterable[Element]) -> Pieces:
        """Take a product of elements of the trigonometric ring apart, reduced and not zero.

        Raises
        ------
        TooLargeError
            When one has more than `MAX_READ` terms in half angles.
        """
        whole = Pieces(Counter(), Counter())
        for factor in factors:
            whole = whole + self._pieces(factor)
        return whole

    def factors(self, pieces: Pieces) -> list[tuple[Element, int]]:
        """Return factors of the trigonometric ring, primitive, with their powers."""
        finite, infinite = Counter(pieces.finite), Counter(pieces.infinite)
        found: Counter[Element] = Counter()
        for piece, power in sorted(finite.items(), key=_sorting):
            if not self._odd(piece):
                found[self._read_back(piece, {})] += power
                del finite[piece]
        for k in sorted(infinite):
            found += self._with_infinity(k, infinite[k], finite)
        for piece in sorted(finite, key=lambda p: _sorting((p, 1))):
            while finite[piece] > 0:
                found[self._with_partner(piece, finite)] += 1
        return [(factor, power) for factor, power in found.items() if not factor.is_ground]

    def moving(self, pieces: Pieces, symbols: set[Symbol]) -> Pieces:
        """Return the pieces that have one of these symbols in them."""
        kept = {p: m for p, m in pieces.finite.items() if self._depends_on(p, symbols)}
        return Pieces(Counter(kept), pieces.infinite)

    def _depends_on(self, piece: Element, symbols: set[Symbol]) -> bool:
        """Say whether a piece has one of these symbols in it."""
        stand_for = (*self.trig.angles, *self.trig.others)
        return any(
            _degree(piece, k) and expression.free_symbols & symbols
            for k, expression in enumerate(stand_for)
        )

    def _pieces(self, factor: Element) -> Pieces:
        numerator, degrees = self._numerator(factor)
        infinite = Counter(
            {
                k: 2 * degree - _degree(numerator, k)
                for k, degree in enumerate(degrees)
                if 2 * degree > _degree(numerator, k)
            }
        )
        return Pieces(Counter(self._split(numerator.primitive()[1])), infinite)

    def _numerator(self, factor: Element) -> tuple[Element, list[int]]:
        """Return the numerator in half angles, and how often 1 + t_k^2 stands below it.

        It does not divide the numerator: with A c^m + B s c^(m-1) as the terms of highest degree,
        all that is left of it at t = i is 2^m (A + iB), and A and B are real and not both zero.
        """
        n = self.count
        degrees = [max(powers[2 * k] + powers[2 * k + 1] for powers in factor) for k in range(n)]
        # Exponents of all cosines and sines, then of all t, then of the rest.
        wide = {(*p[: 2 * n], *(0,) * n, *p[2 * n :]): c for p, c in factor.terms()}
        for k, degree in enumerate(degrees):
            if degree:
                image = partial(_in_half_angle, degree)
                wide = _exchanged(wide, (2 * k, 2 * k + 1), (2 * n + k,), image)
            if len(wide) > MAX_READ:
                raise TooLargeError
        return self.ring.from_dict(_narrowed(self.ring, wide, 2 * n)), degrees

    def _split(self, polynomial: Element) -> Iterator[Element]:
        """Yield the factors of a primitive polynomial that are not constant."""
        if polynomial.is_ground:
            return
        used = [k for k in range(self.ring.ngens) if _degree(polynomial, k)]
        if len(polynomial) > MAX_TERMS:
            yield _normal(polynomial)
            return
        linear = [k for k in used if _degree(polynomial, k) == 1]
        for k in linear[:1] or used:
            content = _content(polynomial, k)
            if not content.is_ground:
                yield from self._split(content)
                yield from self._split(polynomial.exquo(content))
                return
        # Linear in something, and without a factor that is free of it: it cannot be a product.
        if linear:
            yield _normal(polynomial)
            return
        if prod(_degree(polynomial, k) + 1 for k in used) > MAX_MONOMIALS:
            yield _normal(polynomial)
            return
        for factor, power in polynomial.factor_list()[1]:
            yield from [_normal(factor)] * power

    def _odd(self, piece: Element) -> list[int]:
        return [k for k in range(self.count) if _degree(piece, k) % 2]

    def _with_infinity(self, k: int, times: int, finite: Counter[Element]) -> Counter[Element]:
        """Pair t_k with infinity to s_k; what is left over vanishes at 180 degrees alone."""
        found: Counter[Element] = Counter()
        zero = self.ring.gens[k]
        paired = min(times, finite[zero])
        finite[zero] -= paired
        sine, cosine = self.trig.ring.gens[2 * k + 1], self.trig.ring.gens[2 * k]
        found[sine] += paired
        found[1 + cosine] += (times - paired) // 2
        if (times - paired) % 2:
            found[self._odd_infinity(k, finite)] += 1
        return +found

    def _odd_infinity(self, k: int, finite: Counter[Element]) -> Element:
        """Pair a single infinity with another half of a factor, or with itself."""
        left = [p for p in sorted(finite, key=lambda p: _sorting((p, 1))) if finite[p] > 0]
        partner = next((p for p in left if self._odd(p) == [k]), None)
        if partner is None:
            return 1 + self.trig.ring.gens[2 * k]
        finite[partner] -= 1
        return self._read_back(partner, {k: 1})

    def _with_partner(self, piece: Element, finite: Counter[Element]) -> Element:
        """Return the factor that an odd piece makes with others, its half-turn image first.

        In a determinant there is always a partner. In a common divisor a half may be alone: its
        square vanishes at the same place.
        """
        finite[piece] -= 1
        product = piece
        while odd := self._odd(product):
            image = self._half_turned(product, odd[0])
            partner = image if finite[image] > 0 else self._any_partner(odd, finite)
            if partner is None:
                return self._read_back(product * product, {})
            finite[partner] -= 1
            product = product * partner
        return self._read_back(product, {})

    def _any_partner(self, odd: list[int], finite: Counter[Element]) -> Element | None:
        left = [p for p in sorted(finite, key=lambda p: _sorting((p, 1))) if finite[p] > 0]
        alike = [p for p in left if self._odd(p) == odd]
        sharing = [p for p in left if set(self._odd(p)) & set(odd)]
        return next(iter(alike or sharing), None)

    def _half_turned(self, piece: Element, k: int) -> Element:
        """Return what a piece becomes when angle k grows by 180 degrees: t_k is now -1/t_k."""
        degree = _degree(piece, k)
        turned = self.ring.from_dict(
            {
                (*powers[:k], degree - powers[k], *powers[k + 1 :]): c * (-1) ** powers[k]
                for powers, c in piece.terms()
            }
        )
        return _normal(turned)

    def _read_back(self, piece: Element, infinite: dict[int, int]) -> Element:
        """Return a piece of even degrees as a primitive trigonometric polynomial."""
        n = self.count
        halves = [(_degree(piece, k) + infinite.get(k, 0)) // 2 for k in range(n)]
        wide = {(*p[:n], *(0,) * 2 * n, *p[n:]): c for p, c in piece.terms()}
        for k, half in enumerate(halves):
            if half:
                image = partial(_in_whole_angle, half)
                wide = _exchanged(wide, (k,), (n + 2 * k, n + 2 * k + 1), image)
        total = self.trig.ring.from_dict(_narrowed(self.trig.ring, wide, n))
        return _normal(self.trig.reduced(total).primitive()[1])


def _exchanged(
    terms: Mapping[Powers, Any],
    taken: Powers,
    given: Powers,
    image: Callable[..., Mapping[Powers, int]],
) -> dict[Powers, Any]:
    """Replace the powers at the places `taken` by their image, a polynomial at `given`."""
    result: dict[Powers, Any] = {}
    for powers, coefficient in terms.items():
        exponents = list(powers)
        for place in taken:
            exponents[place] = 0
        for new, factor in image(*(powers[place] for place in taken)).items():
            for place, exponent in zip(given, new, strict=True):
                exponents[place] = exponent
            key = tuple(exponents)
            result[key] = result.get(key, 0) + coefficient * factor
    return {powers: coefficient for powers, coefficient in result.items() if coefficient}


def _narrowed(ring: PolyRing, terms: Mapping[Powers, Any], skip: int) -> dict[Powers, Any]:
    """Drop exponents that have all become zero; a ring without symbols has one generator."""
    return {powers[skip:] or (0,) * ring.ngens: c for powers, c in terms.items()}


@cache
def _in_half_angle(degree: int, c: int, s: int) -> dict[Powers, int]:
    """Return ``(1 - t^2)^c (2t)^s (1 + t^2)^(degree - c - s)`` by powers of t."""
    coefficients = [1]
    for factor in [(1, 0, -1)] * c + [(0, 2)] * s + [(1, 0, 1)] * (degree - c - s):
        coefficients = _convolved(coefficients, factor)
    return {(power,): value for power, value in enumerate(coefficients) if value}


@cache
def _in_whole_angle(half: int, power: int) -> dict[Powers, int]:
    """Return ``t^power / (1 + t^2)^half`` in cosine and sine, up to a factor 2^half."""
    sines = min(power, 2 * half - power)
    above = (power - sines) // 2
    coefficients = [1]
    for factor in [(1, -1)] * above + [(1, 1)] * (half - sines - above):
        coefficients = _convolved(coefficients, factor)
    return {(c, sines): value for c, value in enumerate(coefficients) if value}


def _convolved(first: Sequence[int], second: Sequence[int]) -> list[int]:
    product = [0] * (len(first) + len(second) - 1)
    for i, x in enumerate(first):
        for j, y in enumerate(second):
            product[i + j] += x * y
    return product


def _degree(element: Element, k: int) -> int:
    return max((powers[k] for powers in element), default=0)


def _content(polynomial: Element, k: int) -> Element:
    """Return the greatest common divisor of the coefficients of the powers of generator k."""
    by_power: dict[int, dict[tuple[int, ...], object]] = {}
    for powers, coefficient in polynomial.terms():
        rest = (*powers[:k], 0, *powers[k + 1 :])
        by_power.setdefault(powers[k], {})[rest] = coefficient
    ring = polynomial.ring
    coefficients = sorted((ring.from_dict(part) for part in by_power.values()), key=len)

    def divisor(x: Element, y: Element) -> Element:
        return x if x.is_ground else x.gcd(y)

    return _normal(reduce(divisor, coefficients))


def _normal(element: Element) -> Element:
    """Return an element with whole coefficients without a common divisor, the first positive."""
    primitive = element.clear_denoms()[1].primitive()[1]
    return -primitive if primitive.LC < 0 else primitive


def _sorting(item: tuple[Element, int]) -> tuple[int, list[tuple[int, ...]], list[str]]:
    terms = item[0].terms()
    return len(terms), [tuple(p) for p, _ in terms], [str(c) for _, c in terms]
