"""Newton's method on the pose: the last digits, and solutions where no formula gives any."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, sqrt

from symdh.kinematics.inverse.numeric_chain import FloatMatrix, NumericChain
from symdh.kinematics.inverse.task import InverseTask

Goal = FloatMatrix


def task_error(chain: NumericChain, task: InverseTask, goal: Goal, q: Sequence[float]) -> float:
    """Return by how much a pose misses the goal, as a length.

    An error of an entry of the rotation counts as that part of the arm's reach.
    """
    reached = chain.pose(q)
    errors = [abs(reached[axis][3] - goal[axis][3]) for axis in task.axes]
    if task.with_orientation:
        errors += [
            chain.reach * abs(reached[r][c] - goal[r][c]) for r in range(3) for c in range(3)
        ]
    return max(errors)


def refined(
    chain: NumericChain,
    task: InverseTask,
    goal: Goal,
    q: Sequence[float],
    free: Sequence[int],
    steps: int,
    damping: float = 0.0,
) -> tuple[list[float], float]:
    """Improve joint values by damped least squares.

    Parameters
    ----------
    chain : NumericChain
    task : InverseTask
    goal : 3 rows of 4 numbers
    q : sequence of float
    free : sequence of int
        The places of the joint variables that may change.
    steps : int
        How many steps at most.
    damping : float
        0 is Newton's method; more is slower and safer far from a solution. It is adapted.

    Returns
    -------
    q : list of float
    error : float
        As `task_error` has it; never more than that of the values given.
    """
    best, error = list(q), task_error(chain, task, goal, q)
    weight = damping
    for _ in range(steps):
        if error < 1e-15 * chain.reach:
            break
        moved = False
        for tried in (0.0, weight) if weight else (0.0,):
            trial = _moved(chain, task, goal, best, free, tried)
            trial_error = task_error(chain, task, goal, trial)
            if trial_error < error:
                best, error, moved = trial, trial_error, True
                weight /= 10 if tried else 1
                break
        if not moved:
            if not damping or weight > 1e6:
                break
            weight = max(weight * 8, 1e-9)
    return best, error


def _moved(
    chain: NumericChain,
    task: InverseTask,
    goal: Goal,
    q: Sequence[float],
    free: Sequence[int],
    weight: float,
) -> list[float]:
    """Return joint values after one step, or the same where there is none."""
    step = _step(chain, task, goal, q, free, weight)
    trial = list(q)
    for place, change in zip(free, step or [0.0] * len(free), strict=True):
        trial[place] += change
    return trial


def _step(
    chain: NumericChain,
    task: InverseTask,
    goal: Goal,
    q: Sequence[float],
    free: Sequence[int],
    weight: float,
) -> list[float] | None:
    """Return the change of the free variables: exact where it can be, else by least squares."""
    reached = chain.pose(q)
    wanted = _difference(reached, goal, chain.reach)
    slope = chain.jacobian(q)
    rows = list(task.axes) + ([3, 4, 5] if task.with_orientation else [])
    errors = [wanted[k] for k in rows]
    matrix = [[slope[k][place] * (chain.reach if k > 2 else 1.0) for place in free] for k in rows]
    count = len(free)
    if not weight and count == len(rows):
        return _solved(matrix, errors)
    normal = [[sum(row[a] * row[b] for row in matrix) for b in range(count)] for a in range(count)]
    scale = max((normal[a][a] for a in range(count)), default=0.0)
    for a in range(count):
        normal[a][a] += (weight + 1e-14) * scale
    right = [sum(row[a] * e for row, e in zip(matrix, errors, strict=True)) for a in range(count)]
    return _solved(normal, right)


def _difference(reached: FloatMatrix, goal: Goal, reach: float) -> list[float]:
    """Return the translation and the rotation vector from one pose to another."""
    moved = [goal[r][3] - reached[r][3] for r in range(3)]
    turn = [[sum(goal[r][k] * reached[c][k] for k in range(3)) for c in range(3)] for r in range(3)]
    axis = [turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]]
    double_sine = sqrt(sum(x * x for x in axis))
    # Not by the arccosine, which knows nothing of angles below 1e-8.
    angle = atan2(double_sine / 2, (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2)
    factor = angle / double_sine if double_sine > 1e-12 else 0.5
    return moved + [reach * factor * x for x in axis]


def _solved(matrix: list[list[float]], right: list[float]) -> list[float] | None:
    """Solve linear equations by elimination with pivots; None where they are singular."""
    n = len(right)
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda r: abs(rows[r][k]))
        if not rows[pivot][k]:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for r in range(k + 1, n):
            factor = rows[r][k] / rows[k][k]
            if factor:
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[k], strict=True)]
    solution = [0.0] * n
    for k in range(n - 1, -1, -1):
        rest = sum(rows[k][c] * solution[c] for c in range(k + 1, n))
        solution[k] = (rows[k][n] - rest) / rows[k][k]
    return solution
