"""`make bench`: what symdh costs, as ratios measured in one run on the PUMA560.

Figures are CPU seconds, the least of several repeats: noise only ever adds. Ratios compare like
with like on this machine, at this moment; seconds alone would say more about the machine.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import bench_velocity
from sympy import Matrix, cos, eye, pi, simplify, sin, symbols
from sympy.core.cache import clear_cache

import symdh
from symdh.derivation.derive import derive

ROOT = Path(__file__).parent.parent
TABLE = ROOT / "examples" / "puma560.yaml"
SYMDH = str(Path(sysconfig.get_path("scripts")) / "symdh")


@dataclass(frozen=True)
class Comparison:
    """A cost in units of another one, and the goal for that ratio, if there is one."""

    what: str
    ours: float
    theirs: float
    goal: float | None = None
    more_is_better: bool = False

    @property
    def ratio(self) -> float:
        return self.theirs / self.ours if self.more_is_better else self.ours / self.theirs

    @property
    def is_met(self) -> bool:
        if self.goal is None:
            return True
        return self.ratio >= self.goal if self.more_is_better else self.ratio <= self.goal

    def __str__(self) -> str:
        goal = verdict = ""
        if self.goal is not None:
            goal = f"{'at least' if self.more_is_better else 'at most'} {self.goal:g}"
            verdict = "met" if self.is_met else "NOT MET"
        figures = f"{self.ours:9.4f} s {self.theirs:9.4f} s {self.ratio:8.2f}"
        return f"{self.what:58} {figures}  {goal:13} {verdict}".rstrip()


def plain_product() -> Matrix:
    """Pose of the PUMA560 as a newcomer computes it: 24 elementary matrices, multiplied."""
    t = symbols("theta1:7", real=True)
    d1, a2, d3, a3, d4 = symbols("d1 a2 d3 a3 d4", real=True)
    rows = (
        (t[0], d1, 0, pi / 2),
        (t[1], 0, a2, 0),
        (t[2], d3, a3, -pi / 2),
        (t[3], d4, 0, pi / 2),
        (t[4], 0, 0, -pi / 2),
        (t[5], 0, 0, 0),
    )
    product = eye(4)
    for theta, d, a, alpha in rows:
        ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
        product = product * Matrix([[ct, -st, 0, 0], [st, ct, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        product = product * Matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
        product = product * Matrix([[1, 0, 0, a], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        product = product * Matrix([[1, 0, 0, 0], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]])
    return product


def call_time(function: Callable[[], object], repeats: int) -> float:
    """Least CPU time of a call, with sympy's cache empty at each start."""
    times = []
    for _ in range(repeats):
        clear_cache()
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def process_time(command: Sequence[str]) -> float:
    """CPU time of one whole process, user and system."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit status {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def process_times(ours: Sequence[str], theirs: Sequence[str], repeats: int) -> tuple[float, float]:
    """Least CPU times of two commands, run by turns so that both meet the same machine."""
    pairs = [(process_time(ours), process_time(theirs)) for _ in range(repeats)]
    return min(ours for ours, _ in pairs), min(theirs for _, theirs in pairs)


def compare() -> list[Comparison]:
    robot = symdh.load(TABLE)
    derivation = call_time(lambda: symdh.forward_kinematics(robot), repeats=20)
    document = call_time(lambda: derive(robot), repeats=5)
    product = plain_product()
    simplified = call_time(lambda: simplify(product), repeats=2)
    python = [sys.executable, "-c"]
    show = process_times(
        [SYMDH, "show", str(TABLE)], [*python, "import sympy, jinja2, click, yaml"], repeats=15
    )
    usage = process_times([SYMDH, "--help"], [*python, "import click"], repeats=25)
    fewer = "simplify(plain product) against"
    return [
        Comparison(f"{fewer} forward kinematics", derivation, simplified, 100, more_is_better=True),
        Comparison(f"{fewer} the whole document", document, simplified, more_is_better=True),
        Comparison("symdh show against import sympy, jinja2, click, yaml", *show, goal=1.5),
        Comparison("symdh --help against import click", *usage, goal=2),
    ]


def main() -> int:
    print(f"{'PUMA560, CPU time':58} {'symdh':>11} {'other':>11} {'ratio':>8}  {'goal':13}")
    comparisons = compare()
    for comparison in comparisons:
        print(comparison)
    return max(0 if all(c.is_met for c in comparisons) else 1, bench_velocity.main())


if __name__ == "__main__":
    sys.exit(main())
