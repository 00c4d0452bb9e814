"""Chapters: how the frames of a mechanism come about, and what is measured between them."""

from __future__ import annotations

from collections.abc import Iterator

from sympy import Expr

from symdh.derivation import table
from symdh.derivation.blocks import (
    Block,
    Chapter,
    Document,
    EntryStep,
    EntrySteps,
    Paragraph,
    Text,
)
from symdh.derivation.drawing.choices import Choices
from symdh.derivation.picture import drawings
from symdh.derivation.style import Style
from symdh.derivation.words import number_word
from symdh.frames.geometry import Relation
from symdh.frames.placed import crossing
from symdh.frames.story import Assignment, OriginRule, Step, XRule
from symdh.frames.vectors import unit
from symdh.mechanism import JointAxis, Last, Vector
from symdh.notation.nodes import Equation, Generic, Juxtaposed, Name, Node, Rounded, Tuple, Unit
from symdh.notation.numbers import figures
from symdh.robot import Convention, JointType

_CONVENTION = {
    Convention.STANDARD: "Frames by the standard (distal) Denavit–Hartenberg rules",
    Convention.MODIFIED: "Frames by the modified (proximal) Denavit–Hartenberg rules",
}

#: The story of the frames speaks of the axes and of the points b_k.
_FEET = Choices(feet=True)


def frames_document(assignment: Assignment) -> Document:
    """Return the document on an assignment: axes, frames, measures, table."""
    robot = assignment.robot
    title = robot.title or robot.name
    return Document(title, (_CONVENTION[assignment.convention],), frames_chapters(assignment))


def frames_chapters(assignment: Assignment) -> tuple[Chapter, ...]:
    """Return the chapters of `frames_document`."""
    return _Narrator(assignment).chapters()


class _Narrator:
    """Tells one assignment, frame by frame and row by row."""

    def __init__(self, assignment: Assignment) -> None:
        self.found = assignment
        self.mechanism = assignment.mechanism
        self.style = Style(assignment.robot)
        self.standard = assignment.convention is Convention.STANDARD

    def chapters(self) -> tuple[Chapter, ...]:
        rows = tuple(block for k in range(1, self.mechanism.n + 1) for block in self._row(k))
        placed = tuple(block for step in self._in_order() for block in self._frame(step))
        result = table.chapter(self.style)
        return (
            Chapter("The axes", (*self._axes(), *self._snaps())),
            Chapter("The frames", (*placed, *drawings(self.found.robot, self.found.home, _FEET))),
            Chapter("The parameters", rows),
            Chapter(result.title, (*result.blocks, *self._ends())),
        )

    # The axes

    def _axes(self) -> Iterator[Block]:
        count = number_word(self.mechanism.n)
        noun = "axis" if self.mechanism.n == 1 else "axes"
        yield Paragraph(
            (
                f"The home position: {count} {noun}, each given by a point and a direction. A "
                "joint turns about its axis, or slides along it, when its variable grows.",
            )
        )
        for number, axis in enumerate(self.mechanism.axes, start=1):
            yield Paragraph(self._axis(number, axis))
        tool = self.mechanism.tool
        if tool is None:
            return
        text: Text = ("The tool's tip is at ", self._vector(tool.point))
        if tool.approach is not None and tool.sliding is not None:
            text += (
                *("; it approaches along ", self._vector(tool.approach)),
                *(" and closes along ", self._vector(tool.sliding)),
            )
        yield Paragraph((*text, "."))

    def _axis(self, number: int, axis: JointAxis) -> Text:
        kind = "revolute" if axis.type is JointType.REVOLUTE else "prismatic"
        frame = number - 1 if self.standard else number
        way = ", against it" if axis.reverse else ""
        text: Text = (
            *(f"Joint {number}, {kind}, variable ", Name(axis.variable.name)),
            *(": through ", self._vector(axis.point), " along ", self._vector(axis.direction)),
            *("; ", _z(frame), f" lies on it{way}."),
        )
        if axis.home.is_zero:
            return text
        home = self._amount(axis.home, axis.type is JointType.REVOLUTE)
        return (*text, " Here ", Equation((Name(axis.variable.name), home)), ".")

    def _snaps(self) -> Iterator[Block]:
        if not self.found.snaps:
            return
        limit = figures(float(self.mechanism.tolerance))
        yield Paragraph(
            (
                f"Some numbers miss an exact relation by less than the tolerance ({limit} rad, and "
                f"{limit} of the mechanism's size), and are taken for exact. Parameters are "
                "rounded to 15 digits.",
            )
        )
        for snap in self.found.snaps:
            unit_name = snap.unit(self._length_unit())
            miss: Text = (Rounded(figures(snap.miss)),)
            if unit_name:
                miss += (" ", Unit(unit_name))
            yield Paragraph((snap.taken_as[0].upper() + snap.taken_as[1:], "; off by ", *miss, "."))

    def _length_unit(self) -> str:
        length = self.found.robot.units.length
        return length.value if length else ""

    # The frames

    def _in_order(self) -> tuple[Step, ...]:
        """Return the frames in the order in which they are found."""
        steps = self.found.steps
        return steps if self.standard else (*steps[1:], steps[0])

    def _frame(self, step: Step) -> Iterator[Block]:
        yield Paragraph(self._why(step))
        placed = step.placed
        i = str(step.frame)
        entries = (
            EntryStep(Generic("o", i), (self._vector(placed.origin),), None),
            EntryStep(_x(step.frame), (self._vector(unit(placed.x)),), None),
            EntryStep(_z(step.frame), (self._vector(placed.z),), None),
        )
        yield EntrySteps(entries)

    def _why(self, step: Step) -> Text:
        i = step.frame
        lead: Text = (f"Frame {i}. ",)
        if step.relation is not None and step.axes is not None:
            lead += (f"Axes {step.axes[0]} and {step.axes[1]} {_RELATIONS[step.relation]}. ",)
        x = self._why_x(step)
        if step.reversed_x:
            x += (", turned round as asked",)
        return (*lead, *self._why_origin(step), "; ", *x, ".")

    def _why_origin(self, step: Step) -> Text:
        i = step.frame
        axis = i + 1 if self.standard else i
        o = Generic("o", str(i))
        zero = Generic("d", str(i))
        match step.origin_rule:
            case OriginRule.AXIS_POINT:
                return ("The origin ", o, f" is free on axis {axis}: the point given is taken")
            case OriginRule.FOOT:
                return (f"Their common normal meets axis {axis} at ", o)
            case OriginRule.MEETING:
                return ("The origin ", o, " is where they meet")
            case OriginRule.THROUGH_PREVIOUS:
                through = Generic("o", str(i - 1)) if self.standard else Generic("b", str(i))
                return (
                    *("Every common normal is as good; the one through ", through),
                    *(" makes ", zero, " zero in the home position, and it meets "),
                    *(f"axis {axis} at ", o),
                )
            case OriginRule.SAME:
                return ("Nothing asks for a step along the axis: ", o, " stays where it was")
            case OriginRule.LIKE_FIRST:
                return ("It coincides with frame 1 when the first variable is zero: so does ", o)
            case OriginRule.NO_OFFSET:
                return ("The origin ", o, " is free on the last axis and adds no offset")
            case OriginRule.TOOL:
                return ("The origin ", o, " is the tip of the tool")
            case OriginRule.CHOSEN:
                return ("The origin ", o, " is free along the axis and was chosen")
            case OriginRule.GIVEN:
                return ("The origin ", o, " is given")

    def _why_x(self, step: Step) -> Text:
        i = step.frame
        x, before = _x(i), _x(i - 1)
        first, second = step.axes or (0, 0)
        match step.x_rule:
            case XRule.WORLD:
                return (x, " is free: it follows the x axis of the world as far as it can")
            case XRule.COMMON_NORMAL:
                return (x, f" points along the normal, from axis {first} to axis {second}")
            case XRule.PLANE_NORMAL:
                a, b = (first - 1, second - 1) if self.standard else (first, second)
                return (x, " is normal to the plane of both, along ", _z(a), " × ", _z(b))
            case XRule.SAME:
                return (x, " is free and kept parallel to ", before)
            case XRule.LIKE_FIRST:
                return (x, " is ", _x(1), " there")
            case XRule.NO_ANGLE:
                return (x, " is ", before, " where the last variable is zero, or slides along")
            case XRule.TOOL_NORMAL:
                return (
                    *(_z(i), " is the approach vector, ", Generic("y", str(i), hat=True)),
                    *(" the sliding vector and ", x, " the normal vector"),
                )
            case XRule.TOWARDS_TOOL:
                return (x, " points from the last axis to the tip, ", _z(i), " along that axis")
            case XRule.CHOSEN:
                return (x, " is free and was chosen")
            case XRule.GIVEN:
                return ("so are ", x, " and ", _z(i))

    # The parameters

    def _row(self, k: int) -> Iterator[Block]:
        before, after = (step.placed for step in self.found.steps[k - 1 : k + 1])
        b = self._vector(crossing(before, after, self.found.convention))
        normal, axis = (k, k - 1) if self.standard else (k - 1, k)
        yield Paragraph(
            (
                *(f"Row {k}. The line of ", _x(normal), " meets ", _z(axis), " at "),
                *(Equation((Generic("b", str(k)), b)), "; measured in the home position:"),
            )
        )
        yield EntrySteps(self._measures(k))
        yield from self._offset(k)

    def _measures(self, k: int) -> tuple[EntryStep, ...]:
        measured = self.found.measured[k - 1]
        link = str(k if self.standard else k - 1)
        theta = EntryStep(Generic("theta", str(k)), (self._amount(measured.theta, True),), None)
        d = EntryStep(Generic("d", str(k)), (self._amount(measured.d, False),), None)
        a = EntryStep(Generic("a", link), (self._amount(measured.a, False),), None)
        alpha = EntryStep(Generic("alpha", link), (self._amount(measured.alpha, True),), None)
        return (theta, d, a, alpha) if self.standard else (alpha, a, d, theta)

    def _offset(self, k: int) -> Iterator[Block]:
        """Say how the variable enters the row where it is not simply what was measured."""
        axis, joint = self.mechanism.axes[k - 1], self.found.robot.joints[k - 1]
        turning = axis.type is JointType.REVOLUTE
        entry = joint.theta if turning else joint.d
        variable = Name(axis.variable.name)
        if entry == axis.variable:
            yield Paragraph(("That is the variable ", variable, " itself, and the row holds it."))
            return
        at_home = Equation((variable, self._amount(axis.home, turning)))
        what = "angle" if turning else "distance"
        yield Paragraph(
            (
                *("With ", at_home, f" at home, the {what} is "),
                *(self._amount(entry, turning), " in every position."),
            )
        )

    def _ends(self) -> Iterator[Block]:
        robot = self.found.robot
        if robot.base:
            yield Paragraph(
                (
                    "The base word leads from the frame in which the axes are given to frame 0: ",
                    Juxtaposed(self.style.operators(robot.base)),
                    ".",
                )
            )
        if robot.tool:
            why = (
                "no row can reach the tool, so "
                if self.standard and self.mechanism.last is not Last.JOINT
                else ""
            )
            yield Paragraph(
                (
                    f"The last frame is on the last joint; {why}the tool word leads on: ",
                    Juxtaposed(self.style.operators(robot.tool)),
                    ".",
                )
            )

    def _vector(self, vector: Vector) -> Node:
        return Tuple(tuple(self._number(entry) for entry in vector))

    def _number(self, entry: Expr) -> Node:
        if not self.found.exact and not entry.free_symbols and not entry.is_Integer:
            return Rounded(figures(float(entry.evalf(20)), 6, 7))
        return self.style.notation.write(entry)

    def _amount(self, amount: Expr, is_angle: bool) -> Node:
        return self.style.notation.angle(amount) if is_angle else self.style.notation.write(amount)


_RELATIONS = {
    Relation.SKEW: "are skew",
    Relation.INTERSECTING: "meet",
    Relation.PARALLEL: "are parallel",
    Relation.COINCIDENT: "lie on one line",
}


def _x(frame: int) -> Generic:
    return Generic("x", str(frame), hat=True)


def _z(frame: int) -> Generic:
    return Generic("z", str(frame), hat=True)
