"""A closed-form solution: the steps that find every joint variable, and their branches."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from math import prod

from symdh.kinematics.inverse.arm import InverseArm
from symdh.kinematics.inverse.pool import Equation
from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.kinematics.inverse.structure import Structure
from symdh.kinematics.inverse.task import InverseTask


class Rule(Enum):
    """How a step finds its unknown; the value is the rule's name for people."""

    NAMES = "names for known parts"
    SUM = "known sum"
    RATIO = "A s + B c = 0"
    SINE = "A s + C = 0"
    COSINE = "B c + C = 0"
    SINE_COSINE = "A s + B c + C = 0"
    PAIR = "two linear equations in s and c"
    SLIDE = "linear equation of a slide"
    SLIDE_SQUARE = "quadratic equation of a slide"
    HALF_ANGLE = "polynomial in the tangent of the half angle"


@dataclass(frozen=True, slots=True)
class Used:
    """An equation that a step uses.

    Attributes
    ----------
    equation : Equation
        As it was found: ``equation.element = 0``.
    element : Element
        With sums of angles expanded where the step needs it.
    """

    equation: Equation
    element: Element


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a solution.

    Attributes
    ----------
    unknown : int
        What is found: an angle of the ring (a sum perhaps), or a slide.
    rule : Rule
    equations : tuple of Used
    coefficients : tuple of Element
        A, B, C of one equation or of two, in the order that the docstring of the rule gives. In a
        half-angle step they hold the unknown itself and belong to the eliminated angle.
    alternatives : tuple of tuple of Element
        Coefficients of other equations that serve where the first degenerate.
    branches : int
        The most values that the step can give.
    parts : tuple of (sign, unknown)
        What a sum is made of.
    eliminated : int or None
        The angle that a half-angle step got rid of.
    scales : tuple of Element
        The constants l_1 and l_2 of Pieper's combination, empty where Cramer's rule is used.
    definitions : tuple of (generator, Element)
        The names that a step gives to known parts; such a step has no unknown (-1).
    part : tuple of int or None
        The rows i and j where the part A_{i+1} .. A_j was named whose pose is known.
    """

    unknown: int
    rule: Rule
    equations: tuple[Used, ...] = ()
    coefficients: tuple[Element, ...] = ()
    alternatives: tuple[tuple[Element, ...], ...] = ()
    branches: int = 1
    parts: tuple[tuple[int, int], ...] = ()
    eliminated: int | None = None
    scales: tuple[Element, ...] = ()
    definitions: tuple[tuple[int, Element], ...] = ()
    part: tuple[int, int] | None = None


@dataclass(frozen=True)
class Tried:
    """What a search without success has reached.

    Attributes
    ----------
    steps : tuple of Step
        Those that were possible.
    missing : tuple of int
        The unknowns that are still open.
    timed_out : bool
    reason : str
        Why an arm is outside what the search can handle at all; empty otherwise.
    """

    steps: tuple[Step, ...]
    missing: tuple[int, ...]
    timed_out: bool = False
    reason: str = ""


@dataclass(frozen=True)
class ClosedForm:
    """The steps that give every joint variable of an arm for a goal.

    Attributes
    ----------
    arm : InverseArm
    task : InverseTask
    ring : InverseRing
    structure : Structure
    steps : tuple of Step
    """

    arm: InverseArm
    task: InverseTask
    ring: InverseRing
    structure: Structure
    steps: tuple[Step, ...]

    @cached_property
    def branching(self) -> tuple[Step, ...]:
        """The steps that have more than one value."""
        return tuple(step for step in self.steps if step.branches > 1)

    @property
    def most_solutions(self) -> int:
        """The product of the branches: no goal has more solutions of this form."""
        return prod(step.branches for step in self.steps)
