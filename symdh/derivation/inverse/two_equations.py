"""Two equations in the sine and the cosine of an angle."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Mul, atan2, cos, sin

from symdh.derivation.blocks import Block, EntryStep, EntrySteps, Inline, Paragraph
from symdh.derivation.inverse.formulas import plus
from symdh.derivation.inverse.remarks import nothing_said
from symdh.derivation.inverse.telling import LONG, SHORT, Telling, solution
from symdh.kinematics.inverse.ring import Element
from symdh.notation.nodes import Call, Negative, Product, Sum
from symdh.notation.writing import weight

#: A known part that has no more to read than this needs no letter before rho and psi name it.
_PLAIN = 3
#: Nor one that stands over a single sine or cosine.
_PLAIN_ALONE = 5


def pair(telling: Telling) -> list[Block]:
    """Solve two linear equations in the sine and the cosine."""
    apart = _apart(telling)
    if apart is not None:
        return _both_known(telling, *apart)
    first, second = telling.step.coefficients[:3], telling.step.coefficients[3:]
    rotated = _as_rotation(first, second)
    if rotated is not None:
        return _rotation(telling, rotated)
    longest = SHORT if (first[0] and first[1]) or (second[0] and second[1]) else _PLAIN_ALONE
    return _cramer(telling, telling.linear(first, longest), telling.linear(second, longest))


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


def _rotation(telling: Telling, rotated: Sequence[Element]) -> list[Block]:
    """Solve ``x = k_1 c - k_2 s`` and ``y = k_1 s + k_2 c`` by one angle psi."""
    writer = telling.writer
    k_1, k_2 = (writer.short(part, telling.new, _PLAIN) for part in rotated[:2])
    x, y = (writer.short(part, telling.new) for part in rotated[2:])
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
        lead = "the two equations become" if blocks else "Collected, they are"
        blocks += [Paragraph((lead,)), EntrySteps(rows)]
    return [
        *blocks,
        *telling.polar(rho, psi, k_1, k_2),
        Paragraph(("and the two equations become",)),
        EntrySteps(turned),
        Paragraph(
            (
                "Divided by each other, they give the tangent of ",
                inner,
                ". Hence",
            )
        ),
        EntrySteps((EntryStep(unknown, (difference,), None),)),
        *nothing_said(telling, ("Where ", write(rho), " is zero, both equations are empty")),
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
        lead = again if telling.is_told else "the two equations become" if told else "Collected,"
        blocks += [Paragraph((lead,)), EntrySteps(rows)]
    blocks += [
        Paragraph(("So" if apart else "Two linear equations have the solution",)),
        EntrySteps(solved),
        *solution(EntryStep(unknown, (write(atan2(s, c, evaluate=False)),), None)),
    ]
    if not _never_vanishes(telling):
        shown = _without_sign(determinant)
        text = write(shown)
        what: Inline = text if weight(text) <= LONG else "the determinant of the two"
        if _vanish_together(telling):
            blocks += nothing_said(telling, ("Where ", what, " is zero, this pair says nothing"))
        else:
            tail = "; there another pair may." if telling.step.alternatives else "."
            where = ("Where ", what, " is zero, this pair does not settle ", unknown, tail)
            blocks.append(Paragraph(where))
    return blocks


def _vanish_together(telling: Telling) -> bool:
    """Say whether all coefficients of sine and cosine are zero where the determinant is."""
    ring = telling.writer.form.ring
    lengths = ring.first_lengths
    factors = [
        {k for powers in part for k, power in enumerate(powers) if power and k not in lengths}
        for place, part in enumerate(telling.step.coefficients)
        if part and place % 3 < 2
    ]
    single = all(len(part) == 1 for part in telling.step.coefficients[:2] if part)
    return single and all(each == factors[0] for each in factors)


def _never_vanishes(telling: Telling) -> bool:
    a_1, b_1, _, a_2, b_2, _ = telling.step.coefficients
    return telling.writer.form.ring.is_constant(a_1 * b_2 - a_2 * b_1)


def _without_sign(determinant: Expr) -> Expr:
    """Return what is zero where a determinant is, without sign, lengths and powers."""
    if determinant.could_extract_minus_sign():
        determinant = -determinant
    factors = [f.base if f.is_Pow else f for f in Mul.make_args(determinant)]
    turning = [f for f in factors if f.has(cos, sin) or f.is_Add]
    return Mul(*turning) if turning and len(factors) > 1 else Mul(*factors)


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
