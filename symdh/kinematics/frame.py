"""The frames of an arm: base, 0 .. n, tool, in chain order."""

from __future__ import annotations

from typing import Literal

from symdh.errors import UnsupportedError
from symdh.robot import Robot

Frame = int | Literal["base", "tool"]


def frame_from_text(robot: Robot, text: str) -> Frame:
    """Read a frame as a user names it: ``base``, ``0`` .. ``n``, ``tool``.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    """
    word = text.strip().lower()
    if word == "base":
        return "base"
    if word == "tool":
        return "tool"
    if word.isascii() and word.isdigit() and len(word) < 6:
        return checked(robot, int(word))
    raise UnsupportedError(f"there is no frame {text!r}: {_choices(robot)}")


def checked(robot: Robot, frame: Frame) -> Frame:
    """Return the frame if the robot has it.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    """
    if frame in ("base", "tool"):
        return frame
    if isinstance(frame, int) and not isinstance(frame, bool) and 0 <= frame <= robot.n:
        return frame
    raise UnsupportedError(f"there is no frame {frame!r}: {_choices(robot)}")


def place(robot: Robot, frame: Frame) -> int:
    """Return the place of a frame in the chain: base -1, frame i at i, tool n + 1."""
    if frame == "base":
        return -1
    if frame == "tool":
        return robot.n + 1
    return int(frame)


def first_frame(robot: Robot) -> Frame:
    """Return where the whole chain starts: the base if the table has base words, else frame 0."""
    return "base" if robot.base else 0


def last_frame(robot: Robot) -> Frame:
    """Return where the whole chain ends: the tool if the table has tool words, else frame n."""
    return "tool" if robot.tool else robot.n


def _choices(robot: Robot) -> str:
    return f"{robot.name} has base, 0 to {robot.n}, tool"
