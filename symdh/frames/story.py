"""What an assignment tells: every frame with the rules that placed it, and the measures."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

from sympy import Expr

from symdh.frames.geometry import Relation
from symdh.frames.placed import Measured, PlacedFrame, turned
from symdh.frames.settle import Snap
from symdh.mechanism import ZERO, Mechanism
from symdh.robot import Convention, Robot


class OriginRule(Enum):
    """Why an origin is where it is."""

    AXIS_POINT = auto()  # the point of the axis that was given
    FOOT = auto()  # where the common normal meets the axis
    MEETING = auto()  # where the axes meet
    THROUGH_PREVIOUS = auto()  # the normal of parallel axes through the origin before, or b_i
    SAME = auto()  # axes in line: nothing asks for a step
    LIKE_FIRST = auto()  # frame {0} of a modified table: that of frame {1} at zero
    NO_OFFSET = auto()  # the last frame: d is zero but for the variable
    TOOL = auto()  # the tip of the tool
    CHOSEN = auto()
    GIVEN = auto()  # the whole frame is


class XRule(Enum):
    """Why an x axis points as it does."""

    WORLD = auto()  # nothing asks: along the world's x, or as near as the base word gets
    COMMON_NORMAL = auto()  # from axis to axis
    PLANE_NORMAL = auto()  # axes that meet: z x z
    SAME = auto()  # axes in line: as before
    LIKE_FIRST = auto()
    NO_ANGLE = auto()  # the last frame: theta is zero but for the variable
    TOOL_NORMAL = auto()  # sliding x approach
    TOWARDS_TOOL = auto()  # from the last axis to the tip
    CHOSEN = auto()
    GIVEN = auto()


@dataclass(frozen=True, slots=True)
class Step:
    """How one frame came about.

    Attributes
    ----------
    frame : int
    relation : Relation or None
        Of the two axes that decide about x; None for frames at the ends.
    axes : (int, int) or None
        The numbers of those axes.
    origin_rule, x_rule : OriginRule, XRule
    reversed_x : bool
        Whether x was asked to point against its rule (for a free x: see `x_rule`).
    bare : PlacedFrame
        The frame as the axes place it.
    turn : Expr
        What the frame is then turned by about its z: the home angle of the first or the last
        joint of a modified table. Kept apart, it does not spoil the numbers of the base word.
    """

    frame: int
    relation: Relation | None
    axes: tuple[int, int] | None
    origin_rule: OriginRule
    x_rule: XRule
    reversed_x: bool
    bare: PlacedFrame
    turn: Expr = ZERO

    @property
    def placed(self) -> PlacedFrame:
        """The frame in the home position."""
        x = turned(self.bare.x, self.bare.z, self.turn)
        return PlacedFrame(self.bare.origin, x, self.bare.z)


@dataclass(frozen=True)
class Assignment:
    """A table, and how it came about.

    Attributes
    ----------
    mechanism : Mechanism
    convention : Convention
    robot : Robot
        The table, with base and tool words where the geometry needs them.
    steps : tuple of Step
        Frames 0 .. n.
    measured : tuple of Measured
        Rows 1 .. n, in the home position.
    snaps : tuple of Snap
    exact : bool
        Whether every number is exact; else they were rounded to 15 digits.
    """

    mechanism: Mechanism
    convention: Convention
    robot: Robot
    steps: tuple[Step, ...]
    measured: tuple[Measured, ...]
    snaps: tuple[Snap, ...]
    exact: bool

    @property
    def home(self) -> dict[Expr, Expr]:
        """The values of the joint variables in the home position."""
        return {axis.variable: axis.home for axis in self.mechanism.axes}
