"""Entries that are nearly right: a sign, or sine in place of cosine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sympy import Add, Expr, cos, sin

from symdh.kinematics.answers.numbers import Point, close, value
from symdh.kinematics.answers.verdicts import Finding, Verdict

#: Terms and angles past which no single one is tried with another sign or function.
_MOST_TRIED = 12


def agrees(given: Expr, truths: Sequence[float], points: Sequence[Point]) -> bool:
    """Say whether an expression has given values at given points."""
    return all(
        close(value(given, point), truth) for point, truth in zip(points, truths, strict=True)
    )


def near_miss(given: Expr, truths: Sequence[float], points: Sequence[Point]) -> Finding | None:
    """Return what is nearly right with an entry, if anything.

    Parameters
    ----------
    given : Expr
    truths : sequence of float
        The right values at the points.
    points : sequence of mapping
    """
    negative = [-truth for truth in truths]
    if agrees(given, negative, points):
        return Finding(Verdict.SIGN)
    for note, swapped in _swaps(given):
        if agrees(swapped, truths, points):
            return Finding(Verdict.SWAPPED, note)
        if agrees(swapped, negative, points):
            return Finding(Verdict.SWAPPED, f"{note}, and the sign is wrong".lstrip(", "))
    terms = Add.make_args(given)
    if 1 < len(terms) <= _MOST_TRIED:
        for term in terms:
            if agrees(given - 2 * term, truths, points):
                return Finding(Verdict.SIGN, term=term)
    return None


def _swaps(given: Expr) -> Iterator[tuple[str, Expr]]:
    """Yield an expression with sine and cosine exchanged: everywhere, then of one angle."""
    calls = sorted(given.atoms(sin, cos), key=str)
    angles = list(dict.fromkeys(call.args[0] for call in calls))
    if not calls:
        return
    yield "", _swapped(given, calls)
    if 1 < len(angles) <= _MOST_TRIED:
        for angle in angles:
            yield "in one place", _swapped(given, [c for c in calls if c.args[0] == angle])
    for call in calls[:_MOST_TRIED]:
        yield "in one place", _swapped(given, [call])


def _swapped(given: Expr, calls: Sequence[Expr]) -> Expr:
    exchanged = {
        call: (cos if isinstance(call, sin) else sin)(call.args[0], evaluate=False)
        for call in calls
    }
    return given.xreplace(exchanged)
