"""The worked examples of the lectures, typed from their pages: the same matrices, the same form.

Each `examples/*.yaml` named here is an arm of a lecture. Its link transforms are given below as
rows of a table and multiplied out by hand (`link_standard`, `link_modified` are the matrices that
the lectures print), so that nothing here asks symdh what to expect.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from oracle import read_arm
from sympy import (
    Expr,
    ImmutableMatrix,
    Matrix,
    S,
    Symbol,
    cos,
    exp,
    expand,
    eye,
    pi,
    sin,
    symbols,
)

import symdh
from symdh.table import parse_expression

EXAMPLES = Path(__file__).parent.parent / "examples"

t1, t2, t3, t4, t5 = symbols("theta1:6", real=True)
q1, q2, q3, q4 = symbols("q1:5", real=True)
a1, a2, d1, d3, d4 = symbols("a1 a2 d1 d3 d4", real=True)
L1, L2 = symbols("L1 L2", real=True)

Row = tuple[Any, Any, Any, Any]


def link_standard(theta: Expr, d: Expr, a: Expr, alpha: Expr) -> Matrix:
    """The general link transform that lecture 002 prints."""
    ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return Matrix(
        [
            [ct, -st * ca, st * sa, a * ct],
            [st, ct * ca, -ct * sa, a * st],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def link_modified(theta: Expr, d: Expr, a: Expr, alpha: Expr) -> Matrix:
    """The general link transform that lecture 001 prints; a and alpha are those of link i-1."""
    ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return Matrix(
        [
            [ct, -st, 0, a],
            [st * ca, ct * ca, -sa, -sa * d],
            [st * sa, ct * sa, ca, ca * d],
            [0, 0, 0, 1],
        ]
    )


NO_TOOL = ImmutableMatrix.eye(4)


@dataclass(frozen=True)
class Lecture:
    """An arm of a lecture: its rows (theta, d, a, alpha), and the pose it must come to.

    `form` is the matrix as symdh writes it with c12 for cos(theta1 + theta2).
    """

    example: str
    link: Callable[..., Matrix]
    rows: Sequence[Row]
    pose: Matrix
    form: list[list[str]]
    tool: Matrix = NO_TOOL

    def transform(self, i: int, j: int) -> Matrix:
        product = eye(4)
        for row in self.rows[i:j]:
            product = product * self.link(*(S(entry) for entry in row))
        return product


BOTTOM = ["0", "0", "0", "1"]
QUARTER = pi / 2

# 000, 002: the planar arm with two revolute joints.
PLANAR = Matrix(
    [
        [cos(t1 + t2), -sin(t1 + t2), 0, a1 * cos(t1) + a2 * cos(t1 + t2)],
        [sin(t1 + t2), cos(t1 + t2), 0, a1 * sin(t1) + a2 * sin(t1 + t2)],
        [0, 0, 1, 0],
        [0, 0, 0, 1],
    ]
)
PLANAR_FORM = [
    ["c12", "-s12", "0", "a1*c1 + a2*c12"],
    ["s12", "c12", "0", "a1*s1 + a2*s12"],
    ["0", "0", "1", "0"],
    BOTTOM,
]
PLANAR_2R = Lecture(
    "planar_2r", link_standard, [(t1, 0, a1, 0), (t2, 0, a2, 0)], PLANAR, PLANAR_FORM
)

# 001: the same arm in the modified convention; the second length is the tool's.
PLANAR_2R_MODIFIED = Lecture(
    "planar_2r_modified",
    link_modified,
    [(t1, 0, 0, 0), (t2, 0, a1, 0)],
    PLANAR,
    PLANAR_FORM,
    tool=Matrix([[1, 0, 0, a2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
)

# 001: two revolute joints and a prismatic one.
REACH = a2 * cos(t2) + d3 * sin(t2)
RRP_MODIFIED = Lecture(
    "rrp_modified",
    link_modified,
    [(t1, 0, 0, 0), (t2, 0, 0, QUARTER), (0, d3, a2, QUARTER)],
    Matrix(
        [
            [cos(t1) * cos(t2), sin(t1), cos(t1) * sin(t2), cos(t1) * REACH],
            [sin(t1) * cos(t2), -cos(t1), sin(t1) * sin(t2), sin(t1) * REACH],
            [sin(t2), 0, -cos(t2), a2 * sin(t2) - d3 * cos(t2)],
            [0, 0, 0, 1],
        ]
    ),
    [
        ["c1*c2", "s1", "c1*s2", "c1*(a2*c2 + d3*s2)"],
        ["s1*c2", "-c1", "s1*s2", "s1*(a2*c2 + d3*s2)"],
        ["s2", "0", "-c2", "a2*s2 - d3*c2"],
        BOTTOM,
    ],
)

# 002: SCARA, d1 and d4 constant, the last twist 180 degrees.
Q124 = q1 + q2 + q4
SCARA = Lecture(
    "scara",
    link_standard,
    [(q1, d1, a1, 0), (q2, 0, a2, 0), (0, q3, 0, 0), (q4, d4, 0, pi)],
    Matrix(
        [
            [cos(Q124), sin(Q124), 0, a1 * cos(q1) + a2 * cos(q1 + q2)],
            [sin(Q124), -cos(Q124), 0, a1 * sin(q1) + a2 * sin(q1 + q2)],
            [0, 0, -1, d1 + q3 + d4],
            [0, 0, 0, 1],
        ]
    ),
    [
        ["c124", "s124", "0", "a1*c1 + a2*c12"],
        ["s124", "-c124", "0", "a1*s1 + a2*s12"],
        ["0", "0", "-1", "d1 + q3 + d4"],
        BOTTOM,
    ],
)

# 004: MiniMover. The lecture gives the table; since Rx(-90) Rz(t) Rx(90) = Ry(t), the pose is
# Rz(t1) Ry(t2 + t3 + t4) Rz(t5), and the elbow lies in the plane that t1 turns.
C1, S1, C5, S5 = cos(t1), sin(t1), cos(t5), sin(t5)
C234, S234 = cos(t2 + t3 + t4), sin(t2 + t3 + t4)
OUT = L1 * cos(t2) + L2 * cos(t2 + t3)
MINIMOVER = Lecture(
    "minimover_5r",
    link_standard,
    [(t1, 0, 0, -QUARTER), (t2, 0, L1, 0), (t3, 0, L2, 0), (t4, 0, 0, QUARTER), (t5, 0, 0, 0)],
    Matrix(
        [
            [
                C1 * C234 * C5 - S1 * S5,
                -C1 * C234 * S5 - S1 * C5,
                C1 * S234,
                C1 * OUT,
            ],
            [
                S1 * C234 * C5 + C1 * S5,
                -S1 * C234 * S5 + C1 * C5,
                S1 * S234,
                S1 * OUT,
            ],
            [-S234 * C5, S234 * S5, C234, -L1 * sin(t2) - L2 * sin(t2 + t3)],
            [0, 0, 0, 1],
        ]
    ),
    # The lecture prints no form for this pose. The signs follow the rules of symdh's notation: a
    # positive term stands first, and a minus common to all terms goes before a bracket.
    [
        ["c1*c234*c5 - s1*s5", "-(c1*c234*s5 + s1*c5)", "c1*s234", "c1*(L1*c2 + L2*c23)"],
        ["s1*c234*c5 + c1*s5", "c1*c5 - s1*c234*s5", "s1*s234", "s1*(L1*c2 + L2*c23)"],
        ["-s234*c5", "s234*s5", "c234", "-(L1*s2 + L2*s23)"],
        BOTTOM,
    ],
)

LECTURES = (PLANAR_2R, PLANAR_2R_MODIFIED, RRP_MODIFIED, SCARA, MINIMOVER)
each_lecture = pytest.mark.parametrize("lecture", LECTURES, ids=lambda lecture: lecture.example)


def load(lecture: Lecture) -> symdh.Robot:
    return symdh.load(EXAMPLES / f"{lecture.example}.yaml")


def assert_same(matrix: Matrix, expected: Matrix) -> None:
    """Equal as functions: as polynomials in exp(i theta), which have one form only, they agree."""
    difference = (Matrix(matrix) - expected).applyfunc(lambda x: expand(x.rewrite(exp)))
    assert difference == Matrix.zeros(4, 4)


@each_lecture
def test_the_pages_agree_with_themselves(lecture: Lecture) -> None:
    """The pose typed above is the product of the lecture's own link transforms."""
    assert_same(lecture.transform(0, len(lecture.rows)) * lecture.tool, lecture.pose)


@each_lecture
def test_the_pose_is_the_lectures(lecture: Lecture) -> None:
    assert_same(load(lecture).T(), lecture.pose)


@each_lecture
def test_each_link_transform_is_the_lectures(lecture: Lecture) -> None:
    robot = load(lecture)
    assert robot.n == len(lecture.rows)
    for i in range(1, robot.n + 1):
        assert_same(robot.A(i), lecture.transform(i - 1, i))


@each_lecture
def test_transforms_between_all_frames(lecture: Lecture) -> None:
    """Lecture 002: a product for i < j, the identity for i = j, the inverse for i > j."""
    robot = load(lecture)
    for i in range(robot.n + 1):
        assert robot.T(i, i) == eye(4)
        for j in range(i + 1, robot.n + 1):
            forward = lecture.transform(i, j)
            assert_same(robot.T(i, j), forward)
            assert_same(robot.T(j, i) * forward, eye(4))


@each_lecture
def test_the_form_is_the_lectures(lecture: Lecture, run_symdh: Runner) -> None:
    shown = show_json(run_symdh, lecture)
    assert shown["matrix"] == lecture.form


@each_lecture
def test_the_long_form_reads_back(lecture: Lecture, run_symdh: Runner) -> None:
    shown = show_json(run_symdh, lecture)
    read = Matrix([[parse_expression(text) for text in row] for row in shown["expressions"]])
    assert read == load(lecture).T()


def show_json(run_symdh: Runner, lecture: Lecture, *options: str) -> dict[str, Any]:
    table = EXAMPLES / f"{lecture.example}.yaml"
    ran = run_symdh("show", table, "--format", "json", *options)
    assert (ran.returncode, ran.stderr) == (0, "")
    return dict(json.loads(ran.stdout))


def test_show_names_its_frames_and_gives_each_link(run_symdh: Runner) -> None:
    """001: the three matrices before the product."""
    pages = {
        ("0", "1"): [["c1", "-s1", "0", "0"], ["s1", "c1", "0", "0"], ["0", "0", "1", "0"], BOTTOM],
        ("1", "2"): [
            ["c2", "-s2", "0", "a1"],
            ["s2", "c2", "0", "0"],
            ["0", "0", "1", "0"],
            BOTTOM,
        ],
        ("2", "tool"): [
            ["1", "0", "0", "a2"],
            ["0", "1", "0", "0"],
            ["0", "0", "1", "0"],
            BOTTOM,
        ],
    }
    for (start, end), form in pages.items():
        shown = show_json(run_symdh, PLANAR_2R_MODIFIED, "--from", start, "--to", end)
        assert shown["matrix"] == form
        assert str(shown["from"]) == start
        assert str(shown["to"]) == end


# 001: a1 = 6 cm, a2 = 9 cm, 60 and 45 degrees, to the digits that the lecture prints.
NUMBERS = [
    [-0.2588, -0.9659, 0, 0.6706],
    [0.9659, -0.2588, 0, 13.889],
    [0, 0, 1, 0],
    [0, 0, 0, 1],
]
PRINTED_DIGITS = [[5e-5, 5e-5, 0, 5e-5], [5e-5, 5e-5, 0, 5e-4], [0] * 4, [0] * 4]


def test_the_numbers_of_the_modified_arm(run_symdh: Runner) -> None:
    table = EXAMPLES / "planar_2r_modified.yaml"
    ran = run_symdh("eval", table, "--format", "json")
    assert (ran.returncode, ran.stderr) == (0, "")
    matrix = np.array(json.loads(ran.stdout)["matrix"])
    assert np.all(np.abs(matrix - NUMBERS) <= PRINTED_DIGITS)


def test_the_oracle_gives_the_numbers_of_the_lecture_too() -> None:
    arm = read_arm(
        """
        convention: modified
        units: {length: cm}
        joints:
          - {theta: theta1, d: 0, a: 0, alpha: 0}
          - {theta: theta2, d: 0, a: a1, alpha: 0}
        tool: [Tx(a2)]
        values: {a1: 6 cm, a2: 0.09 m}
        """
    )
    pose = arm.pose({"theta1": np.radians(60), "theta2": np.radians(45)})
    assert np.all(np.abs(pose - NUMBERS) <= PRINTED_DIGITS)


@pytest.mark.parametrize("name", ["c234", "s234"])
def test_minimover_turns_by_the_sum_of_its_parallel_joints(name: str, run_symdh: Runner) -> None:
    shown = show_json(run_symdh, MINIMOVER)
    assert name in json.dumps(shown["matrix"])


def test_joint_variables_of_the_lectures() -> None:
    names = {lecture.example: load(lecture).variables for lecture in LECTURES}
    assert names == {
        "planar_2r": (t1, t2),
        "planar_2r_modified": (t1, t2),
        "rrp_modified": (t1, t2, d3),
        "scara": (q1, q2, q3, q4),
        "minimover_5r": (t1, t2, t3, t4, t5),
    }
    assert all(isinstance(symbol, Symbol) for row in names.values() for symbol in row)
