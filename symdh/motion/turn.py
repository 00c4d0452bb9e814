"""Rotations by multiples of 90 degrees: signed permutations of the coordinate axes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from symdh.robot import Axis

SignedAxis = tuple[Axis, int]


@dataclass(frozen=True, slots=True)
class Turn:
    """A rotation that maps every coordinate axis to a coordinate axis.

    Attributes
    ----------
    images : tuple of (Axis, sign)
        ``images[k]`` is where the unit vector along axis k goes: the k-th column of the matrix.
    """

    images: tuple[SignedAxis, SignedAxis, SignedAxis]

    @staticmethod
    def about(axis: Axis, quarters: int) -> Turn:
        """Return the rotation by `quarters` times 90 degrees about `axis`."""
        turn = IDENTITY
        for _ in range(quarters % 4):
            turn = turn.then(_QUARTER[axis])
        return turn

    def image(self, axis: Axis) -> SignedAxis:
        """Return the axis, with a sign, that `axis` is turned to."""
        return self.images[axis]

    def then(self, other: Turn) -> Turn:
        """Return the product ``self * other`` (other acts first on a vector)."""
        first, second, third = (self._apply(image) for image in other.images)
        return Turn((first, second, third))

    def _apply(self, signed: SignedAxis) -> SignedAxis:
        axis, sign = self.images[signed[0]]
        return axis, sign * signed[1]

    def zyx_quarters(self) -> tuple[tuple[Axis, int], ...]:
        """Write the turn as Rz Ry Rx; fewest rotations first, then smallest angles."""
        candidates = (
            tuple(zip((Axis.Z, Axis.Y, Axis.X), quarters, strict=True))
            for quarters in product((0, 1, -1, 2), repeat=3)
        )
        matching = [c for c in candidates if _product(c) == self]
        return min(matching, key=_effort)


def _product(rotations: tuple[tuple[Axis, int], ...]) -> Turn:
    turn = IDENTITY
    for axis, quarters in rotations:
        turn = turn.then(Turn.about(axis, quarters))
    return turn


def _effort(rotations: tuple[tuple[Axis, int], ...]) -> tuple[int, int]:
    return (
        sum(1 for _, quarters in rotations if quarters),
        sum(abs(quarters) for _, quarters in rotations),
    )


IDENTITY = Turn(((Axis.X, 1), (Axis.Y, 1), (Axis.Z, 1)))
_QUARTER = {
    Axis.X: Turn(((Axis.X, 1), (Axis.Z, 1), (Axis.Y, -1))),
    Axis.Y: Turn(((Axis.Z, -1), (Axis.Y, 1), (Axis.X, 1))),
    Axis.Z: Turn(((Axis.Y, 1), (Axis.X, -1), (Axis.Z, 1))),
}
