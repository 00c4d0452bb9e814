"""Two equations in the sine and the cosine of an angle."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, atan2, cos, sin

from symdh.derivation.blocks import Block, EntryStep, EntrySteps, Inline, Paragraph
from symdh.derivation.inverse.formulas import plus
from symdh.derivation.inverse.remarks import meaning_of_free
from symdh.derivation.inverse.telling import LONG, SHORT, Telling, solution
from symdh.kinematics.inverse.ring import Element
from symdh.notation.nodes import Call, Negative, Product, Sum
from symdh.notation.writing import weight


def pair(telling: Telling) -> list[Block]:
    """Solve two linear equations in the sine and the cosine."""
    apart = _apart(telling)
    if apart is not None:
        return _both_known(telling, *apart)
    first, second = telling.step.coefficients[:3], telling.step.coefficients[3:]
    rotated = _as_rotation(first, second)
    if rotated is not None:
        return _rotation(telling, *(telling.writer.short(part, telling.new) for part in rotated))
    return _cramer(telling, telling.linear(first), telling.linear(second))


def _apart(telling: Telling) -> tuple[Element, Element] | None:
    """Return the sine and the cosine where each equation gives one of them as it stands."""
    a_1, b_1, c_1, a_2, b_2, c_2 = telling.step.coefficients
    one = telling.writer.form.ring.one
    if not b_1 and not a_2 and a_1 in (one, -one) and b_2 in (one, -one):
        return -a_1 * c_1, -b_2 * c_2
    if not a_1 and not b_2 and a_2 in (one, -one) and b_1 in (one, -one):
        return -a_2 * c_2, -b_1 * c_1
    return None


def _both_known(telling: Telling, sine: Element, cosine: Element) -> list[Block]:
    """Give an angle whose sine and cosine stand there."""
    writer = telling.writer
    s, c = telling.trigonometric()
    write = writer.expression
    values = writer.element(sine), writer.element(cosine)
    rows = [
        EntryStep(write(name), (value,), None) for name, value in zip((s, c), values, strict=True)
    ]
    angle = [write(atan2(s, c, evaluate=False))]
    if all(weight(value) <= SHORT for value in values):
        angle.append(Call("atan2", values))
    blocks: list[Block] = []
    if not telling.stand_there(rows):
        blocks = [Paragraph(("So",)), EntrySteps(tuple(rows))]
    unknown = writer.unknown(telling.step.unknown)
    return [*blocks, *solution(EntryStep(unknown, tuple(angle), None))]


def _rotation(telling: Telling, k_1: Expr, k_2: Expr, x: Expr, y: Expr) -> list[Block]:
    """Solve ``x = k_1 c - k_2 s`` and ``y = k_1 s + k_2 c`` by one angle psi."""
    writer = telling.writer
    s, c = telling.trigonometric()
    write = writer.expression
    rho, psi = writer.letter("rho"), writer.letter("psi")
    unknown = writer.unknown(telling.step.unknown)
    inner = Sum((write(psi), Negative(unknown)))
    rows = (
        EntryStep(write(x), (write(k_1 * c - k_2 * s),), None),
        EntryStep(write(y), (write(k_1 * s + k_2 * c),), None),
    )
    turned = (
        EntryStep(write(x), (Product((write(rho), Call("sin", (inner,)))),), None),
        EntryStep(write(y), (Product((write(rho), Call("cos", (inner,)))),), None),
    )
    difference = plus(write(psi), write(atan2(x, y, evaluate=False)), -1)
    blocks = telling.introduced()
    if not telling.stand_there(rows):
        blocks += [Paragraph(("these are" if blocks else "So",)), EntrySteps(rows)]
    return [
        *blocks,
        *telling.polar(rho, psi, k_1, k_2),
        Paragraph(("these are",)),
        EntrySteps(turned),
        *solution(EntryStep(unknown, (difference,), None)),
        Paragraph(
            (
                *("If ", write(rho), " is zero, both equations are empty and ", unknown),
                *(" is free; ", meaning_of_free(telling)),
            )
        ),
    ]


def _cramer(
    telling: Telling, first: tuple[Expr, Expr, Expr], second: tuple[Expr, Expr, Expr]
) -> list[Block]:
    writer = telling.writer
    write = writer.expression
    s, c = telling.trigonometric()
    (a_1, b_1, _), (a_2, b_2, _) = first, second
    unknown = writer.unknown(telling.step.unknown)
    determinant = a_1 * b_2 - a_2 * b_1
    rows = telling.rows((first, second), s, c)
    sine, cosine = _cramers_rule(first, second)
    solved = (
        EntryStep(write(s), (writer.quotient(*sine),), None),
        EntryStep(write(c), (writer.quotient(*cosine),), None),
    )
    told = telling.introduced()
    blocks: list[Block] = [*told]
    apart = any((b.is_zero and p.is_zero) for b, p in ((b_1, a_2), (b_2, a_1)))
    if not apart:
        again = "Of the same two equations all else is known now:"
        lead = again if telling.is_told else "these are" if told else "So"
        blocks += [Paragraph((lead,)), EntrySteps(rows)]
    blocks += [
        Paragraph(("So" if apart else "two linear equations, with the solution",)),
        EntrySteps(solved),
        *solution(EntryStep(unknown, (write(atan2(s, c, evaluate=False)),), None)),
    ]
    if determinant.could_extract_minus_sign():
        determinant = -determinant
    if determinant.is_Pow:
        determinant = determinant.base
    if determinant.atoms(cos, sin):
        shown = write(determinant)
        what: Inline = shown if weight(shown) <= LONG else "the determinant of the two"
        where: tuple[Inline, ...] = ("Where ", what, " is zero, this pair says nothing about ")
        rest: tuple[Inline, ...] = (unknown, " and it is free; ", meaning_of_free(telling))
        if telling.step.alternatives:
            rest = (unknown, "; there another pair of entries serves.")
        blocks.append(Paragraph((*where, *rest)))
    return blocks


def _as_rotation(
    first: Sequence[Element], second: Sequence[Element]
) -> tuple[Element, Element, Element, Element] | None:
    """Read two equations as ``x = k_1 c - k_2 s`` and ``y = k_1 s + k_2 c``, if they are that.

    Of the ways to do so the one with the fewest minus signs is taken.
    """
    found = []
    for one, other in ((first, second), (second, first)):
        for sign in (1, -1):
            for turn in (1, -1):
                a_1, b_1, c_1 = (sign * part for part in one)
                a_2, b_2, c_2 = (turn * part for part in other)
                if b_1 and b_2 and b_1 == a_2 and a_1 == -b_2:
                    found.append((b_1, b_2, -c_1, -c_2))
    return min(found, key=_minus_signs, default=None)


def _minus_signs(elements: Sequence[Element]) -> float:
    """Count the elements that have more minus signs than plus signs, and those that have both."""
    count = 0.0
    for element in elements:
        minus = sum(1 for coefficient in element.values() if coefficient < 0)
        count += 1 if 2 * minus > len(element) else minus / 100
    return count


def _cramers_rule(
    first: tuple[Expr, Expr, Expr], second: tuple[Expr, Expr, Expr]
) -> tuple[tuple[Expr, Expr], tuple[Expr, Expr]]:
    """Return numerator and denominator of the sine and of the cosine."""
    (a_1, b_1, c_1), (a_2, b_2, c_2) = first, second
    for (a, b, c), (p, q, r) in ((first, second), (second, first)):
        if b.is_zero and p.is_zero:
            return (-c, a), (-r, q)
    determinant = a_1 * b_2 - a_2 * b_1
    return (b_1 * c_2 - b_2 * c_1, determinant), (a_2 * c_1 - a_1 * c_2, determinant)
