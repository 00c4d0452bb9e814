"""Answers of generated inverse kinematics, judged by the exact pose."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from symdh.codegen.exact import ExactChain
from symdh.codegen.inverse.program import Program

#: By how much an answer may miss the pose, as a part of the reach; forward kinematics, by which the
#: code judged it itself, rounds too.
_DOUBLE, _SINGLE = 1.1e-9, 2e-5
#: How near to the joint values that made a pose an answer counts as these.
_SAME_DOUBLE, _SAME_SINGLE = 1e-5, 2e-2
#: One random pose in so many may be one that floats cannot tell from a singular pose, where two
#: branches meet and one of them is lost; of doubles none is.
_EXCUSED_SINGLE = 50


@dataclass(frozen=True, slots=True)
class InverseVerification:
    """What came out.

    Attributes
    ----------
    poses : int
    found : int
        Of how many poses an answer is the joint values that made it.
    answers : int
        How many there were in all.
    error : float
        By how much an answer misses its pose at most, as a part of the reach.
    tolerance : float
    excused : int
        How many poses need not be found.
    """

    poses: int
    found: int
    answers: int
    error: float
    tolerance: float
    excused: int

    @property
    def is_right(self) -> bool:
        """Whether the joint values are found again and no answer is wrong; NaN is."""
        return self.found >= self.poses - self.excused and self.error <= self.tolerance


def judged(
    plan: Program,
    exact: ExactChain,
    poses: Sequence[Sequence[float]],
    answers: Sequence[Sequence[float]],
    *,
    is_single: bool,
) -> InverseVerification:
    """Judge answers to the poses of some joint values.

    Parameters
    ----------
    plan : Program
        Says what is compared of a pose.
    exact : ExactChain
    poses : sequence of joint values
    answers : sequence of joint values
        For each pose those of all answers in a row.
    is_single : bool
        Whether they were found in single precision.
    """
    n, found, errors = len(plan.turning), 0, [0.0]
    same = _SAME_SINGLE if is_single else _SAME_DOUBLE
    tolerance = _SINGLE if is_single else _DOUBLE
    for joints, row in zip(poses, answers, strict=True):
        each = [row[k : k + n] for k in range(0, len(row), n)]
        errors += [_missed_by(plan, exact, joints, answer) for answer in each]
        found += any(
            _apart(plan, exact, joints, answer) < same
            or _missed_by(plan, exact, joints, _between(plan, joints, answer)) <= tolerance
            for answer in each
        )
    # max() alone would pass over a NaN.
    worst = math.nan if any(map(math.isnan, errors)) else max(errors)
    excused = len(poses) // _EXCUSED_SINGLE if is_single else 0
    return InverseVerification(len(poses), found, len(errors) - 1, worst, tolerance, excused)


def _missed_by(
    plan: Program, exact: ExactChain, joints: Sequence[float], answer: Sequence[float]
) -> float:
    """Return by how much an answer misses the pose of joint values, as a part of the reach."""
    if not all(map(math.isfinite, answer)):
        return math.nan
    off = exact.pose(answer)[0] - exact.pose(joints)[0]
    errors = [float(abs(off[axis, 3])) / exact.lengths for axis in plan.axes]
    if plan.with_orientation:
        errors += [float(abs(off[r, c])) for r in range(3) for c in range(3)]
    return max(errors)


def _between(plan: Program, a: Sequence[float], b: Sequence[float]) -> list[float]:
    """Return the joint values half-way from one to the other, the shorter way round.

    Where these reach the pose as well, the two cannot be told apart by it: beside a singular pose
    rounding moves joint values far along what leaves the pose where it is.
    """
    pairs = zip(a, b, plan.turning, strict=True)
    return [
        x + 0.5 * (math.remainder(y - x, 2.0 * math.pi) if turns else y - x)
        for x, y, turns in pairs
    ]


def _apart(plan: Program, exact: ExactChain, a: Sequence[float], b: Sequence[float]) -> float:
    """Return the largest difference of joint values, angles up to full turns."""
    pairs = zip(a, b, plan.turning, strict=True)
    return max(
        abs(math.remainder(x - y, 2.0 * math.pi) if turns else (x - y) / exact.lengths)
        for x, y, turns in pairs
    )
