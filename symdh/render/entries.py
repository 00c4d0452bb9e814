"""The usual names of the entries of a pose that is printed one by one."""

from __future__ import annotations

from collections.abc import Iterator

from symdh.derivation.blocks import EntryStep
from symdh.derivation.products import entry_name
from symdh.notation.nodes import Matrix


def named_entries(matrix: Matrix) -> Iterator[EntryStep]:
    """Yield r_11 .. r_33 and p_x .. p_z of a 4x4 matrix, column by column."""
    for column in range(4):
        for row in range(3):
            yield EntryStep(entry_name(row, column), (matrix.rows[row][column],), None)
