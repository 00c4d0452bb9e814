"""Forward kinematics in floating point, for the checks that inverse kinematics makes of itself."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, pi, sin

from sympy import Expr, Float

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.frame import first_frame, last_frame
from symdh.kinematics.numeric import check_values
from symdh.robot import MotionKind, Robot

FloatMatrix = tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class _Part:
    """A motion: its kind and axis, the joint variable in it and its factor, and a constant."""

    turns: bool
    axis: int
    variable: int | None
    factor: float
    constant: float


@dataclass(frozen=True)
class NumericChain:
    """The chain of a robot, from its first frame to its last, with numbers for its parameters.

    Attributes
    ----------
    parts : tuple
        Its elementary motions.
    reach : float
        The sum of all constant lengths, 1 where there are none.
    variables : int
        How many joint variables there are.
    """

    parts: tuple[_Part, ...]
    reach: float
    variables: int

    @classmethod
    def of(cls, robot: Robot, extra: Mapping[str, float] | None = None) -> NumericChain:
        """Return the chain of a robot.

        Parameters
        ----------
        robot : Robot
        extra : mapping of str to float, optional
            Numbers for parameters that the table gives none.

        Raises
        ------
        UnsupportedError
            When a parameter has no value.
        """
        given = extra or {}
        more = {s: Float(given[s.name], 17) for s in robot.parameters if s.name in given}
        known: dict[Expr, Expr] = {s: v for s, v in robot.values.items() if s in robot.parameters}
        known |= more
        places = {variable: k for k, variable in enumerate(robot.variables)}
        word = chain_word(robot, first_frame(robot), last_frame(robot))
        check_values(word, {**known, **dict.fromkeys(robot.variables, Float(0))})
        parts, reach = [], 0.0
        for motion in word:
            turns = motion.kind is MotionKind.ROTATION
            variable, factor, constant = None, 0.0, motion.amount
            for symbol in motion.amount.free_symbols & set(places):
                slope = motion.amount.diff(symbol)
                variable, factor = places[symbol], float(slope)
                constant = constant - slope * symbol
            value = _number(constant.xreplace(known))
            if variable is None and not value:
                continue
            reach += 0.0 if turns else abs(value)
            parts.append(_Part(turns, int(motion.axis), variable, factor, value))
        return cls(tuple(parts), reach or 1.0, len(places))

    @cached_property
    def turning(self) -> tuple[bool, ...]:
        """Which joint variables are angles; the others are lengths."""
        turns = {part.variable: part.turns for part in self.parts}
        return tuple(turns[k] for k in range(self.variables))

    def random_values(self, drawn: random.Random) -> list[float]:
        """Draw joint values: angles in a whole turn, slides up to the reach either way."""
        return [
            drawn.uniform(-pi, pi) if turns else self.reach * drawn.uniform(-1, 1)
            for turns in self.turning
        ]

    def pose(self, q: Sequence[float]) -> FloatMatrix:
        """Return the pose of the last frame, 3 rows of 4."""
        columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]
        for part in reversed(self.parts):
            amount = part.constant
            if part.variable is not None:
                amount += part.factor * q[part.variable]
            if not part.turns:
                columns[3][part.axis] += amount
                continue
            first, second = (part.axis + 1) % 3, (part.axis + 2) % 3
            c, s = cos(amount), sin(amount)
            for column in columns:
                x, y = column[first], column[second]
                column[first], column[second] = c * x - s * y, s * x + c * y
        return tuple(tuple(column[r] for column in columns) for r in range(3))

    def jacobian(self, q: Sequence[float]) -> list[list[float]]:
        """Return six rows: velocity of the last origin, then angular velocity."""
        columns = [[0.0] * 6 for _ in range(self.variables)]
        axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        place = [0.0, 0.0, 0.0]
        met: list[tuple[_Part, list[float], list[float]]] = []
        for part in self.parts:
            amount = part.constant
            direction = list(axes[part.axis])
            if part.variable is not None:
                amount += part.factor * q[part.variable]
                met.append((part, direction, list(place)))
            if not part.turns:
                place = [x + amount * d for x, d in zip(place, direction, strict=True)]
                continue
            first, second = (part.axis + 1) % 3, (part.axis + 2) % 3
            c, s = cos(amount), sin(amount)
            x, y = axes[first], axes[second]
            axes[first] = [c * a + s * b for a, b in zip(x, y, strict=True)]
            axes[second] = [c * b - s * a for a, b in zip(x, y, strict=True)]
        for part, z, origin in met:
            assert part.variable is not None
            column = columns[part.variable]
            if part.turns:
                lever = [a - b for a, b in zip(place, origin, strict=True)]
                swept = (
                    z[1] * lever[2] - z[2] * lever[1],
                    z[2] * lever[0] - z[0] * lever[2],
                    z[0] * lever[1] - z[1] * lever[0],
                )
                rates = (*swept, *z)
            else:
                rates = (*z, 0.0, 0.0, 0.0)
            for k, rate in enumerate(rates):
                column[k] += part.factor * rate
        return [[column[k] for column in columns] for k in range(6)]


def _number(value: Expr) -> float:
    if value.free_symbols or not value.is_real or not value.is_finite:
        raise UnsupportedError(f"{value} is not a real number")
    return float(value)
