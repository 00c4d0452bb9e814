"""Chapter: the recursion in place of a closed form that would fill pages."""

from __future__ import annotations

from sympy import Integer

from symdh.derivation.blocks import Block, Chapter, Display, EntryStep, EntrySteps, Paragraph, Text
from symdh.derivation.style import Style
from symdh.kinematics.chain import chain_word, segment
from symdh.kinematics.forward import CLOSED_FORM_LIMIT
from symdh.kinematics.frame import Frame, place
from symdh.motion import transform
from symdh.motion.size import closed_form_size
from symdh.notation.nodes import (
    Dot,
    Equation,
    Generic,
    Negative,
    Node,
    Number,
    Product,
    Sum,
    Tuple,
)
from symdh.robot import Robot


def chapter(style: Style, start: Frame, end: Frame) -> Chapter:
    """Return the chapter that gives the pose by a recursion with named intermediate results."""
    robot = style.robot
    if place(robot, start) > place(robot, end):
        return _backwards(style, start, end)
    blocks: list[Block] = [
        Paragraph(
            (
                f"{_why(robot, start, end)} It is given link by link instead, from the hand "
                "to the base. A direction fixed in the last frame has the components ",
                Generic("u"),
                " and its origin the components ",
                Generic("p"),
                "; the raised number tells the frame in which they are seen.",
            )
        ),
        Display(_start(end)),
    ]
    first, last = place(robot, start), place(robot, end)
    for k in range(last - 1, first - 1, -1):
        if segment(robot, k):
            blocks.append(EntrySteps(_link(style, k)))
    blocks.append(
        Paragraph(
            (
                "Started with the three unit vectors in turn, ",
                Generic("u"),
                " ends as the columns ",
                Generic("n"),
                ", ",
                Generic("s"),
                ", ",
                Generic("a"),
                " of ",
                style.pose_name(start, end),
                ", and ",
                Generic("p"),
                " as its origin.",
            )
        )
    )
    return Chapter("The pose by recursion", tuple(blocks))


def _why(robot: Robot, start: Frame, end: Frame) -> str:
    """Return why the products are not written out."""
    size = closed_form_size(chain_word(robot, start, end))
    if size <= CLOSED_FORM_LIMIT:
        return f"With {robot.n} rows, the pose worked out one product at a time would fill pages."
    about = f"{size:,}" if size < 10**7 else f"more than 10^{len(str(size)) - 1}"
    limit = f"over the limit of {CLOSED_FORM_LIMIT:,}"
    return f"Written out, the pose would have {about} operations, {limit}."


def _backwards(style: Style, start: Frame, end: Frame) -> Chapter:
    """Return the recursion of the way there; the way back is its rigid inverse."""
    there = chapter(style, end, start)
    back, forth = style.pose_name(start, end), style.pose_name(end, start)
    columns = [Generic(letter) for letter in "nsa"]
    rows = Tuple(tuple(columns))
    origin = Tuple(tuple(Negative(Dot(column, Generic("p"))) for column in columns))
    note: Text = (
        *(back, " is the rigid inverse of ", forth, ": its rotation is the transpose, with the "),
        *("rows ", rows, ", and its origin is ", origin, "."),
    )
    return Chapter(there.title, (*there.blocks, Paragraph(note)))


def _stage(style: Style, k: int) -> str:
    if k < 0:
        return "base"
    return "tool" if k > style.robot.n else str(k)


def _start(end: Frame) -> Node:
    zero = Number(Integer(0))
    sides = tuple(Generic("p", axis, stage=str(end)) for axis in "xyz")
    return Equation((*sides, zero))


def _link(style: Style, k: int) -> tuple[EntryStep, ...]:
    """Return the six equations that carry u and p from place k + 1 to place k."""
    matrix = style.notation.matrix(transform(segment(style.robot, k)))
    inner, outer = _stage(style, k + 1), _stage(style, k)
    steps = []
    for letter in "up":
        for row, axis in enumerate("xyz"):
            terms = [
                _times(matrix.rows[row][c], Generic(letter, other, stage=inner))
                for c, other in enumerate("xyz")
            ]
            if letter == "p":
                terms.append(matrix.rows[row][3])
            name = Generic(letter, axis, stage=outer)
            steps.append(EntryStep(name, (_sum(terms),), None))
    return tuple(steps)


def _times(coefficient: Node, component: Node) -> Node:
    match coefficient:
        case Number(value=value) if value == 0:
            return coefficient
        case Number(value=value) if value == 1:
            return component
        case Negative(node=inner):
            return Negative(_times(inner, component))
        case Product(factors=factors):
            return Product((*factors, component))
        case _:
            return Product((coefficient, component))


def _sum(terms: list[Node]) -> Node:
    present = [term for term in terms if term != Number(Integer(0))]
    return present[0] if len(present) == 1 else Sum(tuple(present))
