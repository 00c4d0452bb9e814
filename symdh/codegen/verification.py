"""Generated code against the exact pose: it is compiled or run on random joint values.

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
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path

from sympy import Symbol

from symdh.codegen.exact import ExactChain
from symdh.codegen.inverse.judging import InverseVerification, judged
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.program import Program
from symdh.codegen.precision import DOUBLE, FLOAT, single
from symdh.codegen.targets import GeneratedFile
from symdh.errors import LimitError, OutputError
from symdh.robot import JointType, Robot

_TIME_LIMIT = 120.0
#: What a line with answers begins with.
_ANSWERS = "ik"


@dataclass(frozen=True, slots=True)
class Poses:
    """Joint values and parameters to run code with.

    Attributes
    ----------
    joints : tuple of tuple of float
        A row of joint variables for each pose.
    parameters : mapping of Symbol to float
        A number for each parameter that the table leaves open.
    inverse : Program or None
        The inverse kinematics that the code has, if it has any. The program then prints behind
        each pose a line of the word ``ik`` and the joint values of all answers to it in a row,
        those that made the pose being the seed.
    """

    joints: tuple[tuple[float, ...], ...]
    parameters: Mapping[Symbol, float]
    inverse: Program | None = None

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
    inverse : InverseVerification or None
        What came out of the inverse kinematics.
    """

    poses: int
    error: float
    tolerance: float
    inverse: InverseVerification | None = None

    @property
    def is_right(self) -> bool:
        """Whether the error stays within the tolerance; NaN does not."""
        return self.error <= self.tolerance and (self.inverse is None or self.inverse.is_right)


def verify(
    robot: Robot,
    target: str,
    files: Sequence[GeneratedFile],
    *,
    count: int = 100,
    is_single: bool = False,
    lock: tuple[Symbol, ...] = (),
    ik: bool = True,
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
    lock, ik
        As they were given to the target.

    Raises
    ------
    OutputError
        When the compiler or interpreter is not installed, or refuses the code.
    LimitError
        When it does not come to an end.
    """
    module = import_module(f"symdh.codegen.targets.{target.replace('-', '_')}")
    plan = _inverse(robot, lock) if ik else None
    poses = replace(random_poses(robot, count, is_single=is_single), inverse=plan)
    program: CheckProgram = module.check_program(robot, files, poses)
    found, answers = _run(program, files, poses)
    epsilon = (FLOAT if is_single else DOUBLE).epsilon
    exact = ExactChain(robot, poses.parameters)
    errors = [
        exact.error(joints, pose) / epsilon
        for joints, pose in zip(poses.joints, found, strict=True)
    ]
    # max() alone would pass over a NaN.
    worst = math.nan if any(map(math.isnan, errors)) else max(errors)
    inverse = None
    if plan is not None:
        inverse = judged(plan, exact, poses.joints, answers, is_single=is_single)
    return Verification(len(errors), worst, 4.0 + 2.0 * robot.n, inverse)


def _inverse(robot: Robot, lock: tuple[Symbol, ...]) -> Program | None:
    """Return the inverse kinematics that the code has."""
    plan = inverse_program(robot, None, lock)
    return plan if isinstance(plan, Program) else None


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


def _run(
    program: CheckProgram, files: Sequence[GeneratedFile], poses: Poses
) -> tuple[list[list[float]], list[list[float]]]:
    """Return the poses that the code printed, and the answers to each in a row."""
    with tempfile.TemporaryDirectory(prefix="symdh-") as name:
        folder = Path(name)
        for file in (*files, *program.files):
            path = folder / file.name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
        printed = ""
        for command in program.commands:
            printed = _output(command, folder)
    lines = [line.split() for line in printed.splitlines() if line.strip()]
    rows = [_numbers(words) for words in lines if words[0] != _ANSWERS]
    answers = [_numbers(words[1:]) for words in lines if words[0] == _ANSWERS]
    count, n = len(poses.joints), len(poses.joints[0])
    if len(rows) != count or any(len(row) != 16 for row in rows):
        raise OutputError("cannot verify: the code did not print its poses")
    if len(answers) != count * (poses.inverse is not None) or any(len(row) % n for row in answers):
        raise OutputError("cannot verify: the code did not print its answers")
    return rows, answers


def _numbers(words: Sequence[str]) -> list[float]:
    return [float(word) for word in words]


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
