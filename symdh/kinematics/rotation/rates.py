"""The rates of Euler angles and the angular velocity that they make: omega = B phi'."""

from __future__ import annotations

from sympy import Expr, ImmutableMatrix, Integer, cos, sin

from symdh.kinematics.rotation.euler import EulerSequence
from symdh.motion.matrices import Vector, rotate
from symdh.robot import Axis


def rates(sequence: EulerSequence, first: Expr, second: Expr) -> ImmutableMatrix:
    """Return B, the 3x3 matrix that makes an angular velocity of the rates of Euler angles.

    Its columns are the three axes of rotation where the rotations before have put them:
    ``e_i``, ``R_i(first) e_j`` and ``R_i(first) R_j(second) e_k``, all in the fixed frame
    (Siciliano et al., Robotics, 3.6).
    """
    i, j, k = sequence.axes
    columns = (
        _unit(i),
        rotate(i, first, _unit(j)),
        rotate(i, first, rotate(j, second, _unit(k))),
    )
    return ImmutableMatrix([[column[row] for column in columns] for row in range(3)])


def inverse_rates(sequence: EulerSequence, first: Expr, second: Expr) -> ImmutableMatrix:
    """Return the inverse of B, in closed form.

    Seen from the frame that the first rotation has reached, the first two axes are coordinate
    axes and the third one has no component along the second; so the equations are solved one by
    one. It exists where `rates_vanish` is not zero.
    """
    i, j, e = sequence.first, sequence.second, sequence.parity
    along, across = _unit(i), rotate(i, first, _unit(sequence.other))
    if sequence.proper:
        third = [-e * component / sin(second) for component in across]
        share = cos(second)
    else:
        third = [component / cos(second) for component in across]
        share = e * sin(second)
    rows = (
        [a - share * t for a, t in zip(along, third, strict=True)],
        rotate(i, first, _unit(j)),
        third,
    )
    return ImmutableMatrix(rows)


def rates_vanish(sequence: EulerSequence, second: Expr) -> Expr:
    """Return what B is singular with: the sine (proper) or cosine of the second angle."""
    return sin(second) if sequence.proper else cos(second)


def _unit(axis: Axis) -> Vector:
    x, y, z = (Integer(int(axis is each)) for each in Axis)
    return x, y, z
