"""Random consistent points: exact numbers that satisfy every equation of an arm.

Joint angles, slides and free lengths are drawn at random in a finite field, the table's own numbers
are taken as they are, and the goal is the pose that they give. What vanishes there vanishes
identically, up to a chance of one in 10^16; no rounding can mislead. The field has square roots of
-1 and the roots of unity that the arm's constant angles need, so cosines of 70 degrees are exact
too.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from math import lcm
from typing import Any

from sympy import Expr, Integer, Symbol, pi, primitive_root
from sympy.ntheory import isprime

from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.motion import rotations
from symdh.robot import JointType, MotionKind

#: Angles pi p/q with a larger q are drawn at random like symbols.
_LARGEST = 720_000
_BEGIN = 2**40


class Point:
    """One consistent point of a ring.

    Attributes
    ----------
    prime : int
    values : list of int
        The value of each generator of the ring.
    imaginary : int
        A square root of -1.
    """

    def __init__(self, ring: InverseRing, seed: int) -> None:
        self._random = random.Random(seed)
        self._ring = ring
        unit = _unit(ring)
        self.prime, root = _field(unit)
        self._unit = unit
        self._root = root
        self.imaginary = pow(root, unit // 4, self.prime)
        self._turned: dict[Expr, int] = {}
        self._lengths = self._drawn_lengths()
        self.values = self._values()
        self._memo: dict[Element, int] = {}

    def value(self, element: Element) -> int:
        """Return the value of an element, a number from 0 to prime - 1."""
        key = element
        found = self._memo.get(key)
        if found is None:
            found = self._memo[key] = self._evaluate(element)
        return found

    def define(self, generator: int, element: Element) -> None:
        """Give a generator the value of an element."""
        self.values[generator] = self.value(element)

    def term(self, powers: tuple[int, ...], coefficient: Any) -> int:
        """Return the value of one term."""
        prime = self.prime
        product = int(coefficient.numerator)
        if coefficient.denominator != 1:
            product = product * pow(int(coefficient.denominator), -1, prime)
        for k, power in enumerate(powers):
            if power == 1:
                product = product * self.values[k] % prime
            elif power:
                product = product * pow(self.values[k], power, prime) % prime
        return product

    def _evaluate(self, element: Element) -> int:
        self._ring.clock.check()
        terms = (self.term(powers, coefficient) for powers, coefficient in element.terms())
        return sum(terms) % self.prime

    def _values(self) -> list[int]:
        ring = self._ring
        joints = ring.arm.robot.joints
        values: list[int] = []
        for form in ring.forms:
            values += self._cosine_and_sine(ring.angle(form))
        values += [self._length(joints[row - 1].variable) for row in ring.slides]
        values += self._goal()
        values += [self._lengths[symbol] for symbol in ring.lengths]
        for angle in ring.constants:
            values += self._cosine_and_sine(angle)
        return values + [0] * (len(ring.letters) - len(values))

    def _goal(self) -> list[int]:
        """Multiply the chain, motion by motion, and return R, w and u."""
        columns = [[int(r == c) for r in range(3)] for c in range(3)]
        point = [0, 0, 0]
        p = self.prime
        for motion in reversed([m for word in self._ring.arm.rows for m in word]):
            if motion.kind is MotionKind.TRANSLATION:
                point[motion.axis] = (point[motion.axis] + self._length(motion.amount)) % p
                continue
            c, s = self._cosine_and_sine(motion.amount)
            first, second = (motion.axis + 1) % 3, (motion.axis + 2) % 3
            for vector in (*columns, point):
                x, y = vector[first], vector[second]
                vector[first], vector[second] = (c * x - s * y) % p, (s * x + c * y) % p
        back = [-sum(x * y for x, y in zip(column, point, strict=True)) % p for column in columns]
        return [*columns[0], *columns[1], *columns[2], *point, *back]

    def _cosine_and_sine(self, amount: Expr) -> tuple[int, int]:
        p = self.prime
        turned = 1
        for atom, coefficient in amount.as_coefficients_dict().items():
            turned = turned * self._turn(atom, coefficient) % p
        back = pow(turned, -1, p)
        cosine = (turned + back) * pow(2, -1, p) % p
        sine = (turned - back) * pow(2 * self.imaginary, -1, p) % p
        return cosine, sine

    def _turn(self, atom: Expr, coefficient: Expr) -> int:
        """Return e^(i angle) of a symbol or of a multiple of pi."""
        if coefficient.is_zero:
            return 1
        if atom is pi or atom is Integer(1):
            steps = coefficient * self._unit / 2
            if atom is pi and steps.is_Integer:
                return pow(self._root, int(steps) % self._unit, self.prime)
            atom, coefficient = coefficient * atom, Integer(1)
        known = self._ring.arm.robot.values.get(atom)
        if known is not None and atom in self._ring.arm.robot.parameters and not known.is_zero:
            multiple = known / pi * self._unit / 2
            if multiple.is_Integer:
                return pow(self._root, int(multiple * coefficient) % self._unit, self.prime)
        if atom not in self._turned:
            self._turned[atom] = self._random.randrange(2, self.prime)
        base = self._turned[atom]
        whole = coefficient if coefficient.is_Integer else Integer(1)
        return pow(base, int(whole), self.prime)

    def _drawn_lengths(self) -> Mapping[Symbol, int]:
        """Draw the slides, and the lengths to which the table gives no rational number."""
        robot = self._ring.arm.robot
        drawn = {}
        for symbol in self._ring.lengths:
            value = robot.values.get(symbol)
            if value is not None and value.is_Rational:
                drawn[symbol] = value.p * pow(value.q, -1, self.prime) % self.prime
            else:
                drawn[symbol] = self._random.randrange(1, self.prime)
        for joint in robot.joints:
            if joint.type is JointType.PRISMATIC and joint.variable is not None:
                drawn[joint.variable] = self._random.randrange(1, self.prime)
        return drawn

    def _length(self, amount: Expr | None) -> int:
        assert amount is not None
        total = 0
        for symbol, coefficient in amount.as_coefficients_dict().items():
            if not coefficient.is_zero:
                factor = coefficient.p * pow(coefficient.q, -1, self.prime)
                total += factor * self._lengths[symbol]
        return total % self.prime


def _unit(ring: InverseRing) -> int:
    """Return into how many parts a full turn is cut so that every constant angle is a whole."""
    unit = 8
    robot = ring.arm.robot
    amounts = [m.amount for word in ring.arm.rows for m in rotations(word)]
    amounts += [robot.values[s] for s in robot.parameters if s in robot.values]
    for amount in amounts:
        for atom, coefficient in amount.as_coefficients_dict().items():
            if atom is pi and coefficient.is_Rational:
                larger = lcm(unit, 2 * int(coefficient.q))
                unit = larger if larger <= _LARGEST else unit
    return unit


def _field(unit: int) -> tuple[int, int]:
    """Return a prime p and an element of order `unit`, which divides p - 1."""
    prime = _BEGIN // unit * unit + 1
    while not isprime(prime):
        prime += unit
    generator = primitive_root(prime)
    return prime, pow(generator, (prime - 1) // unit, prime)
