"""The usual names of the entries of a pose that is printed one by one."""

from __future__ import annotations

from collections.abc import Iterator

from symdh.derivation.blocks import EntryStep
from symdh.derivation.products import entry_name
from symdh.notation.nodes import Generic, Matrix


def named_entries(matrix: Matrix) -> Iterator[EntryStep]:
    """Yield the entries of a matrix with names, column by column.

    ``r_{11}`` .. ``r_{33}`` and ``p_x`` .. ``p_z`` of a pose, r of a rotation, J of any other.
    """
    shape = len(matrix.rows), len(matrix.rows[0])
    if shape != (4, 4):
        letter = "r" if shape == (3, 3) else "J"
        for column in range(shape[1]):
            for row in range(shape[0]):
                name = Generic(letter, f"{row + 1}{column + 1}")
                yield EntryStep(name, (matrix.rows[row][column],), None)
        return
    for column in range(4):
        for row in range(3):
            yield EntryStep(entry_name(row, column), (matrix.rows[row][column],), None)
