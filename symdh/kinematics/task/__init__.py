"""Task vectors r = f(q), chosen by name or from the arm's structure, and dr/dq."""

from symdh.kinematics.task.analytic import AnalyticJacobian, analytic_jacobian
from symdh.kinematics.task.choosing import task_vector
from symdh.kinematics.task.numbers import TaskNumbers, task_numbers
from symdh.kinematics.task.vector import (
    Choice,
    Component,
    Coordinate,
    EulerAngle,
    Heading,
    TaskVector,
)

__all__ = [
    "AnalyticJacobian",
    "Choice",
    "Component",
    "Coordinate",
    "EulerAngle",
    "Heading",
    "TaskNumbers",
    "TaskVector",
    "analytic_jacobian",
    "task_numbers",
    "task_vector",
]
