"""Homework: one list of exercises that makes the problem sheet and its solution.

The problem sheet is the solution with every answer taken out, so both have the same text, the same
questions and the same numbers, and there is nothing on the problem sheet to give away.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from enum import Enum
from itertools import count
from string import ascii_lowercase

from symdh.derivation import general, links, numbers, products, result, singularity, velocity
from symdh.derivation.blocks import (
    Block,
    Chapter,
    Document,
    Inline,
    NamedMatrix,
    Paragraph,
    ParameterTable,
    PoseResult,
    ProductResult,
    Question,
    Room,
    SheetHead,
    Text,
)
from symdh.derivation.derive import PRODUCT_LIMIT
from symdh.derivation.legend import legend
from symdh.derivation.picture import drawings
from symdh.derivation.style import Naming, Order, Style
from symdh.derivation.table import chapter as table_chapter
from symdh.errors import UnsupportedError
from symdh.kinematics.forward import ForwardKinematics, forward_kinematics
from symdh.kinematics.singular import MAX_JOINTS, singularities
from symdh.kinematics.velocity import GeometricJacobian
from symdh.notation.names import split_name
from symdh.notation.nodes import (
    Call,
    Equation,
    Generic,
    Juxtaposed,
    Matrix,
    Node,
    Number,
    Sum,
)
from symdh.notation.writing import weight
from symdh.robot import ZERO, Convention, Joint, JointType, Robot

#: What the student writes on top of a problem sheet.
FIELDS = ("Name", "Date")
#: What there is to read in a Jacobian that is asked for on paper.
_JACOBIAN_LIMIT = 200
#: What fits on one line of handwriting.
_HANDWRITTEN = 14
_MOST_LINES = 16
_MATRIX_LINES = 4

_CONVENTIONS = {
    Convention.STANDARD: "standard (distal) Denavit–Hartenberg convention",
    Convention.MODIFIED: "modified (proximal) Denavit–Hartenberg convention",
}


class Sheet(Enum):
    """Which of the two sheets is wanted."""

    PROBLEM = "problem"
    SOLUTION = "solution"


def sheet(
    robot: Robot,
    kind: Sheet | str,
    order: Order | str = Order.RIGHT,
    naming: Naming | str = Naming.AUTO,
    points: bool = False,
    ask_table: bool = False,
) -> Document:
    """Make a sheet of homework from a table.

    Parameters
    ----------
    robot : Robot
    kind : Sheet or str
        ``"problem"`` leaves room for the answers, ``"solution"`` gives them at the same places.
    order : Order or str
    naming : Naming or str
        As in `derive`.
    points : bool
        Give each exercise a place for its points.
    ask_table : bool
        Give the drawing alone and ask for the table first.

    Returns
    -------
    Document

    Raises
    ------
    UnsupportedError
        When the table is asked for and there is no drawing to read it off.
    """
    style = Style(robot, Order(order), Naming(naming))
    problem = Sheet(kind) is Sheet.PROBLEM
    exercises = [*([_table(style)] if ask_table else []), *_exercises(style)]
    chapters = tuple(map(_lettered, exercises))
    convention = _CONVENTIONS[robot.convention]
    return Document(
        title=robot.title or robot.name,
        subtitle=(f"{'Problem sheet' if problem else 'Solution'}, {convention}",),
        chapters=tuple(map(_without_answers, chapters)) if problem else chapters,
        preface=_given(style, with_table=not ask_table),
        sheet=SheetHead(problem, FIELDS if problem else (), points),
    )


def _lettered(chapter: Chapter) -> Chapter:
    """Put (a), (b), ... before the questions of an exercise that has several."""
    questions = [block for block in chapter.blocks if isinstance(block, Question)]
    if len(questions) < 2:
        return chapter
    letters = dict(zip(map(id, questions), _letters(), strict=False))
    blocks = (
        replace(block, text=(f"({letters[id(block)]}) ", *block.text))
        if isinstance(block, Question)
        else block
        for block in chapter.blocks
    )
    return replace(chapter, blocks=tuple(blocks))


def _letters() -> Iterator[str]:
    """Return a, b, .. z, and then as many of a kind as it takes: aa, bb, ..."""
    return (letter * times for times in count(1) for letter in ascii_lowercase)


def _without_answers(chapter: Chapter) -> Chapter:
    blocks = (
        replace(block, answer=None) if isinstance(block, Question) else block
        for block in chapter.blocks
    )
    return replace(chapter, blocks=tuple(blocks))


def _exercises(style: Style) -> Iterator[Chapter]:
    forward = forward_kinematics(style.robot)
    yield _one_link(style)
    yield _links(style)
    if forward.pose is not None and style.robot.n <= PRODUCT_LIMIT:
        yield from _products(style, forward)
    figures = _numbers(style, forward)
    if figures is not None:
        yield figures
    yield from _velocity(style, forward)


def _given(style: Style, with_table: bool) -> tuple[Block, ...]:
    """Return the table, what its rows mean, and how the answers may be written."""
    parameters, *meaning = table_chapter(style).blocks
    told = "the table of an arm" if with_table else "the drawing of an arm"
    return (
        Paragraph((f"Given is {told}.",)),
        *((parameters,) if with_table else ()),
        *drawings(style.robot),
        *meaning,
        *_short_forms(style),
    )


def _short_forms(style: Style) -> tuple[Block, ...]:
    """Return how cosines and sines may be written, with running indices."""
    turning = [j.variable.name for j in style.robot.joints if _turns(j) and j.variable is not None]
    letters = {split_name(name)[0] for name in turning}
    if not style.notation.shorthand.usable or len(letters) != 1:
        return ()
    angle = Generic(letters.pop(), "i")
    angles: list[tuple[str, Node]] = [("i", angle)]
    if len(turning) > 1:
        angles.append(("ij", Sum((angle, replace(angle, index="j")))))
    short: list[Inline] = []
    for index, of in angles:
        for letter, name in (("c", "cos"), ("s", "sin")):
            short += [", " if short else "", Equation((Generic(letter, index), Call(name, (of,))))]
    return (Paragraph(("Short forms may be used: ", *short, ", and so on.")),)


def _turns(joint: Joint) -> bool:
    return joint.type is JointType.REVOLUTE


def _table(style: Style) -> Chapter:
    """Ask for the rows, to be read off the drawing."""
    robot = style.robot
    if not drawings(robot):
        raise UnsupportedError(f"{robot.name} has no drawing to read its table off")
    parameters, *_ = table_chapter(style).blocks
    assert isinstance(parameters, ParameterTable)
    text: Text = ("Read the four parameters of each row off the drawing.",)
    room = Room(robot.n, columns=parameters.header)
    return Chapter("The table", (Question(text, (parameters,), room),))


def _one_link(style: Style) -> Chapter:
    """Ask for the general link transform."""
    answer = general.chapter(style).blocks
    name = style.pose_name("i-1", "i")
    text: Text = (
        "Write the transform ",
        name,
        " of one link as a product of four elementary motions, and multiply the four matrices.",
    )
    return Chapter("One link", (Question(text, answer, Room(8, name)),))


def _links(style: Style) -> Chapter:
    """Ask for the matrix of each row."""
    _, *others = links.chapter(style, forward_kinematics(style.robot)).blocks
    matrices = [block for block in others if isinstance(block, NamedMatrix)]
    questions: list[Block] = []
    known: list[Node] = []
    for block in matrices:
        meanings = legend(style, [block.matrix], known)
        known.append(block.matrix)
        answer = (block, meanings) if meanings is not None else (block,)
        text: Text = ("Find ", block.names[0], ".")
        questions.append(Question(text, answer, Room(_MATRIX_LINES, block.names[0], True)))
    lead = "Put the rows of the table into the transform of one link and find the matrix of each."
    return Chapter("The links", (Paragraph((lead,)), *questions))


def _products(style: Style, forward: ForwardKinematics) -> Iterator[Chapter]:
    """Ask for the products one at a time; the last of them is the pose."""
    known = [style.notation.matrix(link) for link in forward.links]
    questions: list[Question] = []
    for step in products.steps(style, forward):
        made = products.product(style, step, final=False)
        meanings = legend(style, [made.matrix], known)
        known.append(made.matrix)
        answer: tuple[Block, ...] = (made,) if meanings is None else (meanings, made)
        text: Text = ("Find ", Equation(made.names), ", and name the identities that you use.")
        questions.append(Question(text, answer, _room_for_product(made)))
    if not questions:
        return
    *earlier, pose = questions
    if earlier:
        lead = "Multiply the matrices of the links, one product at a time."
        yield Chapter("The products", (Paragraph((lead,)), *earlier))
    columns, *_ = result.chapter(style, forward).blocks
    assert isinstance(columns, PoseResult)
    meaning: Text = ("What does each of the four columns of ", columns.whole.names[0], " tell?")
    told = (*columns.explanation[:-1], ", all seen from the first.")
    yield Chapter("The pose", (pose, Question(meaning, (Paragraph(told),), Room(2))))


def _room_for_product(made: ProductResult) -> Room:
    entries = [step.forms[-1] for step in made.steps]
    return Room(_lines(entries), made.names[0])


def _lines(entries: Iterable[Node]) -> int:
    """Return the lines of handwriting that the entries of a matrix need, four to a line or more."""
    needed = sum(max(1.0, weight(entry) / _HANDWRITTEN * 3) for entry in entries)
    return min(_MOST_LINES, max(_MATRIX_LINES + 1, 2 + round(needed / 3)))


def _numbers(style: Style, forward: ForwardKinematics) -> Chapter | None:
    """Ask for the numeric pose, where the table has the numbers for it."""
    found = numbers.chapter(style, forward)
    if found is None or len(found.blocks) < 2:
        return None
    given, *answer = found.blocks
    missing = numbers.missing(forward, style.robot.values)
    rest: list[Block] = []
    if missing:
        zero = Equation((*(style.notation.write(s) for s in missing), Number(ZERO)))
        rest = [Paragraph(("Take ", zero, "."))]
    name = style.pose_name(forward.start, forward.end)
    text: Text = ("Put the numbers in and find ", name, " to four decimals.")
    room = Room(_MATRIX_LINES, name, True)
    return Chapter("Numbers", (given, *rest, Question(text, tuple(answer), room)))


def _velocity(style: Style, forward: ForwardKinematics) -> Iterator[Chapter]:
    """Ask for the Jacobian and for its singularities, where both can be done by hand."""
    robot, start, end = style.robot, forward.start, forward.end
    joints = len(robot.variables)
    # Along the axes of the first frame the Jacobian of the last one is small where the pose is:
    # both are measured by the rotations of the whole chain.
    if forward.pose is None or not 0 < joints <= MAX_JOINTS:
        return
    found = velocity.readable_jacobian(style, start, end)
    written = style.notation.matrix(found.matrix)
    size = sum(weight(entry) for row in written.rows for entry in row)
    if size > _JACOBIAN_LIMIT:
        return
    known = [style.notation.matrix(m) for m in (*forward.links, forward.pose)]
    yield Chapter("Velocity", (_jacobian(style, found, written, known),))
    singular = singularities(robot)
    if joints > 1 and singular.factors is not None:
        answer = singularity.chapter(style, singular, known).blocks
        text: Text = (
            "In which configurations does the arm lose a direction of motion, and which one?",
        )
        yield Chapter("Singularities", (Question(text, answer, Room(6)),))


def _jacobian(
    style: Style, found: GeometricJacobian, written: Matrix, known: Iterable[Node]
) -> Question:
    jacobian = Generic("J")
    law = Juxtaposed((jacobian, Generic("q", dotted=True)))
    text: Text = (
        "Find the geometric Jacobian ",
        jacobian,
        f" of the origin of {velocity.frame_text(found.of)}, with components along the axes of "
        f"{velocity.frame_text(found.in_)}: linear velocity above, angular velocity below, both ",
        law,
        ". Form it column by column.",
    )
    entries = [entry for row in written.rows for entry in row]
    answer = velocity.chapter(style, found, known, statics=False).blocks
    return Question(text, answer, Room(max(8, _lines(entries)), jacobian))
