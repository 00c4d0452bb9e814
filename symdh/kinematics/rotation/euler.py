"""The 12 sequences of Euler angles: formulas, angles from a matrix, and where they are singular.

A sequence ``ijk`` means ``R = R_i(first) R_j(second) R_k(third)``: rotations about the axes of the
moving body in this order, or about the fixed axes in the opposite order. With a repeated axis
(``zyz``) the angles are proper Euler angles, else Tait-Bryan angles; ``zyx`` is yaw, pitch, roll.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin
from typing import Any

from sympy import Expr, ImmutableMatrix, sqrt

from symdh.errors import UnsupportedError
from symdh.kinematics.rotation.matrix import Rotation
from symdh.robot import Axis

#: Sine (proper) or cosine (Tait-Bryan) of the second angle below which the two outer rotations are
#: about one line for all that double precision can tell.
DEGENERATE = 1e-13

_ALIASES = {"rpy": "zyx", "ypr": "zyx"}


@dataclass(frozen=True, slots=True)
class EulerSequence:
    """Three axes, no two neighbours alike."""

    first: Axis
    second: Axis
    third: Axis

    @property
    def axes(self) -> tuple[Axis, Axis, Axis]:
        """The axes in the order of the product."""
        return self.first, self.second, self.third

    @property
    def name(self) -> str:
        """The usual name: ``zyz``."""
        return "".join(axis.name.lower() for axis in self.axes)

    @property
    def proper(self) -> bool:
        """Whether the last axis is the first one again."""
        return self.first is self.third

    @property
    def other(self) -> Axis:
        """The coordinate axis that is neither the first nor the second."""
        return Axis(3 - self.first - self.second)

    @property
    def parity(self) -> int:
        """1 when first, second and `other` are x, y, z in cyclic order, else -1."""
        return 1 if (self.second - self.first) % 3 == 1 else -1

    def remaining_sign(self, second: float) -> int:
        """Return the sign s of ``first + s third``, all that is left at a singular second angle.

        There the third axis lies along the first or against it.
        """
        if self.proper:
            return 1 if cos(second) > 0 else -1
        return self.parity if sin(second) > 0 else -self.parity


def _all_sequences() -> tuple[EulerSequence, ...]:
    proper = [(i, j, i) for i in Axis for j in Axis if j is not i]
    different = [(i, j, Axis(3 - i - j)) for i in Axis for j in Axis if j is not i]
    return tuple(EulerSequence(*axes) for axes in (*proper, *different))


#: The proper ones first.
SEQUENCES = _all_sequences()


def named_sequence(name: str) -> EulerSequence:
    """Return the sequence of a name such as ``zyz``, in capitals or not; ``rpy`` is ``zyx``.

    Raises
    ------
    UnsupportedError
        When there is none.
    """
    word = name.strip().lower()
    word = _ALIASES.get(word, word)
    for sequence in SEQUENCES:
        if sequence.name == word:
            return sequence
    names = ", ".join(sequence.name for sequence in SEQUENCES)
    raise UnsupportedError(f"there is no sequence of Euler angles {name!r}: there are {names}")


@dataclass(frozen=True, slots=True)
class Atan2:
    """The angle ``atan2(y, x)``, not worked out: where both vanish it is free."""

    y: Expr
    x: Expr


def euler_formulas(matrix: ImmutableMatrix, sequence: EulerSequence) -> tuple[Atan2, Atan2, Atan2]:
    """Return the angles of a sequence by the entries of an exact rotation matrix.

    The solution with the second angle in [0, pi] (proper) or [-pi/2, pi/2] (Tait-Bryan); it holds
    where the sine or cosine of that angle is not zero (Craig, Introduction to Robotics, 2.8, prints
    those of zyx and zyz; the others follow by renaming the axes).
    """
    i, j, k, e = sequence.first, sequence.second, sequence.other, sequence.parity
    if sequence.proper:
        return (
            Atan2(matrix[j, i], -e * matrix[k, i]),
            Atan2(sqrt(matrix[i, j] ** 2 + matrix[i, k] ** 2), matrix[i, i]),
            Atan2(matrix[i, j], e * matrix[i, k]),
        )
    return (
        Atan2(-e * matrix[j, k], matrix[k, k]),
        Atan2(e * matrix[i, k], sqrt(matrix[i, i] ** 2 + matrix[i, j] ** 2)),
        Atan2(-e * matrix[i, j], matrix[i, i]),
    )


def degenerate_formula(matrix: Any, sequence: EulerSequence) -> Atan2:
    """Return the third angle where the second one is singular and the first is set to zero."""
    j, k, e = sequence.second, sequence.other, sequence.parity
    if sequence.proper:
        return Atan2(-e * matrix[j, k], matrix[j, j])
    return Atan2(e * matrix[j, sequence.first], matrix[j, j])


@dataclass(frozen=True, slots=True)
class EulerAngles:
    """The angles of one sequence, in radians.

    Attributes
    ----------
    sequence : EulerSequence
    first, second, third : float
        ``first`` and ``third`` in (-pi, pi]; ``second`` in [0, pi] for a proper sequence, else in
        [-pi/2, pi/2].
    margin : float
        Sine (proper) or cosine (Tait-Bryan) of the second angle: how far the singularity is.
    degenerate : bool
        Whether the outer rotations are about one line. Then `first` was set to zero, and `third`
        is what ``first + s third`` comes to, times s; see `EulerSequence.remaining_sign`.
    """

    sequence: EulerSequence
    first: float
    second: float
    third: float
    margin: float
    degenerate: bool

    @property
    def angles(self) -> tuple[float, float, float]:
        """The three angles in the order of the product."""
        return self.first, self.second, self.third

    @property
    def other(self) -> tuple[float, float, float]:
        """The other three angles that make the same rotation, in radians."""
        second = -self.second if self.sequence.proper else pi - self.second
        return _wrapped(self.first + pi), _wrapped(second), _wrapped(self.third + pi)


def euler_angles(rotation: Rotation, sequence: EulerSequence) -> EulerAngles:
    """Return the angles of a sequence that make a rotation.

    The third angle is taken from what is left once the first is undone, not from its own formula:
    near a singularity the first angle is blurred, and so the third makes up for it, and the three
    together give the matrix back to rounding.

    Parameters
    ----------
    rotation : Rotation
        Orthonormal to rounding; see `nearest_rotation`.
    sequence : EulerSequence
    """
    i, j, k, e = sequence.first, sequence.second, sequence.other, sequence.parity
    if sequence.proper:
        y, x, along = rotation[j][i], -e * rotation[k][i], rotation[i][i]
    else:
        y, x, along = -e * rotation[j][k], rotation[k][k], e * rotation[i][k]
    margin = hypot(y, x)
    degenerate = margin < DEGENERATE
    first = 0.0 if degenerate else _atan2(y, x)
    second = _atan2(margin, along) if sequence.proper else _atan2(along, margin)
    # Row j of R_i(-first) R, which the second rotation leaves alone.
    row = [cos(first) * rotation[j][c] + e * sin(first) * rotation[k][c] for c in range(3)]
    third = _atan2(-e * row[k], row[j]) if sequence.proper else _atan2(e * row[i], row[j])
    return EulerAngles(sequence, first, second, third, margin, degenerate)


def _atan2(y: float, x: float) -> float:
    # A negative zero would make -pi of pi.
    return atan2(y + 0.0, x + 0.0)


def _wrapped(angle: float) -> float:
    if angle > pi:
        return angle - 2 * pi
    return angle + 2 * pi if angle <= -pi else angle
