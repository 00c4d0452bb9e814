"""Space -> paper: an orthographic view from a direction."""

from __future__ import annotations

import math
from dataclasses import dataclass

from symdh.derivation.drawing import space
from symdh.derivation.drawing.shapes import Point
from symdh.derivation.drawing.space import Vector


@dataclass(frozen=True, slots=True)
class View:
    """An orthographic view by the directions of the paper in space.

    Attributes
    ----------
    right, up, toward : Vector
        Unit vectors at right angles; `toward` points at whoever looks.
    flat : bool
        The arm moves in the plane of the paper.
    """

    right: Vector
    up: Vector
    toward: Vector
    flat: bool = False

    def point(self, point: Vector) -> Point:
        """Return where a point of space is on paper."""
        return space.dot(self.right, point), space.dot(self.up, point)

    def depth(self, point: Vector) -> float:
        """Return how near a point is to whoever looks."""
        return space.dot(self.toward, point)


def view_from(azimuth: float, elevation: float) -> View:
    """Return the view from a direction; the world's z axis points up.

    Parameters
    ----------
    azimuth : float
        Degrees about z from the x axis to where one stands.
    elevation : float
        Degrees above the xy plane, -90 to 90.
    """
    a, e = math.radians(azimuth), math.radians(elevation)
    return View(
        right=(-math.sin(a), math.cos(a), 0.0),
        up=(-math.cos(a) * math.sin(e), -math.sin(a) * math.sin(e), math.cos(e)),
        toward=(math.cos(a) * math.cos(e), math.sin(a) * math.cos(e), math.sin(e)),
    )


def view_along(normal: Vector) -> View:
    """Return the view onto a plane, given the side that is seen.

    The world's z points up where the plane is upright, else y does.
    """
    upright = abs(normal[2]) < 0.5
    guess = space.Z if upright else space.Y
    up = space.unit(space.along(guess, -space.dot(guess, normal), normal))
    return View(space.cross(up, normal), up, normal, flat=True)
