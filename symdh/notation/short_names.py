"""Short forms as people type them: ``c12``, ``S_1``, and ``a2`` for the number in row 2."""

from __future__ import annotations

import re

from sympy import Expr, Integer, cos, sin

from symdh.notation.shorthand import Shorthand
from symdh.robot import Convention, Robot

_SHORT = re.compile(r"([csCS])_?(\d+(?:_m?\d+)*)")
_CELL = re.compile(r"(theta|d|a|alpha)_?(\d{1,3})")


class ShortNames:
    """What the names mean that a reader of a table understands though it does not hold them.

    Parameters
    ----------
    robot : Robot

    Attributes
    ----------
    names : tuple of str
        The short forms of single joints.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        shorthand = Shorthand(robot)
        self._usable = shorthand.usable
        self._numbers = {str(shorthand.number(v)): v for v in shorthand.variables}
        self.names = tuple(f"{letter}{k}" for k in self._numbers for letter in "cs")

    def __call__(self, name: str) -> Expr | None:
        """Return what a name means: the cosine or sine of joint angles, or a cell of the table.

        In ``c12`` each digit is a joint, from ten joints on all of them are one; ``c1_12`` parts
        them, and ``c1_m2`` is the cosine of a difference.
        """
        short = _SHORT.fullmatch(name)
        if short is not None and self._usable:
            angle = self._angle(short[2])
            if angle is not None:
                return cos(angle) if short[1] in "cC" else sin(angle)
        cell = _CELL.fullmatch(name)
        return None if cell is None else self._cell(cell[1], int(cell[2]))

    def _angle(self, label: str) -> Expr | None:
        long = any(len(number) > 1 for number in self._numbers)
        joints = re.findall(r"(m?)(\d+)" if long else r"(m?)(\d)", label)
        numbers = [number for _, number in joints]
        if len(set(numbers)) < len(numbers) or not set(numbers) <= set(self._numbers):
            return None
        terms = (-self._numbers[k] if minus else self._numbers[k] for minus, k in joints)
        return sum(terms, Integer(0))

    def _cell(self, column: str, number: int) -> Expr | None:
        """Return a parameter by its index, a and alpha of a modified table one row before."""
        shifted = self._robot.convention is Convention.MODIFIED and column in ("a", "alpha")
        row = number + 1 if shifted else number
        if not 1 <= row <= self._robot.n:
            return None
        amount: Expr = getattr(self._robot.joints[row - 1], column)
        return amount
