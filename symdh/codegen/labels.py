"""Readable labels for sums of joint angles: 23 in c23, s23."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Expr, Symbol

_LONGEST = 4


def angle_label(terms: Sequence[Expr], rows: Mapping[Symbol, int]) -> str:
    """Return a label for the sum of some terms, as books index c and s.

    ``theta_2 + theta_3`` gives ``23``, ``theta_1 - theta_2`` gives ``1m2``, an angle that is no
    joint's gives its name, ``_alpha1``. Constants do not show. Labels need not be unique.

    Parameters
    ----------
    terms : sequence of sympy.Expr
        In chain order.
    rows : mapping of Symbol to int
        The row, counted from 1, that each joint variable belongs to.
    """
    signed = [term for term in terms if term.free_symbols]
    symbols = [-term if term.could_extract_minus_sign() else term for term in signed]
    if not all(symbol in rows for symbol in symbols):
        names = sorted({s.name for term in signed for s in term.free_symbols})
        return "_" + "_".join(names[:_LONGEST])
    numbers = [rows[symbol] for symbol in symbols]
    minus = [term is not symbol for term, symbol in zip(signed, symbols, strict=True)]
    if len(numbers) > _LONGEST:
        return f"{numbers[0]}to{numbers[-1]}"
    between = "_" if max(numbers) > 9 else ""
    parts = [("m" if less else "") + str(n) for less, n in zip(minus, numbers, strict=True)]
    return between.join(parts)
