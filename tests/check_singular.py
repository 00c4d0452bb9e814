"""Singular poses of every table with a closed form: solver, generated Python and generated C.

Not a test of the suite, for it takes many minutes:

    .venv/bin/python tests/check_singular.py                   # all tables, 100 poses a set
    .venv/bin/python tests/check_singular.py --poses 30 puma560 ur5 arms/mine.yaml

The sets are those of `inverse_checks.hard_poses`: every joint at zero and 1e-7 beside it, the elbow
straight and folded, all joints at multiples of 90 degrees; goals out of reach must have no answer.
A valid answer misses the goal by less than 1e-9 of the reach, by the oracle. Of each set at least
99 of 100 poses must have one and none may have a false one. The status is 1 when a set falls short.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing import Pool
from pathlib import Path
from typing import Any

import numpy as np
from inverse_checks import CLOSED, HELD, LOCKS, arm_of, derived, hard_poses, held, locks_of
from inverse_code import Loaded, load
from sympy import Float

import symdh

#: The part of a set that has to have an answer, and by how much an answer may miss its goal.
ANSWERED, TOLERANCE = 0.99, 1e-9

Inverse = Callable[[np.ndarray], Any]


@dataclass(frozen=True)
class Tally:
    """What came of one set of one arm with one implementation."""

    table: str
    means: str
    kind: str
    poses: int
    answered: int
    false: int

    @property
    def is_good(self) -> bool:
        """Whether enough poses have an answer and none a false one; out of reach none has any."""
        if self.kind == "out of reach":
            return self.answered == 0
        return self.answered >= ANSWERED * self.poses and not self.false


def implementations(table: Path, folder: Path) -> tuple[Loaded, dict[str, Inverse]]:
    """The three ways to solve for a goal, locked joints held."""
    lock = [LOCKS[table.stem]] if table.stem in LOCKS else []
    arm = load(table, folder, lock)
    robot = symdh.load(table)
    values = {s: Float(arm.values[s.name], 17) for s in robot.parameters if s.name in arm.values}
    values |= {variable: Float(HELD) for variable in locks_of(table)}
    solver = derived(table)[0].solver(values)
    seed = held(table, np.zeros(len(arm.turns))) if lock else None
    return arm, {
        "solver": lambda goal: [answer.q for answer in solver.solve(goal.tolist())],
        "python": lambda goal: arm.python.ik(goal, seed=seed, **arm.values),
        "c": lambda goal: arm.c(goal, seed)[0],
    }


def sets_of(table: Path, arm: Loaded, count: int) -> Iterator[tuple[str, np.ndarray]]:
    """Goals by the kind of the set; those out of reach last."""
    for kind, q in hard_poses(table, count, arm.values, thorough=True).items():
        yield kind, arm.pose(q)
    if arm.turns.all() and arm.axes:
        goals = arm.pose(held(table, arm_of(table).seeded_poses(count, seed=3)))
        for goal in goals:
            goal[:3, 3] *= 20 * arm.reach / max(np.linalg.norm(goal[:3, 3]), 1e-3)
        yield "out of reach", goals


def checked(asked: tuple[Path, int]) -> list[Tally]:
    """Try one table."""
    table, count = asked
    found = []
    with tempfile.TemporaryDirectory() as folder:
        arm, means = implementations(table, Path(folder))
        for kind, goals in sets_of(table, arm, count):
            for name, inverse in means.items():
                answers = [inverse(goal) for goal in goals]
                pairs = zip(answers, goals, strict=True)
                missed = [arm.missed_by(qs, goal) > TOLERANCE for qs, goal in pairs]
                answered = sum(len(qs) > 0 for qs in answers)
                found.append(Tally(table.stem, name, kind, count, answered, sum(missed)))
    return found


def main() -> int:
    """Print a line a table, and one for every set that falls short."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", help="tables of the corpus, or files; default: all")
    parser.add_argument("--poses", type=int, default=100, help="poses a set")
    parser.add_argument("-j", type=int, default=1, help="tables at a time")
    options = parser.parse_args()
    for name in {*options.names} - {table.stem for table in CLOSED}:
        if not Path(name).is_file():
            parser.error(f"{name} is no file, and no table with a closed form")
    tables = [t for t in CLOSED if not options.names or t.stem in options.names]
    tables += [Path(name) for name in options.names if name.endswith(".yaml")]
    asked = [(table, options.poses) for table in tables]
    bad = total = 0
    with Pool(options.j) as pool:
        for tallies in pool.imap(checked, asked):
            least = {}
            for name in ("solver", "python", "c"):
                sets = [t for t in tallies if t.means == name and t.kind != "out of reach"]
                worst = min(sets, key=lambda t: t.answered)
                least[name] = f"{name} {worst.answered}/{worst.poses} ({worst.kind})"
            print(
                f"{tallies[0].table}: {len(tallies) // 3} sets; least: {', '.join(least.values())}",
                flush=True,
            )
            for tally in tallies:
                total += 1
                if not tally.is_good:
                    bad += 1
                    print(
                        f"  WRONG: {tally.means}, {tally.kind}: {tally.answered} of {tally.poses} "
                        f"answered, {tally.false} with false answers",
                        flush=True,
                    )
    print(f"{total - bad} of {total} sets have answers at {ANSWERED:.0%} of their poses or more")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
