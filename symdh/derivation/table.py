"""Chapter: the table as given, and what it counts."""

from __future__ import annotations

from sympy import Expr, Integer

from symdh.derivation.blocks import Block, Chapter, Display, Paragraph, ParameterTable, Text
from symdh.derivation.style import Style
from symdh.derivation.words import counted
from symdh.notation.nodes import (
    Equation,
    Generic,
    Juxtaposed,
    Name,
    Node,
    Number,
    Operator,
    mapped,
)
from symdh.robot import (
    AngleUnit,
    Axis,
    Convention,
    Joint,
    Motion,
    MotionKind,
    Robot,
)

_R, _T = MotionKind.ROTATION, MotionKind.TRANSLATION


def chapter(style: Style) -> Chapter:
    """Return the chapter on the table."""
    blocks: list[Block] = [
        parameters(style),
        Paragraph(("Each row stands for four motions, made one after the other:",)),
        Display(Equation((_row_name(style), sequence(style)))),
    ]
    return Chapter("The table", tuple(blocks))


def parameters(style: Style) -> ParameterTable:
    """Return the table itself."""
    return ParameterTable(_header(style.robot), _rows(style), _notes(style))


def sequence(style: Style) -> Node:
    """Return the operator sequence of the convention, with a running index."""
    standard = style.robot.convention is Convention.STANDARD
    before = "i" if standard else "i-1"
    theta = Operator(_R, Axis.Z, Generic("theta", "i"), style.craig)
    d = Operator(_T, Axis.Z, Generic("d", "i"), style.craig)
    a = Operator(_T, Axis.X, Generic("a", before), style.craig)
    alpha = Operator(_R, Axis.X, Generic("alpha", before), style.craig)
    return Juxtaposed((theta, d, a, alpha) if standard else (alpha, a, theta, d))


def _row_name(style: Style) -> Node:
    name = style.pose_name("i-1", "i")
    return name if style.craig else Equation((Generic("A", "i"), name))


def _header(robot: Robot) -> tuple[Node, ...]:
    if robot.convention is Convention.STANDARD:
        columns = (("theta", "i"), ("d", "i"), ("a", "i"), ("alpha", "i"))
    else:
        columns = (("alpha", "i-1"), ("a", "i-1"), ("d", "i"), ("theta", "i"))
    return (Generic("i"), *(Generic(letter, index) for letter, index in columns))


def _rows(style: Style) -> tuple[tuple[Node, ...], ...]:
    return tuple(_row(style, i, joint) for i, joint in enumerate(style.robot.joints, start=1))


def _row(style: Style, i: int, joint: Joint) -> tuple[Node, ...]:
    theta, d, a, alpha = (
        _cell(style, joint, kind, amount)
        for kind, amount in ((_R, joint.theta), (_T, joint.d), (_T, joint.a), (_R, joint.alpha))
    )
    number = Number(Integer(i))
    if style.robot.convention is Convention.STANDARD:
        return number, theta, d, a, alpha
    return number, alpha, a, d, theta


def _cell(style: Style, joint: Joint, kind: MotionKind, amount: Expr) -> Node:
    node = style.angle(Motion(kind, Axis.Z, amount))
    if joint.variable is None:
        return node
    variable = joint.variable.name
    return mapped(node, lambda leaf: Name(variable, True) if leaf == Name(variable) else leaf)


def _notes(style: Style) -> tuple[Text, ...]:
    robot = style.robot
    variables = len(robot.variables)
    parameters = 4 * robot.n
    joints = counted(variables, "joint")
    arm = joints if variables == robot.n else f"{counted(robot.n, 'row')} with {joints}"
    star = "* joint variable. " if variables else ""
    count = f"{parameters} parameters, {parameters - variables} of them constant."
    notes: list[Text] = [(f"{star}{arm.capitalize()}: {count}",)]
    for label, word in (("Base", robot.base), ("Tool", robot.tool)):
        if word:
            notes.append((f"{label}: ", Juxtaposed(style.operators(word)), "."))
    if robot.units.angle is AngleUnit.RADIAN:
        notes.append(("Angles are in radians.",))
    return tuple(notes)
