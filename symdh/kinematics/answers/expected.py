"""The right answer to what a student was asked: as a formula, and as numbers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from sympy import Expr, ImmutableMatrix

from symdh.kinematics.answers.numbers import Matrix, Point, matrix, value
from symdh.kinematics.answers.slips import Slip, link_slips, pose_slips, unit_slips
from symdh.kinematics.chain import chain_word, link_word
from symdh.kinematics.forward import has_closed_form, link_transform, transform
from symdh.kinematics.frame import Frame, first_frame, last_frame
from symdh.kinematics.velocity import has_closed_jacobian, jacobian
from symdh.motion import Word
from symdh.robot import Robot
from symdh.table.answers import Jacobian, Link, Pose, Subject


@dataclass(frozen=True)
class Expected:
    """What a subject really is, for one robot."""

    robot: Robot
    subject: Subject

    @cached_property
    def frames(self) -> tuple[Frame, Frame]:
        """The frames that a pose leads from and to; those of the whole chain for a Jacobian."""
        start, end = first_frame(self.robot), last_frame(self.robot)
        if isinstance(self.subject, Pose):
            given_start, given_end = self.subject.start, self.subject.end
            return start if given_start is None else given_start, (
                end if given_end is None else given_end
            )
        return start, end

    @cached_property
    def word(self) -> Word:
        """The motions of the pose."""
        if isinstance(self.subject, Link):
            return link_word(self.robot, self.subject.row)
        return chain_word(self.robot, *self.frames)

    @cached_property
    def formula(self) -> ImmutableMatrix | None:
        """The exact matrix; None where its closed form would be too large."""
        if isinstance(self.subject, Link):
            return link_transform(self.robot, self.subject.row)
        start, end = self.frames
        if isinstance(self.subject, Jacobian):
            if not has_closed_jacobian(self.robot, end, start):
                return None
            return jacobian(self.robot, end, in_=start).matrix
        if not has_closed_form(self.robot, start, end):
            return None
        return transform(self.robot, start, end)

    def entry(self, row: int, column: int) -> Expr | None:
        """Return one entry of the formula, where there is one."""
        return None if self.formula is None else self.formula[row, column]

    def numbers(self, point: Point) -> Matrix:
        """Return the matrix in double precision."""
        if isinstance(self.subject, Jacobian):
            formula = self.formula
            assert formula is not None, "a claim on a Jacobian is judged by its closed form"
            return tuple(
                tuple(value(formula[r, c], point) for c in range(formula.cols))
                for r in range(formula.rows)
            )
        return matrix(self.word, point)

    def slips(self, numeric: bool) -> Iterator[Slip]:
        """Yield the slips that may have been made, the likeliest first."""
        if isinstance(self.subject, Jacobian):
            yield Slip("angular velocity stands above linear velocity", self._halves_exchanged)
            return
        if numeric:
            yield from unit_slips(self.word)
        if isinstance(self.subject, Link):
            yield from link_slips(self.robot, self.subject)
        else:
            yield from pose_slips(self.robot, *self.frames)

    def _halves_exchanged(self, point: Point) -> Matrix:
        rows = self.numbers(point)
        return (*rows[3:], *rows[:3])
