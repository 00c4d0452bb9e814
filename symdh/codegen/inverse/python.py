"""The inverse kinematics of a robot as its Python module holds it: what the template lays out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.calls import PYTHON
from symdh.codegen.facts import Facts
from symdh.codegen.inverse.breaking import broken, broken_value
from symdh.codegen.inverse.constants import NUMBERS, SENTENCES, SETTLE
from symdh.codegen.inverse.found import LEFT_OUT, Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.section import Section, locked_note
from symdh.codegen.inverse.writing import WrittenProgram, write_program
from symdh.codegen.names import Scope, words
from symdh.robot import Robot

#: What the section calls its functions, arguments and modules; names that begin with an underscore
#: are nobody else's.
PYTHON_OWN = words("ik ik_free seed limits math Iterator T")
_START = "_start[{}]"


@dataclass(frozen=True)
class PythonSection(Section):
    """What the template ``python/ik.py.jinja`` gets as ``ik``.

    Attributes
    ----------
    reads : tuple of (place, name)
        What the branches read first.
    passed : str
        The parameters as a dict.
    """

    reads: tuple[tuple[str, str], ...] = ()
    passed: str = ""


def python_section(
    robot: Robot,
    facts: Facts,
    is_reserved: Callable[[str], bool],
    locked: tuple[Symbol, ...] = (),
    *,
    wanted: bool = True,
) -> PythonSection:
    """Write the inverse kinematics of a robot in Python.

    Parameters
    ----------
    robot : Robot
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
        return PythonSection(program.reason)
    scope = Scope(is_reserved)
    symbols = scope.take_symbols([*robot.parameters, *robot.variables])
    written = write_program(program, PYTHON, symbols, scope)
    return PythonSection(
        reason="",
        program=written,
        plan=program,
        reads=_reads(robot, written),
        passed="{" + ", ".join(f'"{symbols[s]}": {symbols[s]}' for s in robot.parameters) + "}",
        locked_note=locked_note(facts, program),
        start=_START,
    )


def python_context() -> dict[str, object]:
    """Return what the template needs beside ``ik``: numbers, sentences, and how lines break."""
    return {
        **NUMBERS,
        "sentences": SENTENCES,
        "settle": SETTLE,
        "wrap": broken,
        "wrap_value": broken_value,
    }


def _reads(robot: Robot, written: WrittenProgram) -> tuple[tuple[str, str], ...]:
    """Return what the branches read that is no argument, and what they call it."""
    places = {variable: _START.format(k) for k, variable in enumerate(robot.variables)}
    read = [(places[symbol], name) for symbol, name in written.reads if symbol in places]
    return (*read, *((f"_goal[{place}]", name) for name, place in written.goal))
