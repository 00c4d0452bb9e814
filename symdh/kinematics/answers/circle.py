"""Equality of trigonometric expressions, decided in a polynomial ring.

An expression is a quotient of polynomials in the cosines and sines of its angles, in its other
symbols and in roots. Sums and multiples of angles are expanded, and the relations
``c^2 + s^2 = 1`` and ``g^n = radicand`` take every power of a sine and of a root to its lowest.
Two expressions are equal when the numerator of their difference comes out as zero.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import lcm
from typing import Any

from sympy import (
    Abs,
    Add,
    Dummy,
    Expr,
    Mul,
    Pow,
    Rational,
    acos,
    asin,
    atan,
    atan2,
    cos,
    default_sort_key,
    expand,
    factorint,
    pi,
    sin,
    tan,
)
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

#: An element of a sympy ring; sympy has no public types to say so.
Element = Any

_MOST_TERMS = 4000
_MOST_PRODUCTS = 400_000
_MOST_POWER = 64
_MOST_RADICAND = 10**12
_OPAQUE = (Abs, acos, asin, atan, atan2)


class UndecidedError(Exception):
    """The ring does not settle the question: too large, or a function that it does not know."""


@dataclass(frozen=True, slots=True)
class Ratio:
    """A quotient of two elements, both of them reduced."""

    top: Element
    bottom: Element


def equal_in_ring(first: Expr, second: Expr) -> bool:
    """Say whether the ring proves two expressions equal.

    False says only that it does not: they may still be equal by a relation that it does not have.

    Raises
    ------
    UndecidedError
        When the polynomials grow past a limit.
    """
    ring = _Ring((first, second))
    a, b = ring.read(first), ring.read(second)
    return bool(ring.times(a.top, b.bottom) == ring.times(b.top, a.bottom))


class _Ring:
    """The ring of a few expressions."""

    def __init__(self, expressions: Iterable[Expr]) -> None:
        letters: dict[Expr, None] = {}
        parts: dict[Expr, int] = {}
        primes: dict[int, None] = {}
        for expression in expressions:
            self._gather(expression, letters, parts, primes)
        self._parts = parts
        self._angles = sorted(parts, key=default_sort_key)
        self._letters = sorted(letters, key=default_sort_key)
        self._primes = sorted(primes)
        names = [Dummy("g") for _ in range(2 * len(parts) + len(letters) + len(primes))]
        self._ring = PolyRing(names or [Dummy("g")], QQ, lex)
        self._one = self._ring.one
        self._same: dict[Expr, Ratio] = {}
        # Generator and power at which it is replaced, and by what.
        self._relations: dict[int, tuple[int, Element]] = {}
        for k in range(len(parts)):
            self._relations[2 * k + 1] = (2, 1 - self._ring.gens[2 * k] ** 2)
        for k, number in enumerate(self._primes):
            place = 2 * len(parts) + len(letters) + k
            self._relations[place] = (2, self._ring.ground_new(QQ(number)))

    # -- what an expression is made of --

    def _gather(
        self, e: Expr, letters: dict[Expr, None], parts: dict[Expr, int], primes: dict[int, None]
    ) -> None:
        if e.is_Rational:
            return
        if isinstance(e, (sin, cos, tan)):
            for part, coefficient in _split(e.args[0]):
                values = _known_values(part, coefficient)
                for value in values or ():
                    self._gather(value, letters, parts, primes)
                if values is None:
                    parts[part] = lcm(parts.get(part, 1), int(coefficient.q))
            return
        if _is_root_of_number(e):
            primes.update(dict.fromkeys(factorint(int(e.base))))
            return
        if isinstance(e, (Add, Mul)) or (isinstance(e, Pow) and e.exp.is_Rational):
            if isinstance(e, Pow) and not e.exp.is_Integer:
                letters[Pow(e.base, Rational(1, e.exp.q))] = None
            for part in e.args:
                self._gather(part, letters, parts, primes)
            return
        letters[e] = None
        if isinstance(e, _OPAQUE):
            for part in e.args:
                self._gather(part, letters, parts, primes)

    # -- arithmetic --

    def times(self, a: Element, b: Element) -> Element:
        """Return the reduced product of two elements."""
        if len(a) * len(b) > _MOST_PRODUCTS:
            raise UndecidedError
        return self._checked(self._reduced(a * b))

    def _checked(self, a: Element) -> Element:
        if len(a) > _MOST_TERMS:
            raise UndecidedError
        return a

    def _reduced(self, a: Element) -> Element:
        for place, (power, replacement) in self._relations.items():
            while any(powers[place] >= power for powers in a):
                a = self._checked(self._lowered(a, place, power, replacement))
        return a

    def _lowered(self, a: Element, place: int, power: int, replacement: Element) -> Element:
        low, high = self._ring.zero, self._ring.zero
        for powers, coefficient in a.terms():
            if powers[place] < power:
                low[powers] = coefficient
            else:
                high[(*powers[:place], powers[place] - power, *powers[place + 1 :])] = coefficient
        if len(high) * len(replacement) > _MOST_PRODUCTS:
            raise UndecidedError
        return low + high * replacement

    def _add(self, a: Ratio, b: Ratio) -> Ratio:
        if a.bottom == b.bottom:
            return Ratio(self._checked(a.top + b.top), a.bottom)
        top = self.times(a.top, b.bottom) + self.times(b.top, a.bottom)
        return Ratio(self._checked(top), self.times(a.bottom, b.bottom))

    def _multiply(self, a: Ratio, b: Ratio) -> Ratio:
        return Ratio(self.times(a.top, b.top), self.times(a.bottom, b.bottom))

    def _power(self, a: Ratio, n: int) -> Ratio:
        if abs(n) > _MOST_POWER:
            raise UndecidedError
        result = Ratio(self._one, self._one)
        for _ in range(abs(n)):
            result = self._multiply(result, a)
        return result if n >= 0 else self._inverse(result)

    def _inverse(self, a: Ratio) -> Ratio:
        if not a.top:
            raise UndecidedError  # a quotient by what is zero everywhere
        return Ratio(a.bottom, a.top)

    # -- reading --

    def read(self, e: Expr) -> Ratio:
        """Return an expression as a quotient."""
        if e.is_Rational:
            return self._whole(self._ring.ground_new(QQ(e.p, e.q)))
        if isinstance(e, Add):
            return self._fold(self._add, map(self.read, e.args))
        if isinstance(e, Mul):
            return self._fold(self._multiply, map(self.read, e.args))
        if isinstance(e, (sin, cos, tan)):
            return self._trigonometric(e)
        if isinstance(e, Pow) and e.exp.is_Integer:
            return self._power(self.read(e.base), int(e.exp))
        if _is_root_of_number(e):
            return self._power(self._root_of_number(int(e.base)), int(e.exp.p))
        if isinstance(e, Pow) and e.exp.is_Rational:
            return self._power(self._root(Pow(e.base, Rational(1, e.exp.q))), int(e.exp.p))
        return self._letter(e)

    def _fold(self, operation: Any, ratios: Iterable[Ratio]) -> Ratio:
        first, *others = ratios
        for each in others:
            first = operation(first, each)
        return first

    def _whole(self, a: Element) -> Ratio:
        return Ratio(a, self._one)

    def _generator(self, letter: Expr) -> int:
        return 2 * len(self._angles) + self._letters.index(letter)

    def _letter(self, e: Expr) -> Ratio:
        """Return a letter; functions of equal arguments are one letter."""
        if isinstance(e, _OPAQUE):
            arguments = [self.read(x) for x in e.args]
            for other, ratio in self._same.items():
                if type(other) is type(e) and self._alike(other, arguments):
                    return ratio
        found = self._whole(self._ring.gens[self._generator(e)])
        self._same[e] = found
        return found

    def _alike(self, e: Expr, arguments: list[Ratio]) -> bool:
        pairs = zip(map(self.read, e.args), arguments, strict=True)
        return all(self.times(x.top, y.bottom) == self.times(y.top, x.bottom) for x, y in pairs)

    def _root(self, root: Expr) -> Ratio:
        """Return ``base^(1/n)``; roots of equal polynomials are one letter."""
        base, n = self.read(root.base), int(root.exp.q)
        for other, ratio in self._same.items():
            if isinstance(other, Pow) and other.exp == root.exp and self._alike_base(other, base):
                return ratio
        place = self._generator(root)
        if base.bottom == self._one:
            self._relations[place] = (n, base.top)
        found = self._whole(self._ring.gens[place])
        self._same[root] = found
        return found

    def _alike_base(self, other: Expr, base: Ratio) -> bool:
        ratio = self.read(other.base)
        left, right = self.times(ratio.top, base.bottom), self.times(base.top, ratio.bottom)
        return bool(left == right)

    def _root_of_number(self, number: int) -> Ratio:
        """Return the square root of a number as a product of roots of primes."""
        result = self._one
        for prime, times in sorted(factorint(number).items()):
            place = 2 * len(self._angles) + len(self._letters) + self._primes.index(prime)
            for _ in range(times):
                result = self.times(result, self._ring.gens[place])
        return self._whole(result)

    def _trigonometric(self, e: Expr) -> Ratio:
        c, s = self._pair(e.args[0])
        if isinstance(e, cos):
            return self._whole(c)
        if isinstance(e, sin):
            return self._whole(s)
        return self._multiply(self._whole(s), self._inverse(self._whole(c)))

    def _pair(self, angle: Expr) -> tuple[Element, Element]:
        """Return cosine and sine of an angle, sums and multiples expanded."""
        pair = (self._one, self._ring.zero)
        for part, coefficient in _split(angle):
            values = _known_values(part, coefficient)
            if values is not None:
                c, s = (self.read(value).top for value in values)
                pair = self._sum(pair, (c, s))
                continue
            k = self._angles.index(part)
            times = int(coefficient * self._parts[part])
            if abs(times) > _MOST_POWER:
                raise UndecidedError
            unit = (self._ring.gens[2 * k], self._ring.gens[2 * k + 1] * (1 if times > 0 else -1))
            for _ in range(abs(times)):
                pair = self._sum(pair, unit)
        return pair

    def _sum(
        self, a: tuple[Element, Element], b: tuple[Element, Element]
    ) -> tuple[Element, Element]:
        """Return cosine and sine of the sum of two angles from theirs."""
        return (
            self.times(a[0], b[0]) - self.times(a[1], b[1]),
            self.times(a[1], b[0]) + self.times(a[0], b[1]),
        )


def _split(angle: Expr) -> list[tuple[Expr, Rational]]:
    """Return an angle as terms with rational coefficients."""
    terms = expand(angle, deep=False, power_base=False, power_exp=False, log=False)
    pairs = terms.as_coefficients_dict().items()
    found = [(term, Rational(c)) for term, c in pairs if c != 0]
    return sorted(found, key=lambda pair: default_sort_key(pair[0]))


def _known_values(part: Expr, coefficient: Rational) -> tuple[Expr, Expr] | None:
    """Return cosine and sine of a multiple of pi that has them in roots: 30 deg, 45 deg.

    They are sums of products of roots and rational numbers, never quotients.
    """
    if part != pi:
        return None
    values = cos(coefficient * pi), sin(coefficient * pi)
    return None if any(value.has(cos, sin) for value in values) else values


def _is_root_of_number(e: Expr) -> bool:
    return (
        isinstance(e, Pow)
        and bool(e.base.is_Integer and e.base.is_positive and e.base <= _MOST_RADICAND)
        and bool(e.exp.is_Rational and e.exp.q == 2)
    )
