"""Axis and angle of a rotation."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, sqrt

from symdh.kinematics.rotation.matrix import Rotation
from symdh.kinematics.rotation.quaternion import quaternion

#: Sine of half the angle below which there is no telling the axis.
_NO_AXIS = 1e-15
_HALF_TURN = 1e-15


@dataclass(frozen=True, slots=True)
class AxisAngle:
    """One rotation about one line.

    Attributes
    ----------
    angle : float
        Radians, in [0, pi].
    axis : tuple of 3 floats, or None
        Unit vector; None when the angle is zero, where any axis will do.
    either : bool
        Whether the angle is pi, where the axis and its opposite are equally right.
    """

    angle: float
    axis: tuple[float, float, float] | None
    either: bool


def axis_angle(rotation: Rotation) -> AxisAngle:
    """Return axis and angle of a rotation (Euler's theorem).

    By way of the quaternion, which is well determined also near 0 and pi, where the textbook's
    ``theta = arccos((trace - 1)/2)`` loses half of the digits.
    """
    whole = quaternion(rotation)
    sine = sqrt(sum(part * part for part in whole.vector))
    # At a half turn rounding may leave w below zero.
    angle = 2 * atan2(sine, abs(whole.w))
    if sine < _NO_AXIS:
        return AxisAngle(0.0, None, False)
    x, y, z = (part / sine for part in whole.vector)
    return AxisAngle(angle, (x, y, z), abs(whole.w) < _HALF_TURN)
