"""The equations of an arm: all entries of (A_1..A_i)^-1 T (A_j+1..A_n)^-1 = A_i+1..A_j."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from symdh.kinematics.inverse.ring import U_NAMES, Element, InverseRing, Pose

#: Joints that may stand on the side of the goal in a chain of more than three.
MOST_MOVED = 3


@dataclass(frozen=True, slots=True)
class Source:
    """Where an equation comes from.

    Attributes
    ----------
    i, j : int
        The product A_{i+1} .. A_j stands alone on its side.
    entries : tuple of (row, column)
        The entries compared, from 0; more than one where they were squared and added, none where
        two equations were combined. Column 3 is the position.
    inverted : bool
        Whether both sides were inverted before: the base seen from the hand.
    base : tuple of int
        The rows i and j of the product that the equation started from: 0 and n, or the ends of
        the part of the chain that was still open when its pose was named.
    """

    i: int
    j: int
    entries: tuple[tuple[int, int], ...]
    inverted: bool
    base: tuple[int, int]

    @property
    def moved(self) -> int:
        """How many rows were taken to the side of what is known."""
        return self.i - self.base[0] + self.base[1] - self.j

    @property
    def effort(self) -> float:
        """How much there is to follow before the entries are compared, in terms of a sum."""
        return 0.75 * self.moved + 0.5 * self.inverted

    @property
    def is_squared(self) -> bool:
        """Whether entries were squared and added."""
        return len(self.entries) > 1


class Combination(Enum):
    """How one equation was made of two."""

    RATIO = "one is divided by the other, and their common factor drops out"
    PROJECTION = "each is multiplied by the known sine or cosine in it, and both are added"
    DIFFERENCE = "they are combined so that the angle that stands in both drops out"
    WITHOUT_SLIDE = "they are combined so that the slide that stands in both drops out"


@dataclass(frozen=True, slots=True)
class Equation:
    """``element = 0``, as it was found.

    Attributes
    ----------
    element : Element
        Left side minus right side, reduced.
    source : Source
    sides : tuple of (left, right)
        The entries that were compared; each pair was squared before adding where there are more.
    parents : tuple of Equation
        Two equations that this one was combined from.
    combination : Combination or None
        How they were combined.
    """

    element: Element
    source: Source
    sides: tuple[tuple[Element, Element], ...] = ()
    parents: tuple[Equation, ...] = ()
    combination: Combination | None = None

    @property
    def effort(self) -> float:
        """How much there is to follow and to read before the equation stands there."""
        squared = self.sides if self.source.is_squared else ()
        read = sum(len(left) + len(right) for left, right in squared)
        return self.source.effort + 0.1 * read + sum(each.source.effort for each in self.parents)


@dataclass(frozen=True, slots=True)
class Split:
    """Both sides of one matrix equation."""

    i: int
    j: int
    inverted: bool
    left: Pose
    right: Pose
    base: tuple[int, int]


class Pool:
    """The equations of an arm for one task.

    Attributes
    ----------
    ring : InverseRing
    allowed : frozenset of str
        The entries of the goal that the task gives.
    splits : tuple of Split
    equations : list of Equation
    """

    def __init__(self, ring: InverseRing, allowed: frozenset[str]) -> None:
        self.ring = ring
        self.allowed = allowed
        self._forbidden = [
            ring.first_goal + k for k, name in enumerate(ring.goal_names) if name not in allowed
        ]
        self._seen: set[frozenset[tuple[tuple[int, ...], object]]] = set()
        self.equations: list[Equation] = []
        self.splits = list(self._splits())
        for split in self.splits:
            self._compare(split)

    def is_given(self, element: Element) -> bool:
        """Say whether an element holds only entries of the goal that the task gives."""
        return not any(powers[k] for powers in element for k in self._forbidden)

    def add_part(self, i_0: int, j_0: int, pose: Pose) -> None:
        """Add the equations of the part A_{i_0 + 1} .. A_{j_0}, whose pose is known now."""
        ring = self.ring
        places = (
            (i, j)
            for i, j in self._places()
            if i_0 <= i and j <= j_0 and i - i_0 + j_0 - j <= MOST_MOVED
        )
        for i, j in sorted(places, key=lambda ij: (ij[0] - i_0 + j_0 - ij[1], ij[0])):
            left = ring.times(ring.inverse_product(i_0, i), pose) if i > i_0 else pose
            left = ring.times(left, ring.inverse_product(j, j_0)) if j < j_0 else left
            split = Split(i, j, False, left, ring.product(i, j), (i_0, j_0))
            self.splits.append(split)
            self._compare(split)

    def add(
        self,
        element: Element,
        source: Source,
        sides: tuple[tuple[Element, Element], ...] = (),
        parents: tuple[Equation, ...] = (),
        combination: Combination | None = None,
    ) -> Equation | None:
        """Add an equation, which is not empty, unless it is there or uses what is not given."""
        if not self.is_given(element):
            return None
        key = frozenset(element.monic().terms())
        if key in self._seen:
            return None
        self._seen.add(key)
        equation = Equation(element, source, sides, parents, combination)
        self.equations.append(equation)
        return equation

    def _compare(self, split: Split) -> None:
        columns = (3,) if split.inverted else (3, 0, 1, 2)
        for column in columns:
            for row in range(3):
                left, right = _entry(split.left, row, column), _entry(split.right, row, column)
                source = Source(split.i, split.j, ((row, column),), split.inverted, split.base)
                self.add(self.ring.reduced(left - right), source, ((left, right),))

    def _splits(self) -> Iterable[Split]:
        ring, n = self.ring, self.ring.arm.robot.n
        goal, back = ring.goal_pose, ring.inverse_goal
        with_u = set(U_NAMES) <= self.allowed
        moving = self.ring.arm.moving
        places = sorted(
            (
                (i, j)
                for i, j in self._places()
                if len(moving) <= MOST_MOVED
                or sum(1 for row in moving if row <= i or row > j) <= MOST_MOVED
            ),
            key=lambda ij: (ij[0] + n - ij[1], ij[0]),
        )
        for i, j in places:
            left = ring.times(ring.inverse_product(0, i), goal) if i else goal
            left = ring.times(left, ring.inverse_product(j, n)) if j < n else left
            yield Split(i, j, False, left, ring.product(i, j), (0, n))
        for i, j in places if with_u else ():
            left = ring.times(ring.product(j, n), back) if j < n else back
            left = ring.times(left, ring.product(0, i)) if i else left
            yield Split(i, j, True, left, ring.inverse_product(i, j), (0, n))

    def _places(self) -> Iterable[tuple[int, int]]:
        """Return where the chain may be cut: behind and before joints that move."""
        n, moving = self.ring.arm.robot.n, set(self.ring.arm.moving)
        for i in range(n):
            for j in range(i + 1, n + 1):
                if (not i or i in moving) and (j == n or j + 1 in moving):
                    yield i, j


def _entry(pose: Pose, row: int, column: int) -> Element:
    return pose.position[row] if column == 3 else pose.rotation[row][column]
