"""Expression graphs: each value is one node, however often it is used (hash consing).

Numbers are folded exactly, and only where the result stays a small exact number. Signs are carried
outward, so that ``-a*b``, ``a*(-b)`` and ``-(a*b)`` are one node.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from sympy import Expr, Integer, Symbol

from symdh.codegen.literals import nearest_double


class Op(Enum):
    """What a node computes from its arguments."""

    CONSTANT = "constant"
    SYMBOL = "symbol"
    NEG = "neg"
    ADD = "+"
    SUB = "-"
    MUL = "*"
    DIV = "/"
    SIN = "sin"
    COS = "cos"
    TAN = "tan"
    ASIN = "asin"
    ACOS = "acos"
    ATAN = "atan"
    ATAN2 = "atan2"
    SQRT = "sqrt"
    ABS = "abs"
    POW = "pow"


#: Nodes that are read, not computed.
LEAVES = frozenset({Op.CONSTANT, Op.SYMBOL})


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """A value of a graph; two nodes of one graph are equal when they are the same object.

    Attributes
    ----------
    index : int
        Place in the graph; arguments always come before what uses them.
    op : Op
    args : tuple of Node
    value : sympy.Expr or None
        The exact number of a constant, the symbol of a symbol, None of anything else.
    """

    index: int
    op: Op
    # Left out of repr: a shared graph printed as a tree can be exponentially long.
    args: tuple[Node, ...] = field(default=(), repr=False)
    value: Expr | None = None

    @property
    def exact(self) -> Expr:
        """The exact number of a constant, or the symbol of a symbol."""
        assert self.value is not None
        return self.value


class Graph:
    """Makes nodes, and never makes one twice."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], Node] = {}
        self.zero = self.constant(Integer(0))
        self.one = self.constant(Integer(1))

    def constant(self, value: Expr) -> Node:
        """Return the node of an exact real number.

        Raises
        ------
        UnsupportedError
            When a double cannot hold the number, or it is not real or not exact.
        """
        nearest_double(value)
        return self._node(Op.CONSTANT, value=value)

    def symbol(self, symbol: Symbol) -> Node:
        """Return the node of a joint variable or parameter."""
        return self._node(Op.SYMBOL, value=symbol)

    def neg(self, a: Node) -> Node:
        """Return -a."""
        if a.op is Op.CONSTANT:
            return self.constant(-a.exact)
        if a.op is Op.NEG:
            return a.args[0]
        return self._node(Op.NEG, a)

    def add(self, a: Node, b: Node) -> Node:
        """Return a + b."""
        if _foldable(a, b):
            return self.constant(a.exact + b.exact)
        if a is self.zero:
            return b
        if b is self.zero:
            return a
        if _has_minus(b):
            return self.sub(a, self.neg(b))
        if _has_minus(a):
            return self.sub(b, self.neg(a))
        return self._node(Op.ADD, a, b)

    def sub(self, a: Node, b: Node) -> Node:
        """Return a - b."""
        if _foldable(a, b):
            return self.constant(a.exact - b.exact)
        if a is b:
            return self.zero
        if a is self.zero:
            return self.neg(b)
        if b is self.zero:
            return a
        if _has_minus(b):
            return self.add(a, self.neg(b))
        if _has_minus(a):
            return self.neg(self.add(self.neg(a), b))
        if self._find(Op.SUB, b, a):
            return self.neg(self.sub(b, a))
        return self._node(Op.SUB, a, b)

    def mul(self, a: Node, b: Node) -> Node:
        """Return a * b; numbers and symbols are written before what is computed."""
        if _foldable(a, b):
            return self.constant(a.exact * b.exact)
        if self.zero in (a, b):
            return self.zero
        if a is self.one:
            return b
        if b is self.one:
            return a
        if _has_minus(a):
            return self.neg(self.mul(self.neg(a), b))
        if _has_minus(b):
            return self.neg(self.mul(a, self.neg(b)))
        first, second = sorted((a, b), key=_writing_rank)
        return self._node(Op.MUL, first, second)

    def div(self, a: Node, b: Node) -> Node:
        """Return a / b."""
        if _has_minus(a):
            return self.neg(self.div(self.neg(a), b))
        if _has_minus(b):
            return self.neg(self.div(a, self.neg(b)))
        return self._node(Op.DIV, a, b)

    def call(self, op: Op, *args: Node) -> Node:
        """Return the value of a function of the mathematics library."""
        return self._node(op, *args)

    def _node(self, op: Op, *args: Node, value: Expr | None = None) -> Node:
        known = self._find(op, *args, value=value)
        if known is not None:
            return known
        node = Node(len(self._known), op, args, value)
        self._known[_key(op, args, value)] = node
        return node

    def _find(self, op: Op, *args: Node, value: Expr | None = None) -> Node | None:
        return self._known.get(_key(op, args, value))


def _key(op: Op, args: tuple[Node, ...], value: Expr | None) -> tuple[object, ...]:
    places = [arg.index for arg in args]
    if op in (Op.ADD, Op.MUL):
        places.sort()
    return (op, *places, value)


def _foldable(a: Node, b: Node) -> bool:
    """Say whether two numbers are folded: with a rational among them the result stays small.

    Two irrational ones are left to the compiler; folded exactly, they would grow without end.
    """
    numbers = a.op is b.op is Op.CONSTANT
    return numbers and bool(a.exact.is_Rational or b.exact.is_Rational)


def _has_minus(a: Node) -> bool:
    return a.op is Op.NEG or (a.op is Op.CONSTANT and bool(a.exact.is_negative))


def _writing_rank(a: Node) -> int:
    return {Op.CONSTANT: 0, Op.SYMBOL: 1}.get(a.op, 2)
