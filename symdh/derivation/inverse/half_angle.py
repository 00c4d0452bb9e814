"""One of two angles is eliminated; the other is a root in the tangent of its half."""

from __future__ import annotations

from sympy import Add, Expr, Integer

from symdh.derivation.blocks import Block, EntryStep, EntrySteps, Paragraph
from symdh.derivation.inverse.formulas import equation, listed
from symdh.derivation.inverse.telling import Telling
from symdh.kinematics.inverse.ring import Element
from symdh.notation.nodes import (
    Call,
    Fraction,
    Generic,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Sum,
)

_T = Generic("t")
_T_SQUARED = Power(_T, Integer(2))
_UNIT = Number(Integer(1))
_QUOTIENT_C = Fraction(Sum((_UNIT, Negative(_T_SQUARED))), Sum((_UNIT, _T_SQUARED)))
_QUOTIENT_S = Fraction(Product((Number(Integer(2)), _T)), Sum((_UNIT, _T_SQUARED)))


def half_angle(telling: Telling) -> list[Block]:
    """Get rid of one of two angles and solve for the tangent of half the other."""
    step, writer = telling.step, telling.writer
    write = writer.expression
    y = step.unknown
    half = Fraction(writer.unknown(y), write(Integer(2)))
    degree = "quartic" if step.branches == 4 else f"polynomial of degree {step.branches}"
    return [
        *([] if step.eliminated is None else _eliminated(telling, step.eliminated)),
        Paragraph(
            (
                *("With ", equation(_T, Call("tan", (half,))), ", "),
                *(equation(write(writer.cosine(y)), _QUOTIENT_C), " and "),
                *(equation(write(writer.sine(y)), _QUOTIENT_S), ", this is a "),
                *(f"{degree} in ", _T, ". Each real root gives one value "),
                equation(writer.unknown(y), Product((write(Integer(2)), Call("atan", (_T,))))),
                "; they are called ",
                *listed([writer.unknown(y, str(k + 1)) for k in range(step.branches)]),
                ".",
            )
        ),
    ]


def _eliminated(telling: Telling, x: int) -> list[Block]:
    """Eliminate an angle of two equations."""
    step, writer = telling.step, telling.writer
    write = writer.expression
    y = step.unknown
    a_1, b_1, c_1 = telling.linear(step.coefficients[:3])
    a_2, b_2, c_2 = telling.linear(step.coefficients[3:])
    rows = telling.rows(((a_1, b_1, c_1), (a_2, b_2, c_2)), writer.sine(x), writer.cosine(x))
    new = list(telling.new)
    told = telling.introduced()
    if step.scales:
        l_1, l_2 = (writer.form.ring.expression(scale) for scale in step.scales)
        left: Node = Sum(tuple(writer.quotient(c**2, s**2) for c, s in ((c_1, l_1), (c_2, l_2))))
        p, q = (
            _divided(telling, element, a, l_1)
            for element, a in zip(step.coefficients, (a_1, b_1), strict=False)
        )
        right = write(p**2 + q**2)
        why = (
            *("The left sides are ", write(l_1), " and ", write(l_2)),
            " times the components of one vector along perpendicular directions. ",
            "Divided by these, squared and added, they give the square of its length, and ",
            writer.unknown(x),
            " drops out:",
        )
    else:
        left = write((b_1 * c_2 - b_2 * c_1) ** 2 + (a_2 * c_1 - a_1 * c_2) ** 2)
        right = write((a_1 * b_2 - a_2 * b_1) ** 2)
        why = (
            *("Solved for the sine and the cosine of ", writer.unknown(x)),
            *(", whose squares add up to 1, these give"),
        )
    both = (*("two equations that hold ", writer.unknown(x), " and ", writer.unknown(y)), " alone:")
    if told:
        what = "a letter for what" if len(new) == 1 else "letters for what is known or"
        told[0] = Paragraph((f"With {what} holds ", writer.unknown(y), " as its only unknown,"))
        lead = Paragraph(("there are ", *both))
    else:
        lead = Paragraph(("These are ", *both))
    return [
        *told,
        lead,
        EntrySteps(rows),
        Paragraph(why),
        EntrySteps((EntryStep(left, (right,), None),)),
    ]


def _divided(telling: Telling, element: Element, name: Expr, by: Expr) -> Expr:
    """Divide a coefficient by a constant: term by term where it has no name."""
    whole = telling.writer.form.ring.expression(element)
    return name / by if name != whole else Add(*(term / by for term in Add.make_args(whole)))
