"""Nodes as arithmetic expressions, in the notation that C, Python and their relatives share."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum

from sympy import Expr

from symdh.codegen.graph import Node, Op
from symdh.codegen.literals import literal


class _Binds(IntEnum):
    """How tightly an expression holds together."""

    SUM = 1
    PRODUCT = 2
    ATOM = 3


_BINARY = {
    Op.ADD: _Binds.SUM,
    Op.SUB: _Binds.SUM,
    Op.MUL: _Binds.PRODUCT,
    Op.DIV: _Binds.PRODUCT,
}


class Printer:
    """Writes nodes in one language.

    Parameters
    ----------
    functions : mapping of Op to str
        What the language calls the functions of its mathematics library.
    names : mapping of Node to str
        Identifiers of inputs and of assigned locals.
    """

    #: Whether a product in a sum stands in brackets: some coding rules want every precedence shown.
    brackets_products = False

    def __init__(self, functions: Mapping[Op, str], names: Mapping[Node, str]) -> None:
        self._functions = functions
        self._names = names

    def number(self, value: Expr) -> str:
        """Write an exact number; languages whose literals differ say so here."""
        return literal(value)

    def expression(self, node: Node) -> str:
        """Write a node as its name or, where it has none, as what computes it."""
        return self._names.get(node) or self.definition(node)

    def definition(self, node: Node) -> str:
        """Write what computes a node, whether it has a name or not."""
        return self._write(node)[0]

    def _write(self, node: Node) -> tuple[str, _Binds]:
        if node.op is Op.CONSTANT:
            text = self.number(node.exact)
            return text, _Binds.SUM if text.startswith("-") else _Binds.ATOM
        if node.op is Op.NEG:
            return self._negative(node.args[0]), _Binds.SUM
        if node.op in _BINARY:
            return self._binary(node.op, *node.args), _BINARY[node.op]
        arguments = ", ".join(self.expression(arg) for arg in node.args)
        return f"{self._functions[node.op]}({arguments})", _Binds.ATOM

    def _binary(self, op: Op, left: Node, right: Node) -> str:
        binds = _BINARY[op]
        # The right side is bracketed even in a sum: a + (b + c) rounds unlike (a + b) + c.
        tighter = _Binds(binds + 1)
        first, second = self._bracketed(left, binds), self._bracketed(right, tighter)
        if self.brackets_products and binds is _Binds.SUM:
            first, second = self._product_set_off(left, first), self._product_set_off(right, second)
        return f"{first} {op.value} {second}"

    def _product_set_off(self, node: Node, text: str) -> str:
        is_product = _BINARY.get(node.op) is _Binds.PRODUCT and node not in self._names
        return f"({text})" if is_product else text

    def _negative(self, node: Node) -> str:
        if node.op is Op.SUB and node not in self._names:
            return self._binary(Op.SUB, *reversed(node.args))
        return f"-{self._bracketed(node, _Binds.PRODUCT)}"

    def _bracketed(self, node: Node, at_least: _Binds) -> str:
        if node in self._names:
            return self._names[node]
        text, binds = self._write(node)
        return text if binds >= at_least else f"({text})"
