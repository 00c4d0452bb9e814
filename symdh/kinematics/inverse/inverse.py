"""Inverse kinematics of an arm: in closed form, or by what is labelled as something else."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from time import process_time
from typing import Protocol

from sympy import Expr, Symbol

from symdh.errors import LimitError, UnsupportedError
from symdh.kinematics.inverse.fallback import LeastSquares, OneJointSearch, nominal
from symdh.kinematics.inverse.judge import Answer, Judge
from symdh.kinematics.inverse.numeric import Solver
from symdh.kinematics.inverse.search import TIME_BUDGET, closed_form
from symdh.kinematics.inverse.solution import ClosedForm, Tried
from symdh.kinematics.inverse.structure import Structure, structure
from symdh.kinematics.inverse.task import InverseTask, Kind, inverse_task, ways_to_move
from symdh.robot import JointType, Robot

#: What a pose of a rigid body has.
MOST_FREEDOMS = 6


class Method(Enum):
    """How solutions are found; the value is what it is called."""

    CLOSED_FORM = "closed form"
    NOMINAL = "closed form of the nominal arm, improved by Newton's method"
    ONE_JOINT = (
        "search over one joint, the others in closed form, completed by damped least squares"
    )
    LEAST_SQUARES = "damped least squares from many starting points"


class GoalSolver(Protocol):
    """Finds the solutions for one goal."""

    judge: Judge

    def solve(
        self, goal: Sequence[Sequence[float]], seed: Sequence[float] | None = None
    ) -> list[Answer]:
        """Return the solutions for a pose of the last frame in the first."""


@dataclass(frozen=True)
class InverseKinematics:
    """What is known of the inverse kinematics of an arm.

    Attributes
    ----------
    robot : Robot
    task : InverseTask
    method : Method
    form : ClosedForm or None
        Of the arm, of its nominal arm, or of the arm with one joint more locked.
    tried : Tried or None
        How far the search for a closed form came where there is none.
    searched : Symbol or None
        The joint that is searched over.
    locked : tuple of Symbol
        Joints held because the user said so.
    structure : Structure
    """

    robot: Robot
    task: InverseTask
    method: Method
    form: ClosedForm | None
    tried: Tried | None
    searched: Symbol | None
    locked: tuple[Symbol, ...]
    structure: Structure

    def solver(self, values: Mapping[Symbol, Expr] | None = None) -> GoalSolver:
        """Return what finds solutions for goals.

        Parameters
        ----------
        values : mapping of Symbol to Expr, optional
            Numbers for parameters, which win over the table's own, and for locked joints.

        Raises
        ------
        UnsupportedError
            When a parameter has no value.
        """
        if self.method is Method.LEAST_SQUARES or self.form is None:
            return LeastSquares(self.robot, self.task, self.locked, values)
        if self.method is Method.ONE_JOINT:
            assert self.searched is not None
            return OneJointSearch(self.form, self.searched, values)
        actual = self.robot if self.method is Method.NOMINAL else None
        return Solver(self.form, values, actual)


def inverse_kinematics(
    robot: Robot,
    task: str | None = None,
    locked: Iterable[Symbol] = (),
    seconds: float = TIME_BUDGET,
) -> InverseKinematics:
    """Derive the inverse kinematics of an arm.

    Parameters
    ----------
    robot : Robot
    task : str, optional
        ``pose``, ``orientation``, or coordinates such as ``x y`` and ``x y phi``; by default what
        fits the arm.
    locked : iterable of Symbol
        Joint variables to hold, for arms with more joints than the task needs.
    seconds : float
        CPU time for all searches together.

    Returns
    -------
    InverseKinematics
        Its `method` says what it is.

    Raises
    ------
    UnsupportedError
        When the arm has more moving joints than the task gives numbers, or than ways to move its
        hand, or the task is unknown.
    LimitError
        When the time is used up before the search has come to an end.
    """
    begin = process_time()
    held = tuple(locked)
    freedoms = len(robot.variables) - len(held)
    if freedoms > MOST_FREEDOMS:
        text = "a pose gives six numbers"
        raise _too_many(robot, freedoms - MOST_FREEDOMS, held, text, seconds)
    wanted = inverse_task(robot, freedoms, task)
    found = closed_form(robot, wanted, held, seconds)
    shape = structure(robot)
    if isinstance(found, ClosedForm):
        return InverseKinematics(robot, wanted, Method.CLOSED_FORM, found, None, None, held, shape)
    if found.timed_out:
        raise LimitError(
            f"the search for the inverse kinematics of {robot.name} in closed form was stopped "
            f"after {seconds:g} s of CPU time; --time-limit allows more"
        )

    def left() -> float:
        return max(seconds - (process_time() - begin), 0.1)

    ways = ways_to_move(robot, wanted, held)
    if ways < freedoms:
        text = f"they move the hand in {ways} ways only"
        raise _too_many(robot, freedoms - ways, held, text, left())

    simple = nominal(robot)
    form = closed_form(simple, wanted, held, left()) if simple is not None else found
    if isinstance(form, ClosedForm):
        return InverseKinematics(robot, wanted, Method.NOMINAL, form, found, None, held, shape)
    for searched in _searchable(robot, wanted, held):
        part = _partial(robot, wanted, (*held, searched), left())
        if isinstance(part, ClosedForm):
            return InverseKinematics(
                robot, wanted, Method.ONE_JOINT, part, found, searched, held, shape
            )
    return InverseKinematics(robot, wanted, Method.LEAST_SQUARES, None, found, None, held, shape)


def _too_many(
    robot: Robot, more: int, held: tuple[Symbol, ...], why: str, seconds: float
) -> UnsupportedError:
    """Say that so many joints have to be locked, and name one that leaves a closed form."""
    free = [variable for variable in robot.variables if variable not in held]
    names = ", ".join(variable.name for variable in free)
    text = f"{robot.name} has {len(free)} joints that move, and {why}"
    if more > 1:
        return UnsupportedError(f"{text}: hold {more} of them with --lock NAME ({names})")
    begin = process_time()
    for variable in sorted(free, key=lambda v: abs(free.index(v) - len(free) // 2 + 1)):
        if process_time() - begin > seconds / 2:
            break
        if isinstance(_partial(robot, None, (*held, variable), seconds / 2), ClosedForm):
            return UnsupportedError(
                f"{text}: hold one of them with --lock NAME ({names}); with --lock "
                f"{variable.name} there is a closed form"
            )
    return UnsupportedError(f"{text}: hold one of them with --lock NAME ({names})")


def _searchable(robot: Robot, task: InverseTask, held: tuple[Symbol, ...]) -> list[Symbol]:
    """Return the joints that a search can go over: those that turn, where a pose is given."""
    if task.kind is not Kind.POSE:
        return []
    return [
        joint.variable
        for joint in robot.joints
        if joint.type is JointType.REVOLUTE
        and joint.variable is not None
        and joint.variable not in held
    ]


def _partial(
    robot: Robot, task: InverseTask | None, locked: tuple[Symbol, ...], seconds: float
) -> ClosedForm | Tried | None:
    try:
        return closed_form(robot, task, locked, seconds)
    except UnsupportedError:
        return None
