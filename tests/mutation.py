"""Change the package at random places and see whether the tests notice: `make mutants`.

Draws places in table, motion, kinematics and codegen with a fixed seed, makes one small change at
each (an operator, a comparison, a number, a condition, a result), and runs the tests that reach
the changed line on a copy of the tree until one fails: first those that reach little else, then
the others and their neighbours, the quick ones first, up to some minutes. Which they are is
measured first, with coverage, and kept in `.mutation` until a file changes that they depend on.
What killed a mutant is kept there too, and runs before the others next time. Prints each survivor,
to be read, the part that was killed, and its 95 % interval.

Why not mutmut or cosmic-ray: mutmut 3.8 changes no code outside functions and in few with a
decorator, and takes no sample; cosmic-ray 8.7 runs one command for all mutants, here the whole
suite, twenty minutes each. What is left to write without them is short.
"""

from __future__ import annotations

import argparse
import ast
import hashlib
import json
import math
import os
import resource
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from itertools import islice
from multiprocessing import get_context
from pathlib import Path

import hypothesis.strategies  # noqa: F401  # loaded once for all mutants, as sympy and numpy
import numpy.testing  # noqa: F401
import pytest
import sympy  # noqa: F401
from coverage.numbits import numbits_to_nums
from mutants import Mutant, Place, mutant, places
from sources import MUTATED, MUTATION, ROOT, sources

GOAL = 90
LAYERS = ("table", "motion", "kinematics", "codegen")
#: The tests of these layers. What runs TeX or a browser is left out.
FILES = (
    "expression",
    "table",
    "motion",
    "tabular",
    "keys",
    "amounts",
    "kinematics",
    "rotation",
    "urdf",
    "answer",
    "singularity",
    "velocity",
    "task",
    "codegen",
    "codegen_jacobian",
    "codegen_python",
    "lectures",
    "frames",
    "bad_inputs",
    "convert",
    "codegen_trig",
    "golden",
    "inverse",
    "codegen_inverse",
    "random_tables",
    "token_mutants",
    "verification",
    "interface",
    "inverse_document",
    "targets",
    "codegen_inverse_native",
    "codegen_inverse_script",
)
#: Those that measure time are left out: a busy machine would kill mutants.
PYTEST = ("-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-m", "not undisturbed")
#: What killed each mutant, a file each; the test that a run has begun last, in its tree.
KILLERS = "killers"
BEGUN = "begun"
#: Seconds of tests, as measured: at first those that reach little else, then all that fit. Of a
#: test with many parameters some are tried, so that it takes no longer than `EACH`.
FIRST, ALL, EACH = 20.0, 400.0, 4.0
RULES = """\
[run]
dynamic_context = test_function
source = {source}
"""


class Reached:
    """Which test functions reach which lines, and how long each takes.

    Tests are named ``test_file.test_function``; a parametrized one is one test.

    Attributes
    ----------
    seconds : Counter of str
        How long each test takes with the parameters that are tried.
    every : dict of str to int
        Each how many-th of its parameters is tried.
    lines : dict of str to dict of int to set of str
        The tests that reach each line of each module.
    breadth : Counter of str
        How many modules each test reaches.
    """

    def __init__(self, folder: Path) -> None:
        self.seconds: Counter[str] = Counter()
        self.every: dict[str, int] = {}
        self.lines: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
        self.breadth: Counter[str] = Counter()
        cases: Counter[str] = Counter()
        for report in sorted(folder.glob("*.xml")):
            for case in ET.parse(report).iter("testcase"):
                module = case.attrib["classname"].rsplit(".", 1)[-1]
                test = f"{module}.{case.attrib['name'].split('[', 1)[0]}"
                self.seconds[test] += float(case.attrib["time"])
                cases[test] += 1
        for test, seconds in self.seconds.items():
            self.every[test] = min(math.ceil(seconds / EACH) or 1, cases[test])
            self.seconds[test] = seconds / self.every[test]
        for data in sorted(folder.glob("*.coverage")):
            self._read(data)

    def _read(self, data: Path) -> None:
        with sqlite3.connect(data) as base:
            rows = base.execute(
                "select file.path, context.context, line_bits.numbits from line_bits"
                " join file on file.id = line_bits.file_id"
                " join context on context.id = line_bits.context_id"
            )
            for path, test, bits in rows:
                if test not in self.seconds:  # while modules were imported
                    continue
                self.breadth[test] += 1
                lines = self.lines[path[path.rindex("symdh/") :]]
                for line in numbits_to_nums(bits):
                    lines[line].add(test)

    def tests(self, module: Path, first: int, last: int) -> tuple[list[str], list[str]]:
        """Return the tests that reach some lines and those that may see what the lines did.

        The former begin with those that reach few modules. Lines that run only while the module
        is imported, or for all tests at once, are reached by every test that enters the module.
        The latter, the quick ones first, are the others of the same files, which look at results
        that are computed once for many tests; and those that run symdh in a process of its own,
        of which nothing is known.
        """
        lines = self.lines[module.as_posix()]
        found = set().union(*(lines.get(line, set()) for line in range(first, last + 1)))
        found = found or set().union(*lines.values())
        files = {test.split(".", 1)[0] for test in found}
        others = {
            test
            for test in self.seconds
            if test.split(".", 1)[0] in files or not self.breadth[test]
        }
        return (
            sorted(found, key=lambda test: (self.breadth[test], self.seconds[test], test)),
            sorted(others - found, key=lambda test: (self.seconds[test], test)),
        )


def up_to(seconds: float, tests: list[str], reached: Reached) -> list[str]:
    """Return the tests from the front that take no longer than that, but at least one."""
    chosen: list[str] = []
    for test in tests:
        seconds -= reached.seconds[test]
        if chosen and seconds < 0:
            continue
        chosen.append(test)
    return chosen


def as_files(test: str) -> str:
    module, name = test.split(".", 1)
    return f"tests/{module}.py::{name.replace('.', '::')}"


def as_test(node: str) -> str:
    file, _, name = node.partition("::")
    return f"{Path(file).stem}.{name.split('[', 1)[0].replace('::', '.')}"


def digest(name: str) -> str:
    """Return what changes when the package does, or a file of tests, or what it imports."""
    total = hashlib.sha256()
    for path in sources():
        if path.stem == f"test_{name}" or not path.stem.startswith("test_"):
            total.update(path.read_bytes())
    return total.hexdigest()


@cache
def reached_lines() -> Reached:
    """Return what each test reaches, as kept, or measured now when a file has changed since."""
    (MUTATION / KILLERS).mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(measure, FILES))
    return Reached(MUTATION)


def measure(name: str) -> None:
    """Run a file of tests once under coverage, unless what it came to is kept and still holds."""
    mark = MUTATION / f"{name}.digest"
    if mark.is_file() and mark.read_text() == digest(name):
        return
    rules = MUTATION / f"{name}.rules"
    rules.write_text(RULES.format(source="".join(f"\n    {ROOT}/symdh/{at}" for at in LAYERS)))
    coverage = MUTATION / f"{name}.coverage"
    coverage.unlink(missing_ok=True)
    ran = subprocess.run(
        [
            *(sys.executable, "-m", "coverage", "run", f"--rcfile={rules}", "-m", "pytest"),
            *(*PYTEST, f"--junitxml={MUTATION}/{name}.xml", f"tests/test_{name}.py"),
        ],
        cwd=ROOT,
        env={**os.environ, "COVERAGE_FILE": str(coverage)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if ran.returncode != 0:
        sys.exit(f"test_{name}.py fails without any change:\n{ran.stdout[-3000:]}")
    mark.write_text(digest(name))


def draw(count: int, seed: int, layers: list[str], part: str) -> dict[str, Mutant]:
    """Draw different mutants by their names, each place of these layers as likely as any other.

    Where a name comes in the draw depends on it and the seed alone, so that a change of the
    package draws the mutants of what it changed anew, and no others.
    """
    every: list[tuple[str, Path, bytes, Place]] = []
    for layer in layers:
        for path in sorted((ROOT / "symdh" / layer).rglob("*.py")):
            if part in path.as_posix():
                source = path.read_bytes()
                module = path.relative_to(ROOT)
                named = names(module, source, seed)
                every += [(name, module, source, place) for name, place in named]
    every.sort(key=lambda each: each[0])
    made = ((name, mutant(module, source, place)) for name, module, source, place in every)
    found = ((name, each) for name, each in made if each)
    return dict(islice(found, count))


def names(module: Path, source: bytes, seed: int) -> Iterator[tuple[str, Place]]:
    """Name each place by its module, its statement and what stands there, not by its line."""
    lines = source.splitlines()
    met: Counter[str] = Counter()
    for place in places(ast.parse(source)):
        head = b" ".join(line.strip() for line in lines[place.first - 1 : place.last])
        told = f"{seed} {module.as_posix()} {head!r} {ast.unparse(place.node)}"
        met[told] += 1
        yield hashlib.sha256(f"{told} {met[told]}".encode()).hexdigest(), place


def is_killed(named: tuple[str, Mutant]) -> bool:
    """Run the tests of a mutant in a copy of the tree."""
    name, changed = named
    reached = reached_lines()
    reaching, others = reached.tests(changed.module, changed.first, changed.last)
    first = up_to(FIRST, reaching, reached)
    others += [test for test in reaching if test not in first]
    rest = up_to(ALL, sorted(others, key=reached.seconds.__getitem__), reached)
    killer = MUTATION / KILLERS / name
    before = json.loads(killer.read_text()) if killer.is_file() else []
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder, "tree")
        shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(".*", "out", "__pycache__"))
        (tree / changed.module).write_bytes(changed.text)
        for some in ([test for test in before if test in reached.seconds], first, rest):
            if some and fails(some, tree, reached):
                killer.write_text(json.dumps(begun(tree)))
                return True
    return False


def begun(tree: Path) -> list[str]:
    """Return the test that was begun last, none where a file of tests could not be imported."""
    note = tree / BEGUN
    return [as_test(note.read_text())] if note.is_file() else []


class Sampling:
    """Leaves parameters out, and writes down which test begins."""

    def __init__(self, every: dict[str, int]) -> None:
        self._every = every

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Keep some parameters of each test, the first among them."""
        met: Counter[str] = Counter()
        kept = []
        for item in items:
            test = as_test(item.nodeid)
            if met[test] % self._every.get(test, 1) == 0:
                kept.append(item)
            met[test] += 1
        items[:] = kept

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Keep the name where it is found after the process has ended, however it ends."""
        Path(BEGUN).write_text(nodeid)


def fails(tests: list[str], tree: Path, reached: Reached) -> bool:
    """Say whether one of these tests fails, or does not end within twice its time and some.

    They run in a fork of this process, which has loaded all that is slow to load and nothing of
    symdh.
    """
    seconds = 20 + 2 * int(sum(reached.seconds[test] for test in tests))
    child = os.fork()
    if child:
        status = os.waitpid(child, 0)[1]
        # 1: tests fail; 2: a file of tests cannot be imported; 4: nor can what all of them import,
        # or a test is not there. Anything else is no verdict.
        if not os.WIFSIGNALED(status) and os.WEXITSTATUS(status) not in (0, 1, 2, 4):
            raise RuntimeError(f"pytest ended with {os.WEXITSTATUS(status)} for {tests}")
        return status != 0
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    sink = os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, 1)
    os.dup2(sink, 2)
    os.chdir(tree)
    os.environ |= {"PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    sys.dont_write_bytecode = True
    sys.path[0] = str(tree)
    # A plugin that is loaded already is not rewritten, and need not be.
    loaded = ("-W", "ignore::pytest.PytestAssertRewriteWarning")
    os._exit(
        pytest.main([*PYTEST, *loaded, *map(as_files, tests)], plugins=[Sampling(reached.every)])
    )


def interval(part: float, count: int) -> tuple[float, float]:
    """Return Wilson's 95 % interval of a part that was seen in `count` draws."""
    z = 1.96
    middle = part + z * z / (2 * count)
    width = z * math.sqrt(part * (1 - part) / count + z * z / (4 * count * count))
    scale = 1 + z * z / count
    return (middle - width) / scale, (middle + width) / scale


def main() -> int:
    """Draw mutants, run them, print the survivors."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--skip", type=int, default=0, help="of those drawn, leave the first out")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--layer", choices=LAYERS, action="append")
    parser.add_argument("--module", default="", help="part of a path")
    options = parser.parse_args()
    layers = options.layer or list(LAYERS)
    every = draw(options.skip + options.count, options.seed, layers, options.module)
    named = list(every.items())[options.skip :]
    drawn = [each for _, each in named]
    unchanged = replace(drawn[0], text=(ROOT / drawn[0].module).read_bytes())
    reached_lines()  # once for all processes
    killed: Counter[str] = Counter()
    with get_context("fork").Pool(options.jobs, maxtasksperchild=1) as pool:
        found = pool.imap(is_killed, [("unchanged", unchanged), *named])
        if next(found):
            sys.exit(f"the tests of {unchanged.module} fail without any change")
        for each, dead in zip(drawn, found, strict=True):
            killed[each.module.parts[1]] += dead
            print(f"{'killed  ' if dead else 'SURVIVED'}  {each}", flush=True)
    for layer, count in sorted(Counter(each.module.parts[1] for each in drawn).items()):
        print(f"{layer:12} killed {killed[layer]} of {count}")
    part = killed.total() / len(drawn)
    low, high = (100 * end for end in interval(part, len(drawn)))
    verdict = "met" if 100 * part >= GOAL else "NOT MET"
    told = f"{killed.total()} of {len(drawn)} = {100 * part:.1f} % ({low:.0f} to {high:.0f} %)"
    print(f"{told}   at least {GOAL} % killed   {verdict}")
    if layers == list(LAYERS) and not options.module and len(drawn) >= 200:
        MUTATED.write_text(f"{told}\n")
    return int(100 * part < GOAL)


if __name__ == "__main__":
    sys.exit(main())
