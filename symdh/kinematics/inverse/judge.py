"""The judge of every answer: forward kinematics, whatever a formula or a search has proposed."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot, inf, pi

from sympy import Expr, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.numeric_chain import NumericChain
from symdh.kinematics.inverse.refine import Goal, refined, task_error
from symdh.kinematics.inverse.task import InverseTask
from symdh.robot import Robot

#: An answer may miss the goal by so much of the arm's reach.
TOLERANCE = 1e-9
#: Rounding of a formula; what misses by more is improved.
_ROUNDING = 1e-13
#: Two answers closer than this, in radians and parts of the reach, are one.
_SAME = 1e-6
MAX_LENGTH = 1e30
"""The longest reach and the farthest goal; their powers, up to the eighth, fit into a double."""


@dataclass(frozen=True)
class Answer:
    """One solution for a goal.

    Attributes
    ----------
    q : tuple of float
        The joint variables in chain order, locked ones included; angles in (-pi, pi].
    branches : tuple of int
        Which branch each branching step took; empty where no formula gave the answer.
    free : tuple of Symbol
        Variables that the goal leaves free; they have the seed's values.
    error : float
        By how much the pose misses the goal, as a length.
    within_limits : bool
        Whether all variables are within the limits of the table.
    """

    q: tuple[float, ...]
    branches: tuple[int, ...]
    free: tuple[Symbol, ...]
    error: float
    within_limits: bool


class Judge:
    """Says what is an answer, which answers are the same, and improves what is nearly one.

    Parameters
    ----------
    robot : Robot
    task : InverseTask
    values : mapping of Symbol to Expr
        Numbers for parameters; they win over the table's own.
    held : mapping of Symbol to float
        Locked joint variables.

    Raises
    ------
    UnsupportedError
        When a parameter has no value, or the arm is longer than `MAX_LENGTH`.
    """

    def __init__(
        self,
        robot: Robot,
        task: InverseTask,
        values: Mapping[Symbol, Expr],
        held: Mapping[Symbol, float],
    ) -> None:
        self.robot = robot
        self.task = task
        numbers = {s.name: float(v) for s, v in values.items() if s in robot.parameters}
        self.chain = NumericChain.of(robot, numbers)
        for length in (self.chain.reach, *held.values()):
            _refuse_over_limit("lengths and locked joints", length)
        self.held = {robot.variables.index(variable): x for variable, x in held.items()}
        self.turning = self.chain.turning
        self.free_places = [k for k in range(len(robot.variables)) if k not in self.held]
        self._limits = _limits(robot, {**robot.values, **values})

    def goal(self, rows: Sequence[Sequence[float]]) -> Goal:
        """Return the goal that the first three rows of a pose are.

        Raises
        ------
        UnsupportedError
            When it is farther away than `MAX_LENGTH`.
        """
        pose = tuple(tuple(map(float, row)) for row in rows[:3])
        for row in pose:
            _refuse_over_limit("a position", row[3])
        return pose

    def error(self, goal: Goal, q: Sequence[float]) -> float:
        """Return by how much joint values miss a goal, as a length."""
        return task_error(self.chain, self.task, goal, q)

    def accept(
        self,
        answers: list[Answer],
        goal: Goal,
        q: Sequence[float],
        branches: tuple[int, ...] = (),
        free: tuple[Symbol, ...] = (),
        steps: int = 0,
        damping: float = 0.0,
    ) -> bool:
        """Add joint values to the answers if they reach the goal, improved if `steps` allow it.

        Returns
        -------
        bool
            Whether they reach it, a new answer or not.
        """
        values, error = list(q), self.error(goal, q)
        if steps and error > _ROUNDING * self.chain.reach:
            values, error = refined(
                self.chain, self.task, goal, values, self.free_places, steps, damping
            )
        if not error <= TOLERANCE * self.chain.reach:
            return False
        values = [self.wrapped(k, x) for k, x in enumerate(values)]
        if not any(self.distance(values, other.q) < _SAME for other in answers):
            within = self._is_within(values)
            answers.append(Answer(tuple(values), branches, free, error, within))
        return True

    def in_order(self, answers: list[Answer], seed: Sequence[float] | None) -> list[Answer]:
        """Return answers nearest to the seed first; as they are without one."""
        if seed is None:
            return answers
        return sorted(answers, key=lambda answer: self.distance(answer.q, seed))

    def random_values(self, drawn: random.Random) -> list[float]:
        """Draw joint values; locked joints keep theirs."""
        return [self.held.get(k, x) for k, x in enumerate(self.chain.random_values(drawn))]

    def wrapped(self, place: int, value: float) -> float:
        """Return an angle in (-pi, pi], a slide as it is."""
        if not self.turning[place]:
            return value
        turned = value - 2 * pi * round(value / (2 * pi))
        return pi if turned <= -pi else turned

    def distance(self, a: Sequence[float], b: Sequence[float], without: int | None = None) -> float:
        """Return how far apart joint values are, slides as parts of the reach."""
        return hypot(
            *(
                self.wrapped(place, x - y) / (1.0 if self.turning[place] else self.chain.reach)
                for place, (x, y) in enumerate(zip(a, b, strict=True))
                if place != without
            )
        )

    def _is_within(self, q: Sequence[float]) -> bool:
        return all(
            low - _SAME <= value <= high + _SAME
            for value, (low, high) in zip(q, self._limits, strict=True)
        )


def _limits(robot: Robot, known: Mapping[Symbol, Expr]) -> list[tuple[float, float]]:
    limits = []
    for variable in robot.variables:
        bounds = robot.limits.get(variable)
        ends = (-inf, inf)
        if bounds is not None:
            lower, upper = (bound.xreplace(dict(known)) for bound in (bounds.lower, bounds.upper))
            if not (lower.free_symbols or upper.free_symbols):
                ends = float(lower), float(upper)
        limits.append(ends)
    return limits


def _refuse_over_limit(what: str, length: float) -> None:
    if not abs(length) <= MAX_LENGTH:
        raise UnsupportedError(
            f"inverse kinematics takes {what} up to the limit of {MAX_LENGTH:g}, not {length:.3g}"
        )
