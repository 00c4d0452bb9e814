"""The unit quaternion of a rotation."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from symdh.kinematics.rotation.matrix import Rotation


@dataclass(frozen=True, slots=True)
class Quaternion:
    """``w + x i + y j + z k`` of unit length; its negative means the same rotation."""

    w: float
    x: float
    y: float
    z: float

    @property
    def vector(self) -> tuple[float, float, float]:
        """The part x, y, z: the axis times the sine of half the angle."""
        return self.x, self.y, self.z


def quaternion(rotation: Rotation) -> Quaternion:
    """Return the unit quaternion of a rotation, w first.

    Of the two that there are, the one with w > 0; where w is zero, the one whose first component
    that is not zero is positive. The largest component is found first and divides the others, so
    no digits are lost at any angle (Shepperd, J. Guidance and Control 1, 1978).

    Parameters
    ----------
    rotation : Rotation
        Orthonormal to rounding.
    """
    (r11, r12, r13), (r21, r22, r23), (r31, r32, r33) = rotation
    # Four times the products of two components, by rows; the diagonal is never negative.
    products = (
        (1 + r11 + r22 + r33, r32 - r23, r13 - r31, r21 - r12),
        (r32 - r23, 1 + r11 - r22 - r33, r12 + r21, r13 + r31),
        (r13 - r31, r12 + r21, 1 - r11 + r22 - r33, r23 + r32),
        (r21 - r12, r13 + r31, r23 + r32, 1 - r11 - r22 + r33),
    )
    largest = max(range(4), key=lambda k: products[k][k])
    row = products[largest]
    length = sqrt(sum(entry * entry for entry in row))
    parts = [entry / length for entry in row]
    leading = next(part for part in parts if abs(part) > 1e-15)
    sign = -1.0 if leading < 0 else 1.0
    w, x, y, z = (sign * part + 0.0 for part in parts)
    return Quaternion(w, x, y, z)
