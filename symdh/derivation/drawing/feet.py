"""The points b_k, at which a normal meets the axis of joint k, and the axes themselves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from symdh.derivation.drawing import space
from symdh.derivation.drawing.labels import HEIGHT, Candidate, centre_beside, text_width
from symdh.derivation.drawing.shapes import Ellipse, Label, Line, Pen
from symdh.derivation.drawing.skeleton import JointPlace
from symdh.derivation.drawing.solids import Body
from symdh.derivation.drawing.space import Vector
from symdh.derivation.drawing.view import View
from symdh.derivation.text import Inline
from symdh.notation.nodes import Generic
from symdh.robot import Convention

_RADIUS = 2.2
#: How far the line of an axis goes on beyond what it joins.
_BEYOND = 34.0
_SAME_POINT = 1e-3


@dataclass(frozen=True, slots=True)
class Foot:
    """Points b_k that coincide."""

    rows: tuple[int, ...]
    point: Vector

    def shape(self, view: View) -> Ellipse:
        """Return the mark."""
        return Ellipse(view.point(self.point), _RADIUS, _RADIUS, 0.0, Pen.MARK)

    def candidates(self, view: View) -> list[Candidate]:
        """Return places for its label, all around."""
        parts: list[Inline] = []
        for row in self.rows:
            parts += [", "] if parts else []
            parts.append(Generic("b", str(row)))
        text = tuple(parts)
        width = text_width(text)
        found = []
        for degrees in range(45, 405, 30):
            way = (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
            for gap, price in ((_RADIUS + 2, 0.0), (_RADIUS + 8, 0.3), (_RADIUS + 16, 0.8)):
                centre = centre_beside(view.point(self.point), gap, way, width)
                found.append(Candidate(Label(text, centre, width, HEIGHT, Pen.MARK), price))
        return found


def feet(joints: Sequence[JointPlace], convention: Convention) -> list[Foot]:
    """Return b_k for each joint (Schilling), the points that coincide in one.

    There x_k meets z_{k-1}; in the modified convention x_{k-1} meets z_k.
    """
    found: list[Foot] = []
    for joint in joints:
        standard = convention is Convention.STANDARD
        point = space.along(joint.point, joint.d if standard else 0.0, joint.axis)
        for k, foot in enumerate(found):
            if space.distance(foot.point, point) < _SAME_POINT:
                found[k] = Foot((*foot.rows, joint.row), point)
                break
        else:
            found.append(Foot((joint.row,), point))
    return found


def axis_lines(joints: Sequence[JointPlace], bodies: Sequence[Body], view: View) -> Iterator[Line]:
    """Yield the line of each joint axis, a little longer than what lies on it."""
    for joint, body in zip(joints, bodies, strict=True):
        at = space.dot(space.subtract(body.centre, joint.point), joint.axis)
        low, high = min(0.0, joint.d, at) - _BEYOND, max(0.0, joint.d, at) + _BEYOND
        ends = (space.along(joint.point, reach, joint.axis) for reach in (low, high))
        first, last = (view.point(end) for end in ends)
        if math.dist(first, last) > 1.0:
            yield Line((first, last), Pen.AXIS_LINE)
