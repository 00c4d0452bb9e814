"""Euler angles read off the rotations of an arm, where these already stand in that order."""

from __future__ import annotations

from itertools import combinations, product

from sympy import Expr, Integer, pi

from symdh.kinematics.rotation.euler import EulerSequence
from symdh.motion import Word, rotations
from symdh.motion.turn import IDENTITY, Turn
from symdh.motion.words import fuse_to_turn
from symdh.robot import Motion

Angles = tuple[Expr, Expr, Expr]

#: Quarter turns, smallest first.
_QUARTERS = (0, 1, -1, 2)


def read_off(word: Word, sequence: EulerSequence) -> Angles | None:
    """Return angles that make the orientation of a word identically, if that can be seen.

    The fused word is compared with the sequence; what it has besides are turns by multiples of
    90 degrees, and of those there are few enough to try them all. The orientation of a SCARA,
    ``Rz(q1 + q2 + q4) Rx(180 deg)``, gives zyx angles ``q1 + q2 + q4, 0, 180 deg``.

    Returns
    -------
    tuple of 3 Expr, or None
        Radians; None when the word has more rotations than the sequence, or about other axes.
    """
    motions, turn = fuse_to_turn(rotations(word))
    if len(motions) > 3:
        return None
    candidates = sorted(product(_QUARTERS, repeat=3), key=_effort)
    for quarters in candidates:
        for places in combinations(range(3), len(motions)):
            found = _match(sequence, motions, turn, quarters, places)
            if found is not None:
                return found
    return None


def _match(
    sequence: EulerSequence,
    motions: Word,
    turn: Turn,
    quarters: tuple[int, ...],
    places: tuple[int, ...],
) -> Angles | None:
    """Try one choice: the motions at these places of the sequence, each with its quarter turns."""
    angles: list[Expr] = []
    reached = IDENTITY
    waiting: list[Motion] = list(motions)
    for place, axis in enumerate(sequence.axes):
        angle: Expr = Integer(0)
        if place in places:
            motion = waiting.pop(0)
            image, sign = reached.image(axis)
            if image is not motion.axis:
                return None
            angle = sign * motion.amount
        angles.append(angle + quarters[place] * pi / 2)
        reached = reached.then(Turn.about(axis, quarters[place]))
    return (angles[0], angles[1], angles[2]) if reached == turn else None


def _effort(quarters: tuple[int, ...]) -> tuple[int, int]:
    return sum(1 for each in quarters if each), sum(abs(each) for each in quarters)
