"""The Jacobian and the singularities, which show themselves."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from symdh.derivation import singularity
from symdh.derivation.style import Style
from symdh.derivation.velocity import jacobian_chapter
from symdh.interface.shown import shown_as
from symdh.kinematics import singular, velocity
from symdh.kinematics.frame import Frame
from symdh.render.page.fragment import chapter_fragment
from symdh.robot import Robot


class GeometricJacobian(velocity.GeometricJacobian):
    """The result of `jacobian`; a notebook shows its chapter. The numbers are in `matrix`."""

    def _repr_html_(self) -> str:
        return chapter_fragment(jacobian_chapter(Style(self.robot), self))


class Singularities(singular.Singularities):
    """The result of `singularities`; a notebook shows its chapter."""

    def _repr_html_(self) -> str:
        return chapter_fragment(singularity.chapter(Style(self.robot), self))


def jacobian(
    robot: Robot,
    of: Frame | None = None,
    at: Sequence[Expr] | None = None,
    in_: Frame | None = None,
) -> GeometricJacobian:
    """Return the geometric Jacobian of a point of a frame, exact.

    Parameters
    ----------
    robot : Robot
    of : int, "base" or "tool", optional
        The frame that moves; by default the last, the tool's where there is one.
    at : three Expr, optional
        The point, in the coordinates of frame `of`; by default its origin.
    in_ : int, "base" or "tool", optional
        The frame in whose axes the components are given; by default the first.

    Returns
    -------
    GeometricJacobian
        Its `matrix` is 6 x m for m joint variables, rows v_x v_y v_z omega_x omega_y omega_z.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    LimitError
        When the closed form would be too large to write out.
    """
    return shown_as(GeometricJacobian, velocity.jacobian(robot, of, at, in_))


def singularities(
    robot: Robot, of: Frame | None = None, at: Sequence[Expr] | None = None
) -> Singularities:
    """Find where an arm loses a direction of motion.

    Parameters
    ----------
    robot : Robot
    of, at
        The point, as in `jacobian`.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    LimitError
        When the closed form would be too large to write out.
    """
    return shown_as(Singularities, singular.singularities(robot, of, at))


__all__ = ["GeometricJacobian", "Singularities", "jacobian", "singularities"]
