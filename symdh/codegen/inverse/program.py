"""A program of branches, in no particular language.

It is a list of statements. A statement that solves for an unknown with several values opens a loop
around all that follows it; the last statement proposes joint values. What the helpers do that a
statement calls for (solve one equation, judge what was proposed) is the language's own.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from symdh.codegen.graph import Node
from symdh.codegen.routine import Assignment


class Kind(Enum):
    """How an unknown is found.

    LINE: A s + B c + C = 0, two values. PAIR: two such equations, one value. SLIDE: A q + C = 0,
    one value. SQUARE: A q^2 + B q + C = 0, two. ROOTS: f_0 + f_1 c + f_2 s + f_3 cos 2x +
    f_4 sin 2x = 0, four.
    """

    LINE = "line"
    PAIR = "pair"
    SLIDE = "slide"
    SQUARE = "square"
    ROOTS = "roots"


@dataclass(frozen=True, slots=True)
class Option:
    """An equation, or two, that give an unknown.

    Attributes
    ----------
    assignments : tuple of Assignment
        What is computed for this option alone; nothing for the first.
    coefficients : tuple of Node
        As `Kind` has them; for a pair those of both equations.
    scales : tuple of Node
        LINE: what A and B could be together at most, and A, B and C. PAIR: the like of the
        determinant. SLIDE: of A. SQUARE: of C. ROOTS: none.
    """

    assignments: tuple[Assignment, ...]
    coefficients: tuple[Node, ...]
    scales: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Solve:
    """Solve for an unknown.

    Attributes
    ----------
    depth : int
        Loops around it.
    kind : Kind
    name : str
        Of the unknown, for people: ``theta2 + theta3``.
    label : str
        Of the unknown, in identifiers: ``23``.
    options : tuple of Option
        The first in which the unknown is well conditioned is taken, else the best of all.
    results : tuple of Node
        Cosine and sine, or the slide: symbols that stand for the value at hand.
    seed : tuple of (sign, place)
        The joint variables that give the unknown's value where the goal leaves it free.
    place : int
        The joint variable that is reported as free then.
    opens : bool
        Whether it may have several values: a loop over them holds all that follows.
    """

    depth: int
    kind: Kind
    name: str
    label: str
    options: tuple[Option, ...]
    results: tuple[Node, ...]
    seed: tuple[tuple[int, int], ...]
    place: int
    opens: bool


@dataclass(frozen=True, slots=True)
class Compute:
    """Compute some values that later statements use."""

    depth: int
    assignments: tuple[Assignment, ...]


@dataclass(frozen=True, slots=True)
class Propose:
    """Propose joint values, in chain order; forward kinematics is their judge."""

    depth: int
    values: tuple[Node, ...]


Statement = Compute | Solve | Propose


@dataclass(frozen=True)
class Program:
    """The closed form of an arm.

    Attributes
    ----------
    statements : tuple of Statement
    goal : tuple of Node
        Symbols for the twelve entries of the goal, row by row; a program reads some of them.
    reach : Node
        The sum of the arm's lengths.
    axes : tuple of int
        Coordinates of the position that are compared.
    with_orientation : bool
    turning : tuple of bool
        Which joint variables are angles.
    free : tuple of int
        The places of the joint variables that are found; the others are locked.
    most_solutions : int
    description : str
        What is compared, in words.
    """

    statements: tuple[Statement, ...]
    goal: tuple[Node, ...]
    reach: Node
    axes: tuple[int, ...]
    with_orientation: bool
    turning: tuple[bool, ...]
    free: tuple[int, ...]
    most_solutions: int
    description: str
