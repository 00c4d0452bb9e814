"""What an arm can be asked for: task vectors and their components."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from sympy import Expr, ImmutableMatrix, Symbol

from symdh.kinematics.frame import Frame
from symdh.kinematics.rotation import (
    Atan2,
    EulerSequence,
    rates_vanish,
)
from symdh.robot import Axis, Robot


class Choice(Enum):
    """Why a task vector has the components that it has."""

    NAMED = "named"
    PARALLEL = "parallel"
    SLIDING = "sliding"
    WRIST = "wrist"
    TURNING = "turning"
    POSITION = "position"
    POSE = "pose"


@dataclass(frozen=True, slots=True)
class Coordinate:
    """One coordinate of the last frame's origin, seen from the first frame."""

    axis: Axis
    value: Expr


@dataclass(frozen=True, slots=True)
class Heading:
    """The angle about the one direction that all revolute axes share.

    Attributes
    ----------
    axis : Axis
        That direction, an axis of the first frame.
    angle : Expr
        Radians; a sum of joint variables.
    planar : bool
        Whether the arm moves in one plane: then the angle is called phi, else alpha_z.
    """

    axis: Axis
    angle: Expr
    planar: bool


@dataclass(frozen=True, slots=True)
class EulerAngle:
    """One of three Euler angles.

    Attributes
    ----------
    place : int
        0, 1 or 2.
    symbol : Symbol
        The letter that stands for it in the rate matrix.
    value : Expr or Atan2
        Radians, a sum of joint variables where it can be read off the arm, else a formula.
    """

    place: int
    symbol: Symbol
    value: Expr | Atan2


Component = Coordinate | Heading | EulerAngle


@dataclass(frozen=True)
class TaskVector:
    """What an arm is asked for, as a function of its joint variables.

    Attributes
    ----------
    robot : Robot
    start, end : Frame
        The pose of `end` in `start` is described.
    components : tuple of Component
    choice : Choice
    sequence : EulerSequence or None
        That of the Euler angles, where there are any.
    orientation : ImmutableMatrix
        The exact 3x3 rotation that the Euler angles describe.
    left_out : Heading or None
        An angle that the arm has too few joints to be asked for as well.
    """

    robot: Robot
    start: Frame
    end: Frame
    components: tuple[Component, ...]
    choice: Choice
    sequence: EulerSequence | None
    orientation: ImmutableMatrix
    left_out: Heading | None = None

    @cached_property
    def angles(self) -> tuple[EulerAngle, ...]:
        """The Euler angles, all three or none."""
        return tuple(c for c in self.components if isinstance(c, EulerAngle))

    @property
    def is_read_off(self) -> bool:
        """Whether the Euler angles are sums of joint variables."""
        return all(isinstance(angle.value, Expr) for angle in self.angles)

    @property
    def vanishing(self) -> Expr | None:
        """What is zero where the Euler angles are singular; None without Euler angles.

        By joint variables where the angles are read off, else by the letter of the second angle.
        """
        if self.sequence is None:
            return None
        second = self.angles[1]
        value = second.value if isinstance(second.value, Expr) else second.symbol
        return rates_vanish(self.sequence, value)
