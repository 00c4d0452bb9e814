"""Generated Python beyond one pose: many at a time, large angles, other array namespaces."""

from __future__ import annotations

import ast
import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import array_api_strict
import numpy as np
import pytest
from generated import import_generated
from oracle import EPSILON, EXTENDED, Arm, read_arm_file
from sympy import Integer
from test_codegen import (
    FORMULAS,
    PLANAR,
    PUMA,
    Q1,
    Q2,
    SCARA,
    STANDARD,
    STILL_NUMBERS,
    TWISTED,
    parameter_numbers,
    prismatic,
    revolute,
)
from test_codegen_jacobian import TABLES, columns_from_axes, named

import symdh
from symdh.codegen import generate
from symdh.robot import Robot

FUNCTIONS = ("fk", "jacobian", "fk_jacobian")
SUMMED = [table for table in TABLES if table.stem in ("puma560", "ur5", "planar_3r", "scara_rrpr")]


def module_of(robot: Robot, folder: Path) -> ModuleType:
    return import_generated(generate(robot, "python"), folder)


def required(robot: Robot) -> dict[str, float]:
    numbers = parameter_numbers(robot)
    return {p.name: numbers[p] for p in robot.parameters if p not in robot.values}


def joints_of(robot: Robot, *shape: int) -> np.ndarray:
    return np.random.default_rng(3).uniform(-3.0, 3.0, (*shape, len(robot.variables)))


def flat(result: Any) -> list[Any]:
    """The matrices that a function returns, in a list."""
    return list(result) if isinstance(result, tuple) else [result]


# ------------------------------------------------------------------------------- one pose or many


@pytest.mark.parametrize("robot", [PUMA, SCARA, TWISTED, FORMULAS], ids=lambda robot: robot.name)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_one_pose_is_what_it_is_among_many(name: str, robot: Robot, tmp_path: Path) -> None:
    """A list, a tuple, an array of one pose and any place of a batch agree up to rounding."""
    function = getattr(module_of(robot, tmp_path), name)
    given = required(robot)
    q = joints_of(robot, 2 * 4096 + 5)
    many = flat(function(q, **given))
    for place in (0, 1, 4095, 4096, 8191, 8192, 8196):
        for one in (q[place], q[place].tolist(), tuple(q[place].tolist()), q[place][None]):
            for matrix, all_of_them in zip(flat(function(one, **given)), many, strict=True):
                assert matrix.dtype == np.float64
                assert matrix.shape[-2:] == all_of_them.shape[-2:]
                error = np.abs(matrix.reshape(all_of_them.shape[1:]) - all_of_them[place])
                assert error.max() <= 100 * EPSILON


@pytest.mark.parametrize("name", FUNCTIONS)
def test_results_are_the_caller_s_to_keep_and_to_write(name: str, tmp_path: Path) -> None:
    function = getattr(module_of(SCARA, tmp_path), name)
    for q in ([0.1, 0.2, 0.3, 0.4], np.full((3, 4), 0.1)):
        first, again = flat(function(q)), flat(function(q))
        kept = [matrix.copy() for matrix in again]
        for matrix in first:
            matrix[:] = np.nan
        for matrix, before in zip(again, kept, strict=True):
            assert (matrix == before).all()


@pytest.mark.parametrize("shape", [(4,), (1, 4), (2, 0, 4), (2, 3, 4)])
def test_results_have_the_leading_axes(shape: tuple[int, ...], tmp_path: Path) -> None:
    module = module_of(SCARA, tmp_path)
    T, J = module.fk_jacobian(np.zeros(shape))
    assert (T.shape, J.shape) == ((*shape[:-1], 4, 4), (*shape[:-1], 6, 4))
    # Neither the layout of the memory nor the kind of number matters.
    assert (module.fk(np.zeros(shape, order="F")) == T).all()
    assert (module.fk(np.zeros(shape, dtype=np.int8)) == T).all()


@pytest.mark.parametrize("bad", [np.inf, -np.inf, np.nan])
@pytest.mark.parametrize("kind", [list, tuple, np.array])
def test_one_pose_with_an_angle_that_is_no_number(bad: float, kind: Any, tmp_path: Path) -> None:
    """What does not depend on the angle stays, though sin of math refuses infinity."""
    module = module_of(SCARA, tmp_path)
    pose = module.fk(kind([0.1, bad, 0.05, 0.3]))
    assert np.isnan(pose[:2, :2]).all()
    assert np.isnan(pose[:2, 3]).all()
    assert (pose[2] == [0.0, 0.0, -1.0, 1.0 + 0.05 - 0.1]).all()
    T, J = module.fk_jacobian(kind([0.1, bad, 0.05, 0.3]))
    assert np.array_equal(T, pose, equal_nan=True)
    assert np.isnan(J[:2, :2]).all()


@pytest.mark.parametrize(
    "wrong", [[], [0.0] * 5, ["a"] * 4, [[0.0], 1.0, 2.0, 3.0], 0.0, "1234", None]
)
def test_a_wrong_q_is_refused(wrong: Any, tmp_path: Path) -> None:
    module = module_of(SCARA, tmp_path)
    for name in FUNCTIONS:
        with pytest.raises((ValueError, TypeError)):
            getattr(module, name)(wrong)


def test_an_array_without_joint_variables_has_one_pose_each(tmp_path: Path) -> None:
    module = module_of(STILL_NUMBERS, tmp_path)
    for lead in ((), (3,), (2, 0)):
        T, J = module.fk_jacobian(np.zeros((*lead, 0)))
        assert (T.shape, J.shape) == ((*lead, 4, 4), (*lead, 6, 0))
        assert (module.fk([]) == T).all()


def test_sliding_joints_take_whole_numbers(tmp_path: Path) -> None:
    gantry = Robot("gantry", STANDARD, (prismatic(Q1), prismatic(Q2, alpha=Integer(0))))
    module = module_of(gantry, tmp_path)
    assert module.fk([1, 2])[2, 3] == 3.0
    assert module.fk(np.array([1, 2])).dtype == np.float64


# ------------------------------------------------------------------------------------ large angles


@pytest.mark.parametrize("table", SUMMED, ids=lambda path: path.stem)
def test_angles_of_a_million_radians_cost_nothing(table: Path, tmp_path: Path) -> None:
    """The angles of parallel joints are not added up: at a million their sum is off by 1e6 eps."""
    arm = read_arm_file(table)
    q = large_poses(arm)
    joints = named(arm, q)
    T, J = arm.pose(joints), columns_from_axes(arm, joints)
    tolerance = arm.tolerance()
    module = module_of(symdh.load(table), tmp_path)
    for found, expected in zip(module.fk_jacobian(q), (T, J), strict=True):
        assert np.abs(found - expected).max() <= tolerance
    assert np.abs(module.jacobian(q) - J).max() <= tolerance
    for place, one in enumerate(q):
        assert np.abs(module.fk(one) - T[place]).max() <= tolerance


@pytest.mark.parametrize("largest", [10.0, 1e6, 1e15])
def test_half_angles_have_no_bad_place(largest: float, tmp_path: Path) -> None:
    """Where the tangent of half the angle is 0, 1 or beyond bounds, and next to it."""
    generator = np.random.default_rng(12)
    quarters = np.concatenate([np.arange(-8, 9), generator.integers(0, int(largest), 500)])
    edges = quarters * (np.pi / 4)
    beside = [np.nextafter(edges, end) for end in (-np.inf, np.inf)]
    angles = np.concatenate([edges, *beside, generator.uniform(-largest, largest, 5000)])
    poses = module_of(Robot("turn", STANDARD, (revolute(Q1),)), tmp_path).fk(angles[:, None])
    exact = EXTENDED.array(angles)
    for row, function in enumerate((EXTENDED.cos, EXTENDED.sin)):
        assert np.abs(poses[:, row, 0] - function(exact)).max() <= 2 * EPSILON


def large_poses(arm: Arm) -> np.ndarray:
    """Seeded poses, angles up to a million radians."""
    turns = np.array([is_turn for _, is_turn in arm.variables])
    return arm.seeded_poses(50, seed=5) * np.where(turns, 1e6 / np.pi, 1.0)


# ------------------------------------------------------------------------- other array namespaces


@pytest.mark.parametrize(
    "robot", [PUMA, SCARA, TWISTED, FORMULAS, PLANAR], ids=lambda robot: robot.name
)
def test_arrays_of_the_standard_stay_what_they_are(robot: Robot, tmp_path: Path) -> None:
    module = module_of(robot, tmp_path)
    given = required(robot)
    for lead in ((), (5,), (2, 3)):
        q = joints_of(robot, *lead)
        strict = array_api_strict.asarray(q)
        for name in FUNCTIONS:
            found = flat(getattr(module, name)(strict, **given))
            expected = flat(getattr(module, name)(q, **given))
            for matrix, numpy_s in zip(found, expected, strict=True):
                assert isinstance(matrix, type(strict))
                assert matrix.dtype == array_api_strict.float64
                assert np.abs(np.asarray(matrix) - numpy_s).max() <= 100 * EPSILON


def test_single_precision_stays_single_in_another_namespace(tmp_path: Path) -> None:
    module = module_of(SCARA, tmp_path)
    q = array_api_strict.zeros((2, 4), dtype=array_api_strict.float32)
    assert module.fk(q).dtype == array_api_strict.float32
    with pytest.raises(ValueError, match=r"q must have shape \(\.\.\., 4\), not \(2, 3\)"):
        module.fk(q[:, :3])


def test_a_library_that_does_not_tell_its_namespace_is_known(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A stand-in for PyTorch: its tensors have no namespace, the module has the functions."""

    class Tensor:
        __module__ = "torch"

        def __init__(self, array: Any) -> None:
            self.array = array
            self.shape = array.shape

        def __getitem__(self, key: Any) -> Any:
            return self.array[key]

    functions = {name: getattr(np, name) for name in ("sin", "cos", "zeros_like")}
    calls: list[str] = []

    def noted(name: str) -> Any:
        return lambda *given, **named: (calls.append(name), getattr(np, name)(*given, **named))[1]

    torch = SimpleNamespace(**functions, stack=noted("stack"), reshape=noted("reshape"))
    monkeypatch.setitem(sys.modules, "torch", torch)  # type: ignore[arg-type]
    q = joints_of(SCARA, 3)
    module = module_of(SCARA, tmp_path)
    assert np.abs(module.fk(Tensor(q)) - module.fk(q)).max() <= 100 * EPSILON
    assert calls == ["stack", "reshape"]


# ------------------------------------------------------------------------------------- the module


def test_the_module_is_typed_and_clean(tmp_path: Path) -> None:
    """mypy and ruff, strict, find nothing to say."""
    import subprocess

    files = []
    for robot in (PUMA, SCARA, STILL_NUMBERS):
        (file,) = generate(robot, "python")
        (tmp_path / file.name).write_text(file.text)
        files.append(str(tmp_path / file.name))
    for command in (
        ["mypy", "--strict", "--no-incremental", *files],
        ["ruff", "check", "--isolated", "--select", "E,F,W,B,UP", "--line-length", "100", *files],
    ):
        ran = subprocess.run(
            [sys.executable, "-m", *command], capture_output=True, text=True, check=False
        )
        assert ran.returncode == 0, ran.stdout


def is_docstring(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def test_the_module_keeps_no_state(tmp_path: Path) -> None:
    """At its top stand imports, functions and constants, and nothing is global or written to."""
    (file,) = generate(replace(PUMA, name="stateless"), "python")
    for node in ast.walk(ast.parse(file.text)):
        assert not isinstance(node, ast.Global | ast.Nonlocal)
        if isinstance(node, ast.ClassDef):  # what one call keeps; nothing that two calls share
            kinds = {type(each) for each in node.body if not is_docstring(each)}
            assert kinds <= {ast.FunctionDef}
    for node in ast.parse(file.text).body:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            target = node.target if isinstance(node, ast.AnnAssign) else node.targets[0]
            assert isinstance(target, ast.Name)
            assert target.id.lstrip("_")[0].isupper()


def test_parameters_are_by_keyword_only(tmp_path: Path) -> None:
    arm = Robot("arm", STANDARD, (revolute(Q1, a=Integer(2)), revolute(Q2, a=Q2 - Q2 + 3)))
    module = module_of(arm, tmp_path)
    with pytest.raises(TypeError):
        module.fk([0.0, 0.0], 1.0)
    assert module.fk([0.0, 0.0])[0, 3] == 5.0
