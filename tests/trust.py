"""Each figure that trust rests on, beside its goal: `make trust`, within half an hour.

`--cut` is the ten minutes of it that CI runs: shorter fuzzing, fewer mutants and hash seeds, no
other versions of sympy and numpy, and not what the test suite has already shown.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TESTS = ROOT / "tests"
FUZZED = (
    "expression",
    "table",
    "csv",
    "markdown",
    "axes",
    "answers",
    "urdf",
    "rotations",
)
_CLOSING = re.compile(r"(?:(\d+) failed, )?(\d+) passed")


@dataclass(frozen=True)
class Figure:
    """What was measured.

    Attributes
    ----------
    what, figure, goal : str
    met : bool
    said : str
        What the check printed, shown when the goal is not met.
    """

    what: str
    figure: str
    goal: str
    met: bool
    said: str = field(default="", repr=False)

    def __str__(self) -> str:
        return f"{self.what:44} {self.figure:34} {self.goal:30} {'met' if self.met else 'NOT MET'}"


def ran(*command: str | Path, env: dict[str, str] | None = None) -> tuple[int, str]:
    """Run one of our scripts; return its exit status and all that it printed."""
    done = subprocess.run(
        [sys.executable, *map(str, command)],
        cwd=ROOT,
        env={**os.environ, **(env or {})},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


def tested(what: str, goal: str, *files: str, env: dict[str, str] | None = None) -> Figure:
    """Run test files."""
    paths = [TESTS / f"test_{file}.py" for file in files]
    status, said = ran("-m", "pytest", "-q", "-n", "auto", *paths, env=env)
    closing = _CLOSING.search(said)
    failed, passed = (closing[1] or "0", closing[2]) if closing else ("?", "0")
    return Figure(what, f"{passed} passed, {failed} failed", goal, status == 0, said)


def fuzzed(target: str, seconds: int) -> Figure:
    """Fuzz one reader."""
    status, said = ran(TESTS / "fuzz.py", target, "--seconds", str(seconds))
    runs = re.search(r"number_of_executed_units: (\d+)", said)
    figure = f"{int(runs[1]):,} inputs in {seconds} s" if runs else "did not run"
    return Figure(f"fuzzing: {target}", figure, "no finding", status == 0, said)


def summed_up(what: str, goal: str, *command: str | Path) -> Figure:
    """Run a script whose last line is its figure."""
    status, said = ran(*command)
    return Figure(what, said.strip().splitlines()[-1][:34], goal, status == 0, said)


def checks(cut: bool) -> Iterator[list[Callable[[], Figure]]]:
    """Give the checks in groups that may run side by side."""
    seconds = 15 if cut else 60
    for pair in zip(FUZZED[::2], FUZZED[1::2], strict=True):
        yield [lambda target=target: fuzzed(target, seconds) for target in pair]  # type: ignore[misc]
    yield [
        lambda: tested(
            "struck at each open, write, fsync, rename",
            "whole files, no litter",
            "faults",
            env={"SYMDH_FAULT_STEP": "3" if cut else "1"},
        )
    ]
    yield [
        lambda: tested(
            "random tables against the oracle",
            "(4 + 2n) eps; 1e-40 exact",
            "random_tables",
            env={"SYMDH_RANDOM_TABLES": "100" if cut else "500"},
        )
    ]
    yield [
        lambda: tested("every token of generated functions", "every change killed", "token_mutants")
    ]
    if not cut:
        yield [lambda: tested("the bad inputs", "every outcome met", "bad_inputs")]
    repro = ["--quick", "--seeds", "2"] if cut else ["--seeds", "32"]
    yield [
        lambda: summed_up(
            "the same bytes everywhere", "no file differs", TESTS / "repro.py", *repro
        )
    ]
    count = "6" if cut else "60"
    yield [
        lambda: summed_up(
            "mutants of table, motion, kinematics, codegen",
            "at least 90 % killed",
            TESTS / "mutation.py",
            "--count",
            count,
        )
    ]


def main() -> int:
    """Run everything and print one line a figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cut", action="store_true", help="the ten minutes that CI runs")
    options = parser.parse_args()
    begun = time.monotonic()
    missed = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for group in checks(options.cut):
            for figure in pool.map(lambda check: check(), group):
                print(figure, flush=True)
                if not figure.met:
                    missed.append(figure)
    for figure in missed:
        print(f"\n--- {figure.what}\n{figure.said[-4000:]}")
    print(f"{len(missed)} not met, after {(time.monotonic() - begun) / 60:.0f} min")
    return min(len(missed), 1)


if __name__ == "__main__":
    sys.exit(main())
