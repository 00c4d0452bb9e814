"""Inverse kinematics as a document: what is given, each step, the solutions and their numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from math import pi, prod

from sympy import Expr, Integer, Symbol

from symdh.derivation.attitude import rounded_angle
from symdh.derivation.blocks import (
    Block,
    Chapter,
    Document,
    EntryStep,
    EntrySteps,
    Inline,
    NamedMatrix,
    Paragraph,
    ParameterTable,
    Text,
)
from symdh.derivation.inverse_names import Writer, listed
from symdh.derivation.inverse_steps import step_chapter
from symdh.derivation.legend import legend
from symdh.derivation.style import Naming, Style
from symdh.derivation.words import counted, number_word
from symdh.kinematics.inverse.branches import Branches, branches_of
from symdh.kinematics.inverse.inverse import InverseKinematics, Method
from symdh.kinematics.inverse.judge import Answer
from symdh.kinematics.inverse.solution import ClosedForm, Rule
from symdh.kinematics.inverse.structure import Structure
from symdh.kinematics.inverse.task import Kind
from symdh.notation.nodes import (
    Generic,
    Juxtaposed,
    Matrix,
    Name,
    Node,
    Number,
    Rounded,
    Sum,
)
from symdh.notation.numbers import figures
from symdh.robot import AngleUnit, Robot

_METHOD = {
    Method.CLOSED_FORM: "Solved in closed form;",
    Method.NOMINAL: (
        "There is no closed form of this very arm. Solved by that of its nominal arm, without "
        "small lengths and angles, improved by Newton's method, which may miss a solution near "
        "singular poses;"
    ),
    Method.ONE_JOINT: (
        "There is no closed form. Solved by a search over one joint with the others in closed "
        "form, completed by damped least squares, which may miss a solution;"
    ),
    Method.LEAST_SQUARES: (
        "There is no closed form. Solved by damped least squares from many starting points, which "
        "may miss a solution;"
    ),
}


@dataclass(frozen=True)
class Solved:
    """The solutions for one goal.

    Attributes
    ----------
    goal : rows of numbers
        The pose that was asked for.
    answers : sequence of Answer
    values : mapping of Symbol to Expr
        Numbers for parameters that are not the table's own.
    """

    goal: Sequence[Sequence[float]]
    answers: Sequence[Answer]
    values: Mapping[Symbol, Expr] = field(default_factory=dict)


def inverse_document(
    found: InverseKinematics, solved: Solved | None = None, naming: Naming | str = Naming.AUTO
) -> Document:
    """Return the document on the inverse kinematics of an arm.

    Parameters
    ----------
    found : InverseKinematics
    solved : Solved, optional
        Solutions to print for one goal.
    naming : Naming or str
        How poses are written.
    """
    robot = found.robot
    chapters: list[Chapter] = []
    if found.method is not Method.CLOSED_FORM:
        chapters.append(_without(found))
    if found.form is not None and found.method is not Method.LEAST_SQUARES:
        chapters += _derivation(found, found.form, Naming(naming))
    if solved is not None:
        chapters.append(numbers_chapter(found, solved))
    subtitle: Text = ("Inverse kinematics",)
    return Document(robot.title or robot.name, subtitle, tuple(chapters))


def _derivation(found: InverseKinematics, form: ClosedForm, naming: Naming) -> list[Chapter]:
    style = Style(form.arm.robot, naming=naming)
    writer = Writer(style, form, branches_of(form))
    steps = [step_chapter(writer, step) for step in form.steps]
    given = _given(found, form, writer)
    meanings = legend(style, [node for chapter in steps for node in _formulas(chapter.blocks)])
    if meanings is not None:
        given = Chapter(given.title, (*given.blocks, meanings))
    return [given, *steps, _solutions(form, writer)]


def _given(found: InverseKinematics, form: ClosedForm, writer: Writer) -> Chapter:
    """Say what is known, what is wanted, and what helps."""
    arm, task = form.arm, form.task
    wanted = [Name(v.name) for v in arm.robot.variables]
    chosen = "as asked for" if task.named else "as fits the arm"
    joints = counted(len(arm.moving), "joint")
    goal = Generic("T" if arm.is_shifted else "G")
    blocks: list[Block] = [
        Paragraph(
            (
                *(f"Wanted: {joints}, ", *listed(wanted), f". Given: {task.description}"),
                *(f" ({chosen})", _reachable(form), ", so that all of this is known:"),
            )
        ),
        NamedMatrix((goal, _chain_name(writer)), _goal_matrix(form, "p")),
    ]
    if task.kind is Kind.POSITION:
        blocks.append(Paragraph(("A star stands for what is not given.",)))
    blocks += _ends(form, writer, goal)
    blocks += _letters(form, writer)
    blocks += _shifted(form, writer)
    if arm.locked:
        held = listed([Name(v.name) for v in arm.locked])
        verb = "is" if len(arm.locked) == 1 else "are"
        blocks.append(Paragraph((*held, f" {verb} locked and known.")))
    blocks += [Paragraph(note) for note in structure_notes(found.structure)]
    blocks += _sums(form, writer)
    blocks += _seen_from_the_hand(form, writer)
    order = [
        writer.unknown(step.unknown)
        for step in form.steps
        if not step.definitions and not (step.rule is Rule.SUM and writer.is_sum(step.unknown))
    ]
    blocks.append(Paragraph(("The unknowns are found in the order ", *listed(order), ".")))
    return Chapter("What is given", tuple(blocks))


def _sums(form: ClosedForm, writer: Writer) -> list[Block]:
    """Say what the unknowns are that are sums of joint angles."""
    found = [step.unknown for step in form.steps if not step.definitions]
    rows = tuple(
        EntryStep(
            writer.unknown(unknown),
            (writer.expression(form.ring.unknown_expression(unknown)),),
            None,
        )
        for unknown in sorted(set(found))
        if form.ring.is_angle(unknown) and writer.is_sum(unknown)
    )
    return [EntrySteps(rows)] if rows else []


def _reachable(form: ClosedForm) -> str:
    if not form.task.reachable_only:
        return ""
    return "; with fewer than six joints it has to be one that the arm can reach"


def _chain_name(writer: Writer) -> Node:
    names = writer.links(0, writer.form.arm.robot.n)
    return names[0] if len(names) == 1 else Juxtaposed(names)


def _goal_matrix(form: ClosedForm, position: str) -> Matrix:
    """Return the goal's matrix, its position called p or w."""
    places = [f"{position}_{axis}" for axis in "xyz"]
    allowed = form.task.allowed(places)
    rows = []
    for r in range(3):
        names = [*(f"r_{r + 1}{c}" for c in (1, 2, 3)), places[r]]
        rows.append(tuple(Name(n) if n in allowed else Generic("*") for n in names))
    last = tuple(Number(Integer(int(c == 3))) for c in range(4))
    return Matrix((*rows, last))


def _ends(form: ClosedForm, writer: Writer, goal: Node) -> list[Block]:
    """Say that base and tool are taken off, or which links they are part of."""
    robot = form.arm.given
    tool_off = bool(robot.tool) and not form.arm.tool_inside
    base_off = bool(robot.base) and not form.arm.base_inside
    if base_off and tool_off:
        ends = (
            "The base and the tool of the table are known, and ",
            " is what remains without them.",
        )
    else:
        end = "base" if base_off else "tool"
        ends = f"The {end} of the table is known, and ", " is what remains without it."
    blocks: list[Block] = []
    if base_off or tool_off:
        blocks.append(Paragraph((ends[0], goal, ends[1])))
    if form.arm.base_inside:
        first = writer.style.link_name(1)
        blocks.append(Paragraph(("The base of the table is part of ", first, ".")))
    if form.arm.tool_inside:
        last = writer.style.link_name(robot.n)
        blocks.append(Paragraph(("The tool of the table is part of ", last, ".")))
    return blocks


def _letters(form: ClosedForm, writer: Writer) -> list[Block]:
    """Say what the letters stand for that the table does not have."""
    meanings = form.arm.meanings
    if not meanings:
        return []
    style = writer.style
    rows = tuple(
        EntryStep(style.notation.write(letter), (style.figures.write(meaning),), None)
        for letter, meaning in meanings.items()
    )
    return [Paragraph(("Letters stand for the numbers of the table:",)), EntrySteps(rows)]


def structure_notes(shape: Structure) -> list[Text]:
    """Return sentences on axes that are parallel or meet."""
    notes: list[Text] = []
    if shape.wrist is not None:
        notes.append(
            (
                f"The axes of joints {_rows(shape.wrist)} meet in one point, the centre of the "
                "wrist. Its position depends on the other joints only, so these come first and "
                "the orientation after them.",
            )
        )
    if shape.shoulder is not None and shape.shoulder != shape.wrist:
        notes.append(
            (
                f"The axes of joints {_rows(shape.shoulder)} meet in one point, the centre of the "
                "shoulder. Seen from the hand, its position depends on the other joints only.",
            )
        )
    for run in shape.parallel:
        notes.append(
            (
                f"The axes of joints {_rows(run)} are parallel: their angles occur as sums, and "
                "these are unknowns of their own.",
            )
        )
    return notes


def _rows(rows: Sequence[int]) -> str:
    return ", ".join(map(str, rows[:-1])) + f" and {rows[-1]}"


def _shifted(form: ClosedForm, writer: Writer) -> list[Block]:
    """Give w where offsets at the ends were taken off p, and the goal with it."""
    arm, ring = form.arm, form.ring
    if not arm.is_shifted:
        return []
    rows = []
    for axis in form.task.axes or (0, 1, 2):
        terms: list[Expr] = [-arm.front[axis]]
        terms += [-arm.hand[c] * Symbol(f"r_{axis + 1}{c + 1}", real=True) for c in range(3)]
        # The position stands in front, where a reader looks for it.
        written = [Name(f"p_{'xyz'[axis]}"), *(writer.expression(t) for t in terms if t != 0)]
        value = written[0] if len(written) == 1 else Sum(tuple(written))
        name = writer.expression(Symbol(ring.goal_position_names[axis], real=True))
        rows.append(EntryStep(name, (value,), None))
    ends = []
    if any(not part.is_zero for part in arm.front):
        ends.append(writer.style.link_name(arm.moving[0]))
    if any(not part.is_zero for part in arm.hand):
        ends.append(writer.style.link_name(arm.moving[-1]))
    one = len(set(ends)) == 1
    text: list[Inline] = [
        "The offset at the end of the chain is known and is taken to the known side. In what "
        "follows "
        if one
        else "The offsets at the ends of the chain are known and are taken to the known side. In "
        "what follows ",
        *listed(list(dict.fromkeys(ends))),
        " is without it" if one else " stand without them",
        ", and the position is that of the point w:",
    ]
    known = NamedMatrix((Generic("G"), _chain_name(writer)), _goal_matrix(form, "w"))
    return [
        Paragraph(tuple(text)),
        EntrySteps(tuple(rows)),
        Paragraph(("What is known is now",)),
        known,
    ]


def _seen_from_the_hand(form: ClosedForm, writer: Writer) -> list[Block]:
    """Give u where a step uses it."""
    ring = form.ring
    first = ring.first_goal + 12
    elements = [e for s in form.steps for e in s.coefficients]
    elements += [used.equation.element for s in form.steps for used in s.equations]
    used_here = {k for e in elements for powers in e for k in range(first, first + 3) if powers[k]}
    rows = []
    for c in range(3):
        value: Expr = Integer(0)
        for r in range(3):
            w = Symbol(ring.goal_position_names[r], real=True)
            value = value - Symbol(f"r_{r + 1}{c + 1}", real=True) * w
        if first + c in used_here:
            name = writer.expression(ring.letters[first + c])
            rows.append(EntryStep(name, (writer.expression(value),), None))
    if not rows:
        return []
    return [Paragraph(("Seen from the hand, the base is at",)), EntrySteps(tuple(rows))]


def _solutions(form: ClosedForm, writer: Writer) -> Chapter:
    """Give the tree of branches."""
    steps = form.branching
    if not steps:
        text = "Every step has one value, so there is one solution, or none out of reach."
        return Chapter("The solutions", (Paragraph((text,)),))
    factors = " times ".join(number_word(step.branches) for step in steps)
    total = form.most_solutions
    lead: Text = (
        f"The branches make a tree: {factors} is {total}, so there are at most {total} solutions. "
        if len(steps) > 1
        else f"There are at most {total} solutions. ",
        "Forward kinematics decides on each; those out of reach or false are left out.",
    )
    header = (Generic("k"), *(writer.unknown(step.unknown) for step in steps))
    rows: list[tuple[Node, ...]] = []
    notes: list[Text] = []
    for k, taken in enumerate(product(*(range(step.branches) for step in steps)), start=1):
        cells = (
            writer.unknown(step.unknown, str(branch + 1))
            for step, branch in zip(steps, taken, strict=True)
        )
        rows.append((Rounded(str(k)), *cells))
        names = _names_of(writer.branches, taken)
        notes += [(f"{k}: {', '.join(names)}.",)] if names else []
    open_ = [f"{names[0]} or {names[1]}" for names in _undecided(writer.branches)]
    if open_:
        notes.append((f"Whether a solution is {' and '.join(open_)} depends on the goal.",))
    return Chapter(
        "The solutions", (Paragraph(lead), ParameterTable(header, tuple(rows), tuple(notes)))
    )


def _names_of(branches: Branches, taken: tuple[int, ...]) -> tuple[str, ...]:
    """Return the sides of the arm that a combination of branches always gives."""
    known = branches.together.get(taken)
    names = []
    for place, (each, branch) in enumerate(zip(branches.steps, taken, strict=True)):
        if each.feature is not None and each.names:
            names.append(each.names[branch])
        elif each.feature is not None and known is not None and not _undecided(branches):
            names.append(known[place])
    return tuple(names)


def _undecided(branches: Branches) -> list[tuple[str, str]]:
    """Return the names of features that depend on the goal for some combination of branches."""
    count = prod(each.step.branches for each in branches.steps)
    if len(branches.together) == count:
        return []
    return [each.feature.names for each in branches.steps if each.feature and not each.names]


def _without(found: InverseKinematics) -> Chapter:
    """Say that there is no closed form, what was tried, what is missing, and what is done."""
    tried = found.tried
    assert tried is not None
    got = "nothing could be found first"
    if tried.steps:
        got = f"the search came as far as {counted(len(tried.steps), 'step')}"
    blocks: list[Block] = [
        Paragraph(
            (
                "No solution in closed form was found. All entries of the matrix equations with "
                "up to three joints moved were compared; known sums, one equation in a sine and a "
                "cosine, two linear ones, square and add, and the elimination of one of two "
                f"angles down to a quartic were tried, and {got}.",
            )
        ),
        Paragraph((_missing_structure(found.structure),)),
    ]
    match found.method:
        case Method.NOMINAL:
            text = (
                "The table has lengths or angles that are small, as in a calibrated arm. Without "
                "them the nominal arm has a closed form; it is derived below, and each of its "
                "solutions is improved on the true arm by Newton's method. Near singular poses one "
                "may be missed."
            )
            blocks.append(Paragraph((text,)))
        case Method.ONE_JOINT:
            assert found.searched is not None
            blocks.append(
                Paragraph(
                    (
                        *("What is offered instead is a search over ", Name(found.searched.name)),
                        ": for each of its values the other joints follow in closed form, as "
                        "derived below, and where the equations that are left hold as well there "
                        "is a solution. It may miss one.",
                    )
                )
            )
        case _:
            text = (
                "What is offered instead is damped least squares from many starting points. It "
                "may miss a solution."
            )
            blocks.append(Paragraph((text,)))
    return Chapter("No closed form", tuple(blocks))


def _missing_structure(shape: Structure) -> str:
    """Say which structure an arm lacks that would give a closed form."""
    has = " ".join(str(part) for note in structure_notes(shape) for part in note)
    needed = (
        "A closed form is known for six joints where three neighbouring axes meet in one point, "
        "as in a spherical wrist, or are parallel (Pieper); this arm has no such three at its ends "
        "or between them, and the general arm of six joints leads to a polynomial of degree 16."
    )
    if shape.wrist or shape.shoulder or any(len(run) > 2 for run in shape.parallel):
        needed = "The structure that the arm has is not enough for the rules that are known here."
    return f"{has} {needed}".strip()


def numbers_chapter(found: InverseKinematics, solved: Solved) -> Chapter:
    """Give the solutions for one goal."""
    robot = found.robot
    style = Style(robot)
    goal = Matrix(
        (
            *(tuple(Rounded(figures(x)) for x in row) for row in solved.goal[:3]),
            tuple(Rounded(str(int(c == 3))) for c in range(4)),
        )
    )
    blocks: list[Block] = [Paragraph((f"{_METHOD[found.method]} the goal is",))]
    blocks.append(NamedMatrix((Generic("T"),), goal))
    count = len(solved.answers)
    if not count:
        text = "This goal has no solution"
        text += (
            ": it is out of reach."
            if found.method in (Method.CLOSED_FORM, Method.NOMINAL)
            else " that was found; there may be one all the same."
        )
        return Chapter("Numbers", (*blocks, Paragraph((text,))))
    unit = "radians" if robot.units.angle is AngleUnit.RADIAN else "degrees"
    blocks.append(Paragraph((f"It has {counted(count, 'solution')}, angles in {unit}:",)))
    turning = {j.variable for j in robot.joints if j.type.value == "revolute"}
    header: tuple[Node, ...] = (Generic("k"), *(Name(v.name) for v in robot.variables))
    rows: list[tuple[Node, ...]] = []
    for k, answer in enumerate(solved.answers, start=1):
        pairs = zip(robot.variables, answer.q, strict=True)
        values = [_value(style, x, variable in turning) for variable, x in pairs]
        rows.append((Rounded(str(k)), *values))
    branches = None
    if found.form is not None and found.method is Method.CLOSED_FORM:
        branches = branches_of(found.form, solved.values)
    told = [_answer_note(branches, k, a) for k, a in enumerate(solved.answers, start=1)]
    notes: list[Text] = [note for note in told if note]
    worst = max(answer.error for answer in solved.answers)
    blocks.append(ParameterTable(header, tuple(rows), tuple(notes)))
    blocks.append(
        Paragraph(
            (
                "Put into the forward kinematics, they miss the goal by at most "
                f"{worst:.1e}{_length_unit(robot)}.",
            )
        )
    )
    return Chapter("Numbers", tuple(blocks))


def _answer_note(branches: Branches | None, k: int, answer: Answer) -> Text:
    said: list[str] = []
    if branches is not None and answer.branches:
        said += branches.names(answer.branches, answer.q)
    if answer.free:
        free = " and ".join(v.name for v in answer.free)
        said.append(f"singular, {free} free")
    if not answer.within_limits:
        said.append("outside the limits of the table")
    return (f"{k}: {', '.join(said)}.",) if said else ()


def _value(style: Style, value: float, turns: bool) -> Node:
    if not turns:
        return Rounded(figures(value))
    return rounded_angle(style, 0.0 if abs(value) < 5e-15 else min(value, pi))


def _length_unit(robot: Robot) -> str:
    return f" {robot.units.length.value}" if robot.units.length else ""


def _formulas(blocks: Sequence[Block]) -> list[Node]:
    """Return the formulas in blocks."""
    found: list[Node] = []
    for block in blocks:
        match block:
            case EntrySteps(entries=entries):
                found += [node for step in entries for node in (step.name, *step.forms)]
            case Paragraph(content=content):
                found += [part for part in content if not isinstance(part, str)]
            case _:
                formula = getattr(block, "formula", None)
                if formula is not None:
                    found.append(formula)
    return found
