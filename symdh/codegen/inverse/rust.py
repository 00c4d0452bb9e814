"""The inverse kinematics of a robot as its Rust module holds it: what its template lays out."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sympy import Symbol

from symdh.codegen.facts import Facts
from symdh.codegen.graph import Op
from symdh.codegen.inverse.breaking import broken
from symdh.codegen.inverse.compiled import Access, CompiledSection, section
from symdh.codegen.inverse.constants import NUMBERS, SENTENCES, SETTLE
from symdh.codegen.inverse.found import LEFT_OUT, Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.program import Program
from symdh.codegen.inverse.writing import roots_of, write_program
from symdh.codegen.names import Scope
from symdh.codegen.routine import reachable
from symdh.robot import Robot

#: Functions of the search under way, which calls those that the caller passed.
_FUNCTIONS = {
    op: f"found.{op.name.lower()}" for op in (Op.SIN, Op.COS, Op.TAN, Op.ASIN, Op.ACOS, Op.ATAN)
} | {
    Op.ATAN2: "found.atan2",
    Op.SQRT: "found.sqrt",
    Op.POW: "found.powf",
    Op.ABS: "f64::abs",
}
_ACCESS = Access(start="found.start[{}]", field="found.p.{}", goal="T[{row}][{column}]")


def rust_section(
    robot: Robot,
    fields: Mapping[Symbol, str],
    facts: Facts,
    is_reserved: Callable[[str], bool],
    locked: tuple[Symbol, ...] = (),
    *,
    wanted: bool = True,
) -> CompiledSection:
    """Write the inverse kinematics of a robot in Rust; its parameters stay open.

    Parameters
    ----------
    robot : Robot
    fields : mapping of Symbol to str
        The fields of ``Params``.
    facts : Facts
    is_reserved : callable
        Says whether the language or the module has a name already.
    locked : tuple of Symbol
        Joint variables that are held at what the seed says.
    wanted : bool
        Whether the file is to have it.
    """
    program = inverse_program(robot, None, locked) if wanted else LEFT_OUT
    if isinstance(program, Missing):
        return CompiledSection(program.reason)
    scope = Scope(is_reserved)
    symbols = scope.take_symbols([*fields, *robot.variables])
    parameters = {symbol: f"p.{name}" for symbol, name in fields.items()}
    written = write_program(program, _FUNCTIONS, symbols, scope, parameters)
    return section(robot, facts, program, written, _ACCESS, fields)


def functions_needed(program: Program) -> frozenset[Op]:
    """Return the functions of mathematics that branches and helpers call."""
    branches = {node.op for node in reachable([*roots_of(program), program.reach])}
    helpers = {Op.SIN, Op.COS, Op.SQRT} | ({Op.ATAN2} if any(program.turning) else set())
    return frozenset((branches | helpers) & set(_FUNCTIONS))


def rust_context() -> dict[str, object]:
    """Return what the template needs beside ``ik``: numbers, sentences, and how lines break."""
    return {**NUMBERS, "sentences": SENTENCES, "settle": SETTLE, "wrap": broken}
