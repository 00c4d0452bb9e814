"""All solutions for one goal from a closed form: every branch judged by forward kinematics."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence

from sympy import Expr, Symbol

from symdh.kinematics.inverse.evaluate import Evaluator, Proposal
from symdh.kinematics.inverse.judge import Answer, Judge
from symdh.kinematics.inverse.refine import Goal
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.robot import Robot

#: Proposals that miss the goal by less than this part of the reach are improved.
_WORTH_IMPROVING = 0.05
#: Steps of Newton's method that take off rounding, and those from farther away.
_FEW, _MANY = 6, 60
#: Goals so far from a degenerate one are solved in its place, in radians and parts of the reach.
_NEAR_BY = (1e-6, 1e-5, 1e-4, 1e-3)
#: How far beyond its reach a nominal arm is asked for what the true arm may reach.
_SLACK = 0.05
#: How often Newton's method starts anew where an equation has degenerated and nothing else helps.
_STARTS = 40


class Solver:
    """A closed form with numbers for its parameters.

    Parameters
    ----------
    solution : ClosedForm
    values : mapping of Symbol to Expr, optional
        Numbers for parameters, which win over the table's own, and for locked joints, which are
        else those of the table or zero.
    actual : Robot, optional
        The arm that answers are judged on, where it is not quite that of the closed form; its
        answers come from Newton's method, which starts where the closed form says.

    Raises
    ------
    UnsupportedError
        When a parameter has no value.
    """

    def __init__(
        self,
        solution: ClosedForm,
        values: Mapping[Symbol, Expr] | None = None,
        actual: Robot | None = None,
    ) -> None:
        given = solution.arm.given
        known = {s: v for s, v in (values or {}).items() if s in given.parameters}
        held = held_values(given, solution.arm.locked, values or {})
        self.solution = solution
        self.judge = Judge(actual or given, solution.task, known, held)
        self._evaluator = Evaluator(solution, known, held, 0.0 if actual is None else _SLACK)
        self._inexact = actual is not None

    def solve(
        self, goal: Sequence[Sequence[float]], seed: Sequence[float] | None = None
    ) -> list[Answer]:
        """Return every solution for a goal.

        Parameters
        ----------
        goal : 3 or 4 rows of 4 numbers
            The pose of the last frame in the first, lengths in the table's unit. Entries that the
            task does not give are ignored.
        seed : sequence of float, optional
            Joint values; free joints take theirs from it (else zero), and answers come nearest
            first.

        Returns
        -------
        list of Answer
            Empty when the goal is out of reach.
        """
        pose = self.judge.goal(goal)
        start = list(seed) if seed is not None else [0.0] * len(self.judge.turning)
        answers: list[Answer] = []
        for proposal in self._evaluator.proposals(pose, start):
            self._judged(answers, proposal, pose)
        if not answers:
            doubtful = self._inexact or self._evaluator.doubtful
            self._rescue(answers, pose, start, doubtful)
        return self.judge.in_order(answers, seed)

    def _judged(self, answers: list[Answer], proposal: Proposal, goal: Goal) -> None:
        near = self.judge.error(goal, proposal.q) < _WORTH_IMPROVING * self.judge.chain.reach
        steps = _MANY if self._inexact else _FEW if near else 0
        damping = 1e-6 if self._inexact else 0.0
        self.judge.accept(
            answers, goal, proposal.q, proposal.branches, proposal.free, steps, damping
        )

    def _rescue(self, answers: list[Answer], goal: Goal, seed: list[float], doubtful: bool) -> None:
        """Where equations degenerate at a goal: solve for goals near it, and go back by Newton.

        The near goals have the solutions that the degenerate equations hide. Last come random
        starting points, if the equations were near to degenerate at all.
        """
        judge, drawn = self.judge, random.Random(1)
        self._improve(answers, goal, goal, seed)
        for size in _NEAR_BY:
            direction = [drawn.uniform(-1, 1) for _ in range(6)]
            # Beyond a boundary one of two opposite directions comes back within reach.
            for by in (size, -size) if not answers else ():
                self._improve(answers, goal, _shaken(goal, by, judge.chain.reach, direction), seed)
        for _ in range(_STARTS if doubtful and not answers else 0):
            if judge.accept(answers, goal, judge.random_values(drawn), (), (), 80, 1e-2):
                return

    def _improve(
        self, answers: list[Answer], goal: Goal, near: Goal, seed: Sequence[float]
    ) -> None:
        """Start from the proposals for a goal near by, or for the same, with many steps."""
        judge = self.judge
        for proposal in self._evaluator.proposals(near, seed):
            if judge.error(goal, proposal.q) < _WORTH_IMPROVING * judge.chain.reach:
                judge.accept(answers, goal, proposal.q, proposal.branches, (), _MANY, 1e-9)


def held_values(
    robot: Robot, locked: Sequence[Symbol], values: Mapping[Symbol, Expr]
) -> dict[Symbol, float]:
    """Return the numbers of locked joints: those given, else the table's, else zero."""
    return {v: float(values.get(v, robot.values.get(v, 0))) for v in locked}


def _shaken(goal: Goal, size: float, reach: float, direction: Sequence[float]) -> Goal:
    """Return a pose near another one, turned and moved in a direction."""
    x, y, z = (size * part for part in direction[:3])
    turn = ((1.0, -z, y), (z, 1.0, -x), (-y, x, 1.0))
    return tuple(
        tuple(
            sum(turn[r][k] * goal[k][c] for k in range(3))
            + (reach * size * direction[3 + r] if c == 3 else 0.0)
            for c in range(4)
        )
        for r in range(3)
    )
