"""Rust: one module that is ``no_std`` and needs no crate.

``fk(&q, f64::sin_cos)`` gives ``[[f64; 4]; 4]``, ``jacobian`` ``[[f64; n]; 6]``, ``fk_jacobian``
both; ``ik`` fills an array of the caller's. Sine and cosine are no part of ``core``, so the caller
passes them: ``f64::sin_cos`` of ``std``, ``libm::sincos`` on a microcontroller.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.calls import CALLS
from symdh.codegen.functions import Language, Program, write_program
from symdh.codegen.graph import Op
from symdh.codegen.inverse.program import Program as Plan
from symdh.codegen.inverse.rust import functions_needed, rust_context, rust_section
from symdh.codegen.names import file_stem, words
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses, find_program
from symdh.robot import Robot
from symdh.templating import render


@dataclass(frozen=True, slots=True)
class _Passed:
    """A function that the caller passes: its name and type here, and what std and libm call it."""

    name: str
    arguments: int
    std: str
    libm: str


#: Sine and cosine come as one, and `core` has an absolute value.
_CALLS = CALLS | {Op.ABS: "f64::abs", Op.POW: "powf"}
_SIN_COS = _Passed("sin_cos", 1, "f64::sin_cos", "libm::sincos")
_PASSED = {
    Op.SIN: _SIN_COS,
    Op.COS: _SIN_COS,
    Op.TAN: _Passed("tan", 1, "f64::tan", "libm::tan"),
    Op.ASIN: _Passed("asin", 1, "f64::asin", "libm::asin"),
    Op.ACOS: _Passed("acos", 1, "f64::acos", "libm::acos"),
    Op.ATAN: _Passed("atan", 1, "f64::atan", "libm::atan"),
    Op.ATAN2: _Passed("atan2", 2, "f64::atan2", "libm::atan2"),
    Op.SQRT: _Passed("sqrt", 1, "f64::sqrt", "libm::sqrt"),
    Op.POW: _Passed("powf", 2, "f64::powf", "libm::pow"),
}

#: Keywords of every edition, reserved ones included, and what the module calls its own things.
_KEYWORDS = words(
    """
    Self abstract as async await become box break const continue crate do dyn else enum extern false
    final fn for gen if impl in let loop macro match mod move mut override priv pub ref return self
    static struct super trait true try type typeof union unsafe unsized use virtual where while
    yield
    """
)
#: ``let None`` would be a pattern, not a name.
_OWN = words(
    """
    q p T J f64 usize Params Default N_JOINTS fk jacobian fk_jacobian sin_cos None Some Ok Err
    IK_MAX LIMITS PI Search TAU TURNS Unknown branches found goal_of ik within_limits wrapped
    """
)
_RESERVED = _KEYWORDS | _OWN | frozenset(_CALLS.values())

#: Names that a module of a crate cannot have.
_NO_MODULES = _KEYWORDS | words("core std alloc main lib")


_LANGUAGE = Language(
    calls=_CALLS,
    is_reserved=_RESERVED.__contains__,
    element="q[{}]",
    field="p.{}",
    pair=("({sin}, {cos})", "sin_cos({angle})"),
)


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``name.rs``, in small letters as Rust has it (see `symdh.codegen.generate`)."""
    program = write_program(robot, _LANGUAGE)
    module = file_stem(robot.name).lower()
    if module in _NO_MODULES:
        module = f"{module}_arm"
    names = (parameter.name for parameter in program.parameters)
    fields = dict(zip(robot.parameters, names, strict=True))
    inverse = rust_section(robot, fields, program.facts, _RESERVED.__contains__, lock, wanted=ik)
    text = render(
        "rust/module.rs.jinja",
        module=module,
        program=program,
        facts=program.facts,
        n=len(program.facts.joints),
        joint_lines=program.facts.joint_table("q[{}]"),
        passed={function.name: _passed(function.calls) for function in program.functions},
        ik=inverse,
        passed_ik=_passed_to_ik(program, inverse.plan),
        **rust_context(),
    )
    return (GeneratedFile(f"{module}.rs", text),)


def _passed(calls: Collection[Op]) -> list[_Passed]:
    """Return the functions that a caller passes for some calls, sine and cosine first."""
    return list(dict.fromkeys(_PASSED[op] for op in _PASSED if op in calls))


def _passed_to_ik(program: Program, plan: Plan | None) -> list[_Passed]:
    """Return what a caller of ``ik`` passes; it calls the other functions too."""
    if plan is None:
        return []
    calls = functions_needed(plan)
    return _passed(calls.union(*(function.calls for function in program.functions)))


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    program = write_program(robot, _LANGUAGE)
    main = render(
        "rust/check.rs.jinja",
        module=files[0].name.removesuffix(".rs"),
        has_parameters=bool(program.parameters),
        passed=_passed(program.functions[0].calls),
        passed_ik=_passed_to_ik(program, poses.inverse),
        n=len(robot.variables),
        rows=poses.rows,
        parameters=[repr(value) for value in poses.parameters.values()],
    )
    compiler = find_program("rustc")
    return CheckProgram(
        (GeneratedFile("check_poses.rs", main),),
        ((compiler, "--edition=2021", "-O", "check_poses.rs"), ("./check_poses",)),
    )
