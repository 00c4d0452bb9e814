"""Rotations one after another, about the axes of the moving body or about the fixed ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from sympy import Expr, ImmutableMatrix

from symdh.motion import Word, rotation, translation
from symdh.motion.matrices import Vector, orientation, position
from symdh.robot import Axis


class About(Enum):
    """Whose axis a rotation is about: the body's own, which moves with it, or the fixed one."""

    BODY = "body"
    FIXED = "fixed"


@dataclass(frozen=True, slots=True)
class Step:
    """One rotation as it is carried out.

    Attributes
    ----------
    axis : Axis
    angle : sympy.Expr
        Radians.
    about : About
    """

    axis: Axis
    angle: Expr
    about: About


@dataclass(frozen=True, slots=True)
class Turned:
    """Where the body is after one step.

    Attributes
    ----------
    step : Step
    word : Word
        All rotations so far in the order of their product; the new one stands at the right end
        when it was about an axis of the body, at the left end when it was about a fixed one.
    matrix : sympy.ImmutableMatrix
        Their exact 3x3 product.
    point : tuple of 3 Expr, or None
        The followed point of the body, seen from the fixed frame.
    """

    step: Step
    word: Word
    matrix: ImmutableMatrix
    point: Vector | None


@dataclass(frozen=True, slots=True)
class Composition:
    """Rotations carried out one after another, from a body that lies along the fixed axes.

    Attributes
    ----------
    steps : tuple of Turned
        In the order in which they happen; at least one.
    point : tuple of 3 Expr, or None
        A point of the body, in the body's own frame; where it was before the first step.
    """

    steps: tuple[Turned, ...]
    point: Vector | None

    @property
    def word(self) -> Word:
        """The product as a word, left to right."""
        return self.steps[-1].word

    @property
    def matrix(self) -> ImmutableMatrix:
        """The exact 3x3 result: the body's axes seen from the fixed frame."""
        return self.steps[-1].matrix


def compose(steps: Sequence[Step], point: Vector | None = None) -> Composition:
    """Carry out rotations in the order given.

    About an axis of the body ``R <- R R_axis(angle)``, about a fixed one ``R <- R_axis(angle) R``
    (Craig, Introduction to Robotics, 2.8; Spong et al., Robot Modeling and Control, 2.4).

    Parameters
    ----------
    steps : sequence of Step
        At least one.
    point : tuple of 3 Expr, optional
        A point of the body to follow.
    """
    word: Word = ()
    done = []
    for step in steps:
        turn = (rotation(step.axis, step.angle),)
        word = word + turn if step.about is About.BODY else turn + word
        done.append(Turned(step, word, exact_matrix(word), moved(word, point)))
    return Composition(tuple(done), point)


def exact_matrix(word: Word) -> ImmutableMatrix:
    """Return the exact 3x3 matrix of a word of rotations."""
    columns = orientation(word)
    return ImmutableMatrix([[_tidy(column[row]) for column in columns] for row in range(3)])


def moved(word: Word, point: Vector | None) -> Vector | None:
    """Return where a word of rotations carries a point."""
    if point is None:
        return None
    slides = tuple(translation(axis, x) for axis, x in zip(Axis, point, strict=True))
    x, y, z = position(word + slides)
    return _tidy(x), _tidy(y), _tidy(z)


def _tidy(entry: Expr) -> Expr:
    # Roots of numbers are read best as a plain sum; nothing textbook-like is lost with them.
    return entry if entry.free_symbols else entry.expand()
