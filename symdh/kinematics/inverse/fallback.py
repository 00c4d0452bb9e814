"""What is done where no closed form is found, in this order and called by its name.

A nominal arm whose closed form is improved by Newton's method, a search over one joint with the
rest in closed form, and damped least squares from many starting points. They find what they
find: none of them proves that there is no other solution.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf, pi

from sympy import Expr, Integer, Symbol
from sympy import pi as exact_pi

from symdh.kinematics.inverse.evaluate import Evaluator
from symdh.kinematics.inverse.judge import Answer, Judge
from symdh.kinematics.inverse.numeric import held_values
from symdh.kinematics.inverse.refine import Goal
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.kinematics.inverse.task import InverseTask
from symdh.robot import Joint, Robot

#: Lengths below this part of the arm's reach, and angles this near to a multiple of 90 degrees,
#: are taken for errors of a calibrated arm.
SMALL_LENGTH = 0.01
SMALL_ANGLE = 0.02

_GRID = 240
_WORTH_REFINING = 0.7
#: Points at neighbouring values of the joint that are farther apart are on different branches.
_ONE_BRANCH = 0.3
_STARTS = 60
#: Random starting points that complete a search over one joint.
_EXTRA = 30
_STEPS = 80


def nominal(robot: Robot) -> Robot | None:
    """Return the arm without its small lengths and nearly right angles; None where it has none."""
    known = {s: v for s, v in robot.values.items() if s in robot.parameters}

    def number(amount: Expr) -> float | None:
        value = amount.xreplace(known)
        return None if value.free_symbols else float(value)

    constants = [number(x) for joint in robot.joints for x in (joint.a, joint.d)]
    reach = sum(abs(x) for x in constants if x is not None)

    def length(amount: Expr) -> Expr:
        value = number(amount)
        small = value is not None and abs(value) < SMALL_LENGTH * reach
        return Integer(0) if small else amount

    def angle(amount: Expr) -> Expr:
        constant = amount.xreplace(dict.fromkeys(robot.variables, Integer(0)))
        value = number(constant)
        quarters = 0 if value is None else round(value / (pi / 2))
        if value is None or abs(value - quarters * pi / 2) >= SMALL_ANGLE:
            return amount
        return amount - constant + quarters * exact_pi / 2

    joints = tuple(
        Joint(j.type, angle(j.theta), length(j.d), length(j.a), angle(j.alpha), j.variable)
        for j in robot.joints
    )
    return None if joints == robot.joints else replace(robot, joints=joints)


class OneJointSearch:
    """A search over one joint: for each of its values, the others in closed form.

    Parameters
    ----------
    form : ClosedForm
        Of the arm with one joint more locked. It has more equations than unknowns; where the
        ones that it does not use hold as well, there is a solution.
    searched : Symbol
        That joint.
    values : mapping of Symbol to Expr
        Numbers for parameters and for joints that are locked for good.

    Raises
    ------
    UnsupportedError
        When a parameter has no value.
    """

    def __init__(
        self, form: ClosedForm, searched: Symbol, values: Mapping[Symbol, Expr] | None = None
    ) -> None:
        given = form.arm.given
        known = {s: v for s, v in (values or {}).items() if s in given.parameters}
        locked = [variable for variable in form.arm.locked if variable != searched]
        self._held = held_values(given, locked, values or {})
        self.judge = Judge(given, form.task, known, self._held)
        self._evaluator = Evaluator(form, known, {**self._held, searched: 0.0})
        self._searched = searched
        self._place = given.variables.index(searched)

    def solve(
        self, goal: Sequence[Sequence[float]], seed: Sequence[float] | None = None
    ) -> list[Answer]:
        """Return the solutions found: where the error along a branch turns, Newton goes on."""
        pose = self.judge.goal(goal)
        start = list(seed) if seed is not None else [0.0] * len(self.judge.turning)
        curves = [self._at(-pi + 2 * pi * k / _GRID, pose, start) for k in range(_GRID)]
        found: list[Answer] = []
        limit = _WORTH_REFINING * self.judge.chain.reach
        for k, points in enumerate(curves):
            before, after = curves[k - 1], curves[(k + 1) % _GRID]
            for error, q in points:
                beside = min(self._error_near(q, before), self._error_near(q, after))
                if error <= limit and error <= beside:
                    self.judge.accept(found, pose, q, (), (), _STEPS, 1e-3)
        drawn = random.Random(31)
        for _ in range(_EXTRA):
            self.judge.accept(found, pose, self.judge.random_values(drawn), (), (), _STEPS, 1e-2)
        return self.judge.in_order(found, seed)

    def _at(
        self, value: float, goal: Goal, seed: list[float]
    ) -> list[tuple[float, tuple[float, ...]]]:
        """Return each branch for one value of the joint, with its error."""
        self._evaluator.hold({**self._held, self._searched: value})
        proposals = self._evaluator.proposals(goal, seed)
        return [(self.judge.error(goal, p.q), p.q) for p in proposals]

    def _error_near(
        self, q: Sequence[float], points: list[tuple[float, tuple[float, ...]]]
    ) -> float:
        """Return the error at a neighbouring value of the joint, infinite where a branch ends."""
        apart = [
            (self.judge.distance(q, other, without=self._place), error) for error, other in points
        ]
        nearest, error = min(apart, default=(inf, inf))
        return error if nearest < _ONE_BRANCH else inf


class LeastSquares:
    """Damped least squares from a seed and from random starting points.

    Parameters
    ----------
    robot : Robot
    task : InverseTask
    locked : sequence of Symbol
    values : mapping of Symbol to Expr
        Numbers for parameters and for locked joints.

    Raises
    ------
    UnsupportedError
        When a parameter has no value.
    """

    def __init__(
        self,
        robot: Robot,
        task: InverseTask,
        locked: Sequence[Symbol],
        values: Mapping[Symbol, Expr] | None = None,
    ) -> None:
        known = {s: v for s, v in (values or {}).items() if s in robot.parameters}
        self.judge = Judge(robot, task, known, held_values(robot, locked, values or {}))

    def solve(
        self, goal: Sequence[Sequence[float]], seed: Sequence[float] | None = None
    ) -> list[Answer]:
        """Return the solutions found."""
        pose = self.judge.goal(goal)
        drawn = random.Random(29)
        found: list[Answer] = []
        for k in range(_STARTS):
            q = list(seed) if seed is not None and not k else self.judge.random_values(drawn)
            self.judge.accept(found, pose, q, (), (), _STEPS, 1e-2)
        return self.judge.in_order(found, seed)
