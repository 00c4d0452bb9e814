"""Nodes as LaTeX mathematics, with widths in points for an 11 pt Latin Modern document.

The output stays inside what KaTeX accepts, so that one writer serves paper and the web page.
"""

from __future__ import annotations

from collections.abc import Sequence

from symdh.notation import MathWriter, Piece, joined, total_width
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
    leaves,
)
from symdh.notation.numbers import decimal
from symdh.render.latex_text import latex_text
from symdh.robot import MotionKind

# Advance widths at 10.95 pt, read off the fonts with \the\wd.
_ITALIC = (
    dict(
        zip(
            "abcdefghijklmnopqrstuvwxyz",
            (
                *(5.79, 4.70, 4.74, 5.70, 5.10, 6.54, 5.62, 6.31, 3.78, 5.14, 6.05, 3.49, 9.62),
                *(6.58, 5.31, 5.51, 5.29, 5.25, 5.14, 3.96, 6.27, 5.71, 8.14, 6.26, 5.77, 5.58),
            ),
            strict=True,
        )
    )
    | dict.fromkeys("ABCDEFGHIJKLNOPQRSTUVXYZ", 9.0)
    | {"M": 11.9, "W": 11.9}
)
_GREEK_WIDTH = 7.6
_DIGIT, _POINT, _BRACKET, _SQUARE = 5.48, 3.05, 4.26, 3.10
_PLUS, _MINUS, _EQUALS = 13.4, 8.6, 14.7
_THIN, _QUAD = 1.83, 10.95
_SCRIPT = 0.78
_COLUMN_GAP, _MATRIX_BRACKETS = 10.0, 11.8
_TRIGONOMETRIC = ("sin", "cos", "tan")
_PAIR = "ij"  # two running indices, not a word
_FUNCTION_NAMES = {
    **{name: "\\" + name for name in _TRIGONOMETRIC},
    **{"a" + name: r"\arc" + name for name in _TRIGONOMETRIC},
}


class LatexWriter(MathWriter):
    """Writes formulas in LaTeX.

    Attributes
    ----------
    quad, qquad : str
        Spaces of one and of two widths of the font's size.
    """

    quad, qquad = r"\quad", r"\qquad"

    def remark(self, text: str) -> str:
        """Return a short text beside a formula, in small print."""
        return rf"\text{{\footnotesize {latex_text(text)}}}"

    def words(self, text: str) -> Piece:
        """Return running text in a formula."""
        return Piece(rf"\text{{{latex_text(text)}}}", 5.0 * len(text))

    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number, an angle in degrees, a unit or pi."""
        match node:
            case Number(value=value):
                text = decimal(value)
                if "/" in text:
                    top, bottom = text.split("/")
                    wide = _SCRIPT * _DIGIT * max(len(top), len(bottom)) + 3
                    return Piece(rf"\tfrac{{{top}}}{{{bottom}}}", wide)
                return Piece(text, _number_width(text))
            case Degrees(value=value):
                text = decimal(value)
                return Piece(rf"{text}^{{\circ}}", _number_width(text) + 5)
            case Rounded(text=text):
                mantissa, _, exponent = text.partition("e")
                if not exponent:
                    return Piece(text, _number_width(text))
                scale = rf"\cdot 10^{{{exponent}}}"
                return Piece(mantissa + scale, _number_width(mantissa) + 20 + 5 * len(exponent))
            case Unit(text=text):
                return Piece(rf"\mathrm{{{text}}}", 6.5 * len(text))
            case Pi():
                return Piece(r"\pi", 6.7)

    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol with its subscript and superscript."""
        match node:
            case Name(text=text, starred=starred, dotted=dotted):
                letter, index = split_name(text)
                piece = _symbol(letter, index, r"^{*}" if starred else "")
                return _accented(piece, letter, r"\dot") if dotted else piece
            case Short(function=function, label=label):
                return _symbol(function, label)
            case Generic(letter=letter, index=index, stage=stage, hat=hat, dotted=dotted):
                above = rf"^{{({_script(stage)})}}" if stage else ""
                piece = _symbol(letter, index, above, len(stage) + 2 if stage else 0)
                if hat or dotted:
                    return _accented(piece, letter, r"\hat" if hat else r"\dot")
                return piece

    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""
        match node:
            case Screw(axis=axis):
                return Piece(rf"\mathrm{{Screw}}_{{{axis.name.lower()}}}", 36.0)
            case PoseName(start=start, end=end, craig=craig):
                return _craig_name(start, end) if craig else _pose_name(start, end)

    def operator(self, node: Operator) -> list[Piece]:
        """Return ``R_x(alpha)`` and ``D_x(a)`` in Craig's style, else ``Rot(x, alpha)``."""
        axis = node.axis.name.lower()
        turning = node.kind is MotionKind.ROTATION
        if node.craig:
            head = _symbol("R" if turning else "D", axis)
            opening = Piece(head.text + "(", head.width + _BRACKET)
        else:
            name = "Rot" if turning else "Trans"
            opening = Piece(rf"\mathrm{{{name}}}({axis},\,", 5.7 * len(name) + 14)
        return [opening, *self.pieces(node.amount), Piece(")", _BRACKET)]

    def matrix(self, node: Matrix) -> list[Piece]:
        """Return a matrix in square brackets."""
        tall = any(_has_fraction(entry) for row in node.rows for entry in row)
        end = r"\\[3pt]" if tall else r"\\"
        rows = [" & ".join(self.text(entry) for entry in row) for row in node.rows]
        text = r"\begin{bmatrix} " + f" {end} ".join(rows) + r" \end{bmatrix}"
        return [Piece(text, self.matrix_width(node))]

    def matrix_width(self, node: Matrix) -> float:
        """Return the width of a matrix in points."""
        columns = [
            max(self.width(entry) for entry in column) for column in zip(*node.rows, strict=True)
        ]
        return sum(columns) + _COLUMN_GAP * (len(columns) - 1) + _MATRIX_BRACKETS

    def fraction(self, top: Node, bottom: Node) -> list[Piece]:
        """Return a quotient."""
        over, under = self.pieces(top), self.pieces(bottom)
        width = max(total_width(over), total_width(under))
        if not any(
            isinstance(leaf, (Name, Short)) for part in (top, bottom) for leaf in leaves(part)
        ):
            return [Piece(rf"\tfrac{{{joined(over)}}}{{{joined(under)}}}", _SCRIPT * width + 3)]
        width += 2.4
        return [Piece(rf"\frac{{{joined(over)}}}{{{joined(under)}}}", width)]

    def power(self, base: list[Piece], exponent: str, node: Node) -> list[Piece]:
        """Return a power; a symbol that has a subscript keeps it."""
        raised = Piece(rf"^{{{exponent}}}", 4.4 * len(exponent))
        if isinstance(node, Call):
            return [Piece("{" + joined(base) + "}", total_width(base)), raised]
        return [*base, raised]

    def root(self, radicand: list[Piece]) -> list[Piece]:
        """Return a square root."""
        return [Piece(rf"\sqrt{{{joined(radicand)}}}", total_width(radicand) + 9.5)]

    def call(self, function: str, arguments: Sequence[Node]) -> list[Piece]:
        """Return a function; a single symbol follows sine and cosine without brackets.

        So does a number times one: ``cos 2 theta``.
        """
        if function == "abs":
            inner = self.pieces(arguments[0])
            return [Piece(f"|{joined(inner)}|", total_width(inner) + 6.2)]
        name = _FUNCTION_NAMES.get(function, rf"\operatorname{{{function}}}")
        width = 5.3 * len(function) + 2 * _THIN
        inner = self.separated(arguments, Piece(",", 5.0))
        whole = total_width(inner)
        if is_bare(function, arguments[0]):
            return [Piece(f"{name} {joined(inner)}", width + whole)]
        return [Piece(f"{name}({joined(inner)})", width + whole + 2 * _BRACKET)]

    def times(self, left: Node, right: Node) -> list[Piece]:
        """Return nothing between symbols, a thin space or a dot where they would run together."""
        if isinstance(right, (Number, Rounded, Degrees)):
            return [Piece(r" \cdot ", 7.6)]
        if isinstance(right, Unit) or isinstance(left, Call) or _is_word(left) or _is_word(right):
            return [Piece(r"\,", _THIN)]
        return [Piece(" ", 0.0)]

    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return round and square brackets in turn, so that pairs are told apart."""
        if height % 2:
            return Piece("[", _SQUARE), Piece("]", _SQUARE)
        return Piece("(", _BRACKET), Piece(")", _BRACKET)

    def plus_minus(self, negative: bool) -> Piece:
        """Return a binary sign."""
        return Piece(" - " if negative else " + ", _PLUS)

    def sign(self) -> Piece:
        """Return a leading minus."""
        return Piece("-", _MINUS)

    def equals(self) -> Piece:
        """Return an equality sign."""
        return Piece(" = ", _EQUALS)

    def comma(self) -> Piece:
        """Return a comma between numbers."""
        return Piece(r",\, ", 5.0)

    def gap(self) -> Piece:
        """Return a comma and a wide space between formulas."""
        return Piece(r", \qquad ", 2 * _QUAD + _POINT)

    def dot(self) -> Piece:
        """Return the sign of a scalar product."""
        return Piece(r" \cdot ", 7.6)

    def cross(self) -> Piece:
        """Return the sign of a vector product."""
        return Piece(r" \times ", 13.4)

    def transpose(self) -> Piece:
        """Return the mark of a transposed matrix."""
        return Piece(r"^{\mathsf{T}}", 6.0)

    def beside(self) -> Piece:
        """Return the space between transforms."""
        return Piece(r"\, ", _THIN)


def is_bare(function: str, argument: Node) -> bool:
    """Say whether an argument follows its function without brackets."""
    if function not in _TRIGONOMETRIC:
        return False
    match argument:
        case Product(factors=(Number(), Name() | Generic() | Pi())):
            return True
        case Sum() | Negative() | Fraction() | Product() | Call():
            return False
        case _:
            return True


def _number_width(text: str) -> float:
    digits = sum(character.isdigit() for character in text)
    return _DIGIT * digits + _POINT * text.count(".") + (_MINUS if text.startswith("-") else 0)


def _letter_width(letter: str) -> float:
    if letter in GREEK:
        return _GREEK_WIDTH
    return sum(_ITALIC.get(character, 9.0) for character in letter)


def _letter(letter: str) -> str:
    if letter == "omicron":
        return "o"
    if letter in GREEK:
        return "\\" + letter
    escaped = letter.replace("_", r"\_")
    return escaped if len(letter) == 1 else rf"\mathit{{{escaped}}}"


def is_word(part: str) -> bool:
    """Say whether a part of a subscript is a word, to be printed upright."""
    return len(part) > 1 and part.isalpha() and part != _PAIR


def _script(index: str) -> str:
    """Return a subscript: words upright, single letters and numbers as mathematics."""
    parts = [rf"\mathrm{{{part}}}" if is_word(part) else part for part in index.split(",")]
    return ",".join(parts).replace("_", r"\_")


def _symbol(letter: str, index: str, above: str = "", above_length: int = 1) -> Piece:
    text = _letter(letter) + (f"_{{{_script(index)}}}" if index else "") + above
    below = 4.3 * len(index) + 2.4 * index.count("-") + (0.6 if index else 0)
    raised = 4.3 * above_length if above else 0
    return Piece(text, _letter_width(letter) + max(below, raised))


def _accented(piece: Piece, letter: str, accent: str) -> Piece:
    plain = _letter(letter)
    under = f"{{{plain}}}" if "{" in plain else f" {plain}"
    return Piece(piece.text.replace(plain, accent + under, 1), piece.width)


def _frame(frame: str) -> str:
    return rf"\mathrm{{{frame}}}" if len(frame) > 1 and frame.isalpha() else frame


def _pose_name(start: str, end: str) -> Piece:
    text = rf"{{}}^{{{_frame(start)}}}T_{{{_frame(end)}}}"
    return Piece(text, 8.5 + 4.3 * (len(start) + len(end)))


def _craig_name(start: str, end: str) -> Piece:
    """Return Craig's name: both frames before the T, flush with it."""
    upper, lower = _frame(start), _frame(end)
    missing = len(end) - len(start)
    if missing > 0:
        upper = rf"\hphantom{{{_frame(end[:missing])}}}{upper}"
    elif missing < 0:
        lower = rf"\hphantom{{{_frame(start[:-missing])}}}{lower}"
    text = rf"{{}}^{{{upper}}}_{{{lower}}}T"
    return Piece(text, 8.5 + 4.3 * max(len(start), len(end)))


def _is_word(node: Node) -> bool:
    return (
        isinstance(node, Name)
        and len(split_name(node.text)[0]) > 1
        and split_name(node.text)[0] not in GREEK
    )


def _has_fraction(node: Node) -> bool:
    if isinstance(node, Negative):
        return _has_fraction(node.node)
    return isinstance(node, Fraction)
