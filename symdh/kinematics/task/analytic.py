"""The analytic Jacobian: the derivative of a task vector by the joint variables."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Expr, ImmutableMatrix

from symdh.kinematics.rotation import (
    inverse_rates,
    rates,
)
from symdh.kinematics.task.vector import (
    Coordinate,
    Heading,
    TaskVector,
)
from symdh.kinematics.velocity import GeometricJacobian, jacobian


@dataclass(frozen=True)
class AnalyticJacobian:
    """The derivative of a task vector by the joint variables.

    Attributes
    ----------
    vector : TaskVector
    geometric : GeometricJacobian
        Of the same frames; its lower half takes joint rates to the angular velocity.
    matrix : ImmutableMatrix
        One row for each component, one column for each joint variable. In the rows of Euler
        angles that are not read off, the letters of the first two stand for those angles.
    rates, inverse_rates : ImmutableMatrix or None
        B with omega = B phi', and its inverse; None without Euler angles.
    """

    vector: TaskVector
    geometric: GeometricJacobian
    matrix: ImmutableMatrix
    rates: ImmutableMatrix | None
    inverse_rates: ImmutableMatrix | None

    @property
    def angular(self) -> ImmutableMatrix:
        """The lower half of the geometric Jacobian, 3 x m."""
        return ImmutableMatrix(self.geometric.matrix[3:, :])


def analytic_jacobian(vector: TaskVector) -> AnalyticJacobian:
    """Differentiate a task vector, exactly and in short form.

    A coordinate's row is that of the geometric Jacobian. An angle that is a sum of joint variables
    is differentiated as it stands. Other Euler angles follow from ``phi' = B^-1 omega``.

    Raises
    ------
    LimitError
        When the closed form would be too large.
    """
    geometric = jacobian(vector.robot, vector.end, None, vector.start)
    whole = geometric.matrix
    variables = vector.robot.variables
    rate_matrix = inverse = None
    if vector.sequence is not None:
        first, second = vector.angles[0].symbol, vector.angles[1].symbol
        rate_matrix = rates(vector.sequence, first, second)
        inverse = inverse_rates(vector.sequence, first, second)
    rows = []
    for component in vector.components:
        if isinstance(component, Coordinate):
            rows.append([whole[component.axis, k] for k in range(len(variables))])
        elif isinstance(component, Heading):
            rows.append([component.angle.diff(variable) for variable in variables])
        elif isinstance(component.value, Expr):
            rows.append([component.value.diff(variable) for variable in variables])
        else:
            assert inverse is not None
            row = inverse.row(component.place)
            rows.append([(row * whole[3:, k])[0, 0] for k in range(len(variables))])
    return AnalyticJacobian(vector, geometric, ImmutableMatrix(rows), rate_matrix, inverse)
