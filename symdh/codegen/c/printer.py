"""Expressions in C."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Expr

from symdh.codegen.graph import Node, Op
from symdh.codegen.precision import Precision
from symdh.codegen.printer import Printer


class CPrinter(Printer):
    """Writes literals of a kind of number, and sums as MISRA C wants them."""

    brackets_products = True

    def __init__(
        self, precision: Precision, functions: Mapping[Op, str], names: Mapping[Node, str]
    ) -> None:
        super().__init__(functions, names)
        self._precision = precision

    def number(self, value: Expr) -> str:
        """Write an exact number."""
        return self._precision.literal(value)
