"""Nodes as arithmetic expressions, in the notation that C, Python and their relatives share."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum

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

    def __init__(self, functions: Mapping[Op, str], names: Mapping[Node, str]) -> None:
        self._functions = functions
        self._names = names

    def expression(self, node: Node) -> str:
        """Write a node as its name or, where it has none, as what computes it."""
        return self._names.get(node) or self.definition(node)

    def definition(self, node: Node) -> str:
        """Write what computes a node, whether it has a name or not."""
        return self._write(node)[0]

    def _write(self, node: Node) -> tuple[str, _Binds]:
        if node.op is Op.CONSTANT:
            text = literal(node.exact)
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
        return f"{self._bracketed(left, binds)} {op.value} {self._bracketed(right, tighter)}"

    def _negative(self, node: Node) -> str:
        if node.op is Op.SUB and node not in self._names:
            return self._binary(Op.SUB, *reversed(node.args))
        return f"-{self._bracketed(node, _Binds.PRODUCT)}"

    def _bracketed(self, node: Node, at_least: _Binds) -> str:
        if node in self._names:
            return self._names[node]
        text, binds = self._write(node)
        return text if binds >= at_least else f"({text})"
