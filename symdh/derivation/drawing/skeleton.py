"""Robot and numbers -> what is to be drawn: stretches along d and a, joint axes, frames."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from sympy import Symbol

from symdh.derivation.drawing.numbers import Numbers, line, number
from symdh.derivation.drawing.space import WORLD, Placement, Vector
from symdh.kinematics.chain import segment
from symdh.kinematics.frame import first_frame, last_frame, place
from symdh.robot import Axis, Joint, JointType, Motion, MotionKind, Robot

#: What a length shorter than the longest one is drawn as: (l / longest) to this power, and no
#: less than this part of the longest. A drawing is a scheme; an offset of 2 cm must be seen too.
_FLATTEN = 0.5
_SHORTEST = 0.42


@dataclass(frozen=True, slots=True)
class Drawn:
    """An elementary motion in numbers: ``start + slope * variable``."""

    motion: Motion
    start: float
    slope: float
    variable: Symbol | None

    def amount(self, values: Numbers) -> float:
        """Return the amount."""
        return self.start + (self.slope * values[self.variable] if self.variable else 0.0)


@dataclass(frozen=True, slots=True)
class Stretch:
    """A straight part of the arm along d or a of a row, or along a slide of base or tool."""

    start: Vector
    end: Vector
    motion: Motion
    row: int | None


@dataclass(frozen=True, slots=True)
class JointPlace:
    """A joint in space.

    Attributes
    ----------
    row : int
        The row of the table, from 1.
    type : JointType
    point, axis, across : Vector
        Where its stretch d begins, its direction (z) and an x axis.
    d : float
        How far the stretch goes along the axis.
    before, after : Vector
        The x axes that theta is measured from and to.
    """

    row: int
    type: JointType
    point: Vector
    axis: Vector
    across: Vector
    d: float
    before: Vector
    after: Vector


@dataclass(frozen=True)
class Skeleton:
    """An arm in one position, in the lengths of the drawing.

    Attributes
    ----------
    stretches : tuple of Stretch
    joints : tuple of JointPlace
    frames : tuple of (str, Placement)
        From the base to the tool, by name.
    """

    stretches: tuple[Stretch, ...]
    joints: tuple[JointPlace, ...]
    frames: tuple[tuple[str, Placement], ...]


class Chain:
    """A robot's motions in numbers, ready to be put into a position link by link.

    Parameters
    ----------
    robot : Robot
    numbers : mapping of Symbol to float
        All parameters and the sliding joints' variables.
    to_scale : bool
        Keep the ratios of the lengths; by default short ones are drawn longer.

    Raises
    ------
    UnsupportedError
        When the numbers make an amount infinite or complex.
    """

    def __init__(self, robot: Robot, numbers: Numbers, to_scale: bool) -> None:
        self.robot = robot
        self.numbers = numbers
        self.first, self.last = place(robot, first_frame(robot)), place(robot, last_frame(robot))
        self.links = [
            tuple(self._drawn(motion, k) for motion in segment(robot, k))
            for k in range(self.first, self.last)
        ]
        self.longest = max((abs(size) for size in self._lengths()), default=0.0)
        self.to_scale = to_scale
        self.slides = [number(joint.d, numbers) for joint in robot.joints]

    def _drawn(self, motion: Motion, k: int) -> Drawn:
        joint = self.robot.joints[k] if 0 <= k < self.robot.n else None
        variable = joint.variable if joint else None
        if joint is None or variable not in motion.amount.free_symbols:
            return Drawn(motion, number(motion.amount, self.numbers), 0.0, None)
        if joint.type is JointType.REVOLUTE:
            return Drawn(motion, *line(motion.amount, variable, self.numbers), variable)
        return Drawn(motion, number(motion.amount, self.numbers), 0.0, None)

    def _lengths(self) -> Iterable[float]:
        for link in self.links:
            for drawn in link:
                if drawn.motion.kind is MotionKind.TRANSLATION:
                    yield drawn.start

    def shown(self, size: float) -> float:
        """Return what a length is drawn as; the longest one is 1."""
        if not self.longest or size == 0.0:
            return 0.0
        part = abs(size) / self.longest
        if not self.to_scale:
            part = max(part**_FLATTEN, _SHORTEST)
        return math.copysign(part, size)

    def link(
        self, index: int, start: Placement, values: Numbers, scale: float = 1.0
    ) -> tuple[list[Stretch], JointPlace | None, Placement]:
        """Put one link into position.

        Parameters
        ----------
        index : int
            0 is the first of `links`.
        start : Placement
            Where the link before it ends.
        values : mapping of Symbol to float
            The variables of the joints that turn.
        scale : float
            The longest length on paper.
        """
        k = self.first + index
        row = k + 1 if 0 <= k < self.robot.n else None
        joint = self.robot.joints[k] if row else None
        stretches: list[Stretch] = []
        found: JointPlace | None = None
        at = start
        for drawn in self.links[index]:
            motion = drawn.motion
            amount = drawn.amount(values)
            if motion.kind is MotionKind.TRANSLATION:
                amount = scale * self.shown(amount)
            after = at.moved(motion.kind, motion.axis, amount)
            if joint and row and motion == Motion(MotionKind.ROTATION, Axis.Z, joint.theta):
                found = self._joint(row, joint, at, after, scale) or found
            if motion.kind is MotionKind.TRANSLATION and amount:
                stretches.append(Stretch(at.origin, after.origin, motion, row))
            at = after
        return stretches, found, at

    def _joint(
        self, row: int, joint: Joint, at: Placement, after: Placement, scale: float
    ) -> JointPlace | None:
        if joint.type is JointType.FIXED:
            return None
        d = scale * self.shown(self.slides[row - 1])
        x, z = after.axes[0], at.axes[2]
        return JointPlace(row, joint.type, at.origin, z, x, d, at.axes[0], x)

    def frame_name(self, place_: int) -> str:
        """Return the name of the frame at a place of the chain."""
        if place_ < 0:
            return "base"
        return "tool" if place_ > self.robot.n else str(place_)

    def skeleton(self, values: Numbers, scale: float) -> Skeleton:
        """Return the arm in a position."""
        at = WORLD
        stretches: list[Stretch] = []
        joints: list[JointPlace] = []
        frames = [(self.frame_name(self.first), at)]
        for index in range(len(self.links)):
            more, joint, at = self.link(index, at, values, scale)
            stretches += more
            joints += [joint] if joint else []
            frames.append((self.frame_name(self.first + index + 1), at))
        return Skeleton(tuple(stretches), tuple(joints), tuple(frames))
