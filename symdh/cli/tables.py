"""From a command's arguments to the robot and its frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symdh.cli import console, patience

if TYPE_CHECKING:
    from symdh.derivation.blocks import Document
    from symdh.kinematics.frame import Frame
    from symdh.robot import Robot


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


def derived(robot: Robot, order: str, notation: str) -> Document:
    """Derive a robot's document; a person at the terminal is told when it takes long."""
    from symdh.derivation.derive import derive

    with patience.telling(f"deriving {robot.name}"):
        return derive(robot, order=order, naming=notation)


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
