"""Nodes as plain ASCII: ``a1*c1 + a2*c12``, or spelt out as ``cos(theta1 + theta2)``.

The spelt-out form is read back by symdh's own expression parser.
"""

from __future__ import annotations

from collections.abc import Sequence

from symdh.notation import MathWriter, Piece, joined
from symdh.notation.nodes import (
    Degrees,
    Fraction,
    Generic,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Operator,
    Pi,
    PoseName,
    Product,
    Rounded,
    Screw,
    Short,
    Sum,
    Unit,
)
from symdh.notation.numbers import decimal


def _piece(text: str) -> Piece:
    return Piece(text, len(text))


class PlainWriter(MathWriter):
    """Writes expressions in ASCII."""

    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number; an angle carries its unit."""
        match node:
            case Number(value=value):
                return _piece(decimal(value))
            case Degrees(value=value):
                return _piece(f"{decimal(value)} deg")
            case Pi():
                return _piece("pi")
            case Rounded(text=text) | Unit(text=text):
                return _piece(text)

    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol; a subscript that is not plain digits stands in braces."""
        match node:
            case Name(text=text):
                return _piece(text)
            case Generic(letter=letter, index=index):
                return _piece(f"{letter}_{{{index}}}" if index else letter)
            case Short(function=function, label=label):
                return _piece(function + (label if label.isdigit() else f"_{{{label}}}"))

    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""
        match node:
            case PoseName(start=start, end=end):
                return _piece(f"T({start},{end})")
            case Screw(axis=axis):
                return _piece(f"Screw({axis.name.lower()})")

    def operator(self, node: Operator) -> list[Piece]:
        """Return an elementary motion as the table spells it: ``Rx(90 deg)``."""
        name = f"{node.kind.value}{node.axis.name.lower()}("
        return [_piece(name), *self.pieces(node.amount), _piece(")")]

    def matrix(self, node: Matrix) -> list[Piece]:
        """Return a matrix as nested lists."""
        rows = (", ".join(self.text(entry) for entry in row) for row in node.rows)
        return [_piece("[" + ", ".join(f"[{row}]" for row in rows) + "]")]

    def fraction(self, top: Node, bottom: Node) -> list[Piece]:
        """Return a quotient on one line."""
        over = self._guarded(top, Sum, Negative)
        under = self._guarded(bottom, Sum, Negative, Product, Fraction)
        return [*over, _piece("/"), *under]

    def power(self, base: list[Piece], exponent: str, node: Node) -> list[Piece]:
        """Return a power."""
        return [*base, _piece("**" + (exponent if exponent.isdigit() else f"({exponent})"))]

    def root(self, radicand: list[Piece]) -> list[Piece]:
        """Return a square root."""
        return [_piece("sqrt("), *radicand, _piece(")")]

    def call(self, function: str, arguments: Sequence[Node]) -> list[Piece]:
        """Return a function with its arguments."""
        return [_piece(f"{function}({', '.join(joined(self.pieces(a)) for a in arguments)})")]

    def times(self, left: Node, right: Node) -> list[Piece]:
        """Return a multiplication sign."""
        return [_piece("*")]

    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return round brackets, the only ones that the parser reads."""
        return _piece("("), _piece(")")

    def plus_minus(self, negative: bool) -> Piece:
        """Return a binary sign."""
        return _piece(" - " if negative else " + ")

    def sign(self) -> Piece:
        """Return a leading minus."""
        return _piece("-")

    def equals(self) -> Piece:
        """Return an equality sign."""
        return _piece(" = ")

    def comma(self) -> Piece:
        """Return a comma."""
        return _piece(", ")

    def gap(self) -> Piece:
        """Return a comma between formulas."""
        return _piece(", ")

    def dot(self) -> Piece:
        """Return the sign of a scalar product."""
        return _piece(" . ")

    def beside(self) -> Piece:
        """Return the sign between transforms."""
        return _piece("*")
