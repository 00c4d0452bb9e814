"""Angles that are sums of known ones, and names for known parts."""

from __future__ import annotations

from symdh.derivation.blocks import Block, Display, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.formulas import listed
from symdh.derivation.inverse.singular import pair_that_serves
from symdh.derivation.inverse.telling import Telling
from symdh.kinematics.inverse.pool import Equation, Source
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.solution import ClosedForm, Rule, Step
from symdh.notation import nodes
from symdh.notation.nodes import Negative, Sum
from symdh.notation.writing import weight

#: The entry of a known part that has more to read than this is not written out.
_TOO_LONG = 30


def is_told(form: ClosedForm, step: Step) -> bool:
    """Say whether a step needs a chapter.

    A sum of angles does not where each of them is known, or where nothing but another sum uses it.
    """
    ring = form.ring
    if step.rule is not Rule.SUM or len(ring.forms[step.unknown]) == 1:
        return True
    found = {before.unknown for before in form.steps[: form.steps.index(step)]}
    if all(ring.unknown_of(row) in found for row, _ in ring.forms[step.unknown]):
        return False
    generators = {2 * step.unknown, 2 * step.unknown + 1}
    return any(powers[k] for e in _all_elements(form) for powers in e for k in generators)


def known_sum(telling: Telling) -> list[Block]:
    """Give an angle as the sum of known ones."""
    writer = telling.writer
    parts = [
        node if sign > 0 else Negative(node)
        for sign, part in _told_parts(writer.form, telling.step)
        for node in (writer.unknown(part),)
    ]
    parts.sort(key=lambda node: isinstance(node, Negative))
    row = EntryStep(writer.unknown(telling.step.unknown), (Sum(tuple(parts)),), None)
    lead = "Both parts are known:" if len(parts) == 2 else "All parts are known:"
    return [Paragraph((lead,)), EntrySteps((row,))]


def _told_parts(form: ClosedForm, step: Step) -> list[tuple[int, int]]:
    """Return what a sum is made of, with the parts of a sum that has no chapter of its own."""
    parts: list[tuple[int, int]] = []
    for sign, part in step.parts:
        of_part = next((each for each in form.steps if each.unknown == part), None)
        if of_part is None or is_told(form, of_part):
            parts.append((sign, part))
        else:
            parts += [(sign * inner, each) for inner, each in _told_parts(form, of_part)]
    return parts


def named_parts(telling: Telling) -> list[Block]:
    """Give the entries of a part whose pose is known now."""
    step, writer = telling.step, telling.writer
    assert step.part is not None
    i, j = step.part
    before = [other.part for other in writer.form.steps if other.part]
    place_now = before.index(step.part)
    base = before[place_now - 1] if place_now else None
    n = writer.form.arm.robot.n
    source = Source(i, j, (), inverted=False, base=base if base is not None else (0, n))
    shown = _printed(writer.form)
    rows = [
        EntryStep(writer.expression(writer.form.ring.letters[k]), (writer.nested(e),), None)
        for k, e in step.definitions
        if k in shown
    ]
    for k, element in step.definitions:
        if k in shown:
            ring = writer.form.ring
            writer.work(telling.title, ring.letters[k], ring.expression(element))
    name = writer.part_name(step.part)
    equation = writer.matrix_equation(source)
    assert isinstance(equation, nodes.Equation)
    moved: list[Block] = [
        Paragraph(("The links whose joints are found go to the side of what is known:",)),
        Display(nodes.Equation((name, *equation.sides))),
    ]
    if any(weight(form) > _TOO_LONG for row in rows for form in row.forms):
        entries = listed([row.name for row in rows])
        text = " are known, row times column; written out they would fill the page."
        return [*moved, Paragraph(("Of its entries ", *entries, text))]
    return [
        *moved,
        Paragraph(("The entries that are needed get names:",)),
        EntrySteps(tuple(rows)),
    ]


def _printed(form: ClosedForm) -> set[int]:
    """Return the generators that stand in what is printed of the steps."""
    elements = _all_elements(form)
    return {k for e in elements for powers in e for k, power in enumerate(powers) if power}


def _all_elements(form: ClosedForm) -> list[Element]:
    """Return all that is printed of the steps."""
    elements: list[Element] = []

    def add(equation: Equation) -> None:
        elements.extend(side for pair in equation.sides for side in pair)
        elements.append(equation.element)
        for parent in equation.parents:
            add(parent)

    for step in form.steps:
        elements += step.coefficients
        elements += pair_that_serves(step, form) or () if step.rule is Rule.PAIR else ()
        elements += [element for _, element in step.definitions]
        for used in step.equations:
            add(used.equation)
    return elements
