"""The inverse kinematics of a robot as its C files hold it: what their templates lay out."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from sympy import Expr, Symbol

from symdh.codegen.c.printer import CPrinter
from symdh.codegen.facts import Facts
from symdh.codegen.graph import Op
from symdh.codegen.inverse.breaking import broken
from symdh.codegen.inverse.compiled import Access, CompiledSection, section
from symdh.codegen.inverse.found import LEFT_OUT, Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.writing import write_program
from symdh.codegen.names import Scope, words
from symdh.codegen.precision import Precision
from symdh.codegen.reserved import is_reserved_in_c
from symdh.robot import Robot

#: What the branches name themselves.
OWN_IN_BRANCHES = ("T", "p", "q", "found", "blank")
#: Helpers and macros of the section, behind the name of the arm and ``_ik``.
_NAMES = words(
    """
    MAX PI angles apart branches distinct error goal improve in_limits leave limits line pair
    propose rescue roots rotation search shift shifts slide sort square step turn turns unknown wave
    wrapped
    """
)
ACCESS = Access(start="found->start[{}]", field="found->p->{}", goal="T[{place}]")


def c_section(
    robot: Robot,
    known: Mapping[Symbol, Expr],
    functions: Mapping[Op, str],
    precision: Precision,
    stem: str,
    fields: Mapping[Symbol, str],
    facts: Facts,
    locked: tuple[Symbol, ...] = (),
    *,
    wanted: bool = True,
) -> CompiledSection:
    """Write the inverse kinematics of a robot in C.

    Parameters
    ----------
    robot : Robot
    known : mapping of Symbol to Expr
        Numbers that are compiled in.
    functions : mapping of Op to str
        What <math.h> calls its functions for that kind of number.
    precision : Precision
    stem : str
        What the names of the arm begin with.
    fields : mapping of Symbol to str
        The fields of the struct of parameters.
    facts : Facts
    locked : tuple of Symbol
        Joint variables that are held at what the seed says.
    wanted : bool
        Whether the file is to have it.
    """
    program = inverse_program(robot, known, locked) if wanted else LEFT_OUT
    if isinstance(program, Missing):
        return CompiledSection(program.reason)
    own = {*OWN_IN_BRANCHES, *functions.values(), *(f"{stem}_ik_{name}" for name in _NAMES)}
    own.add(f"{stem}_ik")
    scope = Scope(lambda name: name in own or is_reserved_in_c(name))
    symbols = scope.take_symbols([*fields, *robot.variables])
    parameters = {symbol: f"p->{name}" for symbol, name in fields.items()}
    printer = partial(CPrinter, precision)
    written = write_program(program, functions, symbols, scope, parameters, printer)
    return section(robot, facts, program, written, ACCESS, fields)


def c_head(stem: str, real: str, n: int, *, with_parameters: bool) -> str:
    """Return the head of ``NAME_ik``, without the semicolon."""
    arguments = [f"const {real} T[16]"]
    if with_parameters:
        arguments.append(f"const {stem}_params *p")
    answers = f"{real} q[{stem}_IK_MAX][{n}]"
    arguments += [f"const {real} *seed", answers, "unsigned *free_joints"]
    return broken(f"int {stem}_ik({', '.join(arguments)})", 0)
