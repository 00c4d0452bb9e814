"""All ways of saying one rotation in numbers."""

from __future__ import annotations

from dataclasses import dataclass

from symdh.kinematics.rotation.axis_angle import AxisAngle, axis_angle
from symdh.kinematics.rotation.euler import (
    SEQUENCES,
    EulerAngles,
    EulerSequence,
    euler_angles,
)
from symdh.kinematics.rotation.matrix import Rotation
from symdh.kinematics.rotation.quaternion import Quaternion, quaternion


@dataclass(frozen=True, slots=True)
class Description:
    """One rotation in numbers; angles in radians.

    Attributes
    ----------
    matrix : Rotation
        Its columns are the directions n, s, a.
    euler : tuple of EulerAngles
        Of all 12 sequences.
    axis_angle : AxisAngle
    quaternion : Quaternion
    """

    matrix: Rotation
    euler: tuple[EulerAngles, ...]
    axis_angle: AxisAngle
    quaternion: Quaternion

    def of(self, sequence: EulerSequence) -> EulerAngles:
        """Return the Euler angles of one sequence."""
        return next(each for each in self.euler if each.sequence == sequence)


def describe(matrix: Rotation) -> Description:
    """Extract everything from a rotation matrix that is orthonormal to rounding."""
    return Description(
        matrix,
        tuple(euler_angles(matrix, sequence) for sequence in SEQUENCES),
        axis_angle(matrix),
        quaternion(matrix),
    )
