"""Inverse kinematics that can be asked for the solutions of a pose."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from sympy import Symbol

from symdh.derivation.inverse import inverse_document
from symdh.interface.shown import shown_as
from symdh.interface.values import NO_VALUES, Values, exact_values
from symdh.kinematics.inverse import inverse
from symdh.kinematics.inverse.goal import goal_of
from symdh.kinematics.inverse.judge import Answer
from symdh.kinematics.inverse.search import TIME_BUDGET
from symdh.render.page.fragment import document_fragment
from symdh.robot import Robot
from symdh.table.names import joint_variable


class InverseKinematics(inverse.InverseKinematics):
    """The result of `inverse_kinematics`; a notebook shows the whole derivation."""

    def solve(
        self,
        goal: Sequence[Any],
        near: Sequence[float] | None = None,
        values: Values = NO_VALUES,
    ) -> list[Answer]:
        """Return every solution for a goal; none where it is out of reach.

        Parameters
        ----------
        goal : 4x4 or 3x4 matrix, or sequence of float
            The pose of the last frame in the first, tool and base included; or the coordinates
            of the task, in a planar one followed by the angle in radians.
        near : m floats, optional
            Joint values, radians and the table's length unit: the nearest solution comes first,
            and joints that the goal leaves free keep them.
        values : mapping of str or Symbol to a number
            Numbers for parameters and locked joints; they win over the table's own.

        Raises
        ------
        UnsupportedError
            When a parameter has no value, or the numbers are no goal of this arm.
        """
        rows = goal.tolist() if hasattr(goal, "tolist") else goal
        numbers = [float(x) for row in rows for x in (row if isinstance(row, Sequence) else [row])]
        return self.solver(exact_values(values)).solve(goal_of(self.task, numbers), near)

    def _repr_html_(self) -> str:
        return document_fragment(inverse_document(self))


def inverse_kinematics(
    robot: Robot,
    task: str | None = None,
    lock: Iterable[str | Symbol] = (),
    seconds: float = TIME_BUDGET,
) -> InverseKinematics:
    """Derive the inverse kinematics of an arm: in closed form where there is one.

    Parameters
    ----------
    robot : Robot
    task : str, optional
        ``pose``, ``orientation``, or coordinates such as ``x y`` and ``x y phi``; by default what
        fits the arm.
    lock : iterable of str or Symbol
        Joints to hold, for arms with more joints than the task needs.
    seconds : float
        CPU time for the search.

    Returns
    -------
    InverseKinematics
        Its `method` says how solutions are found, `solve` finds them.

    Raises
    ------
    UnsupportedError
        When the arm has more moving joints than the task gives numbers, or the task or a joint is
        unknown.
    LimitError
        When the time is used up before the search has come to an end.
    """
    held = [joint_variable(robot, str(each)) for each in lock]
    return shown_as(InverseKinematics, inverse.inverse_kinematics(robot, task, held, seconds))


__all__ = ["Answer", "InverseKinematics", "inverse_kinematics"]
