"""The sines and cosines that generated C inlines, float, and batches: how exact, and whatever q is.

The oracles are x87 extended precision, eleven bits beyond a double, and mpmath at 50 digits.
"""

from __future__ import annotations

import ctypes
import itertools
import math
import re
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from generated import STRICT_C
from lint_c import findings
from oracle import EXTENDED, FIFTY_DIGITS, read_arm_file
from sympy import Integer, Rational, Symbol, cos, sin, sqrt
from test_codegen import (
    D4,
    OBLIQUE,
    PANDA,
    PUMA,
    Q1,
    Q2,
    RIGHT,
    ROBOTS,
    SCARA,
    STANDARD,
    UR5,
    open_parameters,
    real,
    revolute,
    write_all,
)

import symdh
from symdh.codegen import generate
from symdh.codegen.c.folding import fold
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.inverse.compiled import Section
from symdh.codegen.precision import DOUBLE, FLOAT, Precision
from symdh.codegen.stages import cut_stages
from symdh.codegen.targets import c
from symdh.errors import UnsupportedError
from symdh.robot import Convention, Joint, JointType, Robot
from tools import has_instructions, require_tool

TABLES = Path(__file__).parent / "data" / "tables"
TURN = Robot("turn", STANDARD, (revolute(Q1),))
#: What the comment of the kernel says of its own errors.
CLAIM = r"At most (\d) ulp off for \|x\| <= 100, and (\d) ulp up to (\S+) rad"
SPATIAL = Robot(
    "spatial", STANDARD, tuple(revolute(real(f"q{i}"), alpha=RIGHT, a=Integer(1)) for i in range(7))
)
KINDS = {"double": (np.float64, ctypes.c_double), "float": (np.float32, ctypes.c_float)}

#: What the kernel is compiled to: two lanes, four, four with fused multiply-add, none at all, the
#: library.
BUILDS = {
    "sse2": [],
    "avx": ["-mavx"],
    "fma": ["-march=haswell", "-ffp-contract=fast"],
    "scalar": ["-U__SSE2__"],
    "O0": ["-O0"],
    "library": ["-ffast-math", "-fno-finite-math-only"],
}
#: Eight doubles of a batch side by side; not every machine has registers for that.
if has_instructions("avx512f"):
    BUILDS["avx512"] = ["-mavx512f", "-mfma"]


_numbers = itertools.count()


@pytest.fixture(autouse=True)
def _without_inverse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the inverse kinematics out: half of every compiler's time, and not looked at here."""
    without = Section("it is not looked at here")
    monkeypatch.setattr(c, "c_section", lambda *arguments, **options: without)


@dataclass(frozen=True)
class Built:
    """Generated C, compiled together with a loop over poses."""

    library: Any
    kind: str
    n: int
    size: int

    def __call__(self, q: np.ndarray, parameters: Sequence[float] = ()) -> np.ndarray:
        dtype, ctype = KINDS[self.kind]
        flat = np.ascontiguousarray(q, dtype=dtype).reshape(-1, self.n)
        found = np.full((len(flat), self.size), math.nan, dtype=dtype)
        pointer = ctypes.POINTER(ctype)
        self.library.many(
            ctypes.c_long(len(flat)),
            flat.ctypes.data_as(pointer),
            (ctype * max(1, len(parameters)))(*parameters),
            found.ctypes.data_as(pointer),
        )
        return found


def build(
    robot: Robot,
    folder: Path,
    *flags: str,
    compiler: str = "gcc",
    kind: str = "double",
    function: str = "fk",
    **options: Any,
) -> Built:
    """Compile `NAME_fk`, or another function of one result, under a loop."""
    program = require_tool(compiler)
    files = write_all(generate(robot, "c", precision=kind, **options), folder)
    stem, n = files[1].stem, len(robot.variables)
    size = 16 if function == "fk" else 6 * n
    p = f"(const {stem}_params *)p, " if open_parameters(robot) else ""
    number = next(_numbers)
    loop = folder / f"loop{number}.c"
    loop.write_text(
        f'#include "{stem}.c"\n'
        f"void many(long count, const {kind} *q, const {kind} *p, {kind} *result)\n"
        "{\n    long i;\n    (void)p;\n    for (i = 0; i < count; ++i) "
        f"{{ {stem}_{function}(&q[{n} * i], {p}&result[{size} * i]); }}\n}}\n"
    )
    built, library = loop.with_suffix(".o"), loop.with_suffix(".so")
    command = [program, "-std=c99", "-O2", *flags, "-fPIC", "-c", str(loop), "-o", str(built)]
    subprocess.run(command, check=True, capture_output=True)
    # Linked without -ffast-math, which would make the whole process flush small numbers to zero.
    link = [program, *(f for f in flags if "sanitize" in f), "-shared", str(built)]
    subprocess.run([*link, "-o", str(library), "-lm"], check=True, capture_output=True)
    return Built(ctypes.CDLL(str(library)), kind, n, size)


# ------------------------------------------------------------------------------------ the kernel


def hard_angles(largest: float, dtype: Any) -> np.ndarray:
    """Random angles, and those next to multiples of 45 deg, where digits cancel."""
    generator = np.random.default_rng(11)
    count = int(largest / (math.pi / 4))
    multiples = generator.choice(np.arange(-count, count + 1), 300)
    with mpmath.workdps(40):
        edges = np.array([mpmath.pi / 4 * int(k) for k in multiples], dtype=object).astype(dtype)
    return np.concatenate(
        [
            generator.uniform(-largest, largest, 40_000).astype(dtype),
            10.0 ** generator.uniform(-30, 0, 2_000).astype(dtype),
            edges,
            np.nextafter(edges, dtype(np.inf)),
            np.nextafter(edges, dtype(-np.inf)),
        ]
    )


def errors_in_ulp(built: Built, angles: np.ndarray) -> float:
    """Largest error of the cosine and the sine of some angles, in units of the last place."""
    found = built(angles)
    angles = angles.astype(EXTENDED.dtype)
    worst = 0.0
    for column, exact in ((0, EXTENDED.cos(angles)), (4, EXTENDED.sin(angles))):
        unit = np.spacing(np.abs(exact).astype(found.dtype)).astype(EXTENDED.dtype)
        worst = max(worst, float(np.max(np.abs(found[:, column] - exact) / unit)))
    return worst


def test_extended_precision_is_fit_to_be_an_oracle() -> None:
    angles = hard_angles(100.0, np.float64)[::211]
    for function, exact in ((EXTENDED.sin, FIFTY_DIGITS.sin), (EXTENDED.cos, FIFTY_DIGITS.cos)):
        for x, found in zip(angles, function(angles.astype(EXTENDED.dtype)), strict=True):
            high = float(found)
            low = float(found - np.longdouble(high))
            true = exact(FIFTY_DIGITS.number(float(x)))
            assert abs((true - high) - low) <= 2.0**-63 * abs(true)


@pytest.mark.parametrize("flags", BUILDS.values(), ids=BUILDS)
@pytest.mark.parametrize(
    ("kind", "largest", "ulps"),
    [("double", 100.0, 2.0), ("double", 1e6, 3.0), ("float", 100.0, 3.0), ("float", 500.0, 3.0)],
)
def test_the_kernel_is_as_exact_as_its_comment_says(
    kind: str, largest: float, ulps: float, flags: list[str], tmp_path: Path
) -> None:
    built = build(TURN, tmp_path, *flags, kind=kind)
    (source,) = tmp_path.glob("turn*.c")
    comment = " ".join(source.read_text().replace("*", " ").split())
    near, far, limit = re.search(CLAIM, comment).groups()  # type: ignore[union-attr]
    assert int(near if largest <= 100 else far) == ulps
    assert largest <= float(limit.rstrip("f"))
    assert errors_in_ulp(built, hard_angles(largest, KINDS[kind][0])) <= ulps


@pytest.mark.parametrize("flags", [[], ["-mavx"], ["-fassociative-math", "-fno-signed-zeros"]])
def test_the_kernel_under_clang(flags: list[str], tmp_path: Path) -> None:
    """Clang tells nobody about -fassociative-math: a pragma takes it back."""
    more = ["-fno-trapping-math", *flags] if len(flags) > 1 else flags
    built = build(TURN, tmp_path, *more, compiler="clang")
    assert errors_in_ulp(built, hard_angles(100.0, np.float64)) <= 2.0


def test_every_lane_takes_its_own_angle(tmp_path: Path) -> None:
    """Seven joints: a group of four and one of three, each lane unlike the others."""
    q = np.random.default_rng(3).uniform(-math.pi, math.pi, (200, 7))
    for name, flags in BUILDS.items():
        (tmp_path / name).mkdir()
        inline = build(SPATIAL, tmp_path / name, *flags)(q)
        library = build(SPATIAL, tmp_path / name, trig="libm")(q)
        assert np.abs(inline - library).max() < 1e-14


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("flags", [[], ["-mavx"], ["-U__SSE2__"]], ids=["2", "4", "1"])
def test_a_bad_angle_spoils_only_what_depends_on_it(
    bad: float, flags: list[str], tmp_path: Path
) -> None:
    q = np.random.default_rng(4).uniform(-1, 1, (7, 7))
    q[np.arange(7), np.arange(7)] = bad
    function = build(SPATIAL, tmp_path, *flags, function="jacobian")
    good = function(np.where(np.isfinite(q), q, 0.25))
    for place, (row, other) in enumerate(zip(function(q), good, strict=True)):
        # The axes of this joint and of those before it do not depend on it.
        axes, same = (x.reshape(6, 7)[3:, : place + 1] for x in (row, other))
        assert np.allclose(axes, same, atol=1e-15)
        assert np.isnan(row.reshape(6, 7)[:3, 0]).any()


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_traps_whatever_q_is(kind: str, tmp_path: Path) -> None:
    sanitizers = "-fsanitize=undefined,float-cast-overflow,float-divide-by-zero"
    odd = [math.nan, math.inf, -math.inf, 1e300, -1e300, 1e20, 1e6, 5e5, -0.0, 5e-324]
    q = np.array([[x, *np.roll(odd, k)[:5]] for k, x in enumerate(odd)])
    with np.errstate(over="ignore"):
        q = q.astype(KINDS[kind][0])
    for name in ("sse2", "avx", "scalar"):
        flags = BUILDS[name]
        (tmp_path / name).mkdir()
        traps = [*flags, sanitizers, "-fsanitize-undefined-trap-on-error"]
        poses = build(PUMA, tmp_path / name, *traps, kind=kind, batch=True)(q, [0.5])
        finite = np.isfinite(q).all(axis=1) & (np.abs(q) < 1e30).all(axis=1)
        assert np.isfinite(poses[finite]).all()
        assert np.abs(poses[finite]).max() < 2.0


# ----------------------------------------------------------------------------------- large angles


@pytest.mark.parametrize("table", ["puma560", "ur5", "kinova_jaco", "planar_3r", "scara_rrpr"])
@pytest.mark.parametrize("largest", [1e2, 1e6])
def test_large_angles_cost_no_digits(table: str, largest: float, tmp_path: Path) -> None:
    """GC03: a sum of two angles of 1e6 rad is off by 1e-10 rad; what it lost is taken in."""
    path = TABLES / f"{table}.yaml"
    arm = read_arm_file(path)
    generator = np.random.default_rng(9)
    q = generator.uniform(0.5, 1.0, (12, len(arm.variables))) * generator.choice([-1, 1])
    for k, (_, turns) in enumerate(arm.variables):
        q[:, k] *= largest if turns else 0.5
    joints = {name: FIFTY_DIGITS.array(q[:, k]) for k, (name, _) in enumerate(arm.variables)}
    exact = arm.pose(joints, arithmetic=FIFTY_DIGITS)
    for flags in ([], ["-mavx"]):
        found = build(symdh.load(path), tmp_path, *flags)(q).reshape(-1, 4, 4)
        assert float(np.max(np.abs(found - exact))) <= 8 * 2.0**-52 * max(1.0, arm.reach())


# -------------------------------------------------------------------------------- float and batch


def arm_numbers(robot: Robot) -> list[float]:
    return open_parameters(robot)


@pytest.mark.parametrize("robot", [PUMA, UR5, PANDA, SCARA, OBLIQUE], ids=lambda r: r.name)
def test_float_agrees_with_double(robot: Robot, tmp_path: Path) -> None:
    q = np.random.default_rng(5).uniform(-3, 3, (50, len(robot.variables))).astype(np.float32)
    single = build(robot, tmp_path, *STRICT_C, kind="float")(q, arm_numbers(robot))
    double = build(robot, tmp_path)(q, arm_numbers(robot))
    reach = max(1.0, float(np.abs(double).max()) * math.sqrt(3), robot.n)
    assert single.dtype == np.float32
    assert np.abs(single - double).max() <= (4 + 2 * robot.n) * 2.0**-23 * reach


@pytest.mark.parametrize("robot", [PUMA, OBLIQUE, SCARA], ids=lambda r: r.name)
def test_float_never_widens(robot: Robot, tmp_path: Path) -> None:
    """GC04: no literal, call or conversion in double precision."""
    gcc = require_tool("gcc")
    source = write_all(generate(robot, "c", precision="float", batch=True), tmp_path)[1]
    assert source.name == f"{robot.name.replace(' ', '_')}_float.c"
    assert "double" not in source.read_text()
    for flags in ([], ["-march=haswell"], ["-U__SSE2__"]):
        command = [gcc, "-std=c99", "-O2", *STRICT_C, *flags, "-S", "-o", "-", str(source)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert "cvtss2sd" not in done.stdout
        assert "cvtps2pd" not in done.stdout


def test_float_has_names_of_its_own(tmp_path: Path) -> None:
    """Both kinds link into one program."""
    gcc = require_tool("gcc")
    for kind in KINDS:
        write_all(generate(PUMA, "c", precision=kind), tmp_path)
    main = tmp_path / "main.c"
    main.write_text(
        '#include "puma560.h"\n#include "puma560_float.h"\n'
        "int main(void)\n{\n    const float qf[6] = {0};\n    float Tf[16];\n"
        "    const double q[6] = {0};\n    double T[16];\n    const puma560_params p = {0.4};\n"
        "    const puma560_float_params pf = {0.4f};\n    puma560_fk(q, &p, T);\n"
        "    puma560_float_fk(qf, &pf, Tf);\n    return T[15] != 1.0 || Tf[15] != 1.0f;\n}\n"
    )
    sources = [str(path) for path in sorted(tmp_path.glob("*.c"))]
    command = [gcc, "-std=c99", "-Wall", "-Werror", *sources, "-o", str(tmp_path / "main"), "-lm"]
    subprocess.run(command, check=True)
    assert subprocess.run([tmp_path / "main"], check=False).returncode == 0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("robot", [PUMA, SCARA, OBLIQUE], ids=lambda r: r.name)
def test_a_batch_is_poses_one_by_one(robot: Robot, kind: str, tmp_path: Path) -> None:
    """Any count, strides wider than the count, angles that are not for the kernel among others."""
    dtype, ctype = KINDS[kind]
    count, n = 23, len(robot.variables)
    q = np.random.default_rng(6).uniform(-3, 3, (count, n)).astype(dtype)
    q[3, n - 1], q[7, 0], q[20, n - 1] = math.nan, 3e6, -4e3
    pointer = ctypes.POINTER(ctype)
    numbers = arm_numbers(robot)
    given = [(ctype * len(numbers))(*numbers)] if numbers else []
    for name in BUILDS if robot is PUMA else ("sse2", "avx"):
        flags = BUILDS[name]
        (tmp_path / name).mkdir()
        built = build(robot, tmp_path / name, *flags, kind=kind, batch=True)
        one_by_one = built(q, numbers)
        stem = next((tmp_path / name).glob("*.h")).stem
        rows = np.full((n, 31), math.nan, dtype=dtype)
        rows[:, :count] = q.T
        for size in (0, 1, 2, 5, 8, 9, 16, count):
            arrays = np.full((13, 37), 7.0, dtype=dtype)
            getattr(built.library, f"{stem}_fk_batch")(
                ctypes.c_size_t(size),
                rows.ctypes.data_as(pointer),
                ctypes.c_size_t(31),
                *given,
                arrays.ctypes.data_as(pointer),
                ctypes.c_size_t(37),
            )
            poses = np.full((count + 1, 16), 7.0, dtype=dtype)
            getattr(built.library, f"{stem}_fk_poses")(
                ctypes.c_size_t(size),
                q.ctypes.data_as(pointer),
                *given,
                poses.ctypes.data_as(pointer),
            )
            tolerance = 8 * float(np.finfo(dtype).eps) * 8
            for found, width in ((arrays[:12, :size].T, 12), (poses[:size], 16)):
                np.testing.assert_allclose(found, one_by_one[:size, :width], 0, tolerance)
            assert (arrays[12] == 7.0).all()
            assert (arrays[:, size:] == 7.0).all()
            assert (poses[size:] == 7.0).all()


def test_a_batch_may_turn_by_a_parameter_and_slide_by_a_sine(tmp_path: Path) -> None:
    """A twist b that is open, a cam that takes the sine alone, a length that takes a cosine."""
    b, e = Symbol("b", real=True), Symbol("e", real=True)
    cam = Joint(JointType.PRISMATIC, Integer(0), 3 * sin(Q1), Integer(0), b, Q1)
    arm = Robot("cam", Convention.STANDARD, (cam, revolute(Q2, a=2 * cos(e))))
    built = build(arm, tmp_path, batch=True)
    q = np.array([[0.4, 1.2], [2.0, -0.3], [-0.7, 3.0]])
    poses = np.zeros((3, 16))
    pointer = ctypes.POINTER(ctypes.c_double)
    built.library.cam_fk_poses(
        ctypes.c_size_t(3),
        q.ctypes.data_as(pointer),
        (ctypes.c_double * 2)(0.5, 0.3),
        poses.ctypes.data_as(pointer),
    )
    cb, sb, a = math.cos(0.5), math.sin(0.5), 2 * math.cos(0.3)
    for (lift, turn), pose in zip(q, poses, strict=True):
        c, s = math.cos(turn), math.sin(turn)
        # The slide along z, then Rx(b), then Rz(turn) and a along the new x.
        by_hand = [c, -s, 0, a * c, cb * s, cb * c, -sb, a * cb * s]
        by_hand += [sb * s, sb * c, cb, 3 * math.sin(lift) + a * sb * s, 0, 0, 0, 1]
        np.testing.assert_allclose(pose, by_hand, 0, 1e-14)


def test_a_root_of_a_joint_variable_has_no_batch() -> None:
    slide = Joint(JointType.PRISMATIC, Integer(0), sqrt(Q1), Integer(0), Integer(0), Q1)
    arm = Robot("root", Convention.STANDARD, (slide,))
    assert generate(arm, "c")
    with pytest.raises(UnsupportedError, match="sqrt of a joint variable has no batch form"):
        generate(arm, "c", batch=True)


def test_batch_functions_are_left_out_unless_asked_for() -> None:
    header, source = generate(PUMA, "c")
    assert "batch" not in header.text + source.text
    header, source = generate(PUMA, "c", batch=True)
    assert "void puma560_fk_batch(size_t count," in header.text
    assert "void puma560_fk_poses(size_t count," in source.text


# --------------------------------------------------------------------------------- what is written


def test_libm_is_called_where_it_is_asked_for() -> None:
    _, source = generate(PUMA, "c", trig="libm")
    assert set(re.findall(r"\b(?:sin|cos)\((\w+)\)", source.text)) >= {"q1", "angle23", "q6"}
    assert "vector_size" not in source.text


def test_only_angles_that_are_sums_carry_what_they_lost() -> None:
    _, with_sums = generate(PUMA, "c")
    assert "const double lost23 = puma560_lost(q2, q3, angle23);" in with_sums.text
    _, without = generate(PANDA, "c")
    assert "_lost(" not in without.text


def test_a_difference_and_a_sum_of_sums_lose_what_their_parts_lose(tmp_path: Path) -> None:
    """theta_1 - theta_2 + theta_3 at 1e6 rad, the second joint's axis turned over."""
    arm = Robot(
        "folded",
        STANDARD,
        (
            revolute(Q1, alpha=Integer(2) * RIGHT),
            revolute(Q2, alpha=Integer(2) * RIGHT),
            revolute(real("q3"), theta=real("q3") + Rational(1, 3)),
        ),
    )
    q = np.random.default_rng(8).uniform(-1e6, 1e6, (40, 3))
    found = build(arm, tmp_path)(q)
    with mpmath.workdps(50):
        for (a, b, c), pose in zip(q, found, strict=True):
            total = mpmath.mpf(a) - mpmath.mpf(b) + mpmath.mpf(c) + mpmath.mpf(1) / 3
            assert abs(pose[0] - mpmath.cos(total)) < 1e-15
            assert abs(pose[4] - mpmath.sin(total)) < 1e-15


def test_stages_put_angles_behind_what_they_are_made_of() -> None:
    for robot in ROBOTS:
        staged = cut_stages(forward_routine(robot))
        known = set(staged.routine.inputs)
        for stage in staged.stages:
            for assignment in stage.assignments:
                assert assignment.node.op not in (Op.SIN, Op.COS)
                known.add(assignment.node)
            for angle in stage.angles:
                both = [a for a in (angle.sine, angle.cosine) if a is not None]
                assert all(a.node.args == (angle.node,) for a in both)
                known |= {a.node for a in both}
        assert known >= {a.node for a in staged.routine.assignments}
        assert not staged.stages[-1].angles


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("robot", [PUMA, OBLIQUE], ids=lambda r: r.name)
def test_lines_stay_within_a_hundred_columns(robot: Robot, kind: str) -> None:
    for file in generate(robot, "c", precision=kind, batch=True):
        assert max(map(len, file.text.splitlines())) <= 100


def test_a_line_is_filled_up_to_a_hundred_columns() -> None:
    full = "    f(" + "x" * 80 + ", " + "y" * 11 + ","
    assert len(full) == 100
    assert fold(full) == full
    assert fold(f"{full} z);") == f"{full}\n            z);"
    assert fold(f"    f({full[5:]} z);") == f"    f({full[5:-13]}\n            yyyyyyyyyyy, z);"


def test_long_lines_are_broken_at_operators_and_commas() -> None:
    terms = [f"first{i} * second{i}" for i in range(12)]
    lines = fold("    const double x = " + " + ".join(terms) + ";").split("\n")
    assert len(lines) == 3
    assert lines[0].startswith("    const double x = first0 * second0 + first1")
    assert all(line.startswith(12 * " ") for line in lines[1:])
    assert " ".join(line.strip() for line in lines) == "const double x = " + " + ".join(terms) + ";"


@pytest.mark.parametrize(
    ("precision", "value", "text"),
    [
        (DOUBLE, Rational(1, 3), "0.3333333333333333"),
        (FLOAT, Rational(1, 3), "0.33333334f"),
        (FLOAT, Integer(2), "2.0f"),
        (FLOAT, Rational(1, 10**10), "1.0e-10f"),
        (FLOAT, Integer(10) ** 20, "1.0e20f"),
    ],
)
def test_literals_of_each_kind(precision: Precision, value: Any, text: str) -> None:
    assert precision.literal(value) == text


def test_a_number_beyond_float_is_refused() -> None:
    far = replace(PUMA, values={**PUMA.values, D4: Integer(10) ** 39})
    assert generate(far, "c")
    with pytest.raises(UnsupportedError, match="float"):
        generate(far, "c", precision="float")


def test_options_of_another_target_are_refused() -> None:
    with pytest.raises(UnsupportedError, match="'precision'"):
        generate(PUMA, "python", precision="float")


@pytest.mark.parametrize("kind", KINDS)
def test_clang_has_nothing_to_say(kind: str, tmp_path: Path) -> None:
    """A sample of `make lint-c`, which takes every compiler, linter and table."""
    require_tool("clang")
    source = write_all(generate(OBLIQUE, "c", precision=kind, batch=True), tmp_path)[1]
    assert findings(source, only=("clang",)) == []
