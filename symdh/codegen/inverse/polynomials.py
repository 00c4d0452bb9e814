"""Elements of the ring of an arm -> nodes, in few operations."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Rational

from symdh.codegen.graph import Graph, Node, Op
from symdh.kinematics.inverse.ring import Element

#: Generators with their powers, and the coefficient in front of them.
Terms = dict[tuple[tuple[int, int], ...], Node]


class Polynomials:
    """Turns elements into nodes.

    Parameters
    ----------
    graph : Graph
    letters : list of Node or None
        What each generator stands for; filled in while the steps go on.
    constants : range
        The generators that are numbers of the table.
    sizes : mapping of int to Node
        How large other generators may be that are no cosines, sines or entries of a rotation.
    """

    def __init__(
        self,
        graph: Graph,
        letters: list[Node | None],
        constants: range,
        sizes: Mapping[int, Node],
    ) -> None:
        self.graph = graph
        self.letters = letters
        self._constants = constants
        self._sizes = sizes
        self._known: dict[Element, Node] = {}

    def node(self, element: Element) -> Node:
        """Return the value of an element."""
        if element not in self._known:
            self._known[element] = self._nested(self._terms(element))
        return self._known[element]

    def term(self, powers: Sequence[int], coefficient: Any) -> Node:
        """Return the value of one term."""
        value = self.number(coefficient)
        for k, power in enumerate(powers):
            for _ in range(power):
                value = self.graph.mul(value, self._letter(k))
        return value

    def size(self, element: Element) -> Node:
        """Return what an element could be at most if every cosine and sine were 1."""
        graph = self.graph
        total = graph.zero
        for powers, coefficient in element.terms():
            part = self.number(abs(coefficient))
            for k, power in enumerate(powers):
                for _ in range(power):
                    part = graph.mul(part, self._size(k))
            total = graph.add(total, part)
        return total

    def _size(self, k: int) -> Node:
        if k in self._constants:
            return magnitude(self.graph, self._letter(k))
        return self._sizes.get(k, self.graph.one)

    def number(self, coefficient: Any) -> Node:
        """Return a rational number of the ring."""
        exact = Rational(int(coefficient.numerator), int(coefficient.denominator))
        return self.graph.constant(exact)

    def _letter(self, k: int) -> Node:
        letter = self.letters[k]
        assert letter is not None, "a step uses what no step before it gives"
        return letter

    def _terms(self, element: Element) -> Terms:
        """Gather terms that differ in the numbers of the table alone."""
        terms: Terms = {}
        for powers, coefficient in element.terms():
            value = self.number(coefficient)
            rest = []
            for k, power in enumerate(powers):
                if power and self._is_number(k):
                    for _ in range(power):
                        value = self.graph.mul(value, self._letter(k))
                elif power:
                    rest.append((k, power))
            key = tuple(rest)
            terms[key] = self.graph.add(terms[key], value) if key in terms else value
        return terms

    def _is_number(self, k: int) -> bool:
        return k in self._constants or self._letter(k).op is Op.CONSTANT

    def _nested(self, terms: Terms) -> Node:
        """Take the generator out that stands in most terms, and nest what it multiplies."""
        counts = Counter(k for key in terms for k, _ in key)
        best = max(counts, key=lambda k: (counts[k], -k), default=None)
        if best is None or counts[best] < 2:
            return self._flat(terms)
        inside: Terms = {}
        outside: Terms = {}
        for key, value in terms.items():
            powers = dict(key)
            if best in powers:
                powers[best] -= 1
                inside[tuple((k, p) for k, p in powers.items() if p)] = value
            else:
                outside[key] = value
        nested = self.graph.mul(self._letter(best), self._nested(inside))
        return self.graph.add(self._nested(outside), nested) if outside else nested

    def _flat(self, terms: Terms) -> Node:
        total = self.graph.zero
        for key, value in terms.items():
            part = value
            for k, power in key:
                for _ in range(power):
                    part = self.graph.mul(part, self._letter(k))
            total = self.graph.add(total, part)
        return total


def magnitude(graph: Graph, node: Node) -> Node:
    """Return the absolute value of a node; that of a number is a number."""
    if node.op is Op.CONSTANT:
        return graph.constant(abs(node.exact))
    if node.op is Op.NEG:
        return magnitude(graph, node.args[0])
    return node if node.op is Op.ABS else graph.call(Op.ABS, node)
