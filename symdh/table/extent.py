"""How long an expression is when its powers are written out."""

from __future__ import annotations

from collections.abc import Callable

from sympy import Expr


def extent(e: Expr, of_leaf: Callable[[Expr], int]) -> int:
    """Add up what the symbols and numbers of an expression count.

    In a power the base counts as often as its exponent says, a root as its radicand.
    """
    if e.is_Symbol or e.is_Number:
        return of_leaf(e)
    if e.is_Pow and e.exp.is_Rational:
        return abs(int(e.exp.p)) * extent(e.base, of_leaf)
    return sum(extent(part, of_leaf) for part in e.args)
