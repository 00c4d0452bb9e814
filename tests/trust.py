"""Each figure that trust rests on, beside its goal: `make trust`, within half an hour.

`--cut` is the ten minutes of it that CI runs: few hash seeds, no other versions of sympy and numpy,
and not what the test suite has just shown. Coverage and mutants take longer by themselves: what the
last `make coverage` and `make mutants` found is read, and counts as long as no file has changed
since.
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
from functools import partial
from pathlib import Path

from sources import MUTATED, ROOT, sources

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
KILLED = 90
_CLOSING = re.compile(r"(?:(\d+) failed, )?(\d+) passed")


@dataclass(frozen=True)
class Figure:
    """What was measured.

    Attributes
    ----------
    what, figure, goal : str
    met : bool or None
        None where it was not measured here.
    said : str
        What the check printed, shown when the goal is not met.
    """

    what: str
    figure: str
    goal: str
    met: bool | None
    said: str = field(default="", repr=False)

    def __str__(self) -> str:
        verdict = {True: "met", False: "NOT MET", None: "not measured"}[self.met]
        return f"{self.what:44} {self.figure:44} {self.goal:32} {verdict}"


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


def tested(
    what: str, goal: str, *files: str, only: str = "", env: dict[str, str] | None = None
) -> Figure:
    """Run test files, of them the tests that `only` selects."""
    paths = [TESTS / f"test_{file}.py" for file in files]
    status, said = ran("-m", "pytest", "-q", "-n", "auto", "-k", only, *paths, env=env)
    closing = _CLOSING.search(said)
    failed, passed = (closing[1] or "0", closing[2]) if closing else ("?", "0")
    return Figure(what, f"{passed} passed, {failed} failed", goal, status == 0, said)


def fuzzed(target: str, seconds: int, *, anew: bool) -> Figure:
    """Fuzz one reader; `anew` with inputs that no run before has tried, else with the same."""
    seed, hashes = ("0", "random") if anew else ("1", "0")
    command = (TESTS / "fuzz.py", target, "--seconds", str(seconds), "--seed", seed)
    status, said = ran(*command, env={"PYTHONHASHSEED": hashes})
    runs = re.search(r"number_of_executed_units: (\d+)", said)
    figure = f"{int(runs[1]):,} inputs in {seconds} s" if runs else "did not run"
    return Figure(f"fuzzing: {target}", figure, "no finding", status == 0, said)


def summed_up(what: str, goal: str, *command: str | Path) -> Figure:
    """Run a script whose last line is its figure."""
    status, said = ran(*command)
    last = (said.strip().splitlines() or ["it said nothing"])[-1]
    return Figure(what, last.split("   ")[0][:44], goal, status == 0, said)


def is_current(result: Path) -> bool:
    """Say whether a result is there and younger than all that it is a result of."""
    if not result.is_file():
        return False
    made = result.stat().st_mtime
    return all(file.stat().st_mtime < made for file in sources())


def covered() -> Figure:
    """Read the branch coverage that the test suite was last seen to reach."""
    what, goal = "branches of symdh/ that the tests take", "100 %"
    if not is_current(ROOT / ".coverage"):
        return Figure(what, "no data: make coverage", goal, None)
    status, said = ran("-m", "coverage", "report", "--format=total", "--precision=2")
    part = said.split()[0]  # what follows is said below 100 %
    return Figure(what, f"{part} %", goal, status == 0 and float(part) == 100, said)


def mutated() -> Figure:
    """Read how many of 200 mutants the tests were last seen to kill."""
    what, goal = "mutants of the four layers", f"at least {KILLED} % killed"
    if not is_current(MUTATED):
        return Figure(what, "no data: make mutants", goal, None)
    told = MUTATED.read_text().strip()
    part = float(re.search(r"= ([\d.]+) %", told)[1])  # type: ignore[index]
    return Figure(what, told, goal, part >= KILLED)


Check = Callable[[], Figure]


def checks(cut: bool) -> Iterator[list[Check]]:
    """Give the checks in groups that may run side by side."""
    yield [covered, mutated]
    for pair in zip(FUZZED[::2], FUZZED[1::2], strict=True):
        # What CI tries is the same each time, so that a change is judged by what it changes.
        yield [partial(fuzzed, target, 60, anew=not cut) for target in pair]
    yield [partial(summed_up, "dependencies", "0 wrong", ROOT / "tools" / "audit.py")]
    yield [
        partial(
            tested,
            "struck at each open, write, fsync, rename",
            "whole files, no litter",
            "faults",
            env={"SYMDH_FAULT_STEP": "3" if cut else "1"},
        )
    ]
    yield [
        partial(
            tested,
            "random tables against the oracle",
            "(4 + 2n) eps; 1e-40 exact",
            "random_tables",
            env={"SYMDH_RANDOM_TABLES": "100" if cut else "500"},
        )
    ]
    seeds = ["--quick", "--seeds", "2"] if cut else ["--seeds", "32"]
    yield [partial(summed_up, "the same bytes", "0 places differ", TESTS / "repro.py", *seeds)]
    if not cut:
        yield from of_the_suite()


def of_the_suite() -> Iterator[list[Check]]:
    """Give the checks that are test files, and that CI has run with the others."""
    titles = "latex", "typst", "page", "pdf"
    yield [partial(tested, "the bad inputs", "every outcome met", "bad_inputs")]
    yield [partial(tested, "limits on what is read", "named; 1 s, 300 MiB", "limits")]
    yield [
        partial(
            tested, "hostile titles, Lua, shells", "print as text", *titles, only="title or lua"
        )
    ]
    yield [partial(tested, "templates of strangers", "stay in the sandbox", "templates")]
    yield [partial(tested, "files: links, foreign, full, killed", "whole or as before", "output")]
    yield [partial(tested, "every token of generated functions", "all killed", "token_mutants")]


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
                if figure.met is False:
                    missed.append(figure)
    for figure in missed:
        print(f"\n--- {figure.what}\n{figure.said[-4000:]}")
    print(f"{len(missed)} not met, after {(time.monotonic() - begun) / 60:.0f} min")
    return min(len(missed), 1)


if __name__ == "__main__":
    sys.exit(main())
