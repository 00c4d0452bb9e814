"""What an inverse kinematics solution starts from: goal, letters, structure, order."""

from __future__ import annotations

from sympy import Add, Expr, Integer, Symbol

from symdh.derivation.blocks import (
    Block,
    Chapter,
    EntryStep,
    EntrySteps,
    Inline,
    NamedMatrix,
    Paragraph,
)
from symdh.derivation.inverse.formulas import listed
from symdh.derivation.inverse.known_parts import is_told
from symdh.derivation.inverse.names import Writer
from symdh.derivation.inverse.structure import structure_notes
from symdh.derivation.words import counted
from symdh.kinematics.inverse.inverse import InverseKinematics
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.kinematics.inverse.task import InverseTask, Kind
from symdh.notation.nodes import (
    Generic,
    Juxtaposed,
    Matrix,
    Name,
    Node,
    Number,
    Sum,
)

#: What is given, in words.
_GIVEN = {
    Kind.POSE: "the pose of the hand, its position and its orientation",
    Kind.POSITION: "the position of the hand, {coordinates}",
    Kind.PLANAR: "the position of the hand, {coordinates}, and the angle phi that it is turned by",
    Kind.ORIENTATION: "the orientation of the hand",
}


def given(found: InverseKinematics, form: ClosedForm, writer: Writer) -> Chapter:
    """Say what is known, what is wanted, and what helps."""
    arm, task = form.arm, form.task
    wanted = [Name(v.name) for v in arm.robot.variables]
    goal = Generic("T" if arm.is_shifted else "G")
    blocks: list[Block] = [
        Paragraph(
            (
                *(f"Wanted: {counted(len(arm.moving), 'joint')}, ", *listed(wanted), ". Given: "),
                *(_GIVEN[task.kind].format(coordinates=_coordinates(task)), _reachable(form)),
                ". So all of this is known:",
            )
        ),
        NamedMatrix((goal, _chain_name(writer)), _goal_matrix(form, "p")),
    ]
    if not task.whole_pose or len(task.axes) < 3:
        blocks.append(Paragraph(("A star stands for what is not given.",)))
    blocks += _ends(form, writer, goal)
    if arm.locked:
        held = listed([Name(v.name) for v in arm.locked])
        verb = "is" if len(arm.locked) == 1 else "are"
        blocks.append(Paragraph((*held, f" {verb} locked and known.")))
    blocks += [Paragraph(note) for note in structure_notes(found.structure)]
    blocks += _sums(form, writer)
    blocks += _shifted(form, writer)
    blocks += _seen_from_the_hand(form, writer)
    order = [
        writer.unknown(step.unknown)
        for step in form.steps
        if not step.definitions and is_told(form, step)
    ]
    if len(order) > 1:
        blocks.append(Paragraph(("The unknowns are found in the order ", *listed(order), ".")))
    return Chapter("What is given", tuple(blocks))


def _coordinates(task: InverseTask) -> str:
    *others, last = ["xyz"[axis] for axis in task.axes] or [""]
    return f"{', '.join(others)} and {last}" if others else last


def _sums(form: ClosedForm, writer: Writer) -> list[Block]:
    """Say what the unknowns are that are sums of joint angles."""
    found = [s.unknown for s in form.steps if not s.definitions and is_told(form, s)]
    rows = tuple(
        EntryStep(
            writer.unknown(unknown),
            (writer.expression(form.ring.unknown_expression(unknown)),),
            None,
        )
        for unknown in sorted(set(found))
        if form.ring.is_angle(unknown) and writer.is_sum(unknown)
    )
    if not rows:
        return []
    lead = "An unknown of its own is" if len(rows) == 1 else "Unknowns of their own are"
    return [Paragraph((lead,)), EntrySteps(rows)]


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
        point = Symbol(ring.goal_position_names[axis], real=True)
        writer.work("", point, Symbol(f"p_{'xyz'[axis]}", real=True) + Add(*terms))
        rows.append(EntryStep(writer.expression(point), (value,), None))
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
        *(", and the position is that of the point ", Generic("w")),
        ", the centre of the wrist:" if form.structure.wrist else ":",
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
            writer.work("", ring.letters[first + c], value)
            name = writer.expression(ring.letters[first + c])
            rows.append(EntryStep(name, (writer.expression(value),), None))
    if not rows:
        return []
    return [Paragraph(("Seen from the hand, the base is at",)), EntrySteps(tuple(rows))]
