"""Exact matrices of words: the orientation and the position of a fused word, never expanded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sympy import Expr, ImmutableMatrix, Integer, cos, sin

from symdh.motion.runs import Run, cut_runs
from symdh.motion.turn import Turn
from symdh.motion.words import fuse_to_turn, inverse, rotations
from symdh.robot import Axis, Motion, MotionKind

Vector = tuple[Expr, Expr, Expr]

_ZERO, _ONE = Integer(0), Integer(1)


def elementary(motion: Motion) -> ImmutableMatrix:
    """Return the 4x4 homogeneous matrix of one elementary motion."""
    rows = [[_ONE if r == c else _ZERO for c in range(4)] for r in range(4)]
    if motion.kind is MotionKind.TRANSLATION:
        rows[motion.axis][3] = motion.amount
    else:
        first, second = _others(motion.axis)
        cosine, sine = cos(motion.amount), sin(motion.amount)
        rows[first][first], rows[first][second] = cosine, -sine
        rows[second][first], rows[second][second] = sine, cosine
    return ImmutableMatrix(rows)


def transform(word: Iterable[Motion]) -> ImmutableMatrix:
    """Return the exact 4x4 matrix of a word, in the nested form that fusing gives.

    The orientation is multiplied from the right and not expanded; the position is the nested sum
    from the last motion to the first, runs about one axis collapsed (``a_1 c_1 + a_2 c_{12}``).
    """
    word = tuple(word)
    return _homogeneous(orientation(word), position(word))


def inverse_transform(word: Iterable[Motion]) -> ImmutableMatrix:
    """Return the exact 4x4 matrix of the rigid inverse of a word.

    Its orientation is the transpose of the word's own, entry for entry; its position is that of
    the inverse word, which is shorter than ``-R^T p``.
    """
    word = tuple(word)
    columns = orientation(word)
    x, y, z = ((columns[0][r], columns[1][r], columns[2][r]) for r in range(3))
    return _homogeneous((x, y, z), position(inverse(word)))


def orientation(word: Iterable[Motion]) -> tuple[Vector, Vector, Vector]:
    """Return the columns of the rotation matrix of a word."""
    motions, turn = fuse_to_turn(rotations(word))
    columns = _turn_columns(turn)
    for motion in reversed(motions):
        columns = [rotate(motion.axis, motion.amount, column) for column in columns]
    first, second, third = columns
    return first, second, third


def position(word: Iterable[Motion]) -> Vector:
    """Return the origin that a word carries the zero vector to."""
    motions, _ = fuse_to_turn(word)
    point: Vector = (_ZERO, _ZERO, _ZERO)
    for run in reversed(cut_runs(motions)):
        point = _carry(run, point)
    return point


def rotate(axis: Axis, angle: Expr, vector: Sequence[Expr]) -> Vector:
    """Rotate a vector about a coordinate axis."""
    first, second = _others(axis)
    cosine, sine = cos(angle), sin(angle)
    rotated = list(vector)
    rotated[first] = cosine * vector[first] - sine * vector[second]
    rotated[second] = sine * vector[first] + cosine * vector[second]
    return rotated[0], rotated[1], rotated[2]


def _carry(run: Run, point: Vector) -> Vector:
    """Apply a run to a point; parallel links give one term each, none of them nested."""
    *earlier, last = run.stations
    reached = list(rotate(run.axis, last.angle, _add(last.offset, point)))
    for station in earlier:
        reached = _add(reached, rotate(run.axis, station.angle, station.offset))
    return reached[0], reached[1], reached[2]


def _others(axis: Axis) -> tuple[int, int]:
    """Return the two other axes in cyclic order, so that one formula rotates about each axis."""
    return (axis + 1) % 3, (axis + 2) % 3


def _add(a: Sequence[Expr], b: Sequence[Expr]) -> list[Expr]:
    return [x + y for x, y in zip(a, b, strict=True)]


def _turn_columns(turn: Turn) -> list[Vector]:
    columns = []
    for axis, sign in turn.images:
        column = [_ZERO, _ZERO, _ZERO]
        column[axis] = Integer(sign)
        columns.append((column[0], column[1], column[2]))
    return columns


def _homogeneous(columns: Sequence[Vector], point: Vector) -> ImmutableMatrix:
    rows = [[columns[0][r], columns[1][r], columns[2][r], point[r]] for r in range(3)]
    return ImmutableMatrix([*rows, [_ZERO, _ZERO, _ZERO, _ONE]])
