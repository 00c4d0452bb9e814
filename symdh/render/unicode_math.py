"""Nodes as Unicode text for a terminal: θ₁, c₁₂, ⁰T₂; widths in columns."""

from __future__ import annotations

from collections.abc import Sequence

from symdh.notation import Piece, joined
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
from symdh.render.text_math import TextWriter, text_piece
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


class UnicodeWriter(TextWriter):
    """Writes formulas for a terminal."""

    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number, an angle in degrees, a unit or pi."""
        match node:
            case Number(value=value):
                return text_piece(decimal(value))
            case Degrees(value=value):
                return text_piece(f"{decimal(value)}°")
            case Rounded(text=text) | Unit(text=text):
                return text_piece(text)
            case Pi():
                return text_piece("π")

    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol with its subscript."""
        match node:
            case Name(text=text, starred=starred, dotted=dotted):
                letter, index = split_name(text)
                mark = "\u0307" if dotted else ""
                return text_piece(
                    GREEK.get(letter, letter) + mark + _lowered(index) + ("*" if starred else "")
                )
            case Short(function=function, label=label):
                return text_piece(function + _lowered(label))
            case Generic(letter=letter, index=index, stage=stage, hat=hat, dotted=dotted):
                above = _raised(f"({stage})") if stage else ""
                mark = "\u0302" if hat else "\u0307" if dotted else ""
                return text_piece(GREEK.get(letter, letter) + mark + _lowered(index) + above)

    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""
        match node:
            case Screw(axis=axis):
                return text_piece(f"Screw_{axis.name.lower()}")
            case PoseName(start=start, end=end, craig=craig):
                end_text = _lowered(end)
                return text_piece(
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
        return [text_piece(head), *self.pieces(node.amount), text_piece(")")]

    def matrix(self, node: Matrix) -> list[Piece]:
        """Return a matrix on one line; `matrix_lines` writes it in rows."""
        rows = (", ".join(self.text(entry) for entry in row) for row in node.rows)
        return [text_piece("[" + "; ".join(rows) + "]")]

    def matrix_lines(self, node: Matrix) -> list[str]:
        """Return a matrix as lines with tall brackets."""
        cells = [[self.text(entry) for entry in row] for row in node.rows]
        widths = [
            max(text_piece(cell).width for cell in column) for column in zip(*cells, strict=True)
        ]
        lines = []
        for number, row in enumerate(cells):
            body = "  ".join(
                cell.center(int(width)) for cell, width in zip(row, widths, strict=True)
            )
            left, right = _bracket_pair(number, len(cells))
            lines.append(f"{left} {body} {right}")
        return lines

    def power(self, base: list[Piece], exponent: str, node: Node) -> list[Piece]:
        """Return a power; whole exponents are raised."""
        whole = exponent.removeprefix("-").isdigit()
        raised = _raised(exponent) if whole else f"^({exponent})"
        return [*base, text_piece(raised)]

    def root(self, radicand: list[Piece]) -> list[Piece]:
        """Return a square root; a plain number needs no brackets."""
        if len(radicand) == 1 and radicand[0].text.isdigit():
            return [text_piece("√" + radicand[0].text)]
        return [text_piece("√("), *radicand, text_piece(")")]

    def call(self, function: str, arguments: Sequence[Node]) -> list[Piece]:
        """Return a function; a single symbol follows sine and cosine without brackets."""
        inner = ", ".join(joined(self.pieces(argument)) for argument in arguments)
        first = arguments[0]
        if function in ("sin", "cos", "tan") and not isinstance(
            first, (Sum, Negative, Fraction, Product, Call)
        ):
            return [text_piece(f"{function} {inner}")]
        return [text_piece(f"{function}({inner})")]

    def times(self, left: Node, right: Node) -> list[Piece]:
        """Return a space, or a dot between numbers."""
        return [text_piece("·" if isinstance(right, (Number, Rounded, Degrees)) else " ")]

    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return round and square brackets in turn."""
        return (
            (text_piece("["), text_piece("]")) if height % 2 else (text_piece("("), text_piece(")"))
        )

    def gap(self) -> Piece:
        """Return a comma and a wide space between formulas."""
        return text_piece(",   ")

    def dot(self) -> Piece:
        """Return the sign of a scalar product."""
        return text_piece(" · ")

    def cross(self) -> Piece:
        """Return the sign of a vector product."""
        return text_piece(" × ")

    def transpose(self) -> Piece:
        """Return the mark of a transposed matrix."""
        return text_piece("ᵀ")

    def beside(self) -> Piece:
        """Return the space between transforms."""
        return text_piece(" ")


def _lowered(index: str) -> str:
    if not index:
        return ""
    if index in ("x", "y", "z"):
        # Unicode has a small x alone; the three belong together.
        return f"_{index}"
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
