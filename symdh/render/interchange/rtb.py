"""A table as Python source for the Robotics Toolbox: a function that returns a ``DHRobot``."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import ImmutableMatrix

from symdh._version import __version__
from symdh.codegen.fingerprint import fingerprint
from symdh.codegen.names import comment_text, file_stem, words
from symdh.errors import UnsupportedError
from symdh.kinematics.chain import link_word
from symdh.motion import Word
from symdh.render.interchange.exported import Exported
from symdh.render.interchange.numbers import (
    Numbers,
    number_literal,
    short,
    sign_and_offset,
    with_pi,
)
from symdh.robot import ZERO, Convention, Joint, JointType, Robot
from symdh.templating import render

#: Names that the source imports or uses itself.
_TAKEN = words("DHRobot SE3 PrismaticDH PrismaticMDH RevoluteDH RevoluteMDH links np pi robot")


@dataclass(frozen=True, slots=True)
class _Link:
    """One link: its class, and its keyword arguments as text."""

    kind: str
    arguments: str
    name: str


def rtb(robot: Robot) -> Exported:
    """Write a table as source for the Robotics Toolbox for Python.

    Raises
    ------
    UnsupportedError
        When a parameter has no value, a joint moves a multiple of its variable, or a fixed row
        stands between two joints, for which ``DHRobot`` has no link.
    """
    numbers = Numbers(robot)
    first, last = _moving_rows(robot)
    base = robot.base + _words(robot, 1, first)
    tool = _words(robot, last + 1, robot.n + 1) + robot.tool
    links = [_link(numbers, i, robot.joints[i - 1]) for i in range(first, last + 1)]
    name = comment_text(robot.name)
    stem = file_stem(robot.name)
    text = render(
        "interchange/rtb.py.jinja",
        name=name,
        function=f"{stem}_arm" if stem in _TAKEN else stem,
        needs_pi=any("pi" in link.arguments for link in links),
        version=__version__,
        table=fingerprint(robot)[:16],
        convention=robot.convention.value,
        kinds=sorted({link.kind for link in links}),
        links=links,
        base=_rows(numbers.matrix(base)) if base else None,
        tool=_rows(numbers.matrix(tool)) if tool else None,
    )
    return Exported(text, numbers.notes)


def _moving_rows(robot: Robot) -> tuple[int, int]:
    """Return the first and the last row that moves; the fixed ones outside go to base and tool."""
    moving = [i for i, joint in enumerate(robot.joints, start=1) if joint.variable is not None]
    if not moving:
        raise UnsupportedError(f"no joint of {robot.name} moves: there is no DHRobot to write")
    for i in range(moving[0], moving[-1]):
        if i not in moving:
            raise UnsupportedError(
                f"row {i} is fixed and stands between two joints; DHRobot has no such link"
            )
    return moving[0], moving[-1]


def _words(robot: Robot, start: int, stop: int) -> Word:
    return tuple(motion for i in range(start, stop) for motion in link_word(robot, i))


def _link(numbers: Numbers, row: int, joint: Joint) -> _Link:
    assert joint.variable is not None
    sign, offset = sign_and_offset(joint, row, "DHRobot")
    revolute = joint.type is JointType.REVOLUTE
    measured = {
        "d": number_literal(numbers.length(joint.d if revolute else ZERO)),
        "theta": with_pi(numbers.angle(ZERO if revolute else joint.theta)),
        "a": number_literal(numbers.length(joint.a)),
        "alpha": with_pi(numbers.angle(joint.alpha)),
        "offset": with_pi(numbers.angle(offset)) if revolute else short(numbers.length(offset)),
    }
    arguments = [f"{key}={text}" for key, text in measured.items() if text != "0"]
    if sign < 0:
        arguments.append("flip=True")
    limits = numbers.limits(joint)
    if limits is not None:
        write = with_pi if revolute else number_literal
        arguments.append(f"qlim=[{write(limits[0])}, {write(limits[1])}]")
    suffix = "DH" if numbers.robot.convention is Convention.STANDARD else "MDH"
    kind = ("Revolute" if revolute else "Prismatic") + suffix
    return _Link(kind, ", ".join(arguments), comment_text(joint.variable.name))


def _rows(pose: ImmutableMatrix) -> list[str]:
    return [", ".join(short(pose[row, k]) for k in range(4)) for row in range(4)]
