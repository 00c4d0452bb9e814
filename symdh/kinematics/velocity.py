"""Velocity: the geometric Jacobian, in the short forms that the pose comes in.

A joint's column is a derivative of the pose's own position: a turn by epsilon is put into the word
at the joint's axis and fuses with the angles that are there already, and the position is
differentiated with respect to epsilon at zero. So ``-a_2 s_{12}`` comes out by construction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Dummy, Expr, ImmutableMatrix, Integer

from symdh.errors import LimitError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.forward import CLOSED_FORM_LIMIT
from symdh.kinematics.frame import Frame, checked, first_frame, last_frame, place
from symdh.motion import Word, rotation, rotations, translation
from symdh.motion.matrices import Vector, orientation, position
from symdh.motion.size import closed_form_size
from symdh.robot import Axis, Convention, Joint, JointType, Robot

#: Joints past which no Jacobian is written out: its columns are as many as its longest sum has
#: terms, and nobody reads a matrix of thousands of them.
JOINT_LIMIT = 20

ORIGIN: Vector = (Integer(0), Integer(0), Integer(0))


@dataclass(frozen=True, slots=True)
class JacobianColumn:
    """What one joint variable contributes, and what it is made of.

    Attributes
    ----------
    row : int
        The joint's row in the table, from 1.
    joint : Joint
    axis_frame : Frame
        The frame whose z axis the joint moves about or along.
    moves : bool
        Whether the joint stands before the frame whose velocity is wanted; else all is zero.
    rate : Expr
        Derivative of theta or d by the variable: -1 for ``90 deg - q2``.
    axis : Vector
        Direction of the joint axis.
    lever : Vector
        From the origin of `axis_frame` to the point.
    linear, angular : Vector
        The upper and the lower half of the column, `rate` included.
    """

    row: int
    joint: Joint
    axis_frame: Frame
    moves: bool
    rate: Expr
    axis: Vector
    lever: Vector
    linear: Vector
    angular: Vector

    @property
    def cross_terms(self) -> tuple[tuple[Expr, Expr], ...]:
        """Both products in each component of ``rate * axis x lever``, nothing combined."""
        z, p = self.axis, self.lever
        pairs = ((1, 2), (2, 0), (0, 1))
        return tuple((self.rate * z[i] * p[j], -self.rate * z[j] * p[i]) for i, j in pairs)


@dataclass(frozen=True)
class GeometricJacobian:
    """The matrix that takes joint rates to the velocity of a point and of its frame.

    Attributes
    ----------
    robot : Robot
    of : Frame
        The frame that moves.
    at : Vector
        The point, fixed in that frame and given in it.
    in_ : Frame
        The frame whose axes the components are along.
    columns : tuple of JacobianColumn
        One for each joint variable, in chain order.
    """

    robot: Robot
    of: Frame
    at: Vector
    in_: Frame
    columns: tuple[JacobianColumn, ...]

    @property
    def matrix(self) -> ImmutableMatrix:
        """The 6 x m matrix, rows v_x v_y v_z omega_x omega_y omega_z."""
        stacked = [(*column.linear, *column.angular) for column in self.columns]
        return ImmutableMatrix(6, len(stacked), lambda r, c: stacked[c][r])


def jacobian(
    robot: Robot,
    of: Frame | None = None,
    at: Sequence[Expr] | None = None,
    in_: Frame | None = None,
) -> GeometricJacobian:
    """Return the geometric Jacobian of a point of a frame.

    Parameters
    ----------
    robot : Robot
    of : Frame, optional
        The frame that moves; by default the last, the tool's where there is one.
    at : three Expr, optional
        The point, in the coordinates of frame `of`; by default its origin.
    in_ : Frame, optional
        The frame in whose axes the components are given; by default the first. The velocities
        themselves are those against the base.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    LimitError
        When the closed form would pass `CLOSED_FORM_LIMIT`, or the joints are more than
        `JOINT_LIMIT`.

    Notes
    -----
    Columns: ``[z x (p - p_a); z]`` of a revolute joint and ``[z; 0]`` of a prismatic one, with
    a = i - 1 in a standard table (Spong) and a = i in a modified one (Craig).
    """
    end = last_frame(robot) if of is None else checked(robot, of)
    seen_from = first_frame(robot) if in_ is None else checked(robot, in_)
    point = ORIGIN if at is None else (at[0], at[1], at[2])
    moving = [(i, j) for i, j in enumerate(robot.joints, start=1) if j.variable is not None]
    if len(moving) > JOINT_LIMIT:
        raise LimitError(
            f"{robot.name} has {len(moving)} moving joints, over the limit of {JOINT_LIMIT} for a "
            "Jacobian that is written out; generated code (code) has no such limit"
        )
    columns = tuple(_column(robot, i, joint, end, point, seen_from) for i, joint in moving)
    return GeometricJacobian(robot, end, point, seen_from, columns)


def has_closed_jacobian(robot: Robot, of: Frame, in_: Frame) -> bool:
    """Say whether the Jacobian is small enough to be written out."""
    if len(robot.variables) > JOINT_LIMIT:
        return False
    words = (
        rotations(chain_word(robot, in_, axis_frame(robot, i)))
        + chain_word(robot, axis_frame(robot, i), of)
        for i, joint in enumerate(robot.joints, start=1)
        if joint.variable is not None and moves(robot, i, of)
    )
    return all(closed_form_size(word) <= CLOSED_FORM_LIMIT for word in words)


def axis_frame(robot: Robot, i: int) -> int:
    """Return the frame whose z axis is that of joint `i`."""
    return i - 1 if robot.convention is Convention.STANDARD else i


def moves(robot: Robot, i: int, frame: Frame) -> bool:
    """Say whether joint `i` moves a frame: it stands before it in the chain."""
    return i <= place(robot, frame)


def joint_rate(joint: Joint) -> Expr:
    """Return the derivative of a joint's theta or d by its variable, a rational number."""
    amount = joint.theta if joint.type is JointType.REVOLUTE else joint.d
    return amount.diff(joint.variable)


def _column(
    robot: Robot, i: int, joint: Joint, of: Frame, point: Vector, in_: Frame
) -> JacobianColumn:
    frame = axis_frame(robot, i)
    turned = rotations(chain_word(robot, in_, frame))
    rate = joint_rate(joint)
    if not moves(robot, i, of):
        _check_size(robot, turned)
        axis = orientation(turned)[2]
        return JacobianColumn(i, joint, frame, False, rate, axis, ORIGIN, ORIGIN, ORIGIN)
    rest = chain_word(robot, frame, of) + _point_word(point)
    _check_size(robot, turned + rest)
    axis, lever = orientation(turned)[2], position(turned + rest)
    if joint.type is JointType.PRISMATIC:
        return JacobianColumn(i, joint, frame, True, rate, axis, lever, _times(rate, axis), ORIGIN)
    linear = _times(rate, _derivative(turned, rest))
    return JacobianColumn(i, joint, frame, True, rate, axis, lever, linear, _times(rate, axis))


def _derivative(before: Word, after: Word) -> Vector:
    """Return the derivative of a position by the angle of a turn about z between two words."""
    angle = Dummy("epsilon", real=True)
    x, y, z = (
        component.diff(angle).xreplace({angle: Integer(0)})
        for component in position((*before, rotation(Axis.Z, angle), *after))
    )
    return x, y, z


def _point_word(point: Vector) -> Word:
    return tuple(translation(axis, point[axis]) for axis in Axis)


def _times(factor: Expr, vector: Vector) -> Vector:
    return factor * vector[0], factor * vector[1], factor * vector[2]


def _check_size(robot: Robot, word: Word) -> None:
    size = closed_form_size(word)
    if size > CLOSED_FORM_LIMIT:
        about = f"{size:,}" if size < 10**9 else f"10^{len(str(size)) - 1}"
        raise LimitError(
            f"a column of the Jacobian of {robot.name} would have about {about} operations, over "
            f"the limit of {CLOSED_FORM_LIMIT:,}; choose a frame nearer to the joints with --in, "
            "or take the generated code, which has no such limit"
        )
