"""A robot -> the program of its inverse kinematics, or why it has none."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Expr, Symbol

from symdh.codegen.inverse.found import Missing, found_form
from symdh.codegen.inverse.placing import placed
from symdh.codegen.inverse.program import Program
from symdh.codegen.inverse.steps import lower_steps
from symdh.codegen.names import comment_text
from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.robot import JointType, Robot


def inverse_program(
    robot: Robot,
    values: Mapping[Symbol, Expr] | None = None,
    locked: tuple[Symbol, ...] = (),
) -> Program | Missing:
    """Build the program of a robot's inverse kinematics, base to tool.

    Parameters
    ----------
    robot : Robot
    values : mapping of Symbol to Expr, optional
        Exact numbers to put in for some parameters.
    locked : tuple of Symbol
        Joint variables that are held at what the seed says.

    Returns
    -------
    Program or Missing

    Raises
    ------
    UnsupportedError
        When a variable to be locked is none of the robot's.
    """
    form = found_form(robot, locked)
    if isinstance(form, Missing):
        return form
    try:
        return _program(form, dict(values or {}))
    except UnsupportedError as error:
        return Missing(comment_text(str(error)))


def _program(form: ClosedForm, values: Mapping[Symbol, Expr]) -> Program:
    lowered = lower_steps(form, values)
    robot = form.arm.given
    held = set(form.arm.locked)
    turning = {j.variable for j in robot.joints if j.type is JointType.REVOLUTE}
    return Program(
        statements=placed(lowered),
        goal=lowered.letters.goal,
        reach=lowered.letters.reach,
        axes=form.task.axes,
        with_orientation=form.task.with_orientation,
        turning=tuple(variable in turning for variable in robot.variables),
        free=tuple(k for k, variable in enumerate(robot.variables) if variable not in held),
        most_solutions=form.most_solutions,
        description=form.task.description,
    )
