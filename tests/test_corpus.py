"""Every table of the corpus: derived, rendered, generated, compiled, and right to the last bits."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from generated import compile_generated, import_generated
from oracle import FIFTY_DIGITS, Arm, read_arm_file, rigid_inverse
from sympy import Expr, Float, Rational, Symbol, cos, count_ops, eye, sin

import symdh
from symdh.codegen import generate
from symdh.derivation.derive import derive
from symdh.render.latex import render_latex

TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
POSES = 1000
EXACT_POSES = 3

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)


@functools.cache
def load(table: Path) -> symdh.Robot:
    return symdh.load(table)


@functools.cache
def arm_of(table: Path) -> Arm:
    return read_arm_file(table)


@functools.cache
def poses_of(table: Path) -> tuple[np.ndarray, np.ndarray]:
    """Seeded joint values (1000, n), and the oracle's poses for them (1000, 4, 4)."""
    arm = arm_of(table)
    q = arm.seeded_poses(POSES, seed=TABLES.index(table))
    return q, arm.pose(named(arm, q))


def named(arm: Arm, q: np.ndarray) -> dict[str, Any]:
    """Joint values (..., n) by the names of the joint variables."""
    return {name: q[..., k] for k, (name, _) in enumerate(arm.variables)}


def test_the_corpus_is_whole() -> None:
    assert len(TABLES) == 47


@each_table
def test_rows_and_variables_are_those_of_the_table(table: Path) -> None:
    robot, arm = load(table), arm_of(table)
    assert robot.n == arm.n
    assert [symbol.name for symbol in robot.variables] == [name for name, _ in arm.variables]
    assert {symbol.name for symbol in robot.values} == set(arm.values)


@each_table
def test_the_derivation_renders_as_latex(table: Path) -> None:
    text = render_latex(derive(load(table)))
    assert text.index(r"\documentclass") < text.index(r"\begin{document}")
    assert text.rstrip().endswith(r"\end{document}")
    opened: list[str] = []
    for command, environment in re.findall(r"\\(begin|end)\{([^}]*)\}", text):
        if command == "begin":
            opened.append(environment)
        else:
            assert opened.pop() == environment
    assert opened == []
    bare = re.sub(r"\\[\\{}]", "", text)
    assert bare.count("{") == bare.count("}")


@each_table
def test_generated_python_agrees_with_the_oracle(table: Path, tmp_path: Path) -> None:
    module = import_generated(generate(load(table), "python"), tmp_path)
    q, expected = poses_of(table)
    assert_poses_agree(module.fk(q), expected, arm_of(table))


@each_table
def test_generated_c_agrees_with_the_oracle(table: Path, tmp_path: Path) -> None:
    q, expected = poses_of(table)
    fk = compile_generated(generate(load(table), "c"), tmp_path, n=q.shape[-1])
    assert_poses_agree(fk(q), expected, arm_of(table))


@each_table
def test_the_exact_pose_agrees_with_the_oracle(table: Path) -> None:
    robot, arm = load(table), arm_of(table)
    for q in poses_of(table)[0][:EXACT_POSES]:
        numbers = named(arm, q)
        expected = arm.pose(numbers, arithmetic=FIFTY_DIGITS)
        assert_exact_pose_agrees(robot, robot.T(), numbers, expected)


@each_table
def test_exact_transforms_between_any_two_frames(table: Path) -> None:
    robot, arm = load(table), arm_of(table)
    numbers = named(arm, poses_of(table)[0][0])
    last = robot.n
    for i, j in {(0, 1), (0, last), (1, last), (last - 1, last)} - {(last, last)}:
        expected = arm.pose(numbers, i, j, arithmetic=FIFTY_DIGITS)
        assert_exact_pose_agrees(robot, robot.T(i, j), numbers, expected)
        assert_exact_pose_agrees(robot, robot.T(j, i), numbers, rigid_inverse(expected))
    for i in range(last + 1):
        assert robot.T(i, i) == eye(4)


@each_table
def test_nothing_exact_holds_a_float(table: Path) -> None:
    robot = load(table)
    for matrix in (robot.T(), robot.T(robot.n, 0), *(robot.A(i + 1) for i in range(robot.n))):
        assert not matrix.atoms(Float)
    assert not any(value.atoms(Float) for value in robot.values.values())


@pytest.mark.parametrize(("name", "limit"), [("puma560", 278), ("ur5", 227), ("kuka_iiwa7", 812)])
def test_the_whole_pose_is_short(name: str, limit: int) -> None:
    pose = load(table_named(name)).T()
    assert sum(count_ops(pose[i, j]) for i in range(3) for j in range(4)) <= limit


@pytest.mark.parametrize(
    ("name", "joints"), [("puma560", (2, 3)), ("ur5", (2, 3)), ("ur5", (2, 3, 4))]
)
def test_parallel_joints_turn_by_their_sum(name: str, joints: tuple[int, ...]) -> None:
    robot = load(table_named(name))
    total = sum((robot.variables[k - 1] for k in joints), start=Rational(0))
    assert {cos(total), sin(total)} <= robot.T().atoms(cos, sin)


def table_named(name: str) -> Path:
    (table,) = (table for table in TABLES if table.stem == name)
    return table


def assert_poses_agree(poses: np.ndarray, expected: np.ndarray, arm: Arm) -> None:
    assert poses.shape == expected.shape
    assert poses.dtype == np.float64
    assert np.abs(poses - expected).max() <= arm.tolerance()


def assert_exact_pose_agrees(
    robot: symdh.Robot, matrix: Any, numbers: Mapping[str, float], expected: Any
) -> None:
    """Put the numbers into an exact matrix, to 30 digits, and compare."""
    exact: dict[Symbol, Expr] = dict(robot.values)
    exact |= {symbol: Rational(float(numbers[symbol.name])) for symbol in robot.variables}
    scale = max(1, *(abs(expected[i, 3]) for i in range(3)))
    with mpmath.workdps(40):
        for i, j in np.ndindex(4, 4):
            entry = mpmath.mpf(matrix[i, j].evalf(30, subs=exact)._to_mpmath(100))
            assert abs(entry - mpmath.mpf(expected[i, j])) < scale * mpmath.mpf("1e-24")
