"""A task vector and its derivative in numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi

from sympy import Expr, Float, Symbol, atan2

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.numeric import check_values, pose
from symdh.kinematics.rotation import (
    SEQUENCES,
    Atan2,
    euler_angles,
    nearest_rotation,
)
from symdh.kinematics.task.analytic import AnalyticJacobian
from symdh.kinematics.task.vector import (
    Component,
    Coordinate,
    EulerAngle,
    Heading,
    TaskVector,
)

#: Sine (proper) or cosine (Tait-Bryan) of the second Euler angle below which a number for its rate
#: would be more rounding than rate.
SINGULAR = 1e-9

_DIGITS = 40


@dataclass(frozen=True, slots=True)
class TaskNumbers:
    """A task vector and its derivative at one set of values.

    Attributes
    ----------
    vector : tuple of float
        Lengths in the table's unit, angles in radians, in (-pi, pi].
    jacobian : tuple of tuple of float
        One row for each component.
    """

    vector: tuple[float, ...]
    jacobian: tuple[tuple[float, ...], ...]


def task_numbers(whole: AnalyticJacobian, values: Mapping[Symbol, Expr]) -> TaskNumbers:
    """Return the numbers of a task vector and its derivative.

    Parameters
    ----------
    whole : AnalyticJacobian
    values : mapping of Symbol to Expr
        Exact numbers, radians and the table's length unit. They win over the table's own.

    Raises
    ------
    UnsupportedError
        When a symbol has no value, or the Euler angles are singular there.
    """
    vector = whole.vector
    robot = vector.robot
    known = {**robot.values, **values}
    check_values(chain_word(robot, vector.start, vector.end), known)
    reached = pose(robot, vector.start, vector.end, values)
    angles = dict(known)
    if vector.sequence is not None:
        angles |= _euler_numbers(vector, reached, known)
    numbers = [_component_number(c, reached, angles) for c in vector.components]
    rows = whole.matrix
    slopes = [
        tuple(_number(rows[r, c], angles) for c in range(rows.cols)) for r in range(rows.rows)
    ]
    return TaskNumbers(tuple(numbers), tuple(slopes))


def _euler_numbers(
    vector: TaskVector, reached: Sequence[Sequence[float]], known: Mapping[Symbol, Expr]
) -> dict[Symbol, Expr]:
    """Return numbers for the letters of the Euler angles; refuse where they are singular."""
    assert vector.sequence is not None
    rotation = nearest_rotation([row[:3] for row in reached[:3]])
    found = euler_angles(rotation, vector.sequence)
    if found.margin < SINGULAR:
        best = max(SEQUENCES, key=lambda s: round(euler_angles(rotation, s).margin, 6))
        raise UnsupportedError(
            f"the Euler angles {vector.sequence.name} are singular at these values: the first and "
            f"the third rotation are about one line (within {SINGULAR:g}), so their rates do not "
            f"follow from the motion; take another sequence, such as {best.name}"
        )
    return {angle.symbol: _angle_number(angle, known) for angle in vector.angles}


def _angle_number(angle: EulerAngle, known: Mapping[Symbol, Expr]) -> Expr:
    """Return an Euler angle with all working digits, so that what cancels leaves a zero."""
    values = dict(known)
    if not isinstance(angle.value, Atan2):
        return angle.value.xreplace(values)
    y, x = (part.xreplace(values).evalf(_DIGITS) for part in (angle.value.y, angle.value.x))
    return atan2(y, x)


def _component_number(
    component: Component, reached: Sequence[Sequence[float]], known: Mapping[Symbol, Expr]
) -> float:
    if isinstance(component, Coordinate):
        return reached[component.axis][3]
    expression = component.angle if isinstance(component, Heading) else component.symbol
    return _wrapped(_number(expression, known))


def _number(expression: Expr, known: Mapping[Symbol, Expr]) -> float:
    value = expression.xreplace(dict(known)).evalf(_DIGITS)
    return 0.0 if abs(value) < Float("1e-30") else float(value)


def _wrapped(angle: float) -> float:
    turned = angle - 2 * pi * round(angle / (2 * pi))
    return pi if turned == -pi else turned
