"""`make bench-code`: generated code against what other tools generate, in one interleaved run.

CasADi, SymForce and Pinocchio come from their wheels, into a throw-away environment
(SYMDH_BENCH_VENV names one that is there already); what does not install is named and left out.
Every figure is CPU time, the median of the best quarter of many rounds in which all take turns:
what else the machine does only ever adds. Ratios compare like with like; nanoseconds alone say more
about the machine.
"""

from __future__ import annotations

import ctypes
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from sympy import Expr

import symdh
from symdh.codegen import generate
from symdh.robot import Convention, JointType, Robot

TABLES = Path(__file__).parent / "data" / "tables"
ROBOTS = {
    "2R": "planar_2r",
    "SCARA": "scara_rrpr",
    "PUMA560": "puma560",
    "UR5": "ur5",
    "Panda": "franka_panda",
}
FLAGS = os.environ.get("SYMDH_BENCH_FLAGS", "-O2 -march=native").split()
ROUNDS = int(os.environ.get("SYMDH_BENCH_ROUNDS", "60"))
POSES = 1000
RIVALS = ("casadi", "symforce", "sympy")
TASKS = ("fk", "jacobian", "both")

LOOP = """
void many(long count, long n, long size, const double *q, double *out)
{
    long i;
    for (i = 0; i < count; ++i) { call(&q[n * i], &out[size * (i % 8)]); }
}
"""

#: What an engineer writes without a generator: a loop over the rows, 4x4 matrices.
HAND = """
#include <math.h>
static const double rows[][4] = { %(rows)s };
static const int kinds[] = { %(kinds)s };
static void times(double T[16], const double A[16])
{
    double R[16]; int i, j, k;
    for (i = 0; i < 4; ++i) { for (j = 0; j < 4; ++j) { double s = 0.0;
        for (k = 0; k < 4; ++k) { s += T[4 * i + k] * A[4 * k + j]; } R[4 * i + j] = s; } }
    for (i = 0; i < 16; ++i) { T[i] = R[i]; }
}
static void chain(const double *q, double T[16], double Z[][6])
{
    int i, k, v = 0;
    for (i = 0; i < 16; ++i) { T[i] = (i %% 5 == 0) ? 1.0 : 0.0; }
    for (i = 0; i < %(count)d; ++i) {
        const double theta = rows[i][0] + (kinds[i] == 1 ? q[v] : 0.0);
        const double d = rows[i][1] + (kinds[i] == 2 ? q[v] : 0.0);
        const double ct = cos(theta), st = sin(theta), ca = cos(rows[i][3]), sa = sin(rows[i][3]);
        const double a = rows[i][2];
        const double S[16] = {ct,-st*ca,st*sa,a*ct, st,ct*ca,-ct*sa,a*st, 0,sa,ca,d, 0,0,0,1};
        const double M[16] = {ct,-st,0,a, st*ca,ct*ca,-sa,-sa*d, st*sa,ct*sa,ca,ca*d, 0,0,0,1};
        if (!%(modified)d && kinds[i]) { for (k = 0; k < 3; ++k) {
            Z[v][k] = T[4 * k + 2]; Z[v][k + 3] = T[4 * k + 3]; } }
        times(T, %(modified)d ? M : S);
        if (%(modified)d && kinds[i]) { for (k = 0; k < 3; ++k) {
            Z[v][k] = T[4 * k + 2]; Z[v][k + 3] = T[4 * k + 3]; } }
        if (kinds[i]) { ++v; }
    }
}
void call(const double *q, double *out)
{
    double T[16], Z[%(n)d][6]; int i, k; static const int turns[] = { %(turns)s };
    chain(q, T, Z);
    for (i = 0; i < 12 && %(pose)d; ++i) { out[i] = T[i]; }
    if (!%(jacobian)d) { return; }
    for (i = 0; i < %(n)d; ++i) {
        double r[3]; const double *z = Z[i];
        for (k = 0; k < 3; ++k) { r[k] = T[4 * k + 3] - Z[i][k + 3]; }
        for (k = 0; k < 3; ++k) {
            const int b = (k + 1) %% 3, c = (k + 2) %% 3;
            out[%(offset)d + %(n)d * k + i] = turns[i] ? z[b] * r[c] - z[c] * r[b] : z[k];
            out[%(offset)d + %(n)d * (k + 3) + i] = turns[i] ? z[k] : 0.0;
        }
    }
}
"""

PINOCCHIO = """
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <cmath>
using namespace pinocchio;
static Model model; static Data *data; static FrameIndex tip;
static SE3 rz(double c, double s, double d) { SE3 M = SE3::Identity();
    M.rotation() << c,-s,0, s,c,0, 0,0,1; M.translation() << 0,0,d; return M; }
static SE3 rx(double c, double s, double a) { SE3 M = SE3::Identity();
    M.rotation() << 1,0,0, 0,c,-s, 0,s,c; M.translation() << a,0,0; return M; }
static void build() { JointIndex at = 0; SE3 next = SE3::Identity();
%(rows)s
    tip = model.addFrame(Frame("tip", at, 0, next, OP_FRAME)); data = new Data(model); }
extern "C" void call(const double *q, double *out)
{
    if (!data) { build(); }
    Eigen::Map<const Eigen::VectorXd> joints(q, model.nq);
    if (%(jacobian)d) {
        static Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, model.nv);
        computeJointJacobians(model, *data, joints);
        getFrameJacobian(model, *data, tip, LOCAL_WORLD_ALIGNED, J);
        Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> >
            (out + %(offset)d, 6, model.nv) = J;
    } else { forwardKinematics(model, *data, joints); }
    if (%(pose)d) {
        const SE3 &M = updateFramePlacement(model, *data, tip);
        Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor> > T(out);
        T.leftCols<3>() = M.rotation(); T.col(3) = M.translation();
    }
}
"""


# ------------------------------------------------------------------------------- the contestants


def chain_of(robot: Robot) -> dict[str, Any]:
    """Numbers of a robot for the other tools; cosines of right angles are exact there too."""
    rows = []
    for joint in robot.joints:
        index = robot.variables.index(joint.variable) if joint.variable is not None else None
        known = {**robot.values, **dict.fromkeys(robot.variables, 0)}
        numbers = {
            name: number_of(getattr(joint, name).xreplace(known))
            for name in ("theta", "d", "a", "alpha")
        }
        rows.append(
            {
                **numbers,
                "variable": index,
                "turns": joint.type is JointType.REVOLUTE,
                "cs_theta": (clean(math.cos(numbers["theta"])), clean(math.sin(numbers["theta"]))),
                "cs_alpha": (clean(math.cos(numbers["alpha"])), clean(math.sin(numbers["alpha"]))),
            }
        )
    modified = robot.convention is Convention.MODIFIED
    return {"rows": rows, "n": len(robot.variables), "modified": modified}


def number_of(value: Expr) -> float:
    return float(value)


def clean(x: float) -> float:
    return float(round(x)) if abs(x - round(x)) < 1e-15 else x


class Contestant:
    """One tool's code for one task, compiled under a loop."""

    def __init__(self, name: str, source: Path, *, more: list[str] | None = None) -> None:
        self.name = name
        library = source.with_suffix(".so")
        compiler = "g++" if source.suffix == ".cpp" else "gcc"
        subprocess.run(
            [compiler, *FLAGS, "-shared", "-fPIC", "-w", str(source), "-o", str(library), "-lm"]
            + (more or []),
            check=True,
            capture_output=True,
        )
        self.library = ctypes.CDLL(str(library))
        self.times: list[float] = []

    def run(self, q: np.ndarray, out: np.ndarray, size: int) -> None:
        pointer = ctypes.POINTER(ctypes.c_double)
        start = time.thread_time()
        self.library.many(
            ctypes.c_long(len(q)),
            ctypes.c_long(q.shape[1]),
            ctypes.c_long(size),
            q.ctypes.data_as(pointer),
            out.ctypes.data_as(pointer),
        )
        self.times.append((time.thread_time() - start) / len(q) * 1e9)

    @property
    def nanoseconds(self) -> float:
        best = sorted(self.times)[: max(1, len(self.times) // 4)]
        return statistics.median(best)


def our_source(robot: Robot, task: str, folder: Path, trig: str) -> Path:
    """Write our code with the entries where the others put theirs."""
    files = generate(robot, "c", trig=trig, batch=True)
    for file in files:
        (folder / file.name).write_text(file.text)
    stem = files[1].name.removesuffix(".c")
    name = {"fk": "fk", "jacobian": "jacobian", "both": "fk_jacobian"}[task]
    outs = {"fk": "out", "jacobian": "out", "both": "out, out + 16"}[task]
    path = folder / f"ours_{trig}_{task}.c"
    path.write_text(
        f'#include "{stem}.c"\n'
        f"static void call(const double *q, double *out) {{ {stem}_{name}(q, {outs}); }}\n{LOOP}"
    )
    return path


def hand_source(chain: dict[str, Any], task: str, folder: Path) -> Path:
    rows, n = chain["rows"], chain["n"]
    kinds = [0 if r["variable"] is None else 1 if r["turns"] else 2 for r in rows]
    path = folder / f"hand_{task}.c"
    text = HAND % {
        "rows": ", ".join(
            "{" + ", ".join(repr(r[k]) for k in ("theta", "d", "a", "alpha")) + "}" for r in rows
        ),
        "kinds": ", ".join(map(str, kinds)),
        "turns": ", ".join(str(int(k == 1)) for k in kinds if k),
        "count": len(rows),
        "modified": chain["modified"],
        "n": n,
        "pose": task != "jacobian",
        "jacobian": task != "fk",
        "offset": 12 if task == "both" else 0,
    }
    path.write_text(text + LOOP)
    return path


def pinocchio_source(chain: dict[str, Any], task: str, folder: Path) -> Path:
    lines = []
    for k, r in enumerate(chain["rows"]):
        ct, st = r["cs_theta"]
        ca, sa = r["cs_alpha"]
        x = f"rx({ca!r}, {sa!r}, {r['a']!r})"
        z = f"rz({ct!r}, {st!r}, {r['d']!r})"
        before = f"next = next * {x};" if chain["modified"] else ""
        after = "" if chain["modified"] else f"next = next * {x};"
        if r["variable"] is None:
            lines.append(f"    {before} next = next * {z}; {after}")
            continue
        kind = "JointModelRZ" if r["turns"] else "JointModelPZ"
        # The offset of the row stands before the joint; about and along z they commute.
        lines.append(
            f"    {before} next = next * {z};"
            f' at = model.addJoint(at, {kind}(), next, "j{k}"); next = SE3::Identity(); {after}'
        )
    path = folder / f"pinocchio_{task}.cpp"
    text = PINOCCHIO % {
        "rows": "\n".join(lines),
        "pose": task != "jacobian",
        "jacobian": task != "fk",
        "offset": 12 if task == "both" else 0,
    }
    path.write_text(text + 'extern "C" ' + LOOP.strip())
    return path


def rival_source(python: str, tool: str, chain: dict[str, Any], task: str, folder: Path) -> Path:
    place = folder / tool
    if not place.exists():
        place.mkdir()
        script = Path(__file__).with_name("bench_rivals.py")
        subprocess.run(
            [python, str(script), tool, str(place)],
            input=json.dumps(chain),
            text=True,
            check=True,
            capture_output=True,
            cwd=place,
        )
        for path in place.glob("*.c"):
            path.write_text(path.read_text() + LOOP)
    return place / f"{task}.c"


# ---------------------------------------------------------------------------------- environment


def bench_python(folder: Path) -> tuple[str, set[str], Path | None]:
    """Return a Python with the other tools, which of them it has, and Pinocchio's prefix."""
    given = os.environ.get("SYMDH_BENCH_VENV")
    venv = Path(given) if given else folder / "venv"
    python = str(venv / "bin" / "python")
    if not given:
        print("installing CasADi, SymForce and Pinocchio into a throw-away environment", flush=True)
        subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True)
        for package in ("casadi", "symforce", "sympy", "pin"):
            subprocess.run([python, "-m", "pip", "install", "-q", package], check=False)
    have = {
        tool
        for tool in (*RIVALS, "pinocchio")
        if subprocess.run(
            [python, "-c", f"import {tool}"], check=False, capture_output=True
        ).returncode
        == 0
    }
    prefix = next(iter(venv.glob("lib/python3*/site-packages/cmeel.prefix")), None)
    return python, have, prefix


#: Pinocchio has more kinds of joint than the lists of Boost hold by default.
_BOOST = ["-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS"]


def pinocchio_flags(prefix: Path) -> list[str]:
    library = prefix / "lib"
    eigen = next(
        (
            str(p)
            for p in (prefix / "include" / "eigen3", Path("/usr/include/eigen3"))
            if p.is_dir()
        ),
        "",
    )
    flags = [f"-I{prefix / 'include'}", f"-L{library}", f"-Wl,-rpath,{library}", "-std=c++17"]
    return [*flags, *([f"-I{eigen}"] if eigen else []), "-lpinocchio_default", *_BOOST]


# -------------------------------------------------------------------------------------- the rows


def contestants(
    robot: Robot, task: str, folder: Path, python: str, have: set[str], prefix: Path | None
) -> list[Contestant]:
    chain = chain_of(robot)
    found = [
        Contestant("symdh", our_source(robot, task, folder, "inline")),
        Contestant("symdh libm", our_source(robot, task, folder, "libm")),
    ]
    for tool in RIVALS:
        if tool in have:
            found.append(Contestant(tool, rival_source(python, tool, chain, task, folder)))
    found.append(Contestant("hand loop", hand_source(chain, task, folder)))
    if prefix is not None and "pinocchio" in have:
        try:
            source = pinocchio_source(chain, task, folder)
            found.append(Contestant("pinocchio", source, more=pinocchio_flags(prefix)))
        except subprocess.CalledProcessError as error:
            print("pinocchio does not compile here:", error.stderr.decode()[:300])
    return found


def measure(robot: Robot, task: str, rivals: list[Contestant]) -> None:
    n = len(robot.variables)
    q = np.random.default_rng(1).uniform(-math.pi, math.pi, (POSES, n))
    size = 16 + 6 * n
    out = np.zeros((8, size))
    check = {}
    for rival in rivals:
        rival.run(q[:8], out, size)
        check[rival.name] = out.copy()
        rival.times.clear()
    agree(task, check, n)
    for _ in range(ROUNDS):
        for rival in rivals:
            rival.run(q, out, size)


def agree(task: str, results: dict[str, np.ndarray], n: int) -> None:
    """Leave nobody in the race who computes something else."""

    def pick(name: str, out: np.ndarray) -> np.ndarray:
        ours = name.startswith("symdh")
        if task == "both" and ours:
            return np.hstack([out[:, :12], out[:, 16 : 16 + 6 * n]])
        return out[:, : {"fk": 12, "jacobian": 6 * n, "both": 12 + 6 * n}[task]]

    reference = pick("symdh", results["symdh"])
    for name, out in results.items():
        if np.abs(pick(name, out) - reference).max() > 1e-9:
            raise SystemExit(f"{name} computes another {task} than symdh")


def batch_times(robot: Robot, folder: Path, count: int) -> dict[str, float]:
    """Nanoseconds a pose of the batch functions and of a loop over the scalar one."""
    files = generate(robot, "c", batch=True)
    for file in files:
        (folder / file.name).write_text(file.text)
    stem, n = files[1].name.removesuffix(".c"), len(robot.variables)
    source = folder / "batch.c"
    source.write_text(
        f'#include "{stem}.c"\n'
        "void loop(size_t count, const double *q, double *T)\n{\n    size_t i;\n"
        f"    for (i = 0; i < count; ++i) {{ {stem}_fk(&q[{n} * i], &T[16 * i]); }}\n}}\n"
    )
    library = folder / "batch.so"
    command = ["gcc", *FLAGS, "-shared", "-fPIC", str(source), "-o", str(library), "-lm"]
    subprocess.run(command, check=True)
    code = ctypes.CDLL(str(library))
    q = np.random.default_rng(1).uniform(-math.pi, math.pi, (n, count))
    T = np.zeros((16, count))
    pointer = ctypes.POINTER(ctypes.c_double)
    size, qp, Tp = ctypes.c_size_t(count), q.ctypes.data_as(pointer), T.ctypes.data_as(pointer)
    calls: dict[str, Callable[[], object]] = {
        "structure of arrays": lambda: getattr(code, f"{stem}_fk_batch")(size, qp, size, Tp, size),
        "array of poses": lambda: getattr(code, f"{stem}_fk_poses")(size, qp, Tp),
        "loop over fk": lambda: code.loop(size, qp, Tp),
    }
    times: dict[str, list[float]] = {name: [] for name in calls}
    repeats = max(1, 100_000 // count)
    for _ in range(max(5, min(ROUNDS, 2_000_000 // count))):
        for name, call in calls.items():
            start = time.thread_time()
            for _ in range(repeats):
                call()
            times[name].append((time.thread_time() - start) / count / repeats * 1e9)
    return {name: min(each) for name, each in times.items()}


def instructions(robot: Robot, folder: Path) -> int | None:
    """Instructions of one pose, counted by callgrind, the difference of two runs."""
    valgrind = shutil.which("valgrind")
    if valgrind is None:
        return None
    files = generate(robot, "c")
    for file in files:
        (folder / file.name).write_text(file.text)
    stem, n = files[1].name.removesuffix(".c"), len(robot.variables)
    main = folder / "count.c"
    main.write_text(
        f'#include <stdlib.h>\n#include "{stem}.h"\nint main(int argc, char **argv)\n{{\n'
        f"    double q[{n}] = {{0.1}}, T[16]; int i, times = atoi(argv[argc - 1]);\n"
        f"    for (i = 0; i < times; ++i) {{ {stem}_fk(q, T); }}\n    return T[15] != 1.0;\n}}\n"
    )
    program = str(folder / "count")
    # Valgrind does not know every instruction of this machine: a plain one is counted.
    command = ["gcc", "-O2", "-mavx", str(main), str(folder / f"{stem}.c"), "-o", program, "-lm"]
    subprocess.run(command, check=True)
    counts = []
    for times in ("1000", "2000"):
        out = f"--callgrind-out-file={folder / 'callgrind'}"
        done = subprocess.run(
            [valgrind, "--tool=callgrind", out, program, times],
            capture_output=True,
            text=True,
            check=False,
        )
        found = re.search(r"Collected : (\d+)", done.stderr)
        if found is None:
            return None
        counts.append(int(found[1]))
    return (counts[1] - counts[0]) // 1000


def python_times(robot: Robot, folder: Path) -> dict[str, float]:
    """Nanoseconds of the Python module: one call, and a pose of a batch."""
    (file,) = generate(robot, "python")
    space: dict[str, Any] = {"__name__": "bench"}
    exec(compile(file.text, file.name, "exec"), space)
    fk, n = space["fk"], len(robot.variables)
    one, many = [0.1] * n, np.random.default_rng(1).uniform(-3, 3, (100_000, n))
    singles, batches = [], []
    for _ in range(15):
        start = time.thread_time()
        for _ in range(500):
            fk(one)
        singles.append((time.thread_time() - start) / 500 * 1e9)
        start = time.thread_time()
        fk(many)
        batches.append((time.thread_time() - start) / len(many) * 1e9)
    return {"fk(list)": min(singles), "fk(array of 1e5)": min(batches)}


def main() -> int:
    """Print all rows; exit status 1 where symdh is not first among the C scalars."""
    folder = Path(tempfile.mkdtemp(prefix="symdh-bench-"))
    losses = []
    try:
        python, have, prefix = bench_python(folder)
        missing = {*RIVALS, "pinocchio"} - have
        if missing:
            print("not installed, left out:", ", ".join(sorted(missing)))
        print(f"gcc {' '.join(FLAGS)}; ns a call of symdh, and how many times as long others take")
        for name, table in ROBOTS.items():
            robot = symdh.load(TABLES / f"{table}.yaml")
            place = folder / table
            place.mkdir()
            for task in TASKS:
                found = contestants(robot, task, place, python, have, prefix)
                measure(robot, task, found)
                ours, *others = found
                ratios = [f"{o.name} {o.nanoseconds / ours.nanoseconds:.2f}" for o in others]
                print(f"{name:8} {task:9} {ours.nanoseconds:7.1f} ns   {'   '.join(ratios)}")
                losses += [
                    f"{name} {task}: {o.name}" for o in others if o.nanoseconds < ours.nanoseconds
                ]
            for count in (1024, 1_000_000):
                times = batch_times(robot, place, count)
                print(f"{name:8} batch of {count}: {show(times)}")
            print(f"{name:8} Python: {show(python_times(robot, place))}")
            counted = instructions(robot, place)
            print(f"{name:8} instructions of a pose (-O2 -mavx): {counted or 'no valgrind here'}")
            sys.stdout.flush()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print("symdh is first in every row" if not losses else "not first: " + "; ".join(losses))
    return 1 if losses else 0


def show(times: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:.1f} ns" for name, value in times.items())


if __name__ == "__main__":
    sys.exit(main())
