"""Robot -> words: the one place where the two conventions differ."""

from __future__ import annotations

from symdh.kinematics.frame import Frame, checked, place
from symdh.motion import Word, inverse, rotation, translation
from symdh.robot import Axis, Convention, Joint, Robot


def link_word(robot: Robot, i: int) -> Word:
    """Return the four motions of row `i` (1 .. n), zero amounts included.

    Standard: ``Rz(theta) Tz(d) Tx(a) Rx(alpha)`` (Denavit & Hartenberg 1955, as Spong prints it).
    Modified: ``Rx(alpha) Tx(a) Rz(theta) Tz(d)`` (Craig).
    """
    joint = robot.joints[i - 1]
    if robot.convention is Convention.STANDARD:
        return _screw_z(joint) + _screw_x(joint)[::-1]
    return _screw_x(joint) + _screw_z(joint)


def chain_word(robot: Robot, start: Frame, end: Frame) -> Word:
    """Return the word from frame `start` to frame `end`, unfused.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    """
    first, last = place(robot, checked(robot, start)), place(robot, checked(robot, end))
    if first > last:
        return inverse(chain_word(robot, end, start))
    word: Word = ()
    for k in range(first, last):
        word += segment(robot, k)
    return word


def segment(robot: Robot, k: int) -> Word:
    """Return the word from place `k` to place `k + 1` of the chain (see `frame.place`)."""
    if k < 0:
        return robot.base
    if k == robot.n:
        return robot.tool
    return link_word(robot, k + 1)


def _screw_z(joint: Joint) -> Word:
    return rotation(Axis.Z, joint.theta), translation(Axis.Z, joint.d)


def _screw_x(joint: Joint) -> Word:
    return rotation(Axis.X, joint.alpha), translation(Axis.X, joint.a)
