"""The languages that symdh writes. A new one is a module here, a folder of templates, a line below.

The module is named after the target (``-`` reads ``_``) and has
``generate(robot, lock=(), ik=True) -> tuple[GeneratedFile, ...]``, with a keyword for each further
option of the target, and ``check_program`` for ``symdh code --verify`` (see
`symdh.codegen.verification`). It is imported when it is used, so that listing the targets costs
nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from symdh.errors import UnsupportedError

if TYPE_CHECKING:
    from symdh.robot import Robot


#: Options that every target takes.
_OF_EVERY_TARGET = ("lock", "ik")


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
        Of the files that it writes, in their order; some may have no use for the last.
    options : tuple of str
        Keywords that it takes besides those that every target takes, `lock` and `ik`.
    in_derive : bool
        Whether ``symdh derive`` writes it too.
    folder : str
        Where ``symdh code`` puts its files by default; ``{}`` stands for the name of the table.
    """

    name: str
    description: str
    extensions: tuple[str, ...]
    options: tuple[str, ...] = ()
    in_derive: bool = False
    folder: str = "."

    def takes(self, option: str) -> bool:
        """Say whether it has an option of this name."""
        return option in (*_OF_EVERY_TARGET, *self.options)

    def generate(self, robot: Robot, **options: object) -> tuple[GeneratedFile, ...]:
        """Generate the files of this target for a robot (see `symdh.codegen.generate`)."""
        for option in options:
            if not self.takes(option):
                raise UnsupportedError(f"the target {self.name} has no option {option!r}")
        module = import_module(f"{__name__}.{self.name.replace('-', '_')}")
        files: tuple[GeneratedFile, ...] = module.generate(robot, **options)
        return files


TARGETS: tuple[Target, ...] = (
    Target(
        "python",
        "one Python module that needs NumPy alone",
        (".py",),
        in_derive=True,
    ),
    Target(
        "c",
        "a C99 header and source, also valid C++, that need <math.h> alone",
        (".h", ".c"),
        options=("trig", "precision", "batch"),
        in_derive=True,
    ),
    Target(
        "cpp",
        "a C++17 header on Eigen, templated on the scalar",
        (".hpp",),
    ),
    Target(
        "matlab",
        "function files for MATLAB and Octave",
        ("_fk.m", "_jacobian.m", "_fk_jacobian.m", "_ik.m"),
    ),
    Target("julia", "a Julia module without dependencies", (".jl",)),
    Target(
        "rust",
        "a Rust module that is no_std and needs no crate",
        (".rs",),
    ),
    Target(
        "javascript",
        "an ES module with its TypeScript types",
        (".mjs", ".d.mts"),
    ),
    Target(
        "python-ext",
        "a Python extension around the C, which pip installs",
        (".h", ".c", "_ext.c", "setup.py", "pyproject.toml"),
        folder="{}_ext",
    ),
)
