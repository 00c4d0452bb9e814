"""What plain ASCII and Unicode terminal text have in common: one character is one column."""

from __future__ import annotations

from symdh.notation import MathWriter, Piece
from symdh.notation.nodes import Fraction, Negative, Node, Product, Sum


def text_piece(text: str) -> Piece:
    """Return text as a piece; a combining hat or dot takes no column of its own."""
    return Piece(text, len(text) - text.count("\u0302") - text.count("\u0307"))


class TextWriter(MathWriter):
    """Writes what reads the same in both alphabets."""

    def fraction(self, top: Node, bottom: Node) -> list[Piece]:
        """Return a quotient on one line."""
        over = self._guarded(top, Sum, Negative)
        under = self._guarded(bottom, Sum, Negative, Product, Fraction)
        return [*over, text_piece("/"), *under]

    def words(self, text: str) -> Piece:
        """Return running text in a formula."""
        return text_piece(text)

    def plus_minus(self, negative: bool) -> Piece:
        """Return a binary sign."""
        return text_piece(" - " if negative else " + ")

    def sign(self) -> Piece:
        """Return a leading minus."""
        return text_piece("-")

    def equals(self) -> Piece:
        """Return an equality sign."""
        return text_piece(" = ")

    def comma(self) -> Piece:
        """Return a comma between numbers."""
        return text_piece(", ")
