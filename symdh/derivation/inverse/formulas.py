"""Small formulas that every step needs."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Integer

from symdh.derivation.blocks import Inline
from symdh.notation.nodes import (
    Equation,
    Juxtaposed,
    Negative,
    Node,
    Number,
    Power,
    Rounded,
    Sum,
    Tuple,
)

_MINUS = Integer(-1)


def equation(left: Node, right: Node) -> Equation:
    """Return an equation of two sides."""
    return Equation((left, right))


def plus(first: Node, second: Node, sign: int) -> Node:
    """Return the sum of two formulas, or their difference."""
    return Sum((first, second if sign > 0 else Negative(second)))


def inverses(names: Sequence[Node]) -> tuple[Node, ...]:
    """Return the inverse of a product: the inverses, last first."""
    return tuple(Power(name, _MINUS) for name in reversed(names))


def beside(names: Sequence[Node]) -> Node:
    """Return a product of matrices."""
    return names[0] if len(names) == 1 else Juxtaposed(tuple(names))


def place(entry: tuple[int, int]) -> Node:
    """Return the place of an entry, counted from 1."""
    return Tuple(tuple(Rounded(str(k + 1)) for k in entry))


def is_zero(node: Node) -> bool:
    """Say whether a node is the number zero."""
    return isinstance(node, Number) and node.value == 0


def listed(items: Sequence[Node]) -> tuple[Inline, ...]:
    """Return formulas as running text: a, b and c."""
    told: list[Inline] = []
    for position, item in enumerate(items):
        if position:
            told.append(" and " if position == len(items) - 1 else ", ")
        told.append(item)
    return tuple(told)
