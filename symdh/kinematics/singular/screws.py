"""The columns of a Jacobian as polynomials, in the frame and at the point that make them sparse.

The determinant of a square Jacobian, and the rank of any, is the same for every frame whose axes
the components are along, and for every point of the last link whose velocity is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Expr

from symdh.kinematics.chain import chain_word
from symdh.kinematics.frame import Frame, place
from symdh.kinematics.singular.trig_ring import Element, TrigRing, Vector
from symdh.kinematics.velocity import axis_frame, joint_rate, moves
from symdh.motion import Word, translation
from symdh.robot import Axis, JointType, Robot

Column = tuple[Element, ...]


@dataclass(frozen=True)
class ScrewMatrix:
    """A Jacobian in the ring.

    Attributes
    ----------
    columns : tuple of Column
        Six elements each: v_x v_y v_z omega_x omega_y omega_z.
    frame : int
        The frame whose axes the components are along.
    point : Frame or None
        The frame whose origin, moving with the last link, the velocity is of; None for the point
        that was asked for.
    """

    columns: tuple[Column, ...]
    frame: int
    point: Frame | None


def sparsest(ring: TrigRing, robot: Robot, of: Frame, at: Sequence[Expr] | None) -> ScrewMatrix:
    """Return the Jacobian of frame `of` with the fewest terms.

    Parameters
    ----------
    at : three Expr or None
        The point, in frame `of`; None when the choice is free.
    """
    joints = moving_joints(robot, of)
    last = min(place(robot, of), robot.n)
    points: dict[Frame | None, Frame | Sequence[Expr]] = (
        {frame: frame for frame in range(last + 1)} if at is None else {None: at}
    )
    levers = {
        name: [lever(ring, robot, i, of, point) for i in joints] for name, point in points.items()
    }
    # In a long arm only frames in the middle can be sparse, and the others take long to work out.
    frames = range(last + 1) if len(joints) <= 6 else range(last // 2 - 1, last // 2 + 2)
    # Short levers make few terms in any frame, so only the best points are tried in all of them.
    promising = sorted(points, key=lambda point: _cost([arm[:2] for arm in levers[point]]))[:2]
    matrices = (
        ScrewMatrix(
            tuple(
                _column(ring, robot, i, frame, arm)
                for i, arm in zip(joints, levers[point], strict=True)
            ),
            frame,
            point,
        )
        for point in promising
        for frame in frames
    )
    return min(matrices, key=lambda matrix: _cost(matrix.columns))


def moving_joints(robot: Robot, of: Frame) -> list[int]:
    """Return the rows of the joints that move a frame."""
    joints = enumerate(robot.joints, start=1)
    return [i for i, joint in joints if joint.variable is not None and moves(robot, i, of)]


def lever(ring: TrigRing, robot: Robot, i: int, of: Frame, point: Frame | Sequence[Expr]) -> Vector:
    """Return a point in the axis frame of joint `i`: the origin of a frame, or a point of `of`."""
    start = axis_frame(robot, i)
    if point == "base" or point == "tool" or isinstance(point, int):
        word = chain_word(robot, start, point)
    else:
        word = chain_word(robot, start, of) + _offset(point)
    zero = ring.constant(0)
    return ring.carried(word, (zero, zero, zero))


def direction(ring: TrigRing, robot: Robot, i: int, frame: Frame) -> Vector:
    """Return the axis of joint `i` in a frame."""
    zero, one = ring.constant(0), ring.constant(1)
    return ring.oriented(chain_word(robot, frame, axis_frame(robot, i)), (zero, zero, one))


def _column(ring: TrigRing, robot: Robot, i: int, frame: int, arm: Vector) -> Column:
    joint = robot.joints[i - 1]
    rate = ring.read(joint_rate(joint))
    zero = ring.constant(0)
    axis = tuple(rate * x for x in direction(ring, robot, i, frame))
    if joint.type is JointType.PRISMATIC:
        return (*axis, zero, zero, zero)
    word = chain_word(robot, frame, axis_frame(robot, i))
    linear = ring.oriented(word, (-rate * arm[1], rate * arm[0], zero))
    return (*linear, *axis)


def _cost(columns: Sequence[Column]) -> tuple[int, int]:
    """Count the entries that are not zero, then all terms."""
    entries = [entry for column in columns for entry in column if entry]
    return len(entries), sum(len(entry) for entry in entries)


def _offset(point: Sequence[Expr]) -> Word:
    return tuple(translation(axis, point[axis]) for axis in Axis)
