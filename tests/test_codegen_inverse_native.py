"""Inverse kinematics in C of single precision, C++, Rust and the Python extension.

Each is compiled with warnings as errors and run by its own tools on the same poses: random ones,
singular ones, some out of reach, and some that are no poses. The oracle judges the answers, and
generated Python, which was judged itself, says how many there are.

SYMDH_IK_NATIVE=all takes every table of the corpus that has a closed form.
"""

from __future__ import annotations

import functools
import math
import os
import re
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from inverse_checks import CLOSED, LOCKS
from inverse_code import CInverse, Loaded, compile_inverse, load
from sympy import Symbol
from test_codegen_extension import build
from test_targets import CPP, cpp_parameters, require_eigen, run

import symdh
from symdh.codegen import generate
from symdh.codegen.targets import rust
from symdh.robot import Robot
from tools import find_tool, new_folder, require_tool

FEW = (
    *("puma560", "ur5", "pieper_generic", "stanford_textbook", "scara_rrpr", "minimover_5r"),
    *("planar_2r", "zyz_wrist", "cartesian_ppp", "ikbt_ArmRobo", "kuka_iiwa7", "elbow_3r"),
)
EVERY = os.environ.get("SYMDH_IK_NATIVE") == "all"
#: With base, tool, limits and parameters without a value, which no table of the corpus has.
OWN = sorted((Path(__file__).parent / "data" / "inverse").glob("*.yaml"))
TABLES = [*(table for table in CLOSED if EVERY or table.stem in FEW), *OWN]
POSES = int(os.environ.get("SYMDH_IK_POSES", "10"))

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda table: table.stem)


@dataclass(frozen=True)
class Answers:
    """What one call gave: joint values (count, n), and their masks of free joints."""

    q: np.ndarray
    masks: tuple[int, ...]


@dataclass(frozen=True)
class Case:
    """A table with what is asked of it.

    Attributes
    ----------
    arm : Loaded
        What the oracle says of it, and its generated Python.
    own : ndarray, shape (random poses, n)
        The joint values of the random poses.
    goals : ndarray, shape (poses, 4, 4)
        Random ones, then hard ones, then some that have no answer.
    seeds : ndarray, shape (poses, n)
    expected : list of Answers
        Of generated Python.
    nowhere : int
        How many at the end have no answer.
    """

    table: Path
    arm: Loaded
    own: np.ndarray
    goals: np.ndarray
    seeds: np.ndarray
    expected: list[Answers]
    nowhere: int

    @property
    def options(self) -> dict[str, object]:
        return {"lock": _locks(self.table)} if self.table.stem in LOCKS else {}

    @property
    def n(self) -> int:
        return self.own.shape[1]

    @property
    def values(self) -> Mapping[str, float]:
        """Numbers for the parameters without a value."""
        return self.arm.values


def _locks(table: Path) -> tuple[Symbol, ...]:
    return (Symbol(LOCKS[table.stem], real=True),) if table.stem in LOCKS else ()


@functools.cache
def case(table: Path) -> Case:
    folder = new_folder(table.stem)
    arm = load(table, folder, [s.name for s in _locks(table)])
    own = arm.arm.seeded_poses(POSES, seed=71)
    hard = arm.arm.seeded_poses(6, seed=72)
    quarters = np.random.default_rng(73).integers(-1, 3, hard.shape) * np.pi / 2
    hard[:3] = np.where(arm.turns, quarters[:3], hard[:3])
    # One angle at 0, as the wrist of a PUMA has it, and one a little beside.
    for k, joint in enumerate((4, 2, 1)):
        if joint < own.shape[1] and arm.turns[joint]:
            hard[3 + k, joint] = (0.0, 0.0, 1e-7)[k]
    goals = [*arm.pose(own), *arm.pose(hard), *_no_poses(arm, arm.pose(own[:1])[0])]
    nowhere = len(goals) - len(own) - len(hard)
    seeds = np.concatenate([own, hard, np.repeat(own[:1], nowhere, axis=0)])
    expected = []
    for goal, seed in zip(goals, seeds, strict=True):
        q, free = arm.python.ik_free(goal, seed=seed, **arm.values)
        expected.append(Answers(q, tuple(int(row @ (1 << np.arange(len(row)))) for row in free)))
    return Case(table, arm, own, np.array(goals), seeds, expected, nowhere)


def _no_poses(arm: Loaded, pose: np.ndarray) -> Iterator[np.ndarray]:
    """Poses out of reach, and what is none: NaN, infinite, huge, a mirror image."""
    read = [(axis, 3) for axis in arm.axes] or [(0, 0)]
    for bad in (math.nan, math.inf, -math.inf, 1e300):
        spoilt = pose.copy()
        spoilt[read[0]] = bad
        yield spoilt
    if arm.axes and all(arm.turns):
        far = pose.copy()
        far[arm.axes, 3] = 10.0 * arm.reach
        yield far
    if arm.with_orientation:
        for bad in (math.nan, 1e300):
            spoilt = pose.copy()
            spoilt[1, 1] = bad
            yield spoilt
        yield pose @ np.diag([1.0, 1.0, -1.0, 1.0])


def assert_right(given: Case, found: Sequence[Answers]) -> None:
    """Judge answers in double precision."""
    assert len(found) == len(given.goals)
    for k, (answers, expected) in enumerate(zip(found, given.expected, strict=True)):
        name = f"{given.table.stem}, pose {k}"
        assert given.arm.missed_by(answers.q, given.goals[k]) <= 1e-9, name
        assert len(answers.q) == len(answers.masks)
        if k >= len(found) - given.nowhere:
            assert len(answers.q) == 0, name
        elif k < len(given.own):
            assert len(answers.q) == len(expected.q), name
            assert given.arm.apart(answers.q[0], given.own[k]) < 1e-6, name
            assert answers.masks == expected.masks, name
            for answer in answers.q:
                assert given.arm.apart(expected.q, answer).min() < 1e-6, name
        else:
            # At a singular pose there may be a line of answers, of which each takes its own.
            assert len(answers.q) > 0 or len(expected.q) == 0, name


def assert_right_in_single(given: Case, found: Sequence[Answers]) -> None:
    """Judge answers in single precision.

    One random pose in fifty is excused: where two answers nearly meet, a float takes them for one.
    """
    random = len(given.own)
    assert len(found) == len(given.goals)
    for k, (answers, goal) in enumerate(zip(found, given.goals, strict=True)):
        assert given.arm.missed_by(answers.q, goal) <= 2e-5, (given.table.stem, k)
    assert all(len(answers.q) == 0 for answers in found[-given.nowhere :])
    assert all(len(answers.q) > 0 for answers in found[: -given.nowhere])
    pairs = list(zip(found[:random], given.expected[:random], strict=True))
    agreed = sum(len(answers.q) == len(expected.q) for answers, expected in pairs)
    excused = max(1.0, 0.02 * random)
    assert agreed >= random - excused, given.table.stem
    found_and_own = zip(found[:random], given.own, strict=True)
    near = [given.arm.apart(answers.q, own).min() for answers, own in found_and_own]
    assert np.sum(np.array(near) < 2e-2) >= random - excused, given.table.stem


# ---------------------------------------------------------------------------------- C with floats


def compiled(given: Case, folder: Path, **options: object) -> CInverse:
    robot = symdh.load(given.table)
    header, source = generate(robot, "c", **given.options, **options)
    open_ones = [given.values[s.name] for s in robot.parameters if s not in robot.values]
    return compile_inverse(header, source, folder, given.n, open_ones)


def asked(function: CInverse, given: Case) -> list[Answers]:
    calls = (function(T, seed) for T, seed in zip(given.goals, given.seeds, strict=True))
    return [Answers(q, tuple(masks)) for q, masks in calls]


@each_table
def test_c_in_double_agrees_with_python(table: Path) -> None:
    given = case(table)
    assert_right(given, asked(given.arm.c, given))


@each_table
@pytest.mark.filterwarnings("ignore:overflow encountered in cast")
def test_c_in_single_finds_the_joint_values_again(table: Path, tmp_path: Path) -> None:
    given = case(table)
    function = compiled(given, tmp_path, precision="float")
    assert function.is_single
    assert_right_in_single(given, asked(function, given))


def test_bounds_of_float_are_told_in_its_header() -> None:
    header, source = generate(symdh.load(_named("puma560")), "c", precision="float")
    assert "less than 1e-5 of the arm's" in header.text
    assert "int puma560_float_ik(" in header.text
    code = re.sub(r"/\*.*?\*/|#error.*", "", source.text, flags=re.DOTALL)
    assert not re.search(r"\bdouble\b|\b\d+\.\d+(e-?\d+)?\b(?!f)|\b\d+e-?\d+\b", code)


def _named(name: str) -> Path:
    return next(table for table in CLOSED if table.stem == name)


# --------------------------------------------------------------------------- names of the table

#: What the code calls things itself: arguments, helpers, types, members.
HOSTILE = ("found", "blank", "seed", "Scalar", "std", "detail", "x1", "k2", "free1", "answers")


def hostile_arm() -> Robot:
    """Ten links in a plane, eight of them fixed, of lengths with such names."""
    first, second, *fixed = HOSTILE
    rows = [f"{{theta: ik, d: 0, a: {first}, alpha: 0}}"]
    rows += [f"{{theta: 0, d: 0, a: {name}, alpha: 0}}" for name in fixed]
    rows += [f"{{theta: T, d: 0, a: {second}, alpha: 0}}"]
    joints = "".join(f"  - {row}\n" for row in rows)
    return symdh.loads(f"name: hostile\nconvention: standard\njoints:\n{joints}")


def test_names_of_the_table_stand_against_nothing_in_cpp(tmp_path: Path) -> None:
    require_eigen()
    (header,) = generate(hostile_arm(), "cpp")
    (tmp_path / header.name).write_text(header.text)
    fields = cpp_parameters(header.text)
    assert len(fields) == len(HOSTILE)
    lengths = "".join(f"    p.{name} = 0.1 * {k + 1};\n" for k, name in enumerate(fields))
    main = f"""\
#include "hostile.hpp"
int main() {{
    hostile::Params<double> p;
{lengths}
    const Eigen::Vector2d q(0.3, 0.9);
    const auto answers = hostile::ik(hostile::fk(q, p), p, q);
    return answers.size() == 2 && (answers[0] - q).norm() < 1e-9 ? 0 : 1;
}}
"""
    (tmp_path / "main.cpp").write_text(main)
    run([require_tool("g++"), *CPP, "main.cpp", "-o", "main"], tmp_path)
    run([tmp_path / "main"], tmp_path)


def test_names_of_the_table_stand_against_nothing_in_rust(tmp_path: Path) -> None:
    (file,) = generate(hostile_arm(), "rust")
    (tmp_path / file.name).write_text(file.text)
    lengths = ", ".join(repr(0.1 * (k + 1)) for k in range(len(HOSTILE)))
    main = f"""\
mod hostile;
fn main() {{
    let p = hostile::Params::new({lengths});
    let q = [0.3, 0.9];
    let pose = hostile::fk(&q, &p, f64::sin_cos);
    let mut answers = [[0.0; 2]; hostile::IK_MAX];
    let count = hostile::ik(
        &pose, &p, Some(&q), &mut answers, None, {rust_call(file.text)});
    assert!(count == 2 && (answers[0][0] - 0.3).abs() + (answers[0][1] - 0.9).abs() < 1e-9);
}}
"""
    (tmp_path / "main.rs").write_text(main)
    run([find_tool("rustc"), "--edition=2021", "-D", "warnings", "main.rs"], tmp_path)
    run([tmp_path / "main"], tmp_path)


def test_names_of_the_table_stand_against_nothing_in_c_and_the_extension(tmp_path: Path) -> None:
    robot = hostile_arm()
    header, source = generate(robot, "c", precision="float")
    lengths = [0.1 * (k + 1) for k in range(len(HOSTILE))]
    function = compile_inverse(header, source, tmp_path, 2, lengths)
    module = build(robot, tmp_path)
    named = dict(zip(_keywords(module), lengths, strict=True))
    pose = module.fk([0.3, 0.9], **named)
    assert np.allclose(module.ik(pose, seed=[0.3, 0.9], **named)[0], [0.3, 0.9])
    assert np.allclose(function(pose, [0.3, 0.9])[0][0], [0.3, 0.9], atol=1e-4)


def _keywords(module: ModuleType) -> list[str]:
    return re.findall(r"\w+", str(module.fk.__text_signature__).partition("*")[2])


# ------------------------------------------------------------------------------- running a language


def lines_of(given: Case) -> str:
    """Goal and seed of each call, a line each; what is huge in double is infinite in float."""
    rows = np.concatenate([given.goals.reshape(-1, 16), given.seeds], axis=1)
    return "".join(" ".join(map(repr, map(float, row))) + "\n" for row in rows)


def read_answers(output: str, cases: Sequence[Case]) -> list[list[Answers]]:
    """Read a line for each call: joint values and mask of each answer."""
    lines = iter(output.splitlines())
    result = []
    for given in cases:
        found = []
        for _ in given.goals:
            numbers = np.array([float(word) for word in next(lines).split()])
            rows = numbers.reshape(-1, given.n + 1)
            found.append(Answers(rows[:, :-1], tuple(int(mask) for mask in rows[:, -1])))
        result.append(found)
    assert next(lines, None) is None
    return result


# ---------------------------------------------------------------------------------------------- C++

CPP_READ = """\
#include <cstdio>
#include <cstdlib>
template <class Scalar> Scalar read()
{
    char word[40] = "";
    if (std::scanf("%39s", word) != 1) std::abort();
    return static_cast<Scalar>(std::strtod(word, nullptr));
}
"""
CPP_BLOCK = """\
template <class Scalar> void block{place}()
{{
    {parameters}
    for (int pose = 0; pose < {poses}; ++pose) {{
        Eigen::Matrix<Scalar, 4, 4> T;
        Eigen::Matrix<Scalar, {n}, 1> seed;
        for (int k = 0; k < 16; ++k) T(k / 4, k % 4) = read<Scalar>();
        for (int k = 0; k < {n}; ++k) seed[k] = read<Scalar>();
        const auto answers = {name}::ik(T, {given}seed);
        static_assert({name}::n_joints == {n} && {name}::ik_max >= 1);
        std::size_t i = 0;
        for (const auto& q : answers) {{
            for (int k = 0; k < {n}; ++k) std::printf("%.17g ", static_cast<double>(q[k]));
            std::printf("%u ", answers.free_joints[i++]);
        }}
        std::puts("");
        if (i != answers.size() || answers.empty() != (i == 0)) std::abort();
    }}
}}
"""


@pytest.fixture(scope="module")
def in_cpp(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[list[Answers]]]:
    """What C++ answers, by scalar."""
    compiler = require_tool("g++")
    require_eigen()
    folder = tmp_path_factory.mktemp("cpp")
    cases, includes, blocks = [case(table) for table in TABLES], [], []
    for place, given in enumerate(cases):
        (header,) = generate(symdh.load(given.table), "cpp", **given.options)
        (folder / header.name).write_text(header.text)
        includes.append(f'#include "{header.name}"\n')
        (name,) = re.findall(r"^namespace (\w+) \{", header.text, re.MULTILINE)[:1]
        taken = "struct Params" in header.text
        fields = re.findall(r"^    Scalar (\w+) = Scalar\(std::numeric", header.text, re.MULTILINE)
        numbers = zip(fields, _open_values(given), strict=True)
        parameters = f"{name}::Params<Scalar> p;" if taken else ""
        parameters += "".join(f" p.{field} = static_cast<Scalar>({x!r});" for field, x in numbers)
        blocks.append(
            CPP_BLOCK.format(
                place=place,
                parameters=parameters,
                poses=len(given.goals),
                n=given.n,
                name=name,
                given="p, " if taken else "",
            )
        )
    calls = "".join(f"    block{place}<SCALAR>();\n" for place in range(len(cases)))
    main = "".join([*includes, CPP_READ, *blocks, f"int main()\n{{\n{calls}}}\n"])
    (folder / "main.cpp").write_text(main)
    result = {}
    for scalar in ("double", "float"):
        run([compiler, *CPP, f"-DSCALAR={scalar}", "-O1", "main.cpp", "-o", scalar], folder)
        output = _fed(folder / scalar, "".join(map(lines_of, cases)))
        result[scalar] = read_answers(output, cases)
    return result


def _open_values(given: Case) -> list[float]:
    robot = symdh.load(given.table)
    return [given.values[s.name] for s in robot.parameters if s not in robot.values]


def _fed(program: Path, text: str) -> str:
    ran = subprocess.run([program], input=text, capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (0, "")
    return ran.stdout


@each_table
def test_cpp_agrees_with_python(table: Path, in_cpp: dict[str, list[list[Answers]]]) -> None:
    assert_right(case(table), in_cpp["double"][TABLES.index(table)])


@each_table
def test_cpp_takes_floats(table: Path, in_cpp: dict[str, list[list[Answers]]]) -> None:
    assert_right_in_single(case(table), in_cpp["float"][TABLES.index(table)])


CPP_USES = """\
#include "puma560.hpp"
#include "limited.hpp"
#include <cmath>
int main()
{
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    const Vector6 q = Vector6::LinSpaced(0.1, 1.1);
    const Eigen::Matrix4d T = puma560::fk(q);
    // Without a seed, with one, with parameters of one's own, from expressions of every kind.
    const auto plain = puma560::ik(T);
    if (plain.size() != 8 || plain.begin() + 8 != plain.end()) return 1;
    const auto nearest = puma560::ik(T, {}, q);
    if ((nearest[0] - q).norm() > 1e-9) return 2;
    Eigen::VectorXd state(8);
    state << q, 0.0, 0.0;
    Eigen::MatrixXd large = Eigen::MatrixXd::Zero(6, 6);
    large.topLeftCorner<4, 4>() = T;
    if ((puma560::ik(large.topLeftCorner<4, 4>(), {}, state.head<6>())[0] - q).norm() > 1e-9) {
        return 3;
    }
    puma560::Params<double> longer;
    longer.a2 = 0.5;
    for (const auto& answer : puma560::ik(puma560::fk(q, longer), longer)) {
        if ((puma560::fk(answer, longer) - puma560::fk(q, longer)).norm() > 1e-9) return 4;
    }
    // A free joint keeps the value of the seed and is reported: theta5 = 0.
    Vector6 straight = q;
    straight[4] = 0.0;
    Vector6 wanted = straight;
    wanted[3] = 1.25;
    const auto free_ones = puma560::ik(puma560::fk(straight), {}, wanted);
    if (free_ones.free_joints[0] != 1U << 3 || std::abs(free_ones[0][3] - 1.25) > 1e-12) return 5;
    // Limits: 200 degrees of joint 1 are outside of them, and a full turn less is inside.
    const Eigen::Vector2d bent(-1.4, 0.7);
    const auto all = limited::ik(limited::fk(bent));
    const auto within = limited::ik(limited::fk(bent), std::nullopt, true);
    if (all.size() != 2 || within.size() != 1) return 6;
    if (std::abs(within[0][0] - (bent[0] + 2.0 * std::acos(-1.0))) > 1e-9) return 7;
    if (!limited::within_limits(within[0]) || limited::within_limits(bent)) return 8;
    if (!limited::ik(Eigen::Matrix4d::Constant(std::nan("")).eval()).empty()) return 9;
    return 0;
}
"""

LIMITED = """
name: limited
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0.5, alpha: 0}
  - {theta: theta2, d: 0, a: 0.3, alpha: 0}
limits: {theta1: [90 deg, 400 deg], theta2: [0, 180 deg]}
"""


@pytest.mark.parametrize("compiler", ["g++", "clang++"])
def test_cpp_is_called_in_many_ways(compiler: str, tmp_path: Path) -> None:
    program = require_tool(compiler)
    require_eigen()
    for robot in (symdh.load(_named("puma560")), symdh.loads(LIMITED)):
        (header,) = generate(robot, "cpp")
        (tmp_path / header.name).write_text(header.text)
    (tmp_path / "main.cpp").write_text(CPP_USES)
    run([program, *CPP, "-Wold-style-cast", "-O1", "main.cpp", "-o", "main"], tmp_path)
    run([tmp_path / "main"], tmp_path)


# --------------------------------------------------------------------------------------------- Rust

RUST_READ = """\
use std::io::Read;
type Words<'a> = std::str::SplitWhitespace<'a>;
fn row<const N: usize>(words: &mut Words) -> [f64; N] {
    std::array::from_fn(|_| words.next().unwrap().parse().unwrap())
}
fn show<const N: usize>(answers: &[[f64; N]], masks: &[u32]) {
    for (q, mask) in answers.iter().zip(masks) {
        for x in q { print!("{x:e} "); }
        print!("{mask} ");
    }
    println!();
}
"""
RUST_BLOCK = """\
fn block{place}(words: &mut Words) {{
    {parameters}
    for _ in 0..{poses} {{
        let flat: [f64; 16] = row(words);
        let T = std::array::from_fn(|r| std::array::from_fn(|c| flat[4 * r + c]));
        let seed = row(words);
        let mut answers = [[0.0; {n}]; {module}::IK_MAX];
        let mut masks = [0; {module}::IK_MAX];
        let count = {module}::ik(
            &T, {given}Some(&seed), &mut answers, Some(&mut masks), {passed});
        show(&answers[..count], &masks[..count]);
    }}
}}
"""


def rust_call(text: str) -> str:
    """The functions that `ik` of a module wants, those of `std`."""
    signature = re.search(r"pub fn ik\(\n(.*?)^\)", text, re.DOTALL | re.MULTILINE)
    assert signature is not None
    return ", ".join(f"f64::{name}" for name in re.findall(r"(\w+): impl Fn", signature[1]))


@pytest.fixture(scope="module")
def in_rust(tmp_path_factory: pytest.TempPathFactory) -> list[list[Answers]]:
    rustc = find_tool("rustc")
    folder = tmp_path_factory.mktemp("rust")
    cases, modules, blocks = [case(table) for table in TABLES], [], []
    for place, given in enumerate(cases):
        (file,) = rust.generate(symdh.load(given.table), **given.options)
        (folder / file.name).write_text(file.text)
        module = file.name.removesuffix(".rs")
        modules.append(f"mod {module};\n")
        taken = "pub struct Params" in file.text
        numbers = ", ".join(map(repr, _open_values(given)))
        made = f"new({numbers})" if numbers else "default()"
        blocks.append(
            RUST_BLOCK.format(
                place=place,
                parameters=f"let p = {module}::Params::{made};" if taken else "",
                poses=len(given.goals),
                n=given.n,
                module=module,
                given="&p, " if taken else "",
                passed=rust_call(file.text),
            )
        )
    main = [
        *("#![allow(non_snake_case)]\n", *modules, RUST_READ, *blocks),
        "fn main() {\n    let mut text = String::new();\n",
        "    std::io::stdin().read_to_string(&mut text).unwrap();\n",
        "    let words = &mut text.split_whitespace();\n",
        *(f"    block{place}(words);\n" for place in range(len(cases))),
        "}\n",
    ]
    (folder / "main.rs").write_text("".join(main))
    run([rustc, "--edition=2021", "-O", "-D", "warnings", "main.rs"], folder)
    return read_answers(_fed(folder / "main", "".join(map(lines_of, cases))), cases)


@each_table
def test_rust_agrees_with_python(table: Path, in_rust: list[list[Answers]]) -> None:
    assert_right(case(table), in_rust[TABLES.index(table)])


RUST_USES = """\
mod limited;
mod puma560;
fn main() {
    let q = [-1.4, 0.7];
    let pose = limited::fk(&q, f64::sin_cos);
    let mut answers = [[0.0; 2]; limited::IK_MAX];
    let found = |pose, seed, answers: &mut _| {
        limited::ik(pose, seed, answers, None, f64::sin_cos, f64::atan2, f64::sqrt)
    };
    assert_eq!(found(&pose, None, &mut answers), 2);
    let within: Vec<_> = answers.iter().filter(|q| limited::within_limits(q)).collect();
    assert_eq!(within.len(), 1);
    assert!((within[0][0] - q[0] - std::f64::consts::TAU).abs() < 1e-9);
    assert_eq!(found(&[[f64::NAN; 4]; 4], Some(&q), &mut answers), 0);
    // A free joint keeps the value of the seed and is reported.
    let p = puma560::Params::default();
    let straight = puma560::fk(&[0.3, -0.5, 0.7, 0.2, 0.0, 0.4], &p, f64::sin_cos);
    let mut answers = [[0.0; 6]; puma560::IK_MAX];
    let mut masks = [0; puma560::IK_MAX];
    let seed = [0.3, -0.5, 0.7, 1.25, 0.0, 0.0];
    let count = puma560::ik(
        &straight, &p, Some(&seed), &mut answers, Some(&mut masks),
        f64::sin_cos, f64::atan2, f64::sqrt);
    assert!(count > 0 && masks[0] == 1 << 3 && (answers[0][3] - 1.25).abs() < 1e-12);
}
"""


def test_rust_fills_what_is_the_callers(tmp_path: Path) -> None:
    rustc = find_tool("rustc")
    for robot in (symdh.load(_named("puma560")), symdh.loads(LIMITED)):
        (file,) = rust.generate(robot)
        (tmp_path / file.name).write_text(file.text)
    (tmp_path / "main.rs").write_text(RUST_USES)
    run([rustc, "--edition=2021", "-D", "warnings", "main.rs"], tmp_path)
    run([tmp_path / "main"], tmp_path)


def test_rust_needs_core_alone_and_clippy_is_content(tmp_path: Path) -> None:
    """Every kind of equation and of joint, in a crate without std."""
    names = ("pieper_generic", "stanford_textbook", "cartesian_ppp", "planar_2r", "zyz_wrist")
    modules = []
    (tmp_path / "src").mkdir()
    for name in names:
        (file,) = rust.generate(symdh.load(_named(name)))
        (tmp_path / "src" / file.name).write_text(file.text)
        modules.append(f"pub mod {file.name.removesuffix('.rs')};\n")
    lib = "#![no_std]\n#![forbid(unsafe_code)]\n" + "".join(modules)
    (tmp_path / "src" / "lib.rs").write_text(lib)
    rustc = find_tool("rustc")
    run([rustc, "--edition=2021", "--crate-type=lib", "-D", "warnings", "src/lib.rs"], tmp_path)
    (tmp_path / "Cargo.toml").write_text(
        '[package]\nname = "arms"\nversion = "0.1.0"\nedition = "2021"\n'
    )
    done = subprocess.run(
        [find_tool("cargo"), "clippy", "--quiet", "--offline", "--", "-D", "warnings"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    if "no such command" in done.stderr or "is not installed" in done.stderr:
        pytest.skip("clippy is not installed")
    assert (done.returncode, done.stderr) == (0, "")


# ------------------------------------------------------------------------------ Python extension

EXTENDED = [table for table in TABLES if EVERY or table in OWN or table.stem == "puma560"]


@pytest.mark.parametrize("table", EXTENDED, ids=lambda table: table.stem)
def test_extension_answers_as_the_module_does(table: Path, tmp_path: Path) -> None:
    given = case(table)
    module = build(symdh.load(table), tmp_path, **given.options)
    open_names = [s.name for s in symdh.load(table).parameters if s not in symdh.load(table).values]
    named = {name: given.values[name] for name in open_names}
    found = []
    for goal, seed in zip(given.goals, given.seeds, strict=True):
        q, free = module.ik_free(goal, seed=seed, **named)
        assert (q.dtype, free.dtype, free.shape) == (np.float64, np.bool_, q.shape)
        assert (module.ik(goal, seed=seed, **named) == q).all()
        found.append(Answers(q, tuple(int(row @ (1 << np.arange(given.n))) for row in free)))
    assert_right(given, found)


def test_extension_has_limits_seeds_and_messages(tmp_path: Path) -> None:
    module = build(symdh.loads(LIMITED), tmp_path)
    pose = module.fk([-1.4, 0.7])
    answers = module.ik(pose)
    assert answers.shape == (2, 2)
    assert module.ik(pose.tolist(), seed=None, limits=False).tolist() == answers.tolist()
    within = module.ik(pose, limits=True)
    assert np.allclose(within, [[2 * math.pi - 1.4, 0.7]])
    nearest = module.ik(T=pose, seed=(answers[1] + 0.01).tolist())
    assert np.allclose(nearest[0], answers[1])
    assert module.ik(np.full((4, 4), np.nan)).shape == (0, 2)
    assert module.ik_free(np.full((4, 4), np.nan))[1].shape == (0, 2)
    for arguments, named, message in (
        ((), {}, r"ik\(\) missing the argument 'T'"),
        ((np.eye(3),), {}, r"T must have shape \(4, 4\), not \(3, 3\)"),
        ((np.zeros((2, 4, 4)),), {}, r"T must have shape \(4, 4\), not \(2, 4, 4\)"),
        ((pose,), {"seed": [0.0] * 3}, r"seed must have shape \(2,\), not \(3,\)"),
        ((pose, [0.0] * 2), {}, r"ik\(\) takes T by position, the rest by keyword"),
        ((pose,), {"q": 1}, "unexpected keyword argument 'q'"),
        (([["a"] * 4] * 4,), {}, "could not convert string"),
    ):
        with pytest.raises((TypeError, ValueError), match=message):
            module.ik(*arguments, **named)
    assert "Inverse" in module.__doc__ or "inverse kinematics" in module.__doc__
    assert module.ik.__text_signature__ == "(T, *, seed=None, limits=False)"


def test_extension_without_a_closed_form_says_why(tmp_path: Path) -> None:
    iiwa = symdh.load(_named("kuka_iiwa7"))
    module = build(iiwa, tmp_path)
    assert not hasattr(module, "ik")
    assert "No inverse kinematics: 7 joints move" in str(module.__doc__)


# ------------------------------------------------------------------------------------------- heads


@pytest.mark.parametrize("target", ["cpp", "rust"])
def test_without_a_closed_form_the_head_says_why(target: str) -> None:
    (file,) = generate(symdh.load(_named("kuka_iiwa7")), target)
    assert "No inverse kinematics: 7 joints move" in file.text
    assert re.search(r"\bik\b", file.text) is None


@pytest.mark.parametrize("target", ["cpp", "rust", "python-ext"])
def test_the_text_is_always_the_same(target: str) -> None:
    robot = symdh.load(_named("pieper_generic"))
    assert generate(robot, target) == generate(symdh.load(_named("pieper_generic")), target)
