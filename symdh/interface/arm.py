"""A robot that can be asked for its transforms."""

from __future__ import annotations

from pathlib import Path

from sympy import ImmutableMatrix

from symdh import robot as model
from symdh.interface.shown import shown_as
from symdh.kinematics import forward
from symdh.kinematics.frame import Frame, first_frame, last_frame
from symdh.render.latex import render_transform
from symdh.render.page.fragment import table_fragment
from symdh.table import load_table, loads_table


class Robot(model.Robot):
    """A serial arm that knows its kinematics. See `symdh.robot.Robot` for the fields.

    Examples
    --------
    >>> import symdh
    >>> arm = symdh.loads('''
    ... name: arm
    ... convention: standard
    ... columns: [theta, d, a, alpha]
    ... rows:
    ...   - [theta1, 0, a1, 0]
    ...   - [theta2, 0, a2, 0]
    ... ''')
    >>> arm.T(0, 2)[0, 3]
    a1*cos(theta1) + a2*cos(theta1 + theta2)
    """

    @classmethod
    def of(cls, robot: model.Robot) -> Robot:
        """Return the same robot with this interface."""
        return shown_as(cls, robot)

    def A(self, i: int) -> ImmutableMatrix:
        """Return the exact 4x4 transform of row `i`, counted from 1.

        Raises
        ------
        UnsupportedError
            When the table has no such row.
        """
        return forward.link_transform(self, i)

    def T(self, start: Frame | None = None, end: Frame | None = None) -> ImmutableMatrix:
        """Return the exact 4x4 pose of frame `end` in frame `start`.

        Parameters
        ----------
        start, end : int, "base", "tool", optional
            0 is the base frame of the table, n the last; by default the whole chain, base and
            tool included. ``T(i, i)`` is the identity, ``T(j, i)`` the rigid inverse.

        Raises
        ------
        UnsupportedError
            When the robot has no such frame.
        LimitError
            When the closed form would be too large to write out.
        """
        start = first_frame(self) if start is None else start
        end = last_frame(self) if end is None else end
        return forward.transform(self, start, end)

    def _repr_html_(self) -> str:
        return table_fragment(self)

    def _repr_latex_(self) -> str | None:
        return forward_kinematics(self)._repr_latex_()


class ForwardKinematics(forward.ForwardKinematics):
    """The result of `forward_kinematics`; shows its pose in a notebook."""

    def _repr_latex_(self) -> str | None:
        if self.pose is None:
            return None
        return f"$\\displaystyle {render_transform(self.robot, self.start, self.end)}$"


def load(path: str | Path) -> Robot:
    """Read a table from a file.

    Raises
    ------
    TableError
        With every mistake of the file at its line and column.
    ReadError
        When the file cannot be read.
    """
    return Robot.of(load_table(str(path)).robot)


def loads(text: str | bytes) -> Robot:
    """Read a table from text.

    Raises
    ------
    TableError
        With every mistake at its line and column.
    """
    return Robot.of(loads_table(text).robot)


def forward_kinematics(robot: model.Robot) -> ForwardKinematics:
    """Derive the link transforms and the pose of the whole chain of a robot."""
    return shown_as(ForwardKinematics, forward.forward_kinematics(robot))
