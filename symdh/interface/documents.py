"""Derivations and drawings that show themselves."""

from __future__ import annotations

from symdh.derivation import derive as documents
from symdh.derivation.blocks import Document
from symdh.derivation.drawing import draw as drawings
from symdh.derivation.drawing import shapes
from symdh.derivation.drawing.choices import DEFAULT, Choices
from symdh.derivation.style import Naming, Order
from symdh.interface.shown import shown_as
from symdh.interface.values import NO_VALUES, Values, exact_values
from symdh.render.drawing.svg import render_svg
from symdh.render.page.fragment import document_fragment
from symdh.robot import Robot


class Derivation(Document):
    """A derivation, chapter by chapter; a notebook shows all of it."""

    def _repr_html_(self) -> str:
        return document_fragment(self)


class Drawing(shapes.Drawing):
    """A line drawing of an arm; a notebook shows it."""

    def _repr_svg_(self) -> str:
        return render_svg(self)


def derive(
    robot: Robot, order: Order | str = Order.RIGHT, naming: Naming | str = Naming.AUTO
) -> Derivation:
    """Derive the forward kinematics of a robot, every step of it.

    Parameters
    ----------
    robot : Robot
    order : str
        ``"right"`` multiplies from the hand to the base, ``"left"`` from the base to the hand.
    naming : str
        How a pose is written: ``"standard"``, ``"craig"`` or ``"auto"``.
    """
    return shown_as(Derivation, documents.derive(robot, order, naming))


def draw(robot: Robot, values: Values = NO_VALUES, choices: Choices = DEFAULT) -> Drawing:
    """Draw the skeleton of an arm with its joints, frames and dimensions.

    Parameters
    ----------
    robot : Robot
    values : mapping of str or Symbol to a number
        Numbers to draw with, radians and the table's length unit; they win over the table's own.
    choices : Choices
        The direction to look from and what is drawn.

    Raises
    ------
    LimitError
        When the robot has too many rows for a picture.
    UnsupportedError
        When the numbers make a length or an angle infinite or complex.
    """
    return shown_as(Drawing, drawings.draw(robot, exact_values(values), choices))


__all__ = ["Choices", "Derivation", "Drawing", "derive", "draw"]
