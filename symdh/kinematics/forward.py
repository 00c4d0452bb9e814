"""Forward kinematics: exact link transforms, any iTj, and the products that lead to the pose."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import ImmutableMatrix

from symdh import motion
from symdh.errors import LimitError
from symdh.kinematics.chain import chain_word, link_word
from symdh.kinematics.frame import Frame, checked, first_frame, last_frame, place
from symdh.motion import Word
from symdh.motion.size import closed_form_size
from symdh.robot import Robot

#: Operations in the nine rotation entries past which no closed form is written out. A nested form
#: grows by 1.6 with each joint at a right angle to its neighbours, and nine of them need 1,641; a
#: twist that is a symbol counts as one joint more. Beyond it the recursion says more, and
#: generated code stays linear anyway.
CLOSED_FORM_LIMIT = 2000


def link_transform(robot: Robot, i: int) -> ImmutableMatrix:
    """Return A_i, the exact 4x4 transform of row `i` (1 .. n).

    Raises
    ------
    UnsupportedError
        When the table has no such row.
    """
    checked(robot, i)
    checked(robot, i - 1)
    return motion.transform(link_word(robot, i))


def transform(robot: Robot, start: Frame, end: Frame) -> ImmutableMatrix:
    """Return the exact 4x4 pose of frame `end` in frame `start`.

    The identity when both are one frame; the rigid inverse when `end` comes before `start`.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    LimitError
        When the closed form would pass `CLOSED_FORM_LIMIT`.
    """
    if place(robot, checked(robot, start)) <= place(robot, checked(robot, end)):
        word = chain_word(robot, start, end)
        _check_size(robot, word, start, end)
        return motion.transform(word)
    word = chain_word(robot, end, start)
    _check_size(robot, word, start, end)
    return motion.inverse_transform(word)


def has_closed_form(robot: Robot, start: Frame, end: Frame) -> bool:
    """Say whether the pose of `end` in `start` is small enough to be written out."""
    return closed_form_size(chain_word(robot, start, end)) <= CLOSED_FORM_LIMIT


def _check_size(robot: Robot, word: Word, start: Frame, end: Frame) -> None:
    size = closed_form_size(word)
    if size > CLOSED_FORM_LIMIT:
        about = f"{size:,}" if size < 10**9 else f"10^{len(str(size)) - 1}"
        raise LimitError(
            f"the closed form of {robot.name} from {start} to {end} would have about {about} "
            f"operations, over the limit of {CLOSED_FORM_LIMIT:,}; the recursion (derive, show) "
            "and generated code (code) have no such limit"
        )


@dataclass(frozen=True)
class ForwardKinematics:
    """The pose of the last frame in the first, with everything that made it.

    Attributes
    ----------
    robot : Robot
    start, end : Frame
        The ends of the chain.
    links : tuple of ImmutableMatrix
        A_1 .. A_n.
    pose : ImmutableMatrix or None
        The pose of `end` in `start`; None when only the recursion is small enough to print.
    """

    robot: Robot
    start: Frame
    end: Frame
    links: tuple[ImmutableMatrix, ...]
    pose: ImmutableMatrix | None

    def between(self, start: Frame, end: Frame) -> ImmutableMatrix:
        """Return the pose of `end` in `start` (see `transform`)."""
        return transform(self.robot, start, end)


def forward_kinematics(robot: Robot) -> ForwardKinematics:
    """Derive every link transform and the pose of the whole chain, base and tool included."""
    start, end = first_frame(robot), last_frame(robot)
    links = tuple(link_transform(robot, i) for i in range(1, robot.n + 1))
    pose = transform(robot, start, end) if has_closed_form(robot, start, end) else None
    return ForwardKinematics(robot, start, end, links, pose)
