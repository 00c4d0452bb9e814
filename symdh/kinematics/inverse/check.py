"""Proof by trial: random joint values, their poses, and whether the answers hold them again."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from symdh.kinematics.inverse.inverse import InverseKinematics

_FOUND = 1e-6


@dataclass
class Trials:
    """What came of random poses.

    Attributes
    ----------
    poses : int
    found : int
        Poses at which the joint values that made them are among the answers.
    worst : float
        The largest error of an answer, as a length.
    reach : float
        The sum of the arm's lengths.
    counts : Counter
        How many poses have how many solutions.
    missed : list of tuple of float
        The joint values that were not found again, a few of them.
    """

    poses: int
    found: int = 0
    worst: float = 0.0
    reach: float = 1.0
    counts: Counter[int] = field(default_factory=Counter)
    missed: list[tuple[float, ...]] = field(default_factory=list)


def tried(
    found: InverseKinematics,
    count: int,
    values: Mapping[Symbol, Expr] | None = None,
    progress: Callable[[int], None] | None = None,
) -> Trials:
    """Solve for the poses of random joint values.

    Parameters
    ----------
    found : InverseKinematics
    count : int
    values : mapping of Symbol to Expr, optional
        Numbers for parameters and locked joints.
    progress : callable, optional
        Called with the number of poses done.

    Raises
    ------
    UnsupportedError
        When a parameter has no value.
    """
    solver = found.solver(values)
    judge = solver.judge
    drawn = random.Random(2024)
    result = Trials(count, reach=judge.chain.reach)
    for done in range(count):
        q = judge.random_values(drawn)
        answers = solver.solve(judge.chain.pose(q))
        result.counts[len(answers)] += 1
        result.worst = max([result.worst, *(answer.error for answer in answers)])
        if any(judge.distance(q, answer.q) < _FOUND for answer in answers):
            result.found += 1
        elif len(result.missed) < 5:
            result.missed.append(tuple(q))
        if progress is not None:
            progress(done + 1)
    return result
