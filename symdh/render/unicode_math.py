"""Nodes as Unicode text for a terminal: θ₁, c₁₂, ⁰T₂; widths in columns."""

from __future__ import annotations

from collections.abc import Sequence

from symdh.notation import MathWriter, Piece, joined
from symdh.notation.names import GREEK, split_name
from symdh.notation.nodes import (
    Call,
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
from symdh.robot import MotionKind

_SUBSCRIPTS = dict(
    zip("0123456789+-=()aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ", strict=True)
)
_SUPERSCRIPTS = dict(
    zip(
        "0123456789+-=()abcdefghijklmnoprstuvwxyz",
        "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ᵃᵇᶜᵈᵉᶠᵍʰⁱʲᵏˡᵐⁿᵒᵖʳˢᵗᵘᵛʷˣʸᶻ",
        strict=True,
    )
)


def _piece(text: str) -> Piece:
    # A combining hat takes no column of its own.
    return Piece(text, len(text) - text.count("\u0302"))


class UnicodeWriter(MathWriter):
    """Writes formulas for a terminal."""

    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number, an angle in degrees, a unit or pi."""
        match node:
            case Number(value=value):
                return _piece(decimal(value))
            case Degrees(value=value):
                return _piece(f"{decimal(value)}°")
            case Rounded(text=text) | Unit(text=text):
                return _piece(text)
            case Pi():
                return _piece("π")

    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol with its subscript."""
        match node:
            case Name(text=text, starred=starred):
                letter, index = split_name(text)
                return _piece(
                    GREEK.get(letter, letter) + _lowered(index) + ("*" if starred else "")
                )
            case Short(function=function, label=label):
                return _piece(function + _lowered(label))
            case Generic(letter=letter, index=index, stage=stage, hat=hat):
                above = _raised(f"({stage})") if stage else ""
                mark = "\u0302" if hat else ""
                return _piece(GREEK.get(letter, letter) + mark + _lowered(index) + above)

    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""
        match node:
            case Screw(axis=axis):
                return _piece(f"Screw_{axis.name.lower()}")
            case PoseName(start=start, end=end, craig=craig):
                end_text = _lowered(end)
                return _piece(
                    f"{_raised(start)}{end_text}T" if craig else f"{_raised(start)}T{end_text}"
                )

    def operator(self, node: Operator) -> list[Piece]:
        """Return ``Rx(α)`` and ``Dx(a)`` in Craig's style, else ``Rot(x, α)``."""
        axis = node.axis.name.lower()
        turning = node.kind is MotionKind.ROTATION
        if node.craig:
            head = f"{'R' if turning else 'D'}{axis}("
        else:
            head = f"{'Rot' if turning else 'Trans'}({axis}, "
        return [_piece(head), *self.pieces(node.amount), _piece(")")]

    def matrix(self, node: Matrix) -> list[Piece]:
        """Return a matrix on one line; `matrix_lines` writes it in rows."""
        rows = (", ".join(self.text(entry) for entry in row) for row in node.rows)
        return [_piece("[" + "; ".join(rows) + "]")]

    def matrix_lines(self, node: Matrix) -> list[str]:
        """Return a matrix as lines with tall brackets."""
        cells = [[self.text(entry) for entry in row] for row in node.rows]
        widths = [max(_piece(cell).width for cell in column) for column in zip(*cells, strict=True)]
        lines = []
        for number, row in enumerate(cells):
            body = "  ".join(
                cell.center(int(width)) for cell, width in zip(row, widths, strict=True)
            )
            left, right = _bracket_pair(number, len(cells))
            lines.append(f"{left} {body} {right}")
        return lines

    def fraction(self, top: Node, bottom: Node) -> list[Piece]:
        """Return a quotient on one line."""
        over = self._guarded(top, Sum, Negative)
        under = self._guarded(bottom, Sum, Negative, Product, Fraction)
        return [*over, _piece("/"), *under]

    def power(self, base: list[Piece], exponent: str, node: Node) -> list[Piece]:
        """Return a power; whole exponents are raised."""
        raised = _raised(exponent) if exponent.isdigit() else f"^({exponent})"
        return [*base, _piece(raised)]

    def root(self, radicand: list[Piece]) -> list[Piece]:
        """Return a square root."""
        return [_piece("√("), *radicand, _piece(")")]

    def call(self, function: str, arguments: Sequence[Node]) -> list[Piece]:
        """Return a function; a single symbol follows sine and cosine without brackets."""
        inner = ", ".join(joined(self.pieces(argument)) for argument in arguments)
        first = arguments[0]
        if function in ("sin", "cos", "tan") and not isinstance(
            first, (Sum, Negative, Fraction, Product, Call)
        ):
            return [_piece(f"{function} {inner}")]
        return [_piece(f"{function}({inner})")]

    def times(self, left: Node, right: Node) -> list[Piece]:
        """Return a space, or a dot between numbers."""
        return [_piece("·" if isinstance(right, (Number, Rounded, Degrees)) else " ")]

    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return round and square brackets in turn."""
        return (_piece("["), _piece("]")) if height % 2 else (_piece("("), _piece(")"))

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
        """Return a comma between numbers."""
        return _piece(", ")

    def gap(self) -> Piece:
        """Return a comma and a wide space between formulas."""
        return _piece(",   ")

    def dot(self) -> Piece:
        """Return the sign of a scalar product."""
        return _piece(" · ")

    def beside(self) -> Piece:
        """Return the space between transforms."""
        return _piece(" ")


def _lowered(index: str) -> str:
    if not index:
        return ""
    if all(character in _SUBSCRIPTS or character == "," for character in index):
        return "".join(_SUBSCRIPTS.get(character, character) for character in index)
    return f"_{index}"


def _raised(text: str) -> str:
    return "".join(_SUPERSCRIPTS.get(character, character) for character in text)


def _bracket_pair(row: int, rows: int) -> tuple[str, str]:
    if rows == 1:
        return "[", "]"
    if row == 0:
        return "⎡", "⎤"
    return ("⎣", "⎦") if row == rows - 1 else ("⎢", "⎥")
