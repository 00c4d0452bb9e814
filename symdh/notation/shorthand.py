"""The short forms of trigonometric functions: which sums of joint variables, and what number each.

``c_1 = cos(theta_1)``, ``s_{23} = sin(theta_2 + theta_3)``, ``c_{1-2}`` for a difference.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from sympy import Expr, Integer, Symbol

from symdh.robot import JointType, Robot


@dataclass(frozen=True, slots=True)
class JointSum:
    """A sum of joint variables with coefficients of one, in joint order, the first one positive."""

    terms: tuple[tuple[int, int], ...]  # (joint number, sign)


class Shorthand:
    """Joint numbers for the joint variables of one robot."""

    def __init__(self, robot: Robot) -> None:
        self._numbers = _joint_numbers(robot)
        self._separate = any(number >= 10 for number in self._numbers.values())
        names = {symbol.name for symbol in (*robot.parameters, *robot.variables)}
        # A table that itself uses names such as s1 or c12 gets its functions spelt out.
        self.usable = not any(re.fullmatch(r"[cs]\d+", name) for name in names)

    @classmethod
    def none(cls, robot: Robot) -> Shorthand:
        """Return the shorthand that shortens nothing: every function is spelt out."""
        shorthand = cls(robot)
        shorthand.usable = False
        return shorthand

    @property
    def variables(self) -> tuple[Symbol, ...]:
        """The revolute joint variables, in chain order."""
        return tuple(self._numbers)

    def number(self, variable: Symbol) -> int:
        """Return the number that stands for a revolute joint variable."""
        return self._numbers[variable]

    def joint_sum(self, angle: Expr) -> tuple[JointSum, int] | None:
        """Read an angle as a sum of joint variables.

        Returns
        -------
        (JointSum, sign) or None
            The sum and the sign with which it makes the angle; None when the angle is anything
            else, or short forms are not usable for this robot.
        """
        if not self.usable:
            return None
        terms = []
        for symbol, coefficient in angle.as_coefficients_dict().items():
            if symbol not in self._numbers or coefficient not in (1, -1):
                return None
            terms.append((self._numbers[symbol], int(coefficient)))
        terms.sort()
        sign = terms[0][1]
        return JointSum(tuple((number, sign * own) for number, own in terms)), sign

    def label(self, joints: JointSum) -> str:
        """Write the subscript so that it reads one way: 12, 1-2; 1,12 where numbers reach 10."""
        text = ""
        for position, (number, sign) in enumerate(joints.terms):
            if sign < 0:
                text += "-"
            elif position and (self._separate or text[-2:-1] == "-"):
                text += ","
            text += str(number)
        return text

    def angle(self, label: str) -> Expr:
        """Return the sum of joint variables that a label stands for."""
        variables = {str(number): variable for variable, number in self._numbers.items()}
        angle: Expr = Integer(0)
        for sign, number in re.findall(
            r"([-,]?)(\d+)" if self._separate else r"([-,]?)(\d)", label
        ):
            angle = angle - variables[number] if sign == "-" else angle + variables[number]
        return angle


def _joint_numbers(robot: Robot) -> dict[Symbol, int]:
    """Number the revolute variables: by the number in their names where those tell them apart."""
    rows = {
        joint.variable: row
        for row, joint in enumerate(robot.joints, start=1)
        if joint.type is JointType.REVOLUTE and joint.variable is not None
    }
    endings = {variable: re.search(r"(?<!\d)([1-9]\d{0,2})$", variable.name) for variable in rows}
    numbers = {variable: int(found[1]) for variable, found in endings.items() if found}
    if len(numbers) == len(rows) and len(set(numbers.values())) == len(rows):
        return numbers
    return rows
