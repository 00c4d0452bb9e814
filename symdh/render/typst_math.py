"""Nodes as Typst mathematics, as wide as in LaTeX: both are set in Computer Modern."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from symdh.notation import Piece, joined, total_width
from symdh.notation.names import GREEK, split_name
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
from symdh.render.latex_math import LatexWriter, is_bare, is_word
from symdh.render.typst_text import typst_text
from symdh.robot import MotionKind

#: Typst prints the letters of the keyboard as the curly forms, LaTeX as these.
_LETTERS = GREEK | {"phi": "ϕ", "epsilon": "ϵ"}
_FUNCTIONS = {name: name for name in ("sin", "cos", "tan")} | {
    f"a{name}": f"arc{name}" for name in ("sin", "cos", "tan")
}


class TypstWriter(LatexWriter):
    """Writes formulas in Typst; what is decided by widths is decided as in LaTeX.

    Brackets are escaped, for bare ones would be stretched, and would have to come in pairs on each
    line of a broken formula. An empty text stands where a sign between terms begins a line, for it
    would be taken for the sign of a number.
    """

    quad, qquad = 'quad "" ', 'quad quad "" '

    def remark(self, text: str) -> str:
        """Return a short text beside a formula, in small print."""
        return f"#box(text(size: 9pt)[{typst_text(text)}])"

    def words(self, text: str) -> Piece:
        """Return running text in a formula."""
        return Piece(f"#box[{typst_text(text)}]", super().words(text).width)

    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number, an angle in degrees, a unit or pi."""
        match node:
            case Number(value=value):
                text = _number(decimal(value))
            case Degrees(value=value):
                text = f"{_number(decimal(value))}°"
            case Rounded(text=rounded):
                mantissa, _, exponent = rounded.partition("e")
                text = f"{mantissa} ⋅ 10^({exponent})" if exponent else mantissa
            case Unit(text=unit):
                text = _word(unit)
            case Pi():
                text = "π"
        return Piece(text, super().quantity(node).width)

    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol with its subscript and superscript."""
        match node:
            case Name(text=name, starred=starred, dotted=dotted):
                letter, index = split_name(name)
                above, accent = "^(*)" if starred else "", "dot" if dotted else ""
            case Short(function=letter, label=index):
                above, accent = "", ""
            case Generic(letter=letter, index=index, stage=stage, hat=hat, dotted=dotted):
                above = rf"^(\({_script(stage)}\))" if stage else ""
                accent = "hat" if hat else "dot" if dotted else ""
        base = f"{accent}({_letter(letter)})" if accent else _letter(letter)
        below = f"_({_script(index)})" if index else ""
        return Piece(base + below + above, super().symbol(node).width)

    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""
        match node:
            case Screw(axis=axis):
                text = f"{_word('Screw')}_{axis.name.lower()}"
            case PoseName(start=start, end=end, craig=craig):
                place = "bl" if craig else "br"
                text = f"attach(T, tl: {_script(start)}, {place}: {_script(end)})"
        return Piece(text, super().transform(node).width)

    def operator(self, node: Operator) -> list[Piece]:
        """Return ``R_x(alpha)`` and ``D_x(a)`` in Craig's style, else ``Rot(x, alpha)``."""
        opening, *amount, closing = super().operator(node)
        axis = node.axis.name.lower()
        turning = node.kind is MotionKind.ROTATION
        if node.craig:
            head = rf"{'R' if turning else 'D'}_{axis}\("
        else:
            head = rf"{_word('Rot' if turning else 'Trans')}\({axis}\, thick "
        return [Piece(head, opening.width), *amount, Piece(r"\)", closing.width)]

    def matrix(self, node: Matrix) -> list[Piece]:
        """Return a matrix in square brackets."""
        (latex,) = super().matrix(node)
        rows = "; ".join(", ".join(self.text(entry) for entry in row) for row in node.rows)
        # LaTeX has spread the rows of a matrix with fractions.
        spread = "row-gap: #0.7em, " if "[3pt]" in latex.text else ""
        return [Piece(f"mat({spread}{rows})", latex.width)]

    def fraction(self, top: Node, bottom: Node) -> list[Piece]:
        """Return a quotient."""
        (latex,) = super().fraction(top, bottom)
        text = f"frac({self.text(top)}, {self.text(bottom)})"
        small = latex.text.startswith(r"\tfrac")
        return [Piece(f"inline({text})" if small else text, latex.width)]

    def power(self, base: list[Piece], exponent: str, node: Node) -> list[Piece]:
        """Return a power; a symbol that has a subscript keeps it."""
        width = total_width(super().power(base, exponent, node)) - total_width(base)
        raised = Piece(f"^({exponent.replace('/', chr(92) + '/')})", width)
        return [*base, raised]

    def root(self, radicand: list[Piece]) -> list[Piece]:
        """Return a square root."""
        return [Piece(f"sqrt({joined(radicand)})", total_width(super().root(radicand)))]

    def call(self, function: str, arguments: Sequence[Node]) -> list[Piece]:
        """Return a function; a single symbol follows sine and cosine without brackets."""
        (latex,) = super().call(function, arguments)
        inner = joined(self.separated(arguments, self.comma()))
        if function == "abs":
            return [Piece(f"abs({inner})", latex.width)]
        name = _FUNCTIONS.get(function, f'op("{function}")')
        bare = is_bare(function, arguments[0])
        return [Piece(f"{name} {inner}" if bare else rf"{name}\({inner}\)", latex.width)]

    def times(self, left: Node, right: Node) -> list[Piece]:
        """Return nothing between symbols, a thin space or a dot where they would run together."""
        words = {r" \cdot ": " ⋅ ", r"\,": " thin ", " ": " "}
        return [Piece(words[piece.text], piece.width) for piece in super().times(left, right)]

    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return round and square brackets in turn, so that pairs are told apart."""
        opening, closing = super().brackets(height)
        return Piece(f"\\{opening.text}", opening.width), Piece(f"\\{closing.text}", closing.width)

    def comma(self) -> Piece:
        """Return a comma between numbers."""
        return Piece(r"\, thick ", super().comma().width)

    def gap(self) -> Piece:
        """Return a comma and a wide space between formulas."""
        return Piece(rf"\, {self.qquad}", super().gap().width)

    def dot(self) -> Piece:
        """Return the sign of a scalar product."""
        return Piece(" ⋅ ", super().dot().width)

    def cross(self) -> Piece:
        """Return the sign of a vector product."""
        return Piece(" × ", super().cross().width)

    def transpose(self) -> Piece:
        """Return the mark of a transposed matrix."""
        return Piece("^(sans(T))", super().transpose().width)

    def beside(self) -> Piece:
        """Return the space between transforms."""
        return Piece(" thin ", super().beside().width)


def _number(text: str) -> str:
    top, slash, bottom = text.partition("/")
    return f"inline(frac({top}, {bottom}))" if slash else text


def _word(text: str) -> str:
    return f'upright("{_quoted(text)}")'


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _letter(letter: str) -> str:
    if letter in _LETTERS:
        return _LETTERS[letter]
    return letter if len(letter) == 1 else f'italic("{_quoted(letter)}")'


def _script(index: str) -> str:
    """Return a subscript: words upright, single letters and numbers as mathematics."""
    return r"\,".join(" ".join(_atoms(part)) for part in index.split(","))


def _atoms(part: str) -> Iterable[str]:
    """Yield letters one by one, for a run of them would be the name of a variable."""
    if is_word(part):
        yield _word(part)
        return
    for run in re.findall(r"[0-9]+|.", part, re.DOTALL):
        if run.isalnum() or run == "-":
            yield run
        else:
            yield f'"{_quoted(run)}"'
