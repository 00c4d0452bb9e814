"""Inverse kinematics of every table of the corpus and of random arms, checked at length.

Not a test of the suite, for it takes many minutes:

    .venv/bin/python tests/check_inverse.py                  # everything, 1000 poses each
    .venv/bin/python tests/check_inverse.py --poses 100 puma560 ur5

For each table: the CPU time of the derivation, random poses whose joint values have to be found
again, the largest error of an answer by the oracle, the number of solutions against damped least
squares from hundreds of random starts, and goals out of reach (check_singular.py has the poses
where equations degenerate).
The random arms have spherical wrists, three parallel axes, or fewer joints. The status is 1 when
something is wrong.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
from inverse_checks import (
    CLOSED,
    LOCKS,
    apart,
    arm_of,
    derived,
    held,
    missed_by,
    newton_from_everywhere,
    pose_of,
    reach_of,
    solver_of,
)
from oracle import Arm, read_arm
from random_arms import parallel_arm, short_arm, wrist_arm

import symdh
from symdh.kinematics.inverse.inverse import Method, inverse_kinematics

#: An answer may miss the goal by so much of the reach; joint values are found again this near.
TOLERANCE = 1e-9
SAME = 1e-6
#: Seconds of CPU for a derivation, and for half of them.
SLOWEST, MEDIAN = 5.0, 0.2
#: Rounds of random starts until the other search has found as many solutions.
ROUNDS = 5


def main() -> int:
    """Check the tables that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", help="tables of the corpus; default: all, and arms")
    parser.add_argument("--poses", type=int, default=1000)
    parser.add_argument("--counted", type=int, default=3, help="poses whose solutions are counted")
    parser.add_argument("--arms", type=int, default=20, help="random arms of each kind")
    options = parser.parse_args()
    tables = [path for path in CLOSED if not options.names or path.stem in options.names]
    faults = [fault for table in tables for fault in checked(table, options.poses, options.counted)]
    seconds = sorted(derived(table)[1] for table in tables)
    if seconds:
        print(
            f"derivations: {seconds[len(seconds) // 2]:.2f} s median, {seconds[-1]:.2f} s slowest"
        )
    if len(tables) == len(CLOSED):
        if seconds[len(seconds) // 2] > MEDIAN:
            faults.append("half of the derivations take longer than they may")
        for family in (wrist_arm, parallel_arm, short_arm):
            faults += random_arms(family, options.arms)
    for fault in faults:
        print("WRONG:", fault)
    return 1 if faults else 0


def checked(table: Path, poses: int, counted: int) -> list[str]:
    """Check one table; return what is wrong."""
    found, seconds = derived(table)
    name = table.stem
    if found.method is not Method.CLOSED_FORM:
        return [f"{name}: {found.method.value}"]
    faults = [f"{name}: {seconds:.1f} s"] if seconds > SLOWEST else []
    again, worst, counts = _random_poses(table, poses)
    if again < poses or worst > TOLERANCE:
        faults.append(f"{name}: {again} of {poses} found again, error {worst:.1e}")
    alike = sum(_counted_alike(table, truth) for truth in _poses(table, counted, seed=77))
    if alike < counted:
        faults.append(f"{name}: another number of solutions at {counted - alike} of {counted}")
    if _far_away(table):
        faults.append(f"{name}: answers out of reach")
    numbers = ", ".join(f"{n}: {times}" for n, times in sorted(counts.items()))
    print(
        f"{name}: {seconds:.2f} s; {again}/{poses} found again, error {worst:.0e} of the reach; "
        f"solutions {{{numbers}}}, {alike}/{counted} as counted otherwise",
        flush=True,
    )
    return faults


def _poses(table: Path, count: int, seed: int) -> np.ndarray:
    return held(table, arm_of(table).seeded_poses(count, seed=seed))


def _random_poses(table: Path, poses: int) -> tuple[int, float, Counter[int]]:
    arm, found, solver = arm_of(table), derived(table)[0], solver_of(table)
    again, worst, counts = 0, 0.0, Counter[int]()
    q = _poses(table, poses, seed=1)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver.solve(goal.tolist())
        again += any(apart(arm, answer.q, truth) < SAME for answer in answers)
        worst = max(worst, missed_by(arm, found, answers, goal) / reach_of(arm))
        counts[len(answers)] += 1
    return again, worst, counts


def _counted_alike(table: Path, truth: np.ndarray) -> bool:
    """Say whether damped least squares from random starts ends at the same solutions."""
    arm, found = arm_of(table), derived(table)[0]
    goal = pose_of(arm, truth)
    answers = solver_of(table).solve(goal.tolist())
    free = [k for k, (name, _) in enumerate(arm.variables) if name != LOCKS.get(table.stem)]
    others: list[np.ndarray] = []
    for seed in range(ROUNDS):
        for other in newton_from_everywhere(arm, found, goal, truth, free, seed):
            if all(apart(arm, other, known) > 1e-4 for known in others):
                others.append(other)
        if len(others) >= len(answers):
            break
    matched = all(any(apart(arm, a.q, other) < 1e-4 for a in answers) for other in others)
    return matched and len(others) == len(answers)


def _far_away(table: Path) -> int:
    """Return how many goals far out of reach have answers; arms of slides reach everything."""
    arm = arm_of(table)
    if not all(turns for _, turns in arm.variables) or not derived(table)[0].task.axes:
        return 0
    answered = 0
    for goal in pose_of(arm, _poses(table, 20, seed=3)):
        goal[:3, 3] *= 20 * reach_of(arm) / max(np.linalg.norm(goal[:3, 3]), 1e-3)
        answered += bool(solver_of(table).solve(goal.tolist()))
    return answered


# ---------------------------------------------------------------- random arms


def random_arms(family: Callable[[int], str], count: int) -> list[str]:
    """Derive and try random arms; return what is wrong."""
    faults, methods, seconds = [], Counter[str](), 0.0
    seed = 0
    while sum(methods.values()) < count:
        text = family(seed)
        seed += 1
        arm = read_arm(text)
        if not _moves_freely(arm):
            continue
        begin = time.process_time()
        found = inverse_kinematics(symdh.loads(text))
        seconds = max(seconds, time.process_time() - begin)
        methods[found.method.name] += 1
        closed = found.method is Method.CLOSED_FORM
        solver = found.solver()
        q = arm.seeded_poses(20 if closed else 2, seed=seed)
        for truth, goal in zip(q, pose_of(arm, q), strict=True):
            answers = solver.solve(goal.tolist())
            again = any(apart(arm, answer.q, truth) < SAME for answer in answers)
            wrong = missed_by(arm, found, answers, goal) > TOLERANCE * reach_of(arm)
            if wrong or (closed and not again):
                faults.append(f"{family.__name__}({seed - 1}): pose {truth}")
    told = ", ".join(f"{name.lower()}: {times}" for name, times in sorted(methods.items()))
    print(f"{family.__name__}: {told}; slowest {seconds:.1f} s", flush=True)
    return faults


def _moves_freely(arm: Arm) -> bool:
    """Say whether no joint repeats what others do: the Jacobian has full rank."""
    q = arm.seeded_poses(1, seed=5)[0]
    pose = pose_of(arm, q)
    columns = [
        ((pose_of(arm, q + 1e-6 * unit) - pose) / 1e-6)[:3].ravel() for unit in np.eye(len(q))
    ]
    return bool(np.linalg.matrix_rank(np.array(columns), tol=1e-4) == len(q))


if __name__ == "__main__":
    sys.exit(main())
