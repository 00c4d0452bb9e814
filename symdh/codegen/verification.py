"""Generated code against the exact pose: it is compiled or run on random joint values.

The exact pose shares nothing with the code: it is a plain product of the table's elementary 4x4
matrices at 50 digits.

A target takes part when its module has
``check_program(robot, files, poses) -> CheckProgram``.
"""

from __future__ import annotations

import math
import random
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import mpmath
from sympy import Expr, Rational, Symbol

from symdh.codegen.precision import DOUBLE, FLOAT, single
from symdh.codegen.targets import GeneratedFile
from symdh.errors import LimitError, OutputError, UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.robot import JointType, MotionKind, Robot

_DIGITS = 50
_TIME_LIMIT = 120.0


@dataclass(frozen=True, slots=True)
class Poses:
    """Joint values and parameters to run code with.

    Attributes
    ----------
    joints : tuple of tuple of float
        A row of joint variables for each pose.
    parameters : mapping of Symbol to float
        A number for each parameter that the table leaves open.
    """

    joints: tuple[tuple[float, ...], ...]
    parameters: Mapping[Symbol, float]

    @property
    def rows(self) -> list[list[str]]:
        """The joint values as literals that every language reads."""
        return [[repr(x) for x in row] for row in self.joints]


@dataclass(frozen=True, slots=True)
class CheckProgram:
    """How to run generated code: files beside it, and commands in their folder.

    Attributes
    ----------
    files : tuple of GeneratedFile
    commands : tuple of tuple of str
        Run one after the other. The last prints a line for each pose: the 16 entries, row by row,
        between spaces.
    """

    files: tuple[GeneratedFile, ...]
    commands: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class Verification:
    """What came out.

    Attributes
    ----------
    poses : int
        How many were compared.
    error : float
        Largest error of any entry, in eps of reach: units of eps times the sum of all lengths.
    tolerance : float
        What the sums and products of a chain of so many joints excuse, in the same unit.
    """

    poses: int
    error: float
    tolerance: float

    @property
    def is_right(self) -> bool:
        """Whether the error stays within the tolerance; NaN does not."""
        return self.error <= self.tolerance


def verify(
    robot: Robot,
    target: str,
    files: Sequence[GeneratedFile],
    *,
    count: int = 100,
    is_single: bool = False,
) -> Verification:
    """Run generated code on random poses and compare with the exact result.

    Parameters
    ----------
    robot : Robot
    target : str
        Name of the target that made the files.
    files : sequence of GeneratedFile
    count : int
        Number of poses; the same ones each time.
    is_single : bool
        Whether the code computes in single precision.

    Raises
    ------
    UnsupportedError
        When symdh has no way to run this target.
    OutputError
        When the compiler or interpreter is not installed, or refuses the code.
    LimitError
        When it does not come to an end.
    """
    module = import_module(f"symdh.codegen.targets.{target.replace('-', '_')}")
    if not hasattr(module, "check_program"):
        raise UnsupportedError(f"symdh cannot run {target} code to verify it")
    poses = random_poses(robot, count, is_single=is_single)
    program: CheckProgram = module.check_program(robot, files, poses)
    found = _run(program, files, len(poses.joints))
    epsilon = (FLOAT if is_single else DOUBLE).epsilon
    exact = _ExactChain(robot, poses.parameters)
    errors = [
        exact.error(joints, pose) / epsilon
        for joints, pose in zip(poses.joints, found, strict=True)
    ]
    # max() alone would pass over a NaN.
    worst = math.nan if any(map(math.isnan, errors)) else max(errors)
    return Verification(len(errors), worst, 4.0 + 2.0 * robot.n)


def find_program(*names: str) -> str:
    """Return the path of the first program that is installed.

    Raises
    ------
    OutputError
        When none is.
    """
    for name in names:
        path = shutil.which(name)
        if path is not None:
            return path
    raise OutputError(f"cannot verify: {' or '.join(names)} is not installed")


def random_poses(robot: Robot, count: int, *, is_single: bool = False) -> Poses:
    """Draw joint values within the limits, else within half a turn or a unit of length."""
    generator = random.Random(560)
    ranges = []
    for joint in robot.joints:
        if joint.variable is not None:
            limits = robot.limits.get(joint.variable)
            half = 3.14159 if joint.type is JointType.REVOLUTE else 1.0
            ranges.append((float(limits.lower), float(limits.upper)) if limits else (-half, half))
    rounded = single if is_single else float
    joints = tuple(
        tuple(rounded(generator.uniform(*each)) for each in ranges) for _ in range(count)
    )
    open_ones = [p for p in robot.parameters if p not in robot.values]
    return Poses(joints, {p: 0.25 + 0.125 * k for k, p in enumerate(open_ones)})


def _run(program: CheckProgram, files: Sequence[GeneratedFile], count: int) -> list[list[float]]:
    with tempfile.TemporaryDirectory(prefix="symdh-") as name:
        folder = Path(name)
        for file in (*files, *program.files):
            path = folder / file.name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
        printed = ""
        for command in program.commands:
            printed = _output(command, folder)
    rows = [[float(word) for word in line.split()] for line in printed.splitlines() if line.strip()]
    if len(rows) != count or any(len(row) != 16 for row in rows):
        raise OutputError("cannot verify: the code did not print its poses")
    return rows


def _output(command: Sequence[str], folder: Path) -> str:
    program = Path(command[0]).name
    try:
        done = subprocess.run(
            command, cwd=folder, capture_output=True, text=True, timeout=_TIME_LIMIT, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise LimitError(f"cannot verify: {program} ran for {_TIME_LIMIT:.0f} s") from error
    except OSError as error:
        raise OutputError(f"cannot verify: {program}: {error.strerror}") from error
    if done.returncode != 0:
        reason = done.stderr.strip().splitlines()[:5]
        raise OutputError("\n".join([f"cannot verify: {program} failed", *reason]))
    return done.stdout


class _ExactChain:
    """The pose of a robot at 50 digits, motion by motion."""

    def __init__(self, robot: Robot, parameters: Mapping[Symbol, float]) -> None:
        values: dict[Symbol, Expr] = {
            symbol: _exact(number) for symbol, number in parameters.items()
        }
        values |= {p: robot.values[p] for p in robot.parameters if p in robot.values}
        self._variables = robot.variables
        self._mp = mpmath.mp.clone()
        self._mp.dps = _DIGITS
        self._motions = [
            (motion.kind, int(motion.axis), self._line(motion.amount.xreplace(values)))
            for motion in chain_word(robot, "base", "tool")
        ]

    def error(self, joints: Sequence[float], pose: Sequence[float]) -> float:
        """Return the largest error of an entry as a part of the reach; NaN of a NaN."""
        mp = self._mp
        at = {v: mp.mpf(x) for v, x in zip(self._variables, joints, strict=True)}
        exact, reach = mp.eye(4), mp.mpf(0)
        for kind, axis, (constant, slopes) in self._motions:
            amount = constant + sum(slope * at[variable] for variable, slope in slopes)
            if kind is MotionKind.TRANSLATION:
                reach += abs(amount)
            exact = exact * self._elementary(kind, axis, amount)
        if not all(map(math.isfinite, pose)):
            return float("nan")
        largest = max(abs(exact[k // 4, k % 4] - mp.mpf(x)) for k, x in enumerate(pose))
        return float(largest / max(1, reach))

    def _line(self, amount: Expr) -> tuple[Any, tuple[tuple[Symbol, Any], ...]]:
        """Write an amount as a constant and a slope for each variable."""
        slopes = []
        for variable in self._variables:
            if amount.has(variable):
                slopes.append((variable, self._number(amount.diff(variable))))
                amount = amount.xreplace({variable: _exact(0.0)})
        return self._number(amount), tuple(slopes)

    def _number(self, value: Expr) -> Any:
        number = value.evalf(_DIGITS)
        if not number.is_Float and not number.is_Integer:
            raise UnsupportedError(f"{value} has no value to verify with")
        return self._mp.mpf(str(number))

    def _elementary(self, kind: MotionKind, axis: int, amount: Any) -> Any:
        matrix = self._mp.eye(4)
        if kind is MotionKind.TRANSLATION:
            matrix[axis, 3] = amount
            return matrix
        i, j = (axis + 1) % 3, (axis + 2) % 3
        cosine, sine = self._mp.cos(amount), self._mp.sin(amount)
        matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = cosine, -sine, sine, cosine
        return matrix


def _exact(number: float) -> Expr:
    numerator, denominator = number.as_integer_ratio()
    return Rational(numerator, denominator)
