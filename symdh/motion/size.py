"""How large the nested closed form of a word will be, counted before anything is multiplied."""

from __future__ import annotations

from collections.abc import Iterable

from symdh.motion.words import fuse_to_turn, rotations
from symdh.robot import Axis, Motion

#: Operations in an entry; None where the entry is zero, 0 where it is one.
Size = int | None


def closed_form_size(word: Iterable[Motion]) -> int:
    """Return the number of operations in the rotation entries of a word's closed form.

    Counted are additions, multiplications, sines and cosines; a sign costs nothing. Each rotation
    that shares no axis with its neighbour turns entries x, y into ``c x - s y`` and
    ``s x + c y``, so the count grows by the golden ratio with every such rotation. It is counted
    here with integers in place of expressions, in time linear in the word.
    """
    motions, turn = fuse_to_turn(rotations(word))
    total = 0
    for axis, _ in turn.images:
        sizes: list[Size] = [None, None, None]
        sizes[axis] = 0
        for motion in reversed(motions):
            sizes = _rotated(motion.axis, sizes)
        total += sum(size for size in sizes if size)
    return total


def _rotated(axis: Axis, sizes: list[Size]) -> list[Size]:
    first, second = (axis + 1) % 3, (axis + 2) % 3
    products = [_product(size) for size in (sizes[first], sizes[second]) if size is not None]
    turned = list(sizes)
    if products:
        turned[first] = turned[second] = sum(products) + len(products) - 1
    return turned


def _product(size: int) -> int:
    """Count a cosine or sine times an entry; beside a one it stands alone."""
    return size + 2 if size else 1
