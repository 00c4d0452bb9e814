"""Texts of the command line that symdh's own parser reads."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sympy import Expr, Symbol

    from symdh.robot import Robot


def assignment(robot: Robot, settings: tuple[str, ...]) -> dict[Symbol, Expr]:
    """Read ``name=value`` texts, the last one of a name wins.

    Raises
    ------
    TableError
        When a name is not the robot's or a value is no number.
    """
    from symdh.table import parse_setting

    return dict(parse_setting(robot, as_utf8(text)) for text in settings)


def point(robot: Robot, text: str | None) -> tuple[Expr, Expr, Expr] | None:
    """Read ``x,y,z``; None where nothing is said.

    Raises
    ------
    TableError
        When the text is no point.
    """
    from symdh.table import parse_point

    return None if text is None else parse_point(robot, as_utf8(text))


def as_utf8(argument: str) -> str:
    """Decode an argument as UTF-8 also where the locale claims that there is nothing but ASCII."""
    return os.fsencode(argument).decode("utf-8", errors="replace")
