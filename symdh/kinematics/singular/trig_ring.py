"""A polynomial ring for one robot: cosines and sines of its angles, slides, lengths.

Everything that a Jacobian is made of is a polynomial here, with rational coefficients, and sums
and products are exact and cheap. The relation ``s^2 + c^2 = 1`` is applied after each product.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    Integer,
    Mul,
    Pow,
    Rational,
    Symbol,
    cos,
    default_sort_key,
    prime,
    sin,
)
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from symdh.kinematics.chain import link_word
from symdh.motion import Word
from symdh.robot import JointType, Motion, MotionKind, Robot

#: An element of a sympy ring; sympy has no public types to say so.
Element = Any
Vector = tuple[Element, Element, Element]


class TooLargeError(Exception):
    """A polynomial, or a list of them, has grown past a stated limit."""


class TrigRing:
    """The ring of one robot.

    Parameters
    ----------
    robot : Robot
    more : iterable of Expr
        Lengths that are not in the robot's table.

    Attributes
    ----------
    angles : tuple of Expr
        The angles whose cosines and sines are generators: joint variables, then constant angles
        that have no simple cosine. The generators of angle k are 2k (cosine) and 2k + 1 (sine).
    others : tuple of Expr
        The expressions that the other generators stand for.
    """

    def __init__(self, robot: Robot, more: Iterable[Expr] = ()) -> None:
        motions = list(_motions(robot))
        self._turning = {
            j.variable: j for j in robot.joints if j.type is JointType.REVOLUTE and j.variable
        }
        parts = [_split(m.amount) for m in motions if m.kind is MotionKind.ROTATION]
        found = dict.fromkeys(self._unit(v) for v in self._turning)
        constants = [self._parted(part)[1] for part in parts]
        found |= dict.fromkeys(_without_sign(c)[0] for c in constants if _is_opaque_angle(c))
        self.angles: tuple[Expr, ...] = tuple(found)
        plain = [*more, *(m.amount for m in motions if m.kind is MotionKind.TRANSLATION)]
        for constant in constants:
            if not _is_opaque_angle(constant):
                plain += [cos(constant), sin(constant)]
        atoms = {atom for expression in plain for atom in _atoms(expression)}
        slides = [j.variable for j in robot.joints if j.type is JointType.PRISMATIC]
        rest = sorted(atoms - set(slides), key=default_sort_key)
        self.others: tuple[Expr, ...] = (*(v for v in slides if v is not None), *rest)
        names = [Dummy(letter) for _ in self.angles for letter in "cs"]
        names += [Dummy("x") for _ in self.others]
        # A robot without any symbol still needs a ring.
        self.ring = PolyRing(names or [Dummy("x")], QQ, lex)

    def constant(self, value: int) -> Element:
        """Return a whole number as an element."""
        return self.ring.ground_new(QQ(value))

    def read(self, expression: Expr) -> Element:
        """Return an expression of lengths as an element."""
        if expression.is_Rational:
            return self.ring.ground_new(QQ(expression.p, expression.q))
        if isinstance(expression, Add):
            return reduce(lambda x, y: x + y, map(self.read, expression.args))
        if isinstance(expression, Mul):
            return reduce(lambda x, y: x * y, map(self.read, expression.args))
        if _is_power(expression):
            return self.read(expression.base) ** int(expression.exp)
        return self.ring.gens[2 * len(self.angles) + self.others.index(expression)]

    def expression(self, element: Element) -> Expr:
        """Return an element as an expanded expression."""
        letters = [f(angle) for angle in self.angles for f in (cos, sin)] + list(self.others)
        return Add(
            *(
                Mul(
                    Rational(int(c.numerator), int(c.denominator)),
                    *(letter**e for letter, e in zip(letters, powers, strict=False) if e),
                )
                for powers, c in element.terms()
            )
        )

    def reduced(self, element: Element) -> Element:
        """Return an element with every sine to the first power at most."""
        sines = [2 * k + 1 for k in range(len(self.angles))]
        if all(powers[k] < 2 for powers in element for k in sines):
            return element
        for k in sines:
            element = self._reduced_in(element, k)
        return element

    def _reduced_in(self, element: Element, sine: int) -> Element:
        gens = self.ring.gens
        square = 1 - gens[sine - 1] ** 2
        low = self.ring.zero
        by_power: dict[int, Any] = {}
        for powers, coefficient in element.terms():
            pairs, left = divmod(powers[sine], 2)
            rest = (*powers[:sine], left, *powers[sine + 1 :])
            by_power.setdefault(pairs, self.ring.zero)[rest] = coefficient
        for pairs, part in by_power.items():
            low = low + part * square**pairs
        return low

    def product(self, left: Element, right: Element) -> Element:
        """Return the reduced product of two elements."""
        return self.reduced(left * right)

    def generic_point(self, shift: int = 0) -> list[Fraction]:
        """Return rational values of the generators, cosines and sines on the unit circle.

        They come from prime numbers and obey no relation by accident; each `shift` gives others.
        """
        values: list[Fraction] = []
        for k in range(len(self.angles)):
            t = Fraction(int(prime(11 + 3 * k + shift)), int(prime(23 + 5 * k + shift)))
            values += [(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)]
        values += [Fraction(int(prime(31 + 2 * k + shift)), 7) for k in range(len(self.others))]
        return values or [Fraction(1)]

    def value(self, element: Element, point: Sequence[Fraction]) -> Fraction:
        """Return the value of an element where the generators have the values of `point`."""
        total = Fraction(0)
        for powers, coefficient in element.terms():
            term = Fraction(int(coefficient.numerator), int(coefficient.denominator))
            for value, power in zip(point, powers, strict=True):
                if power:
                    term *= value**power
            total += term
        return total

    def cosine_and_sine(self, amount: Expr) -> tuple[Element, Element]:
        """Return cosine and sine of an angle, by the sums of the ring's own angles."""
        moving, constant = self._parted(_split(amount))
        c, s = self._constant_pair(constant)
        for angle, sign in moving:
            c_next, s_next = self._pair(angle, sign)
            c, s = c * c_next - s * s_next, s * c_next + c * s_next
        return self.reduced(c), self.reduced(s)

    def oriented(self, word: Word, vector: Vector) -> Vector:
        """Return a direction carried through the rotations of a word."""
        return self._carried(word, vector, translate=False)

    def carried(self, word: Word, vector: Vector) -> Vector:
        """Return a point carried through a word."""
        return self._carried(word, vector, translate=True)

    def cross(self, a: Vector, b: Vector) -> Vector:
        """Return the vector product."""
        x, y, z = (self.reduced(a[i] * b[j] - a[j] * b[i]) for i, j in ((1, 2), (2, 0), (0, 1)))
        return x, y, z

    def dot(self, a: Vector, b: Vector) -> Element:
        """Return the scalar product."""
        return self.reduced(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])

    def _carried(self, word: Word, vector: Vector, *, translate: bool) -> Vector:
        turned = list(vector)
        for motion in reversed(word):
            if motion.kind is MotionKind.ROTATION:
                self._rotate(turned, motion)
            elif translate:
                turned[motion.axis] = turned[motion.axis] + self.read(motion.amount)
        return turned[0], turned[1], turned[2]

    def _rotate(self, vector: list[Element], motion: Motion) -> None:
        first, second = (motion.axis + 1) % 3, (motion.axis + 2) % 3
        x, y = vector[first], vector[second]
        if not x and not y:
            return
        c, s = self.cosine_and_sine(motion.amount)
        vector[first] = self.reduced(c * x - s * y)
        vector[second] = self.reduced(s * x + c * y)

    def _unit(self, variable: Symbol) -> Expr:
        """Return the positive multiple of a variable that its joint turns by."""
        return abs(self._turning[variable].theta.coeff(variable)) * variable

    def _parted(self, terms: Sequence[tuple[Expr, Expr]]) -> tuple[list[tuple[Expr, int]], Expr]:
        """Part an angle into signed joint angles and a constant."""
        moving: list[tuple[Expr, int]] = []
        constant: Expr = Integer(0)
        for symbol, coefficient in terms:
            if symbol in self._turning:
                unit = self._unit(symbol)
                moving.append((unit, int(coefficient * symbol / unit)))
            else:
                constant = constant + coefficient * symbol
        return sorted(moving, key=lambda term: default_sort_key(term[0])), constant

    def _constant_pair(self, constant: Expr) -> tuple[Element, Element]:
        if not _is_opaque_angle(constant):
            return self.read(cos(constant)), self.read(sin(constant))
        angle, sign = _without_sign(constant)
        return self._pair(angle, sign)

    def _pair(self, angle: Expr, sign: int) -> tuple[Element, Element]:
        k = self.angles.index(angle)
        return self.ring.gens[2 * k], sign * self.ring.gens[2 * k + 1]


def _motions(robot: Robot) -> Iterable[Motion]:
    yield from robot.base
    for i in range(1, robot.n + 1):
        yield from link_word(robot, i)
    yield from robot.tool


def _split(amount: Expr) -> list[tuple[Expr, Expr]]:
    terms = ((part, c) for part, c in amount.as_coefficients_dict().items())
    return sorted(terms, key=lambda term: default_sort_key(term[0]))


def _without_sign(angle: Expr) -> tuple[Expr, int]:
    return (-angle, -1) if angle.could_extract_minus_sign() else (angle, 1)


def _is_opaque_angle(angle: Expr) -> bool:
    """Say whether the cosine of a constant angle is no plain number."""
    return bool(cos(angle).has(cos, sin))


def _is_power(expression: Expr) -> bool:
    return isinstance(expression, Pow) and expression.exp.is_Integer and expression.exp.is_positive


def _atoms(expression: Expr) -> set[Expr]:
    """Return what an expression is a polynomial in."""
    if expression.is_Rational:
        return set()
    if isinstance(expression, (Add, Mul)):
        return {atom for part in expression.args for atom in _atoms(part)}
    return _atoms(expression.base) if _is_power(expression) else {expression}
