"""The languages that symdh writes. A new one is a module here, a folder of templates, a line below.

The module is named after the target and has ``generate(robot) -> tuple[GeneratedFile, ...]``. It
is imported when it is used, so that listing the targets costs nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symdh.robot import Robot


@dataclass(frozen=True, slots=True)
class GeneratedFile:
    """A file to write: its name, without a folder, and its whole text."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class Target:
    """A language to generate.

    Attributes
    ----------
    name : str
        What a user asks for; also the name of the module.
    description : str
        One line of help.
    extensions : tuple of str
        Of the files that it writes, in their order.
    """

    name: str
    description: str
    extensions: tuple[str, ...]

    def generate(self, robot: Robot) -> tuple[GeneratedFile, ...]:
        """Generate the files of this target for a robot (see `symdh.codegen.generate`)."""
        module = import_module(f"{__name__}.{self.name}")
        files: tuple[GeneratedFile, ...] = module.generate(robot)
        return files


TARGETS: tuple[Target, ...] = (
    Target("python", "one Python module that needs NumPy alone", (".py",)),
    Target("c", "a C99 header and source, also valid C++, that need <math.h> alone", (".h", ".c")),
)
