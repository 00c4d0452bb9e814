"""Nodes as plain ASCII: ``a1*c1 + a2*c12``, or spelt out as ``cos(theta1 + theta2)``.

The spelt-out form is read back by symdh's own expression parser.
"""

from __future__ import annotations

from collections.abc import Sequence

from symdh.notation import Piece, joined
from symdh.notation.nodes import (
    Degrees,
    Generic,
    Matrix,
    Name,
    Node,
    Number,
    Operator,
    Pi,
    PoseName,
    Rounded,
    Screw,
    Short,
    Unit,
)
from symdh.notation.numbers import decimal
from symdh.render.text_math import TextWriter, text_piece


class PlainWriter(TextWriter):
    """Writes expressions in ASCII."""

    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number; an angle carries its unit."""
        match node:
            case Number(value=value):
                return text_piece(decimal(value))
            case Degrees(value=value):
                return text_piece(f"{decimal(value)} deg")
            case Pi():
                return text_piece("pi")
            case Rounded(text=text) | Unit(text=text):
                return text_piece(text)

    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol; a subscript that is not plain digits stands in braces."""
        match node:
            case Name(text=text):
                return text_piece(text)
            case Generic(letter=letter, index=index):
                return text_piece(f"{letter}_{{{index}}}" if index else letter)
            case Short(function=function, label=label):
                return text_piece(function + (label if label.isdigit() else f"_{{{label}}}"))

    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""
        match node:
            case PoseName(start=start, end=end):
                return text_piece(f"T({start},{end})")
            case Screw(axis=axis):
                return text_piece(f"Screw({axis.name.lower()})")

    def operator(self, node: Operator) -> list[Piece]:
        """Return an elementary motion as the table spells it: ``Rx(90 deg)``."""
        name = f"{node.kind.value}{node.axis.name.lower()}("
        return [text_piece(name), *self.pieces(node.amount), text_piece(")")]

    def matrix(self, node: Matrix) -> list[Piece]:
        """Return a matrix as nested lists."""
        rows = (", ".join(self.text(entry) for entry in row) for row in node.rows)
        return [text_piece("[" + ", ".join(f"[{row}]" for row in rows) + "]")]

    def power(self, base: list[Piece], exponent: str, node: Node) -> list[Piece]:
        """Return a power."""
        return [*base, text_piece("**" + (exponent if exponent.isdigit() else f"({exponent})"))]

    def root(self, radicand: list[Piece]) -> list[Piece]:
        """Return a square root."""
        return [text_piece("sqrt("), *radicand, text_piece(")")]

    def call(self, function: str, arguments: Sequence[Node]) -> list[Piece]:
        """Return a function with its arguments."""
        return [text_piece(f"{function}({', '.join(joined(self.pieces(a)) for a in arguments)})")]

    def times(self, left: Node, right: Node) -> list[Piece]:
        """Return a multiplication sign."""
        return [text_piece("*")]

    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return round brackets, the only ones that the parser reads."""
        return text_piece("("), text_piece(")")

    def gap(self) -> Piece:
        """Return a comma between formulas."""
        return text_piece(", ")

    def dot(self) -> Piece:
        """Return the sign of a scalar product."""
        return text_piece(" . ")

    def cross(self) -> Piece:
        """Return the sign of a vector product."""
        return text_piece(" x ")

    def transpose(self) -> Piece:
        """Return the mark of a transposed matrix."""
        return text_piece("^T")

    def beside(self) -> Piece:
        """Return the sign between transforms."""
        return text_piece("*")
