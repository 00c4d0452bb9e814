"""What the checks of inverse kinematics share: the oracle's poses, hard poses, other solutions."""

from __future__ import annotations

import functools
import math
import time
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import yaml
from oracle import Arithmetic, Arm, read_arm_file
from sympy import Float, Symbol

import symdh
from symdh.kinematics.inverse.inverse import InverseKinematics, inverse_kinematics

DATA = Path(__file__).parent / "data"
TABLES = sorted((DATA / "tables").glob("*.yaml"))
INDEX = {entry["name"]: entry for entry in yaml.safe_load((DATA / "index.yaml").read_text())}
CLOSED = [path for path in TABLES if INDEX[path.stem]["expect"]["closed_form"]]
OPEN = [path for path in TABLES if not INDEX[path.stem]["expect"]["closed_form"]]

#: The joint that is held in the arms with seven, and what at.
LOCKS = {"franka_panda": "theta7", "kuka_iiwa7": "theta3", "sawyer": "theta3"}
HELD = 0.3

FLOATS = Arithmetic(float, lambda x: np.asarray(x, dtype=float), np.pi, np.cos, np.sin, float)

_STARTS = 400


def symbol(name: str) -> Symbol:
    return Symbol(name, real=True)


def locks_of(table: Path) -> list[Symbol]:
    return [symbol(LOCKS[table.stem])] if table.stem in LOCKS else []


@functools.cache
def derived(table: Path) -> tuple[InverseKinematics, float]:
    """The inverse kinematics of a table, and the CPU seconds that it took."""
    robot = symdh.load(table)
    begin = time.process_time()
    found = inverse_kinematics(robot, None, locks_of(table))
    return found, time.process_time() - begin


@functools.cache
def solver_of(table: Path) -> Any:
    return derived(table)[0].solver({v: Float(HELD) for v in locks_of(table)})


@functools.cache
def arm_of(table: Path) -> Arm:
    return read_arm_file(table)


def pose_of(
    arm: Arm,
    q: np.ndarray,
    first: str | int = "base",
    last: str | int = "tool",
    values: Mapping[str, float] = MappingProxyType({}),
) -> Any:
    """The oracle's poses of joint values (..., n), with values of open parameters."""
    named = {name: q[..., k] for k, (name, _) in enumerate(arm.variables)}
    named |= {name: np.full(q.shape[:-1], x) for name, x in values.items()}
    return np.asarray(arm.pose(named, first, last, arithmetic=FLOATS), dtype=float)


def held(table: Path, q: np.ndarray) -> np.ndarray:
    """Joint values with those of locked joints put in."""
    for k, (name, _) in enumerate(arm_of(table).variables):
        if name == LOCKS.get(table.stem):
            q[..., k] = HELD
    return q


def apart(arm: Arm, a: Any, b: Any) -> float:
    """Largest difference of joint values, angles up to full turns."""
    return max(
        abs(math.remainder(x - y, 2 * math.pi) if turns else x - y)
        for x, y, (_, turns) in zip(a, b, arm.variables, strict=True)
    )


def reach_of(arm: Arm) -> float:
    """The oracle's reach; a wrist has none, and its tolerance is that of a metre."""
    return arm.reach() or 1.0


def missed_by(arm: Arm, found: InverseKinematics, answers: Any, goal: np.ndarray) -> float:
    """By how much the oracle's poses of the answers miss what the task asks for."""
    if not answers:
        return 0.0
    error = abs(pose_of(arm, np.array([answer.q for answer in answers])) - goal)
    worst = max((error[:, axis, 3].max() for axis in found.task.axes), default=0.0)
    if found.task.with_orientation:
        worst = max(worst, reach_of(arm) * error[:, :3, :3].max())
    return float(worst)


# ---------------------------------------------------------------- poses that are hard


def hard_poses(
    table: Path,
    count: int,
    values: Mapping[str, float] = MappingProxyType({}),
    *,
    thorough: bool = False,
) -> Mapping[str, np.ndarray]:
    """Joint values at which equations degenerate, `count` of each kind that the arm has.

    Thorough: every joint at zero and near it, and not the third and the fifth alone. Parameters
    that are open in the table are among `values`.
    """
    arm = arm_of(table)
    rng = np.random.default_rng(9)
    turns = np.array([turning for _, turning in arm.variables])
    n = len(turns)
    quarters = rng.integers(-1, 3, (count, n)) * np.pi / 2
    sets = {"k 90 deg": np.where(turns, quarters, rng.uniform(-0.5, 0.5, (count, n)))}
    for joint in range(n) if thorough else (2, 4):
        for small in (0.0, 1e-7):
            if joint < n and (turns[joint] or thorough):
                q = arm.seeded_poses(count, seed=joint)
                q[:, joint] = small
                sets[f"joint {joint + 1} at {small:g}"] = q
    if n >= 5 and turns[2] and arm.n == n:
        far = partial(_farthest, arm, joint=2, frames=(1, 4), values=values)
        sets["straight"] = far(arm.seeded_poses(count, seed=31))
        sets["folded"] = far(arm.seeded_poses(count, seed=32), sign=-1)
    elif 2 <= n < 5 and turns[n - 1] and turns[1] and arm.n == n:
        # The whole arm's boundary: the last joint turned until the hand is far from the base.
        q = arm.seeded_poses(count, seed=31)
        sets["boundary"] = _farthest(arm, q, n - 1, ("base", "tool"), values)
    return {name: held(table, q) for name, q in sets.items()}


def _farthest(
    arm: Arm,
    q: np.ndarray,
    joint: int,
    frames: tuple[str | int, str | int],
    values: Mapping[str, float],
    sign: int = 1,
) -> np.ndarray:
    """Turn a joint until two frames are as far apart as can be, or as near with -1.

    A grid first, then golden section.
    """
    ratio = (math.sqrt(5) - 1) / 2

    def far(angle: np.ndarray) -> np.ndarray:
        q[:, joint] = angle
        return np.asarray(sign * (pose_of(arm, q, *frames, values)[:, :3, 3] ** 2).sum(axis=-1))

    grid = np.linspace(-np.pi, np.pi, 73)
    best = grid[np.argmax([far(np.full(len(q), angle)) for angle in grid], axis=0)]
    low, high = best - grid[1] + grid[0], best + grid[1] - grid[0]
    for _ in range(60):
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        keep = far(left) > far(right)
        low, high = np.where(keep, low, left), np.where(keep, right, high)
    q[:, joint] = (low + high) / 2
    return q


# ---------------------------------------------------------------- all solutions, another way


def newton_from_everywhere(
    arm: Arm,
    found: InverseKinematics,
    goal: np.ndarray,
    truth: np.ndarray,
    free: Sequence[int],
    seed: int = 5,
) -> list[np.ndarray]:
    """Damped least squares on the oracle's pose from 400 random starts, all at once."""
    rng = np.random.default_rng(seed)
    q = np.repeat(truth[None, :], _STARTS, axis=0)
    spread = np.array([np.pi if turns else 1.0 for _, turns in arm.variables])
    q[:, free] = rng.uniform(-1, 1, (_STARTS, len(free))) * spread[list(free)]
    rows = [(axis, 3) for axis in found.task.axes]
    if found.task.with_orientation:
        rows += [(r, c) for r in range(3) for c in range(3)]
    pick = tuple(np.array(rows).T)

    def residual(values: np.ndarray) -> np.ndarray:
        error = pose_of(arm, values) - goal
        return np.asarray(error[..., pick[0], pick[1]])

    damping = np.full(len(q), 1e-2)
    error = residual(q)
    for _ in range(80):
        slope = np.stack(
            [(residual(q + 1e-6 * np.eye(q.shape[1])[k]) - error) / 1e-6 for k in free], axis=-1
        )
        normal = np.einsum("sra,srb->sab", slope, slope)
        normal += damping[:, None, None] * np.eye(len(free))
        step = np.linalg.solve(normal, np.einsum("sra,sr->sa", slope, -error)[..., None])[..., 0]
        trial = q.copy()
        trial[:, free] += step
        new = residual(trial)
        better = (new**2).sum(axis=1) < (error**2).sum(axis=1)
        q[better], error[better] = trial[better], new[better]
        damping = np.where(better, damping / 4, damping * 4).clip(1e-14, 1e6)
    solutions: list[np.ndarray] = []
    for values, miss in zip(q, error, strict=True):
        new = all(apart(arm, values, other) > 1e-4 for other in solutions)
        if abs(miss).max() < 1e-8 and new:
            solutions.append(values)
    return solutions
