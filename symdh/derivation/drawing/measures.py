"""What is measured: lengths as dimension lines, angles as arcs."""

from __future__ import annotations

import math
from dataclasses import dataclass

from symdh.derivation.drawing import plane, space
from symdh.derivation.drawing.labels import HEIGHT, Candidate, centre_beside, text_width
from symdh.derivation.drawing.shapes import Label, Line, Pen, Point
from symdh.derivation.drawing.skeleton import JointPlace, Stretch
from symdh.derivation.drawing.solids import Body
from symdh.derivation.drawing.view import View
from symdh.derivation.text import Text
from symdh.notation import Notation
from symdh.notation.nodes import Generic, Name, Node
from symdh.robot import Axis, Convention, Robot

#: Distances of a dimension line from its stretch, and what they cost.
_OFFSETS = ((15.0, 0.1), (23.0, 0.3), (33.0, 0.6))
#: A stretch that is shorter than this on paper has no room for arrows.
_SHORT = 20.0
#: An arc is as far from its joint as its label needs, within these bounds.
_ARCS, _FLAT_GUIDE = (19.0, 30.0), 38.0
_STEP = math.radians(12)


def dimension_text(robot: Robot, stretch: Stretch) -> Text:
    """Return what a length is called: its symbol, or its letter with its index."""
    node = Notation(robot).write(stretch.motion.amount)
    if stretch.row is None or isinstance(node, Name):
        return (node,)
    if stretch.motion.axis is Axis.Z:
        return (Generic("d", str(stretch.row)),)
    shift = robot.convention is Convention.MODIFIED
    return (Generic("a", str(stretch.row - shift)),)


def angle_text(robot: Robot, row: int) -> Text:
    """Return what the angle of a row is called: its symbol, or theta with its index."""
    node: Node = Notation(robot).angle(robot.joints[row - 1].theta)
    return (node,) if isinstance(node, Name) else (Generic("theta", str(row)),)


def dimension(stroke: plane.Stroke, text: Text) -> list[Candidate]:
    """Return ways to dimension a stroke: a line with arrows beside it, or the label alone."""
    found = []
    along = plane.direction(stroke)
    width = text_width(text)
    size = math.dist(*stroke)
    for side in (1.0, -1.0):
        out = (side * plane.left_of(along)[0], side * plane.left_of(along)[1])
        for part in (0.5, 0.35, 0.65, 0.2, 0.8):
            middle = plane.between(stroke, part)
            shift = 0.5 * abs(part - 0.5)
            if size >= _SHORT and 0.3 < part < 0.7:
                for offset, price in _OFFSETS:
                    anchor = plane.onward(middle, offset, out)
                    label = _label(text, centre_beside(anchor, 1.5, out, width), width)
                    lines = _dimension_lines(stroke, out, offset)
                    found.append(Candidate(label, price + shift, lines))
            for gap, price in ((4.5, 0.9), (9.0, 1.2), (16.0, 2.0)):
                label = _label(text, centre_beside(middle, gap, out, width), width)
                found.append(Candidate(label, price + shift))
    return found


def _label(text: Text, centre: Point, width: float) -> Label:
    return Label(text, centre, width, HEIGHT, Pen.DIMENSION)


def _dimension_lines(stroke: plane.Stroke, out: Point, offset: float) -> tuple[Line, ...]:
    a, b = (plane.onward(end, offset, out) for end in stroke)
    guides = (
        Line((plane.onward(end, 5.0, out), plane.onward(end, offset + 3.0, out)), Pen.GUIDE)
        for end in stroke
    )
    return Line((a, b), Pen.DIMENSION, head=True, tail=True), *guides


@dataclass(frozen=True, slots=True)
class Arc:
    """The angle of a joint that is seen along its axis, from x to x.

    Attributes
    ----------
    centre : Point
    radius, middle : float
        Its distance from the joint, and the angle of its middle.
    lines : tuple of Line
    """

    centre: Point
    radius: float
    middle: float
    lines: tuple[Line, ...]


def arc(joint: JointPlace, view: View) -> Arc | None:
    """Return the arc of a joint; None where it is too small to be seen."""
    centre = view.point(joint.point)
    first = math.atan2(*view.point(joint.before)[::-1])
    last = math.atan2(*view.point(joint.after)[::-1])
    sweep = math.remainder(last - first, 2 * math.pi)
    if abs(sweep) < math.radians(8):
        return None
    radius = min(max(7.5 / math.sin(abs(sweep) / 2), _ARCS[0]), _ARCS[1])
    count = max(3, round(abs(sweep) / _STEP))
    points = tuple(
        plane.onward(centre, radius, (math.cos(t), math.sin(t)))
        for t in (first + sweep * k / count for k in range(count + 1))
    )
    guide = plane.onward(centre, _FLAT_GUIDE, (math.cos(first), math.sin(first)))
    lines = (Line((centre, guide), Pen.GUIDE), Line(points, Pen.TURN, head=True))
    return Arc(centre, radius, first + sweep / 2, lines)


def arc_candidates(arc: Arc, text: Text) -> list[Candidate]:
    """Return places for the label of an arc: beyond its middle first."""
    width = text_width(text)
    found = []
    for degrees in (0, 15, -15, 30, -30, 60, -60, 180):
        angle = arc.middle + math.radians(degrees)
        way = (math.cos(angle), math.sin(angle))
        for gap, price in ((arc.radius + 1.5, 0.0), (arc.radius + 8, 0.3)):
            place = centre_beside(arc.centre, gap, way, width)
            label = Label(text, place, width, HEIGHT, Pen.TURN)
            found.append(Candidate(label, price + abs(degrees) / 120))
    return found


def turn_arrow(body: Body, view: View) -> Line:
    """Return an arrow around a cylinder, on the near side, the way its joint turns."""
    radius = body.radius + 3.5
    third = space.cross(body.axis, body.across)
    toward = (space.dot(view.toward, body.across), space.dot(view.toward, third))
    nearest = math.atan2(toward[1], toward[0])
    reach = math.radians(105)
    count = 10
    points = []
    for k in range(count + 1):
        t = nearest - reach + 2 * reach * k / count
        rim = space.along(body.centre, radius * math.cos(t), body.across)
        points.append(view.point(space.along(rim, radius * math.sin(t), third)))
    return Line(tuple(points), Pen.TURN, head=True)


def body_candidates(body: Body, view: View, text: Text) -> list[Candidate]:
    """Return places for a label around a body."""
    centre = view.point(body.centre)
    width = text_width(text)
    found = []
    for degrees in range(0, 360, 20):
        way = (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
        for gap, price in ((body.radius + 5.5, 0.0), (body.radius + 11, 0.3), (28, 1.0)):
            place = centre_beside(centre, gap, way, width)
            found.append(Candidate(Label(text, place, width, HEIGHT, Pen.TURN), price))
    return found
