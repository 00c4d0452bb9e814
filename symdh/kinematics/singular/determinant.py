"""Determinants of small matrices of polynomials, as products where the zeros allow it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from symdh.kinematics.singular.trig_ring import Element, TooLargeError, TrigRing

Matrix = Sequence[Sequence[Element]]

#: Terms of a polynomial past which a determinant is given up: its factors would not be found in
#: reasonable time, and nobody would read them.
MAX_TERMS = 3000


def factored_determinant(ring: TrigRing, matrix: Matrix) -> list[Element]:
    """Return polynomials whose product is the determinant of a square matrix.

    A set of columns that is zero outside as many rows is a diagonal block of a block-triangular
    form: the determinant is that block's times that of what is left.

    Raises
    ------
    TooLargeError
        When an intermediate result has more than `MAX_TERMS` terms.
    """
    rows, columns = tuple(range(len(matrix))), tuple(range(len(matrix)))
    factors: list[Element] = []
    sign = 1
    while columns:
        block = _smallest_block(matrix, rows, columns)
        if block is None:
            return [ring.constant(0)]
        own_rows, own_columns = block
        places = [rows.index(r) for r in own_rows] + [columns.index(c) for c in own_columns]
        sign *= (-1) ** sum(places)
        factors.append(_expanded(ring, matrix, own_rows, own_columns))
        rows = tuple(r for r in rows if r not in own_rows)
        columns = tuple(c for c in columns if c not in own_columns)
    return [ring.constant(sign), *factors]


def _smallest_block(
    matrix: Matrix, rows: tuple[int, ...], columns: tuple[int, ...]
) -> tuple[tuple[int, ...], tuple[int, ...]] | None:
    """Return rows and columns of a diagonal block, or None for a determinant that is zero."""
    sets = (c for size in range(1, len(columns) + 1) for c in combinations(columns, size))
    pairs = ((tuple(r for r in rows if any(matrix[r][c] for c in own)), own) for own in sets)
    # All columns together have no more rows than there are.
    used, chosen = next(pair for pair in pairs if len(pair[0]) <= len(pair[1]))
    return (used, chosen) if len(used) == len(chosen) else None


def _expanded(
    ring: TrigRing, matrix: Matrix, rows: tuple[int, ...], columns: tuple[int, ...]
) -> Element:
    """Expand a determinant column by column; minors that come again are computed once."""
    order = sorted(columns, key=lambda c: sum(len(matrix[r][c]) for r in rows))
    minors: dict[tuple[int, ...], Element] = {(): ring.constant(1)}
    for column in order:
        wider: dict[tuple[int, ...], Element] = {}
        for taken, minor in minors.items():
            for row in rows:
                entry = matrix[row][column]
                if row in taken or not entry or not minor:
                    continue
                bigger = tuple(sorted((*taken, row)))
                sign = (-1) ** (len(taken) - bigger.index(row))
                term = ring.product(minor, entry) * sign
                wider[bigger] = wider.get(bigger, ring.constant(0)) + term
                if len(wider[bigger]) > MAX_TERMS:
                    raise TooLargeError
        minors = wider
    swapped = sum(1 for i, c in enumerate(order) for later in order[i + 1 :] if c > later)
    return minors.get(tuple(sorted(rows)), ring.constant(0)) * (-1) ** swapped
