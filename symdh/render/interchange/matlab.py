"""A table as a MATLAB function that builds a ``rigidBodyTree`` (Robotics System Toolbox).

``setFixedTransform(joint, [a alpha d theta], "dh")`` and ``"mdh"`` ignore the parameter that the
joint moves, so an offset has no place there, and neither has a joint that moves against its
variable. Both become rows of their own: an offset is a fixed body before the joint, and a motion
turned round is Rz(-q) = Rx(pi) Rz(q) Rx(-pi), Tz(-q) likewise.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sympy import Expr, pi

from symdh._version import __version__
from symdh.codegen.fingerprint import fingerprint
from symdh.codegen.names import comment_text, file_stem, words
from symdh.motion import Word, rotation
from symdh.render.interchange.exported import Exported
from symdh.render.interchange.numbers import (
    Numbers,
    number_literal,
    short,
    sign_and_offset,
    with_pi,
)
from symdh.robot import ZERO, Axis, Convention, Joint, JointType, Robot
from symdh.templating import render

_KEYWORDS = words(
    """
    break case catch classdef continue else elseif end for function global if otherwise parfor
    persistent return spmd switch try while robot body joint pi
    """
)


@dataclass(frozen=True, slots=True)
class Row:
    """A row whose variable, if it has one, stands alone: no offset and no sign.

    Attributes
    ----------
    type : JointType
    a, alpha, d, theta : Expr
        The one that the joint moves is 0.
    joint : Joint or None
        The joint of the table that it moves; None for a fixed row.
    """

    type: JointType
    a: Expr
    alpha: Expr
    d: Expr
    theta: Expr
    joint: Joint | None = None


@dataclass(frozen=True, slots=True)
class _Body:
    """A rigid body as text: how it hangs on the one before."""

    name: str
    joint: str
    type: str
    parent: str
    transform: str
    limits: str | None


def matlab(robot: Robot) -> Exported:
    """Write a table as a MATLAB function.

    Raises
    ------
    UnsupportedError
        When a parameter has no value, or a joint moves a multiple of its variable.
    """
    numbers = Numbers(robot)
    rows, left = plain_rows(robot)
    name = comment_text(robot.name)
    stem = file_stem(robot.name)
    text = render(
        "interchange/rigid_body_tree.m.jinja",
        name=name,
        function=f"{stem}_arm" if stem in _KEYWORDS else stem,
        version=__version__,
        table=fingerprint(robot)[:16],
        convention=robot.convention.value,
        order=", ".join(comment_text(variable.name) for variable in robot.variables),
        bodies=list(_bodies(numbers, rows, left + robot.tool)),
    )
    return Exported(text, numbers.notes)


def plain_rows(robot: Robot) -> tuple[list[Row], Word]:
    """Return rows without offsets and signs, and the motion that is left behind the last one."""
    if robot.convention is Convention.STANDARD:
        return [row for i, _ in _numbered(robot) for row in _standard(robot, i)], ()
    rows: list[Row] = []
    pending = ZERO  # the Rx(-pi) that a joint turned round leaves for the next row
    for i, joint in _numbered(robot):
        made, pending = _modified(joint, i, joint.alpha + pending)
        rows += made
    return rows, (rotation(Axis.X, pending),) if pending != 0 else ()


def _numbered(robot: Robot) -> Iterator[tuple[int, Joint]]:
    return enumerate(robot.joints, start=1)


def _standard(robot: Robot, i: int) -> Iterator[Row]:
    """Yield Rz(c) Rz(q) .. as two rows, Rz(c) Rz(-q) .. as Rz(c) Rx(pi), Rz(q) .. Rx(-pi)."""
    joint = robot.joints[i - 1]
    if joint.variable is None:
        yield Row(joint.type, joint.a, joint.alpha, joint.d, joint.theta)
        return
    sign, offset = sign_and_offset(joint, i, "rigidBodyTree")
    twist = ZERO if sign > 0 else pi
    revolute = joint.type is JointType.REVOLUTE
    if offset != 0 or twist != 0:
        theta, d = (offset, ZERO) if revolute else (ZERO, offset)
        yield Row(JointType.FIXED, ZERO, twist, d, theta)
    d = sign * joint.d if revolute else ZERO
    theta = ZERO if revolute else sign * joint.theta
    yield Row(joint.type, joint.a, joint.alpha - twist, d, theta, joint)


def _modified(joint: Joint, i: int, alpha: Expr) -> tuple[list[Row], Expr]:
    """Return the rows of one row, and the angle of the Rx that is left behind them."""
    if joint.variable is None:
        return [Row(joint.type, joint.a, alpha, joint.d, joint.theta)], ZERO
    sign, offset = sign_and_offset(joint, i, "rigidBodyTree")
    twist = ZERO if sign > 0 else pi
    revolute = joint.type is JointType.REVOLUTE
    before: list[Row] = []
    a, d = joint.a, joint.d if revolute else ZERO
    theta = ZERO if revolute else joint.theta
    if offset != 0:
        fixed = (ZERO, offset) if revolute else (offset, theta)
        before = [Row(JointType.FIXED, a, alpha, *fixed)]
        a, alpha, theta = ZERO, ZERO, ZERO
    row = Row(joint.type, a, alpha + twist, sign * d, sign * theta, joint)
    return [*before, row], -twist


def _bodies(numbers: Numbers, rows: list[Row], tool: Word) -> Iterator[_Body]:
    taken = {variable.name for variable in numbers.robot.variables}
    form = '"dh"' if numbers.robot.convention is Convention.STANDARD else '"mdh"'
    parent = "base"
    if numbers.robot.base:
        yield _fixed("frame0", parent, numbers, numbers.robot.base, taken)
        parent = "frame0"
    for number, row in enumerate(rows, start=1):
        body = f"body{number}"
        variable = row.joint.variable if row.joint else None
        yield _Body(
            name=body,
            joint=comment_text(variable.name) if variable else _free(f"fixed{number}", taken),
            type=row.type.value,
            parent=parent,
            transform=f"[{_parameters(numbers, row)}], {form}",
            limits=_limits(numbers, row),
        )
        parent = body
    if tool:
        yield _fixed("tool", parent, numbers, tool, taken)


def _free(name: str, taken: set[str]) -> str:
    """Return a name for a fixed joint that no variable has."""
    while name in taken:
        name += "_"
    return name


def _fixed(name: str, parent: str, numbers: Numbers, word: Word, taken: set[str]) -> _Body:
    pose = numbers.matrix(word)
    rows = (" ".join(short(pose[row, k]) for k in range(4)) for row in range(4))
    return _Body(name, _free(f"to_{name}", taken), "fixed", parent, f"[{'; '.join(rows)}]", None)


def _parameters(numbers: Numbers, row: Row) -> str:
    return " ".join(
        (
            number_literal(numbers.length(row.a)),
            with_pi(numbers.angle(row.alpha)),
            number_literal(numbers.length(row.d)),
            with_pi(numbers.angle(row.theta)),
        )
    )


def _limits(numbers: Numbers, row: Row) -> str | None:
    limits = numbers.limits(row.joint) if row.joint else None
    if limits is None:
        return None
    write = with_pi if row.type is JointType.REVOLUTE else number_literal
    return f"[{write(limits[0])} {write(limits[1])}]"
