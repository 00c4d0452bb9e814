"""The equations of a slide."""

from __future__ import annotations

from sympy import Integer, sqrt

from symdh.derivation.blocks import Block, Display, EntryStep, Paragraph
from symdh.derivation.inverse.formulas import equation
from symdh.derivation.inverse.remarks import empty_where
from symdh.derivation.inverse.telling import Telling, solution
from symdh.notation.nodes import Fraction, Negative, Node, Sum


def slide(telling: Telling) -> list[Block]:
    """Solve ``A q + C = 0``."""
    writer = telling.writer
    a, c = telling.step.coefficients
    row = EntryStep(writer.unknown(telling.step.unknown), (writer.quotient_of(-c, a),), None)
    blocks = [] if telling.has_written(row) else solution(row)
    return [*blocks, *empty_where(telling, a)]


def slide_square(telling: Telling) -> list[Block]:
    """Solve ``A q^2 + B q + C = 0``."""
    writer = telling.writer
    a, b, c = telling.linear(telling.step.coefficients)
    q = writer.form.ring.unknown_expression(telling.step.unknown)
    write = writer.expression
    values: list[Node]
    if b.is_zero:
        root = write(sqrt(-c / a))
        values = [root, Negative(root)]
    else:
        root = write(sqrt(b**2 - 4 * a * c))
        tops = (Sum((write(-b), root)), Sum((write(-b), Negative(root))))
        values = [Fraction(top, write(2 * a)) for top in tops]
    rows = [
        EntryStep(writer.unknown(telling.step.unknown, str(k)), (value,), None)
        for k, value in enumerate(values, start=1)
    ]
    return [
        *telling.introduced(),
        Paragraph(("So",)),
        Display(equation(write(a * q**2 + b * q + c), write(Integer(0)))),
        *solution(*rows),
        Paragraph(("Where the radicand is negative, the goal is out of reach.",)),
    ]
