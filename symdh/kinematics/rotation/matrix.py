"""Nine numbers that are meant to be a rotation: are they one, and which is the nearest."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from math import sqrt

from sympy import Expr, Float, ImmutableMatrix, Rational, prime

from symdh.errors import UnsupportedError
from symdh.robot import in_name_order
from symdh.table.amounts import digits_of

Row = tuple[float, float, float]
Rotation = tuple[Row, Row, Row]

#: By how much products of columns may miss those of an orthonormal matrix.
TOLERANCE = 1e-6

_COLUMNS = ("n", "s", "a")
_DIGITS = 30


def nearest_rotation(
    rows: Sequence[Sequence[float]], tolerance: float = TOLERANCE, place: str = ""
) -> Rotation:
    """Check that nine numbers are a rotation, and take away what rounding has left.

    Parameters
    ----------
    rows : 3 x 3 numbers
    tolerance : float
        By how much R^T R may miss the identity, in any entry.
    place : str
        What an error message says after its first words, e.g. where the numbers come from.

    Returns
    -------
    Rotation
        The rotation nearest to the numbers: the orthogonal factor of their polar decomposition,
        by Newton's iteration (Higham, SIAM J. Sci. Stat. Comput. 7, 1986).

    Raises
    ------
    UnsupportedError
        When the columns are no unit vectors, not perpendicular, or left-handed.
    """
    columns = [tuple(row[k] for row in rows) for k in range(3)]
    for name, column in zip(_COLUMNS, columns, strict=True):
        if not abs(_dot(column, column) - 1) <= tolerance:
            length = sqrt(_dot(column, column))
            raise _refused(place, f"its column {name} has length {length:.7g}, not 1", tolerance)
    for (first, p), (second, q) in combinations(zip(_COLUMNS, columns, strict=True), 2):
        if not abs(_dot(p, q)) <= tolerance:
            why = f"its columns {first} and {second} have the product {_dot(p, q):.7g}, not 0"
            raise _refused(place, why, tolerance)
    if _determinant(columns) < 0:
        why = "its determinant is -1, a reflection: its axes are left-handed"
        raise _refused(place, why)
    return _polar(rows)


def check_family(matrix: ImmutableMatrix, tolerance: float = TOLERANCE) -> None:
    """Check that a matrix with symbols in it is a rotation, at one generic set of their values.

    Raises
    ------
    UnsupportedError
        When it is not.
    """
    symbols = in_name_order(matrix.free_symbols)
    values: dict[Expr, Expr] = {
        symbol: Rational(prime(20 + 3 * k), prime(60 + 5 * k)) for k, symbol in enumerate(symbols)
    }
    place = f" at {', '.join(f'{name} = {value}' for name, value in values.items())}"
    nearest_rotation(numbers_of(matrix.xreplace(values)), tolerance, place if values else "")


def numbers_of(matrix: ImmutableMatrix) -> list[list[float]]:
    """Return an exact 3x3 matrix without symbols as floats; digits that cancel become zeros.

    Raises
    ------
    UnsupportedError
        When an entry is no finite real number.
    """
    rows = []
    for r in range(3):
        row = [digits_of(matrix[r, c], _DIGITS) for c in range(3)]
        for entry in row:
            if not (entry.is_Float or entry.is_Rational):
                raise UnsupportedError(f"an entry of the matrix is {entry}, not a real number")
        rows.append([0.0 if abs(entry) < Float("1e-25") else float(entry) for entry in row])
    return rows


def _refused(place: str, why: str, tolerance: float | None = None) -> UnsupportedError:
    allowed = "" if tolerance is None else f" (tolerance {tolerance:g})"
    return UnsupportedError(f"the matrix is not a rotation{place}: {why}{allowed}")


def _polar(rows: Sequence[Sequence[float]]) -> Rotation:
    matrix = [list(row) for row in rows]
    # Newton's iteration squares what is missed, 0.1 at most: five steps leave rounding alone.
    for _ in range(5):
        # For three columns the inverse transpose has the cross products of the columns.
        columns = [[row[k] for row in matrix] for k in range(3)]
        volume = _determinant(columns)
        crossed = [_cross(columns[(k + 1) % 3], columns[(k + 2) % 3]) for k in range(3)]
        matrix = [[(matrix[r][k] + crossed[k][r] / volume) / 2 for k in range(3)] for r in range(3)]
    first, second, third = ((row[0] + 0.0, row[1] + 0.0, row[2] + 0.0) for row in matrix)
    return first, second, third


def _dot(p: Sequence[float], q: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(p, q, strict=True))


def _cross(p: Sequence[float], q: Sequence[float]) -> list[float]:
    return [p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3] for k in range(3)]


def _determinant(columns: Sequence[Sequence[float]]) -> float:
    return _dot(columns[0], _cross(columns[1], columns[2]))
