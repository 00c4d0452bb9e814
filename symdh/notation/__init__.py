"""How a result is written: short forms, the order of factors and terms, signs, line breaking."""

from symdh.notation.breaking import break_lines
from symdh.notation.pieces import MathWriter, Piece, joined, total_width
from symdh.notation.shorthand import Shorthand
from symdh.notation.writing import Notation

__all__ = [
    "MathWriter",
    "Notation",
    "Piece",
    "Shorthand",
    "break_lines",
    "joined",
    "total_width",
]
