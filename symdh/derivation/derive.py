"""A robot's forward kinematics as a document."""

from __future__ import annotations

from symdh.derivation import (
    general,
    links,
    meaning,
    numbers,
    picture,
    products,
    recursion,
    result,
    singularity,
    table,
    velocity,
)
from symdh.derivation.blocks import Chapter, Document, Text
from symdh.derivation.style import Naming, Order, Style
from symdh.kinematics.forward import forward_kinematics
from symdh.kinematics.singular import MAX_JOINTS, singularities
from symdh.kinematics.velocity import has_closed_jacobian
from symdh.robot import Convention, Robot

_CONVENTION = {
    Convention.STANDARD: "Standard (distal) Denavit–Hartenberg convention",
    Convention.MODIFIED: "Modified (proximal) Denavit–Hartenberg convention",
}


#: Rows past which a document gives the recursion in place of one product after the other, and past
#: which it leaves velocity out: by then the steps fill tens of pages.
PRODUCT_LIMIT = 12
VELOCITY_LIMIT = 10


def derive(
    robot: Robot, order: Order | str = Order.RIGHT, naming: Naming | str = Naming.AUTO
) -> Document:
    """Derive the forward kinematics of a robot, every step of it.

    Parameters
    ----------
    robot : Robot
    order : Order or str
        ``"right"`` multiplies from the hand to the base, ``"left"`` from the base to the hand.
    naming : Naming or str
        ``"standard"`` writes 0T3 with the frame after the T, ``"craig"`` with both before it;
        ``"auto"`` follows the table's convention.

    Returns
    -------
    Document
    """
    style = Style(robot, Order(order), Naming(naming))
    forward = forward_kinematics(robot)
    given = table.chapter(style)
    chapters = [
        Chapter(given.title, (*given.blocks, *picture.drawings(robot))),
        meaning.chapter(style),
        general.chapter(style),
        links.chapter(style, forward),
    ]
    if forward.pose is not None and robot.n <= PRODUCT_LIMIT:
        chapters.append(products.chapter(style, forward))
    else:
        chapters.append(recursion.chapter(style, forward.start, forward.end))
    if forward.pose is not None:
        chapters.append(result.chapter(style, forward))
    few = 0 < len(robot.variables) <= VELOCITY_LIMIT
    if few and has_closed_jacobian(robot, forward.end, forward.start):
        known = [style.notation.matrix(m) for m in (*forward.links, forward.pose) if m is not None]
        motion = velocity.readable_jacobian(style, forward.start, forward.end)
        chapters.append(velocity.chapter(style, motion, known))
        if len(robot.variables) <= MAX_JOINTS:
            chapters.append(singularity.chapter(style, singularities(robot), known))
    figures = numbers.chapter(style, forward)
    if figures is not None:
        chapters.append(figures)
    return Document(robot.title or robot.name, subtitle(robot), tuple(chapters))


def subtitle(robot: Robot) -> Text:
    """Return what stands below a robot's name: its convention."""
    return (_CONVENTION[robot.convention],)
