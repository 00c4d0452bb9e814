"""A hash that tells which table a generated file comes from."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator

from sympy import Add, Expr, Mul

from symdh.robot import Motion, Robot, in_name_order


def fingerprint(robot: Robot) -> str:
    """Return the SHA-256 of what a table says, as 64 hex digits.

    It does not depend on how the table is laid out or spelt, nor on its title, which is prose.
    """
    return hashlib.sha256("\n".join(_lines(robot)).encode()).hexdigest()


def _lines(robot: Robot) -> Iterator[str]:
    yield f"name {robot.name}"
    yield f"convention {robot.convention.value}"
    angle, length = robot.units.angle, robot.units.length
    yield f"units {angle.value if angle else '-'} {length.value if length else '-'}"
    yield from _word_lines("base", robot.base)
    for joint in robot.joints:
        entries = [_text(e) for e in (joint.theta, joint.d, joint.a, joint.alpha)]
        variable = _text(joint.variable) if joint.variable is not None else "-"
        yield " ".join(["joint", joint.type.value, variable, *entries])
    yield from _word_lines("tool", robot.tool)
    for symbol in in_name_order(robot.values):
        yield f"value {_text(symbol)} {_text(robot.values[symbol])}"
    for symbol in in_name_order(robot.limits):
        limits = robot.limits[symbol]
        yield f"limits {_text(symbol)} {_text(limits.lower)} {_text(limits.upper)}"


def _word_lines(label: str, word: Iterable[Motion]) -> Iterator[str]:
    for motion in word:
        yield f"{label} {motion.kind.value}{motion.axis.name} {_text(motion.amount)}"


def _text(expression: Expr) -> str:
    """Write an expression in prefix form, terms and factors sorted: sympy's order is its own."""
    if not expression.args:
        return str(expression)
    parts = [_text(arg) for arg in expression.args]
    if isinstance(expression, (Add, Mul)):
        parts.sort()
    return f"({expression.func.__name__} {' '.join(parts)})"
