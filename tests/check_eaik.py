"""As many answers as EAIK gives, for the arms with six joints that turn.

EAIK (Ostermeier, Kuelz & Althoff 2025) decomposes an arm geometrically and shares nothing with
symdh. It is no dependency: run this with a Python that has it, or let the script make one in a
folder for scratch. Its answers are filtered by the oracle's poses, and merged where they are alike.

    python tests/check_eaik.py [POSES]
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from inverse_code import Loaded, load

DATA = Path(__file__).parent / "data"
#: Run by the Python that has EAIK: arms as axes and points, poses; answers come back.
ASKED = """
import json, sys, time
import numpy as np
from eaik.IK_HP import HPRobot
asked = json.load(sys.stdin)
robot = HPRobot(np.array(asked["axes"]), np.array(asked["points"]))
poses = [np.array(pose) for pose in asked["poses"]]
answers = [robot.IK(pose) for pose in poses]
best = float("inf")
for _ in range(asked["rounds"]):
    begin = time.perf_counter()
    robot.IK_batched(poses, 1)
    best = min(best, (time.perf_counter() - begin) / len(poses))
print(json.dumps({
    "q": [np.asarray(one.Q).tolist() for one in answers],
    "least_squares": [np.asarray(one.is_LS).tolist() for one in answers],
    "seconds": best,
}))
"""


def python_with_eaik() -> str | None:
    """A Python that has EAIK; None, with a line that says why, where it cannot be had."""
    for python in (sys.executable, str(_scratch() / "bin" / "python")):
        if Path(python).exists() and _has_eaik(python):
            return python
    made = subprocess.run([sys.executable, "-m", "venv", _scratch()], check=False)
    python = str(_scratch() / "bin" / "python")
    if made.returncode == 0:
        subprocess.run([python, "-m", "pip", "install", "--quiet", "EAIK"], check=False)
        if _has_eaik(python):
            return python
    print("EAIK is not there and does not install: nothing is compared with it", file=sys.stderr)
    return None


def _scratch() -> Path:
    return Path(tempfile.gettempdir()) / "symdh-eaik"


def _has_eaik(python: str) -> bool:
    tried = subprocess.run([python, "-c", "import eaik.IK_HP"], capture_output=True, check=False)
    return tried.returncode == 0


def geometry(arm: Loaded) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Axes (n, 3) and offsets (n + 1, 3) with all joints at zero, and the pose there."""
    zero = {name: np.zeros(1) for name, _ in arm.arm.variables}
    standard = arm.arm.convention == "standard"
    rows = [k for k, row in enumerate(arm.arm.rows) if _moves(arm, row)]
    frames = [np.asarray(arm.arm.pose(zero, "base", k if standard else k + 1))[0] for k in rows]
    end = arm.pose(np.zeros((1, len(arm.turns))))[0]
    axes = np.array([frame[:3, 2] for frame in frames], dtype=float)
    places = [np.zeros(3), *(frame[:3, 3] for frame in frames), end[:3, 3]]
    return axes, np.diff(np.array(places, dtype=float), axis=0), end


def _moves(arm: Loaded, row: dict[str, str]) -> bool:
    return any(name in row["theta"] for name, _ in arm.arm.variables)


def ask(python: str, arm: Loaded, poses: np.ndarray, rounds: int = 0) -> dict[str, Any]:
    """What EAIK says of some poses."""
    axes, points, end = geometry(arm)
    # Its hand is not turned where all joints are at zero.
    turned = poses.copy()
    turned[:, :3, :3] = poses[:, :3, :3] @ end[:3, :3].T
    asked = {
        "axes": axes.tolist(),
        "points": points.tolist(),
        "poses": turned.tolist(),
        "rounds": rounds,
    }
    ran = subprocess.run(
        [python, "-c", ASKED], input=json.dumps(asked), capture_output=True, text=True, check=False
    )
    if ran.returncode:
        raise RuntimeError(ran.stderr.strip().splitlines()[-1])
    found: dict[str, Any] = json.loads(ran.stdout.splitlines()[-1])
    return found


def kept(arm: Loaded, answers: Any, goal: np.ndarray, tolerance: float = 1e-6) -> list[Any]:
    """Answers that reach a goal, each once."""
    found: list[Any] = []
    for q in np.asarray(answers, dtype=float).reshape(-1, len(arm.turns)):
        near = arm.missed_by([q], goal) <= tolerance
        if near and all(arm.apart(q, other) > 1e-4 for other in found):
            found.append(q)
    return found


def six_turning() -> list[Path]:
    """The tables with a closed form and six joints that turn."""
    entries = yaml.safe_load((DATA / "index.yaml").read_text())
    return [
        DATA / "tables" / f"{entry['name']}.yaml"
        for entry in entries
        if entry["structure"] == "RRRRRR" and entry["expect"]["closed_form"]
    ]


def main() -> int:
    """Print a line a table; 1 where a count differs for the worse."""
    poses = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    python = python_with_eaik()
    if python is None:
        return 0
    worse = 0
    print(f"{'table':24} poses  equal  symdh has more  EAIK has more")
    for table in six_turning():
        with tempfile.TemporaryDirectory() as folder:
            arm = load(table, Path(folder))
            q = arm.arm.seeded_poses(poses, seed=17)
            goals = arm.pose(q)
            try:
                theirs = ask(python, arm, goals)["q"]
            except RuntimeError as error:
                print(f"{table.stem:24} EAIK: {error}")
                continue
            more = less = 0
            for goal, answers in zip(goals, theirs, strict=True):
                difference = len(arm.c(goal)[0]) - len(kept(arm, answers, goal))
                more += difference > 0
                less += difference < 0
            worse += less
            print(f"{table.stem:24} {poses:5} {poses - more - less:6} {more:15} {less:14}")
    return 1 if worse else 0


if __name__ == "__main__":
    raise SystemExit(main())
