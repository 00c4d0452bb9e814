"""Goals: poses to be reached, from numbers that a user gives."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, isfinite, sin

from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.refine import Goal
from symdh.kinematics.inverse.task import InverseTask, Kind

#: By how much the columns of a rotation may miss being orthonormal.
TOLERANCE = 1e-6


def goal_of(task: InverseTask, numbers: Sequence[float]) -> Goal:
    """Return the goal that numbers stand for.

    Parameters
    ----------
    task : InverseTask
    numbers : sequence of float
        Twelve or sixteen numbers of a pose by rows; or the coordinates of the task, in a planar
        task followed by the angle in radians.

    Raises
    ------
    UnsupportedError
        When their count fits neither, or the first three columns are no rotation.
    """
    if not all(isfinite(x) for x in numbers):
        raise UnsupportedError("a pose needs finite numbers")
    if len(numbers) in (12, 16):
        rows = tuple(tuple(numbers[4 * r : 4 * r + 4]) for r in range(3))
        if len(numbers) == 16 and tuple(numbers[12:]) != (0.0, 0.0, 0.0, 1.0):
            raise UnsupportedError("the last row of a pose is 0 0 0 1")
        if task.with_orientation:
            _check_rotation(rows)
        return rows
    few = len(task.axes) + (task.kind is Kind.PLANAR)
    if task.kind in (Kind.POSITION, Kind.PLANAR) and len(numbers) == few:
        return _from_coordinates(task, numbers)
    wanted = "12 numbers (three rows of a pose) or 16"
    if task.kind in (Kind.POSITION, Kind.PLANAR):
        wanted = f"{few} numbers ({task.description}), {wanted}"
    raise UnsupportedError(f"a goal of this arm is {wanted}; there are {len(numbers)}")


def _from_coordinates(task: InverseTask, numbers: Sequence[float]) -> Goal:
    position = [0.0, 0.0, 0.0]
    for axis, value in zip(task.axes, numbers, strict=False):
        position[axis] = value
    rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    if task.kind is Kind.PLANAR:
        if task.axes != (0, 1):
            raise UnsupportedError("an angle needs a plane x y; give the pose as 12 numbers")
        c, s = cos(numbers[-1]), sin(numbers[-1])
        rotation[0][:2], rotation[1][:2] = [c, -s], [s, c]
    return tuple((*rotation[r], position[r]) for r in range(3))


def _check_rotation(rows: Goal) -> None:
    columns = [[row[c] for row in rows] for c in range(3)]
    for a in range(3):
        for b in range(3):
            product = sum(x * y for x, y in zip(columns[a], columns[b], strict=True))
            if abs(product - (a == b)) > TOLERANCE:
                raise UnsupportedError(
                    "the first three columns are no rotation: they miss being orthonormal by "
                    f"{abs(product - (a == b)):.1g}"
                )
    x, y, z = columns
    handed = sum(
        x[k] * (y[(k + 1) % 3] * z[(k + 2) % 3] - y[(k + 2) % 3] * z[(k + 1) % 3]) for k in range(3)
    )
    if handed < 0:
        raise UnsupportedError("the first three columns are a reflection, no rotation")
