"""What is said of a solution: its branches by name, and where it leaves the unknown free."""

from __future__ import annotations

from sympy import Expr

from symdh.derivation.blocks import Block, Inline, Paragraph
from symdh.derivation.inverse.telling import Telling
from symdh.kinematics.inverse.posture import Part
from symdh.kinematics.inverse.solution import Rule
from symdh.robot import JointType

#: What is said of two values that the arm does not tell apart.
_WITHOUT_NAMES = {
    Rule.COSINE: "The first value is a positive angle, the second a negative one.",
    Rule.SINE: "The first value is at most 90 degrees from zero, the second farther.",
}
#: The column of the position in a matrix, from 0.
_POSITION = 3


def named_branches(telling: Telling) -> list[Block]:
    """Name the branches."""
    branching = telling.writer.branches.of(telling.step.unknown)
    if branching is None:
        return []
    if branching.feature is None:
        text = _WITHOUT_NAMES.get(telling.step.rule)
        return [Paragraph((text,))] if text else []
    first, second = branching.feature.names
    if branching.names:
        text = f"The two values: (1) {branching.names[0]}, (2) {branching.names[1]}. "
    else:
        text = f"One of the two values gives {first}, the other {second}; which is which "
        text += "depends on the steps before. " if _settled(telling) else "depends on the goal. "
    text += branching.feature.meaning
    if telling.writer.branches.assumed:
        text += " Lengths are taken as positive."
    return [Paragraph((text,))]


def _settled(telling: Telling) -> bool:
    """Whether the names of the branches of all steps together do not depend on the goal."""
    return len(telling.writer.branches.together) == telling.writer.form.most_solutions


def free(telling: Telling, a: Expr, b: Expr) -> list[Block]:
    """Say when the angle is free, unless that depends on the arm's lengths alone."""
    ring, write = telling.writer.form.ring, telling.writer.expression
    if all(ring.is_constant(element) for element in telling.step.coefficients[:2]):
        return []
    a, b = (-x if x.could_extract_minus_sign() else x for x in (a, b))
    unknown = telling.writer.unknown(telling.step.unknown)
    text: tuple[Inline, ...] = (
        *("Where ", write(a), " and ", write(b), " are both zero, ", unknown),
        *(" is free; ", meaning_of_free(telling)),
    )
    return [Paragraph(text)]


def meaning_of_free(telling: Telling) -> str:
    """Say what a free angle means for the arm."""
    form = telling.writer.form
    moving, unknown = form.arm.moving, telling.step.unknown
    if not form.ring.is_angle(unknown):
        return "it keeps the value that it has."
    rows = {row for row, _ in form.ring.forms[unknown]}
    lead = form.arm.robot.joints[moving[0] - 1].type is JointType.REVOLUTE
    if rows == {moving[0]} and lead and len(moving) > 1:
        return (
            "then the point that the other joints place lies on the axis of this one, turning "
            "it changes nothing, and it keeps the value that it has."
        )
    branching = telling.writer.branches.of(unknown)
    feature = None if branching is None else branching.feature
    in_hand = rows <= set(moving[-3:]) and len(moving) >= 3
    if form.task.with_orientation and (in_hand or (feature and feature.part is Part.WRIST)):
        return (
            "then two axes of the hand are in line, only the sum or the difference of their "
            "angles is determined, and this one keeps the value that it has."
        )
    sources = [used.equation.source for used in telling.step.equations]
    columns = {column for source in sources for _, column in source.entries}
    if columns == {_POSITION} and all(source.entries for source in sources):
        return (
            "then turning it does not move the point that is compared, and it keeps the value "
            "that it has."
        )
    return "it keeps the value that it has."


def stretched(telling: Telling) -> str:
    """Say what it means for an elbow that both values are one."""
    branching = telling.writer.branches.of(telling.step.unknown)
    feature = None if branching is None else branching.feature
    bent = feature is not None and feature.part is Part.ELBOW
    return ": the arm is stretched out or folded" if bent else ""
