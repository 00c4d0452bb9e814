"""Where the equations of a step come from: the matrices moved, the entries compared."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from symdh.derivation.blocks import Block, Display, EntrySteps, Inline, Paragraph
from symdh.derivation.inverse.formulas import listed, place
from symdh.derivation.inverse.telling import Telling
from symdh.kinematics.inverse.pool import Combination, Equation, Source
from symdh.kinematics.inverse.solution import Used


def origin(telling: Telling) -> list[Block]:
    """Say which matrices were moved and which entries compared, and give the equations."""
    blocks: list[Block] = []
    for sources, equations in _by_matrix(used.equation for used in telling.step.equations):
        blocks += _read_off(telling, sources, equations)
    expanded = [used for used in telling.step.equations if used.element != used.equation.element]
    if expanded:
        blocks += _expanded(telling, expanded)
    return blocks


def _read_off(telling: Telling, source: Source, equations: Sequence[Equation]) -> list[Block]:
    if equations[0].parents:
        return _combined(telling, equations[0])
    entries = [entry for equation in equations for entry in equation.source.entries]
    before = {telling.writer.told.get(equation.source, "") for equation in equations}
    for equation in equations:
        telling.writer.told.setdefault(equation.source, telling.title)
    if len(before) == 1 and min(before) and not any(e.source.is_squared for e in equations):
        return [
            Paragraph(_compared_again(entries, min(before))),
            telling.shown(side for each in equations for side in each.sides),
        ]
    blocks: list[Block] = [
        Paragraph(_moved(telling, source)),
        Display(telling.writer.matrix_equation(source)),
    ]
    squared = [equation for equation in equations if equation.source.is_squared]
    plain = [equation for equation in equations if not equation.source.is_squared]
    if plain:
        entries = [entry for equation in plain for entry in equation.source.entries]
        blocks.append(Paragraph(_compared(entries)))
        blocks.append(telling.shown(side for each in plain for side in each.sides))
    for equation in squared:
        blocks.append(Paragraph(_compared(equation.source.entries)))
        blocks.append(telling.shown(equation.sides))
        _remember(telling, equation)
        blocks.append(Paragraph(("Squared and added, they give",)))
        blocks.append(telling.as_equation(equation.element))
    return blocks


def _remember(telling: Telling, equation: Equation) -> None:
    """Entries that were squared and added have been compared one by one as well."""
    for entry in equation.source.entries:
        telling.writer.told.setdefault(replace(equation.source, entries=(entry,)), telling.title)


def _moved(telling: Telling, source: Source) -> tuple[Inline, ...]:
    writer = telling.writer
    names = [*writer.links(source.base[0], source.i), *writer.links(source.j, source.base[1])]
    goal = writer.goal_matrix(source)
    if source.inverted:
        tail = (", and the links at its ends are moved over",) if names else ()
        return ("Both sides are inverted, so that the base is seen from the hand", *tail, ":")
    if not names:
        return ("The matrix equation is taken as it stands:",)
    verb = "are" if len(names) > 1 else "is"
    return (*listed(names), f" {verb} moved to the side of ", goal, ":")


def _combined(telling: Telling, equation: Equation) -> list[Block]:
    blocks: list[Block] = []
    for source, parents in _by_matrix(equation.parents):
        blocks += _read_off(telling, source, parents)
    how = equation.combination or Combination.RATIO
    return [
        *blocks,
        Paragraph((f"{how.value[0].upper()}{how.value[1:]}:",)),
        telling.as_equation(equation.element),
    ]


def _expanded(telling: Telling, used: Sequence[Used]) -> list[Block]:
    text = "The sums of angles are expanded, since one part of each is known:"
    rows = [row for each in used for row in telling.as_equation(each.element).entries]
    return [Paragraph((text,)), EntrySteps(tuple(rows))]


def _by_matrix(equations: Iterable[Equation]) -> list[tuple[Source, list[Equation]]]:
    """Group equations that were read off the same matrix equation."""
    groups: list[tuple[Source, list[Equation]]] = []
    for equation in equations:
        source = equation.source
        key = (source.i, source.j, source.inverted, source.base, bool(equation.parents))
        for other, members in groups:
            if not equation.parents and key == (
                *(other.i, other.j, other.inverted, other.base),
                bool(members[0].parents),
            ):
                members.append(equation)
                break
        else:
            groups.append((source, [equation]))
    return groups


def _compared(entries: Sequence[tuple[int, int]]) -> tuple[Inline, ...]:
    """Say which entries are compared."""
    places = listed([place(entry) for entry in entries])
    return ("The entries at ", *places, " on both sides are equal:")


def _compared_again(entries: Sequence[tuple[int, int]], title: str) -> tuple[Inline, ...]:
    """Say which entries are taken that an earlier step has compared."""
    places = listed([place(entry) for entry in entries])
    return ("The entries at ", *places, f" have been compared for {title}:")
