"""What a singular factor means: the places of an arm at which three directions lie in one plane."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import pairwise

from symdh.kinematics.frame import Frame
from symdh.kinematics.singular.factors import HalfAngles
from symdh.kinematics.singular.screws import direction, lever
from symdh.kinematics.singular.solving import joint_angles
from symdh.kinematics.singular.trig_ring import Element, Vector
from symdh.kinematics.velocity import axis_frame
from symdh.robot import JointType, Robot

#: Terms of a volume past which it is not compared: no factor with a name is so long.
MAX_VOLUME = 60


class Kind(Enum):
    """The well-known singularities of serial arms."""

    WRIST = "wrist"
    ELBOW = "elbow"
    SHOULDER = "shoulder"
    AXES = "axes"


@dataclass(frozen=True, slots=True)
class Meaning:
    """A singularity with a name.

    Attributes
    ----------
    kind : Kind
        WRIST and AXES: the axes of the three `joints` are parallel to one plane, the last three
        turning joints or others. ELBOW: `point` lies in the plane of the two parallel axes.
        SHOULDER: `point` lies in the plane through the first axis that is parallel to the second.
    joints : tuple of int
        Rows of the table.
    point : Frame or None
        The frame whose origin is meant.
    """

    kind: Kind
    joints: tuple[int, ...]
    point: Frame | None = None


class Meanings:
    """The places of one arm that singular factors are compared with."""

    def __init__(self, half_angles: HalfAngles, robot: Robot, joints: list[int]) -> None:
        self._half_angles = half_angles
        self._ring = half_angles.trig
        self._robot = robot
        self._turning = [i for i in joints if robot.joints[i - 1].type is JointType.REVOLUTE]

    def of(self, factor: Element) -> Meaning | None:
        """Return what a factor of joint angles means.

        The place whose volume is this factor and lengths, else the first whose volume contains it.
        """
        if not joint_angles(self._ring, factor):
            return None
        own = self._half_angles.pieces([factor]).support
        alike = [meaning for meaning, support in self._places if support == own]
        containing = [meaning for meaning, support in self._places if support >= own]
        return next(iter((*alike, *containing)), None)

    @cached_property
    def _places(self) -> list[tuple[Meaning, frozenset[object]]]:
        variables = set(self._robot.variables)
        places = []
        for meaning, volume in self._volumes():
            if volume and len(volume) <= MAX_VOLUME:
                pieces = self._half_angles.pieces([volume])
                places.append((meaning, self._half_angles.moving(pieces, variables).support))
        return places

    def _volumes(self) -> Iterator[tuple[Meaning, Element]]:
        """Yield each place with the volume that three directions span there."""
        yield from self._elbows()
        yield from self._wrists()
        yield from self._shoulders()

    def _wrists(self) -> Iterator[tuple[Meaning, Element]]:
        turning = self._turning
        for k in range(len(turning) - 3, -1, -1):
            first, middle, last = turning[k : k + 3]
            frame = axis_frame(self._robot, middle)
            axes = [self._axis(i, frame) for i in (first, middle, last)]
            kind = Kind.WRIST if k == len(turning) - 3 else Kind.AXES
            yield Meaning(kind, (first, middle, last)), self._volume(*axes)

    def _elbows(self) -> Iterator[tuple[Meaning, Element]]:
        for first, second in pairwise(self._turning):
            frame = axis_frame(self._robot, first)
            axis = self._axis(second, frame)
            if axis[0] or axis[1]:
                continue
            arm = self._point(first, axis_frame(self._robot, second))
            for point in self._points_after(second):
                to_point = self._point(first, point)
                yield Meaning(Kind.ELBOW, (first, second), point), self._volume(axis, arm, to_point)

    def _shoulders(self) -> Iterator[tuple[Meaning, Element]]:
        if len(self._turning) < 2:
            return
        first, second = self._turning[:2]
        frame = axis_frame(self._robot, first)
        axes = self._axis(first, frame), self._axis(second, frame)
        for point in self._points_after(second):
            meaning = Meaning(Kind.SHOULDER, (first, second), point)
            yield meaning, self._volume(*axes, self._point(first, point))

    def _axis(self, i: int, frame: int) -> Vector:
        return direction(self._ring, self._robot, i, frame)

    def _point(self, i: int, point: Frame) -> Vector:
        return lever(self._ring, self._robot, i, point, point)

    def _points_after(self, i: int) -> list[Frame]:
        last: list[Frame] = ["tool"] if self._robot.tool else []
        return [*range(axis_frame(self._robot, i) + 1, self._robot.n + 1), *last]

    def _volume(self, a: Vector, b: Vector, c: Vector) -> Element:
        return self._ring.dot(a, self._ring.cross(b, c))
