"""The arm that is solved: its table with a letter for every length, and its links."""

from __future__ import annotations

from symdh.derivation.blocks import (
    Block,
    Chapter,
    EntryStep,
    EntrySteps,
    MatrixRow,
    NamedMatrix,
    Paragraph,
)
from symdh.derivation.inverse.names import Writer
from symdh.derivation.table import chapter as table_chapter
from symdh.kinematics.chain import link_word
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.motion import transform


def the_arm(form: ClosedForm, writer: Writer) -> Chapter:
    """Return the chapter with the table, and what stands in it for a number."""
    table = table_chapter(writer.style)
    return Chapter(table.title, (*table.blocks, *_letters(form, writer)))


def _letters(form: ClosedForm, writer: Writer) -> list[Block]:
    """Say what the letters stand for that the table does not have."""
    meanings = form.arm.meanings
    if not meanings:
        return []
    style = writer.style
    rows = tuple(
        EntryStep(style.notation.write(letter), (style.figures.write(meaning),), None)
        for letter, meaning in meanings.items()
    )
    return [Paragraph(("Letters stand for the numbers of the table:",)), EntrySteps(rows)]


def gathered(form: ClosedForm, writer: Writer) -> list[Block]:
    """Say of rows at the ends of the chain that do not move which link they are part of."""
    arm, style = form.arm, writer.style
    notes: list[Block] = []
    for row, word in enumerate(arm.rows, start=1):
        outside = row < arm.moving[0] or row > arm.moving[-1]
        if outside and not word and link_word(arm.robot, row):
            into = arm.moving[0] if row < arm.moving[0] else arm.moving[-1]
            told = (style.link_name(row), " does not move and is made part of ")
            notes.append(Paragraph((*told, style.link_name(into), ".")))
    return notes


def link_matrices(form: ClosedForm, writer: Writer) -> MatrixRow:
    """Return the matrices of the rows as the equations have them."""
    style = writer.style
    return MatrixRow(
        tuple(
            NamedMatrix((style.link_name(row),), style.notation.matrix(transform(word)))
            for row, word in enumerate(form.arm.rows, start=1)
        )
    )
