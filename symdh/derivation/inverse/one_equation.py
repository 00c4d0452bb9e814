"""One equation in the sine and the cosine of an angle."""

from __future__ import annotations

from sympy import Expr, Integer, atan2, pi, sqrt

from symdh.derivation.blocks import Block, Display, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.formulas import equation, plus
from symdh.derivation.inverse.remarks import empty_where, free, stretched
from symdh.derivation.inverse.telling import Telling, solution
from symdh.kinematics.inverse.solution import Rule
from symdh.notation.nodes import Call, Negative, Product, Sum


def ratio(telling: Telling) -> list[Block]:
    """Solve ``A s + B c = 0``."""
    a, b, _ = telling.linear((*telling.step.coefficients[:2], telling.writer.form.ring.zero))
    s, c = telling.trigonometric()
    write = telling.writer.expression
    first = telling.writer.unknown(telling.step.unknown, "1")
    second = Sum((first, telling.writer.style.notation.angle(pi)))
    return [
        *telling.restated(equation(write(a * s + b * c), write(Integer(0)))),
        *solution(
            EntryStep(first, (write(atan2(-b, a)),), None),
            EntryStep(telling.writer.unknown(telling.step.unknown, "2"), (second,), None),
        ),
        *free(telling, a, b),
    ]


def arc(telling: Telling) -> list[Block]:
    """Solve ``A s + C = 0`` or ``B c + C = 0``: the sine or the cosine is known."""
    a, b, c = telling.step.coefficients
    writer = telling.writer
    s, cosine = telling.trigonometric()
    of_cosine = telling.step.rule is Rule.COSINE
    known = cosine if of_cosine else s
    value = writer.quotient_of(-c, b if of_cosine else a)
    other = sqrt(1 - known**2)
    pairs = [(other, known), (-other, known)] if of_cosine else [(known, other), (known, -other)]
    rows = [
        EntryStep(
            writer.unknown(telling.step.unknown, str(k)),
            (writer.expression(atan2(y, x, evaluate=False)),),
            None,
        )
        for k, (y, x) in enumerate(pairs, start=1)
    ]
    function = "arccosine" if of_cosine else "arcsine"
    shown = writer.expression(known)
    return [
        Paragraph(("So",)),
        EntrySteps((EntryStep(shown, (value,), None),)),
        *solution(*rows, lead=f"and the {function}, written with atan2, is"),
        Paragraph(
            (
                *("Where ", shown, " is ", writer.expression(Integer(1)), " or "),
                *(writer.expression(Integer(-1)), ", both solutions are one"),
                *(stretched(telling), "; beyond that the goal is out of reach."),
            )
        ),
        *empty_where(telling, b if of_cosine else a),
    ]


def sine_cosine(telling: Telling) -> list[Block]:
    """Solve ``A s + B c + C = 0`` by one angle psi."""
    writer, unknown_angle = telling.writer, telling.step.unknown
    a, b, known, swapped = _reduced(telling)
    s, cosine = telling.trigonometric()
    rho, psi = writer.letter("rho"), writer.letter("psi")
    write = writer.expression
    unknown = writer.unknown(unknown_angle)
    inner = Sum((unknown, Negative(write(psi))))
    root = sqrt(rho**2 - known**2)
    turned = write(atan2(root, known, evaluate=False))
    signs = (-1, 1) if swapped else (1, -1)
    rows = [
        EntryStep(writer.unknown(unknown_angle, str(k)), (plus(write(psi), turned, sign),), None)
        for k, sign in enumerate(signs, start=1)
    ]
    return [
        *telling.restated(equation(write(a * s + b * cosine), write(known))),
        *telling.polar(rho, psi, a, b),
        Paragraph(("and the left side becomes one cosine:",)),
        Display(equation(Product((write(rho), Call("cos", (inner,)))), write(known))),
        *solution(*rows),
        Paragraph(
            (
                *("Where ", write(rho**2), " is less than ", write(known**2)),
                *(", the goal is out of reach; where they are equal, both solutions are one"),
                *(stretched(telling), "."),
            )
        ),
        *free(telling, a, b, known),
    ]


def _reduced(telling: Telling) -> tuple[Expr, Expr, Expr, bool]:
    """Return A, B and -C with a common length divided out and what the goal gives positive.

    The last value says whether that turns the equation round, which swaps the two solutions.
    """
    writer, ring = telling.writer, telling.writer.form.ring
    a, b, c = telling.step.coefficients
    turned = writer.is_negative(-c)
    if turned:
        a, b, c = -a, -b, -c
    common = a.gcd(b)  # of rational numbers, so its first coefficient is positive
    lengths = len(common) == 1 and all(
        ring.letters[k].is_Symbol and k in ring.first_lengths
        for k, power in enumerate(common.LM)
        if power
    )
    if not lengths or common == ring.one:
        short_a, short_b, short_c = telling.linear((a, b, c))
        return short_a, short_b, -short_c, turned
    if writer.sign_of(common) < 0:
        turned = not turned
    short_a, short_b = (writer.short(part.exquo(common), telling.new) for part in (a, b))
    return short_a, short_b, writer.quotient_letter(-c, common, telling.new), turned
