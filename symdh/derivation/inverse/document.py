"""Inverse kinematics as a document: what is given, each step, the solutions and their numbers."""

from __future__ import annotations

from collections.abc import Sequence

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Display,
    Document,
    EntrySteps,
    Paragraph,
    Text,
)
from symdh.derivation.inverse.arm import gathered, link_matrices, the_arm
from symdh.derivation.inverse.example import example
from symdh.derivation.inverse.given import given as what_is_given
from symdh.derivation.inverse.known_parts import is_told
from symdh.derivation.inverse.names import Writer, goal_letters
from symdh.derivation.inverse.no_closed_form import without_closed_form
from symdh.derivation.inverse.numbers import Solved, numbers_chapter
from symdh.derivation.inverse.solutions import solutions
from symdh.derivation.inverse.steps import step_chapter
from symdh.derivation.legend import legend
from symdh.derivation.style import Naming, Style
from symdh.kinematics.inverse.branches import branches_of
from symdh.kinematics.inverse.inverse import InverseKinematics, Method
from symdh.notation.nodes import (
    Node,
)


def inverse_document(
    found: InverseKinematics, solved: Solved | None = None, naming: Naming | str = Naming.AUTO
) -> Document:
    """Return the document on the inverse kinematics of an arm.

    Parameters
    ----------
    found : InverseKinematics
    solved : Solved, optional
        Solutions to print for one goal.
    naming : Naming or str
        How poses are written.
    """
    robot = found.robot
    writer: Writer | None = None
    chapters: list[Chapter] = []
    if found.method is not Method.CLOSED_FORM:
        chapters.append(without_closed_form(found))
    if found.form is not None and found.method is not Method.LEAST_SQUARES:
        form = found.form
        style = Style(form.arm.robot, naming=Naming(naming), leading=goal_letters(form))
        writer = Writer(style, form, branches_of(form))
        chapters += _derivation(found, writer)
    if solved is not None:
        chapters.append(numbers_chapter(found, solved))
        if writer is not None and solved.answers and found.method is Method.CLOSED_FORM:
            chapters.append(example(writer, solved))
    subtitle: Text = ("Inverse kinematics",)
    return Document(robot.title or robot.name, subtitle, tuple(chapters))


def _derivation(found: InverseKinematics, writer: Writer) -> list[Chapter]:
    form, style = writer.form, writer.style
    given = what_is_given(found, form, writer)
    steps = [step_chapter(writer, step) for step in form.steps if is_told(form, step)]
    links = link_matrices(form, writer)
    formulas = [node for chapter in steps for node in _formulas(chapter.blocks)]
    meanings = legend(style, [*formulas, *(each.matrix for each in links.matrices)])
    told: list[Block] = [] if meanings is None else [meanings]
    told += gathered(form, writer)
    return [
        the_arm(form, writer),
        given,
        Chapter("The links", (*told, links)),
        *steps,
        solutions(form, writer),
    ]


def _formulas(blocks: Sequence[Block]) -> list[Node]:
    """Return the formulas in blocks."""
    found: list[Node] = []
    for block in blocks:
        if isinstance(block, EntrySteps):
            found += [node for step in block.entries for node in (step.name, *step.forms)]
        elif isinstance(block, Paragraph):
            found += [part for part in block.content if not isinstance(part, str)]
        else:
            assert isinstance(block, Display), "a step is told by nothing else"
            found.append(block.formula)
    return found
