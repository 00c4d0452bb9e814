"""The inverse kinematics of a robot as its C++ header holds it; the template is that of C."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Symbol

from symdh.codegen.facts import Facts
from symdh.codegen.graph import Op
from symdh.codegen.inverse.c import ACCESS, OWN_IN_BRANCHES
from symdh.codegen.inverse.compiled import CompiledSection, section
from symdh.codegen.inverse.constants import NUMBERS, SINGLE_NUMBERS
from symdh.codegen.inverse.found import LEFT_OUT, Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.writing import MakePrinter, write_program
from symdh.codegen.names import Scope, words
from symdh.codegen.reserved import is_reserved_in_c
from symdh.robot import Robot

_OWN = words("std Scalar Params fk jacobian fk_jacobian detail n_joints")


def cpp_section(
    robot: Robot,
    functions: Mapping[Op, str],
    printer: MakePrinter,
    fields: Mapping[Symbol, str],
    facts: Facts,
    locked: tuple[Symbol, ...] = (),
    *,
    wanted: bool = True,
) -> CompiledSection:
    """Write the inverse kinematics of a robot in C++; its parameters stay open.

    Parameters
    ----------
    robot : Robot
    functions : mapping of Op to str
        What is called for the functions of <cmath>.
    printer : callable
        See `symdh.codegen.inverse.writing.write_program`.
    fields : mapping of Symbol to str
        The fields of ``Params``.
    facts : Facts
    locked : tuple of Symbol
        Joint variables that are held at what the seed says.
    wanted : bool
        Whether the file is to have it.
    """
    program = inverse_program(robot, None, locked) if wanted else LEFT_OUT
    if isinstance(program, Missing):
        return CompiledSection(program.reason)
    scope = Scope(_is_taken)
    symbols = scope.take_symbols([*fields, *robot.variables])
    parameters = {symbol: f"p->{name}" for symbol, name in fields.items()}
    written = write_program(program, functions, symbols, scope, parameters, printer)
    return section(robot, facts, program, written, ACCESS, fields)


def _is_taken(name: str) -> bool:
    own = name in _OWN or name in OWN_IN_BRANCHES or name.startswith("ik_")
    return own or is_reserved_in_c(name)


def cpp_bounds() -> list[tuple[str, str, str]]:
    """Return name, value for float, and value for double of what the helpers go by."""
    return [(name, SINGLE_NUMBERS[name], NUMBERS[name]) for name in NUMBERS]


def cpp_heads(n: int, *, with_parameters: bool) -> dict[str, str]:
    """Return the heads of the two functions of ``detail`` that are called from outside."""
    arguments = ["const Scalar T[16]"]
    if with_parameters:
        arguments.append("const Params<Scalar> *p")
    arguments += ["const Scalar *seed", f"Scalar q[ik_max][{n}]", "unsigned *free_joints"]
    joined = ",\n    ".join(arguments)
    return {
        "ik_head": f"template <class Scalar>\nint ik_find(\n    {joined})",
        "within_head": f"template <class Scalar>\nint ik_within_limits(const Scalar q[{n}])",
    }
