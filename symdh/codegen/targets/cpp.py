"""C++17: one header on Eigen, templated on the scalar: double, float, dual numbers.

``NAME::fk(q)`` gives ``Eigen::Matrix<Scalar, 4, 4>``, ``NAME::jacobian(q)`` 6 x n,
``NAME::fk_jacobian(q)`` both; ``NAME::ik(T)`` goes back.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Symbol

from symdh.codegen.calls import CALLS
from symdh.codegen.functions import Language, required_values, write_program
from symdh.codegen.inverse.cpp import cpp_bounds, cpp_heads, cpp_section
from symdh.codegen.inverse.dialect import cpp_dialect
from symdh.codegen.literals import literal
from symdh.codegen.names import file_stem, words
from symdh.codegen.printer import Printer
from symdh.codegen.reserved import C_LIBRARY, is_reserved_in_c
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses, find_program
from symdh.robot import Robot
from symdh.templating import render

_OWN = words(
    """
    q p T J joints n_joints fk jacobian fk_jacobian Params Scalar Derived Eigen std ik ik_max
    IkAnswers detail within_limits
    """
)


class _Printer(Printer):
    """Numbers become the scalar, so that float stays float and a dual number meets its like."""

    def number(self, value: Expr) -> str:
        return f"Scalar({literal(value)})"


_LANGUAGE = Language(
    calls=CALLS,  # found by argument-dependent lookup, or in std
    is_reserved=lambda n: n in _OWN or n in CALLS.values() or is_reserved_in_c(n),
    element="q[{}]",
    field="p.{}",
    printer=_Printer,
)


class _BranchPrinter(_Printer):
    """Sums as the C has them, with which the branches share their template."""

    brackets_products = True


#: Without argument-dependent lookup: the inverse kinematics is for numbers alone.
_STD = {op: f"std::{call}" for op, call in CALLS.items()}


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.hpp`` (see `symdh.codegen.generate`)."""
    program = write_program(robot, _LANGUAGE)
    stem = file_stem(robot.name)
    n = len(program.facts.joints)
    names = (parameter.name for parameter in program.parameters)
    fields = dict(zip(robot.parameters, names, strict=True))
    text = render(
        "cpp/header.hpp.jinja",
        stem=stem,
        namespace=_namespace(stem),
        program=program,
        facts=program.facts,
        n=n,
        joint_lines=program.facts.joint_table("q[{}]"),
        using={
            function.name: sorted(CALLS[op] for op in function.calls)
            for function in program.functions
        },
        ik=cpp_section(robot, _STD, _BranchPrinter, fields, program.facts, lock, wanted=ik),
        fields=fields,
        bounds=cpp_bounds(),
        **cpp_heads(n, with_parameters=bool(fields)),
        **cpp_dialect().context(),
    )
    return (GeneratedFile(f"{stem}.hpp", text),)


def _namespace(stem: str) -> str:
    """Return a namespace that no keyword, macro or function of the C library stands against."""
    taken = is_reserved_in_c(stem) or stem in C_LIBRARY or stem in {"std", "Eigen", "main"}
    return f"{stem}_arm" if taken else stem


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    program = write_program(robot, _LANGUAGE)
    main = render(
        "cpp/check.cpp.jinja",
        header=files[0].name,
        namespace=_namespace(file_stem(robot.name)),
        n=len(robot.variables),
        rows=poses.rows,
        parameters=required_values(program, poses.parameters),
        has_parameters=bool(program.parameters),
        inverse=poses.inverse is not None,
    )
    compiler = find_program("c++", "g++", "clang++")
    # Where Debian, Homebrew and MacPorts put Eigen.
    folders = ("/usr/include/eigen3", "/usr/local/include/eigen3", "/opt/homebrew/include/eigen3")
    includes = [word for folder in folders for word in ("-isystem", folder)]
    return CheckProgram(
        (GeneratedFile("check.cpp", main),),
        ((compiler, "-std=c++17", "-O1", *includes, "check.cpp", "-o", "check"), ("./check",)),
    )
