"""URDF files that others have written, against a URDF reader that others have written.

Not a test of the suite, for it wants packages that symdh does not need; in an environment of its
own:

    python -m venv env
    env/bin/pip install . yourdfpy rtb-data example-robot-data
    env/bin/pip install --no-deps manipulapy
    env/bin/pip install roboticstoolbox-python    # optional, for the export to it
    env/bin/python tests/check_urdf.py

Every arm below is imported in both conventions and compared with yourdfpy's forward kinematics at
100 random joint values; every table of the corpus is exported and read back by yourdfpy, and by
the Robotics Toolbox where that is installed. The status is 1 when a difference is too large or an
arm is missing.
"""

from __future__ import annotations

import importlib.util
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from oracle import METRES, Arm, read_arm, read_arm_file
from sympy import Rational

import symdh
from symdh.frames.residual import residual
from symdh.frames.urdf_chain import table_of_chain
from symdh.render.interchange import export
from symdh.render.table_yaml import table_yaml
from symdh.robot import Convention
from symdh.table.source import read_source
from symdh.table.urdf import read_urdf_chain

POSES = 100
NEAR = Rational(1, 100_000)
#: yourdfpy computes in double precision; decimals such as 1.5708 are off by up to 1e-5 each.
ROUNDING = 1e-13
SNAPPED = 1e-4

DATA = Path(__file__).parent / "data" / "tables"
TOOLBOX = "rtbdata", "rtbdata/xacro"
MANIPULA = "ManipulaPy", "ManipulaPy/ManipulaPy_data"
EXAMPLES = "cmeel.prefix", "cmeel.prefix/share/example-robot-data/robots"

#: Arm, where its file is, base and tip.
ARMS = [
    ("ABB IRB 140", TOOLBOX, "abb_irb140_description/urdf/irb140.urdf", "base_link", "tool0"),
    ("ABB IRB 2400", MANIPULA, "abb/irb2400.urdf", "base_link", "tool0"),
    ("Fanuc CRX-10iA/L", MANIPULA, "fanuc_crx/crx10ia_l.urdf", "base_link", "flange"),
    ("Fanuc M-16iB", MANIPULA, "fanuc/m16ib.urdf", "base_link", "tool0"),
    ("Franka Panda", MANIPULA, "franka_panda/panda.urdf", "panda_link0", "panda_hand"),
    ("Kinova Gen3", MANIPULA, "kinova/gen3/gen3.urdf", "base_link", "EndEffector_Link"),
    ("Kinova Jaco", MANIPULA, "kinova/jaco/jaco_6dof.urdf", "world", "j2s6s300_end_effector"),
    ("Kuka iiwa 7", MANIPULA, "kuka_iiwa/iiwa7/iiwa7.urdf", "world", "iiwa_link_ee"),
    ("Kuka KR 16", TOOLBOX, "kuka_description/kuka_kr16/urdf/kr16_2.urdf", "base_link", "tool0"),
    (
        "Kuka KR 210",
        TOOLBOX,
        "kuka_description/kuka_kr210/urdf/kr210l150.urdf",
        "base_link",
        "tool0",
    ),
    (
        "PUMA 560",
        TOOLBOX,
        "unimation_puma560_description/urdf/puma560_robot.urdf",
        "link1",
        "link7",
    ),
    (
        "Lynxmotion AL5D",
        TOOLBOX,
        "lynxmotion_al5d_description/urdf/al5d_robot.urdf",
        "base",
        "link4",
    ),
    ("UR5", MANIPULA, "universal_robots/ur5/ur5.urdf", "base_link", "tool0"),
    ("UR10e", MANIPULA, "universal_robots/ur10e/ur10e.urdf", "base_link", "tool0"),
    ("UFactory xArm 6", MANIPULA, "xarm/xarm6_robot.urdf", "world", "link6"),
    (
        "Baxter, left arm",
        EXAMPLES,
        "baxter_description/urdf/baxter.urdf",
        "torso",
        "left_hand_link",
    ),
    ("Tiago, arm", EXAMPLES, "tiago_description/robots/tiago.urdf", "base_link", "arm_tool_link"),
]


def main() -> int:
    import yourdfpy

    bad = 0
    for name, (package, folder), path, base, tip in ARMS:
        file = find(package, folder, path)
        if file is None:
            print(f"{name:17} missing: {path}")
            bad += 1
            continue
        bad += check_arm(yourdfpy, name, file, base, tip)
    bad += check_exports(yourdfpy)
    if importlib.util.find_spec("roboticstoolbox") is not None:
        bad += check_toolbox()
    print("all agree" if not bad else f"{bad} do not agree")
    return int(bad > 0)


def find(package: str, folder: str, path: str) -> Path | None:
    """Find a data file among the installed packages without importing any."""
    for site in map(Path, sys.path):
        if (site / package).is_dir() and (site / folder / path).is_file():
            return site / folder / path
    return None


def check_arm(yourdfpy: Any, name: str, file: Path, base: str, tip: str) -> int:
    urdf = yourdfpy.URDF.load(
        str(file), build_scene_graph=True, load_meshes=False, build_collision_scene_graph=False
    )
    chain = read_urdf_chain(read_source(str(file)), (base, tip), NEAR)
    bad = 0
    for convention in Convention:
        found = table_of_chain(chain, convention, NEAR)
        arm = read_arm(table_yaml(found.robot))
        q = arm.seeded_poses(POSES, seed=1)
        expected = poses_of(urdf, found.joint_names, q, base, tip)
        there = arm.pose({v: q[:, k] for k, (v, _) in enumerate(arm.variables)})
        off = float(np.abs(there - expected).max())
        said = residual(chain, found.robot)
        limit = SNAPPED if chain.snaps or found.snaps else ROUNDING
        agrees = off <= limit and off <= 3 * max(said.position, said.rotation) + ROUNDING
        bad += not agrees
        print(
            f"{name:17} {convention.value:8} {len(found.joint_names)} joints, "
            f"off by {off:.1e}, residual printed {said.position:.1e} m {said.rotation:.1e} rad, "
            f"{sum(snap.count for snap in chain.snaps)} decimals and {len(found.snaps)} axes "
            f"snapped{'' if agrees else '  FAILS'}"
        )
    return bad


def poses_of(urdf: Any, names: tuple[str, ...], q: np.ndarray, base: str, tip: str) -> np.ndarray:
    """Poses of the tip in the base by the other reader; joints off the chain stay at zero."""
    poses = []
    for values in q:
        given = dict.fromkeys(urdf.actuated_joint_names, 0.0)
        given |= dict(zip(names, map(float, values), strict=True))
        urdf.update_cfg(given)
        poses.append(urdf.get_transform(tip, base))
    return np.array(poses)


def tables() -> Iterator[tuple[Path, Arm, np.ndarray, np.ndarray]]:
    """Yield each table with joint values in SI units and the oracle's poses in metres."""
    for path in sorted(DATA.glob("*.yaml")):
        arm = read_arm_file(path)
        metre = float(METRES[arm.length])
        q = arm.seeded_poses(POSES, seed=2)
        poses = np.array(arm.pose({v: q[:, k] for k, (v, _) in enumerate(arm.variables)}))
        poses[:, :3, 3] *= metre
        yield path, arm, q * [1.0 if turns else metre for _, turns in arm.variables], poses


def check_exports(yourdfpy: Any) -> int:
    def fk(path: Path, arm: Arm, q: np.ndarray) -> np.ndarray:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "arm.urdf"
            file.write_text(export(symdh.load(path), "urdf").text)
            urdf = yourdfpy.URDF.load(str(file), load_meshes=False)
        assert urdf.validate()
        names = tuple(name for name, _ in arm.variables)
        return poses_of(urdf, names, q, "base_link", "tool0")

    return compare("URDF, read by yourdfpy", fk)


def check_toolbox() -> int:
    def fk(path: Path, arm: Arm, q: np.ndarray) -> np.ndarray:
        scope: dict[str, Any] = {}
        source = export(symdh.load(path), "rtb").text
        exec(compile(source, path.name, "exec"), scope)
        robot = scope[path.stem]()
        return np.array([robot.fkine(values).A for values in q])

    return compare("DHRobot, run by the Robotics Toolbox", fk)


def compare(what: str, fk: Callable[[Path, Arm, np.ndarray], np.ndarray]) -> int:
    worst, bad, count = 0.0, 0, 0
    for path, arm, q, expected in tables():
        off = float(np.abs(fk(path, arm, q) - expected).max())
        off /= max(1.0, arm.reach() * float(METRES[arm.length]))
        worst, count = max(worst, off), count + 1
        if not off <= ROUNDING:
            print(f"{path.stem}: {what} is off by {off:.1e}  FAILS")
            bad += 1
    print(f"{what}: {count} tables, off by {worst:.1e} of the reach at most")
    return bad


if __name__ == "__main__":
    sys.exit(main())
