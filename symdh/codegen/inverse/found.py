"""The closed form that code is generated from, searched once for all languages."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

from sympy import Symbol

from symdh.codegen.fingerprint import fingerprint
from symdh.codegen.names import comment_text
from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.search import closed_form
from symdh.kinematics.inverse.solution import ClosedForm, Tried
from symdh.robot import Robot

#: Seconds of CPU that the search may take while code is generated.
SECONDS = 5.0
#: What a pose gives; arms with more joints need some of them locked.
_MOST = 6
#: A table with more rows is no arm that the search was made for.
_MOST_ROWS = 16


@dataclass(frozen=True, slots=True)
class Missing:
    """Why a file has no inverse kinematics: the end of a sentence, safe in any comment."""

    reason: str


#: Of a file that was asked for without it.
LEFT_OUT = Missing("it was left out, as asked")


@dataclass(frozen=True)
class _Wanted:
    """What is searched; two tables with one fingerprint are one."""

    table: str
    locked: tuple[str, ...]
    robot: Robot = field(compare=False, repr=False)
    symbols: tuple[Symbol, ...] = field(compare=False, repr=False)


def found_form(robot: Robot, locked: tuple[Symbol, ...] = ()) -> ClosedForm | Missing:
    """Return the closed form of a robot's inverse kinematics, or why there is none.

    Parameters
    ----------
    robot : Robot
    locked : tuple of Symbol
        Joint variables to hold.

    Raises
    ------
    UnsupportedError
        When a variable to be locked is none of the robot's.
    """
    for variable in locked:
        if variable not in robot.variables:
            known = ", ".join(v.name for v in robot.variables)
            raise UnsupportedError(
                f"{variable.name} is no joint variable of {robot.name}; these are: {known}"
            )
    freedoms = len(robot.variables) - len(locked)
    if freedoms < 1:
        return Missing("no joint moves")
    if freedoms > _MOST:
        return Missing(f"{freedoms} joints move, and a pose gives six numbers")
    if robot.n > _MOST_ROWS:
        return Missing(f"the table has more than {_MOST_ROWS} rows")
    names = tuple(variable.name for variable in locked)
    return _searched(_Wanted(fingerprint(robot), names, robot, locked))


@lru_cache(maxsize=8)
def _searched(wanted: _Wanted) -> ClosedForm | Missing:
    try:
        form = closed_form(wanted.robot, None, wanted.symbols, SECONDS)
    except UnsupportedError as error:
        return Missing(comment_text(str(error)))
    return form if isinstance(form, ClosedForm) else _missing(form)


def _missing(tried: Tried) -> Missing:
    if tried.timed_out:
        return Missing(f"the search for a closed form was stopped after {SECONDS:g} s")
    return Missing(comment_text(tried.reason) or "no closed form was found")
