"""Words of elementary motions and the rules that shorten them before anything is multiplied.

A word stands for the product of its motions, left to right. Three facts do all the work:

- neighbours about (or along) one axis add, and a zero amount vanishes;
- motions about and along one axis commute, and translations commute with each other;
- a constant rotation by a multiple of 90 degrees passes any motion by turning that motion's axis:
  ``Rx(90 deg) Rz(q) = Ry(-q) Rx(90 deg)``. Carried to the right end, all of them together are one
  signed permutation of the axes, and axes that are parallel in space become neighbours that add.

The last one is why ``c_{23}`` and ``c_{124}`` appear by construction, also where a twist is 180
degrees.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sympy import Add, Expr, Integer, Rational, pi

from symdh.motion.turn import IDENTITY, Turn
from symdh.robot import Axis, Motion, MotionKind

Word = tuple[Motion, ...]


def rotation(axis: Axis, angle: Expr) -> Motion:
    """Return the rotation by `angle` (radians) about `axis`."""
    return Motion(MotionKind.ROTATION, axis, angle)


def translation(axis: Axis, distance: Expr) -> Motion:
    """Return the translation by `distance` (length) along `axis`."""
    return Motion(MotionKind.TRANSLATION, axis, distance)


def inverse(word: Iterable[Motion]) -> Word:
    """Return the word of the inverse transform: reversed, every amount negated."""
    return tuple(replace(motion, amount=-motion.amount) for motion in reversed(tuple(word)))


def rotations(word: Iterable[Motion]) -> Word:
    """Return the rotations of a word: the word of its orientation."""
    return tuple(motion for motion in word if motion.kind is MotionKind.ROTATION)


def fuse(word: Iterable[Motion]) -> Word:
    """Bring a word to its short form; it stands for the same transform.

    Parameters
    ----------
    word : iterable of Motion

    Returns
    -------
    Word
        Motions whose neighbours do not add, followed by at most three constant rotations by
        multiples of 90 degrees.
    """
    motions, turn = fuse_to_turn(word)
    return motions + turn_word(turn)


def fuse_to_turn(word: Iterable[Motion]) -> tuple[Word, Turn]:
    """Bring a word to its short form, the trailing right-angle turn kept apart."""
    motions, turn = _pass(word)
    # Two angles may add up to a right angle: Rx(45 deg) Rx(45 deg) turns the axes behind it too.
    while any(split_quarters(motion)[0] != motion for motion in rotations(motions)):
        motions, more = _pass(motions)
        turn = more.then(turn)
    return motions, turn


def _pass(word: Iterable[Motion]) -> tuple[Word, Turn]:
    """Go through a word once: right angles to the end, neighbours added."""
    fused: list[Motion] = []
    turn = IDENTITY
    for motion in word:
        quarters = 0
        if motion.kind is MotionKind.ROTATION:
            motion, quarters = split_quarters(motion)
        axis, sign = turn.image(motion.axis)
        _append(fused, Motion(motion.kind, axis, sign * motion.amount))
        turn = turn.then(Turn.about(motion.axis, quarters))
    return tuple(fused), turn


def split_quarters(motion: Motion) -> tuple[Motion, int]:
    """Split R(q + k 90 deg) into R(q) and the number k of quarter turns."""
    constant, rest = motion.amount.as_independent(*motion.amount.free_symbols, as_Add=True)
    if not motion.amount.free_symbols:
        constant, rest = motion.amount, Integer(0)
    quarters = constant * 2 / pi
    if not quarters.is_Integer:
        return motion, 0
    return replace(motion, amount=rest), int(quarters) % 4


def turn_word(turn: Turn) -> Word:
    """Write a turn as at most three rotations, about z, then y, then x."""
    return tuple(
        rotation(axis, _principal(quarters) * pi / 2)
        for axis, quarters in turn.zyx_quarters()
        if quarters % 4
    )


def _principal(quarters: int) -> Rational:
    return Rational((quarters + 1) % 4 - 1)


def _append(fused: list[Motion], motion: Motion) -> None:
    """Append a motion, adding it to an equal kind and axis that it can commute back to."""
    if motion.amount.is_zero:
        return
    for position in range(len(fused) - 1, -1, -1):
        earlier = fused[position]
        if (earlier.kind, earlier.axis) == (motion.kind, motion.axis):
            del fused[position]
            amount = Add(earlier.amount, motion.amount)
            rest = fused[position:]
            del fused[position:]
            # What stood between may now add as well, so it goes through the same door.
            for each in (replace(motion, amount=amount), *rest):
                _append(fused, each)
            return
        if not _commute(earlier, motion):
            break
    fused.append(motion)


def _commute(first: Motion, second: Motion) -> bool:
    both_slide = first.kind is second.kind is MotionKind.TRANSLATION
    return first.axis is second.axis or both_slide
