"""The geometric Jacobian: against derivatives of the oracle's poses, and as it is printed."""

from __future__ import annotations

import functools
import json
import re
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from oracle import EXTENDED, Arithmetic, Arm, read_arm, read_arm_file
from sympy import Expr, Float, Matrix, Rational, Symbol, cos, lambdify, sin, symbols

import symdh
from symdh.derivation import velocity
from symdh.derivation.derive import derive
from symdh.derivation.style import Style
from symdh.errors import LimitError, TableError, UnsupportedError
from symdh.kinematics.frame import Frame
from symdh.kinematics.velocity import has_closed_jacobian, jacobian
from symdh.render.latex import render_latex
from symdh.render.terminal import render_chapters
from symdh.table import parse_expression, parse_point
from tools import require_tool

TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
POSES = 200
STEP = 1e-5
COMPLEX_STEP = 1e-40

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)

#: The oracle's product of elementary matrices with complex joint values: the imaginary part of
#: f(q + ih) is h times the derivative, without any difference that could cancel.
COMPLEX = Arithmetic(
    number=EXTENDED.number,
    array=lambda x: np.asarray(x, dtype=np.clongdouble),
    pi=EXTENDED.pi,
    cos=np.cos,
    sin=np.sin,
    dtype=np.clongdouble,
)


@functools.cache
def load(table: Path) -> symdh.Robot:
    return symdh.load(table)


@functools.cache
def arm_of(table: Path) -> Arm:
    return read_arm_file(table)


def table_named(name: str) -> Path:
    (table,) = (table for table in TABLES if table.stem == name)
    return table


def numbers_of(arm: Arm, q: np.ndarray) -> dict[str, Any]:
    return {name: q[..., k] for k, (name, _) in enumerate(arm.variables)}


def stacked(derivative: np.ndarray, pose: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Velocity of a point and angular velocity, from the derivative of a pose; (..., 6)."""
    linear = derivative[..., :3, 3] + derivative[..., :3, :3] @ at
    spin = derivative[..., :3, :3] @ np.swapaxes(pose[..., :3, :3], -1, -2)
    angular = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], axis=-1)
    return np.concatenate([linear, angular], axis=-1)


def expected_jacobian(
    arm: Arm,
    q: np.ndarray,
    last: Frame = "tool",
    at: Sequence[float] = (0.0, 0.0, 0.0),
    in_: Frame = "base",
) -> np.ndarray:
    """The Jacobian (..., 6, m) by complex steps of the oracle's pose."""
    columns = []
    for k in range(q.shape[-1]):
        stepped = np.array(q, dtype=np.clongdouble)
        stepped[..., k] += 1j * COMPLEX_STEP
        pose = arm.pose(numbers_of(arm, stepped), "base", last, COMPLEX)
        columns.append(stacked(pose.imag / COMPLEX_STEP, pose.real, np.array(at)))
    found = np.stack(columns, axis=-1)
    if in_ == "base":
        return found
    turn = arm.pose(numbers_of(arm, q), "base", in_)[..., :3, :3]
    back = np.swapaxes(turn, -1, -2)
    return np.concatenate([back @ found[..., :3, :], back @ found[..., 3:, :]], axis=-2)


def differenced_jacobian(arm: Arm, q: np.ndarray) -> np.ndarray:
    """The Jacobian (..., 6, m) by central differences of the oracle's pose, in plain doubles."""
    columns = []
    middle = arm.pose(numbers_of(arm, q)).astype(float)
    for k in range(q.shape[-1]):
        step = np.zeros(q.shape[-1])
        step[k] = STEP
        ahead = arm.pose(numbers_of(arm, q + step)).astype(float)
        behind = arm.pose(numbers_of(arm, q - step)).astype(float)
        columns.append(stacked((ahead - behind) / (2 * STEP), middle, np.zeros(3)))
    return np.stack(columns, axis=-1)


def evaluated(
    robot: symdh.Robot, matrix: Any, q: np.ndarray, more: dict[Symbol, Expr] | None = None
) -> np.ndarray:
    """A matrix of expressions (..., rows, columns) at joint values (..., m)."""
    exact = Matrix(matrix).xreplace({**robot.values, **(more or {})})
    function = lambdify(robot.variables, list(exact), "numpy", cse=True)
    entries = [np.broadcast_to(e, q.shape[:-1]) for e in function(*np.moveaxis(q, -1, 0))]
    return np.stack(entries, axis=-1).reshape(*q.shape[:-1], *exact.shape).astype(float)


def poses_of(table: Path) -> np.ndarray:
    return arm_of(table).seeded_poses(POSES, seed=1000 + TABLES.index(table))


def assert_close(found: np.ndarray, expected: np.ndarray, tolerance: float) -> None:
    assert found.shape == expected.shape
    scale = max(1.0, float(np.abs(expected).max()))
    assert np.abs(found - expected).max() <= tolerance * scale


@each_table
def test_the_jacobian_is_the_derivative_of_the_pose(table: Path) -> None:
    robot, arm, q = load(table), arm_of(table), poses_of(table)
    found = evaluated(robot, jacobian(robot).matrix, q)
    assert_close(found, expected_jacobian(arm, q), 1e-12)
    assert_close(found, differenced_jacobian(arm, q), 1e-6)


@each_table
def test_the_jacobian_of_any_frame_at_any_point_in_any_frame(table: Path) -> None:
    robot, arm = load(table), arm_of(table)
    q = poses_of(table)[:5]
    point, at = (Rational(1, 5), Rational(-3, 10), Rational(7, 10)), (0.2, -0.3, 0.7)
    last = robot.n
    for of, in_ in {(last, last), (1, last), (last - 1, 1)}:
        found = jacobian(robot, of, point, in_)
        assert (found.of, found.at, found.in_) == (of, point, in_)
        assert_close(
            evaluated(robot, found.matrix, q), expected_jacobian(arm, q, of, at, in_), 1e-12
        )


@each_table
def test_columns_are_cross_products_of_axis_and_lever(table: Path) -> None:
    robot = load(table)
    q = poses_of(table)[:3]
    for column in jacobian(robot).columns:
        axis, lever, linear, angular = (
            evaluated(robot, Matrix([part]), q)[..., 0, :]
            for part in (column.axis, column.lever, column.linear, column.angular)
        )
        rate = float(column.rate)
        if column.joint.type is symdh.JointType.REVOLUTE:
            assert_close(linear, rate * np.cross(axis, lever), 1e-12)
            assert_close(angular, rate * axis, 1e-12)
            terms = Matrix([[sum(pair) for pair in column.cross_terms]])
            assert_close(evaluated(robot, terms, q)[..., 0, :], linear, 1e-12)
        else:
            assert_close(linear, rate * axis, 1e-12)
            assert not angular.any()


@each_table
def test_no_float_and_no_helper_symbol_is_left(table: Path) -> None:
    robot = load(table)
    matrix = jacobian(robot).matrix
    assert not matrix.atoms(Float)
    assert matrix.free_symbols <= {*robot.variables, *robot.parameters}


def test_short_forms_come_by_construction() -> None:
    t1, t2, a1, a2 = symbols("theta1 theta2 a1 a2", real=True)
    matrix = jacobian(load(table_named("planar_2r"))).matrix
    assert list(matrix[:, 1]) == [-a2 * sin(t1 + t2), a2 * cos(t1 + t2), 0, 0, 0, 1]
    assert matrix[0, 0] == -a1 * sin(t1) - a2 * sin(t1 + t2)


def test_the_component_along_the_axis_vanishes() -> None:
    for column in jacobian(load(table_named("puma560")), in_=3).columns[1:3]:
        assert column.axis == (0, -1, 0)
        assert column.linear[1] == 0


GEARED = """
name: geared
convention: {convention}
units: {{angle: deg, length: m}}
joints:
  - {{theta: 90 deg - q1, d: 0.3, a: 0.1, alpha: 90 deg}}
  - {{theta: 2*q2 + 20 deg, d: 0, a: 0.4, alpha: 30 deg}}
  - {{theta: 0, d: 0.1 - q3, a: 0, alpha: -90 deg}}
  - {{theta: -q4/2, d: 0.2, a: 0, alpha: 0}}
base: [Tz(0.5), Rx(40 deg)]
tool: [Tx(0.1), Ry(25 deg), Tz(0.2)]
"""


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_offset_sign_and_gear_base_and_tool(convention: str) -> None:
    text = GEARED.format(convention=convention)
    robot, arm = symdh.loads(text), read_arm(text)
    q = arm.seeded_poses(50, seed=7)
    found = jacobian(robot)
    assert [column.rate for column in found.columns] == [-1, 2, -1, Rational(-1, 2)]
    assert_close(evaluated(robot, found.matrix, q), expected_jacobian(arm, q), 1e-12)


def test_a_joint_behind_the_frame_gives_zeros() -> None:
    found = jacobian(load(table_named("puma560")), of=2)
    assert [column.moves for column in found.columns] == [True, True, False, False, False, False]
    assert not any(found.matrix[:, 2:])


def test_frames_that_are_not_there_and_what_is_too_large() -> None:
    robot = load(table_named("planar_2r"))
    with pytest.raises(UnsupportedError, match="no frame 3"):
        jacobian(robot, of=3)
    rows = "\n".join(f"  - [q{i}, 1, 1, {20 + i} deg]" for i in range(1, 13))
    long = symdh.loads(
        f"name: snake\nconvention: standard\nunits: {{angle: deg, length: m}}\n"
        f"columns: [theta, d, a, alpha]\nrows:\n{rows}\n"
    )
    assert not has_closed_jacobian(long, 12, 0)
    with pytest.raises(LimitError, match="--in"):
        jacobian(long)
    assert "Velocity" not in [chapter.title for chapter in derive(long).chapters]


def test_a_jacobian_of_many_joints_is_not_written_out() -> None:
    """Parallel axes keep every entry short; it is the number of columns that is too large."""
    for count, closed in ((20, True), (21, False)):
        rows = "".join(f"  - [q{i}, 0, 1, 0]\n" for i in range(1, count + 1))
        robot = symdh.loads(
            f"name: snake\nconvention: standard\ncolumns: [theta, d, a, alpha]\nrows:\n{rows}"
        )
        assert has_closed_jacobian(robot, count, 0) == closed


@pytest.mark.parametrize(
    ("text", "point"),
    [
        ("0,0,0", (0, 0, 0)),
        (" [0, 1/2,0]", (0, Rational(1, 2), 0)),
        ("10 mm, -0.5, a2/2", (Rational(1, 100), Rational(-1, 2), Symbol("a2", real=True) / 2)),
        ("L, 0, sqrt(2)*(1 + 1)", (Symbol("L", real=True), 0, parse_expression("2*sqrt(2)"))),
    ],
)
def test_points_are_read_in_the_units_of_the_table(text: str, point: tuple[Expr, ...]) -> None:
    arm = load(table_named("planar_2r"))
    assert parse_point(text, arm.units, "--at", arm.variables) == point


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("1,2", 4, "three coordinates"),
        ("1,2,theta1", 5, "moves a joint"),
        ("1,2,30 deg", 5, "angle"),
        ("1, ,2", 4, "empty"),
        ("[1,2,3", 1, "unexpected character ["),
        ("[1,2,3],", 9, "here are 4"),
        ("1,2,3,4", 8, "here are 4"),
    ],
)
def test_what_is_no_point(text: str, column: int, message: str) -> None:
    arm = load(table_named("planar_2r"))
    with pytest.raises(TableError) as caught:
        parse_point(text, arm.units, "--at", arm.variables)
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.filename, diagnostic.line) == ("--at", 1)
    assert message in diagnostic.message
    assert diagnostic.column == column


def test_the_command_prints_what_the_function_returns(run_symdh: Runner) -> None:
    table = table_named("puma560")
    ran = run_symdh("jacobian", table, "--of", "4", "--in", "3", "--format", "json")
    assert (ran.returncode, ran.stderr) == (0, "")
    printed = json.loads(ran.stdout)
    robot, q = load(table), poses_of(table)[:5]
    matrix = Matrix([[parse_expression(e) for e in row] for row in printed["expressions"]])
    expected = expected_jacobian(arm_of(table), q, 4, in_=3)
    assert_close(evaluated(robot, matrix, q), expected, 1e-12)
    assert (printed["of"], printed["in"], printed["variables"]) == (
        *(4, 3),
        [f"theta{i}" for i in range(1, 7)],
    )
    assert printed["matrix"][1][0] == "a2*c2 + a3*c23 - d4*s23"


def test_the_command_shows_a_wide_matrix_column_by_column(run_symdh: Runner) -> None:
    ran = run_symdh("jacobian", table_named("puma560"), env={"COLUMNS": "80"})
    assert [name in ran.stdout for name in ("J₁ = ", "J₆ = ", "J = ")] == [True, True, False]
    assert max(map(len, ran.stdout.splitlines())) <= 80
    narrow = run_symdh("jacobian", table_named("planar_2r"), env={"COLUMNS": "80"})
    assert "J = ⎢" in narrow.stdout


@pytest.mark.parametrize(
    ("options", "message"),
    [(["--of", "9"], "no frame"), (["--at", "1,2"], "three"), (["--in", "x"], "no frame")],
)
def test_the_command_refuses(options: list[str], message: str, run_symdh: Runner) -> None:
    ran = run_symdh("jacobian", table_named("planar_2r"), *options)
    assert (ran.returncode, ran.stdout) == (2, "")
    assert message in ran.stderr
    assert "Traceback" not in ran.stderr


@pytest.mark.parametrize("name", ["planar_2r", "puma560", "pieper_generic", "ikbt_Issue4"])
def test_no_line_of_the_handout_is_too_long(name: str, tmp_path: Path) -> None:
    pdflatex = require_tool("pdflatex")
    document = derive(load(table_named(name)))
    assert {"Velocity", "Singularities"} <= {chapter.title for chapter in document.chapters}
    (tmp_path / "arm.tex").write_text(render_latex(document), encoding="utf-8")
    command = [pdflatex, "-interaction=nonstopmode", "-halt-on-error", "arm.tex"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=120)
    log = (tmp_path / "arm.log").read_text(encoding="utf-8", errors="replace")
    assert ran.returncode == 0, log[-2000:]
    assert re.findall(r"Overfull \\hbox \([^)]*\)", log) == []


def test_a_gear_and_a_joint_behind_the_frame_are_told() -> None:
    """J_1 = 2 (-a1 sin 2q1, a1 cos 2q1, 0, 0, 0, 1), and the second joint does not move frame 1."""
    rows = "  - [2*q1, 0, a1, 0]\n  - [q2, 0, a2, 0]\n"
    robot = symdh.loads(
        f"name: arm\nconvention: standard\ncolumns: [theta, d, a, alpha]\nrows:\n{rows}"
    )
    told = render_chapters([velocity.chapter(Style(robot), jacobian(robot, of=1), ())])
    text = " ".join(told.split())
    assert "J₁ = 2 [" in text
    assert "⎣ 2 ⎦ Joint 2 stands behind frame 1: a column of zeros." in text
    assert "τ₁ = -2 a₁ sin(2 q₁) f_x + 2 a₁ cos(2 q₁) f_y + 2 n_z τ₂ = 0" in text


def test_a_point_beside_the_origin_is_named(run_symdh: Runner) -> None:
    """At (0, 1, 0) of frame 2 the lever of joint 2 is (a2 c12 - s12, a2 s12 + c12, 0)."""
    ran = run_symdh("jacobian", table_named("planar_2r"), "--at", "0,1,0", env={"COLUMNS": "80"})
    text = " ".join(ran.stdout.split())
    assert "The point p, the point (0, 1, 0) of frame 2, moves with the linear velocity v" in text
    rows = [line for line in ran.stdout.splitlines() if line.rstrip().endswith(("⎤", "⎥", "⎦"))]
    second = [line.strip(" ⎤⎥⎦").rpartition("  ")[2] for line in rows[-6:]]
    assert second == ["-(c₁₂ + a₂ s₁₂)", "a₂ c₁₂ - s₁₂", "0", "0", "0", "1"]


def test_short_forms_of_the_jacobian_alone_are_introduced() -> None:
    """Along frame 1 the lever of joint 1 holds c_23, which neither the links nor the pose have."""
    robot = load(table_named("planar_3r"))
    style, forward = Style(robot), symdh.forward_kinematics(robot)
    assert forward.pose is not None
    known = [style.notation.matrix(matrix) for matrix in (*forward.links, forward.pose)]
    for frame, told in ((0, False), (1, True)):
        made = velocity.chapter(style, jacobian(robot, 3, in_=frame), known)
        text = " ".join(render_chapters([made]).split())
        assert ("Here c₂₃ = cos(θ₂ + θ₃) and s₂₃ = sin(θ₂ + θ₃)." in text) is told


def test_statics_are_the_transpose() -> None:
    text = render_latex(derive(load(table_named("planar_2r"))), fragment=True)
    assert r"= -a_{2} s_{12} f_{x} + a_{2} c_{12} f_{y} + n_{z}" in text
