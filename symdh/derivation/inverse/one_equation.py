"""One equation in the sine and the cosine of an angle."""

from __future__ import annotations

from sympy import Integer, atan2, pi, sqrt

from symdh.derivation.blocks import Block, Display, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.formulas import equation, plus
from symdh.derivation.inverse.remarks import free, stretched
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
    ]


def sine_cosine(telling: Telling) -> list[Block]:
    """Solve ``A s + B c + C = 0`` by one angle psi."""
    a, b, c = telling.linear(telling.step.coefficients)
    known = -c
    writer = telling.writer
    s, cosine = telling.trigonometric()
    rho, psi = writer.letter("rho"), writer.letter("psi")
    write = writer.expression
    unknown = writer.unknown(telling.step.unknown)
    inner = Sum((unknown, Negative(write(psi))))
    root = sqrt(rho**2 - known**2)
    rows = [
        EntryStep(
            writer.unknown(telling.step.unknown, str(k)),
            (plus(write(psi), write(atan2(root, known, evaluate=False)), sign),),
            None,
        )
        for k, sign in ((1, 1), (2, -1))
    ]
    return [
        *telling.restated(equation(write(a * s + b * cosine), write(known))),
        *telling.polar(rho, psi, a, b),
        Paragraph(("the left side is one cosine:",)),
        Display(equation(Product((write(rho), Call("cos", (inner,)))), write(known))),
        *solution(*rows),
        Paragraph(
            (
                *("Where ", write(rho**2), " is less than ", write(known**2)),
                *(", the goal is out of reach; where they are equal, both solutions are one"),
                *(stretched(telling), "."),
            )
        ),
        *free(telling, a, b),
    ]
