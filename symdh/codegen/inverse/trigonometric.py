"""Trigonometric polynomials of one angle with nodes for coefficients.

``f_0 + sum_k (2 Re f_k cos k x - 2 Im f_k sin k x)``, kept as the complex f_k with k >= 0 of
``sum_k f_k e^(i k x)``; f_-k is the conjugate of f_k.
"""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Rational

from symdh.codegen.graph import Graph, Node
from symdh.codegen.inverse.polynomials import Polynomials
from symdh.kinematics.inverse.ring import Element

#: Real and imaginary part.
Complex = tuple[Node, Node]
Trigonometric = dict[int, Complex]

_HALF = Rational(1, 2)


class Trigonometry:
    """Makes and multiplies trigonometric polynomials.

    Parameters
    ----------
    polynomials : Polynomials
        Gives the values of all but the angle.
    """

    def __init__(self, polynomials: Polynomials) -> None:
        self._polynomials = polynomials
        self._graph: Graph = polynomials.graph

    def of(self, element: Element, angle: int) -> Trigonometric:
        """Write an element by powers of e^(ix), x the angle of that number in the ring."""
        graph = self._graph
        half, zero = graph.constant(_HALF), graph.zero
        # c = (z + 1/z) / 2, s = (z - 1/z) / (2 i); only the powers from 0 up are kept.
        cosine: Trigonometric = {1: (half, zero)}
        sine: Trigonometric = {1: (zero, graph.neg(half))}
        total: Trigonometric = {}
        c, s = 2 * angle, 2 * angle + 1
        for powers, coefficient in element.terms():
            rest = (*powers[:c], 0, 0, *powers[s + 1 :])
            part: Trigonometric = {0: (self._polynomials.term(rest, coefficient), zero)}
            for factor, times in ((cosine, powers[c]), (sine, powers[s])):
                for _ in range(times):
                    part = self.product(part, factor)
            total = self.added(total, part)
        return total

    def added(self, a: Trigonometric, b: Trigonometric, sign: int = 1) -> Trigonometric:
        """Return a + b, or a - b."""
        graph = self._graph
        combine = graph.add if sign > 0 else graph.sub
        none = (graph.zero, graph.zero)
        total = {}
        for k in sorted({*a, *b}):
            (re_a, im_a), (re_b, im_b) = a.get(k, none), b.get(k, none)
            total[k] = combine(re_a, re_b), combine(im_a, im_b)
        return total

    def scaled(self, a: Trigonometric, factor: Node) -> Trigonometric:
        """Return a times a number."""
        graph = self._graph
        return {k: (graph.mul(factor, re), graph.mul(factor, im)) for k, (re, im) in a.items()}

    def product(self, a: Trigonometric, b: Trigonometric) -> Trigonometric:
        """Return the product of two."""
        graph = self._graph
        total: Trigonometric = {}
        for i, x in self._whole(a).items():
            for j, y in self._whole(b).items():
                if i + j >= 0:
                    re, im = total.get(i + j, (graph.zero, graph.zero))
                    re = graph.add(re, graph.sub(graph.mul(x[0], y[0]), graph.mul(x[1], y[1])))
                    im = graph.add(im, graph.add(graph.mul(x[0], y[1]), graph.mul(x[1], y[0])))
                    total[i + j] = re, im
        if 0 in total:
            # It is real; the nodes would not cancel by themselves.
            total[0] = total[0][0], graph.zero
        return total

    def eliminated(
        self, coefficients: tuple[Trigonometric, ...], scales: tuple[Node, ...]
    ) -> Trigonometric:
        """Return what is left of two equations ``A s + B c + C = 0`` in another angle.

        See `symdh.kinematics.inverse.rules.laurent.eliminated`, which does it with numbers.
        """
        a_1, b_1, c_1, a_2, b_2, c_2 = coefficients
        product, added = self.product, self.added
        if scales:
            square_1, square_2 = (self._graph.mul(scale, scale) for scale in scales)
            left = self.scaled(product(c_1, c_1), square_2)
            left = added(left, self.scaled(product(c_2, c_2), square_1))
            lengths = added(product(a_1, a_1), product(b_1, b_1))
            return added(left, self.scaled(lengths, square_2), -1)
        sine = added(product(b_1, c_2), product(b_2, c_1), -1)
        cosine = added(product(a_2, c_1), product(a_1, c_2), -1)
        determinant = added(product(a_1, b_2), product(a_2, b_1), -1)
        squares = added(product(sine, sine), product(cosine, cosine))
        return added(squares, product(determinant, determinant), -1)

    def real(self, a: Trigonometric, degree: int) -> tuple[Node, ...]:
        """Return the coefficients of 1, cos x, sin x, cos 2x, sin 2x up to a degree."""
        graph = self._graph
        none = (graph.zero, graph.zero)
        two = graph.constant(Rational(2))
        found = [a.get(0, none)[0]]
        for k in range(1, degree + 1):
            re, im = a.get(k, none)
            found += [graph.mul(two, re), graph.neg(graph.mul(two, im))]
        return tuple(found)

    def _whole(self, a: Mapping[int, Complex]) -> Trigonometric:
        """Add the negative powers."""
        return {**{-k: (re, self._graph.neg(im)) for k, (re, im) in a.items() if k}, **a}
