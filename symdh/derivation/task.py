"""Chapters: the task vector of an arm, and the analytic Jacobian."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import pi

from sympy import Expr, ImmutableMatrix, Integer, Symbol

from symdh.derivation.attitude import atan2_node, degenerate_case, product_of, rounded_angle
from symdh.derivation.blocks import (
    Block,
    Chapter,
    Display,
    Document,
    EntryStep,
    EntrySteps,
    Inline,
    NamedMatrix,
    Paragraph,
    Text,
)
from symdh.derivation.legend import legend
from symdh.derivation.numbers import quantity
from symdh.derivation.style import Style
from symdh.derivation.words import counted
from symdh.kinematics.rotation import euler_formulas
from symdh.kinematics.task import (
    AnalyticJacobian,
    Choice,
    Component,
    Coordinate,
    Heading,
    TaskNumbers,
    TaskVector,
)
from symdh.notation.nodes import (
    Equation,
    Fraction,
    Generic,
    Juxtaposed,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Rounded,
    Sum,
    Tuple,
    Unit,
)
from symdh.notation.numbers import figures
from symdh.notation.writing import weight

_J, _B, _J_O = Generic("J"), Generic("B"), Generic("J", "O")
_ZERO = Number(Integer(0))

#: What there is to read in a numerator that still fits a line of paper.
_LONGEST = 22


def task_document(
    found: AnalyticJacobian,
    numbers: TaskNumbers | None = None,
    values: Mapping[Symbol, Expr] | None = None,
) -> Document:
    """Return the document on a task vector.

    Parameters
    ----------
    found : AnalyticJacobian
    numbers : TaskNumbers, optional
    values : mapping of Symbol to Expr, optional
        Those that the numbers were made with besides the table's own.
    """
    robot = found.vector.robot
    style = Style(robot)
    parts = [_vector(style, found.vector), _jacobian(style, found)]
    if numbers is not None:
        parts.append(_numbers(style, found.vector, numbers, {**robot.values, **(values or {})}))
    subtitle: Text = ("Task vector and analytic Jacobian",)
    return Document(robot.title or robot.name, subtitle, tuple(parts))


def component_name(component: Component) -> Node:
    """Return ``p_x``, ``phi``, ``alpha_z`` or the letter of an Euler angle."""
    if isinstance(component, Coordinate):
        return Generic("p", component.axis.name.lower())
    if isinstance(component, Heading):
        planar, letter = component.planar, component.axis.name.lower()
        return Generic("phi") if planar else Generic("alpha", letter)
    return Name(component.symbol.name)


def _vector(style: Style, vector: TaskVector) -> Chapter:
    names = Tuple(tuple(component_name(c) for c in vector.components))
    blocks: list[Block] = [
        Paragraph(_reason(style, vector)),
        Display(Equation((Generic("r"), names))),
        EntrySteps(tuple(_component(style, vector, c) for c in vector.components)),
    ]
    blocks += _entries_used(style, vector)
    blocks += _introduced(style, blocks)
    if vector.sequence is not None:
        blocks += _orientation(style, vector)
    joints = len(vector.robot.variables)
    if len(vector.components) > joints:
        told = (
            f"There are {counted(len(vector.components), 'component')} and "
            f"{counted(joints, 'joint variable')}: not all of them can be prescribed at once."
        )
        blocks.append(Paragraph((told,)))
    return Chapter("The task vector", tuple(blocks))


def _reason(style: Style, vector: TaskVector) -> Text:
    match vector.choice:
        case Choice.NAMED:
            return ("The task vector has the components that were asked for:",)
        case Choice.SLIDING:
            return ("No joint turns the hand, so its position says all:",)
        case Choice.WRIST:
            return ("The axes of the three joints meet in one point: the arm is a wrist:",)
        case Choice.TURNING:
            return ("No joint moves the origin of the hand: its orientation in Euler angles:",)
        case Choice.POSITION:
            joints = counted(len(vector.robot.variables), "joint")
            return (f"With {joints} the position alone can be prescribed:",)
        case Choice.POSE:
            return ("The position, and the orientation in Euler angles:",)
        case Choice.PARALLEL:
            return _parallel(style, vector)


def _parallel(style: Style, vector: TaskVector) -> Text:
    """Say that all revolute axes are parallel, and what follows."""
    heading = vector.left_out or next(c for c in vector.components if isinstance(c, Heading))
    lead: list[Inline] = [
        *("All revolute axes are parallel to ", Generic(heading.axis.name.lower())),
        ", so one angle says the orientation",
    ]
    if vector.left_out is None:
        return (*lead, ":")
    angle = style.notation.angle(heading.angle)
    rest = f"; {counted(len(vector.robot.variables), 'joint')} have to do with the position, and "
    equation = Equation((component_name(heading), angle))
    return (*lead, rest, "the angle follows: ", equation, ".")


def _component(style: Style, vector: TaskVector, component: Component) -> EntryStep:
    name = component_name(component)
    if isinstance(component, Coordinate):
        return EntryStep(name, (style.notation.write(component.value),), None)
    value = component.angle if isinstance(component, Heading) else component.value
    if isinstance(value, Expr):
        return EntryStep(name, (style.notation.angle(value),), None)
    assert vector.sequence is not None
    assert not isinstance(component, Heading)
    formula = euler_formulas(_letters(), vector.sequence)[component.place]
    return EntryStep(name, (atan2_node(style, formula),), None)


def _letters() -> ImmutableMatrix:
    return ImmutableMatrix(3, 3, lambda r, c: Symbol(f"r{r + 1}{c + 1}", real=True))


def _entries_used(style: Style, vector: TaskVector) -> list[Block]:
    """Return the entries of the rotation matrix that the formulas of the angles use."""
    if vector.sequence is None or vector.is_read_off:
        return []
    letters = _letters()
    used = {
        symbol
        for formula in euler_formulas(letters, vector.sequence)
        for symbol in formula.y.free_symbols | formula.x.free_symbols
    }
    steps = [
        EntryStep(
            Generic("r", f"{r + 1}{c + 1}"), (style.notation.write(vector.orientation[r, c]),), None
        )
        for r in range(3)
        for c in range(3)
        if letters[r, c] in used
    ]
    return [Paragraph(("with the entries of the rotation matrix",)), EntrySteps(tuple(steps))]


def _introduced(style: Style, blocks: Iterable[Block]) -> list[Block]:
    formulas = [
        form
        for block in blocks
        if isinstance(block, EntrySteps)
        for step in block.entries
        for form in step.forms
    ]
    found = legend(style, formulas)
    return [found] if found is not None else []


def _orientation(style: Style, vector: TaskVector) -> list[Block]:
    """Say which product the Euler angles make, and where they fail."""
    assert vector.sequence is not None
    blocks: list[Block] = [
        Paragraph(("The Euler angles are those of",)),
        Display(product_of(vector.sequence)),
    ]
    if vector.is_read_off:
        blocks.append(
            Paragraph(("The arm's own rotations stand in that order, so they are read off.",))
        )
    blocks.append(degenerate_case(style, vector.sequence))
    return blocks


def _jacobian(style: Style, found: AnalyticJacobian) -> Chapter:
    vector = found.vector
    names = Tuple(tuple(Name(variable.name) for variable in vector.robot.variables))
    blocks: list[Block] = [
        Paragraph(
            ("The task vector is differentiated by ", names, ", one column for each of them."),
        )
    ]
    if vector.sequence is not None:
        blocks += _rates(style, found)
    blocks += _matrix(style, found)
    return Chapter("The analytic Jacobian", tuple(blocks))


def _matrix(style: Style, found: AnalyticJacobian) -> list[Block]:
    """Return J whole; with rates of Euler angles in it, its entries that are not zero."""
    vector = found.vector
    if vector.is_read_off:
        written = style.notation.matrix(found.matrix)
        introduced = legend(style, [written], _exact_forms(style, vector))
        return [NamedMatrix((_J,), written), *([introduced] if introduced else [])]
    entries = {
        (r, c): style.notation.write(found.matrix[r, c])
        for c in range(found.matrix.cols)
        for r in range(found.matrix.rows)
        if not found.matrix[r, c].is_zero
    }
    note = "The other entries are zero."
    if max(_longest_fraction(entry) for entry in entries.values()) > _LONGEST:
        note = (
            "The other entries of these rows are zero. Those of the angles would fill pages "
            "multiplied out; they are the products of the two matrices above."
        )
        angles = {r for r, c in enumerate(vector.components) if not isinstance(c, Coordinate)}
        entries = {place: entry for place, entry in entries.items() if place[0] not in angles}
    between = "," if found.matrix.cols > 9 else ""
    steps = tuple(
        EntryStep(Generic("J", f"{r + 1}{between}{c + 1}"), (entry,), None)
        for (r, c), entry in entries.items()
    )
    introduced = legend(style, entries.values(), _exact_forms(style, vector))
    told = [introduced] if introduced else []
    return [*told, *([EntrySteps(steps)] if steps else []), Paragraph((note,))]


def _longest_fraction(node: Node) -> int:
    """Return how much there is to read in the longest quotient of an entry: it cannot be broken."""
    match node:
        case Fraction(numerator=top):
            return weight(top)
        case Sum(terms=parts) | Product(factors=parts):
            return max(_longest_fraction(part) for part in parts)
        case Negative(node=inner):
            return _longest_fraction(inner)
        case _:
            return 0


def _exact_forms(style: Style, vector: TaskVector) -> list[Node]:
    """Return the formulas that the chapter before has printed."""
    shown = [c.angle if isinstance(c, Heading) else c.value for c in vector.components]
    forms = [style.notation.write(value) for value in shown if isinstance(value, Expr)]
    if vector.sequence is not None and not vector.is_read_off:
        forms += [style.notation.write(entry) for entry in vector.orientation]
    return forms


def _rates(style: Style, found: AnalyticJacobian) -> list[Block]:
    """Say how the rates of Euler angles follow from the angular velocity, and where not."""
    vector = found.vector
    assert vector.sequence is not None
    assert found.rates is not None
    assert found.inverse_rates is not None
    inverse = Power(_B, Integer(-1))
    blocks: list[Block] = [
        Paragraph(
            (
                *("The angular velocity is ", _B, " times the rates of the Euler angles; the "),
                *("columns of ", _B, " are the axes of their three rotations:"),
            )
        ),
        NamedMatrix((_B,), style.notation.matrix(found.rates)),
        Paragraph(_singular(style, vector)),
    ]
    if vector.is_read_off:
        told = "The angles are sums of joint variables and are differentiated as they stand:"
        return [*blocks, Paragraph((told,))]
    blocks += [
        Paragraph(("Elsewhere its inverse is",)),
        NamedMatrix((inverse,), style.notation.matrix(found.inverse_rates)),
        Paragraph(("The joint rates give the angular velocity by",)),
        NamedMatrix((_J_O,), style.notation.matrix(found.angular)),
        Paragraph(
            (
                *("so the rows of the angles are ", Juxtaposed((inverse, _J_O)), "; there "),
                *(_listed(vector), " are the angles of the task vector."),
            )
        ),
    ]
    return blocks


def _listed(vector: TaskVector) -> Node:
    return Tuple(tuple(Name(angle.symbol.name) for angle in vector.angles[:2]))


def _singular(style: Style, vector: TaskVector) -> Text:
    """Say where B is singular, by joint variables where that can be said."""
    sequence, vanishing = vector.sequence, vector.vanishing
    assert sequence is not None
    assert vanishing is not None
    written = style.notation.write(vanishing)
    if not vanishing.free_symbols and not vanishing.is_zero:
        second = vector.angles[1]
        angle = style.notation.angle(second.value) if isinstance(second.value, Expr) else _ZERO
        equal = Equation((Name(second.symbol.name), angle))
        return (_B, " is never singular for this arm, in which always ", equal, ".")
    entry = Generic("r", f"{sequence.first + 1}{sequence.third + 1}")
    return (
        *(_B, " is singular where ", Equation((written, _ZERO)), ", that is where ", entry),
        " is 1 or -1: there the representation fails though the arm may move freely. No rates of "
        "the angles make a rotation about the line that is square to all three axes.",
    )


def _numbers(
    style: Style, vector: TaskVector, numbers: TaskNumbers, known: Mapping[Symbol, Expr]
) -> Chapter:
    robot = vector.robot
    content: list[Inline] = ["With "]
    symbols = [s for s in (*robot.parameters, *robot.variables) if s in known]
    for position, symbol in enumerate(symbols):
        if position:
            content.append(" and " if position == len(symbols) - 1 else ", ")
        value = quantity(style, symbol, known[symbol])
        content.append(Equation((style.notation.write(symbol), value)))
    steps = [
        EntryStep(component_name(component), (_measured(style, component, number),), None)
        for component, number in zip(vector.components, numbers.vector, strict=True)
    ]
    rows = tuple(tuple(Rounded(figures(x)) for x in row) for row in numbers.jacobian)
    return Chapter(
        "Numbers",
        (
            Paragraph((*content, ":")),
            EntrySteps(tuple(steps)),
            Paragraph(("and, angles in radians,",)),
            NamedMatrix((_J,), Matrix(rows)),
        ),
    )


def _measured(style: Style, component: Component, number: float) -> Node:
    if not isinstance(component, Coordinate):
        return rounded_angle(style, pi if abs(number - pi) < 1e-15 else number)
    unit = style.robot.units.length
    shown = Rounded(figures(number))
    return Product((shown, Unit(unit.value))) if unit else shown
