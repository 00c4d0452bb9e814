"""What the telling of one step keeps: what has been named and written so far."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sympy import Expr, Symbol, atan2, sqrt

from symdh.derivation.blocks import Block, Display, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.formulas import is_zero
from symdh.derivation.inverse.names import Writer
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.solution import Step
from symdh.notation.nodes import Call, Negative, Node, Product
from symdh.notation.writing import weight

#: A determinant that has more to read than this is not written out in a sentence.
LONG = 7
#: A side of an equation that has more to read than this does not stand in front.
_LONG_ALONE = 16
#: The sine and the cosine of an angle that have no more to read than this are put in.
SHORT = 2
#: Nor does one that leaves too little room for the other.
_LONG_TOGETHER = 40
#: Nor one of several, which would push the others to the right.
_LONG_AMONG_OTHERS = 5


class Telling:
    """Tells one step.

    Attributes
    ----------
    writer : Writer
    title : str
        Of the step's chapter.
    step : Step
    new : list of (letter, element)
        Names that were given and not yet introduced.
    written : set of tuple of Node
        Both sides of the equations that stand in the chapter so far.
    """

    def __init__(self, writer: Writer, title: str, step: Step) -> None:
        self.writer = writer
        self.title = title
        self.step = step
        self.new: list[tuple[Symbol, Element]] = []
        self.written: set[tuple[Node, ...]] = set()

    @property
    def is_told(self) -> bool:
        """Whether the step before has introduced the equations of this one."""
        steps = self.writer.form.steps
        k = steps.index(self.step)
        return k > 0 and steps[k - 1].equations == self.step.equations != ()

    def shown(self, sides: Iterable[tuple[Element, Element]]) -> EntrySteps:
        """Return equations with the shorter side in front."""
        write = self.writer.element
        rows = []
        pairs = tuple(sides)
        longest = _LONG_ALONE if len(pairs) == 1 else _LONG_AMONG_OTHERS
        for left, right in pairs:
            known, chain = write(left), write(right)
            front, behind = (known, chain) if weight(known) <= weight(chain) else (chain, known)
            if is_zero(front):
                front, behind = behind, front
            together = weight(front) + weight(behind)
            if weight(front) > longest or (weight(front) > LONG and together > _LONG_TOGETHER):
                front, behind = write(left - left), write(left - right)
            rows.append(EntryStep(front, (behind,), None))
            self.written.add((front, behind))
        return EntrySteps(tuple(rows))

    def stand_there(self, rows: Sequence[EntryStep]) -> bool:
        """Say whether equations have been written in this step as they are."""
        return all(
            {(row.name, row.forms[0]), (row.forms[0], row.name)} & self.written for row in rows
        )

    def has_written(self, row: EntryStep) -> bool:
        """Say whether an equation stands in this step, its sides in the same order."""
        return (row.name, *row.forms) in self.written

    def as_equation(self, element: Element) -> EntrySteps:
        """Return ``element = 0`` with what the goal gives on one side."""
        ring = self.writer.form.ring
        given: dict[tuple[int, ...], object] = {}
        rest: dict[tuple[int, ...], object] = {}
        for powers, coefficient in element.terms():
            goal = any(power and ring.is_given(k) for k, power in enumerate(powers))
            (given if goal else rest)[powers] = coefficient
        left, right = ring.ring.from_dict(given), -ring.ring.from_dict(rest)
        if right and all(coefficient < 0 for coefficient in right.values()) and left:
            left, right = -left, -right
        return self.shown([(left, right)])

    def linear(
        self, coefficients: Sequence[Element], longest: int = SHORT
    ) -> tuple[Expr, Expr, Expr]:
        """Return A, B, C with letters for what is long: A s + B c = -C, so -C gets the letter."""
        a, b, c = coefficients
        short = self.writer.short
        return short(a, self.new), short(b, self.new), -short(-c, self.new, longest)

    def introduced(self) -> list[Block]:
        """Give what the new names stand for, once."""
        if not self.new:
            return []
        introduction = self.writer.introduction
        rows = [introduction(letter, element, self.title) for letter, element in self.new]
        self.new = []
        letters = "a letter" if len(rows) == 1 else "letters"
        return [Paragraph((f"With {letters} for what is known,",)), EntrySteps(tuple(rows))]

    def restated(self, equation: Node) -> list[Block]:
        """Give the new names, and the equation with them; nothing where it stands there."""
        told = self.introduced()
        return [*told, Paragraph(("this becomes",)), Display(equation)] if told else []

    def rows(
        self, equations: Sequence[tuple[Expr, Expr, Expr]], s: Expr, c: Expr
    ) -> tuple[EntryStep, ...]:
        """Return ``A s + B c = -C`` of each equation, with as few signs as can be."""
        write = self.writer.expression
        rows = []
        for a, b, rest in equations:
            left, right = write(a * s + b * c), write(-rest)
            if isinstance(left, Negative):
                left, right = left.node, write(rest)
            rows.append(EntryStep(left, (right,), None))
        return tuple(rows)

    def trigonometric(self) -> tuple[Expr, Expr]:
        """Return the sine and the cosine of the unknown."""
        unknown = self.step.unknown
        return self.writer.sine(unknown), self.writer.cosine(unknown)

    def polar(self, rho: Symbol, psi: Symbol, y: Expr, x: Expr) -> list[Block]:
        """Put ``rho sin psi`` and ``rho cos psi`` for two known parts."""
        write = self.writer.expression
        angle = write(psi)
        rows = (
            EntryStep(write(y), (Product((write(rho), Call("sin", (angle,)))),), None),
            EntryStep(write(x), (Product((write(rho), Call("cos", (angle,)))),), None),
        )
        self.writer.work(self.title, rho, sqrt(y**2 + x**2))
        self.writer.work(self.title, psi, atan2(y, x, evaluate=False), turns=True)
        values = (
            EntryStep(write(rho), (write(sqrt(y**2 + x**2)),), None),
            EntryStep(angle, (write(atan2(y, x, evaluate=False)),), None),
        )
        return [
            Paragraph(
                (
                    *("With a length ", write(rho), " and an angle ", angle),
                    " the known parts are written as",
                )
            ),
            EntrySteps(rows),
            Paragraph(("so that",)),
            EntrySteps(values),
        ]


def solution(*rows: EntryStep, lead: str = "Hence") -> list[Block]:
    """Give the values of the unknown."""
    return [Paragraph((lead,)), EntrySteps(tuple(rows))]
