"""Generated C++, MATLAB, Julia, Rust and JavaScript: run by their own tools on seeded poses.

Every table and every odd robot goes through each language in one program, which prints what the
three functions return; the numbers are compared with the oracles of the Python and C tests.
"""

from __future__ import annotations

import functools
import json
import math
import re
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from julia_subset import Module, julia_parser
from oracle import read_arm_file
from test_codegen import (
    HOSTILE_PARAMETERS,
    HOSTILE_VARIABLES,
    PLANAR,
    PUMA,
    ROBOTS,
    SCARA,
    Oracle,
    open_parameters,
    parameter_numbers,
    write_all,
)
from test_codegen_jacobian import (
    TABLES,
    column_tolerances,
    columns_from_axes,
    exact_results,
    named,
)

import symdh
from symdh.codegen import TARGETS, GeneratedFile, generate
from symdh.codegen.targets import Target, cpp, javascript, julia, matlab, rust
from symdh.codegen.verification import random_poses, verify
from symdh.errors import SymdhError, UnsupportedError
from symdh.robot import Robot
from tools import LANGUAGES, find_tool, require_language, require_tool

Generator = Callable[[Robot], tuple[GeneratedFile, ...]]
#: Parallel axes: what adds the angles up before it takes the cosine is wrong at a million radians.
SUMMED = ("puma560", "ur5", "planar_3r")
ODD = [*ROBOTS, HOSTILE_PARAMETERS, HOSTILE_VARIABLES]


@dataclass(frozen=True)
class Case:
    """A robot, joint values (poses, n), and what an oracle makes of them, with tolerances."""

    robot: Robot
    q: np.ndarray
    T: np.ndarray
    J: np.ndarray
    pose_tolerance: float
    jacobian_tolerance: np.ndarray | float

    @property
    def open(self) -> list[float]:
        """Numbers for the parameters without a value, in their order."""
        return open_parameters(self.robot)


@functools.cache
def cases() -> tuple[Case, ...]:
    large = [_table_case(table, 1e6 / math.pi) for table in TABLES if table.stem in SUMMED]
    return (*map(_table_case, TABLES), *large, *map(_odd_case, ODD))


def _table_case(table: Path, scale: float = 1.0) -> Case:
    arm = read_arm_file(table)
    q = scale * arm.seeded_poses(4, seed=7000 + TABLES.index(table))
    joints = named(arm, q)
    T, J = arm.pose(joints), columns_from_axes(arm, joints)
    return Case(symdh.load(table), q, T, J, arm.tolerance(), arm.tolerance())


def _odd_case(robot: Robot) -> Case:
    generator = np.random.default_rng(11)
    q = generator.uniform(-math.pi, math.pi, (1, len(robot.variables)))
    T, J = exact_results(robot, q[0]) if robot.variables else (_still_pose(robot), np.zeros((6, 0)))
    tolerances = column_tolerances(robot, q)
    lowest = float(tolerances.min()) if robot.variables else 1e-15
    return Case(robot, q, T[None], J[None], lowest, tolerances)


def _still_pose(robot: Robot) -> np.ndarray:
    return Oracle(robot).pose(parameter_numbers(robot))[0]


# ----------------------------------------------------------------------------- running a language


def written(
    generate: Generator, folder: Path, chosen: Sequence[Case] | None = None
) -> list[tuple[Case, tuple[GeneratedFile, ...]]]:
    """Generate cases, by default all, into one folder; each robot gets a name of its own."""
    result = []
    for place, case in enumerate(chosen or cases()):
        robot = replace(case.robot, name=f"arm {place} {case.robot.name}")
        files = generate(robot)
        write_all(files, folder)
        result.append((case, files))
    return result


def run(command: Sequence[str | Path], folder: Path) -> str:
    done = subprocess.run(
        [str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, ""), done.stderr[:4000]
    return done.stdout


def assert_agrees(output: str, chosen: Sequence[Case] | None = None) -> None:
    """Compare lines of numbers, T T J J of each pose of each case, with the oracle."""
    lines = iter(output.splitlines())
    for case in chosen or cases():
        n = case.q.shape[1]
        for T, J in zip(case.T, case.J, strict=True):
            numbers = np.array([float(word) for word in next(lines).split()])
            assert len(numbers) == 32 + 12 * n
            poses, jacobians = numbers[:32].reshape(2, 4, 4), numbers[32:].reshape(2, 6, n)
            name = case.robot.name
            assert (np.abs(poses - T) <= case.pose_tolerance).all(), name
            assert (np.abs(jacobians - J) <= case.jacobian_tolerance).all(), name
            assert (poses[:, 3] == [0.0, 0.0, 0.0, 1.0]).all()
    assert next(lines, None) is None


def numbers(values: Sequence[float] | np.ndarray) -> str:
    return ", ".join(repr(float(value)) for value in values)


# -------------------------------------------------------------------------------------------- C++

CPP = [
    "-std=c++17",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wshadow",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Werror",
    "-isystem",
    "/usr/include/eigen3",
]


def require_eigen() -> None:
    """Skip the test without Eigen, and fail where CI promises it."""
    if not Path("/usr/include/eigen3/Eigen/Core").exists():
        require_tool("eigen3")


def cpp_parameters(header: str) -> list[str]:
    """The fields that have no value, in their order."""
    return re.findall(r"^    Scalar (\w+) = Scalar\(std::numeric_limits", header, re.MULTILINE)


def cpp_namespace(header: str) -> str:
    name, *_ = re.findall(r"^namespace (\w+) \{", header, re.MULTILINE)
    return name


CPP_MAIN = """\
template <class Matrix> void print(const Matrix& m) {
    for (int r = 0; r < m.rows(); ++r)
        for (int c = 0; c < m.cols(); ++c) std::printf("%.17g ", m(r, c));
}
"""


def test_cpp_agrees_with_the_oracles(tmp_path: Path) -> None:
    compiler = require_tool("g++")
    require_eigen()
    includes, blocks = [], []
    chosen = cases()[::3]  # Eigen takes its time to compile
    for case, (header,) in written(cpp.generate, tmp_path, chosen):
        includes.append(f'#include "{header.name}"\n')
        blocks.append(cpp_block(case, header.text))
    source = "".join(includes) + "#include <cstdio>\n" + CPP_MAIN
    source += "".join(f"static void block{k}() {{\n{b}}}\n" for k, b in enumerate(blocks))
    calls = "".join(f"    block{k}();\n" for k in range(len(blocks)))
    (tmp_path / "main.cpp").write_text(f"{source}int main() {{\n{calls}}}\n")
    run([compiler, *CPP, "-O0", "main.cpp", "-o", "main"], tmp_path)
    assert_agrees(run([tmp_path / "main"], tmp_path), chosen)


def cpp_block(case: Case, header: str) -> str:
    name, n = cpp_namespace(header), case.q.shape[1]
    fields = cpp_parameters(header)
    lines = [f"Eigen::Matrix<double, {n}, 1> q;"]
    if fields:
        lines.append(f"{name}::Params<double> p;")
        lines += [f"p.{f} = {x!r};" for f, x in zip(fields, case.open, strict=True)]
    arguments = "q, p" if fields else "q"
    for q in case.q:
        lines += [f"q[{k}] = {float(x)!r};" for k, x in enumerate(q)]
        lines += [
            f"{{ const auto [T, J] = {name}::fk_jacobian({arguments});",
            f"print({name}::fk({arguments})); print(T);",
            f'print({name}::jacobian({arguments})); print(J); std::puts(""); }}',
        ]
    return "".join(f"    {line}\n" for line in lines)


CPP_USES = """\
#include "puma560.hpp"
#include <unsupported/Eigen/AutoDiff>
#include <cstdio>
int main() {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Dual = Eigen::AutoDiffScalar<Vector6>;
    const Vector6 q = Vector6::LinSpaced(0.1, 1.1);
    puma560::Params<double> p;
    p.d4 = 0.4318;
    // What stands in a larger vector, on the heap, in a sum or in a plain array is taken too.
    Eigen::VectorXd state(9);
    state << q, 1.0, 2.0, 3.0;
    const Eigen::Matrix4d T = puma560::fk(q, p);
    if (puma560::fk(state.head<6>(), p) != T || puma560::fk(state.head(6), p) != T) return 1;
    if (puma560::fk(Eigen::Map<const Vector6>(q.data()), p) != T) return 2;
    if (puma560::fk(q + Vector6::Zero(), p) != T || puma560::fk<double>(q, p) != T) return 3;
    // The derivative of the position is the upper half of the Jacobian.
    Eigen::Matrix<Dual, 6, 1> dual;
    for (int k = 0; k < 6; ++k) dual[k] = Dual(q[k], 6, k);
    puma560::Params<Dual> dual_p;
    dual_p.d4 = Dual(0.4318, Vector6::Zero());
    const Eigen::Matrix<Dual, 4, 4> D = puma560::fk(dual, dual_p);
    const Eigen::Matrix<double, 6, 6> J = puma560::jacobian(q, p);
    for (int r = 0; r < 3; ++r)
        if ((D(r, 3).derivatives().transpose() - J.row(r)).cwiseAbs().maxCoeff() > 1e-15) return 4;
    // Single precision stays single.
    puma560::Params<float> single;
    single.d4 = 0.4318f;
    const Eigen::Matrix4f F = puma560::fk(Eigen::Matrix<float, 6, 1>(q.cast<float>()), single);
    if ((F.cast<double>() - T).cwiseAbs().maxCoeff() > 2e-6) return 5;
    // A parameter that nobody set shows.
    if (puma560::fk(q, puma560::Params<double>()).allFinite()) return 6;
    return 0;
}
"""


def test_cpp_takes_every_scalar_and_expression(tmp_path: Path) -> None:
    compiler = require_tool("g++")
    require_eigen()
    write_all(cpp.generate(PUMA), tmp_path)
    (tmp_path / "main.cpp").write_text(CPP_USES)
    run([compiler, *CPP, "-O1", "main.cpp", "-o", "main"], tmp_path)
    run([tmp_path / "main"], tmp_path)


@pytest.mark.parametrize("compiler", ["g++", "clang++"])
def test_cpp_example_compiles_with_all_warnings(compiler: str, tmp_path: Path) -> None:
    program = require_tool(compiler)
    require_eigen()
    source = []
    for robot in (PUMA, SCARA, HOSTILE_PARAMETERS):
        (header,) = cpp.generate(robot)
        write_all([header], tmp_path)
        example = re.search(r"Example:\n \*\n((?: \*     .*\n)+)", header.text)
        assert example is not None
        body = example[1].replace(" *    ", "")
        use = "    return pose.rows() + J.rows() + T.rows() == 14 ? 0 : 1;\n"
        source.append(f'#include "{header.name}"\nint use_{robot.name}() {{\n{body}{use}}}\n')
    (tmp_path / "main.cpp").write_text("".join(source) + "int main() { return use_puma560(); }\n")
    run([program, *CPP, "main.cpp", "-o", "main"], tmp_path)
    run([tmp_path / "main"], tmp_path)


@pytest.mark.parametrize(
    ("name", "namespace"),
    [("double", "double_arm"), ("index", "index_arm"), ("std", "std_arm"), ("arm", "arm")],
)
def test_cpp_namespace_stands_against_nothing(name: str, namespace: str) -> None:
    (header,) = cpp.generate(replace(PLANAR, name=name))
    assert cpp_namespace(header.text) == namespace
    assert header.name == f"{name}.hpp"


# ----------------------------------------------------------------------------------- MATLAB, Octave


def matlab_parameters(function: str) -> list[str]:
    """The fields that have no value, in their order."""
    return re.findall(r"^\w+ = given\(p, '(\w+)'\);", function, re.MULTILINE)


def octave(script: str, folder: Path) -> str:
    (folder / "main.m").write_text(f"1;\n{script}")
    return run([require_tool("octave-cli"), "--norc", "--no-history", "--quiet", "main.m"], folder)


def test_matlab_agrees_with_the_oracles(tmp_path: Path) -> None:
    lines = ["function show(m)\n  printf('%.17g ', m');\nend\n"]
    for case, files in written(matlab.generate, tmp_path):
        fk, jacobian, both = (file.name.removesuffix(".m") for file in files[:3])
        fields = matlab_parameters(files[0].text)
        values = (f"'{f}', {x!r}" for f, x in zip(fields, case.open, strict=True))
        lines.append(f"p = struct({', '.join(values)});\n")
        arguments = "q, p" if fields else "q"
        for q in case.q:
            lines.append(f"q = [{numbers(q)}];\n[T, J] = {both}({arguments});\n")
            lines.append(f"show({fk}({arguments})); show(T);\n")
            lines.append(f"show({jacobian}({arguments})); show(J); printf('\\n');\n")
    assert_agrees(octave("".join(lines), tmp_path))


def test_matlab_takes_rows_and_columns_and_says_what_is_wrong(tmp_path: Path) -> None:
    write_all(matlab.generate(PUMA), tmp_path)
    output = octave(
        """\
q = 0.1:0.1:0.6;
p.d4 = 0.4318;
assert(isequal(puma560_fk(q, p), puma560_fk(q', p)));
p.a2 = 1;
assert(abs(puma560_fk(zeros(1, 6), p)(1, 4) - 1.0203) < 1e-15);
function tell(call)
  try
    call();
  catch problem
    printf('%s | %s\\n', problem.identifier, problem.message);
  end
end
tell(@() puma560_fk(1:5, p));
tell(@() puma560_fk(q));
tell(@() puma560_jacobian(q, struct('d4', 1, 'd7', 1)));
""",
        tmp_path,
    )
    assert output.splitlines() == [
        "puma560_fk:size | q must hold 6 numbers, not 5",
        "puma560_fk:parameter | the table has no value for p.d4: set it",
        "puma560_jacobian:parameter | there is no parameter p.d7",
    ]


def test_matlab_has_help(tmp_path: Path) -> None:
    files = matlab.generate(PUMA)
    write_all(files, tmp_path)
    output = octave("printf('%s', get_help_text('puma560_jacobian'));\n", tmp_path)
    assert output.startswith("PUMA560_JACOBIAN  Geometric Jacobian of puma560.\n")
    assert "q(1)  q1  revolute  rad" in output
    assert "p.d4  must be set" in output
    example = re.search(r"Example:\n\n((?:       .*\n)+)", output)
    assert example is not None
    assert "J =" in octave(example[1], tmp_path)


def test_matlab_refuses_a_name_that_it_would_cut() -> None:
    with pytest.raises(UnsupportedError, match="63 letters"):
        matlab.generate(replace(PLANAR, name="a" * 60))


# ------------------------------------------------------------------------------------------- Rust


def test_rust_agrees_with_the_oracles(tmp_path: Path) -> None:
    rustc = find_tool("rustc")
    lines = ["fn show<const R: usize, const C: usize>(m: [[f64; C]; R]) {\n"]
    lines.append('    for row in m { for x in row { print!("{x:e} "); } }\n}\n')
    modules = []
    for place, (case, (file,)) in enumerate(written(rust.generate, tmp_path)):
        module = file.name.removesuffix(".rs")
        modules.append(f"mod {module};\n")
        lines.append(f"fn block{place}() {{\n{rust_block(case, module, file.text)}}}\n")
    calls = "".join(f"    block{k}();\n" for k in range(len(modules)))
    main = f"{''.join(modules)}{''.join(lines)}fn main() {{\n{calls}}}\n"
    (tmp_path / "main.rs").write_text(main)
    run([rustc, "--edition=2021", "-D", "warnings", "main.rs"], tmp_path)
    assert_agrees(run([tmp_path / "main"], tmp_path))


def rust_block(case: Case, module: str, text: str) -> str:
    lines = []
    if "pub struct Params" in text:
        made = f"new({numbers(case.open)})" if case.open else "default()"
        lines.append(f"let p = {module}::Params::{made};")
    for q in case.q:
        lines.append(f"let q = [{numbers(q)}];".replace("[]", "[0.0_f64; 0]"))
        called = []
        for name in ("fk", "jacobian", "fk_jacobian"):
            signature = re.search(rf"pub fn {name}\(\n(.*?)^\)", text, re.DOTALL | re.MULTILINE)
            assert signature is not None
            passed = re.findall(r"(\w+): impl Fn", signature[1])
            given = ["&q", *(["&p"] if "p: &Params" in signature[1] else [])]
            given += [f"f64::{function}" for function in passed]
            called.append(f"{module}::{name}({', '.join(given)})")
        fk, jacobian, both = called
        lines.append(f"let (T, J) = {both}; show({fk}); show(T);")
        lines.append(f"show({jacobian}); show(J); println!();")
    return "    #![allow(non_snake_case)]\n" + "".join(f"    {line}\n" for line in lines)


def test_rust_needs_core_alone(tmp_path: Path) -> None:
    rustc = find_tool("rustc")
    robots = [PUMA, SCARA, *ODD[-2:], next(r for r in ODD if r.name == "formulas")]
    modules = []
    for place, robot in enumerate(robots):
        (file,) = rust.generate(replace(robot, name=f"{robot.name} {place}"))
        write_all([file], tmp_path)
        modules.append(f"pub mod {file.name.removesuffix('.rs')};\n")
    (tmp_path / "lib.rs").write_text("#![no_std]\n#![forbid(unsafe_code)]\n" + "".join(modules))
    run([rustc, "--edition=2021", "--crate-type=lib", "-D", "warnings", "lib.rs"], tmp_path)


def test_rust_example_runs_and_clippy_is_content(tmp_path: Path) -> None:
    cargo = find_tool("cargo")
    modules, examples = [], []
    for robot in (PUMA, SCARA, HOSTILE_PARAMETERS):
        (file,) = rust.generate(robot)
        (tmp_path / "src").mkdir(exist_ok=True)
        write_all([file], tmp_path / "src")
        example = re.search(r"```ignore\n(.*?)//! ```", file.text, re.DOTALL)
        assert example is not None
        mod, body = re.sub(r"^//! ?", "", example[1], flags=re.MULTILINE).split("\n", 1)
        modules.append(f"{mod}\n")
        body = body.replace("use ", "use crate::")
        allowed = "#[allow(non_snake_case, unused_variables)]\n"
        examples.append(f"{allowed}fn {file.name[:-3]}_example() {{\n{body}}}\n")
    calls = "".join(f"    {name}();\n" for name in re.findall(r"fn (\w+)\(", "".join(examples)))
    main = "".join([*modules, *examples, f"fn main() {{\n{calls}}}\n"])
    (tmp_path / "src" / "main.rs").write_text(main)
    (tmp_path / "Cargo.toml").write_text(
        '[package]\nname = "uses"\nversion = "0.1.0"\nedition = "2021"\n'
    )
    done = subprocess.run(
        [cargo, "clippy", "--quiet", "--offline", "--", "-D", "warnings"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    if "no such command" in done.stderr or "is not installed" in done.stderr:
        pytest.skip("clippy is not installed")
    assert (done.returncode, done.stderr) == (0, "")
    run([cargo, "run", "--quiet", "--offline"], tmp_path)


@pytest.mark.parametrize(
    ("name", "file"), [("SCARA", "scara.rs"), ("Loop", "loop_arm.rs"), ("core", "core_arm.rs")]
)
def test_rust_modules_are_named_as_rust_has_it(name: str, file: str) -> None:
    assert rust.generate(replace(PLANAR, name=name))[0].name == file


# ------------------------------------------------------------------------------------- JavaScript


def javascript_parameters(types: str) -> list[str]:
    """The properties that have no value, in their order."""
    return re.findall(r"^  (\w+): number;", types, re.MULTILINE)


def node(script: str, folder: Path) -> str:
    (folder / "main.mjs").write_text(script)
    return run([require_tool("node"), "main.mjs"], folder)


def test_javascript_agrees_with_the_oracles(tmp_path: Path) -> None:
    lines = ["const show = (m) => m.flat().join(' ');\n"]
    for place, (case, (module, types)) in enumerate(written(javascript.generate, tmp_path)):
        lines.append(f'import * as m{place} from "./{module.name}";\n')
        fields = javascript_parameters(types.text)
        given = json.dumps(dict(zip(fields, case.open, strict=True)))
        for q in case.q:
            arguments = f"[{numbers(q)}]" + (f", {given}" if fields else "")
            lines.append(
                f"{{ const {{ T, J }} = m{place}.fk_jacobian({arguments});\n"
                f"console.log(show(m{place}.fk({arguments})), show(T),"
                f" show(m{place}.jacobian({arguments})), show(J)); }}\n"
            )
    assert_agrees(node("".join(lines), tmp_path))


def test_javascript_takes_typed_arrays_and_says_what_is_wrong(tmp_path: Path) -> None:
    write_all(javascript.generate(PUMA), tmp_path)
    output = node(
        """\
import { fk, N_JOINTS } from "./puma560.mjs";
const at = (...given) => { try { return fk(...given)[0][3]; } catch (e) { return `${e}`; } };
console.log(N_JOINTS, at(new Float64Array(6), { d4: 0.5, a2: 1 }));
console.log(at([0, 0, 0], { d4: 0.5 }));
console.log(at([0, 0, 0, 0, 0, 0]));
console.log(at([NaN, 0, 0, 0, 0, 0], { d4: 0.5 }), at([0, Infinity, 0, 0, 0, 0], { d4: 0.5 }));
""",
        tmp_path,
    )
    assert output.splitlines() == [
        "6 1.0203",
        "RangeError: q must hold 6 numbers, not 3",
        "TypeError: the table has no value for d4: give one, fk(q, { d4: 1 })",
        "NaN NaN",
    ]


def test_javascript_examples_run(tmp_path: Path) -> None:
    for robot in (PUMA, SCARA, PLANAR, HOSTILE_PARAMETERS):
        module, _ = javascript.generate(robot)
        write_all([module], tmp_path)
        run([require_tool("node"), "--check", module.name], tmp_path)
        lines = r"Example:\n \*\n((?: \*(?:     .*)?\n)+?) \*\n \* @module"
        example = re.search(lines, module.text)
        assert example is not None
        node(example[1].replace(" *", ""), tmp_path)


# ------------------------------------------------------------------------------------------ Julia


def julia_parameters(module: str) -> list[str]:
    """The keywords that have no value, in their order."""
    head = re.search(r"^function fk\((.*?)^\)", module, re.DOTALL | re.MULTILINE)
    return re.findall(r"^    (\w+),$", head[1], re.MULTILINE) if head else []


def test_julia_agrees_with_the_oracles(tmp_path: Path) -> None:
    program = find_tool("julia")
    lines = ["show_(m) = for x in permutedims(m) print(x, ' ') end\n"]
    for case, (file,) in written(julia.generate, tmp_path):
        (name,) = re.findall(r"^module (\w+)$", file.text, re.MULTILINE)
        fields = julia_parameters(file.text)
        given = "; " + ", ".join(f"{f} = {x!r}" for f, x in zip(fields, case.open, strict=True))
        lines.append(f'include("{file.name}")\n')
        for q in case.q:
            arguments = f"Float64[{numbers(q)}]{given}"
            lines.append(f"T, J = {name}.fk_jacobian({arguments})\n")
            lines.append(f"show_({name}.fk({arguments})); show_(T)\n")
            lines.append(f"show_({name}.jacobian({arguments})); show_(J); println()\n")
    (tmp_path / "main.jl").write_text("".join(lines))
    assert_agrees(run([program, "--startup-file=no", "main.jl"], tmp_path))


def test_julia_agrees_with_the_oracles_in_our_interpreter(tmp_path: Path) -> None:
    parse = julia_parser()
    lines = []
    for case, (file,) in written(julia.generate, tmp_path):
        module = Module(parse, file.text)
        given = dict(zip(julia_parameters(file.text), case.open, strict=True))
        for q in case.q:
            T, J = module.call("fk_jacobian", q, **given)
            found = (module.call("fk", q, **given), T, module.call("jacobian", q, **given), J)
            lines.append(" ".join(repr(float(x)) for matrix in found for x in matrix.ravel()))
    assert_agrees("\n".join(lines))


def test_julia_is_asked_to_print_the_poses(monkeypatch: pytest.MonkeyPatch) -> None:
    """There is no Julia to run it: it is Julia by its grammar, and includes what was written."""
    monkeypatch.setattr(julia, "find_program", lambda name: f"/opt/{name}")
    files = julia.generate(PLANAR)
    poses = random_poses(PLANAR, 3, is_single=False)
    program = julia.check_program(PLANAR, files, poses)
    (driver,) = program.files
    assert program.commands == (("/opt/julia", "--startup-file=no", driver.name),)
    assert driver.name != files[0].name
    assert not julia_parser()(driver.text.encode()).root_node.has_error
    assert f'include("{files[0].name}")' in driver.text
    for row in poses.joints:
        assert all(repr(x) in driver.text for x in row)


# --------------------------------------------------------------------------------- all languages


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.name)
def test_every_language_says_where_its_files_come_from(target: Target) -> None:
    for file in target.generate(SCARA):
        assert "Generated by symdh 0" in file.text[:400]
        assert "Do not edit" in file.text[:500]
        assert file.text.isascii()
        assert file.text.endswith("\n")
        assert not file.text.endswith("\n\n")
        assert not re.search(r"[ \t]$", file.text, re.MULTILINE)
        lines = 2 if file.name.endswith(".py") else 1  # that are empty, between functions
        assert "\n" * (lines + 2) not in file.text


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.name)
def test_a_name_cannot_leave_its_comment(target: Target) -> None:
    arm = replace(PLANAR, name='a */ int x; """ \\ ??/ %} `')
    for file in target.generate(arm):
        assert "int x;" not in file.text


@pytest.mark.parametrize("target", LANGUAGES)
def test_symdh_verifies_what_it_wrote(target: str) -> None:
    require_language(target)
    verification = verify(PUMA, target, generate(PUMA, target), count=5)
    assert verification.is_right
    assert verification.poses == 5


def test_every_target_is_among_the_languages_here() -> None:
    assert set(LANGUAGES) == {target.name for target in TARGETS}


def planar_with_lengths(names: list[str]) -> Robot:
    """Two joints in a plane, with two lengths of these names in each of the fixed rows between."""
    first, last, *others = names
    rows = [f"{{theta: u, d: 0, a: {first}, alpha: 0}}"]
    for d, a in zip(others[::2], others[1::2], strict=True):
        rows.append(f"{{theta: 0, d: {d}, a: {a}, alpha: 0, type: fixed}}")
    rows.append(f"{{theta: v, d: 0, a: {last}, alpha: 0}}")
    joints = "".join(f"  - {row}\n" for row in rows)
    return symdh.loads(f"name: arm\nconvention: standard\njoints:\n{joints}")


def may_be_a_length(name: str) -> bool:
    try:
        planar_with_lengths([name, f"{name}9"])
    except SymdhError:  # a function of symdh's own, or too long
        return False
    return True


@pytest.mark.parametrize("target", LANGUAGES)
def test_lengths_may_be_called_what_the_code_calls_its_own(target: str) -> None:
    """Every function that generated code calls or defines and each of its constants, as a length.

    Sixteen rows are the most that have inverse kinematics, so there are several arms.
    """
    require_language(target)
    files = generate(planar_with_lengths(["a1", "a2"]), target)
    text = "".join(file.text for file in files)
    found = re.findall(r"\b[A-Za-z_]\w*(?= ?\()|\b[A-Z][A-Z0-9_]+\b", text)
    names = sorted(filter(may_be_a_length, set(found)))
    assert len(names) > 20
    for start in range(0, len(names), 30):
        part = names[start : start + 30]
        arm = planar_with_lengths([*part, *(f"z{k}" for k in range(30 - len(part)))])
        verification = verify(arm, target, generate(arm, target), count=2)
        assert verification.is_right, part
        assert verification.inverse is not None
        assert verification.inverse.found == 2
