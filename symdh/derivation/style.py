"""How the transforms of one document are named, and in which order they are multiplied."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from symdh.kinematics.frame import Frame
from symdh.motion import Word
from symdh.notation import Notation
from symdh.notation.nodes import Generic, Node, Operator, PoseName
from symdh.robot import Convention, Motion, MotionKind, Robot


class Order(Enum):
    """From which end the links are multiplied."""

    RIGHT = "right"
    LEFT = "left"


class Naming(Enum):
    """How a pose is written; AUTO follows the table's convention."""

    AUTO = "auto"
    STANDARD = "standard"
    CRAIG = "craig"


@dataclass(frozen=True)
class Style:
    """The robot of a document with the choices that its author made.

    Attributes
    ----------
    robot : Robot
    order : Order
    naming : Naming
    leading : tuple of str
        Symbols whose terms come first in a sum.
    """

    robot: Robot
    order: Order = Order.RIGHT
    naming: Naming = Naming.AUTO
    leading: tuple[str, ...] = ()

    @property
    def craig(self) -> bool:
        """Whether poses are written with both frames on the left."""
        if self.naming is Naming.AUTO:
            return self.robot.convention is Convention.MODIFIED
        return self.naming is Naming.CRAIG

    @cached_property
    def notation(self) -> Notation:
        """How the robot's expressions are written."""
        return Notation(self.robot, leading=self.leading)

    @cached_property
    def figures(self) -> Notation:
        """How expressions are written once numbers stand in them: 0.5, not a half."""
        return Notation(self.robot, decimals=True)

    def pose_name(self, start: Frame | str, end: Frame | str) -> PoseName:
        """Return the name of the pose of `end` in `start`."""
        return PoseName(str(start), str(end), self.craig)

    def link_name(self, i: int) -> Node:
        """Return the name of one row's transform: A_i, or Craig's name of it."""
        return self.pose_name(i - 1, i) if self.craig else Generic("A", str(i))

    def angle(self, node_of: Motion) -> Node:
        """Return the amount of a motion; constants of a rotation in the table's angle unit."""
        write = self.notation.angle if node_of.kind is MotionKind.ROTATION else self.notation.write
        return write(node_of.amount)

    def operators(self, word: Word) -> tuple[Node, ...]:
        """Return the motions of a word that do something, as operators."""
        return tuple(
            Operator(motion.kind, motion.axis, self.angle(motion), self.craig)
            for motion in word
            if not motion.amount.is_zero
        )
