"""A table for other programs: text formats that keep it exact, and models that hold numbers.

Importing this package is cheap: sympy and jinja2 are loaded when something is written.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from symdh.errors import UnsupportedError

if TYPE_CHECKING:
    from symdh.render.interchange.exported import Exported
    from symdh.robot import Robot


@dataclass(frozen=True, slots=True)
class Interchange:
    """A format that a table can be written in.

    Attributes
    ----------
    name : str
        What a user asks for.
    description : str
        A few words of help.
    module, function : str
        Where in this package a robot is turned into an `Exported`.
    """

    name: str
    description: str
    module: str
    function: str

    def write(self, robot: Robot) -> Exported:
        """Write a table in this format (see `export`)."""
        module = import_module(f"{__name__}.{self.module}")
        exported: Exported = getattr(module, self.function)(robot)
        return exported


FORMATS = (
    Interchange("yaml", "the table as symdh reads it", "table", "table_yaml"),
    Interchange("json", "the same as JSON", "table", "table_json"),
    Interchange("csv", "the table for a spreadsheet", "rows", "table_csv"),
    Interchange("markdown", "the table to read and to print", "rows", "table_markdown"),
    Interchange("latex-table", "a table to \\input", "rows", "table_latex"),
    Interchange("urdf", "links and joints without shapes", "urdf", "urdf"),
    Interchange("rtb", "a DHRobot of the Robotics Toolbox for Python", "rtb", "rtb"),
    Interchange("matlab", "a rigidBodyTree of MATLAB", "matlab", "matlab"),
)


def export(robot: Robot, name: str) -> Exported:
    """Write a table in the format called `name`.

    Raises
    ------
    UnsupportedError
        When there is no such format, or it cannot hold this table.
    LimitError
        When an expression is too long for a table.
    """
    for form in FORMATS:
        if form.name == name:
            return form.write(robot)
    raise UnsupportedError(f"there is no format {name!r}: {', '.join(f.name for f in FORMATS)}")


__all__ = ["FORMATS", "Interchange", "export"]
