"""The domain model of a mechanism: joint axes and a tool in space, in the home position.

Lengths are exact numbers in the mechanism's length unit, angles are exact radians; symbols are
real, and lengths that are symbols count as positive where a direction follows from them. All
points and directions are in one frame, the world's, in which the table's base word starts.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType

from sympy import Expr, Integer, Rational, Symbol

from symdh.robot import Convention, JointType, Limits, Units

Vector = tuple[Expr, Expr, Expr]

#: A pose by its columns: x, y and z axis and the origin.
Pose = tuple[Vector, Vector, Vector, Vector]

ZERO, ONE = Integer(0), Integer(1)

#: What is nearer than this to parallel (in radians) or to meeting (as a part of the mechanism's
#: size) counts as parallel or meeting. A right angle typed as 1.5708 is off by 3.7e-6.
TOLERANCE = Rational(1, 100_000)


NO_UNITS = Units()


class Last(Enum):
    """Where the last frame of a standard table goes.

    ``TOOL``: to the tool, and an error where no Denavit-Hartenberg row reaches it; ``JOINT``: on
    the last joint axis, and a tool word leads on; ``AUTO``: to the tool where that can be.
    """

    TOOL = "tool"
    JOINT = "joint"
    AUTO = "auto"


@dataclass(frozen=True, slots=True)
class JointAxis:
    """A joint axis, located in the home position.

    Attributes
    ----------
    type : JointType
        Revolute or prismatic.
    point : Vector
        Any point of the axis; where a rule leaves an origin open, the origin.
    direction : Vector
        Unit vector: the joint turns about it, or slides along it, when its variable grows.
    variable : Symbol
    home : Expr
        The value of the variable in the home position.
    ratio : Expr
        How far the joint turns or slides for each unit of its variable; positive.
    reverse : bool
        Whether the frame's z axis points against `direction`.
    """

    type: JointType
    point: Vector
    direction: Vector
    variable: Symbol
    home: Expr = ZERO
    ratio: Expr = ONE
    reverse: bool = False


@dataclass(frozen=True, slots=True)
class ToolFrame:
    """The tool in the home position.

    Attributes
    ----------
    point : Vector
        The tip.
    approach, sliding : Vector or None
        Unit vectors: the way the tool approaches (z) and the way the gripper closes (y); the
        normal vector is sliding x approach (x). None, both of them, where only the tip matters.
    """

    point: Vector
    approach: Vector | None = None
    sliding: Vector | None = None


@dataclass(frozen=True, slots=True)
class FrameChoice:
    """What somebody chose for one frame where the rules leave it open.

    Attributes
    ----------
    reverse_x : bool
        Take x against the direction of the default.
    x : Vector or None
        The direction of x itself.
    origin : Vector or None
        A point that the common normal of parallel axes passes through, or the origin itself.
    """

    reverse_x: bool = False
    x: Vector | None = None
    origin: Vector | None = None


@dataclass(frozen=True)
class Mechanism:
    """Joint axes and a tool in the home position, and the choices that the rules leave open.

    Attributes
    ----------
    name : str
    axes : tuple of JointAxis
        From the base to the tool.
    tool : ToolFrame or None
    choices : mapping of int to FrameChoice
        By the number of the frame.
    last : Last
        Where frame n goes; of no effect in the modified convention, whose last frame is on the
        last joint.
    tolerance : Expr
        See `TOLERANCE`; 0 takes every number at its word.
    convention : Convention or None
        The one that the file asks for.
    poses : tuple of Pose
        Frames L_0 .. L_n in the home position, where they are given outright; points and
        directions of the axes are then read off them. Else empty.
    values, limits, title, units
        As in a `Robot`.
    """

    name: str
    axes: tuple[JointAxis, ...]
    tool: ToolFrame | None = None
    choices: Mapping[int, FrameChoice] = field(default_factory=dict)
    last: Last = Last.AUTO
    tolerance: Expr = TOLERANCE
    convention: Convention | None = None
    poses: tuple[Pose, ...] = ()
    values: Mapping[Symbol, Expr] = field(default_factory=dict)
    limits: Mapping[Symbol, Limits] = field(default_factory=dict)
    title: str | None = None
    units: Units = NO_UNITS

    def __post_init__(self) -> None:
        for name in ("choices", "values", "limits"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.axes)

    def choice(self, frame: int) -> FrameChoice:
        """Return what was chosen for a frame."""
        return self.choices.get(frame, NO_CHOICE)


NO_CHOICE = FrameChoice()
