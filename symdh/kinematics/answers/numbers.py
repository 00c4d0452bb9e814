"""Expressions and chains in double precision, for what is tried many times."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from sympy import (
    Abs,
    Add,
    Expr,
    Float,
    Mul,
    Pow,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    pi,
    prime,
    sin,
    tan,
)

from symdh.motion import Word
from symdh.robot import MotionKind

#: A number for each symbol.
Point = Mapping[Symbol, float]
Matrix = tuple[tuple[float, ...], ...]

_FUNCTIONS: dict[type, Callable[..., float]] = {
    cos: math.cos,
    sin: math.sin,
    tan: math.tan,
    acos: math.acos,
    asin: math.asin,
    atan: math.atan,
    atan2: math.atan2,
    Abs: abs,
}
_CLOSE = 1e-9
_DIGITS = 50


def value(expression: Expr, point: Point) -> float:
    """Return what an expression is worth; not a number where it has no real value."""
    try:
        return _value(expression, point)
    except (ValueError, OverflowError, ZeroDivisionError):
        return math.nan


def _value(e: Expr, point: Point) -> float:
    if e.is_Rational:
        return int(e.p) / int(e.q)
    if isinstance(e, Symbol):
        return point[e]
    if e == pi:
        return math.pi
    if isinstance(e, Add):
        return math.fsum(_value(part, point) for part in e.args)
    if isinstance(e, Mul):
        return math.prod(_value(part, point) for part in e.args)
    if isinstance(e, Pow):
        found = _value(e.base, point) ** _value(e.exp, point)
        return found if isinstance(found, float) else math.nan
    function = _FUNCTIONS.get(type(e))
    if function is None:  # the imaginary unit, for one, of sqrt(-a1) for a positive a1
        found = e.xreplace({s: Float(point[s]) for s in e.free_symbols}).evalf()
        return float(found) if found.is_real else math.nan
    return function(*(_value(part, point) for part in e.args))


def precise(expression: Expr, point: Point) -> Expr:
    """Return what an expression is worth to 50 digits."""
    exact = {s: Float(point[s], _DIGITS + 20) for s in expression.free_symbols}
    return expression.xreplace(exact).evalf(_DIGITS)


def close(x: float, y: float) -> bool:
    """Say whether two numbers are equal but for rounding."""
    return abs(x - y) <= _CLOSE * (1 + abs(x) + abs(y))


def matrix(word: Word, point: Point) -> Matrix:
    """Return the 4x4 matrix of a word."""
    columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]
    for motion in reversed(word):
        amount = value(motion.amount, point)
        if motion.kind is MotionKind.TRANSLATION:
            columns[3][motion.axis] += amount
            continue
        first, second = (motion.axis + 1) % 3, (motion.axis + 2) % 3
        c, s = (math.cos(amount), math.sin(amount)) if math.isfinite(amount) else (math.nan,) * 2
        for column in columns:
            x, y = column[first], column[second]
            column[first], column[second] = c * x - s * y, s * x + c * y
    return (*(tuple(column[r] for column in columns) for r in range(3)), (0.0, 0.0, 0.0, 1.0))


def transposed(pose: Matrix) -> Matrix:
    """Return the transpose of a matrix."""
    return tuple(zip(*pose, strict=True))


def turned_back(pose: Matrix) -> Matrix:
    """Return a pose with its rotation transposed and its position as it was."""
    rows = [(*(pose[c][r] for c in range(3)), pose[r][3]) for r in range(3)]
    return (*rows, pose[3])


def inverse(pose: Matrix) -> Matrix:
    """Return the rigid inverse of a pose."""
    rows = []
    for c in range(3):
        column = [pose[r][c] for r in range(3)]
        at = -sum(x * pose[r][3] for r, x in enumerate(column))
        rows.append((*column, at))
    return (*rows, pose[3])


def random_points(
    symbols: Iterable[Symbol], known: Point, count: int, angles: Collection[Symbol] = ()
) -> list[dict[Symbol, float]]:
    """Return points that obey no relation by accident; lengths of the first half are positive.

    Parameters
    ----------
    symbols : iterable of Symbol
        In a fixed order.
    known : mapping of Symbol to float
        Symbols whose number is given.
    count : int
    angles : collection of Symbol
        Those that are positive as often as negative in either half.
    """
    letters = list(symbols)
    points = []
    for shift in range(count):
        signs = _signs(shift, count)
        turns = (-1) ** shift
        values = {
            letter: (turns if letter in angles else signs[k % 2]) * _fraction(k, shift)
            for k, letter in enumerate(letters)
        }
        points.append({**values, **known})
    return points


def _fraction(k: int, shift: int) -> float:
    """Return a number between 0.2 and 3 from primes."""
    top = int(prime(37 + 11 * k + 5 * shift)) * 1009 % 2793 + 200
    return top / 1000 + math.sqrt(int(prime(3 + k + shift))) / 1e4


def _signs(shift: int, count: int) -> Sequence[int]:
    if shift < count // 2:
        return (1, 1)
    return (-1, 1) if shift % 2 else (1, -1)
