"""Vectors in space with exact entries, each kept in its short form."""

from __future__ import annotations

from sympy import Expr, Pow

from symdh.frames.exact import common_factor, is_zero, root, tidy
from symdh.mechanism import ONE, ZERO, Vector

X: Vector = (ONE, ZERO, ZERO)
Y: Vector = (ZERO, ONE, ZERO)
Z: Vector = (ZERO, ZERO, ONE)
ORIGIN: Vector = (ZERO, ZERO, ZERO)


def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return tidy(a[0] + b[0]), tidy(a[1] + b[1]), tidy(a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return tidy(a[0] - b[0]), tidy(a[1] - b[1]), tidy(a[2] - b[2])


def scale(factor: Expr, a: Vector) -> Vector:
    """Return a multiple of a vector."""
    return tidy(factor * a[0]), tidy(factor * a[1]), tidy(factor * a[2])


def negate(a: Vector) -> Vector:
    """Return -a."""
    return -a[0], -a[1], -a[2]


def dot(a: Vector, b: Vector) -> Expr:
    """Return the scalar product."""
    return tidy(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    return (
        tidy(a[1] * b[2] - a[2] * b[1]),
        tidy(a[2] * b[0] - a[0] * b[2]),
        tidy(a[0] * b[1] - a[1] * b[0]),
    )


def along(point: Vector, distance: Expr, direction: Vector) -> Vector:
    """Return the point that is so far from another one in a direction."""
    return add(point, scale(distance, direction))


def is_null(a: Vector) -> bool:
    """Say whether a vector is zero."""
    return all(is_zero(entry) for entry in a)


def length(a: Vector) -> Expr:
    """Return the length of a vector; symbols count as positive."""
    shared = common_factor(a)
    if shared != 1:
        return tidy(shared * length(scale(1 / shared, a)))
    return root(dot(a, a))


def unit(a: Vector) -> Vector:
    """Return the unit vector of a vector that is not zero."""
    shared = common_factor(a)
    if shared != 1:
        return unit(scale(1 / shared, a))
    return scale(1 / length(a), a)


def ray(a: Vector) -> Vector:
    """Return a short vector of the same direction: the unit vector where that has no new roots.

    Angles follow from directions of any length, so that a root of a long number, which the unit
    vector would bring in, need not be carried along.
    """
    shared = common_factor(a)
    if shared != 1:
        return ray(scale(1 / shared, a))
    size = length(a)
    return a if _has_root(size) else scale(1 / size, a)


def _has_root(e: Expr) -> bool:
    """Say whether a root is in an expression."""
    return any(not power.exp.is_Integer for power in e.atoms(Pow))
