"""`make accuracy`: how far generated poses are off, in eps of the arm's reach, beside (4 + 2n).

    python tests/accuracy.py [POSES [TABLE...]]

Every pose is compared with the oracle in extended precision, 11 bits beyond a double. What that is
worth is not taken on trust: it is compared with mpmath at 50 digits on a sample of the poses, and
the pose on which each kind of code is worst is judged once more at 50 digits; that is the figure
that counts. For float, eps is 2^-23 and the joint values are floats.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from generated import import_generated
from oracle import EXTENDED, FIFTY_DIGITS, Arithmetic, Arm, read_arm_file

import symdh
from symdh.codegen import generate
from symdh.robot import Robot

TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
POSES = 100_000
#: Poses of a table that extended precision is compared with 50 digits on.
SAMPLE = 100
#: What extended precision may be off by, in eps of double precision.
ORACLE_LIMIT = 0.05
_AT_A_TIME = 10_000
EPS = {"double": 2.0**-52, "float": 2.0**-23}

LOOP = """#include "{stem}.c"
void many(long count, const {real} *q, {real} *T)
{{
    long i;
    for (i = 0; i < count; ++i) {{ {stem}_fk(&q[{n} * i], &T[16 * i]); }}
}}
"""

Poses = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Contestant:
    """A kind of generated code: its name, its kind of number, and what computes poses."""

    name: str
    kind: str
    poses: Poses


@dataclass(frozen=True)
class Row:
    """What came of one table.

    Attributes
    ----------
    table : str
    limit : int
        4 + 2 n.
    oracle : float
        Error of extended precision on the sample, in eps of double precision and reach.
    errors : dict of str to float
        Largest error of an entry of a pose in eps of reach, by kind of code.
    """

    table: str
    limit: int
    oracle: float
    errors: dict[str, float]

    @property
    def is_good(self) -> bool:
        errors = self.errors.values()
        return all(error <= self.limit for error in errors) and self.oracle <= ORACLE_LIMIT


def measure(table: Path, poses: int = POSES, sample: int = SAMPLE) -> Row:
    """Measure every kind of code of one table."""
    arm, robot = read_arm_file(table), symdh.load(table)
    reach = max(1.0, arm.reach())
    q = {"double": arm.seeded_poses(poses, seed=TABLES.index(table))}
    # Floats are doubles too: the oracle takes them as they are.
    q["float"] = q["double"].astype(np.float32).astype(np.float64)
    exact = {kind: in_extended_precision(arm, joints) for kind, joints in q.items()}
    some = slice(None, None, max(1, poses // sample))
    off = apart(exact["double"][some], pose_of(arm, q["double"][some], FIFTY_DIGITS))
    errors = {}
    with tempfile.TemporaryDirectory() as folder:
        for contestant in contestants(robot, Path(folder)):
            joints = q[contestant.kind]
            found = contestant.poses(joints)
            error = np.abs(found - exact[contestant.kind]).max(axis=(1, 2))
            worst = int(np.argmax(np.where(np.isnan(error), np.inf, error)))
            judged = apart(found[worst], pose_of(arm, joints[worst : worst + 1], FIFTY_DIGITS)[0])
            errors[contestant.name] = judged / EPS[contestant.kind] / reach
    return Row(table.stem, 4 + 2 * arm.n, off / EPS["double"] / reach, errors)


def in_extended_precision(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Poses by the oracle, some at a time."""
    starts = range(0, len(q), _AT_A_TIME)
    return np.concatenate([pose_of(arm, q[at : at + _AT_A_TIME], EXTENDED) for at in starts])


def apart(found: np.ndarray, exact: Any) -> float:
    """Largest difference from numbers of 50 digits; those of x87 are two doubles each."""
    high = found.astype(np.float64)
    low = (found - high).astype(np.float64)
    return float(np.abs(((exact - high) - low).astype(np.float64)).max())


def pose_of(arm: Arm, q: np.ndarray, arithmetic: Arithmetic) -> Any:
    joints = {name: arithmetic.array(q[:, k]) for k, (name, _) in enumerate(arm.variables)}
    return arm.pose(joints, arithmetic=arithmetic)


# ------------------------------------------------------------------------------ the generated code


def contestants(robot: Robot, folder: Path) -> Iterator[Contestant]:
    """Yield every kind of code."""
    for kind in EPS:
        plain, native = (compiled(robot, folder, kind, flags) for flags in ([], ["-march=native"]))
        yield Contestant(f"C {kind}", kind, plain.one_by_one)
        yield Contestant(f"C {kind} native", kind, native.one_by_one)
        yield Contestant(f"C {kind} batch", kind, native.batch)
    module = import_generated(generate(robot, "python"), folder)
    yield Contestant("Python", "double", lambda q: np.array([module.fk(row) for row in q.tolist()]))
    yield Contestant("Python batch", "double", module.fk)


@dataclass(frozen=True)
class Compiled:
    """Generated C: one pose after the other, and a batch of them."""

    library: Any
    stem: str
    dtype: Any
    ctype: Any

    def one_by_one(self, q: np.ndarray) -> np.ndarray:
        rows = np.ascontiguousarray(q, dtype=self.dtype)
        T = np.empty((len(rows), 4, 4), dtype=self.dtype)
        self.library.many(ctypes.c_long(len(rows)), self._pointer(rows), self._pointer(T))
        return T

    def batch(self, q: np.ndarray) -> np.ndarray:
        columns = np.ascontiguousarray(q.T, dtype=self.dtype)
        entries = np.zeros((16, len(q)), dtype=self.dtype)
        entries[15] = 1
        count = ctypes.c_size_t(len(q))
        call = getattr(self.library, f"{self.stem}_fk_batch")
        call(count, self._pointer(columns), count, self._pointer(entries), count)
        return entries.T.reshape(-1, 4, 4)

    def _pointer(self, x: np.ndarray) -> Any:
        return x.ctypes.data_as(ctypes.POINTER(self.ctype))


def compiled(robot: Robot, folder: Path, kind: str, flags: Sequence[str]) -> Compiled:
    """Generate C and compile it under a loop."""
    for file in (files := generate(robot, "c", precision=kind, batch=True)):
        (folder / file.name).write_text(file.text)
    stem = files[1].name.removesuffix(".c")
    source = folder / "many.c"
    source.write_text(LOOP.format(stem=stem, real=kind, n=len(robot.variables)))
    library = folder / f"{stem}{''.join(flags)}.so"
    command = ["gcc", "-O2", *flags, "-shared", "-fPIC", str(source), "-o", str(library), "-lm"]
    subprocess.run(command, check=True)
    dtype, ctype = {
        "double": (np.float64, ctypes.c_double),
        "float": (np.float32, ctypes.c_float),
    }[kind]
    return Compiled(ctypes.CDLL(str(library)), stem, dtype, ctype)


# --------------------------------------------------------------------------------------- the run


def main(arguments: Sequence[str]) -> int:
    """Print a row for each table; exit status 1 where any is off by more than it may be."""
    poses = int(arguments[0]) if arguments else POSES
    tables = [Path(name).resolve() for name in arguments[1:]] or TABLES
    print(f"{poses} poses a table, largest error in eps of reach, at most 4 + 2n; eps = 2^-52,")
    print("of float 2^-23; the oracle's own error beside 50 digits first")
    rows = []
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for row in pool.map(measure, tables, [poses] * len(tables)):
            if not rows:
                print("\n" + line("table", "limit", "oracle", [*row.errors]))
            figures = [f"{error:.2f}" for error in row.errors.values()]
            print(line(row.table, str(row.limit), f"{row.oracle:.4f}", figures), end="")
            print("" if row.is_good else "   TOO FAR OFF", flush=True)
            rows.append(row)
    worst = [max(row.errors[name] / row.limit for row in rows) for name in rows[0].errors]
    print(line("worst of limit", "", "", [f"{x:.0%}" for x in worst]))
    bad = [row.table for row in rows if not row.is_good]
    print(f"{len(rows) - len(bad)} of {len(rows)} tables within (4 + 2n) eps of reach")
    return 1 if bad else 0


def line(table: str, limit: str, oracle: str, figures: Sequence[str]) -> str:
    return f"{table:28} {limit:>5} {oracle:>7}  " + " ".join(f"{x:>15}" for x in figures)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
