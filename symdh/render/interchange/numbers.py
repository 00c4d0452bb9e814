"""Numbers for the formats that hold no symbols: metres, radians, doubles."""

from __future__ import annotations

from sympy import Expr, Float, ImmutableMatrix, Matrix, atan2, eye, pi, sqrt

from symdh.codegen.literals import literal, nearest_double
from symdh.errors import UnsupportedError
from symdh.kinematics.chain import link_word
from symdh.kinematics.numeric import check_values
from symdh.motion import Word, elementary
from symdh.robot import (
    ZERO,
    Joint,
    JointType,
    LengthUnit,
    Motion,
    MotionKind,
    Robot,
)
from symdh.table import with_values
from symdh.table.units import convert_length

_DIGITS = 40
_NOTHING = Float("1e-30", _DIGITS)
_FINEST = 12


class Numbers:
    """Puts the values of one table into its expressions.

    Raises
    ------
    UnsupportedError
        When a parameter has no value.
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self._values = {s: v for s, v in robot.values.items() if s not in robot.variables}
        check_values(_word(robot), {**self._values, **dict.fromkeys(robot.variables, ZERO)})
        unit = robot.units.length
        self._metre = convert_length(ZERO + 1, unit or LengthUnit.METRE, LengthUnit.METRE)

    @property
    def notes(self) -> tuple[str, ...]:
        """What had to be assumed about the unit of length."""
        if self.robot.units.length is not None:
            return ()
        return ("the table gives no unit of length; its lengths are written as metres",)

    def angle(self, e: Expr) -> Expr:
        """Return exact radians."""
        return self._real(e)

    def length(self, e: Expr) -> Expr:
        """Return exact metres."""
        return self._real(e) * self._metre

    def _real(self, e: Expr) -> Expr:
        return with_values(e, self._values)

    def amount(self, motion: Motion) -> Motion:
        """Return a motion with its number."""
        read = self.angle if motion.kind is MotionKind.ROTATION else self.length
        return Motion(motion.kind, motion.axis, read(motion.amount))

    def matrix(self, word: Word) -> ImmutableMatrix:
        """Return the 4x4 pose of a word of constants, to 40 digits."""
        pose = Matrix(eye(4))
        for motion in word:
            pose = pose * elementary(self.amount(motion)).evalf(_DIGITS)
        return ImmutableMatrix(pose.applyfunc(lambda e: ZERO if abs(e) < _NOTHING else e))

    def limits(self, joint: Joint) -> tuple[Expr, Expr] | None:
        """Return the bounds of a joint variable, where the table has any."""
        found = self.robot.limits.get(joint.variable) if joint.variable else None
        if found is None:
            return None
        read = self.angle if joint.type is JointType.REVOLUTE else self.length
        return read(found.lower), read(found.upper)


def sign_and_offset(joint: Joint, row: int, form: str) -> tuple[int, Expr]:
    """Return s and c of a moving joint whose angle or slide is s q + c, s being 1 or -1.

    Raises
    ------
    UnsupportedError
        When the variable has another factor, which the format called `form` cannot say.
    """
    assert joint.variable is not None
    home = joint.theta if joint.type is JointType.REVOLUTE else joint.d
    factor = home.coeff(joint.variable)
    if factor not in (1, -1):
        raise UnsupportedError(
            f"joint {row} moves {factor} times its variable {joint.variable}; "
            f"{form} has no way to say so"
        )
    return int(factor), home - factor * joint.variable


def roll_pitch_yaw(pose: ImmutableMatrix) -> tuple[Expr, Expr, Expr]:
    """Return the angles of Rz(yaw) Ry(pitch) Rx(roll), to 40 digits."""
    level = sqrt(pose[0, 0] ** 2 + pose[1, 0] ** 2)
    pitch = _angle(-pose[2, 0], level)
    if level < _NOTHING:  # straight up or down: roll and yaw are about one line
        return ZERO, pitch, _angle(-pose[0, 1], pose[1, 1])
    return _angle(pose[2, 1], pose[2, 2]), pitch, _angle(pose[1, 0], pose[0, 0])


def _angle(sine: Expr, cosine: Expr) -> Expr:
    return atan2(sine, cosine).evalf(_DIGITS)


def triple(numbers: tuple[Expr, Expr, Expr]) -> str:
    """Write three numbers with blanks between them."""
    return " ".join(short(number) for number in numbers)


def short(number: Expr) -> str:
    """Write a double with the fewest digits that give it back, a whole number without a point."""
    value = number if number.is_Float else nearest_double(number)
    text = repr(float(value)) if value else "0"
    return text.removesuffix(".0")


def with_pi(angle: Expr) -> str:
    """Write an angle as program text: ``-pi/2`` where it is a simple part of pi."""
    part = angle / pi
    if angle != 0 and part.is_Rational and _FINEST % int(part.q) == 0:
        top = {1: "", -1: "-"}.get(int(part.p), f"{part.p}*")
        return f"{top}pi" + ("" if part.q == 1 else f"/{part.q}")
    return number_literal(angle)


def number_literal(number: Expr) -> str:
    """Write a number as program text; zero as 0."""
    return "0" if number == 0 else literal(number)


def _word(robot: Robot) -> Word:
    """Return all motions of a robot; of their order nothing depends here."""
    rows = tuple(motion for i in range(1, robot.n + 1) for motion in link_word(robot, i))
    return robot.base + rows + robot.tool
