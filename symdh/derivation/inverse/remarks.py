"""What is said of a solution: its branches by name, and where it leaves the unknown free."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from symdh.derivation.blocks import Block, EntrySteps, Inline, Paragraph
from symdh.derivation.inverse.formulas import listed
from symdh.derivation.inverse.singular import around, lined_up_about, pair_that_serves
from symdh.derivation.inverse.telling import Telling
from symdh.kinematics.inverse.posture import Part
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.solution import Rule
from symdh.notation.nodes import Generic

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


def free(telling: Telling, *parts: Expr) -> list[Block]:
    """Say when the angle is free: where all parts of ``A s + B c + C`` are zero.

    Nothing is said where that depends on the arm's lengths alone.
    """
    ring, write = telling.writer.form.ring, telling.writer.expression
    a, b, c = telling.step.coefficients
    if (ring.is_constant(a) and ring.is_constant(b)) or (len(parts) > 2 and ring.is_constant(c)):
        return []
    zero = listed([write(-x if x.could_extract_minus_sign() else x) for x in parts])
    both = "both" if len(parts) == 2 else "all"
    unknown = telling.writer.unknown(telling.step.unknown)
    text = (f" are {both} zero, ", unknown, " is free; ", *meaning_of_free(telling))
    return [Paragraph(("Where ", *zero, *text))]


def meaning_of_free(telling: Telling) -> tuple[Inline, ...]:
    """Say what a free angle means for the arm."""
    form = telling.writer.form
    moving, unknown = form.arm.moving, telling.step.unknown
    kept = "it may keep the value that it has."
    rows = [row for row, _ in form.ring.forms[unknown]]
    if rows == [moving[0]] and len(moving) > 1 and _of_position(telling):
        point = Generic("w" if form.arm.is_shifted else "p")
        return (
            *("then the point ", point, f" lies on the axis of joint {rows[0]}, turning about it "),
            f"changes nothing, and {kept}",
        )
    both = lined_up_about(form, rows[-1])
    if form.task.with_orientation and both is not None:
        how = "in line" if set(both) <= set(form.structure.wrist or ()) else "parallel"
        return (
            f"then the axes of joints {both[0]} and {both[1]} are {how}, only the sum or the "
            "difference of the angles about them is determined, and this one may keep the value "
            "that it has.",
        )
    if _of_position(telling):
        return (f"then turning it does not move the point that is compared, and {kept}",)
    return (kept,)


def nothing_said(telling: Telling, where: Sequence[Inline]) -> list[Block]:
    """Say what holds where a pair of equations does not give the angle.

    Parameters
    ----------
    telling : Telling
    where : sequence of Inline
        The main clause: where the pair fails.
    """
    writer, step = telling.writer, telling.step
    unknown = writer.unknown(step.unknown)
    what: list[Inline] = list(where)
    middle = _middle(telling)
    if middle is not None:
        what.append(f": the axes of joints {middle[0]} and {middle[1]} are parallel")
    other = pair_that_serves(step, writer.form)
    if other is not None:
        first, second = (
            tuple(writer.form.ring.expression(part) for part in linear)
            for linear in (other[:3], other[3:])
        )
        s, c = telling.trigonometric()
        rows = telling.rows((first, second), s, c)
        return [
            Paragraph((*what, "; there ", unknown, " follows from another pair of entries:")),
            EntrySteps(rows),
        ]
    if step.alternatives and not _of_position(telling):
        text = ". Another pair of entries may serve there; where none does, "
        return [Paragraph((*what, text, unknown, " is free: ", *meaning_of_free(telling)))]
    return [Paragraph((*what, " and ", unknown, " is free; ", *meaning_of_free(telling)))]


def empty_where(telling: Telling, factor: Element) -> list[Block]:
    """Say where one equation says nothing: where what stands before the unknown is zero."""
    writer, ring = telling.writer, telling.writer.form.ring
    if ring.is_constant(factor):
        return []
    if len(factor) == 1:  # lengths are not zero
        powers = (0 if k in ring.first_lengths else power for k, power in enumerate(factor.LM))
        factor = ring.ring.from_dict({tuple(powers): ring.ring.domain.one})
    shown = writer.element(-factor if writer.is_negative(factor) else factor)
    other = "; there another entry may." if telling.step.alternatives else "."
    unknown = writer.unknown(telling.step.unknown)
    return [Paragraph(("Where ", shown, " is zero, this says nothing of ", unknown, other))]


def _middle(telling: Telling) -> tuple[int, int] | None:
    """Return the joints whose axes are parallel where the sine or cosine before the angle is 0."""
    ring = telling.writer.form.ring
    a_1, b_1, _, a_2, b_2, _ = telling.step.coefficients
    determinant = a_1 * b_2 - a_2 * b_1
    used = {k for powers in determinant for k, power in enumerate(powers) if power}
    turning = [k for k in used if k not in ring.first_lengths]
    if len(determinant) != 1 or len(turning) != 1 or turning[0] >= 2 * len(ring.forms):
        return None
    return around(telling.writer.form, turning[0])


def _of_position(telling: Telling) -> bool:
    """Say whether entries of the position alone were compared."""
    sources = [used.equation.source for used in telling.step.equations]
    columns = {column for source in sources for _, column in source.entries}
    return columns == {_POSITION} and all(source.entries for source in sources)


def stretched(telling: Telling) -> str:
    """Say what it means for an elbow that both values are one."""
    branching = telling.writer.branches.of(telling.step.unknown)
    feature = None if branching is None else branching.feature
    bent = feature is not None and feature.part is Part.ELBOW
    return ": the arm is stretched out or folded" if bent else ""
