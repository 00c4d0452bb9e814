"""`make bench-ik`: generated inverse kinematics beside EAIK, in one run.

C code compiled with -O2, all branches, judged by forward kinematics, against EAIK (a C++ library,
from PyPI), which neither judges nor leaves out what misses; EAIK is called with many poses at once
on one thread, so that its Python costs next to nothing. Rounds of both alternate, and the least
time of each counts: noise only ever adds. Derivation time is that of the search alone.

IKFast's generator is on no registry that the tests reach, so its code is not among the rivals.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from check_eaik import ask, python_with_eaik
from inverse_code import load

import symdh
from symdh.codegen import generate
from symdh.kinematics.inverse.search import closed_form
from tools import require_tool

DATA = Path(__file__).parent / "data" / "tables"
ARMS = ("puma560", "ur5", "kuka_kr5", "abb_irb140", "staubli_tx40", "pieper_generic")
POSES, ROUNDS, TURNS = 1000, 20, 5

DRIVER = """
#include "{stem}.h"
#include <stdio.h>
#include <time.h>
static const double q[{poses}][{n}] = {{{values}}};
static double T[{poses}][16];
int main(void)
{{
    double answers[{stem}_IK_MAX][{n}], best = 1e9;
    long count = 0;
    for (int k = 0; k < {poses}; ++k) {{
        {stem}_fk(q[k], T[k]);
    }}
    for (int round = 0; round < {rounds}; ++round) {{
        struct timespec begin, end;
        double seconds;
        clock_gettime(CLOCK_MONOTONIC, &begin);
        for (int k = 0; k < {poses}; ++k) {{
            count += {stem}_ik(T[k], 0, answers, 0);
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


def built(table: Path, folder: Path, q: np.ndarray) -> Path:
    """Compile the code of a table and a driver that times it."""
    header, source = generate(symdh.load(table), "c")
    for file in (header, source):
        (folder / file.name).write_text(file.text, encoding="utf-8")
    values = ", ".join("{" + ", ".join(map(repr, map(float, row))) + "}" for row in q)
    stem = source.name.removesuffix(".c")
    text = DRIVER.format(stem=stem, n=q.shape[1], poses=len(q), values=values, rounds=ROUNDS)
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


def main() -> int:
    """Print a line an arm."""
    python = python_with_eaik()
    print(
        f"{'arm':16} {'derived':>9} {'C us':>7} {'EAIK us':>8} {'ratio':>6} {'answers':>8} "
        f"{'.c kB':>6} {'.py kB':>6}"
    )
    for name in ARMS:
        table = DATA / f"{name}.yaml"
        robot = symdh.load(table)
        begin = time.process_time()
        closed_form(robot)
        derived = time.process_time() - begin
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            arm = load(table, folder)
            q = arm.arm.seeded_poses(POSES, seed=1)
            program = built(table, folder, q)
            ours, theirs, answers = np.inf, np.inf, 0.0
            for _ in range(TURNS):
                seconds, count = subprocess.check_output([program], text=True).split()
                ours, answers = min(ours, float(seconds)), int(count) / POSES
                if python is not None:
                    theirs = min(theirs, ask(python, arm, arm.pose(q), rounds=3)["seconds"])
            sizes = [
                sum(len(file.text) for file in generate(robot, target)) / 1000
                for target in ("c", "python")
            ]
        beside = f"{theirs * 1e6:8.2f} {theirs / ours:6.1f}" if python else f"{'-':>8} {'-':>6}"
        print(
            f"{name:16} {derived:7.2f} s {ours * 1e6:7.2f} {beside} {answers:8.2f} "
            f"{sizes[0]:6.1f} {sizes[1]:6.1f}"
        )
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
