"""Chapter: velocity. Each column of the Jacobian formed, the matrix, and the statics it gives."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sympy import Add, Expr, Integer, cos, sin

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Display,
    EntryStep,
    EntrySteps,
    Fitting,
    MatrixRow,
    NamedMatrix,
    Paragraph,
    Text,
)
from symdh.derivation.legend import legend
from symdh.derivation.products import identity, same_polynomial
from symdh.derivation.style import Style
from symdh.kinematics.frame import Frame
from symdh.kinematics.velocity import GeometricJacobian, JacobianColumn, jacobian
from symdh.notation.nodes import (
    Cross,
    Equation,
    Generic,
    Juxtaposed,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Product,
    Sum,
    Transposed,
    Tuple,
)
from symdh.notation.writing import weight
from symdh.robot import Convention, Joint, JointType

#: What there is to read in the longest entry of vectors that stand side by side.
_NARROW = 12
#: What there is to read in a Jacobian that is put into the statics whole, not by name.
_SHORT = 60
#: What there is to read in a Jacobian that a handout still forms column by column.
_READABLE = 400

_J, _V, _OMEGA, _P = Generic("J"), Generic("v"), Generic("omega"), Generic("p")
_FORCE, _MOMENT = Generic("f"), Generic("n")
_ZERO = Number(Integer(0))
_COMPONENTS = "xyz"
_TOO_LONG: Text = (
    "Multiplied out, the columns of this arm would fill pages. Each is two vectors of the poses "
    "above; symdh jacobian prints those of single frames, and symdh code the function.",
)


def chapter(
    style: Style, found: GeometricJacobian, known: Iterable[Node] = (), statics: bool = True
) -> Chapter:
    """Return the chapter on velocity.

    Parameters
    ----------
    style : Style
    found : GeometricJacobian
    known : iterable of Node
        Formulas whose short forms have been introduced.
    statics : bool
        End with the joint torques that hold a force.
    """
    blocks: list[Block] = [*_law(style, found), *_rule(style)]
    if _leaves(found) > _READABLE:
        return Chapter("Velocity", (*blocks, Paragraph(_TOO_LONG), *_statics(found, None)))
    written = style.notation.matrix(found.matrix)
    meanings = legend(style, [written], known)
    if meanings is not None:
        blocks.append(meanings)
    for number, column in enumerate(found.columns, start=1):
        blocks += _column(style, found, number, column)
    blocks.append(Paragraph(("The columns side by side:",)))
    names = tuple(_column_name(k + 1) for k in range(len(found.columns)))
    together = Display(Equation((_J, Matrix((names,)))))
    blocks.append(Fitting(NamedMatrix((_J,), written), (together,)))
    loads = _statics(found, written) if statics else ()
    return Chapter("Velocity", (*blocks, *loads))


def readable_jacobian(style: Style, start: Frame, end: Frame) -> GeometricJacobian:
    """Return the Jacobian of a frame along the axes of another; of a middle one where that pays.

    The components along a frame in the middle of a long arm are much shorter.
    """
    robot = style.robot
    found = jacobian(robot, end, in_=start)
    if _leaves(found) <= _READABLE:
        return found
    middle = (robot.n // 2, (robot.n + 1) // 2, robot.n // 2 + 1)
    others = [jacobian(robot, end, in_=frame) for frame in dict.fromkeys(middle)]
    return min((found, *others), key=_leaves)


def jacobian_chapter(style: Style, found: GeometricJacobian) -> Chapter:
    """Return the Jacobian alone: whole where it fits, else column by column."""
    written = style.notation.matrix(found.matrix)
    columns = tuple(
        Fitting(
            NamedMatrix((_column_name(number + 1),), _stacked(row[number] for row in written.rows)),
            (EntrySteps(_entries(written, number)),),
        )
        for number in range(len(found.columns))
    )
    blocks: list[Block] = [*_law(style, found), Fitting(NamedMatrix((_J,), written), columns)]
    meanings = legend(style, [written])
    return Chapter("Velocity", (*blocks, meanings) if meanings is not None else tuple(blocks))


def _leaves(found: GeometricJacobian) -> int:
    """Count what there is to read in a Jacobian before it is written, which takes longer."""

    def count(expression: Expr) -> int:
        if not expression.args or isinstance(expression, (cos, sin)):
            return 1
        return sum(map(count, expression.args))

    return sum(count(entry) for entry in found.matrix)


def _weight(written: Matrix) -> int:
    return sum(weight(entry) for row in written.rows for entry in row)


def frame_text(frame: Frame) -> str:
    """Return what a frame is called in a sentence."""
    return f"the {frame}" if isinstance(frame, str) else f"frame {frame}"


def _law(style: Style, found: GeometricJacobian) -> tuple[Block, ...]:
    """Return what the Jacobian does."""
    point: Text = (_P, f", the origin of {frame_text(found.of)},")
    if any(not part.is_zero for part in found.at):
        at = Tuple(tuple(style.notation.write(part) for part in found.at))
        point = (_P, ", the point ", at, f" of {frame_text(found.of)},")
    rates = Tuple(tuple(_rate(column.joint) for column in found.columns))
    law = Equation((_stacked((_V, _OMEGA)), Juxtaposed((_J, Generic("q", dotted=True)))))
    names = Equation((Generic("q", dotted=True), rates))
    return (
        Paragraph(
            (
                *("The point ", *point, " moves with the linear velocity ", _V),
                f", and {frame_text(found.of)} turns with the angular velocity ",
                *(_OMEGA, f". Along the axes of {frame_text(found.in_)}, both are linear in the "),
                *("rates of the joints, ", names, ":"),
            )
        ),
        Display(law),
    )


def _rule(style: Style) -> tuple[Block, ...]:
    """Return what one joint contributes, in the convention of the table."""
    index = "i-1" if style.robot.convention is Convention.STANDARD else "i"
    axis, arm = _axis_name(index), _arm_name(index)
    turning = Equation((Generic("J", "i"), _stacked((Cross(axis, arm), axis))))
    sliding = Equation((Generic("J", "i"), _stacked((axis, _ZERO))))
    blocks: list[Block] = []
    types = {joint.type for joint in style.robot.joints}
    if JointType.REVOLUTE in types:
        text: Text = (
            *("A joint that turns about ", axis, " carries the point around its axis, along the "),
            *("cross product with the arm from ", _origin_name(index), " to the point:"),
        )
        blocks += [Paragraph(text), Display(turning)]
    if JointType.PRISMATIC in types:
        text = ("A joint that slides along ", axis, " moves the point along it and turns nothing:")
        blocks += [Paragraph(text), Display(sliding)]
    return tuple(blocks)


def _column(
    style: Style, found: GeometricJacobian, number: int, column: JacobianColumn
) -> list[Block]:
    """Return how one column comes about."""
    index = str(column.axis_frame)
    axis, arm = _axis_name(index), _arm_name(index)
    revolute = column.joint.type is JointType.REVOLUTE
    does = "turns about" if revolute else "slides along"
    if not column.moves:
        text: Text = (
            f"Joint {column.row} stands behind {frame_text(found.of)}: a column of zeros.",
        )
        return [Paragraph(text)]
    blocks: list[Block] = [Paragraph((f"Joint {column.row} {does} ", axis, ":"))]
    vectors = [_vector(style, axis, column.axis)]
    if revolute:
        vectors.append(_vector(style, arm, column.lever))
    blocks += _beside(vectors)
    changed = _changed(style, number, column) if revolute else {}
    if changed:
        blocks.append(EntrySteps(tuple(changed.values())))
    made = _stacked((Cross(axis, arm), axis) if revolute else (axis, _ZERO))
    entries = style.notation.matrix(
        found.matrix[:, number - 1]  # a 6 x 1 matrix
    )
    rest = (step for row, step in enumerate(_entries(entries, 0, number)) if row not in changed)
    names = (_column_name(number), _scaled(style, column.rate, made))
    blocks.append(
        Fitting(NamedMatrix(names, entries), (Display(Equation(names)), EntrySteps(tuple(rest))))
    )
    return blocks


def _changed(style: Style, number: int, column: JacobianColumn) -> dict[int, EntryStep]:
    """Return the entries of a cross product that an identity shortens, by row."""
    steps = {}
    for row, (terms, result) in enumerate(zip(column.cross_terms, column.linear, strict=True)):
        if not same_polynomial(Add(*terms), result):
            forms = (style.notation.sum(list(terms)), style.notation.write(result))
            reason = identity(list(terms), result)
            steps[row] = EntryStep(_entry_name(row, number), forms, reason)
    return steps


def _vector(style: Style, name: Node, vector: Sequence[Expr]) -> NamedMatrix:
    return NamedMatrix((name,), _stacked(style.notation.write(part) for part in vector))


def _beside(vectors: Sequence[NamedMatrix]) -> list[Block]:
    """Return short vectors side by side, long ones below each other, component by component."""
    longest = max(weight(row[0]) for vector in vectors for row in vector.matrix.rows)
    if longest <= _NARROW:
        return [MatrixRow(tuple(vectors))]
    return [Fitting(vector, (EntrySteps(_components(vector)),)) for vector in vectors]


def _components(vector: NamedMatrix) -> tuple[EntryStep, ...]:
    name = vector.names[0]
    return tuple(
        EntryStep(_component(name, axis), row, None)
        for axis, row in zip(_COMPONENTS, vector.matrix.rows, strict=True)
    )


def _component(name: Node, axis: str) -> Node:
    """Return one component of a vector or of a difference of two."""
    match name:
        case Sum(terms=terms):
            return Sum(tuple(_component(term, axis) for term in terms))
        case Negative(node=inner):
            return Negative(_component(inner, axis))
        case _:
            assert isinstance(name, Generic)
            return Generic(name.letter, f"{name.index},{axis}" if name.index else axis)


def _statics(found: GeometricJacobian, written: Matrix | None) -> list[Block]:
    """Return the joint torques that hold a force and a moment, one by one if J is written out."""
    tau = Generic("tau")
    law = Equation((tau, Juxtaposed((Transposed(_J), _stacked((_FORCE, _MOMENT))))))
    sliding = any(column.joint.type is JointType.PRISMATIC for column in found.columns)
    holds = "torques and forces" if sliding else "torques"
    text: Text = (
        *("The same matrix gives the statics. A force ", _FORCE, " at the point and a moment "),
        *(_MOMENT, f" on the frame are those of joint {holds} ", tau),
        ", because both do the same work in every small motion:",
    )
    blocks: list[Block] = [Paragraph(text), Display(law)]
    if written is None:
        return blocks
    short = _weight(written) <= _SHORT
    steps = tuple(
        EntryStep(Generic("tau", str(column.row)), (_load(written, number, short),), None)
        for number, column in enumerate(found.columns)
    )
    return [*blocks, EntrySteps(steps)]


def _load(written: Matrix, number: int, short: bool) -> Node:
    """Return one joint's torque as a sum over the components of force and moment."""
    terms: list[Node] = []
    for row in range(6):
        entry = written.rows[row][number]
        if entry == _ZERO:
            continue
        component = Generic("f" if row < 3 else "n", _COMPONENTS[row % 3])
        terms.append(_times(entry if short else _entry_name(row, number + 1), component))
    if not terms:
        return _ZERO
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))


def _times(coefficient: Node, component: Node) -> Node:
    match coefficient:
        case Number(value=value) if value == 1:
            return component
        case Negative(node=inner):
            return Negative(_times(inner, component))
        case Product(factors=factors):
            return Product((*factors, component))
        case _:
            return Product((coefficient, component))


def _scaled(style: Style, rate: Expr, node: Node) -> Node:
    if rate == 1:
        return node
    if rate == -1:
        return Negative(node)
    return Juxtaposed((style.notation.write(rate), node))


def _entries(written: Matrix, column: int, number: int | None = None) -> tuple[EntryStep, ...]:
    """Return the entries of a column, named by their place in the Jacobian."""
    number = column + 1 if number is None else number
    return tuple(
        EntryStep(_entry_name(row, number), (entries[column],), None)
        for row, entries in enumerate(written.rows)
    )


def _entry_name(row: int, column: int) -> Node:
    between = "," if column > 9 else ""
    return Generic("J", f"{row + 1}{between}{column}")


def _column_name(number: int) -> Node:
    return Generic("J", str(number))


def _axis_name(index: str) -> Node:
    return Generic("z", index, hat=True)


def _origin_name(index: str) -> Node:
    return Generic("p", index)


def _arm_name(index: str) -> Node:
    return Sum((_P, Negative(_origin_name(index))))


def _rate(joint: Joint) -> Node:
    assert joint.variable is not None
    return Name(joint.variable.name, dotted=True)


def _stacked(entries: Iterable[Node]) -> Matrix:
    return Matrix(tuple((entry,) for entry in entries))
