"""The usual names of the entries of a matrix that is printed one by one."""

from __future__ import annotations

from collections.abc import Iterator

from symdh.derivation.blocks import EntryStep
from symdh.derivation.products import entry_name
from symdh.notation.nodes import Generic, Matrix, Node


def named_entries(matrix: Matrix, name: Node) -> Iterator[EntryStep]:
    """Yield the entries of a matrix with their names, column by column.

    Those of a 4x4 pose are ``r_{11}`` .. ``r_{33}`` and ``p_x`` .. ``p_z``, those of a rotation R
    ``r_{11}`` .. ``r_{33}``; any other matrix lends its letter: ``J_{12}``.
    """
    rows, columns = len(matrix.rows), len(matrix.rows[0])
    if (rows, columns) == (4, 4):
        for column in range(4):
            for row in range(3):
                yield EntryStep(entry_name(row, column), (matrix.rows[row][column],), None)
        return
    letter = name.letter if isinstance(name, Generic) and name.letter != "R" else "r"
    between = "," if max(rows, columns) > 9 else ""
    for column in range(columns):
        for row in range(rows):
            entry = Generic(letter, f"{row + 1}{between}{column + 1}")
            yield EntryStep(entry, (matrix.rows[row][column],), None)
