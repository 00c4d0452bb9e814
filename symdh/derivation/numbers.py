"""Chapter: the table's numbers put in, with their units."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Expr, I, ImmutableMatrix, Integer, Symbol

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Entries,
    EntryStep,
    NamedMatrix,
    Paragraph,
)
from symdh.derivation.products import entry_name
from symdh.derivation.style import Style
from symdh.errors import UnsupportedError
from symdh.kinematics.forward import ForwardKinematics
from symdh.kinematics.numeric import NumericMatrix, pose
from symdh.notation.nodes import (
    Call,
    Equation,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Product,
    Rounded,
    Short,
    Unit,
    leaves,
    mapped,
)
from symdh.notation.numbers import figures
from symdh.robot import Robot, in_name_order
from symdh.table.quantity import NOT_FINITE

_FUNCTION = {"c": "cos", "s": "sin"}


def chapter(style: Style, forward: ForwardKinematics) -> Chapter | None:
    """Return the chapter with numbers; None when the table has no values."""
    robot = style.robot
    if not robot.values:
        return None
    blocks: list[Block] = [_given(style)]
    if forward.pose is not None:
        blocks += _put_in(style, forward, forward.pose[:3, 3])
    blocks += _numeric_pose(style, forward)
    return Chapter("Numbers", tuple(blocks))


def _given(style: Style) -> Paragraph:
    """Return the values of the table as a list of equations."""
    robot = style.robot
    content: list[str | Node] = ["The table gives "]
    symbols = [s for s in (*robot.parameters, *robot.variables) if s in robot.values]
    for position, symbol in enumerate(symbols):
        if position:
            content.append(" and " if position == len(symbols) - 1 else ", ")
        name = style.notation.write(symbol)
        content.append(Equation((name, quantity(style, symbol, robot.values[symbol]))))
    return Paragraph((*content, "."))


def quantity(style: Style, symbol: Symbol, value: Expr) -> Node:
    """Return a value with its unit."""
    if symbol in angles(style.robot):
        return style.figures.angle(value)
    number = style.figures.write(value)
    length = style.robot.units.length
    if length is None:
        return number
    if isinstance(number, Negative):
        return Negative(Product((number.node, Unit(length.value))))
    return Product((number, Unit(length.value)))


def angles(robot: Robot) -> set[Symbol]:
    """Return the symbols that measure angles."""
    rows = (expression for joint in robot.joints for expression in (joint.theta, joint.alpha))
    words = (m.amount for m in (*robot.base, *robot.tool) if m.kind.value == "R")
    return {symbol for expression in (*rows, *words) for symbol in expression.free_symbols}


def _put_in(style: Style, forward: ForwardKinematics, position: ImmutableMatrix) -> list[Block]:
    """Return the position with the known numbers in it."""
    robot = style.robot
    turning = angles(robot)
    lengths = {s: v for s, v in robot.values.items() if s not in turning}
    complete = missing(forward, robot.values) == []
    reached = _reached(forward, robot.values) if complete else None
    steps = []
    for row in range(3):
        exact = position[row]
        if not exact.free_symbols & set(robot.values):
            continue
        known = exact.xreplace(lengths)
        if known.has(I, *NOT_FINITE):
            return []
        node = mapped(style.figures.write(known), _Angles(style).put_in)
        forms = (node,) if reached is None else (node, _measured(style, reached[row][3]))
        steps.append(EntryStep(entry_name(row, 3), forms, None))
    if not steps:
        return []
    sums = _angle_sums(style, forward)
    lead = ("Hence ", *sums, ". The position becomes") if sums else ("The position becomes",)
    return [Paragraph(lead), Entries((tuple(steps),))]


def _angle_sums(style: Style, forward: ForwardKinematics) -> tuple[str | Node, ...]:
    """Return the known sums of joint angles that the pose uses, as equations."""
    notation = style.notation
    known = style.robot.values
    entries = notation.matrix(forward.pose)
    labels = {leaf.label for leaf in leaves(entries) if isinstance(leaf, Short)}
    content: list[str | Node] = []
    for label in sorted(labels, key=lambda text: (len(text), text)):
        angle = notation.shorthand.angle(label)
        if angle.is_Add and angle.free_symbols <= set(known):
            if content:
                content.append(", ")
            value = angle.xreplace(dict(known))
            content.append(Equation((notation.write(angle), notation.angle(value))))
    return tuple(content)


class _Angles:
    """Puts known angles in: c_{12} becomes cos 105 deg, and cos alpha_1 becomes cos 90 deg."""

    def __init__(self, style: Style) -> None:
        self._style = style
        turning = angles(style.robot)
        self._values = {s.name: v for s, v in style.robot.values.items() if s in turning}

    def put_in(self, leaf: Node) -> Node:
        if isinstance(leaf, Name) and leaf.text in self._values:
            return self._style.figures.angle(self._values[leaf.text])
        if not isinstance(leaf, Short):
            return leaf
        notation = self._style.notation
        angle = notation.shorthand.angle(leaf.label)
        known = self._style.robot.values
        if not angle.free_symbols <= set(known):
            return leaf
        return Call(_FUNCTION[leaf.function], (notation.angle(angle.xreplace(dict(known))),))


def _measured(style: Style, value: float) -> Node:
    length = style.robot.units.length
    number = Rounded(figures(value))
    return Product((number, Unit(length.value))) if length else number


def _numeric_pose(style: Style, forward: ForwardKinematics) -> list[Block]:
    """Return the numeric matrix; joint variables without a value are taken as zero and said so."""
    robot = style.robot
    zeros = missing(forward, robot.values)
    if any(symbol not in robot.variables for symbol in zeros):
        return []
    values = {**robot.values, **{symbol: Integer(0) for symbol in zeros}}
    numbers = _reached(forward, values)
    if numbers is None:
        return []
    name = style.pose_name(forward.start, forward.end)
    lead: tuple[str | Node, ...] = ("In numbers",)
    if zeros:
        zero = Equation((*(style.notation.write(s) for s in zeros), Number(Integer(0))))
        lead = ("With ", zero, " the pose is")
    length = robot.units.length
    unit = f" (lengths in {length.value})" if length else ""
    return [Paragraph((*lead, f"{unit}:")), NamedMatrix((name,), rounded(numbers))]


def _reached(forward: ForwardKinematics, values: Mapping[Symbol, Expr]) -> NumericMatrix | None:
    """Return the numeric pose; None where the values make a length infinite or complex."""
    try:
        return pose(forward.robot, forward.start, forward.end, values)
    except UnsupportedError:
        return None


def rounded(numbers: NumericMatrix) -> Matrix:
    """Return a numeric matrix rounded for people."""
    return Matrix(tuple(tuple(Rounded(figures(x)) for x in row) for row in numbers))


def missing(forward: ForwardKinematics, known: Mapping[Symbol, Expr]) -> list[Symbol]:
    """Return the symbols without a value; the joint variables among them are taken as zero."""
    robot = forward.robot
    return in_name_order({*robot.variables, *robot.parameters} - set(known))
