"""Skeleton -> shapes: the arm itself, then what is written about it."""

from __future__ import annotations

from collections.abc import Sequence

from symdh.derivation.drawing import axes, ends, labels, measures
from symdh.derivation.drawing.bodies import joint_bodies, stub
from symdh.derivation.drawing.choices import Choices
from symdh.derivation.drawing.feet import Foot, axis_lines, feet
from symdh.derivation.drawing.labels import Candidate, Obstacles
from symdh.derivation.drawing.painter import Bar, painted
from symdh.derivation.drawing.plane import Stroke
from symdh.derivation.drawing.shapes import Ellipse, Line, Pen, Shape, bounds
from symdh.derivation.drawing.skeleton import Skeleton
from symdh.derivation.drawing.solids import outline
from symdh.derivation.drawing.view import View
from symdh.robot import JointType, Robot

#: What it costs a label to cover 10 points of a line of each sort, or the whole of a joint.
_COST_OF_BAR, _COST_OF_ARROW, _COST_OF_ARC, _COST_OF_END, _COST_OF_BODY = 1.6, 2.2, 1.5, 0.8, 4.0
_DOT = 1.5
#: Least and largest radius of a joint, and length of an axis.
_RADII, _ARROWS = (4.0, 7.0), (19.0, 28.0)


class Scene:
    """The arm in its position, with its joints and ends in their places.

    Parameters
    ----------
    robot : Robot
    skeleton : Skeleton
        In points.
    view : View
    choices : Choices
    scale : float
        How long the longest length is, in points; joints and arrows follow it, within bounds.
    """

    def __init__(
        self, robot: Robot, skeleton: Skeleton, view: View, choices: Choices, scale: float
    ) -> None:
        self.robot = robot
        self.skeleton = skeleton
        self.view = view
        self.choices = choices
        self.bodies = joint_bodies(skeleton.joints, view, _within(_RADII, 0.12 * scale))
        self.floor = ends.ground(skeleton, self.bodies, view)
        self.hand = ends.tool(skeleton, self.bodies, view)
        self.bars = self._bars()
        letters = "xy" if view.flat else "xyz" if choices.y_axes else "xz"
        self.arrows = axes.arrows(skeleton.frames, letters, _within(_ARROWS, 0.45 * scale))
        self.feet = feet(skeleton.joints, robot.convention) if choices.feet else []
        self.turns, self.angles = self._turns()

    def bare(self) -> list[Shape]:
        """Return the shapes that have a place whatever is written beside them."""
        return [
            *(axis_lines(self.skeleton.joints, self.bodies, self.view) if self.feet else ()),
            *self.floor.shapes,
            *painted(self.view, self.bars, self.bodies),
            *self.hand.shapes,
        ]

    def shapes(self) -> list[Shape]:
        """Return all shapes of the drawing, far ones first."""
        placed = labels.place(self._wishes(), self._obstacles())
        return [
            *self.bare(),
            *(line for candidate in placed for line in candidate.lines),
            *self.turns,
            *(shape for arrow in self.arrows for shape in arrow.shapes(self.view)),
            *(foot.shape(self.view) for foot in self.feet),
            *self._origins(),
            *(candidate.label for candidate in placed),
        ]

    def _bars(self) -> list[Bar]:
        bars = [Bar(stretch.start, stretch.end) for stretch in self.skeleton.stretches]
        for joint, body in zip(self.skeleton.joints, self.bodies, strict=True):
            side = stub(joint, body)
            bars += [Bar(*side)] if side else []
        return bars + [end.bar for end in (self.floor, self.hand) if end.bar]

    def _turns(self) -> tuple[list[Line], list[list[Candidate]]]:
        """Return the arcs of the joints that turn, and where their labels may go."""
        lines: list[Line] = []
        wishes: list[list[Candidate]] = []
        for joint, body in zip(self.skeleton.joints, self.bodies, strict=True):
            if joint.type is not JointType.REVOLUTE:
                continue
            text = measures.angle_text(self.robot, joint.row)
            if not self.view.flat:
                lines.append(measures.turn_arrow(body, self.view))
                wishes.append(measures.body_candidates(body, self.view, text))
                continue
            arc = measures.arc(joint, self.view)
            if arc is not None:
                lines += arc.lines
                wishes.append(measures.arc_candidates(arc, text))
        return lines, wishes

    def _wishes(self) -> list[list[Candidate]]:
        """Return the places that each label may take; what has least to choose from first."""
        named: list[axes.Arrow | Foot] = [*self.arrows, *self.feet]
        lengths = [
            measures.dimension(
                (self.view.point(stretch.start), self.view.point(stretch.end)),
                measures.dimension_text(self.robot, stretch),
            )
            for stretch in self.skeleton.stretches
        ]
        return [*(each.candidates(self.view) for each in named), *self.angles, *lengths]

    def _obstacles(self) -> Obstacles:
        view = self.view
        arrows = [shape for arrow in self.arrows for shape in arrow.shapes(view)]
        sorts: tuple[tuple[Sequence[Stroke], float], ...] = (
            ([(view.point(bar.start), view.point(bar.end)) for bar in self.bars], _COST_OF_BAR),
            (labels.strokes(arrows), _COST_OF_ARROW),
            (labels.strokes(self.turns), _COST_OF_ARC),
            (labels.strokes((*self.floor.shapes, *self.hand.shapes)), _COST_OF_END),
        )
        return Obstacles(
            [(stroke, price) for strokes, price in sorts for stroke in strokes],
            [(bounds(outline(body, view)), _COST_OF_BODY) for body in self.bodies],
        )

    def _origins(self) -> list[Ellipse]:
        points = (self.view.point(placement.origin) for _, placement in self.skeleton.frames)
        places = dict.fromkeys((round(x, 3), round(y, 3)) for x, y in points)
        return [Ellipse(place, _DOT, _DOT, 0.0, Pen.ORIGIN) for place in places]


def _within(limits: tuple[float, float], size: float) -> float:
    return min(max(size, limits[0]), limits[1])
