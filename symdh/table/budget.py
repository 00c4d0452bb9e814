"""How much work the expressions of one file may be, whatever they are."""

from __future__ import annotations

from dataclasses import dataclass

from symdh.table.lexer import ExpressionError

MAX_EFFORT = 6_000
OF_NUMBERS = 80
"""The exact value of a function or a root of numbers, cos(pi/7), costs as much as many signs."""


@dataclass(slots=True)
class Budget:
    """What is left for the expressions of a file.

    Attributes
    ----------
    left : int
        In signs (names, numbers, operators, brackets); below 0 when there was too much.
    """

    left: int = MAX_EFFORT

    @property
    def is_spent(self) -> bool:
        """Whether a limit was reached, and said."""
        return self.left < 0

    def spend(self, amount: int, offset: int) -> None:
        """Take from it; raise at `offset` when that is more than is left."""
        self.left -= amount
        if self.is_spent:
            raise ExpressionError(
                offset,
                f"the expressions of this file are over the limit of {MAX_EFFORT} signs, of which "
                f"a function of numbers counts {OF_NUMBERS}",
            )
