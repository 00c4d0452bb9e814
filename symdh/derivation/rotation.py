"""Chapters: rotations composed one after another, the result, and a point that is carried along."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Integer

from symdh.derivation.attitude import Attitude, chapters
from symdh.derivation.blocks import (
    Block,
    Chapter,
    Document,
    EntryStep,
    EntrySteps,
    NamedMatrix,
    Paragraph,
    Text,
)
from symdh.derivation.legend import legend
from symdh.derivation.style import Style
from symdh.kinematics.rotation import (
    About,
    Composition,
    EulerSequence,
    RotationResult,
    Turned,
    numbers_of,
)
from symdh.motion import Word, rotation
from symdh.notation.nodes import (
    Equation,
    Generic,
    Juxtaposed,
    Matrix,
    Node,
    Operator,
    Product,
    Rounded,
    Tuple,
    Unit,
)
from symdh.notation.numbers import figures
from symdh.table.amounts import digits_of

R = Generic("R")

#: What double precision may leave of a rotation that was typed exactly.
_ROUNDING = 1e-14


def rotation_document(result: RotationResult, sequences: Sequence[EulerSequence]) -> Document:
    """Return the document on one rotation.

    Parameters
    ----------
    result : RotationResult
    sequences : sequence of EulerSequence
        Those whose formulas are printed.
    """
    style = Style(result.robot)
    parts = []
    if result.composition is not None:
        parts.append(_composing(style, result.composition))
    parts.append(_matrix(style, result))
    if result.point is not None and result.moved is not None:
        parts.append(_point(style, result, result.point, result.moved))
    attitude = Attitude(style, result.matrix, result.word, result.numbers)
    parts += chapters(attitude, sequences)
    title = result.robot.title or (result.robot.name if result.frames else "Rotations")
    return Document(title, (_subtitle(result),), tuple(parts))


def _subtitle(result: RotationResult) -> str:
    if result.composition is not None:
        return "Rotations about moving and fixed axes, composed step by step"
    if result.frames is not None:
        return f"The orientation of frame {result.frames[1]} in frame {result.frames[0]}"
    return "A rotation matrix and what it says"


def _composing(style: Style, composition: Composition) -> Chapter:
    """Return the chapter that multiplies the rotations in the order in which they happen."""
    blocks: list[Block] = [
        Paragraph(
            (
                "At first the axes of the body lie along the fixed ones. A rotation about an axis "
                "of the body is read in the frame that the body has reached, so it is multiplied "
                "on the right; one about a fixed axis is read in the fixed frame, so it turns all "
                "that was done before and is multiplied on the left.",
            )
        )
    ]
    introduced = legend(style, [style.notation.matrix(composition.matrix)])
    if introduced is not None:
        blocks.append(introduced)
    for number, turned in enumerate(composition.steps, start=1):
        blocks += _step(style, number, turned)
    if len(composition.steps) > 1:
        operators = Juxtaposed(style_operators(style, composition.word))
        blocks.append(Paragraph(("All together: ", Equation((R, operators)), ".")))
    return Chapter("The rotations one by one", tuple(blocks))


def style_operators(style: Style, word: Word) -> tuple[Node, ...]:
    """Return rotations as operators ``R_x(45 deg)``; a zero angle is shown as well."""
    return tuple(
        Operator(each.kind, each.axis, style.notation.angle(each.amount), craig=True)
        for each in word
    )


def _step(style: Style, number: int, turned: Turned) -> list[Block]:
    step = turned.step
    (operator,) = style_operators(style, (rotation(step.axis, step.angle),))
    letter = Generic(step.axis.name.lower())
    body = step.about is About.BODY
    own = "the body's own" if body else "the fixed"
    after, before = Generic("R", str(number)), Generic("R", str(number - 1))
    if number == 1:
        side = "nothing was done before, so both sides are alike"
        factors: tuple[Node, ...] = (operator,)
    else:
        side = "on the right" if body else "on the left"
        factors = (before, operator) if body else (operator, before)
    told: Text = (
        f"Step {number}: by ",
        style.notation.angle(step.angle),
        *(f" about {own} ", letter, f" axis: {side}."),
    )
    names = (after, Juxtaposed(factors))
    return [Paragraph(told), NamedMatrix(names, style.notation.matrix(turned.matrix))]


def _matrix(style: Style, result: RotationResult) -> Chapter:
    letters = [Generic(letter) for letter in "nsa"]
    blocks: list[Block] = []
    if result.matrix is not None:
        written = style.notation.matrix(result.matrix)
        blocks.append(NamedMatrix((R,), written))
        introduced = legend(style, [written]) if result.composition is None else None
        if introduced is not None:
            blocks.append(introduced)
    blocks.append(
        Paragraph(
            (
                *("The columns ", letters[0], ", ", letters[1], " and ", letters[2], " of ", R),
                " are the body's x, y and z axis, seen from the fixed frame.",
            )
        )
    )
    if result.numbers is not None and not _is_plain(result):
        rows = tuple(tuple(Rounded(figures(x)) for x in row) for row in result.numbers.matrix)
        blocks += [Paragraph(("In numbers:",)), NamedMatrix((R,), Matrix(rows))]
    missed = _deviation(result)
    if missed > _ROUNDING:
        told = f"The numbers given miss a rotation by up to {figures(missed)}; what follows is "
        blocks.append(Paragraph((told + "about the nearest rotation.",)))
    return Chapter("The rotation matrix", tuple(blocks))


def _is_plain(result: RotationResult) -> bool:
    """Say whether the exact matrix reads like numbers already."""
    return result.matrix is not None and all(entry.is_Integer for entry in result.matrix)


def _deviation(result: RotationResult) -> float:
    """Return by how much the numbers of a given matrix differ from the rotation described."""
    typed = result.composition is None and result.frames is None
    if not typed or result.numbers is None or result.matrix is None:
        return 0.0
    given = numbers_of(result.matrix.xreplace(dict(result.robot.values)))
    near = result.numbers.matrix
    return max(abs(given[r][c] - near[r][c]) for r in range(3) for c in range(3))


def _point(
    style: Style, result: RotationResult, point: Sequence[Expr], moved: Sequence[Expr]
) -> Chapter:
    # Decimal where the point was typed so: 0.1, not a tenth.
    typed = any(x.is_Rational and not x.is_Integer for x in point)
    notation = style.figures if typed else style.notation
    before = Tuple(tuple(notation.write(x) for x in point))
    p, unit = Generic("p"), result.robot.units.length
    steps = []
    for axis, exact in zip("xyz", moved, strict=True):
        forms = [notation.write(exact)]
        number = exact.xreplace(dict(result.robot.values))
        if not number.free_symbols and not exact.is_Integer:
            forms.append(Rounded(figures(_float(number))))
        if unit is not None and not number.free_symbols:
            forms[-1] = Product((forms[-1], Unit(unit.value)))
        steps.append(EntryStep(Generic("p", axis), tuple(forms), None))
    lead: Text = (
        *("In the body the point is at ", before, " for good, and so it was in the fixed frame "),
        *(
            "before the first rotation. Afterwards it is at ",
            Equation((p, Juxtaposed((R, before)))),
        ),
        " in the fixed frame:",
    )
    return Chapter("The point", (Paragraph(lead), EntrySteps(tuple(steps))))


def _float(number: Expr) -> float:
    value = digits_of(number, 30)
    return 0.0 if abs(value) < Integer(10) ** -25 else float(value)
