"""Python's side of bench_code.py: calls from Python, one pose or many, all in one interleaved run.

    python bench_python.py FOLDER STEM ROUNDS < chain.json

FOLDER holds the generated STEM.py and the built STEM_ext. Run by a Python that has the other tools;
those that it has not are left out. Prints, for each row, nanoseconds of every contestant as JSON.
"""

from __future__ import annotations

import importlib
import json
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import bench_rivals
import numpy as np

Call = Callable[[], Any]
Rows = dict[str, dict[str, Call]]
MANY = 100_000


class Hand:
    """What one writes without a generator: a loop over the rows, 4x4 matrices of NumPy."""

    def __init__(self, chain: dict[str, Any]) -> None:
        self.rows, self.modified = chain["rows"], chain["modified"]

    def fk(self, q: np.ndarray) -> np.ndarray:
        """One pose or, with q of shape (N, n), N of them."""
        q = np.asarray(q)
        T = np.broadcast_to(np.eye(4), (*q.shape[:-1], 4, 4))
        for row in self.rows:
            at, turns = row["variable"], row["turns"]
            theta = row["theta"] + (q[..., at] if at is not None and turns else 0.0)
            d = row["d"] + (q[..., at] if at is not None and not turns else 0.0)
            ct, st = np.cos(theta), np.sin(theta)
            ca, sa = row["cs_alpha"]
            A = np.zeros((*q.shape[:-1], 4, 4))
            A[..., 3, 3] = 1.0
            if self.modified:
                entries = [ct, -st, 0, row["a"], st * ca, ct * ca, -sa, -sa * d]
                entries += [st * sa, ct * sa, ca, ca * d]
            else:
                entries = [ct, -st * ca, st * sa, row["a"] * ct, st, ct * ca, -ct * sa]
                entries += [row["a"] * st, 0, sa, ca, d]
            for k, entry in enumerate(entries):
                A[..., k // 4, k % 4] = entry
            T = T @ A
        return T


def with_lambdify(chain: dict[str, Any]) -> dict[str, Callable[..., Any]]:
    """sympy: lambdify with common subexpressions taken out, on the product as it stands."""
    import sympy as sm

    q = sm.symbols(f"q0:{chain['n']}")
    pose, jacobian = bench_rivals.product(chain["rows"], list(q), sm.cos, sm.sin, chain["modified"])
    return {
        "fk": sm.lambdify([q], sm.Matrix(3, 4, pose), modules="numpy", cse=True),
        "jacobian": sm.lambdify([q], sm.Matrix(6, chain["n"], jacobian), modules="numpy", cse=True),
        "many": sm.lambdify([q], pose, modules="numpy", cse=True),
    }


def with_casadi(chain: dict[str, Any]) -> dict[str, Any]:
    """CasADi: a function of its virtual machine."""
    import casadi as ca

    n = chain["n"]
    q = ca.SX.sym("q", n)
    pose, jacobian = bench_rivals.product(
        chain["rows"], [q[i] for i in range(n)], ca.cos, ca.sin, chain["modified"]
    )
    fk = ca.Function("fk", [q], [ca.vertcat(*pose)])
    return {
        "fk": fk,
        "jacobian": ca.Function("jacobian", [q], [ca.vertcat(*jacobian)]),
        "many": fk.map(MANY),
    }


class Pinocchio:
    """Pinocchio by its binding: the joints of the chain, the rest as placements between them."""

    def __init__(self, chain: dict[str, Any]) -> None:
        import pinocchio as pin

        self.pin = pin
        self.model = pin.Model()
        at, place = 0, pin.SE3.Identity()
        for k, row in enumerate(chain["rows"]):
            (ct, st), (ca, sa) = row["cs_theta"], row["cs_alpha"]
            about_z = np.array([[ct, -st, 0.0], [st, ct, 0.0], [0.0, 0.0, 1.0]])
            about_x = np.array([[1.0, 0.0, 0.0], [0.0, ca, -sa], [0.0, sa, ca]])
            z = pin.SE3(about_z, np.array([0.0, 0.0, row["d"]]))
            x = pin.SE3(about_x, np.array([row["a"], 0.0, 0.0]))
            place = place * x * z if chain["modified"] else place * z
            if row["variable"] is not None:
                joint = pin.JointModelRZ() if row["turns"] else pin.JointModelPZ()
                at = self.model.addJoint(at, joint, place, f"j{k}")
                place = pin.SE3.Identity()
            if not chain["modified"]:
                place = place * x
        frame = pin.Frame("tip", at, 0, place, pin.FrameType.OP_FRAME)
        self.tip = self.model.addFrame(frame)
        self.data = self.model.createData()

    def fk(self, q: np.ndarray) -> Any:
        self.pin.framesForwardKinematics(self.model, self.data, q)
        return self.data.oMf[self.tip]

    def jacobian(self, q: np.ndarray) -> Any:
        frame = self.pin.LOCAL_WORLD_ALIGNED
        return self.pin.computeFrameJacobian(self.model, self.data, q, self.tip, frame)


def rows_of(chain: dict[str, Any], module: Any, extension: Any) -> Rows:
    """Return the contestants of each row, ours first."""
    n = chain["n"]
    generator = np.random.default_rng(1)
    q = generator.uniform(-3, 3, n)
    many = generator.uniform(-3, 3, (MANY, n))
    numbers, columns = q.tolist(), [np.ascontiguousarray(column) for column in many.T]
    T, J, poses = np.empty((4, 4)), np.empty((6, n)), np.empty((MANY, 4, 4))
    rows: Rows = {
        "Python fk": {"symdh": lambda: module.fk(numbers)},
        "Python jacobian": {"symdh": lambda: module.jacobian(numbers)},
        "Python 1e5 poses": {"symdh": lambda: module.fk(many)},
    }
    hand = Hand(chain)
    rows["Python fk"]["hand numpy"] = lambda: hand.fk(q)
    rows["Python 1e5 poses"]["hand numpy"] = lambda: hand.fk(many)
    expected = hand.fk(q)[:3]

    def add(row: str, name: str, call: Call, pose: Callable[[Any], Any] | None = None) -> None:
        if pose is not None:
            found = np.asarray(pose(call())).reshape(3, 4)
            assert np.abs(found - expected).max() < 1e-9, f"{name} computes something else"
        rows[row][name] = call

    assert np.abs(module.fk(numbers)[:3] - expected).max() < 1e-9
    for name, build in (("lambdify", with_lambdify), ("casadi", with_casadi)):
        try:
            made = build(chain)
        except ImportError:
            continue
        given = numbers if name == "lambdify" else q
        together = columns if name == "lambdify" else np.ascontiguousarray(many.T)
        add("Python fk", name, lambda f=made["fk"], x=given: f(x), lambda found: found)
        add("Python jacobian", name, lambda f=made["jacobian"], x=given: f(x))
        add("Python 1e5 poses", name, lambda f=made["many"], x=together: f(x))
    try:
        pinocchio = Pinocchio(chain)
    except ImportError:
        pass
    else:
        add("Python fk", "pinocchio", lambda: pinocchio.fk(q), lambda M: M.homogeneous[:3])
        add("Python jacobian", "pinocchio", lambda: pinocchio.jacobian(q))
    if extension is not None:
        for row, name, call in (
            ("Python fk", "fk", lambda: extension.fk(q, T)),
            ("Python jacobian", "jacobian", lambda: extension.jacobian(q, J)),
            ("Python 1e5 poses", "fk", lambda: extension.fk(many, poses)),
        ):
            assert hasattr(extension, name)
            others = {k: v for k, v in rows[row].items() if k != "symdh"}
            rows[row.replace("Python", "extension")] = {"symdh": call, **others}
            rows[row]["symdh extension"] = call
    return rows


def race(contestants: dict[str, Call], rounds: int) -> dict[str, float]:
    """CPU nanoseconds of a call: the median of the best quarter of rounds, all taking turns."""
    repeats = {name: enough_calls(call) for name, call in contestants.items()}
    times: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(rounds):
        for name, call in contestants.items():
            times[name].append(seconds(call, repeats[name]) / repeats[name] * 1e9)
    best = {name: sorted(each)[: max(1, len(each) // 4)] for name, each in times.items()}
    return {name: statistics.median(each) for name, each in best.items()}


def enough_calls(call: Call) -> int:
    """Return how many calls take at least half a millisecond once they are warm."""
    count = 1
    while seconds(call, count) < 5e-4:
        count *= 2
    return count


def seconds(call: Call, count: int) -> float:
    """CPU time of some calls."""
    turns = range(count)
    start = time.thread_time()
    for _ in turns:
        call()
    return time.thread_time() - start


def main() -> None:
    """Print a JSON object: row to contestant to nanoseconds, of a call or of one of many poses."""
    folder, stem, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])
    sys.path.insert(0, folder)
    module = importlib.import_module(stem)
    try:
        extension = importlib.import_module(f"{stem}_ext")
    except ImportError:
        extension = None
    found = {}
    for row, contestants in rows_of(json.load(sys.stdin), module, extension).items():
        each = 1e5 if "1e5" in row else 1
        times = race(contestants, max(5, rounds // 6) if each > 1 else rounds)
        found[row] = {name: value / each for name, value in times.items()}
    print(json.dumps(found))


if __name__ == "__main__":
    main()
