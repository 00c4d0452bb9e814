"""Robot -> line drawing: the one door to this package."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from statistics import median

from sympy import Expr, Symbol

from symdh.derivation.drawing import space
from symdh.derivation.drawing.caption import caption
from symdh.derivation.drawing.choices import DEFAULT, NO_VALUES, Choices
from symdh.derivation.drawing.numbers import known_numbers, stand_ins
from symdh.derivation.drawing.pose import readable_pose
from symdh.derivation.drawing.scene import Scene
from symdh.derivation.drawing.shapes import Drawing, Shape, bounds, corners, moved
from symdh.derivation.drawing.skeleton import Chain, Skeleton
from symdh.derivation.drawing.space import Vector
from symdh.derivation.drawing.view import View, view_along, view_from
from symdh.errors import LimitError
from symdh.robot import JointType, Robot

#: Rows past which an arm no longer fits a picture that can be read.
MAX_ROWS = 14
#: Where to look from in degrees: x to the right, y into the paper, z up.
AZIMUTH, ELEVATION = -60.0, 27.0
#: What fits a page, in points, with the caption below.
_WIDE, _HIGH = 420.0, 330.0
#: How long a stretch of middle length is to be; in a plane there is more to write beside it.
_STRETCH, _FLAT_STRETCH = 70.0, 84.0
#: A small arm grows until it is this tall or wide, or a stretch is this long.
_TALL, _LONGEST = 230.0, 110.0
_MARGIN = 4.0
_ATTEMPTS = 6


def draw(
    robot: Robot, values: Mapping[Symbol, Expr] = NO_VALUES, choices: Choices = DEFAULT
) -> Drawing:
    """Draw the skeleton of an arm with its joints, frames and dimensions.

    Parameters
    ----------
    robot : Robot
    values : mapping of Symbol to Expr
        Numbers for symbols, radians and the table's length unit; they win over the table's own.
        Joints that have none take a position in which no link hides another.
    choices : Choices

    Returns
    -------
    Drawing

    Raises
    ------
    LimitError
        When the robot has more than `MAX_ROWS` rows.
    UnsupportedError
        When the numbers make a length or an angle infinite or complex.
    """
    return Picture(robot, values, choices).drawing()


class Picture:
    """The arm in its position and scale, from which the drawing is made.

    Attributes
    ----------
    view : View
    scale : float
        The longest length on paper, in points.
    numbers : dict of Symbol to float
        Everything that it is drawn with.
    """

    def __init__(
        self, robot: Robot, values: Mapping[Symbol, Expr] = NO_VALUES, choices: Choices = DEFAULT
    ) -> None:
        if robot.n > MAX_ROWS:
            raise LimitError(
                f"{robot.name} has {robot.n} rows; a drawing holds no more than {MAX_ROWS}"
            )
        self.robot = robot
        self.choices = choices
        self.known = known_numbers(robot, values)
        self.invented = stand_ins(robot, self.known)
        self.chain = Chain(robot, {**self.known, **self.invented}, choices.to_scale)
        self.view = _view(self.chain, choices)
        self.pose = readable_pose(self.chain, self.view, self.known)
        self.numbers = {**self.known, **self.invented, **self.pose}
        self.scale = self._scale()

    @property
    def skeleton(self) -> Skeleton:
        """The arm in points."""
        return self.chain.skeleton(self.pose, self.scale)

    def drawing(self) -> Drawing:
        """Return the drawing; one that is too large for a page is scaled down."""
        # The arm alone first: to place labels takes longer than all the rest.
        self._shrink(lambda: self._scene().bare(), _WIDE - 4 * _MARGIN, _HIGH - 4 * _MARGIN)
        return self._framed(self._shrink(lambda: self._scene().shapes(), _WIDE, _HIGH))

    def _shrink(self, make: Callable[[], list[Shape]], wide: float, high: float) -> list[Shape]:
        """Make shapes, at a smaller scale as long as they are too large."""
        shapes = make()
        for _ in range(_ATTEMPTS):
            width, height = _extent(shapes)
            part = min(wide / width, high / height)
            if part >= 1:
                break
            # Joints and labels keep their size, so the arm has to give more than its share.
            self.scale *= 0.97 * part
            shapes = make()
        return shapes

    def _scene(self) -> Scene:
        return Scene(self.robot, self.skeleton, self.view, self.choices, self.scale)

    def _framed(self, shapes: Sequence[Shape]) -> Drawing:
        left, low, _, _ = bounds([point for shape in shapes for point in corners(shape)])
        width, height = _extent(shapes)
        inside = tuple(moved(s, _MARGIN - left, _MARGIN - low) for s in shapes)
        return Drawing(
            width + 2 * _MARGIN,
            height + 2 * _MARGIN,
            inside,
            f"Skeleton of {self.robot.title or self.robot.name}",
            caption(self.robot, {**self.invented, **self.pose}, self.view, self.choices.to_scale),
        )

    def _scale(self) -> float:
        """Return the scale at which stretches are neither long nor short on paper."""
        bare = self.chain.skeleton(self.pose, 1.0)
        seen = [math.dist(self.view.point(s.start), self.view.point(s.end)) for s in bare.stretches]
        wanted = _FLAT_STRETCH if self.view.flat else _STRETCH
        if not seen:
            return wanted
        points = [self.view.point(end) for s in bare.stretches for end in (s.start, s.end)]
        left, low, right, high = bounds(points)
        # A stretch that is seen end on has no length on paper.
        extent, longest = max(right - left, high - low, 0.3), max(*seen, 0.3)
        scale = wanted / max(median(seen), 0.3)
        return max(scale, min(_TALL / extent, _LONGEST / longest))


def _extent(shapes: Sequence[Shape]) -> tuple[float, float]:
    left, low, right, high = bounds([point for shape in shapes for point in corners(shape)])
    return max(right - left, 1.0), max(high - low, 1.0)


def _view(chain: Chain, choices: Choices) -> View:
    if choices.azimuth is None and choices.elevation is None:
        normal = plane_of_motion(chain)
        if normal is not None:
            return view_along(normal)
    return view_from(
        AZIMUTH if choices.azimuth is None else choices.azimuth,
        ELEVATION if choices.elevation is None else choices.elevation,
    )


def plane_of_motion(chain: Chain) -> Vector | None:
    """Return the normal of the plane that an arm moves in, towards its first axis; else None.

    An arm is planar when its turning joints are parallel and no stretch leaves the plane.
    """
    straight = {joint.variable: 0.0 for joint in chain.robot.joints if joint.variable}
    bare = chain.skeleton(straight, 1.0)
    turning = [joint.axis for joint in bare.joints if joint.type is JointType.REVOLUTE]
    if not turning or not bare.stretches:
        return None
    normal = turning[0]
    across = [space.subtract(s.end, s.start) for s in bare.stretches]
    parallel = all(abs(space.dot(axis, normal)) > 1 - 1e-9 for axis in turning)
    level = all(abs(space.dot(way, normal)) < 1e-9 for way in across)
    return normal if parallel and level else None
