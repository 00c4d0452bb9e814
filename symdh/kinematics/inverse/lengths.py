"""Random numbers for the parameters of an arm that have no value, such that it exists."""

from __future__ import annotations

import random

from sympy import Expr, Float, Function, Pow, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.frame import first_frame, last_frame
from symdh.kinematics.inverse.numeric_chain import NumericChain
from symdh.robot import Robot
from symdh.table import with_values
from symdh.table.quantity import NOT_FINITE

#: How often numbers are drawn until ``sqrt(L - 1)`` and its like are real, and after how many
#: times from twice the range.
_DRAWS, _SOME = 200, 20


def drawn_lengths(
    robot: Robot, drawn: random.Random, low: float, high: float
) -> dict[Symbol, float]:
    """Draw numbers for open parameters, anew until every amount of the table is a real number.

    Parameters
    ----------
    robot : Robot
        Parameters that have a value keep it.
    drawn : random.Random
    low, high : float
        The range; it grows upwards where none of its numbers will do.

    Returns
    -------
    dict of Symbol to float
        Of the parameters that have no value, in their order.

    Raises
    ------
    UnsupportedError
        When the values make an amount infinite or complex, or all numbers that were drawn do.
    """
    word = chain_word(robot, first_frame(robot), last_frame(robot))
    # Sums and multiples of real numbers are real.
    amounts = [m.amount for m in word if m.amount.atoms(Pow, Function)]
    values = {s: v for s, v in robot.values.items() if s in robot.parameters}
    wanted = [s for s in robot.parameters if s not in values]
    unreal: list[Expr] = []
    for k in range(_DRAWS):
        numbers = {symbol: drawn.uniform(low, high * 2 ** (k // _SOME)) for symbol in wanted}
        known = {**{symbol: Float(x, 17) for symbol, x in numbers.items()}, **values}
        unreal = [amount for amount in amounts if not _is_real(amount.xreplace(known))]
        if not unreal:
            return numbers
    with_values(unreal[0], values)
    raise UnsupportedError(f"no numbers were found that make {unreal[0]} a real number")


def random_chain(robot: Robot) -> NumericChain:
    """Return the chain of a robot, with random numbers for parameters that have no value."""
    numbers = drawn_lengths(robot, random.Random(11), 0.3, 1.5)
    return NumericChain.of(robot, {symbol.name: number for symbol, number in numbers.items()})


def _is_real(amount: Expr) -> bool:
    """Say whether an amount is real and finite; joint variables in it are."""
    return amount.is_real is not False and not amount.has(*NOT_FINITE)
