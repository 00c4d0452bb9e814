"""Generated code: run, and compared with a product of elementary matrices at 40 digits."""

from __future__ import annotations

import ast
import doctest
import hashlib
import inspect
import math
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import mpmath
import numpy as np
import pytest
from generated import STRICT_C, compile_generated, import_generated
from sympy import (
    Abs,
    Expr,
    Float,
    Function,
    I,
    Integer,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    pi,
    sin,
    sqrt,
    tan,
)

from symdh import resources
from symdh.codegen import TARGETS, GeneratedFile, generate
from symdh.codegen.fingerprint import fingerprint
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Graph, Op
from symdh.codegen.literals import literal
from symdh.codegen.lowering import Lowering
from symdh.codegen.names import Scope, file_stem
from symdh.errors import ReadError, UnsupportedError
from symdh.robot import (
    AngleUnit,
    Axis,
    Convention,
    Joint,
    JointType,
    LengthUnit,
    Limits,
    Motion,
    MotionKind,
    Robot,
    Units,
)
from tools import require_tool

STANDARD, MODIFIED = Convention.STANDARD, Convention.MODIFIED
DEGREE = pi / 180
EPS = 2.0**-52
POSES = 12


def real(name: str) -> Symbol:
    return Symbol(name, real=True)


def symbols(names: str) -> list[Symbol]:
    return [real(name) for name in names.split()]


def revolute(
    q: Symbol, d: Expr = 0, a: Expr = 0, alpha: Expr = 0, theta: Expr | None = None
) -> Joint:
    return joint(JointType.REVOLUTE, q if theta is None else theta, d, a, alpha, q)


def prismatic(
    q: Symbol, theta: Expr = 0, a: Expr = 0, alpha: Expr = 0, d: Expr | None = None
) -> Joint:
    return joint(JointType.PRISMATIC, theta, q if d is None else d, a, alpha, q)


def fixed(theta: Expr = 0, d: Expr = 0, a: Expr = 0, alpha: Expr = 0) -> Joint:
    return joint(JointType.FIXED, theta, d, a, alpha, None)


def joint(kind: JointType, theta: Any, d: Any, a: Any, alpha: Any, q: Symbol | None) -> Joint:
    exact = [Integer(e) if isinstance(e, int) else e for e in (theta, d, a, alpha)]
    return Joint(kind, *exact, variable=q)


def rotated(axis: Axis, angle: Expr) -> Motion:
    return Motion(MotionKind.ROTATION, axis, angle)


def moved(axis: Axis, distance: Expr) -> Motion:
    return Motion(MotionKind.TRANSLATION, axis, distance)


# ------------------------------------------------------------------------------------- robots

Q1, Q2, Q3, Q4, Q5, Q6, Q7 = symbols("q1 q2 q3 q4 q5 q6 q7")
A1, A2, A3, D1, D2, D3, D4, D5, D6 = symbols("a1 a2 a3 d1 d2 d3 d4 d5 d6")
BETA, L1, L2 = symbols("beta L1 L2")
RIGHT = pi / 2

PUMA = Robot(
    "puma560",
    STANDARD,
    (
        revolute(Q1, alpha=RIGHT),
        revolute(Q2, a=A2),
        revolute(Q3, d=D3, a=A3, alpha=-RIGHT),
        revolute(Q4, d=D4, alpha=RIGHT),
        revolute(Q5, alpha=-RIGHT),
        revolute(Q6),
    ),
    values={A2: Rational("0.4318"), D3: Rational("0.15005"), A3: Rational("0.0203")},
)
UR5 = Robot(
    "ur5",
    STANDARD,
    (
        revolute(Q1, d=D1, alpha=RIGHT),
        revolute(Q2, a=A2),
        revolute(Q3, a=A3),
        revolute(Q4, d=D4, alpha=RIGHT),
        revolute(Q5, d=D5, alpha=-RIGHT),
        revolute(Q6, d=D6),
    ),
)
PANDA = Robot(
    "panda",
    MODIFIED,
    (
        revolute(Q1, d=D1),
        revolute(Q2, alpha=-RIGHT),
        revolute(Q3, d=D3, alpha=RIGHT),
        revolute(Q4, a=A1, alpha=RIGHT),
        revolute(Q5, d=D5, a=-A1, alpha=-RIGHT),
        revolute(Q6, alpha=RIGHT),
        revolute(Q7, a=A2, alpha=RIGHT),
    ),
    tool=(moved(Axis.Z, D6),),
)
PLANAR = Robot("planar 2R", STANDARD, (revolute(Q1, a=A1), revolute(Q2, a=A2)))
SCARA = Robot(
    "SCARA",
    STANDARD,
    (
        revolute(Q1, d=D1, a=A1),
        revolute(Q2, a=A2),
        prismatic(Q3),
        revolute(Q4, d=D4, alpha=pi),
    ),
    values={A1: Rational(1, 4), A2: Rational(1, 3), D1: Integer(1), D4: Rational(-1, 10)},
    limits={Q3: Limits(Integer(0), Rational("0.15")), Q1: Limits(-170 * DEGREE, 170 * DEGREE)},
    units=Units(AngleUnit.DEGREE, LengthUnit.METRE),
)
FLIPPED = Robot(
    "flipped",
    STANDARD,
    (revolute(Q1, a=A1, alpha=pi), revolute(Q2, a=A2), revolute(Q3, a=A3, alpha=-pi)),
)
OBLIQUE = Robot(
    "oblique",
    MODIFIED,
    (
        revolute(Q1, d=D1, alpha=17 * DEGREE),
        revolute(Q2, d=D2, a=A1, alpha=60 * DEGREE, theta=Q2 + 60 * DEGREE),
        prismatic(Q3, theta=-75 * DEGREE, a=Rational(1, 7), alpha=120 * DEGREE),
        revolute(Q4, a=A2, alpha=Integer(1), theta=Rational(1, 2) - Q4),
    ),
)
SIGNS = Robot(
    "signs-and.offsets",
    STANDARD,
    (
        revolute(Q1, d=D1, alpha=RIGHT, theta=RIGHT - Q1),
        revolute(Q2, a=A2, theta=Q2 - RIGHT),
        revolute(Q3, a=A3, theta=-Q3 + pi),
        prismatic(Q4, theta=RIGHT, alpha=-RIGHT, d=D4 - Q4),
        revolute(Q5, alpha=3 * RIGHT, theta=2 * Q5 + 200 * DEGREE),
        fixed(theta=45 * DEGREE, a=A1),
        revolute(Q6, d=-D6),
    ),
    base=(moved(Axis.Y, L1), rotated(Axis.X, 30 * DEGREE), rotated(Axis.Z, RIGHT)),
    tool=(rotated(Axis.Y, BETA), moved(Axis.X, L2), rotated(Axis.Z, pi)),
)
TWISTED = Robot(
    "symbolic twist",
    STANDARD,
    (
        revolute(Q1, a=A1, alpha=BETA),
        revolute(Q2, d=D2, a=A2, alpha=-BETA),
        revolute(Q3, d=L1 * cos(BETA), a=A3, alpha=BETA + RIGHT),
    ),
    values={A1: Rational("0.4"), BETA: 25 * DEGREE},
)
FORMULAS = Robot(
    "formulas",
    STANDARD,
    (
        revolute(Q1, d=sqrt(L1**2 + L2**2), a=L1**3 / L2, alpha=asin(L1 / (L1 + L2))),
        revolute(Q2, d=L1 * sin(BETA) - 2, a=1 / L2, alpha=acos(L1 / 8), theta=Q2 + atan2(L1, L2)),
        revolute(Q3, d=Abs(L1 - L2), a=L2 ** Rational(3, 2), alpha=atan(L1), theta=Q3 / 3),
        revolute(Q4, d=tan(BETA / 2), a=L1 ** Rational(1, 3), alpha=-pi / 5),
    ),
)
STILL = Robot(
    "still",
    STANDARD,
    (fixed(theta=BETA, a=A1, alpha=20 * DEGREE), fixed(theta=20 * DEGREE, d=D1, alpha=RIGHT)),
)
STILL_NUMBERS = replace(
    STILL, name="still_numbers", values={BETA: 20 * DEGREE, A1: Integer(2), D1: Rational(1, 3)}
)
LONELY = Robot("lonely", STANDARD, (prismatic(Q1), fixed(a=A1 - A1 + 1)), tool=(moved(Axis.X, A2),))
MANY = Robot(
    "many",
    MODIFIED,
    tuple(
        revolute(real(f"q{i}"), d=Rational(i, 50), a=Rational(1, i), alpha=(i % 3) * RIGHT)
        for i in range(1, 31)
    ),
)
ROBOTS = [
    PUMA,
    UR5,
    PANDA,
    PLANAR,
    SCARA,
    FLIPPED,
    OBLIQUE,
    SIGNS,
    TWISTED,
    FORMULAS,
    STILL,
    STILL_NUMBERS,
    LONELY,
    MANY,
]
by_name = pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)


# ------------------------------------------------------------------------------------- oracle


@dataclass(frozen=True)
class Oracle:
    """The pose of a robot as a plain product of elementary matrices in 40-digit arithmetic."""

    robot: Robot

    def pose(self, numbers: Mapping[Symbol, float]) -> tuple[np.ndarray, float]:
        """Return the pose rounded to doubles, and the reach: the sum of all lengths."""
        exact = {symbol: Rational(*float(x).as_integer_ratio()) for symbol, x in numbers.items()}
        product, reach = mpmath.eye(4), mpmath.mpf(0)
        with mpmath.workdps(40):
            for letter, axis, amount in self._motions():
                value = mpmath.mpf(amount.xreplace(exact).evalf(40))
                product = product * _elementary(letter, axis, value)
                reach += abs(value) if letter == "T" else 0
            pose = np.array(product.tolist(), dtype=object).reshape(4, 4).astype(np.float64)
        return pose, float(reach)

    def _motions(self) -> list[tuple[str, int, Expr]]:
        motions = [(m.kind.value, int(m.axis), m.amount) for m in self.robot.base]
        for j in self.robot.joints:
            about_z = [("R", 2, j.theta), ("T", 2, j.d)]
            about_x = [("R", 0, j.alpha), ("T", 0, j.a)]
            if self.robot.convention is Convention.STANDARD:
                motions += about_z + about_x
            else:
                motions += about_x + about_z
        return motions + [(m.kind.value, int(m.axis), m.amount) for m in self.robot.tool]


def _elementary(letter: str, axis: int, value: Any) -> Any:
    matrix = mpmath.eye(4)
    if letter == "T":
        matrix[axis, 3] = value
        return matrix
    c, s = mpmath.cos(value), mpmath.sin(value)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def test_oracle_knows_a_pose_worked_by_hand() -> None:
    arm = Robot("arm", STANDARD, (revolute(Q1, a=Integer(2), alpha=RIGHT),))
    pose, reach = Oracle(arm).pose({Q1: 0.0})
    assert np.allclose(pose, [[1, 0, 0, 2], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], atol=1e-15)
    assert reach == 2.0


def parameter_numbers(robot: Robot) -> dict[Symbol, float]:
    """Numbers for the parameters: the nearest double of the table's, else some of our own."""
    own = {p: 0.3 + 0.2 * k for k, p in enumerate(robot.parameters)}
    return {p: float(robot.values.get(p, x)) for p, x in own.items()}


def random_joints(robot: Robot) -> np.ndarray:
    generator = np.random.default_rng(sum(map(ord, robot.name)))
    return generator.uniform(-math.pi, math.pi, (POSES, len(robot.variables)))


def assert_poses(robot: Robot, joints: np.ndarray, poses: np.ndarray) -> None:
    """Compare poses with the oracle, to the tolerance that the design states."""
    parameters = parameter_numbers(robot)
    oracle = Oracle(robot)
    for q, pose in zip(joints, poses, strict=True):
        exact, reach = oracle.pose({**parameters, **dict(zip(robot.variables, q, strict=True))})
        tolerance = (4 + 2 * robot.n) * EPS * max(1.0, reach)
        assert np.max(np.abs(pose - exact)) <= tolerance
        assert (pose[3] == [0.0, 0.0, 0.0, 1.0]).all()


# ------------------------------------------------------------------------------ running the code


def python_module(robot: Robot, folder: Path) -> ModuleType:
    return import_generated(generate(robot, "python"), folder)


def open_parameters(robot: Robot) -> list[float]:
    """Numbers for the fields of the C struct: the parameters that have no value."""
    numbers = parameter_numbers(robot)
    return [numbers[p] for p in robot.parameters if p not in robot.values]


def run_c(
    robot: Robot,
    folder: Path,
    joints: np.ndarray,
    flags: Sequence[str] = ("-Wno-overlength-strings",),
) -> np.ndarray:
    function = compile_generated(
        generate(robot, "c"), folder, n=len(robot.variables), flags=list(flags)
    )
    if robot.variables:
        return function(joints, open_parameters(robot) or None)
    function = replace(function, n=1)  # the function must not look at q at all
    return function(np.full((len(joints), 1), math.nan), open_parameters(robot) or None)


@by_name
def test_python_agrees_with_the_oracle(robot: Robot, tmp_path: Path) -> None:
    module = python_module(robot, tmp_path)
    joints = random_joints(robot)
    numbers = parameter_numbers(robot)
    required = {p.name: numbers[p] for p in robot.parameters if p not in robot.values}
    assert_poses(robot, joints, module.fk(joints, **required))


@by_name
def test_c_agrees_with_the_oracle(robot: Robot, tmp_path: Path) -> None:
    joints = random_joints(robot)
    assert_poses(robot, joints, run_c(robot, tmp_path, joints))


CPP98 = ["-std=c++98", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
CPP17 = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"]
CPP20 = ["-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]


@pytest.mark.parametrize(
    ("compiler", "flags"),
    [
        ("gcc", ["-std=c99", *STRICT_C]),
        ("g++", CPP98),
        ("g++", CPP17),
        ("g++", CPP20),
        ("clang", ["-std=c99", *STRICT_C]),
        ("clang++", ["-x", "c++", *CPP17]),
    ],
    ids=["c99", "c++98", "c++17", "c++20", "clang-c99", "clang-c++17"],
)
def test_every_compiler_accepts_every_robot(
    compiler: str, flags: list[str], tmp_path: Path
) -> None:
    program = require_tool(compiler)
    sources = []
    for robot in [*ROBOTS, HOSTILE_PARAMETERS, HOSTILE_VARIABLES]:
        folder = tmp_path / f"{len(sources)}"
        folder.mkdir()
        sources.append(str(write_all(generate(robot, "c"), folder)[1]))
    language = ["-x", "c++"] if compiler == "g++" else []
    command = [program, *language, *flags, "-fsyntax-only", *sources]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""


def write_all(files: Sequence[GeneratedFile], folder: Path) -> list[Path]:
    paths = [folder / file.name for file in files]
    for path, file in zip(paths, files, strict=True):
        path.write_text(file.text, encoding="utf-8")
    return paths


# ---------------------------------------------------------------------------------------- names

HOSTILE = """
    E N Q I S O q p T J t0 t1 s1 c1 s12 c12 angle12 r11 px fk np npt sin cos atan2 fabs sqrt pow y0
    gamma log errno EDOM M_PI PI NAN INFINITY NULL linux unix min max near assert isnan class j1
    lambda double int signed and or not xor bool true false None True is in def print abs sum
    float ValueError N_JOINTS x X a_ a theta template this operator restrict inline self pi2 vx1
    hostile_fk hostile_params numpy jacobian fk_jacobian hostile_jacobian hostile_fk_jacobian wz2
"""


HOSTILE_PARAMETERS = Robot(
    "hostile",
    STANDARD,
    (
        revolute(real("u1"), alpha=30 * DEGREE),
        *(fixed(d=real(name), alpha=30 * DEGREE) for name in HOSTILE.split()),
    ),
)
HOSTILE_VARIABLES = Robot(
    "hostile", STANDARD, tuple(revolute(real(name), a=Integer(1)) for name in HOSTILE.split())
)


@pytest.mark.parametrize("robot", [HOSTILE_PARAMETERS, HOSTILE_VARIABLES])
def test_all_hostile_names_at_once(robot: Robot, tmp_path: Path) -> None:
    joints = random_joints(robot)[:3]
    assert_poses(robot, joints, run_c(robot, tmp_path, joints))
    fk = python_module(robot, tmp_path).fk
    numbers = parameter_numbers(robot)
    keywords = [argument for argument in inspect.signature(fk).parameters if argument != "q"]
    values = dict(zip(keywords, (numbers[p] for p in robot.parameters), strict=True))
    assert_poses(robot, joints, fk(joints, **values))


@pytest.mark.parametrize(
    ("hostile", "other"),
    [
        (["q", "p", "T", "t1", "s1", "c12"], ["a", "b"]),
        (["E", "N", "I", "S", "errno", "EDOM"], ["class", "lambda"]),
        (["sin", "cos", "fabs", "np", "fk", "px"], ["s1", "angle12"]),
        (["class", "class_", "lambda", "double", "None", "q_"], ["T", "q"]),
        (["L1", "l1", "L_1", "M_PI", "linux", "gamma"], ["int", "t1"]),
    ],
)
def test_symbols_may_have_any_name(hostile: list[str], other: list[str], tmp_path: Path) -> None:
    """Six parameters, two joint variables: the same numbers, whatever the names."""
    lengths, variables = symbols(" ".join(hostile)), symbols(" ".join(other))
    (a, b, c, d, e, f), (u, v) = lengths, variables
    arm = Robot(
        "hostile",
        STANDARD,
        (revolute(u, d=a, a=b, alpha=RIGHT), revolute(v, d=c, a=d), fixed(d=e, a=f)),
    )
    joints = random_joints(arm)
    numbers = parameter_numbers(arm)
    module = python_module(arm, tmp_path)
    arguments = [a for a in inspect.signature(module.fk).parameters if a != "q"]
    keywords = dict(zip(arguments, (numbers[p] for p in arm.parameters), strict=True))
    assert_poses(arm, joints, module.fk(joints, **keywords))
    assert_poses(arm, joints, run_c(arm, tmp_path, joints))


def test_a_renamed_symbol_is_named_in_the_comments() -> None:
    arm = Robot("arm", STANDARD, (revolute(Q1, a=real("class")),))
    (module,) = generate(arm, "python")
    header, _ = generate(arm, "c")
    assert "    class_ : float\n        class of the table." in module.text
    assert "double class_; /**< class of the table */" in header.text


def test_scope_prefers_who_may_keep_the_name() -> None:
    scope = Scope(lambda name: name == "class")
    first, second, third, fourth = symbols("class class_ ok! ok")
    assert scope.take_symbols([first, second, third, fourth]) == {
        first: "class_",
        second: "class_2_",
        third: "ok_",
        fourth: "ok",
    }
    assert [scope.take("ok"), scope.take("ok"), scope.take("t")] == ["ok_2_", "ok_3_", "t"]


def test_scope_finds_a_name_where_whole_families_are_reserved() -> None:
    scope = Scope(lambda name: name.startswith("E"))
    assert [scope.take("EDOM"), scope.take("EDOM")] == ["EDOM_", "EDOM_2_"]


def test_scope_tells_symbols_with_unusual_letters_apart() -> None:
    scope = Scope(lambda name: False)
    given = scope.take_symbols(symbols("a' a* 1a a__b"))
    assert list(given.values()) == ["a", "a_", "x1a", "a_b"]


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("SCARA", "SCARA"),
        ("planar 2R", "planar_2R"),
        ("a - b..c", "a_b_c"),
        ("2R", "robot_2R"),
        ("math", "math_arm"),
        ("String", "String_arm"),
        ("numpy", "numpy_arm"),
        ("class", "class_arm"),
        ("double", "double"),
    ],
)
def test_files_are_named_after_the_table(name: str, stem: str) -> None:
    assert file_stem(name) == stem
    arm = replace(PLANAR, name=name)
    names = [file.name for target in TARGETS for file in generate(arm, target.name)]
    assert names[:3] == [f"{stem}.py", f"{stem}.h", f"{stem}.c"]
    others = set(names) - {"setup.py", "pyproject.toml"}
    assert all(name.lower().startswith(stem.lower()) for name in others)


def test_a_name_without_letters_is_refused() -> None:
    with pytest.raises(UnsupportedError, match="no letter"):
        file_stem("***")


def test_a_name_cannot_leave_its_comment(tmp_path: Path) -> None:
    arm = replace(PLANAR, name='a */ int x; """ \\ ??/')
    for file in (*generate(arm, "c"), *generate(arm, "python")):
        assert file.text.count("int x") == file.text.count("a __ int x")
    assert_poses(arm, random_joints(arm), run_c(arm, tmp_path, random_joints(arm)))
    assert callable(python_module(arm, tmp_path).fk)


# --------------------------------------------------------------------------------------- Python


def test_python_broadcasts_over_leading_axes(tmp_path: Path) -> None:
    fk = python_module(SCARA, tmp_path).fk
    joints = np.linspace(-1.0, 1.0, 24).reshape(2, 3, 4)
    poses = fk(joints)
    assert poses.shape == (2, 3, 4, 4)
    assert poses.dtype == np.float64
    assert np.abs(fk(joints[1, 2]) - poses[1, 2]).max() <= 2e-15
    assert fk(np.zeros((0, 4))).shape == (0, 4, 4)
    assert (fk([0, 0, 0, 0]) == fk(np.zeros(4, dtype=np.float32))).all()


@pytest.mark.parametrize("wrong", [0.0, [0.0] * 3, [0.0] * 5, np.zeros((4, 3))])
def test_python_refuses_a_wrong_last_axis(wrong: Any, tmp_path: Path) -> None:
    shape = re.escape(str(np.shape(wrong)))
    with pytest.raises(ValueError, match=rf"q must have shape \(\.\.\., 4\), not {shape}"):
        python_module(SCARA, tmp_path).fk(wrong)


def test_python_without_joint_variables(tmp_path: Path) -> None:
    fk = python_module(STILL_NUMBERS, tmp_path).fk
    assert fk([]).shape == (4, 4)
    assert fk(np.zeros((3, 0))).shape == (3, 4, 4)


def test_python_values_are_defaults_and_others_are_required(tmp_path: Path) -> None:
    fk = python_module(PUMA, tmp_path).fk
    with pytest.raises(TypeError, match="'d4'"):
        fk(np.zeros(6))
    with pytest.raises(TypeError):
        fk(np.zeros(6), 0.4318)
    # At q = 0 the arm is stretched along x: a2 + a3, and the wrist stands d4 up.
    pose = fk(np.zeros(6), d4=0.5, a2=2.0)
    assert pose[:3, 3] == pytest.approx([2.0 + 0.0203, -0.15005, 0.5])


def test_python_tells_joints_and_limits(tmp_path: Path) -> None:
    module = python_module(SCARA, tmp_path)
    assert module.N_JOINTS == 4
    assert module.JOINT_NAMES == ("q1", "q2", "q3", "q4")
    limit = math.radians(170)
    first, *others = module.JOINT_LIMITS
    assert first == pytest.approx((-limit, limit))
    assert others == [None, (0.0, 0.15), None]


def test_python_values_of_joint_variables_are_no_defaults(tmp_path: Path) -> None:
    arm = replace(PLANAR, values={Q1: RIGHT, A1: Integer(1), A2: Integer(1)})
    assert python_module(arm, tmp_path).fk([0.0, 0.0])[0, 3] == 2.0


@by_name
def test_python_examples_run_and_only_numpy_is_imported(
    robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (file,) = generate(robot, "python")
    imported = {
        name.name
        for node in ast.walk(ast.parse(file.text))
        if isinstance(node, ast.Import)
        for name in node.names
    }
    assert imported - sys.stdlib_module_names == {"numpy", "numpy.typing"}
    module = python_module(robot, tmp_path)
    stem = file.name.removesuffix(".py")
    monkeypatch.setitem(sys.modules, stem, module)
    results = doctest.testmod(module)
    assert results.attempted >= 4
    assert results.failed == 0


# -------------------------------------------------------------------------------------------- C


def test_c_takes_parameters_only_where_values_are_missing() -> None:
    header, source = generate(PUMA, "c")
    assert (
        "void puma560_fk(const double q[6], const puma560_params *p, double T[16]);" in header.text
    )
    assert re.findall(r"^    double (\w+);", header.text, re.MULTILINE) == ["d4"]
    assert "0.4318 * " in source.text
    header, _ = generate(SCARA, "c")
    assert "void SCARA_fk(const double q[4], double T[16]);" in header.text
    assert "SCARA_params" not in header.text
    header, _ = generate(STILL_NUMBERS, "c")
    assert "void still_numbers_fk(const double *q, double T[16]);" in header.text


def test_c_values_that_are_right_angles_fold() -> None:
    """A twist that the table knows to be 90 deg leaves no cos(pi/2) = 6e-17 behind."""
    arm = Robot(
        "arm", STANDARD, (revolute(Q1, alpha=BETA), revolute(Q2, a=A1)), values={BETA: RIGHT}
    )
    _, source = generate(arm, "c", trig="libm")
    assert "1.57" not in source.text
    forward, _, _ = source.text.partition("Inverse kinematics.")
    calls = set(re.findall(r"(?:sin|cos)\(\w+\)", forward))
    assert calls == {"cos(q1)", "cos(q2)", "sin(q1)", "sin(q2)"}


def test_c_refuses_a_header_of_another_table(tmp_path: Path) -> None:
    gcc = require_tool("gcc")
    _, source = write_all(generate(SCARA, "c"), tmp_path)
    command = [gcc, "-fsyntax-only", str(source)]
    assert subprocess.run(command, capture_output=True, check=False).returncode == 0
    other = replace(SCARA, values={**SCARA.values, A1: Rational(1, 5)})
    (tmp_path / "SCARA.h").write_text(generate(other, "c")[0].text, encoding="utf-8")
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "SCARA.h and SCARA.c come from different tables" in done.stderr


@pytest.mark.parametrize("robot", [PUMA, SCARA, STILL, STILL_NUMBERS], ids=lambda r: r.name)
def test_c_example_of_the_header_compiles(robot: Robot, tmp_path: Path) -> None:
    gcc = require_tool("gcc")
    header, source = write_all(generate(robot, "c"), tmp_path)
    example = re.search(r"Example:\n \*\n((?: \*     .*\n)+)", header.read_text(encoding="utf-8"))
    assert example is not None
    body = example[1].replace(" *    ", "")
    program = tmp_path / "main.c"
    end = "    return T[15] == 1.0 ? 0 : 1;\n"
    program.write_text(f'#include "{header.name}"\nint main(void)\n{{\n{body}{end}}}\n')
    binary = str(tmp_path / "example")
    command = [gcc, "-std=c99", "-Wall", "-Wextra", "-Werror", str(program), str(source)]
    subprocess.run([*command, "-o", binary, "-lm"], check=True)
    assert subprocess.run([binary], check=False).returncode == 0


def test_c_prefixes_every_external_symbol(tmp_path: Path) -> None:
    gcc, nm = require_tool("gcc"), require_tool("nm")
    _, source = write_all(generate(PUMA, "c"), tmp_path)
    built = tmp_path / "puma560.o"
    subprocess.run([gcc, "-c", str(source), "-o", str(built)], check=True)
    listed = subprocess.run([nm, "-g", str(built)], check=True, capture_output=True, text=True)
    found = re.findall(r"^\S* +([A-Z]) (\w+)$", listed.stdout, re.MULTILINE)
    ours = [name for kind, name in found if kind != "U"]
    assert ours == ["puma560_fk", "puma560_fk_jacobian", "puma560_ik", "puma560_jacobian"]
    from_libm = {"sin", "cos", "sincos", "atan2", "ceil", "fmax", "sqrt"}
    assert {name for kind, name in found if kind == "U"} <= from_libm


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_an_angle_that_is_no_number_gives_nan(bad: float, tmp_path: Path) -> None:
    """What does not depend on the angle stays; nothing traps and nothing else is written."""
    q = np.array([[0.1, bad, 0.05, 0.3]])
    python = python_module(SCARA, tmp_path).fk(q)
    traps = ["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"]
    for pose in (python[0], run_c(SCARA, tmp_path, q, traps)[0]):
        assert np.isnan(pose[:2, :2]).all()
        assert np.isnan(pose[:2, 3]).all()
        assert (pose[2] == [0.0, 0.0, -1.0, pytest.approx(1.0 + 0.05 - 0.1)]).all()
        assert (pose[3] == [0.0, 0.0, 0.0, 1.0]).all()


# ------------------------------------------------------------------------------ both languages


def has_closed_form(robot: Robot) -> bool:
    return "def ik(" in generate(robot, "python")[0].text


@by_name
def test_the_same_robot_gives_the_same_text(robot: Robot) -> None:
    for target in TARGETS:
        files = generate(robot, target.name)
        assert files == generate(robot, target.name)
        # MATLAB has a file for inverse kinematics where the arm has a closed form.
        extensions = [e for e in target.extensions if e != "_ik.m" or has_closed_form(robot)]
        assert len(files) == len(extensions)
        assert all(map(str.endswith, (file.name for file in files), extensions))
        for file in files:
            assert file.text.isascii()
            assert file.text.endswith("\n")
            assert not re.search(r"[ \t]$", file.text, re.MULTILINE)


def test_every_file_says_where_it_comes_from() -> None:
    for file in (*generate(SCARA, "python"), *generate(SCARA, "c")):
        head = file.text[:400]
        assert "Generated by symdh 0" in head
        assert fingerprint(SCARA)[:16] in head
        assert "Do not edit" in head
    for file in (generate(SCARA, "python")[0], generate(SCARA, "c")[0]):
        assert "standard, A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i)" in file.text
        assert "angles in rad, lengths in m" in file.text
        assert re.search(r"q\[(\.\.\., )?2\]  q3  prismatic  m    0\.0 to 0\.15", file.text)


def test_an_unknown_target_is_refused() -> None:
    with pytest.raises(UnsupportedError, match="python, c"):
        generate(PUMA, "cobol")


def test_listing_the_targets_imports_neither_sympy_nor_jinja2() -> None:
    check = (
        "import sys, symdh.codegen as c; c.TARGETS; print({'sympy', 'jinja2'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", check], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


# ------------------------------------------------------------------------------------- routines


def work(robot: Robot) -> tuple[int, int, int]:
    """Multiplications, additions and calls of one pose."""
    counts = forward_routine(robot).op_counts()
    multiplications = counts.pop(Op.MUL, 0)
    additions = counts.pop(Op.ADD, 0) + counts.pop(Op.SUB, 0)
    return multiplications, additions, sum(counts.values())


@pytest.mark.parametrize(
    ("robot", "most"),
    [(PUMA, (40, 20, 12)), (UR5, (36, 21, 12)), (PANDA, (68, 36, 14)), (PLANAR, (4, 3, 4))],
    ids=lambda value: value.name if isinstance(value, Robot) else "",
)
def test_work_of_known_arms(robot: Robot, most: tuple[int, int, int]) -> None:
    assert all(found <= limit for found, limit in zip(work(robot), most, strict=True))


@pytest.mark.parametrize("alpha", [Integer(0), RIGHT, 50 * DEGREE], ids=["0", "90", "50"])
def test_work_grows_linearly_with_the_joints(alpha: Expr) -> None:
    def arm(n: int) -> Robot:
        rows = (
            revolute(real(f"q{i}"), d=real(f"d{i}"), a=real(f"a{i}"), alpha=alpha)
            for i in range(1, n + 1)
        )
        return Robot("long", STANDARD, tuple(rows))

    at_50, at_100, at_200 = (sum(work(arm(n))) for n in (50, 100, 200))
    assert at_200 - at_100 == 2 * (at_100 - at_50)


def test_lines_of_a_long_arm_stay_short() -> None:
    rows = (revolute(real(f"q{i}"), a=real(f"a{i}")) for i in range(1, 51))
    arm = Robot("long", STANDARD, tuple(rows))
    for file in (*generate(arm, "python"), *generate(arm, "c")):
        assert max(map(len, file.text.splitlines())) <= 100


def test_values_that_are_equal_are_computed_once() -> None:
    routine = forward_routine(PUMA)
    texts = [(a.node.op, a.node.args) for a in routine.assignments]
    assert len(texts) == len(set(texts))
    assert [a.name for a in routine.assignments[:7]] == [
        "c1",
        "s1",
        "c2",
        "s2",
        "angle23",
        "c23",
        "s23",
    ]


def test_assignments_use_only_what_stands_above_them() -> None:
    for robot in ROBOTS:
        routine = forward_routine(robot)
        indices = [assignment.node.index for assignment in routine.assignments]
        assert indices == sorted(indices)
        assert [(o.row, o.column) for o in routine.outputs] == [
            (row, column) for row in range(3) for column in range(4)
        ]


@pytest.mark.parametrize(
    ("angle", "label"),
    [
        (Q1, "1"),
        (Q2 + Q3, "23"),
        (Q1 - Q2, "1m2"),
        (Q2 + 30 * DEGREE, "2"),
        (BETA, "_beta"),
        (BETA - Q1, "_beta_q1"),
        (real("q9") + real("q10"), "9_10"),
        (sum(real(f"q{i}") for i in range(2, 9)), "2to8"),
    ],
)
def test_cosines_are_called_what_books_call_them(angle: Expr, label: str) -> None:
    lowering = Lowering(Graph(), {real(f"q{i}"): i for i in range(1, 12)})
    cosine, _ = lowering.cos_sin(angle)
    assert lowering.names[cosine] == f"c{label}"


def test_sums_that_begin_alike_share_their_joints() -> None:
    lowering = Lowering(Graph(), {real(f"q{i}"): i for i in range(1, 12)})
    angle = {sum_: lowering.cos_sin(sum_)[0].args[0] for sum_ in (Q1 + Q2, Q1 + Q2 + BETA)}
    assert angle[Q1 + Q2] in angle[Q1 + Q2 + BETA].args


@pytest.mark.parametrize("quarters", range(-5, 6))
@pytest.mark.parametrize("sign", [1, -1])
def test_quarter_turns_and_signs_are_taken_out_of_angles(quarters: int, sign: int) -> None:
    lowering = Lowering(Graph(), {Q1: 1})
    cosine, sine = lowering.cos_sin(sign * Q1 + quarters * RIGHT)
    c, s = lowering.cos_sin(Q1)
    at = {c: math.cos(0.3), s: math.sin(0.3)}
    values = {**at, **{lowering.graph.neg(node): -x for node, x in at.items()}}
    angle = sign * 0.3 + quarters * math.pi / 2
    assert values[cosine] == pytest.approx(math.cos(angle))
    assert values[sine] == pytest.approx(math.sin(angle))


def test_graph_folds_zero_one_and_signs() -> None:
    g = Graph()
    x, y = g.symbol(Q1), g.symbol(Q2)
    half = g.constant(Rational(1, 2))
    assert g.mul(g.zero, x) is g.zero
    assert g.mul(x, g.one) is x
    assert g.add(x, g.zero) is x
    assert g.sub(x, g.zero) is x
    assert g.sub(x, x) is g.zero
    assert g.sub(g.zero, x) is g.neg(x)
    assert g.neg(g.neg(x)) is x
    assert g.mul(x, y) is g.mul(y, x)
    assert g.add(x, y) is g.add(y, x)
    assert g.add(x, g.neg(y)) is g.sub(x, y)
    assert g.add(g.neg(x), y) is g.sub(y, x)
    assert g.sub(y, x) is g.neg(g.sub(x, y))
    assert g.sub(x, g.neg(y)) is g.add(x, y)
    assert g.sub(g.neg(x), y) is g.neg(g.add(x, y))
    assert g.mul(g.neg(x), g.neg(y)) is g.mul(x, y)
    assert g.mul(g.constant(Rational(-1, 2)), x) is g.neg(g.mul(half, x))
    assert g.div(g.neg(x), g.neg(y)) is g.div(x, y)
    assert g.mul(half, half).value == Rational(1, 4)
    assert g.mul(half, g.constant(sqrt(2))).value == sqrt(2) / 2


@pytest.mark.parametrize(
    "odd",
    [Function("mystery")(L1), 2**L1, L1**L2, L1 * I, Float("0.5") * L1, L1 + sqrt(-2)],
    ids=str,
)
def test_what_has_no_code_is_refused(odd: Expr) -> None:
    arm = Robot("arm", STANDARD, (revolute(Q1, a=odd),))
    for target in TARGETS:
        with pytest.raises(UnsupportedError):
            generate(arm, target.name)


# ------------------------------------------------------------------------------------- literals


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (Integer(0), "0.0"),
        (Integer(2), "2.0"),
        (Rational("0.4318"), "0.4318"),
        (Rational(-1, 3), "-0.3333333333333333"),
        (Integer(10) ** 30, "1.0e30"),
        (Rational(5, 4 * 10**7), "1.25e-7"),
        (pi / 2, "1.5707963267948966"),
        (sqrt(2) / 2, "0.7071067811865476"),
        (cos(17 * DEGREE), "0.9563047559630354"),
        (Rational(1, 10**400), "0.0"),
    ],
)
def test_literals_are_the_shortest_of_the_nearest_double(value: Expr, text: str) -> None:
    assert literal(value) == text


@pytest.mark.parametrize(
    ("length", "number", "found"),
    [
        (sqrt(L1 - 1), Rational(1, 2), "equal to sqrt(2)*I/2, which is not a real number"),
        (1 / L1, Integer(0), "infinite: a division by zero"),
    ],
)
def test_values_that_make_no_real_length_are_named(length: Expr, number: Expr, found: str) -> None:
    arm = Robot("arm", STANDARD, (revolute(Q1, a=length),), values={L1: number})
    says = f"these values make {length} {found}"
    with pytest.raises(UnsupportedError, match=re.escape(says)):
        generate(arm, "c")


@pytest.mark.parametrize("value", [Integer(10) ** 400, sqrt(-1), asin(2), Float("0.5"), pi**1000])
def test_numbers_that_no_double_holds_are_refused(value: Expr) -> None:
    with pytest.raises(UnsupportedError):
        literal(value)


# ---------------------------------------------------------------------------------- fingerprint


def test_a_header_and_a_source_of_different_tables_do_not_compile(tmp_path: Path) -> None:
    gcc = require_tool("gcc")
    longer = replace(SCARA, values={**SCARA.values, Symbol("a1", real=True): Rational(1, 2)})
    header, _ = generate(SCARA, "c")
    for robot, compiles in ((SCARA, True), (longer, False)):
        source = generate(robot, "c")[1]
        (tmp_path / header.name).write_text(header.text)
        (tmp_path / source.name).write_text(source.text)
        command = [gcc, "-c", source.name, "-o", "out.o"]
        ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert (ran.returncode == 0) is compiles
        assert ("come from different tables: generate both again" in ran.stderr) is not compiles


def test_fingerprint_is_the_hash_of_a_plain_text() -> None:
    text = "\n".join(
        [
            "name SCARA",
            "convention standard",
            "units deg m",
            "joint revolute q1 q1 d1 a1 0",
            "joint revolute q2 q2 0 a2 0",
            "joint prismatic q3 0 q3 0 0",
            "joint revolute q4 q4 d4 0 pi",
            "value a1 1/4",
            "value a2 1/3",
            "value d1 1",
            "value d4 -1/10",
            "limits q1 (Mul -17/18 pi) (Mul 17/18 pi)",
            "limits q3 0 3/20",
        ]
    )
    assert fingerprint(SCARA) == hashlib.sha256(text.encode()).hexdigest()


def test_fingerprint_does_not_depend_on_spelling() -> None:
    backwards = dict(reversed(SCARA.values.items()))
    assert fingerprint(replace(SCARA, values=backwards, title="text")) == fingerprint(SCARA)


@pytest.mark.parametrize(
    "change",
    [
        {"name": "scara"},
        {"convention": MODIFIED},
        {"joints": SCARA.joints[:3]},
        {"base": (moved(Axis.X, A1),)},
        {"tool": (moved(Axis.X, A1),)},
        {"tool": (moved(Axis.Y, A1),)},
        {"tool": (rotated(Axis.X, A1),)},
        {"values": {}},
        {"limits": {}},
        {"units": Units(AngleUnit.DEGREE, LengthUnit.MILLIMETRE)},
    ],
    ids=str,
)
def test_fingerprint_sees_every_change(change: dict[str, Any]) -> None:
    changed = replace(SCARA, **change)
    assert fingerprint(changed) != fingerprint(SCARA)
    assert len({fingerprint(replace(SCARA, tool=t)) for t in ((), SIGNS.tool, PANDA.tool)}) == 3


# -------------------------------------------------------------------------------- surroundings


def test_missing_templates_are_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resources, "__file__", str(tmp_path / "symdh" / "resources.py"))
    with pytest.raises(ReadError, match="install symdh again"):
        resources.templates_dir()
    (tmp_path / "templates").mkdir()
    assert resources.templates_dir() == tmp_path / "templates"
    (tmp_path / "symdh" / "templates").mkdir(parents=True)
    assert resources.templates_dir() == tmp_path / "symdh" / "templates"


def test_a_missing_tool_skips_here_and_fails_in_ci(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CI", raising=False)
    with pytest.raises(pytest.skip.Exception, match="no-such-tool is not installed"):
        require_tool("no-such-tool")
    monkeypatch.setenv("CI", "true")
    with pytest.raises(pytest.fail.Exception, match="no-such-tool is not installed"):
        require_tool("no-such-tool")
