"""Table -> the joint axes and the tool that it puts in space, in its home position."""

from __future__ import annotations

from sympy import Expr

from symdh.frames.placed import WORLD, PlacedFrame
from symdh.kinematics.chain import chain_word
from symdh.mechanism import ZERO, JointAxis, Mechanism, ToolFrame
from symdh.robot import Joint, Motion, Robot


def mechanism_of(robot: Robot) -> Mechanism:
    """Return the axes and the tool of a table, seen from its base, all joint variables zero.

    Rows without a variable become part of the links beside them.

    Parameters
    ----------
    robot : Robot

    Returns
    -------
    Mechanism
        Directions are those in which the joints move when their variables grow; z keeps the way
        that it has in the table.
    """
    joints = {joint.variable: joint for joint in robot.joints if joint.variable is not None}
    axes: list[JointAxis] = []
    frame = WORLD
    for motion in chain_word(robot, "base", "tool"):
        own = next((joints[s] for s in motion.amount.free_symbols if s in joints), None)
        if own is not None:
            axes.append(_axis(own, motion.amount, frame))
            motion = _at_home(motion, own)
        frame = frame.moved(motion)
    return Mechanism(
        name=robot.name,
        axes=tuple(axes),
        tool=ToolFrame(frame.origin, approach=frame.z, sliding=frame.columns[1]),
        convention=robot.convention,
        values=robot.values,
        limits=robot.limits,
        title=robot.title,
        units=robot.units,
    )


def _axis(joint: Joint, amount: Expr, frame: PlacedFrame) -> JointAxis:
    assert joint.variable is not None
    factor = amount.coeff(joint.variable)
    backwards = bool(factor < 0)
    direction = (-frame.z[0], -frame.z[1], -frame.z[2]) if backwards else frame.z
    return JointAxis(
        joint.type,
        frame.origin,
        direction,
        joint.variable,
        ratio=abs(factor),
        reverse=backwards,
    )


def _at_home(motion: Motion, joint: Joint) -> Motion:
    return Motion(motion.kind, motion.axis, motion.amount.xreplace({joint.variable: ZERO}))
