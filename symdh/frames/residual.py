"""How far the pose of an imported table is from that of its URDF chain, in double precision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import asin, cos, hypot, pi, sin, sqrt

from symdh.frames.urdf_chain import origin_word
from symdh.motion import Word, rotation, translation
from symdh.robot import Axis, Convention, Joint, JointType, Motion, MotionKind, Robot
from symdh.table.urdf import UrdfChain, UrdfJointType

POSES = 100

#: Half the range of a joint variable in the poses that are compared: radians, metres.
_REACH = {JointType.REVOLUTE: pi, JointType.PRISMATIC: 0.5}
#: The fractional parts of the multiples of this fill the unit interval evenly.
_GOLDEN = (sqrt(5) - 1) / 2

Matrix = list[list[float]]
Triple = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class _Step:
    """A rotation about, or a slide along, a unit vector by ``constant + factor q[place]``."""

    turns: bool
    axis: Triple
    constant: float
    factor: float
    place: int


@dataclass(frozen=True, slots=True)
class Residual:
    """The largest difference between two poses, over many values of the joint variables.

    Attributes
    ----------
    position : float
        Metres.
    rotation : float
        Radians.
    poses : int
        How many were compared.
    """

    position: float
    rotation: float
    poses: int


def residual(chain: UrdfChain, robot: Robot, poses: int = POSES) -> Residual:
    """Compare an imported table with the decimals of its file, each taken at its word.

    Parameters
    ----------
    chain : UrdfChain
    robot : Robot
        With numbers for all parameters, in metres.
    poses : int
        The first of them is the home position.
    """
    types = [joint.type for joint in robot.joints if joint.variable is not None]
    left, right = _steps_of_chain(chain), _steps_of_robot(robot)
    differences = [
        _difference(_pose(left, q), _pose(right, q)) for q in _joint_values(types, poses)
    ]
    return Residual(
        max(position for position, _ in differences),
        max(turn for _, turn in differences),
        poses,
    )


def _joint_values(types: Sequence[JointType], poses: int) -> Iterator[list[float]]:
    """Yield values that fill the range of each joint, the same ones every time."""
    for number in range(poses):
        yield [
            _REACH[kind] * (2 * ((number * _GOLDEN ** (place + 1) + 0.5) % 1) - 1)
            for place, kind in enumerate(types)
        ]


def _steps_of_chain(chain: UrdfChain) -> list[_Step]:
    """Return the motions of a chain, each joint about or along its axis brought to length 1."""
    steps = []
    place = 0
    for joint in chain.joints:
        steps += [_constant(motion) for motion in origin_word(joint.written)]
        if joint.type is not UrdfJointType.FIXED:
            x, y, z = (float(entry) for entry in joint.written.axis)
            size = hypot(x, y, z)
            turns = joint.type is not UrdfJointType.PRISMATIC
            steps.append(_Step(turns, (x / size, y / size, z / size), 0.0, 1.0, place))
            place += 1
    return steps


def _steps_of_robot(robot: Robot) -> list[_Step]:
    word = robot.base
    for joint in robot.joints:
        word += _link_word(joint, robot.convention)
    places = {variable: place for place, variable in enumerate(robot.variables)}
    steps = []
    for motion in word + robot.tool:
        variables = motion.amount.free_symbols
        if not variables:
            steps.append(_constant(motion))
            continue
        (variable,) = variables
        factor = motion.amount.coeff(variable)
        still = _constant(replace(motion, amount=motion.amount - factor * variable))
        steps.append(replace(still, factor=float(factor), place=places[variable]))
    return steps


def _constant(motion: Motion) -> _Step:
    axis = (float(motion.axis == 0), float(motion.axis == 1), float(motion.axis == 2))
    return _Step(motion.kind is MotionKind.ROTATION, axis, float(motion.amount), 0.0, 0)


def _pose(steps: Sequence[_Step], q: Sequence[float]) -> Matrix:
    pose = _identity()
    for step in steps:
        amount = step.constant + step.factor * q[step.place]
        if amount:
            pose = _times(pose, (_turn if step.turns else _slide)(step.axis, amount))
    return pose


def _link_word(joint: Joint, convention: Convention) -> Word:
    along_z = (rotation(Axis.Z, joint.theta), translation(Axis.Z, joint.d))
    along_x = (translation(Axis.X, joint.a), rotation(Axis.X, joint.alpha))
    return along_z + along_x if convention is Convention.STANDARD else along_x + along_z


def _difference(left: Matrix, right: Matrix) -> tuple[float, float]:
    """Return the distance of two origins, and the angle between two orientations."""
    position = hypot(*(left[row][3] - right[row][3] for row in range(3)))
    # |A - B| of two rotations is sqrt(8) sin(angle / 2) in the Frobenius norm.
    chord = hypot(*(left[row][k] - right[row][k] for row in range(3) for k in range(3)))
    return position, 2 * asin(min(chord / sqrt(8), 1.0))


def _slide(axis: Triple, amount: float) -> Matrix:
    pose = _identity()
    for row in range(3):
        pose[row][3] = amount * axis[row]
    return pose


def _turn(axis: Triple, angle: float) -> Matrix:
    """Return the rotation about a unit vector (Rodrigues)."""
    c, s = cos(angle), sin(angle)
    x, y, z = axis
    cross = ((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0))
    pose = _identity()
    for row in range(3):
        for k in range(3):
            pose[row][k] = c * (row == k) + (1 - c) * axis[row] * axis[k] + s * cross[row][k]
    return pose


def _times(left: Matrix, right: Matrix) -> Matrix:
    return [
        [sum(left[row][j] * right[j][k] for j in range(4)) for k in range(4)] for row in range(4)
    ]


def _identity() -> Matrix:
    return [[float(row == k) for k in range(4)] for row in range(4)]
