"""The tree of branches."""

from __future__ import annotations

from itertools import product
from math import prod

from symdh.derivation.blocks import (
    Chapter,
    Paragraph,
    ParameterTable,
    Text,
)
from symdh.derivation.inverse.names import Writer
from symdh.derivation.words import number_word
from symdh.kinematics.inverse.branches import Branches
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.notation.nodes import (
    Node,
    Rounded,
    Words,
)

#: The head of the column that counts solutions; a letter might stand for something else.
NUMBER = Words("no.")


def solutions(form: ClosedForm, writer: Writer) -> Chapter:
    """Give the tree of branches."""
    steps = form.branching
    if not steps:
        text = "Every step has one value, so there is one solution, or none out of reach."
        return Chapter("The solutions", (Paragraph((text,)),))
    factors = " times ".join(number_word(step.branches) for step in steps)
    total = form.most_solutions
    lead: Text = (
        f"The branches make a tree: {factors} is {total}, so there are at most {total} solutions. "
        if len(steps) > 1
        else f"There are at most {total} solutions. ",
        "In each the other unknowns have one value. Forward kinematics decides; solutions that are "
        "out of reach or false are left out.",
    )
    combinations = list(product(*(range(step.branches) for step in steps)))
    named = [_names_of(writer.branches, taken) for taken in combinations]
    header: list[Node] = [NUMBER, *(writer.unknown(step.unknown) for step in steps)]
    header += [Words("posture")] if any(named) else []
    rows: list[tuple[Node, ...]] = []
    notes: list[Text] = []
    for k, (taken, names) in enumerate(zip(combinations, named, strict=True), start=1):
        cells = [
            writer.unknown(step.unknown, str(branch + 1))
            for step, branch in zip(steps, taken, strict=True)
        ]
        cells += [Words(", ".join(names))] if any(named) else []
        rows.append((Rounded(str(k)), *cells))
    open_ = [f"{names[0]} or {names[1]}" for names in _undecided(writer.branches)]
    if open_:
        notes.append((f"Whether a solution is {' and '.join(open_)} depends on the goal.",))
    return Chapter(
        "The solutions", (Paragraph(lead), ParameterTable(tuple(header), tuple(rows), tuple(notes)))
    )


def _names_of(branches: Branches, taken: tuple[int, ...]) -> tuple[str, ...]:
    """Return the sides of the arm that a combination of branches always gives."""
    known = branches.together.get(taken)
    names = []
    for place, (each, branch) in enumerate(zip(branches.steps, taken, strict=True)):
        if each.feature is not None and each.names:
            names.append(each.names[branch])
        elif each.feature is not None and known is not None and not _undecided(branches):
            names.append(known[place])
    return tuple(names)


def _undecided(branches: Branches) -> list[tuple[str, str]]:
    """Return the names of features that depend on the goal for some combination of branches."""
    count = prod(each.step.branches for each in branches.steps)
    if len(branches.together) == count:
        return []
    return [each.feature.names for each in branches.steps if each.feature and not each.names]
