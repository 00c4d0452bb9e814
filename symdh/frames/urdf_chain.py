"""A serial chain of URDF joints -> joint axes in space -> a table.

URDF puts a frame anywhere on a link; Denavit-Hartenberg rows need frames on the common normals. So
the axes are located in the home position, all joints at zero, and frames are assigned to them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from sympy import Expr, Float, ImmutableMatrix, Integer, Matrix, Rational, Symbol, expand, eye, pi
from sympy import sqrt as root

from symdh.frames.assign import assign_frames
from symdh.frames.settle import Snap
from symdh.mechanism import JointAxis, Mechanism, ToolFrame, Vector
from symdh.motion import Word, elementary, rotation, transform, translation
from symdh.robot import (
    AngleUnit,
    Axis,
    Convention,
    Joint,
    JointType,
    LengthUnit,
    Motion,
    Robot,
    Units,
)
from symdh.table.labels import default_name
from symdh.table.urdf import Placement, UrdfChain, UrdfJoint, UrdfJointType

PLACES = 15
"""Decimal places of a parameter that is neither a rational number nor a simple part of pi."""

FINEST = Rational(1, 10**8)
"""Axes nearer than this to parallel always count as such, whatever the tolerance.

Frames of axes at an angle e are some L/e away; in a table of 15 digits that costs 1e-15 L/e, more
than the e L that the angle is worth.
"""

_DIGITS = 50
#: Steps of a quaternion's components: the rotation is off by less than a double could tell.
_STEPS = Integer(10) ** 17
#: The cosine and sine of these parts of pi are short roots; exact geometry stays cheap with them.
_STEPS_OF_PI = 12
_TYPES = {
    UrdfJointType.REVOLUTE: JointType.REVOLUTE,
    UrdfJointType.CONTINUOUS: JointType.REVOLUTE,
    UrdfJointType.PRISMATIC: JointType.PRISMATIC,
}


@dataclass(frozen=True, slots=True)
class ImportedChain:
    """The table of a chain.

    Attributes
    ----------
    robot : Robot
        Metres and degrees; all parameters are numbers.
    joint_names : tuple of str
        What the file calls the joints that move, in the order of the rows.
    snaps : tuple of Snap
        What counts as parallel or as meeting without being quite so.
    """

    robot: Robot
    joint_names: tuple[str, ...]
    snaps: tuple[Snap, ...]


def table_of_chain(chain: UrdfChain, convention: Convention, tolerance: Expr) -> ImportedChain:
    """Return the table of a chain, with the base and tool words that make the pose equal.

    Parameters
    ----------
    chain : UrdfChain
    convention : Convention
    tolerance : Expr
        What is nearer than this to parallel or to meeting counts as such, `FINEST` at least; see
        `symdh.mechanism.TOLERANCE`.

    Returns
    -------
    ImportedChain

    Raises
    ------
    AssignmentError
        When no frames can be assigned.
    """
    found = assign_frames(mechanism_of_chain(chain, tolerance), convention)
    robot = found.robot
    joints = tuple(_in_numbers(joint) for joint in robot.joints)
    base, tool = (tuple(map(_motion_in_numbers, word)) for word in (robot.base, robot.tool))
    names = (joint.name for joint in _moving(chain))
    robot = replace(robot, joints=joints, base=base, tool=tool)
    return ImportedChain(robot, tuple(names), found.snaps)


def mechanism_of_chain(chain: UrdfChain, tolerance: Expr) -> Mechanism:
    """Return the joint axes and the tip of a chain in the home position, all joints at zero."""
    moving = _moving(chain)
    variables = tuple(_variable(place, joint) for place, joint in enumerate(moving, start=1))
    poses = _home_poses(chain)
    axes = (
        JointAxis(
            type=_TYPES[joint.type],
            point=_origin(pose),
            direction=_turned(pose, joint.meant.axis),
            variable=variable,
        )
        for joint, pose, variable in zip(
            moving,
            (
                pose
                for joint, pose in zip(chain.joints, poses, strict=True)
                if joint.type is not UrdfJointType.FIXED
            ),
            variables,
            strict=True,
        )
    )
    tip = poses[-1]
    limits = {
        variable: joint.limits
        for variable, joint in zip(variables, moving, strict=True)
        if joint.limits is not None
    }
    return Mechanism(
        name=default_name(f"{chain.name}.urdf"),
        axes=tuple(axes),
        tool=ToolFrame(_origin(tip), approach=_column(tip, 2), sliding=_column(tip, 1)),
        tolerance=max(tolerance, FINEST),
        limits=limits,
        title=_title(chain),
        units=Units(AngleUnit.DEGREE, LengthUnit.METRE),
    )


def origin_word(placement: Placement) -> Word:
    """Return the motions from a parent link to a joint: Txyz, then Rz(yaw) Ry(pitch) Rx(roll)."""
    slides = tuple(map(translation, Axis, placement.xyz))
    turns = tuple(map(rotation, Axis, placement.rpy))
    return slides + turns[::-1]


def _moving(chain: UrdfChain) -> list[UrdfJoint]:
    return [joint for joint in chain.joints if joint.type is not UrdfJointType.FIXED]


def _title(chain: UrdfChain) -> str:
    return f"{chain.name}: from {chain.start} to {chain.end}"[:200]


def _variable(place: int, joint: UrdfJoint) -> Symbol:
    letter = "d" if joint.type is UrdfJointType.PRISMATIC else "theta"
    return Symbol(f"{letter}{place}", real=True)


def _home_poses(chain: UrdfChain) -> list[ImmutableMatrix]:
    """Return the pose of each joint, fixed ones included, before it moves; all joints at zero.

    Exact while all angles are simple parts of pi; behind the first that is not, a rotation with
    rational entries that is nearer to the true one than a double could be, and still a rotation.
    """
    poses = []
    pose, exact = ImmutableMatrix(eye(4)), True
    for joint in chain.joints:
        word = origin_word(joint.meant)
        exact = exact and all(map(_is_simple, joint.meant.rpy))
        if exact:
            pose = (pose * transform(word)).applyfunc(expand)
            poses.append(pose)
        else:
            # Carried on with 50 digits; only what is handed out is made a rotation.
            for motion in word:
                pose = (pose * elementary(motion)).evalf(_DIGITS)
            poses.append(_rational_pose(pose))
    return poses


def _is_simple(angle: Expr) -> bool:
    part = angle / pi
    return bool(part.is_Rational) and _STEPS_OF_PI % int(part.q) == 0


def _rational_pose(pose: ImmutableMatrix) -> ImmutableMatrix:
    exact = Matrix(eye(4))
    exact[:3, :3] = _rotation_of(_quaternion(pose))
    for row in range(3):
        exact[row, 3] = _rounded(pose[row, 3])
    return ImmutableMatrix(exact)


def _quaternion(pose: ImmutableMatrix) -> list[Rational]:
    """Return the quaternion of a rotation, not normalised, on a fine grid.

    Shepperd (1978): the largest of the four components is taken from its root, the others by
    division.
    """
    trace = pose[0, 0] + pose[1, 1] + pose[2, 2]
    squares = [1 + trace, *(1 + 2 * pose[k, k] - trace for k in range(3))]
    k = max(range(4), key=lambda each: squares[each])
    off = {
        (0, 1): pose[2, 1] - pose[1, 2],
        (0, 2): pose[0, 2] - pose[2, 0],
        (0, 3): pose[1, 0] - pose[0, 1],
        (1, 2): pose[0, 1] + pose[1, 0],
        (1, 3): pose[0, 2] + pose[2, 0],
        (2, 3): pose[1, 2] + pose[2, 1],
    }
    largest = root(squares[k])
    found = [largest if i == k else off[min(i, k), max(i, k)] / largest for i in range(4)]
    return [Rational(round(component * _STEPS), _STEPS) for component in found]


def _rotation_of(quaternion: list[Rational]) -> Matrix:
    """Return the rotation matrix of a quaternion of any length; its entries are rational."""
    w, x, y, z = quaternion
    square = w * w + x * x + y * y + z * z
    return (
        Matrix(
            [
                [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
            ]
        )
        / square
    )


def _origin(pose: ImmutableMatrix) -> Vector:
    return _column(pose, 3)


def _column(pose: ImmutableMatrix, k: int) -> Vector:
    return pose[0, k], pose[1, k], pose[2, k]


def _turned(pose: ImmutableMatrix, vector: Vector) -> Vector:
    x, y, z = (
        expand(sum((pose[row, k] * vector[k] for k in range(3)), Integer(0))) for row in range(3)
    )
    return x, y, z


def _in_numbers(joint: Joint) -> Joint:
    return replace(
        joint,
        theta=_number(joint.theta),
        d=_number(joint.d),
        a=_number(joint.a),
        alpha=_number(joint.alpha),
    )


def _motion_in_numbers(motion: Motion) -> Motion:
    return replace(motion, amount=_number(motion.amount))


def _number(e: Expr) -> Expr:
    """Return an expression whose constant is a rational number or a simple part of pi.

    The file has decimals, so a root or an arc tangent of them says no more than a decimal.
    """
    constant, rest = e.as_independent(*e.free_symbols, as_Add=True)
    if not e.free_symbols:
        constant, rest = e, Integer(0)
    part = constant / pi
    if part.is_Rational and 360 % int(part.q) == 0:
        return e
    return rest + _rounded(constant.evalf(_DIGITS))


def _rounded(value: Float) -> Rational:
    scale = Integer(10) ** PLACES
    return Rational(round(value * scale), scale)
