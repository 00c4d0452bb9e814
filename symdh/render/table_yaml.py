"""A robot as the YAML table that loads back to it, number for number."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sympy import Add, Expr, Rational, Symbol, pi
from sympy.printing.str import StrPrinter

from symdh._version import __version__
from symdh.errors import LimitError
from symdh.notation.numbers import decimal
from symdh.notation.writing import is_decimal
from symdh.robot import AngleUnit, Joint, JointType, Motion, MotionKind, Robot, in_name_order
from symdh.table import ANGLE, symbol_dimension
from symdh.table.lexer import MAX_EXPRESSION
from symdh.table.near_pi import pi_text
from symdh.table.quantity import MAX_BITS

MARK = f"# written by symdh {__version__}"
"""The first line of a table, by which symdh knows that it may be written anew."""

_QUOTED = set(",[]{}:#&*!|>'\"%@`")
_MAX_DIGITS = 20


def table_yaml(robot: Robot, remarks: Iterable[str] = ()) -> str:
    """Write a table.

    Parameters
    ----------
    robot : Robot
    remarks : iterable of str
        Lines of comment on top.

    Returns
    -------
    str
        A table that `symdh.loads` reads as the same robot: same rows, words, values and limits.

    Raises
    ------
    LimitError
        When an expression is too long for a table.
    """
    lines = [MARK, *(f"# {remark}" for remark in remarks), *first_settings(robot), "joints:"]
    lines += [f"  - {{{_joint(joint, robot.units.angle)}}}" for joint in robot.joints]
    return "\n".join([*lines, *last_settings(robot)]) + "\n"


def first_settings(robot: Robot) -> list[str]:
    """Write the keys that stand before the rows of a table, each on one line."""
    lines = [f"name: {robot.name}"]
    if robot.title:
        lines.append(f"title: {_single_quoted(robot.title)}")
    lines.append(f"convention: {robot.convention.value}")
    units = {"angle": robot.units.angle, "length": robot.units.length}
    given = ", ".join(f"{name}: {unit.value}" for name, unit in units.items() if unit)
    if given:
        lines.append(f"units: {{{given}}}")
    return lines


def last_settings(robot: Robot) -> list[str]:
    """Write the keys that stand after the rows of a table, each on one line."""
    lines = []
    unit = robot.units.angle
    for key, word in (("base", robot.base), ("tool", robot.tool)):
        if word:
            lines.append(f"{key}: [{', '.join(_motion(motion, unit) for motion in word)}]")
    if robot.values:
        lines.append(f"values: {{{_values(robot)}}}")
    if robot.limits:
        lines.append(f"limits: {{{_limits(robot)}}}")
    return lines


def _joint(joint: Joint, unit: AngleUnit | None) -> str:
    cells = {
        "theta": angle_text(joint.theta, unit),
        "d": length_text(joint.d, unit),
        "a": length_text(joint.a, unit),
        "alpha": angle_text(joint.alpha, unit),
    }
    if not _reads_as(joint):
        cells["type"] = joint.type.value
    if joint.variable is not None and not _finds_variable(joint):
        cells["variable"] = joint.variable.name
    return ", ".join(f"{name}: {_plain(text)}" for name, text in cells.items())


def _reads_as(joint: Joint) -> bool:
    """Say whether a row's type is what a reader takes it for."""
    if joint.theta.free_symbols:
        return joint.type is JointType.REVOLUTE
    if joint.d.free_symbols:
        return joint.type is JointType.PRISMATIC
    return joint.type is JointType.FIXED


def _finds_variable(joint: Joint) -> bool:
    home = joint.theta if joint.type is JointType.REVOLUTE else joint.d
    return bool(home.free_symbols == {joint.variable})


def _motion(motion: Motion, unit: AngleUnit | None) -> str:
    turning = motion.kind is MotionKind.ROTATION
    amount = angle_text(motion.amount, unit) if turning else length_text(motion.amount, unit)
    return _plain(f"{motion.kind.value}{motion.axis.name.lower()}({amount})")


def _values(robot: Robot) -> str:
    entries = []
    for symbol in in_name_order(robot.values):
        write = angle_text if symbol_dimension(robot, symbol) == ANGLE else length_text
        entries.append(f"{symbol.name}: {_plain(write(robot.values[symbol]))}")
    return ", ".join(entries)


def _limits(robot: Robot) -> str:
    turning: Mapping[Symbol | None, bool] = {
        joint.variable: joint.type is JointType.REVOLUTE for joint in robot.joints
    }
    entries = []
    for symbol in in_name_order(robot.limits):
        write = angle_text if turning[symbol] else length_text
        bounds = robot.limits[symbol]
        lower, upper = _plain(write(bounds.lower)), _plain(write(bounds.upper))
        entries.append(f"{symbol.name}: [{lower}, {upper}]")
    return ", ".join(entries)


def length_text(expression: Expr, unit: AngleUnit | None = None) -> str:
    """Write a length, or a plain number; for `unit` see `angle_text`."""
    _check_numbers(expression)
    return _checked(_Printer(unit).doprint(expression))


def angle_text(expression: Expr, unit: AngleUnit | None = None) -> str:
    """Write an angle; its constants carry their units, so that no table reads them otherwise.

    Parameters
    ----------
    expression : Expr
        Radians.
    unit : AngleUnit or None
        What a bare number means in the table.
    """
    _check_numbers(expression)
    terms = Add.make_args(expression)
    named = sorted((t for t in terms if t.free_symbols), key=_name_key)
    constants = sorted((t for t in terms if not t.free_symbols), key=str)
    text = ""
    for term in (*named, *constants):
        minus = term.could_extract_minus_sign()
        written = _angle_term(-term if minus else term, unit)
        if text:
            text += f" - {written}" if minus else f" + {written}"
        else:
            text = f"-{written}" if minus else written
    return _checked(text)


def _angle_term(term: Expr, unit: AngleUnit | None) -> str:
    if term == 0:
        return "0"
    turns = term / pi
    if turns.is_Rational:
        degrees = turns * 180
        return f"{decimal(degrees)} deg" if _is_short_decimal(degrees) else pi_text(turns)
    if term.is_Rational:
        return _in_radians(term)
    return str(_AnglePrinter(unit).doprint(term))


def _in_radians(number: Rational) -> str:
    if _is_short_decimal(number):
        return f"{decimal(number)} rad"
    return f"({number.p}/{number.q}) rad"


def _is_short_decimal(number: Rational) -> bool:
    return is_decimal(number) and len(decimal(number)) <= _MAX_DIGITS


def _name_key(term: Expr) -> str:
    return ",".join(symbol.name for symbol in in_name_order(term.free_symbols)) + str(term)


class _Printer(StrPrinter):  # type: ignore[misc]
    """sympy's own spelling, where the parser of tables reads it alike."""

    def __init__(self, unit: AngleUnit | None) -> None:
        super().__init__()
        self._unit = unit

    def _print_Rational(self, expression: Rational) -> str:
        if _is_short_decimal(expression):
            return decimal(expression)
        return f"{expression.p}/{expression.q}"

    def _print_Abs(self, expression: Expr) -> str:
        return f"abs({self._print(expression.args[0])})"

    def _of_an_angle(self, expression: Expr) -> str:
        return f"{type(expression).__name__}({angle_text(expression.args[0], self._unit)})"

    _print_sin = _print_cos = _print_tan = _of_an_angle


class _AnglePrinter(_Printer):
    """Spells a product that is an angle: a number in a sum inside it is in radians.

    A table in radians needs to say so nowhere, and there the number may be a factor; any other
    table refuses a bare number in such a place.
    """

    def _print_Add(self, expression: Expr, order: str | None = None) -> str:
        number, rest = expression.as_coeff_Add()
        if number == 0 or self._unit is AngleUnit.RADIAN:
            return str(super()._print_Add(expression, order))
        sign = "-" if number.is_negative else "+"
        return f"{self._print(rest)} {sign} {_in_radians(abs(number))}"

    def _print_Function(self, expression: Expr) -> str:
        # What other functions are given is no angle: a ratio, or lengths.
        return str(_Printer(self._unit).doprint(expression))


def _check_numbers(expression: Expr) -> None:
    """Refuse numbers that a reader of tables would refuse."""
    for number in expression.atoms(Rational):
        bits = max(int(number.p).bit_length(), int(number.q).bit_length())
        if bits > MAX_BITS:
            raise LimitError(
                f"a number of this table has {bits} bits, over the limit of {MAX_BITS}; "
                "give the axes with fewer digits"
            )


def _checked(text: str) -> str:
    if len(text) > MAX_EXPRESSION:
        raise LimitError(
            f"an exact expression of this table has {len(text)} characters, over the limit of "
            f"{MAX_EXPRESSION}; give directions that make rounder numbers, or rounded ones"
        )
    return text


def _plain(text: str) -> str:
    """Quote a text where YAML would see more in it than text."""
    return _single_quoted(text) if _QUOTED & set(text) else text


def _single_quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"
