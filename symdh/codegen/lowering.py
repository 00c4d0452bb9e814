"""Exact expressions -> nodes of a graph."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce

from sympy import (
    Abs,
    Add,
    Expr,
    Integer,
    Mul,
    Pow,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    pi,
    sin,
    tan,
)

from symdh.codegen.graph import Graph, Node, Op
from symdh.codegen.labels import angle_label
from symdh.errors import UnsupportedError
from symdh.robot import natural_key

_CALLS = {
    tan: Op.TAN,
    asin: Op.ASIN,
    acos: Op.ACOS,
    atan: Op.ATAN,
    atan2: Op.ATAN2,
    Abs: Op.ABS,
}

#: Constant or not, of a joint or not, the joint's row, and the names of the symbols.
_ChainKey = tuple[bool, bool, int, list[tuple[tuple[str, int], ...]]]


class Lowering:
    """Turns the expressions of one robot into nodes of one graph.

    Parameters
    ----------
    graph : Graph
    rows : mapping of Symbol to int
        The row, counted from 1, that each joint variable belongs to.
    splits_sums : bool
        Whether the cosine of a sum of angles is made of theirs, ``c2 * c3 - s2 * s3``: no more
        calls, and as exact for large angles, where ``q2 + q3`` itself is rounded.

    Attributes
    ----------
    names : dict of Node to str
        Readable names for the nodes of angles, their cosines and sines: angle23, c23, s23.
    """

    def __init__(
        self, graph: Graph, rows: Mapping[Symbol, int], *, splits_sums: bool = False
    ) -> None:
        self.graph = graph
        self.names: dict[Node, str] = {}
        self._rows = rows
        self._splits_sums = splits_sums
        self._cos_sin: dict[Expr, tuple[Node, Node]] = {}
        self._chain_keys: dict[Expr, _ChainKey] = {}

    def node(self, expression: Expr) -> Node:
        """Return the node of an expression.

        Raises
        ------
        UnsupportedError
            When it holds something that is not part of a table's language.
        """
        if not expression.free_symbols:
            return self.graph.constant(expression)
        if isinstance(expression, Symbol):
            return self.graph.symbol(expression)
        if isinstance(expression, Add):
            return self._sum(self._in_chain_order(expression.args))
        if isinstance(expression, Mul):
            return self._product(expression)
        if isinstance(expression, Pow):
            return self._power(expression.base, expression.exp)
        if isinstance(expression, cos):
            return self.cos_sin(expression.args[0])[0]
        if isinstance(expression, sin):
            return self.cos_sin(expression.args[0])[1]
        if expression.func in _CALLS:
            return self.graph.call(_CALLS[expression.func], *map(self.node, expression.args))
        raise UnsupportedError(f"no code can be generated for {expression}")

    def cos_sin(self, angle: Expr) -> tuple[Node, Node]:
        """Return the cosine and the sine of an angle in radians.

        Quarter turns and a leading minus are taken out exactly, so that no code adds a rounded
        pi/2 to a joint's angle and c_1, s_1 serve ``theta_1 + 90 deg`` and ``-theta_1`` as well.
        """
        if angle not in self._cos_sin:
            quarters, rest = _split_quarters(angle)
            cosine, sine = self._cos_sin_of(rest)
            for _ in range(quarters % 4):
                # cos(x + 90 deg) = -sin x, sin(x + 90 deg) = cos x
                cosine, sine = self.graph.neg(sine), cosine
            self._cos_sin[angle] = cosine, sine
        return self._cos_sin[angle]

    def _cos_sin_of(self, angle: Expr) -> tuple[Node, Node]:
        if not angle.free_symbols:
            return self.graph.constant(cos(angle)), self.graph.constant(sin(angle))
        terms = self._in_chain_order(Add.make_args(angle))
        negative = terms[0].could_extract_minus_sign()
        if negative:
            terms = [-term for term in terms]
        if self._splits_sums and len(terms) > 1:
            cosine, sine = self._cos_sin_of_sum(terms)
        else:
            cosine, sine = self._called(terms)
        return cosine, self.graph.neg(sine) if negative else sine

    def _called(self, terms: Sequence[Expr]) -> tuple[Node, Node]:
        argument = self._sum(terms)
        cosine = self.graph.call(Op.COS, argument)
        sine = self.graph.call(Op.SIN, argument)
        self._name(terms, angle=argument, c=cosine, s=sine)
        return cosine, sine

    def _cos_sin_of_sum(self, terms: Sequence[Expr]) -> tuple[Node, Node]:
        """Add the terms one by one, so that sums that begin alike share what they can."""
        graph = self.graph
        total = terms[0]
        cosine, sine = self.cos_sin(total)
        for count, term in enumerate(terms[1:], start=2):
            c, s = self.cos_sin(term)
            total += term
            if total not in self._cos_sin:
                self._cos_sin[total] = (
                    graph.sub(graph.mul(cosine, c), graph.mul(sine, s)),
                    graph.add(graph.mul(sine, c), graph.mul(cosine, s)),
                )
            cosine, sine = self._cos_sin[total]
            self._name(terms[:count], c=cosine, s=sine)
        return cosine, sine

    def _name(self, terms: Sequence[Expr], **nodes: Node) -> None:
        label = angle_label(terms, self._rows)
        for prefix, node in nodes.items():
            self.names.setdefault(node, prefix + label)

    def _sum(self, terms: Iterable[Expr]) -> Node:
        return reduce(self.graph.add, map(self.node, terms))

    def _product(self, product: Mul) -> Node:
        number, rest = product.as_independent(*product.free_symbols, as_Add=False)
        numerator = [self.graph.constant(number)]
        denominator = []
        for factor in self._in_chain_order(Mul.make_args(rest)):
            if isinstance(factor, Pow) and factor.exp.is_negative:
                denominator.append(self._power(factor.base, -factor.exp))
            else:
                numerator.append(self.node(factor))
        above = reduce(self.graph.mul, numerator)
        if not denominator:
            return above
        return self.graph.div(above, reduce(self.graph.mul, denominator))

    def _power(self, base: Expr, exponent: Expr) -> Node:
        if not exponent.is_Rational:
            raise UnsupportedError(f"no code can be generated for {base**exponent}")
        if exponent.is_negative:
            return self.graph.div(self.graph.one, self._power(base, -exponent))
        root = self.node(base)
        if exponent.q == 1:
            return self._repeated(root, exponent.p)
        if exponent.q == 2:
            return self._repeated(self.graph.call(Op.SQRT, root), exponent.p)
        return self.graph.call(Op.POW, root, self.graph.constant(exponent))

    def _repeated(self, factor: Node, times: int) -> Node:
        """Multiply a factor with itself, by halving: x**5 is x * (x*x) * (x*x)."""
        if times == 1:
            return factor
        half = self._repeated(factor, times // 2)
        square = self.graph.mul(half, half)
        return self.graph.mul(factor, square) if times % 2 else square

    def _in_chain_order(self, parts: Iterable[Expr]) -> list[Expr]:
        """Sort the parts of a sum or product: by joints, then other symbols, then constants.

        Sums of angles along a chain then begin alike, and share what they have in common.
        """
        return sorted(parts, key=self._chain_key)

    def _chain_key(self, part: Expr) -> _ChainKey:
        if part not in self._chain_keys:
            symbols = part.free_symbols
            rows = [self._rows[symbol] for symbol in symbols if symbol in self._rows]
            names = sorted(natural_key(symbol.name) for symbol in symbols)
            self._chain_keys[part] = not symbols, not rows, min(rows, default=0), names
        return self._chain_keys[part]


def _split_quarters(angle: Expr) -> tuple[int, Expr]:
    """Write an angle as k 90 deg plus a rest whose constant part is at most 45 deg."""
    constant = angle.as_independent(*angle.free_symbols, as_Add=True)[0]
    half_turns = constant.coeff(pi)
    quarters = round(half_turns * 2) if half_turns.is_Rational else 0
    return quarters, angle - Integer(quarters) * pi / 2
