"""The steps of an inverse kinematics solution, told one by one."""

from __future__ import annotations

from collections.abc import Callable

from symdh.derivation.blocks import Block, Chapter
from symdh.derivation.inverse.half_angle import half_angle
from symdh.derivation.inverse.known_parts import known_sum, named_parts
from symdh.derivation.inverse.names import Worked, Writer
from symdh.derivation.inverse.one_equation import arc, ratio, sine_cosine
from symdh.derivation.inverse.origin import origin
from symdh.derivation.inverse.remarks import named_branches
from symdh.derivation.inverse.slides import slide, slide_square
from symdh.derivation.inverse.telling import Telling
from symdh.derivation.inverse.two_equations import pair
from symdh.kinematics.inverse.solution import Rule, Step


def step_chapter(writer: Writer, step: Step) -> Chapter:
    """Return the chapter on one step."""
    title = _title(writer, step)
    blocks = _blocks(Telling(writer, title, step))
    if not step.definitions:
        ring, unknown = writer.form.ring, step.unknown
        expression, turns = ring.unknown_expression(unknown), ring.is_angle(unknown)
        writer.worked.append(Worked(title, writer.unknown(unknown), expression, turns))
    return Chapter(f"{title[0].upper()}{title[1:]}", tuple(blocks))


def _title(writer: Writer, step: Step) -> str:
    if step.definitions:
        return "what is known so far"
    ring = writer.form.ring
    if not ring.is_angle(step.unknown):
        row = ring.slides[step.unknown - len(ring.forms)]
        return f"joint {row}"
    rows = [row for row, _ in ring.forms[step.unknown]]
    if len(rows) == 1:
        return f"joint {rows[0]}"
    listed = f"{', '.join(map(str, rows[:-1]))} and {rows[-1]}"
    return f"the angles of joints {listed} together"


#: How a rule is told; names and sums of what is known are told otherwise.
RULES: dict[Rule, Callable[[Telling], list[Block]]] = {
    Rule.RATIO: ratio,
    Rule.SINE: arc,
    Rule.COSINE: arc,
    Rule.SINE_COSINE: sine_cosine,
    Rule.PAIR: pair,
    Rule.SLIDE: slide,
    Rule.SLIDE_SQUARE: slide_square,
    Rule.HALF_ANGLE: half_angle,
}


def _blocks(telling: Telling) -> list[Block]:
    """Return all that is said of a step."""
    step = telling.step
    if step.definitions:
        return named_parts(telling)
    if step.rule is Rule.SUM:
        return known_sum(telling)
    told = [] if telling.is_told else origin(telling)
    return [*told, *RULES[step.rule](telling), *named_branches(telling)]
