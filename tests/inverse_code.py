"""Generated inverse kinematics, loaded: `NAME_ik` through gcc and ctypes, `ik` by import."""

from __future__ import annotations

import ctypes
import re
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from generated import STRICT_C, import_generated
from oracle import Arithmetic, Arm, read_arm_file
from sympy import Symbol

import symdh
from symdh.codegen import GeneratedFile, generate
from tools import require_tool

FLOATS = Arithmetic(float, lambda x: np.asarray(x, dtype=float), np.pi, np.cos, np.sin, float)


@dataclass(frozen=True)
class CInverse:
    """A generated `NAME_ik`; parameters without a value are bound already."""

    function: Any
    most: int
    n: int
    parameters: tuple[float, ...]
    is_single: bool = False

    def __call__(self, goal: Any, seed: Any = None) -> tuple[np.ndarray, list[int]]:
        """Answers (count, n), and their masks of free joints."""
        real = ctypes.c_float if self.is_single else ctypes.c_double
        kind, numbers = np.dtype(real), ctypes.POINTER(real)
        answers, masks = np.empty((self.most, self.n), kind), (ctypes.c_uint * self.most)()
        pose = np.ascontiguousarray(goal, dtype=kind)
        arguments: list[Any] = [pose.ctypes.data_as(numbers)]
        if self.parameters:
            arguments.append((real * len(self.parameters))(*self.parameters))
        start = None if seed is None else np.ascontiguousarray(seed, dtype=kind)
        arguments.append(None if start is None else start.ctypes.data_as(numbers))
        count = self.function(*arguments, answers.ctypes.data_as(numbers), masks)
        assert 0 <= count <= self.most
        return answers[:count].astype(float), list(masks)[:count]


@dataclass(frozen=True)
class Loaded:
    """A table's inverse kinematics in both languages, and what the oracle says of the table.

    Attributes
    ----------
    axes : list of int
        The coordinates that the header says are compared.
    with_orientation : bool
    values : dict of str to float
        Numbers for the parameters without a value.
    """

    arm: Arm
    c: CInverse
    python: ModuleType
    axes: list[int]
    with_orientation: bool
    values: Mapping[str, float]

    @property
    def turns(self) -> np.ndarray:
        return np.array([turning for _, turning in self.arm.variables])

    @property
    def reach(self) -> float:
        """The oracle's reach; a wrist has none, and its tolerance is that of a metre."""
        return self.arm.reach(self.values) or 1.0

    def pose(self, q: Any) -> np.ndarray:
        """The oracle's poses of joint values (count, n)."""
        joints = np.asarray(q, dtype=float)
        named = {name: joints[:, k] for k, (name, _) in enumerate(self.arm.variables)}
        named |= {name: np.full(len(joints), x) for name, x in self.values.items()}
        return np.asarray(self.arm.pose(named, arithmetic=FLOATS), dtype=float)

    def missed_by(self, answers: Any, goal: np.ndarray) -> float:
        """By how much answers miss a goal, as a part of the reach; 0 without answers."""
        if not len(answers):
            return 0.0
        off = abs(self.pose(answers) - goal)
        worst = max((off[:, axis, 3].max() / self.reach for axis in self.axes), default=0.0)
        return float(max(worst, off[:, :3, :3].max())) if self.with_orientation else float(worst)

    def apart(self, a: Any, b: Any) -> Any:
        """Largest difference of joint values, angles up to full turns."""
        difference = np.asarray(a) - np.asarray(b)
        turned = np.mod(difference + np.pi, 2 * np.pi) - np.pi
        return np.abs(np.where(self.turns, turned, difference)).max(axis=-1)


def load(
    table: Path, folder: Path, locked: Sequence[str] = (), flags: Sequence[str] = ()
) -> Loaded:
    """Generate both languages for a table, compile, import."""
    robot = symdh.load(table)
    held = tuple(Symbol(name, real=True) for name in locked)
    options: dict[str, object] = {"lock": held} if held else {}
    header, source = generate(robot, "c", **options)
    arm = read_arm_file(table)
    names = arm.parameters()
    drawn = np.random.default_rng(7).uniform(0.3, 1.2, len(names))
    values = dict(zip(names, map(float, drawn), strict=True))
    open_ones = [s.name for s in robot.parameters if s not in robot.values]
    n = len(robot.variables)
    c = compile_inverse(header, source, folder, n, [values[name] for name in open_ones], flags)
    compared = re.search(r"What is compared: (.*)\.", header.text)
    assert compared is not None
    words = compared[1]
    return Loaded(
        arm,
        c,
        import_generated(generate(robot, "python", **options), folder),
        [0, 1, 2] if "pose" in words else ["xyz".index(x) for x in re.findall(r"\b[xyz]\b", words)],
        any(word in words for word in ("orientation", "phi")),
        values,
    )


def compile_inverse(
    header: GeneratedFile,
    source: GeneratedFile,
    folder: Path,
    n: int,
    parameters: Sequence[float] = (),
    flags: Sequence[str] = (),
) -> CInverse:
    """Write the files into a folder, compile them strictly and load `NAME_ik`."""
    for file in (header, source):
        (folder / file.name).write_text(file.text, encoding="utf-8")
    stem = source.name.removesuffix(".c")
    library = folder / f"{stem}.so"
    command = [require_tool("gcc"), "-std=c99", "-O1", *STRICT_C, *flags, "-shared", "-fPIC"]
    built = subprocess.run(
        [*command, str(folder / source.name), "-o", str(library), "-lm"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stderr
    assert built.stderr == ""
    most = re.search(rf"#define {stem}_IK_MAX (\d+)", header.text)
    assert most is not None
    function = getattr(ctypes.CDLL(str(library)), f"{stem}_ik")
    return CInverse(function, int(most[1]), n, tuple(parameters), stem.endswith("_float"))
