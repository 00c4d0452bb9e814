"""A rotation with all that is known of it: composed, given as a matrix, or taken from an arm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sympy import Expr, ImmutableMatrix, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.forward import has_closed_form, transform
from symdh.kinematics.frame import Frame
from symdh.kinematics.numeric import check_values, pose
from symdh.kinematics.rotation.composing import Composition, Step, compose, moved
from symdh.kinematics.rotation.description import Description, describe
from symdh.kinematics.rotation.matrix import (
    TOLERANCE,
    check_family,
    nearest_rotation,
    numbers_of,
)
from symdh.motion import Word, rotations
from symdh.motion.matrices import Vector
from symdh.robot import Robot, in_name_order


@dataclass(frozen=True)
class RotationResult:
    """One rotation.

    Attributes
    ----------
    robot : Robot
        The arm whose orientation it is, or a stand-in for plain rotations.
    matrix : ImmutableMatrix or None
        Exact, 3x3; None where the closed form of an arm's would be too large.
    composition : Composition or None
        How it came about, where it was composed.
    frames : (Frame, Frame) or None
        The frames of an arm between which it was taken.
    word : Word or None
        The rotations that make it, where they are known.
    point, moved : tuple of 3 Expr, or None
        A point of the body before and after.
    numbers : Description or None
        None where symbols have no values.
    """

    robot: Robot
    matrix: ImmutableMatrix | None
    composition: Composition | None = None
    frames: tuple[Frame, Frame] | None = None
    word: Word | None = None
    point: Vector | None = None
    moved: Vector | None = None
    numbers: Description | None = None


def of_steps(
    robot: Robot, steps: Sequence[Step], point: Vector | None, symbolic: bool = False
) -> RotationResult:
    """Compose rotations; describe the result in numbers where all angles have values.

    Parameters
    ----------
    robot : Robot
        The stand-in, with the values of the symbols.
    steps : sequence of Step
    point : tuple of 3 Expr, or None
    symbolic : bool
        Leave the numbers out.
    """
    composition = compose(steps, point)
    known = {} if symbolic else dict(robot.values)
    exact = composition.matrix.xreplace(known)
    numbers = None if exact.free_symbols else describe(nearest_rotation(numbers_of(exact)))
    return RotationResult(
        robot,
        composition.matrix,
        composition=composition,
        word=composition.word,
        point=point,
        moved=composition.steps[-1].point,
        numbers=numbers,
    )


def of_matrix(
    robot: Robot,
    entries: Sequence[Expr],
    point: Vector | None,
    symbolic: bool = False,
    tolerance: float = TOLERANCE,
) -> RotationResult:
    """Check nine entries, by rows, and describe the rotation that they are.

    Raises
    ------
    UnsupportedError
        When they are no rotation within the tolerance, or hold symbols without values.
    """
    matrix = ImmutableMatrix(3, 3, tuple(entries))
    exact = matrix.xreplace(dict(robot.values))
    numbers = None
    if symbolic:
        check_family(matrix, tolerance)
    elif exact.free_symbols:
        names = ", ".join(symbol.name for symbol in in_name_order(exact.free_symbols))
        raise UnsupportedError(f"{names} has no value; add --symbolic for formulas alone")
    else:
        numbers = describe(nearest_rotation(numbers_of(exact), tolerance))
    after = None if point is None else _times(matrix, point)
    return RotationResult(robot, matrix, point=point, moved=after, numbers=numbers)


def of_arm(
    robot: Robot,
    start: Frame,
    end: Frame,
    values: Mapping[Symbol, Expr],
    point: Vector | None = None,
    symbolic: bool = False,
) -> RotationResult:
    """Describe the orientation of frame `end` in frame `start`.

    Parameters
    ----------
    robot : Robot
    start, end : Frame
    values : mapping of Symbol to Expr
        Exact numbers; they win over the table's own.
    point : tuple of 3 Expr, optional
        A direction or point of frame `end`, turned into the axes of `start`.
    symbolic : bool
        Give formulas and no numbers.

    Raises
    ------
    UnsupportedError
        When there is no such frame, or, unless `symbolic`, a symbol without a value.
    LimitError
        When `symbolic` is asked for and the closed form would be too large.
    """
    word = rotations(chain_word(robot, start, end))
    matrix = None
    if symbolic or has_closed_form(robot, start, end):
        matrix = ImmutableMatrix(transform(robot, start, end)[:3, :3])
    numbers = None
    if not symbolic:
        check_values(word, {**robot.values, **values})
        reached = pose(robot, start, end, _all_known(robot, values))
        numbers = describe(nearest_rotation([row[:3] for row in reached[:3]]))
    after = moved(word, point)
    return RotationResult(
        robot,
        matrix,
        frames=(start, end),
        word=word,
        point=point,
        moved=after,
        numbers=numbers,
    )


def _all_known(robot: Robot, values: Mapping[Symbol, Expr]) -> dict[Symbol, Expr]:
    """Give lengths without a value some number: an orientation does not depend on them."""
    lengths = {symbol: symbol * 0 for symbol in (*robot.parameters, *robot.variables)}
    return {**lengths, **robot.values, **values}


def _times(matrix: ImmutableMatrix, point: Vector) -> Vector:
    x, y, z = (sum((matrix[r, c] * point[c] for c in range(3)), point[0] * 0) for r in range(3))
    return x, y, z
