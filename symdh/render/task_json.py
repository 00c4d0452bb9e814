"""A task vector and its derivative as JSON, for programs."""

from __future__ import annotations

from typing import Any

from sympy import Expr

from symdh.kinematics.task import (
    AnalyticJacobian,
    Component,
    Coordinate,
    EulerAngle,
    Heading,
    TaskNumbers,
)
from symdh.notation import Notation, Shorthand
from symdh.render.json_text import json_text
from symdh.render.plain_math import PlainWriter
from symdh.robot import Robot


def task_json(found: AnalyticJacobian, numbers: TaskNumbers | None = None) -> str:
    """Return a task vector and the analytic Jacobian.

    ``components`` are names, ``vector`` and ``jacobian`` expressions that symdh reads back, angles
    in radians; letters of Euler angles that stand in ``jacobian`` are defined by ``letters``.
    ``singular_where_zero`` is the sine or cosine that the Euler angles fail with, null without any.
    ``values`` holds the numbers of both, null where none were asked for.
    """
    vector = found.vector
    write = _Spelling(vector.robot)
    vanishing = vector.vanishing
    matrix = found.matrix
    content: dict[str, Any] = {
        "from": vector.start,
        "to": vector.end,
        "choice": vector.choice.value,
        "sequence": vector.sequence and vector.sequence.name,
        "components": [_name(component) for component in vector.components],
        "vector": [write.component(component) for component in vector.components],
        "variables": [variable.name for variable in vector.robot.variables],
        "jacobian": [[write(matrix[r, c]) for c in range(matrix.cols)] for r in range(matrix.rows)],
        "letters": {angle.symbol.name: write.component(angle) for angle in vector.angles},
        "singular_where_zero": None if vanishing is None else write(vanishing),
        "values": None
        if numbers is None
        else {
            "vector": list(numbers.vector),
            "jacobian": [list(row) for row in numbers.jacobian],
        },
    }
    return json_text(content)


class _Spelling:
    """Writes expressions so that symdh's own parser reads them back."""

    def __init__(self, robot: Robot) -> None:
        self._notation = Notation(robot, Shorthand.none(robot), degrees=False)
        self._writer = PlainWriter()

    def __call__(self, expression: Expr) -> str:
        return self._writer.text(self._notation.write(expression))

    def component(self, component: Component) -> str:
        value = component.angle if isinstance(component, Heading) else component.value
        if isinstance(value, Expr):
            return self(value)
        return f"atan2({self(value.y)}, {self(value.x)})"


def _name(component: Component) -> str:
    match component:
        case Coordinate(axis=axis):
            return axis.name.lower()
        case Heading(axis=axis, planar=planar):
            return "phi" if planar else f"alpha_{axis.name.lower()}"
        case EulerAngle(symbol=symbol):
            return str(symbol.name)
