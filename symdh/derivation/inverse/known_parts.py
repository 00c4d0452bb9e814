"""Angles that are sums of known ones, and names for known parts."""

from __future__ import annotations

from symdh.derivation.blocks import Block, Display, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.formulas import listed
from symdh.derivation.inverse.telling import Telling
from symdh.kinematics.inverse.pool import Equation, Source
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.notation import nodes
from symdh.notation.nodes import Negative, Sum
from symdh.notation.writing import weight

#: The entry of a known part that has more to read than this is not written out.
_TOO_LONG = 30


def known_sum(telling: Telling) -> list[Block]:
    """Give an angle as the sum of known ones."""
    writer = telling.writer
    terms = []
    for sign, part in telling.step.parts:
        node = writer.unknown(part)
        terms.append(node if sign > 0 else Negative(node))
    terms.sort(key=lambda node: isinstance(node, Negative))
    row = EntryStep(writer.unknown(telling.step.unknown), (Sum(tuple(terms)),), None)
    return [Paragraph(("Both parts are known:",)), EntrySteps((row,))]


def named_parts(telling: Telling) -> list[Block]:
    """Give the entries of a part whose pose is known now."""
    step, writer = telling.step, telling.writer
    assert step.part is not None
    i, j = step.part
    before = [other.part for other in writer.form.steps if other.part]
    place_now = before.index(step.part)
    base = before[place_now - 1] if place_now else None
    n = writer.form.arm.robot.n
    source = Source(i, j, (), base=base if base is not None else (0, n))
    shown = _printed(writer.form)
    rows = [
        EntryStep(writer.expression(writer.form.ring.letters[k]), (writer.nested(e),), None)
        for k, e in step.definitions
        if k in shown
    ]
    name = writer.part_name(step.part)
    equation = writer.matrix_equation(source)
    assert isinstance(equation, nodes.Equation)
    moved: list[Block] = [
        Paragraph(("The joints found so far are taken to the side of what is known,",)),
        Display(nodes.Equation((name, *equation.sides))),
    ]
    if any(weight(form) > _TOO_LONG for row in rows for form in row.forms):
        entries = listed([row.name for row in rows])
        text = (" are known numbers, row times column; written out they would fill the page.",)
        return [*moved, Paragraph(("of which ", *entries, *text))]
    return [
        *moved,
        Paragraph(("and the entries that are needed get names:",)),
        EntrySteps(tuple(rows)),
    ]


def _printed(form: ClosedForm) -> set[int]:
    """Return the generators that stand in what is printed of the steps."""
    elements: list[Element] = []

    def add(equation: Equation) -> None:
        elements.extend(side for pair in equation.sides for side in pair)
        elements.append(equation.element)
        for parent in equation.parents:
            add(parent)

    for step in form.steps:
        elements += step.coefficients
        elements += [element for _, element in step.definitions]
        for used in step.equations:
            add(used.equation)
    return {k for e in elements for powers in e for k, power in enumerate(powers) if power}
