"""Where a pair of equations fails: which axes are parallel there, and which pair serves."""

from __future__ import annotations

import random
from math import pi

from symdh.kinematics.inverse.lines import are_parallel, joint_lines
from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.kinematics.inverse.solution import ClosedForm, Step
from symdh.robot import JointType


def around(form: ClosedForm, generator: int) -> tuple[int, int] | None:
    """Return the joints beside the one whose sine or cosine is zero, where their axes are parallel.

    Parameters
    ----------
    form : ClosedForm
    generator : int
        Of the cosine or the sine of an angle.

    Returns
    -------
    tuple of two int, or None
        None where the angle is a sum, or the axes beside it are not parallel then.
    """
    rows = form.ring.forms[generator // 2]
    if len(rows) != 1:
        return None
    row = rows[0][0]
    beside = _beside(form, row)
    angle = 0.0 if generator % 2 else pi / 2
    return beside if beside is not None and _parallel_at(form, row, angle, beside) else None


def lined_up_about(form: ClosedForm, row: int) -> tuple[int, int] | None:
    """Return a joint and the one two places on, or back, where the one between can align them."""
    moving = form.arm.moving
    place = moving.index(row)
    for between in (place + 1, place - 1):
        if not 0 <= between < len(moving):
            continue
        beside = _beside(form, moving[between])
        if beside is not None and any(
            _parallel_at(form, moving[between], angle, beside) for angle in (0.0, pi / 2)
        ):
            return beside
    return None


def _beside(form: ClosedForm, row: int) -> tuple[int, int] | None:
    """Return the joints before and behind one, if all three turn."""
    moving = form.arm.moving
    place = moving.index(row)
    if not 0 < place < len(moving) - 1:
        return None
    three = moving[place - 1 : place + 2]
    turning = all(form.arm.given.joints[k - 1].type is JointType.REVOLUTE for k in three)
    return (three[0], three[2]) if turning else None


def _parallel_at(form: ClosedForm, row: int, angle: float, beside: tuple[int, int]) -> bool:
    """Say whether the axes of two joints are parallel where the one between has an angle.

    They are not when it has another, so that its angle is what decides.
    """
    robot = form.arm.given
    drawn = random.Random(23)
    variable = robot.joints[row - 1].variable
    q = [drawn.uniform(0.4, 1.2) for _ in robot.variables]

    def parallel() -> bool:
        lines = {line.row: line for line in joint_lines(robot, q)}
        return are_parallel(lines[beside[0]], lines[beside[1]])

    assert variable is not None
    at_random = parallel()
    q[robot.variables.index(variable)] = angle
    return parallel() and not at_random


def pair_that_serves(step: Step, form: ClosedForm) -> tuple[Element, ...] | None:
    """Return another pair of equations that gives the angle where the pair of a step does not.

    Only one that surely does is returned: its determinant is made of lengths and angles, and is
    not zero where any factor of the step's own determinant is.
    """
    ring = form.ring
    own = _determinant(step.coefficients)
    factors = sorted(
        {k for powers in own for k, power in enumerate(powers) if power} - set(ring.first_lengths)
    )
    if len(own) != 1 or not factors or any(k >= 2 * len(ring.forms) for k in factors):
        return None
    for other in step.alternatives:
        determinant = ring.reduced(_determinant(other))
        if all(_is_left(ring, determinant, k) for k in factors):
            return other
    return None


def _determinant(pair: tuple[Element, ...]) -> Element:
    a_1, b_1, _, a_2, b_2, _ = pair
    return a_1 * b_2 - a_2 * b_1


def _is_left(ring: InverseRing, determinant: Element, factor: int) -> bool:
    """Say whether an element of lengths and angles is not zero where a sine or cosine is."""
    partner = factor ^ 1
    left: dict[tuple[int, ...], object] = {}
    angles = range(2 * len(ring.forms))
    for powers, coefficient in determinant.terms():
        used = {k for k, power in enumerate(powers) if power}
        if not used <= {*angles, *ring.first_lengths}:
            return False
        if not powers[factor]:
            rest = tuple(0 if k == partner else power for k, power in enumerate(powers))
            left[rest] = left.get(rest, 0) + coefficient
    return bool(ring.reduced(ring.ring.from_dict(left)))
