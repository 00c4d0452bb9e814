"""From a command's arguments to the robot and its frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from symdh.cli import console, patience

if TYPE_CHECKING:
    from symdh.derivation.blocks import Document
    from symdh.kinematics.frame import Frame
    from symdh.robot import Robot


@dataclass(frozen=True, slots=True)
class Homework:
    """Which sheet of homework is wanted in place of the handout.

    Attributes
    ----------
    sheet : str or None
        ``"problem"``, ``"solution"``, or None for the handout.
    points : bool
        Whether each exercise has a place for points.
    ask_table : bool
        Whether the table itself is asked for.
    """

    sheet: str | None = None
    points: bool = False
    ask_table: bool = False


HANDOUT = Homework()


def read_robot(path: str) -> Robot:
    """Load a table and print its warnings.

    Raises
    ------
    TableError, ReadError
    """
    from symdh.table import load_table

    loaded = load_table(path)
    console.show_diagnostics(loaded.warnings)
    return loaded.robot


def derived(robot: Robot, order: str, notation: str, homework: Homework = HANDOUT) -> Document:
    """Make a robot's document; a person at the terminal is told when it takes long."""
    with patience.telling(f"deriving {robot.name}"):
        return document(robot, order, notation, homework)


def document(robot: Robot, order: str, notation: str, homework: Homework) -> Document:
    """Make a robot's handout, or the sheet of homework that is asked for."""
    if homework.sheet is not None:
        from symdh.derivation.sheet import sheet

        return sheet(
            robot,
            homework.sheet,
            order=order,
            naming=notation,
            points=homework.points,
            ask_table=homework.ask_table,
        )
    from symdh.derivation.derive import derive

    return derive(robot, order=order, naming=notation)


def stem(robot: Robot, homework: Homework) -> str:
    """Return what a robot's files are called: ``arm``, ``arm_problem``."""
    from symdh.codegen.names import file_stem

    return file_stem(robot.name) + (f"_{homework.sheet}" if homework.sheet else "")


def read_preamble(path: str | None) -> str:
    """Return the text of a preamble file; nothing where none is asked for.

    Raises
    ------
    TableError, ReadError
        When it is no text, or cannot be read.
    """
    if path is None:
        return ""
    from symdh.table.source import read_source

    return read_source(path).text


def frames_between(robot: Robot, start: str | None, end: str | None) -> tuple[Frame, Frame]:
    """Return the two frames that a user named; the whole chain where nothing is said.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    """
    from symdh.kinematics.frame import first_frame, frame_from_text, last_frame

    return (
        first_frame(robot) if start is None else frame_from_text(robot, start),
        last_frame(robot) if end is None else frame_from_text(robot, end),
    )
