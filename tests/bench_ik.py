"""`make bench-ik`: generated inverse kinematics beside EAIK and IKFast, in one run.

C code compiled with -O2, all branches, each judged by forward kinematics; EAIK (a C++ library from
PyPI, with a batch of poses on one thread, so that its Python costs next to nothing) and IKFast's
C++ (see ikfast_rivals.py) answer the same poses without a judge. Rounds of all alternate, and the
least time of each counts: noise only ever adds. What is not installed and does not install is said
and left out. Derivation time is that of the search alone, in CPU seconds.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import ikfast_rivals
import numpy as np
from check_eaik import ask, python_with_eaik
from inverse_code import Loaded, load
from sympy import Symbol

import symdh
from symdh.codegen import generate
from symdh.kinematics.inverse.search import closed_form
from tools import require_tool

DATA = Path(__file__).parent / "data" / "tables"
ARMS = ("puma560", "ur5", "kuka_kr5", "abb_irb140", "staubli_tx40", "pieper_generic")
POSES, ROUNDS, TURNS = 1000, 20, 5
#: By how much entries of a pose may differ from those of the rival's own forward kinematics.
SAME_ARM = 1e-4

DRIVER = """
#include "{stem}.h"
#include <stdio.h>
#include <time.h>
static double read[{poses}][16 + {n}];
int main(int count_of_arguments, char **arguments)
{{
    FILE *file = count_of_arguments > 1 ? fopen(arguments[1], "rb") : 0;
    double answers[{stem}_IK_MAX][{n}], best = 1e9;
    long count = 0;
    if (!file || fread(read, sizeof read[0], {poses}, file) != {poses}) {{
        return 1;
    }}
    for (int round = 0; round < {rounds}; ++round) {{
        struct timespec begin, end;
        double seconds;
        clock_gettime(CLOCK_MONOTONIC, &begin);
        for (int k = 0; k < {poses}; ++k) {{
            count += {stem}_ik(read[k], {locked} ? read[k] + 16 : 0, answers, 0);
        }}
        clock_gettime(CLOCK_MONOTONIC, &end);
        seconds = (double)(end.tv_sec - begin.tv_sec);
        seconds += 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
        best = seconds / {poses} < best ? seconds / {poses} : best;
    }}
    printf("%.9g %ld", best, count / {rounds});
    return 0;
}}
"""


@dataclass(frozen=True)
class Measured:
    """Least seconds a pose, and answers a pose; infinite and zero where nothing was measured."""

    seconds: float = np.inf
    answers: float = 0.0

    def better(self, seconds: float, answers: float) -> Measured:
        return Measured(min(self.seconds, seconds), answers)

    def beside(self, ours: Measured) -> str:
        if not np.isfinite(self.seconds):
            return f"{'-':>8} {'-':>6} {'-':>8}"
        ratio = self.seconds / ours.seconds
        return f"{self.seconds * 1e6:8.2f} {ratio:6.1f} {self.answers:8.2f}"


def built(table: Path, folder: Path, n: int, lock: str) -> Path:
    """Compile the code of a table and a driver that times it."""
    options = {"lock": (Symbol(lock, real=True),)} if lock else {}
    header, source = generate(symdh.load(table), "c", **options)
    for file in (header, source):
        (folder / file.name).write_text(file.text, encoding="utf-8")
    stem = source.name.removesuffix(".c")
    text = DRIVER.format(stem=stem, n=n, poses=POSES, rounds=ROUNDS, locked=int(bool(lock)))
    (folder / "driver.c").write_text(text, encoding="utf-8")
    program = folder / "driver"
    subprocess.run(
        [
            *(require_tool("gcc"), "-std=gnu99", "-O2", "-w"),
            *("driver.c", source.name, "-o", str(program), "-lm"),
        ],
        cwd=folder,
        check=True,
    )
    return program


def derivation(table: Path, lock: str) -> float:
    """CPU seconds of the search."""
    robot = symdh.load(table)
    begin = time.process_time()
    closed_form(robot, None, [Symbol(lock, real=True)] if lock else [])
    return time.process_time() - begin


def size(table: Path, lock: str, target: str) -> float:
    """Characters of generated files, in thousands."""
    options = {"lock": (Symbol(lock, real=True),)} if lock else {}
    return sum(len(file.text) for file in generate(symdh.load(table), target, **options)) / 1000


def poses_of(arm: Loaded, file: Path) -> tuple[np.ndarray, np.ndarray]:
    """Random joint values and their poses, which are written to a file for the drivers."""
    q = arm.arm.seeded_poses(POSES, seed=1)
    poses = arm.pose(q)
    np.hstack([poses.reshape(POSES, 16), q]).astype(np.float64).tofile(file)
    return q, poses


def line(
    table: Path, rival: ikfast_rivals.Rival | None, origin: Path | None, python: str | None
) -> str:
    """Measure one arm."""
    lock = rival.lock if rival else ""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        arm = load(table, folder, [lock] if lock else [])
        q, poses = poses_of(arm, folder / "poses.bin")
        program = built(table, folder, q.shape[1], lock)
        other = None
        if rival is not None and origin is not None:
            other = ikfast_rivals.built(rival, folder, origin, q, ROUNDS)
        ours, ikfast, eaik = Measured(), Measured(), Measured()
        for _ in range(TURNS):
            seconds, count = _run(program, folder)[:2]
            ours = ours.better(seconds, count / POSES)
            if other is not None:
                seconds, count, off = _run(other, folder)
                if off > SAME_ARM:
                    raise AssertionError(f"{table.stem}: another geometry, off by {off:.1e}")
                ikfast = ikfast.better(seconds, count / POSES)
            if python is not None and not lock:
                found = ask(python, arm, poses, rounds=3)
                eaik = eaik.better(found["seconds"], sum(map(len, found["q"])) / POSES)
    files = f"{size(table, lock, 'c'):6.1f} {size(table, lock, 'python'):6.1f}"
    if other is not None and rival is not None and origin is not None:
        files += f" {len((origin / rival.source).read_text()) / 1000:7.1f} {rival.by}"
    return (
        f"{table.stem:14} {derivation(table, lock):6.2f} s {ours.seconds * 1e6:7.2f} "
        f"{ours.answers:7.2f} {eaik.beside(ours)} {ikfast.beside(ours)} {files}"
    )


def _run(program: Path, folder: Path) -> list[float]:
    text = subprocess.check_output([program, str(folder / "poses.bin")], text=True)
    return [float(word) for word in text.split()]


def main() -> int:
    """Print a line an arm; those with names are measured alone."""
    names = sys.argv[1:]
    python, origin = python_with_eaik(), ikfast_rivals.sources()
    print("IKBT is on no registry, so its derivation times are not measured beside ours")
    print("us a pose for all branches, ratios to ours, answers a pose before any judge but ours\n")
    print(
        f"{'arm':14} {'derived':>8} {'C us':>7} {'answers':>7} {'EAIK us':>8} {'ratio':>6} "
        f"{'answers':>8} {'IKFast':>8} {'ratio':>6} {'answers':>8} {'.c kB':>6} {'.py kB':>6} "
        f"{'.cpp kB':>7}"
    )
    for name in ARMS:
        if not names or name in names:
            print(line(DATA / f"{name}.yaml", None, origin, python), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for name, rival in ikfast_rivals.RIVALS.items():
            if not names or name in names:
                table = Path(folder) / f"{name}.yaml"
                table.write_text(rival.table, encoding="utf-8")
                print(line(table, rival, origin, python), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
