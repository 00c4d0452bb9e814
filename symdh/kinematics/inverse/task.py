"""What an arm is asked for: a pose, or less where it has fewer than six freedoms."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from sympy import Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.lengths import random_chain
from symdh.kinematics.inverse.lines import Line, joint_lines
from symdh.kinematics.inverse.ring import ROTATION_NAMES, U_NAMES
from symdh.robot import JointType, Robot

_SMALL = 1e-9


class Kind(Enum):
    """What is compared of two poses."""

    POSE = "pose"
    POSITION = "position"
    PLANAR = "planar"
    ORIENTATION = "orientation"


@dataclass(frozen=True)
class InverseTask:
    """What is given: a whole pose, or some of its entries.

    Attributes
    ----------
    kind : Kind
    axes : tuple of int
        The coordinates of the position that are given, 0 to 2.
    reachable_only : bool
        Whether the arm can reach some poses only, so that the goal must be one of these.
    """

    kind: Kind
    axes: tuple[int, ...]
    reachable_only: bool

    @property
    def whole_pose(self) -> bool:
        """Whether the position is that of a known hand, so that its offset is known as well."""
        return self.kind in (Kind.POSE, Kind.PLANAR)

    @property
    def whole_position(self) -> bool:
        """Whether all coordinates of the position are given, or none."""
        return len(self.axes) in (0, 3)

    @property
    def with_orientation(self) -> bool:
        """Whether the orientation is given."""
        return self.kind is not Kind.POSITION

    def allowed(self, position_names: Sequence[str]) -> frozenset[str]:
        """Return the entries of the goal that equations may use."""
        names = {position_names[axis] for axis in self.axes}
        if self.with_orientation:
            names |= set(ROTATION_NAMES)
        if self.kind is Kind.POSE:
            names |= set(U_NAMES)
        return frozenset(names)

    @property
    def description(self) -> str:
        """The task in words."""
        letters = " ".join("xyz"[axis] for axis in self.axes)
        match self.kind:
            case Kind.POSE:
                return "the pose, position and orientation"
            case Kind.POSITION:
                return f"the position: {letters}"
            case Kind.PLANAR:
                return f"the position {letters} and the angle phi"
            case Kind.ORIENTATION:
                return "the orientation"


def inverse_task(robot: Robot, freedoms: int, text: str | None = None) -> InverseTask:
    """Return the task that was named, or the one that fits the arm.

    Parameters
    ----------
    robot : Robot
    freedoms : int
        How many joints move; locked ones do not count.
    text : str, optional
        ``pose``, ``orientation``, or coordinates such as ``x y`` and ``x y phi``.

    Raises
    ------
    UnsupportedError
        When the words are none of these, or ask for more than the arm has joints.
    """
    if text is not None:
        return _named(text, freedoms)
    if freedoms >= 6:
        return InverseTask(Kind.POSE, (0, 1, 2), False)
    lines = joint_lines(robot, random_chain(robot).random_values(random.Random(5)))
    axes = moved_coordinates(robot)
    if not axes:
        return InverseTask(Kind.ORIENTATION, (), freedoms < 3)
    if len(axes) == 2 and freedoms == 2 and _parallel(lines):
        if _places(robot, 2):
            return InverseTask(Kind.POSITION, axes, False)
        return InverseTask(Kind.PLANAR, axes, True)
    if len(axes) == 2 and freedoms == 3 and _parallel(lines):
        return InverseTask(Kind.PLANAR, axes, False)
    if freedoms == 3 and _places(robot, 3):
        return InverseTask(Kind.POSITION, axes, False)
    return InverseTask(Kind.POSE, (0, 1, 2), True)


def _named(text: str, freedoms: int) -> InverseTask:
    words = [word for word in re.split(r"[\s,]+", text.strip().lower()) if word]
    if words == ["pose"]:
        return InverseTask(Kind.POSE, (0, 1, 2), freedoms < 6)
    if words == ["orientation"]:
        return InverseTask(Kind.ORIENTATION, (), freedoms < 3)
    phi = "phi" in words
    letters = [word for word in words if word != "phi"]
    if letters and len(set(words)) == len(words) and all(x in ("x", "y", "z") for x in letters):
        axes = tuple(sorted("xyz".index(x) for x in letters))
        if len(words) < freedoms:
            numbers = "1 number" if len(words) == 1 else f"{len(words)} numbers"
            raise UnsupportedError(
                f"the task '{' '.join(words)}' gives {numbers} for {freedoms} joints: "
                "lock joints with --lock, or ask for more"
            )
        kind = Kind.PLANAR if phi else Kind.POSITION
        return InverseTask(kind, axes, len(words) > freedoms)
    raise UnsupportedError(
        f"there is no task {text!r}: write pose, orientation, or coordinates such as 'x y', "
        "'x y phi' and 'x y z'"
    )


def moved_coordinates(robot: Robot) -> tuple[int, ...]:
    """Return which coordinates of the hand change when the joints move."""
    chain, drawn = random_chain(robot), random.Random(7)
    poses = [chain.pose(chain.random_values(drawn)) for _ in range(4)]
    moved = []
    for axis in range(3):
        column = [pose[axis][3] for pose in poses]
        if max(column) - min(column) > _SMALL * chain.reach:
            moved.append(axis)
    return tuple(moved)


def ways_to_move(robot: Robot, task: InverseTask, locked: Sequence[Symbol] = ()) -> int:
    """Return in how many independent ways the joints change what a task gives.

    Fewer than joints that move say that some of these repeat what others do.
    """
    rows = list(task.axes) + ([3, 4, 5] if task.with_orientation else [])
    columns = [k for k, variable in enumerate(robot.variables) if variable not in locked]
    return _rank(robot, rows, columns)


def _places(robot: Robot, rank: int) -> bool:
    """Say whether the joints can move the hand in so many directions."""
    return _rank(robot, [0, 1, 2], range(len(robot.variables))) >= rank


def _rank(robot: Robot, rows: Sequence[int], columns: Sequence[int]) -> int:
    """Return the rank of a part of the Jacobian at random joint values, lengths in reaches."""
    chain = random_chain(robot)
    slope = chain.jacobian(chain.random_values(random.Random(6)))
    unit = [1.0 if turns else chain.reach for turns in chain.turning]
    left = [
        [slope[r][c] * unit[c] / (chain.reach if r < 3 else 1.0) for c in columns] for r in rows
    ]
    rank = 0
    while left and columns:
        size, r, c = max((abs(x), r, c) for r, row in enumerate(left) for c, x in enumerate(row))
        if size < _SMALL:
            break
        pivot = left.pop(r)
        left = [
            [x - row[c] / pivot[c] * y for x, y in zip(row, pivot, strict=True)] for row in left
        ]
        rank += 1
    return rank


def _parallel(lines: Sequence[Line]) -> bool:
    """Say whether all revolute axes are parallel."""
    turning = [line.direction for line in lines if line.type is JointType.REVOLUTE]
    first = turning[0] if turning else (0.0, 0.0, 1.0)
    return all(
        abs(abs(sum(x * y for x, y in zip(first, d, strict=True))) - 1) < _SMALL for d in turning
    )
