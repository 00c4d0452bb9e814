"""Generated Jacobians: run, and compared with columns z x (p - p_i) and with differences.

The first comparison takes axes and origins from products of elementary matrices, the second
differentiates such a product numerically, at so many digits that nothing of the difference quotient
is left in a double. Neither shares code with the package.
"""

from __future__ import annotations

import ctypes
import functools
import inspect
import math
import re
import subprocess
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from generated import STRICT_C, compile_generated, import_generated
from oracle import EXTENDED, FIFTY_DIGITS, Arm, read_arm_file
from sympy import Expr, Integer, Rational, Symbol
from test_codegen import (
    CPP17,
    CPP98,
    DEGREE,
    EPS,
    HOSTILE_PARAMETERS,
    HOSTILE_VARIABLES,
    PANDA,
    PLANAR,
    PUMA,
    Q1,
    Q2,
    RIGHT,
    ROBOTS,
    SCARA,
    STANDARD,
    STILL,
    STILL_NUMBERS,
    UR5,
    Oracle,
    _elementary,
    moved,
    open_parameters,
    parameter_numbers,
    prismatic,
    real,
    revolute,
    rotated,
    symbols,
    write_all,
)

import symdh
from symdh.codegen import GeneratedFile, generate
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.jacobian import forward_jacobian_routine, jacobian_routine
from symdh.codegen.routine import Routine
from symdh.robot import Axis, Robot
from tools import require_tool

TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
POSES = 200
MOVING = [robot for robot in ROBOTS if robot.variables]

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)
by_name = pytest.mark.parametrize("robot", MOVING, ids=lambda robot: robot.name)


# ---------------------------------------------------------------------- running what is generated


@dataclass(frozen=True)
class Results:
    """What is generated gives the Jacobian twice, alone and together with the pose."""

    pose: np.ndarray
    alone: np.ndarray
    together: np.ndarray


def run_python(
    files: Sequence[GeneratedFile], folder: Path, q: np.ndarray, parameters: Sequence[float] = ()
) -> Results:
    """Run the Python; `parameters` are those without a default, in their order."""
    module = import_generated(files, folder)
    arguments = inspect.signature(module.jacobian).parameters.values()
    required = [a.name for a in arguments if a.default is a.empty and a.name != "q"]
    keywords = dict(zip(required, parameters, strict=True))
    pose, together = module.fk_jacobian(q, **keywords)
    return Results(pose, module.jacobian(q, **keywords), together)


def run_c(
    files: Sequence[GeneratedFile], folder: Path, q: np.ndarray, parameters: Sequence[float] = ()
) -> Results:
    """Compile the C strictly and run it; what surrounds the results must stay untouched."""
    count, n = q.shape
    compile_generated(files, folder, n=n, flags=["-Wno-overlength-strings"])
    (built,) = folder.glob("*.so")
    library = ctypes.CDLL(str(built))
    between = [(ctypes.c_double * len(parameters))(*parameters)] if parameters else []
    results = Results(*(np.empty((count, *shape)) for shape in ((4, 4), (6, n), (6, n))))
    for row, joints in enumerate(np.ascontiguousarray(q)):
        given = (ctypes.c_double * n)(*joints)
        T, alone, both = _guarded(16), _guarded(6 * n), _guarded(6 * n)
        getattr(library, f"{built.stem}_jacobian")(given, *between, _inside(alone))
        getattr(library, f"{built.stem}_fk_jacobian")(given, *between, _inside(T), _inside(both))
        for found, array in (
            (T, results.pose),
            (alone, results.alone),
            (both, results.together),
        ):
            assert found[0] == found[-1] == _GUARD
            array[row] = found[1:-1].reshape(array.shape[1:])
    return results


_GUARD = 12345.678


def _guarded(size: int) -> np.ndarray:
    return np.array([_GUARD, *[math.nan] * size, _GUARD])


def _inside(array: np.ndarray) -> Any:
    return array[1:].ctypes.data_as(ctypes.POINTER(ctypes.c_double))


# --------------------------------------------------------------------------------- every table


@functools.cache
def arm_of(table: Path) -> Arm:
    return read_arm_file(table)


@functools.cache
def expected_of(table: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Seeded joint values (200, n), and the oracle's poses and Jacobians for them."""
    arm = arm_of(table)
    q = arm.seeded_poses(POSES, seed=1000 + TABLES.index(table))
    joints = named(arm, q)
    return q, arm.pose(joints), columns_from_axes(arm, joints)


def named(arm: Arm, q: np.ndarray) -> dict[str, np.ndarray]:
    """Joint values (..., n) by the names of the joint variables."""
    return {name: q[..., k] for k, (name, _) in enumerate(arm.variables)}


def columns_from_axes(arm: Arm, joints: dict[str, np.ndarray]) -> np.ndarray:
    """Jacobians (..., 6, n) from the frames of the chain: [z x (p - p_i); z] and [z; 0]."""
    end = arm.pose(joints)[..., :3, 3]
    columns = []
    for name, turns in arm.variables:
        i, text = entry_of(arm, name, "theta" if turns else "d")
        # The axis of joint i is the z axis of frame i - 1 in a standard table, of i in a modified.
        frame = arm.pose(joints, "base", i - 1 if arm.convention == "standard" else i)
        z = frame[..., :3, 2] * rate_of(arm, text, name)
        linear = np.cross(z, end - frame[..., :3, 3]) if turns else z
        columns.append(np.concatenate([linear, z if turns else 0 * z], axis=-1))
    return np.stack(columns, axis=-1)


def entry_of(arm: Arm, name: str, column: str) -> tuple[int, str]:
    """Row of a joint variable, from 1, and the text that it stands in."""
    rows = enumerate((row[column] for row in arm.rows), start=1)
    ((i, text),) = ((i, text) for i, text in rows if re.search(rf"\b{name}\b", text))
    return i, text


def rate_of(arm: Arm, text: str, name: str) -> Any:
    """Derivative of a linear entry by its variable."""
    at_0, at_1 = (
        arm._scope(EXTENDED, {name: value}).evaluate(text, is_angle=False) for value in (0.0, 1.0)
    )
    return at_1 - at_0


def test_the_oracle_knows_a_jacobian_worked_by_hand() -> None:
    """Planar 2R with a1 = a2 = 1 at 0 and 90 deg: the hand moves sideways, then inward."""
    table = next(table for table in TABLES if table.stem == "planar_2r")
    arm = replace(arm_of(table), values={"a1": "1", "a2": "1"})
    (first, _), (second, _) = arm.variables
    found = columns_from_axes(arm, {first: np.array([0.0]), second: np.array([np.pi / 2])})
    expected = [[-1, -1], [1, 0], [0, 0], [0, 0], [0, 0], [1, 1]]
    assert np.allclose(found.astype(float)[0], expected, atol=1e-15)


@each_table
def test_python_agrees_with_axes_and_levers(table: Path, tmp_path: Path) -> None:
    q, T, J = expected_of(table)
    found = run_python(generate(symdh.load(table), "python"), tmp_path, q)
    assert_results_agree(found, T, J, arm_of(table).tolerance())


@each_table
def test_c_agrees_with_axes_and_levers(table: Path, tmp_path: Path) -> None:
    q, T, J = expected_of(table)
    found = run_c(generate(symdh.load(table), "c"), tmp_path, q)
    assert_results_agree(found, T, J, arm_of(table).tolerance())


@each_table
def test_python_agrees_with_differences_at_fifty_digits(table: Path, tmp_path: Path) -> None:
    arm = arm_of(table)
    q = expected_of(table)[0][:3]
    T = arm.pose(named(arm, q))
    found = run_python(generate(symdh.load(table), "python"), tmp_path, q)
    assert_results_agree(found, T, differences(arm, q), arm.tolerance())


def differences(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Jacobians (..., 6, n) as central differences of the pose, the error about 1e-30."""
    names = [name for name, _ in arm.variables]
    step = FIFTY_DIGITS.number("1e-15")
    exact = FIFTY_DIGITS.array(q)

    def pose(moved: int, by: Any) -> Any:
        return arm.pose(
            {name: exact[..., k] + (by if k == moved else 0) for k, name in enumerate(names)},
            arithmetic=FIFTY_DIGITS,
        )

    columns = []
    for k in range(len(names)):
        slope = (pose(k, step) - pose(k, -step)) / (2 * step)
        columns.append(_twist(slope, pose(k, 0)))
    return np.stack(columns, axis=-1)


def _twist(slope: Any, pose: Any) -> Any:
    """Velocity and angular velocity (..., 6) from a pose and its derivative: S(w) = R' R^T."""
    spin = slope[..., :3, :3] @ np.swapaxes(pose[..., :3, :3], -1, -2)
    angular = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], axis=-1)
    return np.concatenate([slope[..., :3, 3], angular], axis=-1).astype(np.float64)


def assert_results_agree(
    found: Results, T: np.ndarray, J: np.ndarray, tolerance: float | np.ndarray
) -> None:
    for matrix, expected in ((found.pose, T), (found.alone, J), (found.together, J)):
        assert matrix.shape == expected.shape
        assert (np.abs(matrix - expected) <= tolerance).all()


# ------------------------------------------------------ base, tool, offsets, gears, open parameters

STEP = Rational(1, 10**12)


def exact_results(robot: Robot, q: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """Pose and Jacobian, the latter by central differences, in 40-digit arithmetic."""
    values = dict(zip(robot.variables, q, strict=True)) | parameter_numbers(robot)
    at = {symbol: Rational(*float(x).as_integer_ratio()) for symbol, x in values.items()}
    with mpmath.workdps(40):
        pose = exact_pose(robot, at)
        columns = []
        for variable in robot.variables:
            after = exact_pose(robot, {**at, variable: at[variable] + STEP})
            before = exact_pose(robot, {**at, variable: at[variable] - STEP})
            columns.append(_twist((after - before) / (2 * mpmath.mpf(1) / STEP.q), pose))
    return pose.astype(np.float64), np.stack(columns, axis=-1)


def exact_pose(robot: Robot, at: Mapping[Symbol, Rational]) -> Any:
    product = mpmath.eye(4)
    for letter, axis, amount in Oracle(robot)._motions():
        value = mpmath.mpf(amount.xreplace(dict(at)).evalf(40))
        product = product * _elementary(letter, axis, value)
    return np.array(product.tolist(), dtype=object).reshape(4, 4)


def column_tolerances(robot: Robot, q: np.ndarray) -> np.ndarray:
    """Tolerance of each column; a joint that turns at twice the rate has one twice as large."""
    named = [dict(zip(robot.variables, row, strict=True)) for row in q]
    numbers = parameter_numbers(robot)
    reach = max(Oracle(robot).pose({**numbers, **row})[1] for row in named)
    joints = {joint.variable: joint for joint in robot.joints}
    rates = [abs(float((joints[v].theta + joints[v].d).diff(v))) for v in robot.variables]
    return (4 + 2 * robot.n) * EPS * max(1.0, reach) * np.maximum(1.0, rates)


@by_name
@pytest.mark.parametrize(("run", "target"), [(run_python, "python"), (run_c, "c")])
def test_every_robot_agrees_with_differences(
    robot: Robot, run: Callable[..., Results], target: str, tmp_path: Path
) -> None:
    generator = np.random.default_rng(7)
    q = generator.uniform(-math.pi, math.pi, (2, len(robot.variables)))
    expected = [exact_results(robot, row) for row in q]
    found = run(generate(robot, target), tmp_path, q, open_parameters(robot))
    tolerances = column_tolerances(robot, q)
    assert np.abs(found.pose - [T for T, _ in expected]).max() <= tolerances.min()
    for J in (found.alone, found.together):
        assert (np.abs(J - [J for _, J in expected]) <= tolerances).all()


@pytest.mark.parametrize(
    ("robot", "q", "expected"),
    [
        # 90 deg - q1 points up at q1 = 0 and turns backwards: the hand moves along +x.
        (
            Robot("back", STANDARD, (revolute(Q1, a=Integer(2), theta=RIGHT - Q1),)),
            [0.0],
            [[2], [0], [0], [0], [0], [-1]],
        ),
        # A gear: the joint turns by 3 q1.
        (
            Robot("geared", STANDARD, (revolute(Q1, a=Integer(2), theta=3 * Q1),)),
            [0.0],
            [[0], [6], [0], [0], [0], [3]],
        ),
        # The slide's z points along x once the first joint has turned by 90 deg; it goes backwards.
        (
            Robot(
                "slide",
                STANDARD,
                (revolute(Q1, alpha=RIGHT), prismatic(Q2, d=1 - 2 * Q2, theta=RIGHT)),
                tool=(moved(Axis.X, Integer(5)),),
            ),
            [math.pi / 2, 0.0],
            [[0, -2], [1, 0], [0, 0], [0, 0], [0, 0], [1, 0]],
        ),
        # The base lays the arm on its side: its z is the world's -y, its y the world's z.
        (
            Robot("based", STANDARD, (revolute(Q1, a=Integer(2)),), base=(rotated(Axis.X, RIGHT),)),
            [0.0],
            [[0], [0], [2], [0], [-1], [0]],
        ),
    ],
    ids=lambda value: value.name if isinstance(value, Robot) else "",
)
def test_columns_worked_by_hand(
    robot: Robot, q: list[float], expected: list[list[int]], tmp_path: Path
) -> None:
    for run, target in ((run_python, "python"), (run_c, "c")):
        found = run(generate(robot, target), tmp_path, np.array([q]))
        assert np.abs(found.alone[0] - expected).max() < 1e-15
        assert np.abs(found.together[0] - expected).max() < 1e-15


# ---------------------------------------------------------------------------------------- names


@pytest.mark.parametrize("robot", [HOSTILE_PARAMETERS, HOSTILE_VARIABLES])
@pytest.mark.parametrize(("run", "target"), [(run_python, "python"), (run_c, "c")])
def test_hostile_names_change_no_number(
    robot: Robot, run: Callable[..., Results], target: str, tmp_path: Path
) -> None:
    plain = with_plain_names(robot)
    (tmp_path / "plain").mkdir()
    q = np.linspace(-1.0, 1.0, len(robot.variables))[None]
    parameters = np.linspace(0.5, 1.5, len(robot.parameters)).tolist()
    found = run(generate(robot, target), tmp_path, q, parameters)
    expected = run(generate(plain, target), tmp_path / "plain", q, parameters)
    for name in ("pose", "alone", "together"):
        assert np.allclose(getattr(found, name), getattr(expected, name), rtol=0, atol=1e-12)


def with_plain_names(robot: Robot) -> Robot:
    """The same robot with its symbols called z1, z2 .."""
    every = [*robot.parameters, *robot.variables]
    plain = dict(zip(every, symbols(" ".join(f"z{k}" for k in range(len(every)))), strict=True))
    joints = tuple(
        replace(
            joint,
            **{name: getattr(joint, name).xreplace(plain) for name in ("theta", "d", "a", "alpha")},
            variable=None if joint.variable is None else plain[joint.variable],
        )
        for joint in robot.joints
    )
    return replace(robot, name="plain", joints=joints)


def test_parameters_have_one_name_in_all_functions(tmp_path: Path) -> None:
    module = import_generated(generate(HOSTILE_PARAMETERS, "python"), tmp_path)
    of_fk = inspect.signature(module.fk).parameters
    assert inspect.signature(module.jacobian).parameters == of_fk
    assert inspect.signature(module.fk_jacobian).parameters == of_fk


# --------------------------------------------------------------------------------------- Python


def test_python_broadcasts_over_leading_axes(tmp_path: Path) -> None:
    module = import_generated(generate(SCARA, "python"), tmp_path)
    q = np.linspace(-1.0, 1.0, 24).reshape(2, 3, 4)
    J = module.jacobian(q)
    T, together = module.fk_jacobian(q)
    assert (J.shape, J.dtype) == ((2, 3, 6, 4), np.float64)
    assert (T.shape, together.shape) == ((2, 3, 4, 4), (2, 3, 6, 4))
    # One pose takes its sines from math, many take them from half angles.
    assert np.abs(module.jacobian(q[1, 2]) - J[1, 2]).max() <= 2e-15
    assert module.jacobian(np.zeros((0, 4))).shape == (0, 6, 4)


@pytest.mark.parametrize("wrong", [0.0, [0.0] * 3, np.zeros((4, 3))])
def test_python_refuses_a_wrong_last_axis(wrong: Any, tmp_path: Path) -> None:
    module = import_generated(generate(SCARA, "python"), tmp_path)
    shape = re.escape(str(np.shape(wrong)))
    for function in (module.jacobian, module.fk_jacobian):
        with pytest.raises(ValueError, match=rf"q must have shape \(\.\.\., 4\), not {shape}"):
            function(wrong)


def test_python_without_joint_variables(tmp_path: Path) -> None:
    module = import_generated(generate(STILL_NUMBERS, "python"), tmp_path)
    assert module.jacobian([]).shape == (6, 0)
    T, J = module.fk_jacobian(np.zeros((3, 0)))
    assert J.shape == (3, 6, 0)
    assert (module.fk(np.zeros((3, 0))) == T).all()


def test_python_takes_parameters_by_keyword(tmp_path: Path) -> None:
    module = import_generated(generate(PLANAR, "python"), tmp_path)
    J = module.jacobian([0.0, 0.0], a1=2.0, a2=3.0)
    assert J[1].tolist() == [5.0, 3.0]
    with pytest.raises(TypeError, match="'a2'"):
        module.jacobian([0.0, 0.0], a1=2.0)


# -------------------------------------------------------------------------------------------- C


def test_c_declares_the_arrays_with_their_sizes() -> None:
    header, _ = generate(SCARA, "c")
    assert "void SCARA_jacobian(const double q[4], double J[24]);" in header.text
    assert "void SCARA_fk_jacobian(const double q[4], double T[16], double J[24]);" in header.text
    header, _ = generate(PUMA, "c")
    given = "const double q[6], const puma560_params *p"
    assert f"void puma560_jacobian({given}, double J[36]);" in header.text
    assert f"void puma560_fk_jacobian({given}, double T[16], double J[36]);" in header.text


def test_c_breaks_a_long_head() -> None:
    arm = replace(PUMA, name="a" * 60)
    for file in generate(arm, "c"):
        assert "_fk_jacobian(\n    const double q[6],\n    const " in file.text


@pytest.mark.parametrize("robot", [STILL, STILL_NUMBERS], ids=lambda robot: robot.name)
def test_c_without_joint_variables_has_no_jacobian(robot: Robot) -> None:
    for file in generate(robot, "c"):
        assert f"{robot.name}_fk(" in file.text
        assert "jacobian" not in file.text.lower()


@pytest.mark.parametrize(
    ("compiler", "flags"),
    [
        ("g++", ["-x", "c++", *CPP98]),
        ("g++", ["-x", "c++", *CPP17]),
        ("clang", ["-std=c99", *STRICT_C]),
        ("clang++", ["-x", "c++", *CPP17]),
    ],
    ids=["c++98", "c++17", "clang-c99", "clang-c++17"],
)
def test_every_compiler_accepts_every_table(
    compiler: str, flags: list[str], tmp_path: Path
) -> None:
    program = require_tool(compiler)
    sources = [str(write_all(generate(symdh.load(t), "c"), tmp_path)[1]) for t in TABLES]
    assert len(set(sources)) == len(TABLES)
    command = [program, *flags, "-fsyntax-only", *sources]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(("run", "target"), [(run_python, "python"), (run_c, "c")])
def test_an_angle_that_is_no_number_gives_nan(
    bad: float, run: Callable[..., Results], target: str, tmp_path: Path
) -> None:
    """What does not depend on the second angle of a SCARA stays."""
    found = run(generate(SCARA, target), tmp_path, np.array([[0.1, bad, 0.05, 0.3]]))
    for J in (found.alone[0], found.together[0]):
        assert np.isnan(J[:2, :2]).all()
        assert (J[:2, 2:] == 0.0).all()
        assert (J[2:] == [[0, 0, 1, 0], [0, 0, 0, 0], [0, 0, 0, 0], [1, 1, 0, 1]]).all()


# ------------------------------------------------------------------------------------- routines


def work(routine: Routine) -> tuple[int, int, int]:
    """Multiplications, additions and calls, sums of angles included."""
    counts = routine.op_counts()
    multiplications = counts.pop(Op.MUL, 0)
    additions = counts.pop(Op.ADD, 0) + counts.pop(Op.SUB, 0)
    return multiplications, additions, sum(counts.values())


@pytest.mark.parametrize(
    ("robot", "alone", "together"),
    [
        (PLANAR, (4, 3, 4), (4, 3, 4)),
        (SCARA, (4, 3, 4), (4, 6, 6)),
        (PUMA, (34, 14, 10), (52, 23, 12)),
        (UR5, (34, 15, 10), (51, 24, 12)),
        (PANDA, (91, 44, 12), (109, 54, 14)),
    ],
    ids=lambda value: value.name if isinstance(value, Robot) else "",
)
def test_work_of_known_arms(
    robot: Robot, alone: tuple[int, int, int], together: tuple[int, int, int]
) -> None:
    for found, most in (
        (work(jacobian_routine(robot)), alone),
        (work(forward_jacobian_routine(robot)), together),
    ):
        assert all(count <= limit for count, limit in zip(found, most, strict=True))


@by_name
def test_together_is_never_more_work_than_one_after_the_other(robot: Robot) -> None:
    pose, alone = work(forward_routine(robot)), work(jacobian_routine(robot))
    together = work(forward_jacobian_routine(robot))
    assert all(t <= p + j for t, p, j in zip(together, pose, alone, strict=True))
    assert together[2] == max(pose[2], alone[2])


@pytest.mark.parametrize("alpha", [Integer(0), RIGHT, 50 * DEGREE], ids=["0", "90", "50"])
def test_work_grows_linearly_with_the_joints(alpha: Expr) -> None:
    def arm(n: int) -> Robot:
        rows = (
            revolute(real(f"q{i}"), d=real(f"d{i}"), a=real(f"a{i}"), alpha=alpha)
            for i in range(1, n + 1)
        )
        return Robot("long", STANDARD, tuple(rows))

    for build in (jacobian_routine, forward_jacobian_routine):
        at_25, at_50, at_100 = (sum(work(build(arm(n)))) for n in (25, 50, 100))
        assert at_100 - at_50 == 2 * (at_50 - at_25)


def test_outputs_come_row_by_row_with_the_rows_of_the_table_in_their_names() -> None:
    robot = next(robot for robot in ROBOTS if robot.name == "signs-and.offsets")  # row 6 is fixed
    outputs = jacobian_routine(robot).outputs
    assert [(o.row, o.column) for o in outputs] == [(r, c) for r in range(6) for c in range(6)]
    assert {o.matrix for o in outputs} == {"J"}
    assert [o.name for o in outputs[:6]] == ["vx1", "vx2", "vx3", "vx4", "vx5", "vx7"]
    both = forward_jacobian_routine(robot).outputs
    assert [o.matrix for o in both] == ["T"] * 12 + ["J"] * 36


def test_assignments_use_only_what_stands_above_them() -> None:
    for robot in ROBOTS:
        for routine in (jacobian_routine(robot), forward_jacobian_routine(robot)):
            indices = [assignment.node.index for assignment in routine.assignments]
            assert indices == sorted(indices)
            texts = [(a.node.op, a.node.args) for a in routine.assignments]
            assert len(texts) == len(set(texts))
