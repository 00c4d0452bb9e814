"""Texts of the command line that symdh's own parser reads."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sympy import Expr, Symbol

    from symdh.robot import Robot


def assignment(
    robot: Robot, settings: tuple[str, ...], option: str = "--set"
) -> dict[Symbol, Expr]:
    """Read ``name=value`` texts, the last one of a name wins.

    Raises
    ------
    TableError
        When a name is not the robot's or a value is no number.
    UnsupportedError
        When the values make an amount of the robot infinite, complex or too large.
    """
    from symdh.table import check_settings, parse_setting

    found = dict(parse_setting(robot, as_utf8(text), option) for text in settings)
    check_settings(robot, found)
    return found


def point(robot: Robot, text: str | None) -> tuple[Expr, Expr, Expr] | None:
    """Read the ``x,y,z`` of --at; None where nothing is said.

    Raises
    ------
    TableError
        When the text is no point.
    """
    from symdh.table import parse_point

    if text is None:
        return None
    return parse_point(as_utf8(text), robot.units, "--at", robot.variables)


def joint(robot: Robot, name: str) -> Symbol:
    """Return the joint variable that a user named.

    Raises
    ------
    UnsupportedError
        When the robot has none of that name.
    """
    from symdh.table.names import joint_variable

    return joint_variable(robot, as_utf8(name))


def as_utf8(argument: str) -> str:
    """Decode an argument as UTF-8 also where the locale claims that there is nothing but ASCII."""
    return os.fsencode(argument).decode("utf-8", errors="replace")
