"""Chapters: what an orientation is in Euler angles, axis and angle, and as a quaternion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, radians

from sympy import ImmutableMatrix, Integer, Rational, Symbol, pi, sqrt

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Display,
    EntryStep,
    EntrySteps,
    Inline,
    Paragraph,
    ParameterTable,
    Text,
)
from symdh.derivation.style import Style
from symdh.kinematics.rotation import (
    Atan2,
    Description,
    EulerAngles,
    EulerSequence,
    degenerate_formula,
    euler_formulas,
    read_off,
)
from symdh.motion import Word
from symdh.notation.nodes import (
    Call,
    Degrees,
    Equation,
    Fraction,
    Generic,
    Juxtaposed,
    Negative,
    Node,
    Number,
    Operator,
    Power,
    Product,
    Rounded,
    Sum,
    Tuple,
)
from symdh.notation.numbers import figures
from symdh.notation.writing import weight
from symdh.robot import AngleUnit, MotionKind

PHI, THETA, PSI = Generic("phi"), Generic("theta"), Generic("psi")
NAMES = (PHI, THETA, PSI)

#: The entries r_11 .. r_33 as letters, for formulas.
_R = ImmutableMatrix(3, 3, lambda r, c: Symbol(f"r{r + 1}{c + 1}", real=True))

_K_I, _K_J, _TWO = Generic("k", "i"), Generic("k", "j"), Number(Integer(2))
#: ``k_i^2 = (r_ii + 1)/2`` and ``r_ij = 2 k_i k_j``: the axis of a half turn.
_SQUARES = Equation(
    (
        Power(_K_I, Integer(2)),
        Fraction(Sum((Generic("r", "ii"), Number(Integer(1)))), _TWO),
    )
)
_PRODUCTS = Equation((Generic("r", "ij"), Product((_TWO, _K_I, _K_J))))

#: What there is to read in a formula with the entries put in, beyond which it says nothing.
_LONGEST = 16

_NEAR = 1e-6


@dataclass(frozen=True)
class Attitude:
    """An orientation to be described.

    Attributes
    ----------
    style : Style
        How its expressions and angles are written.
    matrix : ImmutableMatrix or None
        Exact, 3x3; None where its closed form would be too large.
    word : Word or None
        The rotations that made it, where they are known.
    numbers : Description or None
        None where symbols have no values.
    """

    style: Style
    matrix: ImmutableMatrix | None
    word: Word | None
    numbers: Description | None

    def angle(self, value: float) -> Node:
        """Return an angle in the unit of the document, rounded for people."""
        return rounded_angle(self.style, value)

    def number(self, value: float) -> Node:
        """Return a number rounded for people."""
        return Rounded(figures(value))

    @property
    def half_turn(self) -> Node:
        """180 degrees in the unit of the document."""
        return self.style.notation.angle(pi)


def rounded_angle(style: Style, value: float) -> Node:
    """Return an angle in the unit of a document, rounded for people."""
    if style.robot.units.angle is AngleUnit.RADIAN:
        return Rounded(figures(value))
    shown = Rational(figures(degrees(value)))
    node = Degrees(abs(shown))
    return Negative(node) if shown.is_negative else node


def chapters(attitude: Attitude, sequences: Sequence[EulerSequence]) -> tuple[Chapter, ...]:
    """Return the chapters on Euler angles, axis and angle, and the quaternion.

    Parameters
    ----------
    attitude : Attitude
    sequences : sequence of EulerSequence
        Those whose formulas are printed; the numbers of all 12 are printed in any case.
    """
    return (
        _euler_chapter(attitude, sequences),
        Chapter("Axis and angle", tuple(_axis_angle(attitude))),
        Chapter("Quaternion", tuple(_quaternion(attitude))),
    )


def _euler_chapter(attitude: Attitude, sequences: Sequence[EulerSequence]) -> Chapter:
    blocks: list[Block] = [
        Paragraph(
            (
                "Three rotations about the axes of the moving body, in the order in which they "
                "stand; about the fixed axes the same three in the opposite order. ",
                *("Here ", PHI, ", ", THETA, ", ", PSI, " are the first, second and third angle "),
                *(
                    "of each product, and ",
                    Generic("r", "ij"),
                    " the entries of ",
                    Generic("R"),
                    ".",
                ),
            )
        )
    ]
    for sequence in sequences:
        blocks += euler_blocks(attitude, sequence)
    if attitude.numbers is not None:
        blocks += _all_sequences(attitude, attitude.numbers)
    return Chapter("Euler angles", tuple(blocks))


def euler_blocks(attitude: Attitude, sequence: EulerSequence) -> list[Block]:
    """Return the formulas of one sequence, its angles, and its degenerate case."""
    blocks: list[Block] = [Display(product_of(sequence))]
    if sequence.name == "zyx":
        blocks.append(Paragraph((PHI, " is the yaw, ", THETA, " the pitch, ", PSI, " the roll.")))
    general = euler_formulas(_R, sequence)
    found = attitude.numbers.of(sequence) if attitude.numbers else None
    singular = found is not None and found.degenerate
    steps = []
    for place, (name, formula) in enumerate(zip(NAMES, general, strict=True)):
        forms = [atan2_node(attitude.style, formula)]
        if found is not None and not singular:
            forms.append(attitude.angle(found.angles[place]))
        elif found is None and attitude.matrix is not None:
            exact = euler_formulas(attitude.matrix, sequence)[place]
            forms += _short_enough([atan2_node(attitude.style, exact)])
        steps.append(EntryStep(name, tuple(forms), None))
    blocks.append(EntrySteps(tuple(steps)))
    if found is not None and not singular:
        blocks.append(_other_solution(attitude, found))
    if found is None and attitude.word is not None:
        blocks += _read_off(attitude, attitude.word, sequence)
    blocks.append(degenerate_case(attitude.style, sequence))
    if found is not None and singular:
        blocks.append(_degenerate_here(attitude, found))
    elif found is not None and found.margin < _NEAR:
        blocks.append(_nearly_degenerate(sequence))
    return blocks


def product_of(sequence: EulerSequence) -> Node:
    """Return ``R = R_z(phi) R_y(theta) R_x(psi)``."""
    operators = tuple(
        Operator(MotionKind.ROTATION, axis, name, craig=True)
        for axis, name in zip(sequence.axes, NAMES, strict=True)
    )
    return Equation((Generic("R"), Juxtaposed(operators)))


def atan2_node(style: Style, formula: Atan2) -> Node:
    """Return ``atan2(y, x)``."""
    return Call("atan2", (style.notation.write(formula.y), style.notation.write(formula.x)))


def degenerate_case(style: Style, sequence: EulerSequence) -> Paragraph:
    """Say where a sequence is singular, what is still determined, and what is chosen."""
    zero = Number(Integer(0))
    function = "sin" if sequence.proper else "cos"
    entry = Generic("r", f"{sequence.first + 1}{sequence.third + 1}")
    bounds = (0, 180) if sequence.proper else (90, -90)
    sums: list[Inline] = []
    for bound in bounds:
        angle = style.notation.angle(Rational(bound, 180) * pi)
        sign = sequence.remaining_sign(radians(bound))
        sums += [", " if sums else " ", _sum(sign), " at ", Equation((THETA, angle))]
    third = atan2_node(style, degenerate_formula(_R, sequence))
    return Paragraph(
        (
            *("Degenerate where ", Equation((Call(function, (THETA,)), zero)), ", that is "),
            *(entry, " is 1 or -1: then the first and the third rotation are about one line, and "),
            *("only their sum is determined:", *sums, ". There ", PHI, " is set to zero, which "),
            *("leaves ", Equation((PSI, third)), "."),
        )
    )


def _sum(sign: int) -> Node:
    return Sum((PHI, PSI if sign > 0 else Negative(PSI)))


def _degenerate_here(attitude: Attitude, found: EulerAngles) -> Paragraph:
    sign = found.sequence.remaining_sign(found.second)
    total = attitude.angle(sign * found.third)
    zero = Number(Integer(0))
    return Paragraph(
        (
            *("This rotation is such a case: ", Equation((THETA, attitude.angle(found.second)))),
            *(", only ", Equation((_sum(sign), total)), " is determined, and with "),
            *(Equation((PHI, zero)), " it is ", Equation((PSI, attitude.angle(found.third))), "."),
        )
    )


def _nearly_degenerate(sequence: EulerSequence) -> Paragraph:
    function = Call("sin" if sequence.proper else "cos", (THETA,))
    return Paragraph(
        (
            *("This rotation is close to it (", function, " below 0.000001): the last digits of "),
            *(PHI, " and ", PSI, " mean little, though together they give the matrix."),
        )
    )


def _other_solution(attitude: Attitude, found: EulerAngles) -> Paragraph:
    other = Tuple(tuple(attitude.angle(angle) for angle in found.other))
    return Paragraph(
        (
            "The same rotation with the other sign of the root: ",
            Equation((Tuple(NAMES), other)),
            ".",
        )
    )


def _read_off(attitude: Attitude, word: Word, sequence: EulerSequence) -> list[Block]:
    angles = read_off(word, sequence)
    if angles is None:
        return []
    write = attitude.style.notation.angle
    equations: list[Inline] = []
    for name, angle in zip(NAMES, angles, strict=True):
        equations += [", " if equations else "", Equation((name, write(angle)))]
    return [
        Paragraph(
            ("These rotations stand in that order already, so one solution is ", *equations, ".")
        )
    ]


def _all_sequences(attitude: Attitude, numbers: Description) -> list[Block]:
    """Return the table of the angles of all 12 sequences."""
    rows = []
    singular = []
    for found in numbers.euler:
        name = Generic(found.sequence.name.upper())
        rows.append((name, *(attitude.angle(angle) for angle in found.angles)))
        if found.degenerate:
            singular.append(found)
    notes: list[Text] = [
        (
            *(
                Generic(each.sequence.name.upper()),
                " is degenerate here: ",
                PHI,
                " is set to zero; ",
            ),
            *("only ", _sum(each.sequence.remaining_sign(each.second)), " is determined."),
        )
        for each in singular
    ]
    return [
        Paragraph(("All 12 sequences, each for the positive root:",)),
        ParameterTable((Generic("R"), *NAMES), tuple(rows), tuple(notes)),
    ]


def _axis_angle(attitude: Attitude) -> list[Block]:
    angle, axis = Generic("theta"), Generic("k", hat=True)
    differences = [_R[2, 1] - _R[1, 2], _R[0, 2] - _R[2, 0], _R[1, 0] - _R[0, 1]]
    root = sqrt(sum((d**2 for d in differences), Integer(0)))
    trace = _R[0, 0] + _R[1, 1] + _R[2, 2] - 1
    write = attitude.style.notation.write
    forms: list[Node] = [Call("atan2", (write(root), write(trace)))]
    if attitude.numbers is not None:
        forms.append(attitude.angle(attitude.numbers.axis_angle.angle))
    blocks: list[Block] = [EntrySteps((EntryStep(angle, tuple(forms), None),))]
    twice = Product((_TWO, Call("sin", (angle,))))
    steps = []
    found = attitude.numbers.axis_angle if attitude.numbers else None
    usual = found is not None and found.axis is not None and not found.either
    for letter, difference in zip("xyz", differences, strict=True):
        parts: list[Node] = [Fraction(write(difference), twice)]
        if usual and found is not None and found.axis is not None:
            parts.append(attitude.number(found.axis["xyz".index(letter)]))
        steps.append(EntryStep(Generic("k", letter), tuple(parts), None))
    blocks.append(EntrySteps(tuple(steps)))
    half, zero = attitude.half_turn, Number(Integer(0))
    blocks.append(
        Paragraph(
            (
                *("Degenerate where ", Equation((Call("sin", (angle,)), zero)), ". At "),
                *(Equation((angle, zero)), " nothing turns and any axis will do. At "),
                *(Equation((angle, half)), " the axis and its opposite are equally right: "),
                *(_SQUARES, ", and the signs follow from ", _PRODUCTS, "."),
            )
        )
    )
    if found is not None:
        blocks += _axis_here(attitude, found.axis, found.either, axis)
    return blocks


def _axis_here(
    attitude: Attitude, axis: tuple[float, float, float] | None, either: bool, name: Node
) -> list[Block]:
    if axis is None:
        return [Paragraph(("This is the identity: there is no axis to name.",))]
    components = Tuple(tuple(attitude.number(x) for x in axis))
    if either:
        told: Text = ("A half turn, about ", Equation((name, components)), " or its opposite.")
        return [Paragraph(told)]
    return []


def _quaternion(attitude: Attitude) -> list[Block]:
    write = attitude.style.notation.write
    trace = 1 + _R[0, 0] + _R[1, 1] + _R[2, 2]
    pairs = (("x", _R[2, 1] - _R[1, 2]), ("y", _R[0, 2] - _R[2, 0]), ("z", _R[1, 0] - _R[0, 1]))
    four = Product((Number(Integer(4)), Generic("w")))
    formulas = [("w", write(sqrt(trace) / 2))]
    formulas += [(letter, Fraction(write(difference), four)) for letter, difference in pairs]
    found = attitude.numbers.quaternion if attitude.numbers else None
    usual = found is not None and found.w > _NEAR
    steps = []
    for letter, formula in formulas:
        forms = [formula]
        if found is not None and (usual or letter == "w"):
            forms.append(attitude.number(getattr(found, letter)))
        steps.append(EntryStep(Generic(letter), tuple(forms), None))
    zero, letters = Number(Integer(0)), Tuple(tuple(Generic(c) for c in "wxyz"))
    blocks: list[Block] = [
        Paragraph(("The unit quaternion ", letters, ", the scalar part first:")),
        EntrySteps(tuple(steps)),
        Paragraph(
            (
                *("Its negative means the same rotation. Degenerate where "),
                *(Equation((Generic("w"), zero)), ", a half turn: then the vector part is the "),
                *("axis ", Generic("k", hat=True), " itself."),
            )
        ),
    ]
    if found is not None and not usual:
        parts = Tuple(tuple(attitude.number(x) for x in (found.w, *found.vector)))
        blocks.append(Paragraph(("Here ", Equation((letters, parts)), ".")))
    return blocks


def _short_enough(forms: list[Node]) -> list[Node]:
    return [form for form in forms if weight(form) <= _LONGEST]
