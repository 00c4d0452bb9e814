"""Rotations: composing them, and the ways of describing one that is there."""

from __future__ import annotations

from symdh.kinematics.rotation.axis_angle import AxisAngle, axis_angle
from symdh.kinematics.rotation.composing import About, Composition, Step, Turned, compose
from symdh.kinematics.rotation.description import Description, describe
from symdh.kinematics.rotation.euler import (
    SEQUENCES,
    Atan2,
    EulerAngles,
    EulerSequence,
    degenerate_formula,
    euler_angles,
    euler_formulas,
    named_sequence,
)
from symdh.kinematics.rotation.matrix import (
    TOLERANCE,
    Rotation,
    check_family,
    nearest_rotation,
    numbers_of,
)
from symdh.kinematics.rotation.quaternion import Quaternion, quaternion
from symdh.kinematics.rotation.rates import inverse_rates, rates, rates_vanish
from symdh.kinematics.rotation.reading import read_off
from symdh.kinematics.rotation.result import RotationResult, of_arm, of_matrix, of_steps
from symdh.kinematics.rotation.stand_in import stand_in

__all__ = [
    "SEQUENCES",
    "TOLERANCE",
    "About",
    "Atan2",
    "AxisAngle",
    "Composition",
    "Description",
    "EulerAngles",
    "EulerSequence",
    "Quaternion",
    "Rotation",
    "RotationResult",
    "Step",
    "Turned",
    "axis_angle",
    "check_family",
    "compose",
    "degenerate_formula",
    "describe",
    "euler_angles",
    "euler_formulas",
    "inverse_rates",
    "named_sequence",
    "nearest_rotation",
    "numbers_of",
    "of_arm",
    "of_matrix",
    "of_steps",
    "quaternion",
    "rates",
    "rates_vanish",
    "read_off",
    "stand_in",
]
