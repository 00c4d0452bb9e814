"""The posture of an arm: on which side the shoulder is, where the elbow, how the wrist is turned.

Each feature is a number that geometry gives, from the joint axes in space; its sign has a name. So
two solutions are told apart by what the arm looks like and not by the sign of a root.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from itertools import pairwise

from sympy import Expr, Symbol

from symdh.kinematics.inverse.lines import (
    Axes,
    Line,
    Vector,
    across,
    are_parallel,
    cross,
    dot,
    length,
    span,
)
from symdh.kinematics.inverse.numeric_chain import NumericChain
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.kinematics.inverse.task import Kind
from symdh.robot import JointType

Measure = Callable[[Sequence[float]], float]

_UP: Vector = (0.0, 0.0, 1.0)
#: Smaller than this, in parts of the reach, is nothing.
_NOTHING = 1e-9


class Part(Enum):
    """The part of an arm that a feature is of."""

    SHOULDER = "shoulder"
    ELBOW = "elbow"
    WRIST = "wrist"
    SLIDE = "slide"


@dataclass(frozen=True)
class Feature:
    """A side that a part of the arm can be on.

    Attributes
    ----------
    part : Part
    names : tuple of (str, str)
        What it is called where the measure is positive, and where it is negative.
    meaning : str
        What the names mean, a sentence; empty where they say it themselves.
    measure : callable
        Gives a number for joint values.
    """

    part: Part
    names: tuple[str, str]
    meaning: str
    measure: Measure

    def name(self, q: Sequence[float]) -> str:
        """Return the name of the side for joint values."""
        return self.names[0 if self.measure(q) >= 0 else 1]


class Skeleton:
    """The joint axes of an arm in space, and the point that its goal is about.

    Parameters
    ----------
    form : ClosedForm
    numbers : mapping of Symbol to Expr
        Numbers for all parameters.
    """

    def __init__(self, form: ClosedForm, numbers: Mapping[Symbol, Expr]) -> None:
        arm = form.arm
        tool = arm.given.tool if arm.tool_inside else ()
        values = {**arm.given.values, **numbers}
        robot = replace(arm.given, base=(), tool=tool, values=values)
        self._axes, self._chain = Axes(robot), NumericChain.of(robot)
        self._moving = set(arm.moving)
        known = {**values, **{letter: m.xreplace(values) for letter, m in arm.meanings.items()}}
        self._hand = [float(part.xreplace(known)) for part in arm.hand]
        self.reach = self._chain.reach

    def lines(self, q: Sequence[float]) -> dict[int, Line]:
        """Return the axes of the joints that move, by row."""
        return {line.row: line for line in self._axes.lines(q) if line.row in self._moving}

    def point(self, q: Sequence[float]) -> Vector:
        """Return the point of the hand: the wrist centre where the hand is taken off."""
        x, y, z = (
            row[3] - sum(entry * part for entry, part in zip(row, self._hand, strict=False))
            for row in self._chain.pose(q)
        )
        return x, y, z


def features(form: ClosedForm, skeleton: Skeleton, q: Sequence[float]) -> tuple[Feature, ...]:
    """Return the features that an arm has.

    Parameters
    ----------
    form : ClosedForm
    skeleton : Skeleton
    q : sequence of float
        Joint values in general position: there it shows what is parallel and what has an offset.
    """
    lines = skeleton.lines(q)
    shoulder = _shoulder(form, skeleton, q)
    found = [shoulder] if shoulder is not None else []
    for run in form.structure.parallel:
        elbow = _elbow(form, skeleton, [row for row in run if row in lines], lines)
        found += [elbow] if elbow is not None else []
    found += [_triple(skeleton, part, rows) for part, rows in _triples(form, lines)]
    return (*found, *_slides(form))


def _shoulder(form: ClosedForm, skeleton: Skeleton, q: Sequence[float]) -> Feature | None:
    """Return on which side of the first axis the arm stands, or whether it faces the goal."""
    lines, moving = skeleton.lines(q), form.arm.moving
    if len(moving) < 3 or form.task.kind is Kind.ORIENTATION:
        return None
    first, second = lines[moving[0]], lines[moving[1]]
    turning = first.type is second.type is JointType.REVOLUTE
    if not turning or abs(dot(first.direction, second.direction)) > _NOTHING:
        return None
    small = _NOTHING * skeleton.reach
    if abs(dot(span(first.point, skeleton.point(q)), second.direction)) > small:
        return _side(skeleton, first.row, second.row)
    if length(_start(first, second)) > small:
        return _facing(skeleton, first.row, second.row)
    return None


def _side(skeleton: Skeleton, first: int, second: int) -> Feature:
    """The arm moves in a plane beside the first axis."""

    def left(q: Sequence[float]) -> float:
        lines = skeleton.lines(q)
        axis, hinge = lines[first].direction, lines[second].direction
        goal = across(span(lines[first].point, skeleton.point(q)), axis)
        return dot(goal, hinge) * dot(axis, cross(goal, hinge))

    return Feature(
        Part.SHOULDER,
        ("shoulder left", "shoulder right"),
        f"Seen from above, with the goal ahead, the arm stands to the left or to the right of the "
        f"axis of joint {first}.",
        left,
    )


def _facing(skeleton: Skeleton, first: int, second: int) -> Feature:
    """The arm begins at a distance from the first axis, on the side of the goal or behind."""

    def forward(q: Sequence[float]) -> float:
        lines = skeleton.lines(q)
        goal = span(lines[first].point, skeleton.point(q))
        return dot(_start(lines[first], lines[second]), goal)

    return Feature(
        Part.SHOULDER,
        ("facing the goal", "facing away"),
        f"The axis of joint {second} is on the side of the goal, or the arm reaches back over the "
        f"axis of joint {first}.",
        forward,
    )


def _start(first: Line, second: Line) -> Vector:
    """Return the vector from one axis to another that is perpendicular to both."""
    return across(across(span(first.point, second.point), first.direction), second.direction)


def _elbow(
    form: ClosedForm, skeleton: Skeleton, run: Sequence[int], lines: Mapping[int, Line]
) -> Feature | None:
    """Return on which side of the line from the shoulder to the wrist the elbow is."""
    if len(run) < 2:
        return None
    first, elbow = run[:2]
    last = run[2] if len(run) > 2 else None

    def sides(q: Sequence[float]) -> tuple[Vector, Vector]:
        """Return where the elbow and where the wrist is, seen along the axes."""
        now = skeleton.lines(q)
        begin, axis = now[first].point, now[elbow].direction
        end = skeleton.point(q) if last is None else now[last].point
        return across(span(begin, now[elbow].point), axis), across(span(begin, end), axis)

    def left(q: Sequence[float]) -> float:
        bent, goal = sides(q)
        return dot(_UP, cross(goal, bent))

    def above(q: Sequence[float]) -> float:
        bent, goal = sides(q)
        return dot(bent, across(_UP, goal))

    point = "point w" if form.arm.is_shifted else "point p"
    end = f"the axis of joint {last}" if last else "the centre of the wrist"
    if last is None and form.structure.wrist is None:
        end = f"the {point}"
    line = f"the line from the axis of joint {first} to {end}"
    upright = abs(dot(lines[elbow].direction, _UP))
    if upright > 1 - _NOTHING:
        names = ("elbow left", "elbow right")
        if len(form.arm.moving) == 2:
            names = ("left-hand solution", "right-hand solution")
        meaning = f"Seen from above, the elbow is to the left or to the right of {line}."
        return Feature(Part.ELBOW, names, meaning, left)
    if upright < _NOTHING:
        meaning = f"The elbow is above or below {line}; up is z of frame 0."
        return Feature(Part.ELBOW, ("elbow up", "elbow down"), meaning, above)
    return None


def _triples(form: ClosedForm, lines: Mapping[int, Line]) -> Iterator[tuple[Part, tuple[int, ...]]]:
    """Yield the last and the first three joints where they turn about axes in three directions."""
    moving = form.arm.moving
    ends = [(Part.WRIST, moving[-3:])] if form.task.with_orientation else []
    if form.structure.shoulder is not None:
        ends.append((Part.SHOULDER, form.structure.shoulder))
    for part, rows in ends:
        three = [lines[row] for row in rows if row in lines]
        turning = all(line.type is JointType.REVOLUTE for line in three)
        if len(three) == 3 and turning and not any(are_parallel(a, b) for a, b in pairwise(three)):
            yield part, tuple(rows)


def _triple(skeleton: Skeleton, part: Part, rows: Sequence[int]) -> Feature:
    """The middle one of three joints is turned to one side or to the other."""
    before, middle, after = rows

    def handed(q: Sequence[float]) -> float:
        lines = skeleton.lines(q)
        normal = cross(lines[before].direction, lines[after].direction)
        return dot(normal, lines[middle].direction)

    return Feature(
        part,
        (f"{part.value} not flipped", f"{part.value} flipped"),
        f"Not flipped, joint {middle} turns the axis of joint {after} away from that of joint "
        f"{before} by a positive angle.",
        handed,
    )


def _slides(form: ClosedForm) -> Iterator[Feature]:
    """Yield for each prismatic joint whether its d is positive."""
    given = form.arm.given
    known = {s: v for s, v in given.values.items() if s in given.parameters}
    for row in form.ring.slides:
        joint = given.joints[row - 1]
        assert joint.variable is not None
        place = given.variables.index(joint.variable)
        slope = joint.d.diff(joint.variable)
        constant = (joint.d - slope * joint.variable).xreplace(known)
        if not constant.free_symbols:
            yield _slide(row, place, float(slope), float(constant))


def _slide(row: int, place: int, slope: float, constant: float) -> Feature:
    return Feature(
        Part.SLIDE,
        (f"slide {row} forward", f"slide {row} backward"),
        f"The slide of joint {row} is out along its axis, or back against it.",
        lambda q: slope * q[place] + constant,
    )
