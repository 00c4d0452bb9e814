"""Blocks -> items that a template lays out, decided by the widths of their formulas.

Paper (LaTeX, Typst) and web page share this: all print in Computer Modern, so what fits is the
same. They differ in how formulas are spelt (the page has LaTeX too, for KaTeX), how running text is
escaped and how a formula stands in it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from symdh.derivation.blocks import (
    Block,
    Definitions,
    Display,
    Entries,
    EntryStep,
    EntrySteps,
    Figure,
    Fitting,
    MatrixRow,
    NamedMatrix,
    Paragraph,
    ParameterTable,
    PoseResult,
    ProductResult,
    Question,
    Text,
)
from symdh.derivation.drawing.shapes import Drawing
from symdh.notation import break_lines, joined
from symdh.notation.nodes import Equation, Generic, Node
from symdh.notation.pieces import Pieces, total_width
from symdh.render.drawing.tikz import render_tikz
from symdh.render.entries import named_entries
from symdh.render.latex_math import LatexWriter

#: The text is 160 mm wide on A4 and on letter paper; estimates keep a margin of 6 %.
LINE = 0.94 * 455.2
_GAP = 22.0  # \qquad between matrices in a row
_INDENT = 22.0  # \qquad before a continued line
#: So many lines of one display are not parted by the end of a page.
_FEW = 4
_REASON_GAP = 11.0
_TABLE_ROWS = 40  # of a parameter table on one page


@dataclass(frozen=True, slots=True)
class Item:
    """One block ready for the template: `kind` picks the macro, `data` fills it."""

    kind: str
    data: object


@dataclass(frozen=True, slots=True)
class Line:
    """One row of an aligned display: what stands before and after the alignment.

    `gap` asks for space above it; `tied` keeps it on one page with the row above.
    """

    left: str
    right: str
    gap: bool = False
    tied: bool = False


class Layout:
    """Turns blocks into items by the widths of their formulas.

    Parameters
    ----------
    escape : callable
        Makes running text safe for the output.
    inline_math : callable
        Puts a formula into running text.
    math : LatexWriter, optional
        Spells the formulas; by default in LaTeX.
    picture : callable, optional
        Writes a drawing; by default as TikZ.
    """

    def __init__(
        self,
        escape: Callable[[str], str],
        inline_math: Callable[[str], str],
        math: LatexWriter | None = None,
        picture: Callable[[Drawing], str] = render_tikz,
    ) -> None:
        self._escape = escape
        self._inline_math = inline_math
        self._math = math or LatexWriter()
        self._picture = picture

    def inline(self, content: Text) -> str:
        """Return text with formulas in it."""
        return "".join(
            self._escape(part)
            if isinstance(part, str)
            else self._inline_math(self._math.text(part))
            for part in content
        )

    def items(self, block: Block) -> list[Item]:
        """Return a block as what the template's macros lay out."""
        match block:
            case Paragraph(content=content):
                return [Item("paragraph", self.inline(content))]
            case Display(formula=formula):
                return [Item("lines", self._display(formula))]
            case Definitions(entries=entries):
                rows = [(self._math.text(e.term), self.inline(e.meaning)) for e in entries]
                return [Item("definitions", rows)]
            case ParameterTable():
                return list(self._tables(block))
            case NamedMatrix():
                return [self._named_matrix(block)]
            case MatrixRow(matrices=matrices):
                return [Item("displays", list(self._packed(matrices)))]
            case EntrySteps(entries=steps):
                return [Item("lines", _together(self._steps(steps)))]
            case ProductResult():
                return self._product(block)
            case Entries(groups=groups):
                return [self._entries(groups)]
            case Fitting(whole=whole, otherwise=otherwise):
                if self._fits(whole):
                    return [self._named_matrix(whole)]
                return [item for part in otherwise for item in self.items(part)]
            case PoseResult(whole=whole, explanation=explanation, entries=entries):
                matrix = [self._named_matrix(whole)] if self._fits(whole) else []
                told = Item("paragraph", self.inline(explanation))
                return [*matrix, told, self._entries(entries.groups)]
            case Question():
                return self._question(block)
            case Figure(drawing=drawing):
                caption = self.inline(drawing.caption)
                return [Item("figure", {"picture": self._picture(drawing), "caption": caption})]

    def _question(self, block: Question) -> list[Item]:
        """Return a question with its answer, or with room for one."""
        question = Item("question", self.inline(block.text))
        if block.answer is not None:
            solved = [item for part in block.answer for item in self.items(part)]
            return [question, Item("solution", None), *solved]
        room = block.room
        label = "" if room.label is None else self._math.text(room.label) + " ="
        data = {
            "label": label,
            "lines": room.lines,
            "brackets": room.brackets,
            "columns": self._cells(room.columns),
        }
        return [question, Item("room", data)]

    def _tables(self, block: ParameterTable) -> Iterator[Item]:
        """Yield the table in parts that fit on a page, the notes below the last."""
        for first in range(0, len(block.rows), _TABLE_ROWS):
            rows = block.rows[first : first + _TABLE_ROWS]
            last = first + _TABLE_ROWS >= len(block.rows)
            data = {
                "columns": len(block.header),
                "header": self._cells(block.header),
                "rows": [self._cells(row) for row in rows],
                "notes": [self.inline(note) for note in block.notes] if last else [],
                "tall": any(isinstance(n, Generic) and n.stage for row in rows for n in row),
            }
            yield Item("table", data)

    def _cells(self, row: Sequence[Node]) -> list[str]:
        return [self._math.text(node) for node in row]

    def _display(self, formula: Node) -> list[Line]:
        """Return a formula as aligned lines, a new line before an equality where one is needed."""
        if self._math.width(formula) <= LINE:
            return [Line("", self._math.text(formula))]
        if not isinstance(formula, Equation):
            return self._broken("", self._math.pieces(formula), LINE)
        left = self._math.text(formula.sides[0])
        room = LINE - self._math.width(formula.sides[0]) - self._math.equals().width
        lines: list[Line] = []
        for side in formula.sides[1:]:
            lines += self._broken(left, [self._math.equals(), *self._math.pieces(side)], room)
            left = ""
        return lines

    def _fits(self, block: NamedMatrix) -> bool:
        """Say whether a matrix fits on a line, its names on a line above if need be."""
        return self._math.matrix_width(block.matrix) + 2 * self._math.equals().width <= LINE

    def _named_matrix(self, block: NamedMatrix) -> Item:
        if not self._fits(block):
            # Right of the alignment: a long name on its left would push the entries off the page.
            names = self._names(block.names)
            names[-1] = replace(names[-1], right=names[-1].right + ":")
            entries = tuple(named_entries(block.matrix, block.names[0]))
            return Item("lines", names + self._steps(entries))
        whole = Equation((*block.names, block.matrix))
        if self._math.width(whole) <= LINE:
            return Item("displays", [self._math.text(whole)])
        matrix = joined([self._math.equals(), *self._math.matrix(block.matrix)])
        names = self._names(block.names)
        return Item("lines", [*names, Line("", self._math.quad + matrix, tied=True)])

    def _names(self, names: Sequence[Node]) -> list[Line]:
        """Return what a matrix is equal to, broken between transforms where that is needed."""
        return self._broken("", self._math.pieces(Equation(tuple(names))), LINE)

    def _product(self, block: ProductResult) -> list[Item]:
        """Return a product: the changed entries and the matrix, or all entries in one list."""
        changed = [step for step in block.steps if step.identity]
        whole = NamedMatrix(block.names, block.matrix)
        equation = self.inline((Equation(block.names),))
        if block.final:
            rest = "The other entries" if changed else "Here the entries"
            lead = f"{equation}, rows times columns:" if changed else f"{equation}:"
            items = [Item("paragraph", lead)]
            if changed:
                items.append(Item("lines", self._steps(changed)))
            note = f"{rest} are rows times columns as they stand; the next section lists all."
            return [*items, Item("paragraph", note)]
        if not self._fits(whole):
            lead = f"{equation}, rows times columns:"
            return [Item("paragraph", lead), Item("lines", self._steps(block.steps))]
        if not changed:
            return [self._named_matrix(whole)]
        lead = f"{equation}, where rows times columns give"
        return [
            Item("paragraph", lead),
            Item("lines", self._steps(changed)),
            self._named_matrix(whole),
        ]

    def _steps(self, steps: Sequence[EntryStep]) -> list[Line]:
        # The right-hand sides begin below each other, behind the widest left-hand side.
        widest = max((self._math.width(step.name) for step in steps), default=0.0)
        return [line for step in steps for line in self._entry(step, widest)]

    def _packed(self, matrices: Sequence[NamedMatrix]) -> Iterator[str]:
        """Yield displays with as many matrices side by side as fit; there is one at least."""
        shown: list[str] = []
        used = 0.0
        for block in matrices:
            whole = Equation((*block.names, block.matrix))
            width = self._math.width(whole)
            if shown and used + _GAP + width > LINE:
                yield f" {self._math.qquad} ".join(shown)
                shown, used = [], 0.0
            used += width + (_GAP if shown else 0)
            shown.append(self._math.text(whole))
        yield f" {self._math.qquad} ".join(shown)

    def _entry(self, step: EntryStep, widest: float) -> list[Line]:
        """Return an entry's forms as aligned lines, the identity's name behind the last."""
        left = self._math.text(step.name)
        room = LINE - widest - self._math.equals().width
        equals = self._math.equals()
        forms = [[equals, *self._math.pieces(form)] for form in step.forms]
        reason = step.identity.value if step.identity else ""
        beside = _REASON_GAP + 4.6 * len(reason) if reason else 0.0
        together = [piece for form in forms for piece in form]
        if total_width(together) + beside <= room:
            forms = [together]
        lines: list[Line] = []
        for form in forms:
            lines += self._broken("" if lines else left, form, room)
        if reason:
            note = f"{self._math.quad} {self._math.remark(reason)}"
            last = lines[-1]
            if total_width(forms[-1]) + beside <= room:
                lines[-1] = replace(last, right=last.right + note)
            else:
                lines.append(Line("", self._math.qquad + note))
        return [lines[0], *(replace(line, tied=True) for line in lines[1:])]

    def _broken(self, left: str, pieces: Pieces, room: float) -> list[Line]:
        broken = [joined(line) for line in break_lines(pieces, room, _INDENT)]
        first = Line(left, broken[0])
        return [first, *(Line("", self._math.qquad + text) for text in broken[1:])]

    def _entries(self, groups: Sequence[Sequence[EntryStep]]) -> Item:
        """Return groups side by side where they fit, else below each other."""
        columns = [[Equation((step.name, *step.forms)) for step in group] for group in groups]
        widths = [max(self._math.width(entry) for entry in column) for column in columns]
        if len(groups) > 1 and sum(widths) + 2 * _GAP * len(widths) <= LINE:
            return Item("columns", self._side_by_side(groups))
        lines: list[Line] = []
        widest = max(self._math.width(step.name) for group in groups for step in group)
        for group in groups:
            for position, step in enumerate(group):
                entry = self._entry(step, widest)
                if lines and position == 0:
                    entry[0] = replace(entry[0], gap=True)
                lines += entry
        return Item("lines", lines)

    def _side_by_side(self, groups: Sequence[Sequence[EntryStep]]) -> dict[str, object]:
        rows = [
            [Line(self._math.text(s.name), f"= {self._math.text(s.forms[-1])}") for s in steps]
            for steps in zip(*groups, strict=True)
        ]
        return {"count": len(groups), "rows": rows}


def _together(lines: list[Line]) -> list[Line]:
    """Keep a few lines on one page."""
    if len(lines) > _FEW:
        return lines
    return [*lines[:1], *(replace(line, tied=True) for line in lines[1:])]
