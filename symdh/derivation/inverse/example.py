"""The numbers of one solution, put in step by step."""

from __future__ import annotations

from itertools import groupby
from math import pi, remainder

from sympy import Expr, Float, Symbol

from symdh.derivation.attitude import rounded_angle
from symdh.derivation.blocks import Block, Chapter, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.names import Worked, Writer
from symdh.derivation.inverse.numbers import Solved
from symdh.kinematics.frame import Frame
from symdh.kinematics.numeric import pose
from symdh.notation.nodes import Node, Rounded
from symdh.notation.numbers import figures

_DIGITS = 20
#: Beside numbers of an arm's size this is zero, whose digits have cancelled.
_CANCELLED = 5e-15


def example(writer: Writer, solved: Solved) -> Chapter:
    """Return the chapter that works out the first solution of a goal.

    Parameters
    ----------
    writer : Writer
        That has written the steps.
    solved : Solved
        With at least one answer.
    """
    known = _numbers(writer, solved)
    blocks: list[Block] = [
        Paragraph(("The first of these solutions, with what the steps find on the way.",)),
        *_parameters(writer, known),
    ]
    for title, parts in groupby(writer.worked, key=lambda each: each.title):
        rows = tuple(EntryStep(part.name, (_value(writer, part, known),), None) for part in parts)
        lead = f"{title[0].upper()}{title[1:]}:" if title else "What is given:"
        blocks += [Paragraph((lead,)), EntrySteps(rows)]
    return Chapter("An example", tuple(blocks))


def _parameters(writer: Writer, known: dict[Symbol, Expr]) -> list[Block]:
    """Give the lengths and angles of the arm."""
    style, robot = writer.style, writer.form.arm.robot
    rows = tuple(
        EntryStep(style.notation.write(symbol), (style.figures.write(known[symbol]),), None)
        for symbol in robot.parameters
        if symbol in known
    )
    return [Paragraph(("The arm has",)), EntrySteps(rows)] if rows else []


def _value(writer: Writer, part: Worked, known: dict[Symbol, Expr]) -> Node:
    """Return the number of a part, and keep it for those that come after."""
    number = part.expression.xreplace(known).evalf(_DIGITS)
    if part.symbol is not None:
        known[part.symbol] = number
    value = float(number)
    if part.turns:
        value = remainder(value, 2 * pi)
    value = 0.0 if abs(value) < _CANCELLED else value
    return rounded_angle(writer.style, value) if part.turns else Rounded(figures(value))


def _numbers(writer: Writer, solved: Solved) -> dict[Symbol, Expr]:
    """Return the numbers of parameters, joints and entries of the goal without its ends."""
    arm = writer.form.arm
    numbers = {s: v for s, v in arm.given.values.items() if s in arm.given.parameters}
    numbers |= solved.values
    numbers |= {letter: meaning.xreplace(numbers) for letter, meaning in arm.meanings.items()}
    pairs = zip(arm.given.variables, solved.answers[0].q, strict=True)
    numbers |= {variable: Float(q, 17) for variable, q in pairs}
    first: Frame = "base" if arm.base_inside else 0
    last: Frame = "tool" if arm.tool_inside else arm.given.n
    reached = pose(arm.given, first, last, numbers)
    for r in range(3):
        for c in range(3):
            numbers[Symbol(f"r_{r + 1}{c + 1}", real=True)] = Float(reached[r][c], 17)
        numbers[Symbol(f"p_{'xyz'[r]}", real=True)] = Float(reached[r][3], 17)
    return numbers
