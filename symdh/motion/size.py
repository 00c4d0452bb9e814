"""How large the nested closed form of a word will be, counted before anything is multiplied."""

from __future__ import annotations

from collections.abc import Iterable

from symdh.motion.words import fuse_to_turn, rotations
from symdh.robot import Axis, Motion


def closed_form_size(word: Iterable[Motion]) -> int:
    """Return the number of operations in the rotation entries of a word's closed form.

    Each rotation that shares no axis with its neighbour turns entries x, y into
    ``c x - s y`` and ``s x + c y``, so the count roughly triples with every such joint. It is
    counted here with integers in place of expressions, in time linear in the word.
    """
    motions, turn = fuse_to_turn(rotations(word))
    total = 0
    for axis, _ in turn.images:
        sizes = [0, 0, 0]
        sizes[axis] = 1
        for motion in reversed(motions):
            sizes = _rotated(motion.axis, sizes)
        total += sum(sizes)
    return total


def _rotated(axis: Axis, sizes: list[int]) -> list[int]:
    first, second = (axis + 1) % 3, (axis + 2) % 3
    x, y = sizes[first], sizes[second]
    turned = list(sizes)
    # A zero stays a zero; c x alone costs one product, c x - s y two products and a sum.
    turned[first] = turned[second] = x + y + (3 if x and y else 1 if x or y else 0)
    return turned
