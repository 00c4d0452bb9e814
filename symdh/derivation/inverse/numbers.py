"""The solutions for one goal in numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import pi

from sympy import Expr, Symbol

from symdh.derivation.attitude import rounded_angle
from symdh.derivation.blocks import (
    Block,
    Chapter,
    NamedMatrix,
    Paragraph,
    ParameterTable,
    Text,
)
from symdh.derivation.inverse.formulas import listed
from symdh.derivation.inverse.names import unknown_name
from symdh.derivation.inverse.solutions import NUMBER
from symdh.derivation.style import Style
from symdh.derivation.words import counted
from symdh.kinematics.inverse.branches import Branches, branches_of
from symdh.kinematics.inverse.inverse import InverseKinematics, Method
from symdh.kinematics.inverse.judge import Answer
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.notation.nodes import (
    Generic,
    Matrix,
    Name,
    Node,
    Rounded,
)
from symdh.notation.numbers import figures
from symdh.robot import AngleUnit, Robot

_METHOD = {
    Method.CLOSED_FORM: "Solved in closed form;",
    Method.NOMINAL: (
        "There is no closed form of this very arm. Solved by that of its nominal arm, without "
        "small lengths and angles, improved by Newton's method, which may miss a solution near "
        "singular poses;"
    ),
    Method.ONE_JOINT: (
        "There is no closed form. Solved by a search over one joint with the others in closed "
        "form, completed by damped least squares, which may miss a solution;"
    ),
    Method.LEAST_SQUARES: (
        "There is no closed form. Solved by damped least squares from many starting points, which "
        "may miss a solution;"
    ),
}


@dataclass(frozen=True)
class Solved:
    """The solutions for one goal.

    Attributes
    ----------
    goal : rows of numbers
        The pose that was asked for.
    answers : sequence of Answer
    values : mapping of Symbol to Expr
        Numbers for parameters that are not the table's own.
    """

    goal: Sequence[Sequence[float]]
    answers: Sequence[Answer]
    values: Mapping[Symbol, Expr] = field(default_factory=dict)


def numbers_chapter(found: InverseKinematics, solved: Solved) -> Chapter:
    """Give the solutions for one goal."""
    robot = found.robot
    style = Style(robot)
    goal = Matrix(
        (
            *(tuple(Rounded(figures(x)) for x in row) for row in solved.goal[:3]),
            tuple(Rounded(str(int(c == 3))) for c in range(4)),
        )
    )
    blocks: list[Block] = [Paragraph((f"{_METHOD[found.method]} the goal is",))]
    blocks.append(NamedMatrix((Generic("T"),), goal))
    count = len(solved.answers)
    if not count:
        text = "This goal has no solution"
        text += (
            ": it is out of reach."
            if found.method in (Method.CLOSED_FORM, Method.NOMINAL)
            else " that was found; there may be one all the same."
        )
        return Chapter("Numbers", (*blocks, Paragraph((text,))))
    unit = "radians" if robot.units.angle is AngleUnit.RADIAN else "degrees"
    blocks.append(Paragraph((f"It has {counted(count, 'solution')}, angles in {unit}:",)))
    turning = {j.variable for j in robot.joints if j.type.value == "revolute"}
    header: tuple[Node, ...] = (NUMBER, *(Name(v.name) for v in robot.variables))
    rows: list[tuple[Node, ...]] = []
    for k, answer in enumerate(solved.answers, start=1):
        pairs = zip(robot.variables, answer.q, strict=True)
        values = [_value(style, x, variable in turning) for variable, x in pairs]
        rows.append((Rounded(str(k)), *values))
    branches = None
    if found.form is not None and found.method is Method.CLOSED_FORM:
        branches = branches_of(found.form, solved.values)
    told = [
        _answer_note(style, found.form, branches, k, a)
        for k, a in enumerate(solved.answers, start=1)
    ]
    notes: list[Text] = [note for note in told if note]
    worst = max(answer.error for answer in solved.answers)
    blocks.append(ParameterTable(header, tuple(rows), tuple(notes)))
    blocks.append(
        Paragraph(
            (
                "Put into the forward kinematics, they miss the goal by at most "
                f"{worst:.1e}{_length_unit(robot)}.",
            )
        )
    )
    return Chapter("Numbers", tuple(blocks))


def _answer_note(
    style: Style, form: ClosedForm | None, branches: Branches | None, k: int, a: Answer
) -> Text:
    """Say which branches a solution is, and what else there is to know of it."""
    said: list[Text] = []
    if form is not None and branches is not None and a.branches:
        for each, branch in zip(branches.steps, a.branches, strict=True):
            if each.feature is not None:
                said.append((each.feature.name(a.q),))
            else:
                stage = str(branch + 1)
                said.append((unknown_name(style, form.ring, each.step.unknown, stage),))
    if a.free:
        said.append(("singular, ", *listed([Name(v.name) for v in a.free]), " free"))
    if not a.within_limits:
        said.append(("outside the limits of the table",))
    parts = [part for each in said for part in (", ", *each)][1:]
    return (f"{k}: ", *parts, ".") if said else ()


def _value(style: Style, value: float, turns: bool) -> Node:
    if not turns:
        return Rounded(figures(value))
    return rounded_angle(style, 0.0 if abs(value) < 5e-15 else min(value, pi))


def _length_unit(robot: Robot) -> str:
    return f" {robot.units.length.value}" if robot.units.length else ""
