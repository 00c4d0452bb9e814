"""`make bench-code`: generated code against what other tools generate, in one interleaved run.

CasADi, SymForce, sympy and Pinocchio come from their wheels, into a throw-away environment;
SYMDH_BENCH_VENV names one that is there already, made by

    python3 -m venv VENV && VENV/bin/pip install casadi symforce sympy pin

and SYMDH_BENCH_VENV=none does without. What does not install is named and left out. Every figure is
CPU time, the median of the best quarter of many rounds in which all take turns: what else the
machine does only ever adds. Ratios compare like with like; nanoseconds alone say more about the
machine.
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
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from sympy import Expr

import symdh
from symdh.codegen import generate
from symdh.codegen.names import file_stem
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
POSES = 4000
RIVALS = ("casadi", "symforce", "sympy")
TASKS = ("fk", "jacobian", "both")

#: Calls under a loop: results into a few places, or each into its own.
LOOP = """
void many(long count, long n, long size, const double *q, double *out)
{
    long i;
    for (i = 0; i < count; ++i) { call(&q[n * i], &out[size * (i % 8)]); }
}
void each(long count, long n, long size, const double *q, double *out)
{
    long i;
    for (i = 0; i < count; ++i) { call(&q[n * i], &out[size * i]); }
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

#: Compiled once: its model is made at run time anyhow.
PINOCCHIO = (
    """
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
using namespace pinocchio;
static Model model; static Data *data; static FrameIndex tip; static Eigen::MatrixXd J;
static int pose, jacobian;
static SE3 rz(double c, double s, double d) { SE3 M = SE3::Identity();
    M.rotation() << c,-s,0, s,c,0, 0,0,1; M.translation() << 0,0,d; return M; }
static SE3 rx(double c, double s, double a) { SE3 M = SE3::Identity();
    M.rotation() << 1,0,0, 0,c,-s, 0,s,c; M.translation() << a,0,0; return M; }
/* Of each row: 0 fixed, 1 turns, 2 slides; cos, sin theta; d; cos, sin alpha; a. */
extern "C" void build(int count, const double (*rows)[7], int modified)
{
    JointIndex at = 0; SE3 next = SE3::Identity(); model = Model();
    for (int k = 0; k < count; ++k) {
        const double *r = rows[k];
        if (modified) { next = next * rx(r[4], r[5], r[6]); }
        next = next * rz(r[1], r[2], r[3]);
        if (r[0] != 0) {
            const std::string name = "j" + std::to_string(k);
            at = r[0] == 1 ? model.addJoint(at, JointModelRZ(), next, name)
                           : model.addJoint(at, JointModelPZ(), next, name);
            next = SE3::Identity();
        }
        if (!modified) { next = next * rx(r[4], r[5], r[6]); }
    }
    tip = model.addFrame(Frame("tip", at, 0, next, OP_FRAME));
    delete data; data = new Data(model); J = Eigen::MatrixXd::Zero(6, model.nv);
}
extern "C" void choose(int with_pose, int with_jacobian)
{ pose = with_pose; jacobian = with_jacobian; }
static void call(const double *q, double *out)
{
    Eigen::Map<const Eigen::VectorXd> joints(q, model.nq);
    if (jacobian) {
        computeJointJacobians(model, *data, joints);
        getFrameJacobian(model, *data, tip, LOCAL_WORLD_ALIGNED, J);
        Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> >
            (out + (pose ? 12 : 0), 6, model.nv) = J;
    } else { forwardKinematics(model, *data, joints); }
    if (pose) {
        const SE3 &M = updateFramePlacement(model, *data, tip);
        Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor> > T(out);
        T.leftCols<3>() = M.rotation(); T.col(3) = M.translation();
    }
}
extern "C" {
"""
    + LOOP
    + "}"
)


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

    def __init__(self, name: str, library: Path, prepare: Callable[[Any], None] | None = None):
        self.name = name
        self.library = ctypes.CDLL(str(library))
        self.prepare = prepare
        self.times: list[float] = []

    def run(self, q: np.ndarray, out: np.ndarray, size: int, loop: str = "many") -> None:
        if self.prepare is not None:
            self.prepare(self.library)
        pointer = ctypes.POINTER(ctypes.c_double)
        given, found = q.ctypes.data_as(pointer), out.ctypes.data_as(pointer)
        n, width, run = ctypes.c_long(q.shape[1]), ctypes.c_long(size), getattr(self.library, loop)
        # Whoever is first after another program had the processor shall not pay for its caches.
        run(ctypes.c_long(min(100, len(q))), n, width, given, found)
        start = time.thread_time()
        run(ctypes.c_long(len(q)), n, width, given, found)
        self.times.append((time.thread_time() - start) / len(q) * 1e9)

    @property
    def nanoseconds(self) -> float:
        return typical(self.times)


def typical(times: list[float]) -> float:
    """Median of the best quarter."""
    return statistics.median(sorted(times)[: max(1, len(times) // 4)])


def compiled(source: Path, *more: str) -> Path:
    """Compile a source into a library beside it."""
    library = source.with_suffix(".so")
    compiler = "g++" if source.suffix == ".cpp" else "gcc"
    command = [compiler, *FLAGS, "-shared", "-fPIC", "-w", str(source), "-o", str(library)]
    subprocess.run([*command, "-lm", *more], check=True, capture_output=True)
    return library


def our_source(robot: Robot, task: str, folder: Path, trig: str) -> Path:
    """Write our code with the entries where the others put theirs."""
    place = folder / trig
    place.mkdir(exist_ok=True)
    for file in generate(robot, "c", trig=trig, batch=True):
        (place / file.name).write_text(file.text)
    stem = file_stem(robot.name)
    name = {"fk": "fk", "jacobian": "jacobian", "both": "fk_jacobian"}[task]
    outs = {"fk": "out", "jacobian": "out", "both": "out, out + 16"}[task]
    path = place / f"ours_{task}.c"
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


def pinocchio_library(folder: Path, prefix: Path) -> Path | None:
    """Compile the loop over Pinocchio, where that works."""
    source = folder / "pinocchio.cpp"
    source.write_text(PINOCCHIO)
    try:
        return compiled(source, *pinocchio_flags(prefix))
    except subprocess.CalledProcessError as error:
        print("Pinocchio does not compile here:", error.stderr.decode()[:300])
        return None


def pinocchio_model(chain: dict[str, Any], task: str) -> Callable[[Any], None]:
    """Return what makes Pinocchio's library compute a task of a chain."""
    kinds = [0 if r["variable"] is None else 1 if r["turns"] else 2 for r in chain["rows"]]
    numbers = [
        [kind, *r["cs_theta"], r["d"], *r["cs_alpha"], r["a"]]
        for kind, r in zip(kinds, chain["rows"], strict=True)
    ]
    rows = np.array(numbers, dtype=float)
    built = []

    def prepare(library: Any) -> None:
        if not built:
            address = rows.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
            library.build(ctypes.c_int(len(rows)), address, ctypes.c_int(chain["modified"]))
            built.append(True)
        library.choose(ctypes.c_int(task != "jacobian"), ctypes.c_int(task != "fk"))

    return prepare


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


@dataclass(frozen=True)
class Peers:
    """The other tools: a Python, which of them it has, and a library for Pinocchio."""

    python: str
    have: frozenset[str]
    pinocchio: Path | None


def find_peers(folder: Path) -> Peers:
    """Find the other tools, or install them."""
    given = os.environ.get("SYMDH_BENCH_VENV")
    if given == "none":
        return Peers(sys.executable, frozenset({"sympy"}), None)
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
    library = pinocchio_library(folder, prefix) if prefix and "pinocchio" in have else None
    return Peers(python, frozenset(have), library)


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


def contestants(robot: Robot, task: str, folder: Path, peers: Peers) -> list[Contestant]:
    chain = chain_of(robot)
    found = [
        Contestant("symdh", compiled(our_source(robot, task, folder, "inline"))),
        Contestant("symdh libm", compiled(our_source(robot, task, folder, "libm"))),
    ]
    for tool in RIVALS:
        if tool in peers.have:
            source = rival_source(peers.python, tool, chain, task, folder)
            found.append(Contestant(tool, compiled(source)))
    found.append(Contestant("hand loop", compiled(hand_source(chain, task, folder))))
    if peers.pinocchio is not None:
        model = pinocchio_model(chain, task)
        found.append(Contestant("pinocchio", peers.pinocchio, model))
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


def measure_batch(
    robot: Robot, folder: Path, count: int, rivals: list[Contestant]
) -> dict[str, float]:
    """Nanoseconds a pose of the batch functions, and of loops over everybody's pose."""
    stem, n = file_stem(robot.name), len(robot.variables)
    code = ctypes.CDLL(str(folder / "inline" / "ours_fk.so"))
    q = np.random.default_rng(1).uniform(-math.pi, math.pi, (count, n))
    columns, T = np.ascontiguousarray(q.T), np.zeros((16, count))
    pointer = ctypes.POINTER(ctypes.c_double)
    size, Tp = ctypes.c_size_t(count), T.ctypes.data_as(pointer)
    qp, cp = q.ctypes.data_as(pointer), columns.ctypes.data_as(pointer)
    soa, aos = getattr(code, f"{stem}_fk_batch"), getattr(code, f"{stem}_fk_poses")
    calls: dict[str, Callable[[], object]] = {
        "symdh": lambda: soa(size, cp, size, Tp, size),
        "symdh array of poses": lambda: aos(size, qp, Tp),
    }
    times: dict[str, list[float]] = {name: [] for name in calls}
    repeats = max(1, 100_000 // count)
    for rival in rivals:
        rival.times.clear()
    for _ in range(max(8, min(ROUNDS, 5_000_000 // count))):
        for name, call in calls.items():
            start = time.thread_time()
            for _ in range(repeats):
                call()
            times[name].append((time.thread_time() - start) / count / repeats * 1e9)
        for rival in rivals:
            rival.run(q, T, 16, "each")
    loops = {f"{rival.name} in a loop": rival.nanoseconds for rival in rivals}
    return {name: typical(each) for name, each in times.items()} | loops


def instructions(source: Path, n: int) -> int | None:
    """Instructions of one call, counted by callgrind inside the loop."""
    valgrind = shutil.which("valgrind")
    if valgrind is None:
        return None
    main, program = source.with_name("count.c"), str(source.with_name("count"))
    size = 16 + 6 * n
    main.write_text(
        "void many(long, long, long, const double *, double *);\nint main(void)\n{\n"
        f"    double q[{n}] = {{0.1}}, out[{8 * size}];\n"
        f"    many(1000, 0, {size}, q, out);\n    return 0;\n}}\n"
    )
    # Valgrind does not know every instruction of every machine: plain ones are counted.
    command = ["gcc", "-O2", "-mavx", "-w", str(source), str(main), "-o", program, "-lm"]
    subprocess.run(command, check=True)
    options = ["--tool=callgrind", "--toggle-collect=many", "--callgrind-out-file=/dev/null"]
    done = subprocess.run(
        [valgrind, *options, program], capture_output=True, text=True, check=False
    )
    found = re.search(r"Collected : (\d+)", done.stderr)
    return int(found[1]) // 1000 if found else None


def python_rows(robot: Robot, folder: Path, peers: Peers) -> dict[str, dict[str, float]]:
    """Run the Python side, in the Python of the other tools."""
    place = folder / "python"
    place.mkdir()
    for file in (*generate(robot, "python"), *generate(robot, "python-ext")):
        (place / file.name).write_text(file.text)
    build = [peers.python, "setup.py", "--quiet", "build_ext", "--inplace"]
    env = {**os.environ, "CFLAGS": " ".join(FLAGS)}
    done = subprocess.run(build, cwd=place, env=env, check=False, capture_output=True, text=True)
    if done.returncode:
        print("the extension does not build here:", done.stderr[-300:])
    script = Path(__file__).with_name("bench_python.py")
    command = [peers.python, str(script), str(place), file_stem(robot.name), str(ROUNDS)]
    chain = json.dumps(chain_of(robot))
    ran = subprocess.run(command, input=chain, text=True, check=True, stdout=subprocess.PIPE)
    found: dict[str, dict[str, float]] = json.loads(ran.stdout)
    return found


class Report:
    """Prints rows of nanoseconds, ours first and the others as ratios, and keeps who beats us."""

    def __init__(self) -> None:
        self.rows = 0
        self.losses: list[str] = []

    def row(self, robot: str, name: str, times: dict[str, float]) -> None:
        ours, *others = times
        ratios = "   ".join(f"{other} {times[other] / times[ours]:.2f}" for other in others)
        print(f"{robot:8} {name:22} {times[ours]:9.1f} ns   {ratios}", flush=True)
        self.rows += 1
        # Ways of our own that are slower or faster are no rivals.
        faster = [o for o in others if times[o] < times[ours] and not o.startswith("symdh")]
        self.losses += [f"{robot} {name}: {other}" for other in faster]


def bench(robot: Robot, name: str, folder: Path, peers: Peers, report: Report) -> None:
    """Print all rows of one robot."""
    n = len(robot.variables)
    for task in TASKS:
        found = contestants(robot, task, folder, peers)
        measure(robot, task, found)
        report.row(name, f"C {task}", {one.name: one.nanoseconds for one in found})
        if task == "fk":
            for count in (1024, 1_000_000):
                times = measure_batch(robot, folder, count, found[:1] + found[2:])
                report.row(name, f"C batch of {count}", times)
    for row, times in python_rows(robot, folder, peers).items():
        report.row(name, row, times)
    counts = {f"symdh {task}": folder / "inline" / f"ours_{task}.c" for task in TASKS}
    counts |= {f"{tool} fk": folder / tool / "fk.c" for tool in RIVALS if tool in peers.have}
    counts["hand loop fk"] = folder / "hand_fk.c"
    counted = [f"{what} {instructions(source, n)}" for what, source in counts.items()]
    print(f"{name:8} instructions of a call (callgrind, -O2 -mavx): {', '.join(counted)}\n")


def main() -> int:
    """Print all rows; exit status 1 where symdh is not first in one of C."""
    folder = Path(tempfile.mkdtemp(prefix="symdh-bench-"))
    report = Report()
    try:
        peers = find_peers(folder)
        missing = {*RIVALS, "pinocchio"} - peers.have
        if missing:
            print("not installed, left out:", ", ".join(sorted(missing)))
        print(f"gcc {' '.join(FLAGS)}; ns a call of symdh, and how many times as long others take")
        for name, table in ROBOTS.items():
            place = folder / table
            place.mkdir()
            bench(symdh.load(TABLES / f"{table}.yaml"), name, place, peers, report)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    behind = {loss.rpartition(": ")[0] for loss in report.losses}
    print(f"symdh is first in {report.rows - len(behind)} of {report.rows} rows")
    for loss in report.losses:
        print(f"not first: {loss} is faster")
    return 1 if any(" C " in loss for loss in report.losses) else 0


if __name__ == "__main__":
    sys.exit(main())
