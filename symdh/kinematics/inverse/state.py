"""What a search knows: which unknowns are found, and the equations with those that are open."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from symdh.kinematics.inverse.point import Point
from symdh.kinematics.inverse.pool import Equation, Pool, Source
from symdh.kinematics.inverse.ring import Element, InverseRing, Pose
from symdh.kinematics.inverse.solution import Step, Used


@dataclass
class View:
    """An equation as it stands now: sums of angles expanded where that leaves fewer unknowns.

    Attributes
    ----------
    equation : Equation
    element : Element
    support : frozenset of int
        All unknowns in it, found or not.
    """

    equation: Equation
    element: Element
    support: frozenset[int]

    @property
    def used(self) -> Used:
        """The equation as a step keeps it."""
        return Used(self.equation, self.element)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A step that can be taken; the cheapest is."""

    cost: float
    step: Step


@dataclass
class State:
    """A search in progress.

    Attributes
    ----------
    pool : Pool
    points : tuple of Point
        What vanishes at all of them vanishes.
    known : set of int
    steps : list of Step
    views : list of View
    parts : dict of (i, j) to Pose
        The known poses of parts A_{i+1} .. A_j, with names for their entries.
    projections : list of (angle, Element, Source, parents)
        Equations that are of use once the angle is known.
    """

    pool: Pool
    points: tuple[Point, ...]
    known: set[int] = field(default_factory=set)
    steps: list[Step] = field(default_factory=list)
    views: list[View] = field(default_factory=list)
    parts: dict[tuple[int, int], Pose] = field(default_factory=dict)
    projections: list[tuple[int, Element, Source, tuple[Equation, ...]]] = field(
        default_factory=list
    )

    @property
    def ring(self) -> InverseRing:
        """The ring of the arm."""
        return self.pool.ring

    def refresh(self) -> None:
        """Take up equations that were added to the pool."""
        for equation in self.pool.equations[len(self.views) :]:
            self.views.append(View(equation, equation.element, self.support(equation.element)))

    def support(self, element: Element) -> frozenset[int]:
        """Return the unknowns in an element."""
        return unknowns_in(self.ring, element)

    def open(self, support: Iterable[int]) -> frozenset[int]:
        """Return those of some unknowns that are not found yet."""
        return frozenset(support) - self.known

    def vanishes(self, element: Element) -> bool:
        """Say whether an element is zero whatever the joints do."""
        return not element or all(point.value(element) == 0 for point in self.points)

    def without_zero(self, element: Element) -> Element:
        """Return zero for an element that vanishes, else the element."""
        return self.ring.zero if self.vanishes(element) else element

    def take(self, step: Step) -> None:
        """Take a step: its unknown is known from now on."""
        self.steps.append(step)
        if step.definitions:
            for generator, element in step.definitions:
                for point in self.points:
                    point.define(generator, element)
        else:
            self.known.add(step.unknown)

    def linear(self, element: Element, angle: int) -> tuple[Element, Element, Element] | None:
        """Return A, B, C of ``A s + B c + C``; None when the element is not of that form."""
        c, s = 2 * angle, 2 * angle + 1
        parts: tuple[dict[tuple[int, ...], object], ...] = ({}, {}, {})
        for powers, coefficient in element.terms():
            degree = powers[c] + powers[s]
            if degree > 1:
                return None
            rest = (*powers[:c], 0, 0, *powers[s + 1 :])
            parts[2 if not degree else 0 if powers[s] else 1][rest] = coefficient
        a, b, rest_part = (self.ring.ring.from_dict(part) for part in parts)
        return a, b, rest_part


def unknowns_in(ring: InverseRing, element: Element) -> frozenset[int]:
    """Return the unknowns in an element, found or not."""
    angles, first, last = len(ring.forms), 2 * len(ring.forms), ring.unknown_gens
    found: set[int] = set()
    for powers in element:
        for k in range(last):
            if powers[k]:
                found.add(k // 2 if k < first else k - first + angles)
    return frozenset(found)
