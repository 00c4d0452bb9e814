"""Names of symbols: Greek letters, subscripts, and the names that are taken."""

from __future__ import annotations

import re

from sympy import Symbol

from symdh.errors import UnsupportedError
from symdh.robot import Robot
from symdh.table.units import ANGLE_UNITS

MAX_NAME = 40

_LOWER = """
alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu
nu xi omicron pi rho sigma tau upsilon phi chi psi omega
""".split()  # noqa: SIM905
_GREEK = {
    **dict(zip("αβγδεζηθικλμνξοπρστυφχψω", _LOWER, strict=True)),
    **dict(zip("ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ", map(str.capitalize, _LOWER), strict=True)),
    "ς": "sigma",
    "ϑ": "theta",
    "ϕ": "phi",
    "ϵ": "epsilon",
    "µ": "mu",  # the micro sign, which some keyboards give for the letter
}
_SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
_SPELLING = str.maketrans(_GREEK | _SUBSCRIPTS)

GREEK_LETTERS = "".join(_GREEK)
SUBSCRIPT_DIGITS = "".join(_SUBSCRIPTS)

FUNCTION_NAMES = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "abs")
CONSTANT = "pi"
NOT_NUMBERS = ("inf", "infinity", "nan")


def canonical_name(written: str) -> str:
    """Return the one spelling of a name: ``θ_1``, ``θ₁`` and ``theta_1`` give ``theta1``.

    Greek letters are spelt out, subscript digits become digits, and an underscore between a letter
    and the digits at the end is dropped.
    """
    return re.sub(r"(?<=[A-Za-z])_(?=[0-9]+\Z)", "", written.translate(_SPELLING))


def why_reserved(name: str) -> str | None:
    """Say why the canonical `name` cannot be a symbol, or return None when it can."""
    if len(name) > MAX_NAME:
        return f"name has {len(name)} characters, over {MAX_NAME}"
    if name in FUNCTION_NAMES:
        return f"a function needs parentheses: {name}(...)"
    if name in ANGLE_UNITS:
        return f"{name} is a unit; write it after a number, or rename the symbol"
    if name.lower() in NOT_NUMBERS:
        return f"{name} is a reserved name and not a number"
    return None


def joint_variable(robot: Robot, written: str) -> Symbol:
    """Return the joint variable that somebody names, in any spelling.

    Raises
    ------
    UnsupportedError
        When the robot has none of that name.
    """
    name = canonical_name(written.strip())
    for variable in robot.variables:
        if variable.name == name:
            return variable
    known = ", ".join(each.name for each in robot.variables)
    raise UnsupportedError(f"{written} is no joint variable of {robot.name}; these are: {known}")
