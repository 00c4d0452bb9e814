"""Frames in space, the four parameters between two of them, and the word that leads to one."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Expr, ImmutableMatrix, cos, sin

from symdh.frames import vectors as v
from symdh.frames.exact import angle, is_zero, tidy
from symdh.mechanism import ONE, Vector
from symdh.motion import Word, rotation, translation
from symdh.robot import Axis, Convention, Motion, MotionKind


@dataclass(frozen=True, slots=True)
class PlacedFrame:
    """A right-handed frame, seen from the world.

    Attributes
    ----------
    origin : Vector
    x : Vector
        The direction of the x axis, of any length.
    z : Vector
        The unit vector of the z axis, at right angles to `x`.
    """

    origin: Vector
    x: Vector
    z: Vector

    @property
    def columns(self) -> tuple[Vector, Vector, Vector]:
        """The unit vectors of the three axes."""
        x = v.unit(self.x)
        return x, v.cross(self.z, x), self.z

    @property
    def matrix(self) -> ImmutableMatrix:
        """The 4x4 pose in the world."""
        columns = (*self.columns, self.origin)
        rows = [[column[row] for column in columns] for row in range(3)]
        return ImmutableMatrix([*rows, [0, 0, 0, 1]])

    def moved(self, motion: Motion) -> PlacedFrame:
        """Return the frame that an elementary motion of this one's own axes leads to."""
        columns = list(self.columns)
        if motion.kind is MotionKind.TRANSLATION:
            point = v.along(self.origin, motion.amount, columns[motion.axis])
            return PlacedFrame(point, columns[0], self.z)
        first, second = (motion.axis + 1) % 3, (motion.axis + 2) % 3
        c, s = cos(motion.amount), sin(motion.amount)
        a, b = columns[first], columns[second]
        columns[first] = v.add(v.scale(c, a), v.scale(s, b))
        columns[second] = v.subtract(v.scale(c, b), v.scale(s, a))
        return PlacedFrame(self.origin, columns[0], columns[2])


WORLD = PlacedFrame(v.ORIGIN, v.X, v.Z)


@dataclass(frozen=True, slots=True)
class Measured:
    """The parameters between two neighbouring frames.

    In a modified table `a` and `alpha` mean a_{i-1} and alpha_{i-1}.

    Attributes
    ----------
    theta, d, a, alpha : Expr
        Radians and the length unit.
    """

    theta: Expr
    d: Expr
    a: Expr
    alpha: Expr


def measure(before: PlacedFrame, after: PlacedFrame, convention: Convention) -> Measured:
    """Measure theta, d, a and alpha from one frame to the next, both as the convention wants them.

    Standard: theta from x_{i-1} to x_i about z_{i-1}, d along it; alpha from z_{i-1} to z_i about
    x_i, a along it. Modified: alpha_{i-1} and a_{i-1} about and along x_{i-1}, theta_i and d_i
    about and along z_i (Spong, Craig).
    """
    standard = convention is Convention.STANDARD
    normal = after.x if standard else before.x
    axis = before.z if standard else after.z
    step = v.subtract(after.origin, before.origin)
    # The normal is made a unit vector last: its length may be a root, and so it is one alone.
    size = v.length(normal)
    twist = v.dot(normal, v.cross(before.z, after.z))
    return Measured(
        theta=angle_about(axis, before.x, after.x),
        d=v.dot(step, axis),
        a=tidy(v.dot(step, normal) / size),
        alpha=angle(tidy(twist / size), v.dot(before.z, after.z)),
    )


def crossing(before: PlacedFrame, after: PlacedFrame, convention: Convention) -> Vector:
    """Return b_i, where the normal meets the joint's axis (Schilling).

    x_i and z_{i-1} in the standard convention, x_{i-1} and z_i in the modified one.
    """
    step = v.subtract(after.origin, before.origin)
    if convention is Convention.STANDARD:
        return v.along(before.origin, v.dot(step, before.z), before.z)
    normal = v.unit(before.x)
    return v.along(before.origin, v.dot(step, normal), normal)


def angle_about(axis: Vector, start: Vector, end: Vector) -> Expr:
    """Return the angle about a unit vector from one direction to another, both at right angles."""
    return angle(v.dot(axis, v.cross(start, end)), v.dot(start, end))


def turned(direction: Vector, axis: Vector, amount: Expr) -> Vector:
    """Turn a direction about a unit vector at right angles to it."""
    if is_zero(amount):
        return direction
    across = v.cross(axis, direction)
    return v.add(v.scale(cos(amount), direction), v.scale(sin(amount), across))


def seen_from(frame: PlacedFrame, other: PlacedFrame) -> PlacedFrame:
    """Return another frame in the coordinates of a frame."""
    columns = frame.columns

    def inside(vector: Vector) -> Vector:
        return (v.dot(columns[0], vector), v.dot(columns[1], vector), v.dot(columns[2], vector))

    step = inside(v.subtract(other.origin, frame.origin))
    return PlacedFrame(step, inside(v.unit(other.x)), inside(other.z))


def word_to(frame: PlacedFrame) -> Word:
    """Return a short word that leads from the world to a frame: slides, then turns."""
    slides = (translation(axis, frame.origin[axis]) for axis in Axis)
    turns = (rotation(axis, amount) for axis, amount in _turns(frame))
    return tuple(motion for motion in (*slides, *turns) if not is_zero(motion.amount))


def _turns(frame: PlacedFrame) -> tuple[tuple[Axis, Expr], ...]:
    """Return the rotation as one turn about y, or as turns about z, y and x."""
    x, y, z = frame.columns
    if is_zero(y[1] - ONE):
        return ((Axis.Y, angle(z[0], z[2])),)
    if is_zero(x[0]) and is_zero(x[1]):
        # x points up or down: z and x turn about one line, and x does it alone.
        down = is_zero(x[2] + ONE)
        quarter = angle(-x[2], x[0])
        return (Axis.Y, quarter), (Axis.X, angle(y[0] if down else -y[0], y[1]))
    level = v.length((x[0], x[1], x[2] * 0))
    return (
        (Axis.Z, angle(x[1], x[0])),
        (Axis.Y, angle(tidy(-x[2]), level)),
        (Axis.X, angle(y[2], z[2])),
    )
