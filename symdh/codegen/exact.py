"""The exact pose of a robot, which generated code is judged by.

It shares nothing with the code: it is a plain product of the table's elementary 4x4 matrices at 50
digits.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import mpmath
from sympy import Expr, Rational, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.robot import MotionKind, Robot

_DIGITS = 50


class ExactChain:
    """The pose of a robot at 50 digits, motion by motion.

    Parameters
    ----------
    robot : Robot
    parameters : mapping of Symbol to float
        A number for each parameter that the table leaves open.
    """

    def __init__(self, robot: Robot, parameters: Mapping[Symbol, float]) -> None:
        values: dict[Symbol, Expr] = {
            symbol: _exact(number) for symbol, number in parameters.items()
        }
        values |= {p: robot.values[p] for p in robot.parameters if p in robot.values}
        self._variables = robot.variables
        self._mp = mpmath.mp.clone()
        self._mp.dps = _DIGITS
        self._motions = [
            (motion.kind, int(motion.axis), self._line(motion.amount.xreplace(values)))
            for motion in chain_word(robot, "base", "tool")
        ]

    def error(self, joints: Sequence[float], pose: Sequence[float]) -> float:
        """Return the largest error of an entry as a part of the reach; NaN of a NaN."""
        mp = self._mp
        exact, reach = self.pose(joints)
        if not all(map(math.isfinite, pose)):
            return float("nan")
        largest = max(abs(exact[k // 4, k % 4] - mp.mpf(x)) for k, x in enumerate(pose))
        return float(largest / max(1, reach))

    def pose(self, joints: Sequence[float]) -> tuple[Any, Any]:
        """Return the pose, a matrix of mpmath, and how far the arm reaches in it."""
        mp = self._mp
        at = {v: mp.mpf(x) for v, x in zip(self._variables, joints, strict=True)}
        pose, reach = mp.eye(4), mp.mpf(0)
        for kind, axis, (constant, slopes) in self._motions:
            amount = constant + sum(slope * at[variable] for variable, slope in slopes)
            if kind is MotionKind.TRANSLATION:
                reach += abs(amount)
            pose = pose * self._elementary(kind, axis, amount)
        return pose, reach

    @property
    def lengths(self) -> float:
        """The sum of all lengths, slides at 0; 1 where there is none."""
        lengths = (
            abs(constant)
            for kind, _, (constant, _) in self._motions
            if kind is MotionKind.TRANSLATION
        )
        return float(sum(lengths)) or 1.0

    def _line(self, amount: Expr) -> tuple[Any, tuple[tuple[Symbol, Any], ...]]:
        """Write an amount as a constant and a slope for each variable."""
        slopes = []
        for variable in self._variables:
            if amount.has(variable):
                slopes.append((variable, self._number(amount.diff(variable))))
                amount = amount.xreplace({variable: _exact(0.0)})
        return self._number(amount), tuple(slopes)

    def _number(self, value: Expr) -> Any:
        number = value.evalf(_DIGITS)
        if not number.is_Float and not number.is_Integer:
            raise UnsupportedError(f"{value} has no value to verify with")
        return self._mp.mpf(str(number))

    def _elementary(self, kind: MotionKind, axis: int, amount: Any) -> Any:
        matrix = self._mp.eye(4)
        if kind is MotionKind.TRANSLATION:
            matrix[axis, 3] = amount
            return matrix
        i, j = (axis + 1) % 3, (axis + 2) % 3
        cosine, sine = self._mp.cos(amount), self._mp.sin(amount)
        matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = cosine, -sine, sine, cosine
        return matrix


def _exact(number: float) -> Expr:
    numerator, denominator = number.as_integer_ratio()
    return Rational(numerator, denominator)
