"""Loading the code that symdh generates: Python by import, C through gcc and ctypes."""

from __future__ import annotations

import ctypes
import importlib.util
import itertools
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from symdh.codegen import GeneratedFile
from tools import require_tool

STRICT_C = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Wdouble-promotion",
    "-Werror",
]

_module_numbers = itertools.count()


def import_generated(files: Iterable[GeneratedFile], folder: Path) -> ModuleType:
    """Write the generated Python into `folder` and import it."""
    (file,) = files
    path = folder / file.name
    path.write_text(file.text, encoding="utf-8")
    return import_file(path)


def import_file(path: Path) -> ModuleType:
    """Import a module from its file, under a name that no other test uses."""
    spec = importlib.util.spec_from_file_location(f"generated_{next(_module_numbers)}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@dataclass(frozen=True)
class CFunction:
    """A generated `NAME_fk`, called through ctypes."""

    function: Any
    n: int

    def __call__(self, q: np.ndarray, parameters: Sequence[float] | None = None) -> np.ndarray:
        """Poses (..., 4, 4) for joint values (..., n); `parameters` where there is a struct."""
        flat = np.ascontiguousarray(q, dtype=np.float64).reshape(-1, self.n)
        poses = np.empty((len(flat), 16))
        between = [] if parameters is None else [(ctypes.c_double * len(parameters))(*parameters)]
        as_double = ctypes.POINTER(ctypes.c_double)
        for row, pose in zip(flat, poses, strict=True):
            self.function(row.ctypes.data_as(as_double), *between, pose.ctypes.data_as(as_double))
        return poses.reshape(*np.shape(q)[:-1], 4, 4)


def compile_generated(
    files: Iterable[GeneratedFile], folder: Path, *, n: int, flags: Sequence[str] = ()
) -> CFunction:
    """Write the generated C into `folder`, compile it strictly and load its function."""
    for file in files:
        (folder / file.name).write_text(file.text, encoding="utf-8")
    (source,) = folder.glob("*.c")
    return compile_file(source, n=n, flags=flags)


def compile_file(source: Path, *, n: int, flags: Sequence[str] = ()) -> CFunction:
    """Compile a generated C file strictly and load its function `NAME_fk` of `n` variables."""
    gcc = require_tool("gcc")
    library = source.with_suffix(".so")
    command = [gcc, "-std=c99", "-O2", *STRICT_C, *flags, "-shared", "-fPIC"]
    built = subprocess.run(
        [*command, str(source), "-o", str(library), "-lm"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stderr
    assert built.stderr == ""
    function = getattr(ctypes.CDLL(str(library)), f"{source.stem}_fk")
    function.restype = None
    return CFunction(function, n)
