"""Numbers for symbols: the numeric pose, rounded once from a working precision of 40 digits."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Expr, Float, ImmutableMatrix, Symbol, eye

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.frame import Frame
from symdh.motion import Word, elementary
from symdh.robot import Motion, Robot, in_name_order
from symdh.table import with_values

NumericMatrix = tuple[tuple[float, ...], ...]

_DIGITS = 40
#: What is smaller than this beside the largest entry is a zero whose digits cancelled.
_CANCELLED = Float("1e-30", _DIGITS)


def pose(robot: Robot, start: Frame, end: Frame, values: Mapping[Symbol, Expr]) -> NumericMatrix:
    """Return the numeric 4x4 pose of `end` in `start`.

    Parameters
    ----------
    robot : Robot
    start, end : Frame
    values : mapping of Symbol to Expr
        Exact numbers, radians and the table's length unit. They win over the table's own.

    Returns
    -------
    tuple of 4 tuples of 4 floats

    Raises
    ------
    UnsupportedError
        When a symbol has no value, or the values make an amount infinite or complex.
    """
    known = {**robot.values, **values}
    word = chain_word(robot, start, end)
    check_values(word, known)
    matrix = ImmutableMatrix(eye(4))
    for motion in word:
        matrix = matrix * _numeric(motion, known)
    scale = max(abs(entry) for entry in matrix)
    return tuple(
        tuple(_rounded(matrix[row, column], scale) for column in range(4)) for row in range(4)
    )


def check_values(word: Word, known: Mapping[Symbol, Expr]) -> None:
    """Check that every symbol of a word has a value.

    Raises
    ------
    UnsupportedError
        Naming each symbol that has none.
    """
    symbols = {symbol for motion in word for symbol in motion.amount.free_symbols}
    missing = [symbol.name for symbol in in_name_order(symbols - set(known))]
    if missing:
        verb = "has" if len(missing) == 1 else "have"
        raise UnsupportedError(
            f"{', '.join(missing)} {verb} no value: put them under 'values:' in the table "
            f"or give --set {missing[0]}=NUMBER"
        )


def _numeric(motion: Motion, known: Mapping[Symbol, Expr]) -> ImmutableMatrix:
    amount = with_values(motion.amount, known)
    return elementary(Motion(motion.kind, motion.axis, amount)).evalf(_DIGITS)


def _rounded(entry: Expr, scale: Expr) -> float:
    return 0.0 if abs(entry) < _CANCELLED * scale else float(entry)
