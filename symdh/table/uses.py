"""What each symbol measures, told from where it stands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sympy import Add, Expr, Symbol, cos, sin, tan

from symdh.robot import MotionKind, Robot
from symdh.table.units import ANGLE, LENGTH, Dimension


def dimensions_of_symbols(
    expressions: Iterable[tuple[Expr, Dimension | None]],
) -> dict[Symbol, set[Dimension]]:
    """Return what each symbol measures in `expressions`, whose own dimensions are given.

    A symbol that is a term of a sum, but for a factor, measures what the sum measures; one inside
    ``sin``, ``cos`` or ``tan`` is an angle. Where this tells nothing, as in a product of symbols,
    the symbol is missing.
    """
    found: dict[Symbol, set[Dimension]] = {}
    for expression, dimension in expressions:
        for symbol, measured in _uses(expression, dimension):
            found.setdefault(symbol, set()).add(measured)
    return found


def symbol_dimension(robot: Robot, symbol: Symbol) -> Dimension | None:
    """Return what a symbol of `robot` measures: ANGLE, LENGTH, or None where that is open."""
    found = dimensions_of_symbols(_expressions(robot)).get(symbol, set())
    return next(iter(found)) if len(found) == 1 else None


def _uses(expression: Expr, dimension: Dimension | None) -> Iterator[tuple[Symbol, Dimension]]:
    if dimension is not None:
        yield from _terms(expression, dimension)
    # These are all of them, those inside others included.
    for call in expression.atoms(sin, cos, tan):
        yield from _terms(call.args[0], ANGLE)


def _terms(total: Expr, dimension: Dimension) -> Iterator[tuple[Symbol, Dimension]]:
    for term in Add.make_args(total):
        factor = term.as_coeff_Mul()[1]
        if isinstance(factor, Symbol):
            yield factor, dimension


def _expressions(robot: Robot) -> Iterator[tuple[Expr, Dimension]]:
    for joint in robot.joints:
        yield from ((joint.theta, ANGLE), (joint.alpha, ANGLE))
        yield from ((joint.d, LENGTH), (joint.a, LENGTH))
    for motion in (*robot.base, *robot.tool):
        yield motion.amount, ANGLE if motion.kind is MotionKind.ROTATION else LENGTH
