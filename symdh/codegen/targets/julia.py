"""Julia: one module without dependencies, generic in the type of number.

``fk(q)`` gives T, 4 x 4, ``jacobian(q)`` J, 6 x n, ``fk_jacobian(q)`` both; ``ik(T)`` goes
back.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Symbol

from symdh.codegen.calls import CALLS
from symdh.codegen.functions import Language, required_values, write_program
from symdh.codegen.graph import Op
from symdh.codegen.inverse.julia import OWN, SCRIPT
from symdh.codegen.inverse.script import script_context, script_section
from symdh.codegen.names import file_stem, words
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses, find_program
from symdh.robot import Robot
from symdh.templating import render

_CALLS = CALLS | {Op.ATAN2: "atan", Op.POW: "^"}
_KEYWORDS = words(
    """
    abstract as baremodule begin break catch const continue do else elseif end export false finally
    for function global if import in isa let local macro module mutable outer primitive public
    quote return struct true try type using var where while
    """
)

#: What the module calls or defines.
_OWN = words(
    """
    AbstractVector Base Core DimensionMismatch Main N_JOINTS length reshape sincos throw q T J fk
    jacobian fk_jacobian check
    """
)
_RESERVED = _KEYWORDS | _OWN | OWN | frozenset(_CALLS.values())


_LANGUAGE = Language(
    calls=_CALLS,
    is_reserved=_RESERVED.__contains__,
    element="q[{}]",
    first=1,
    pair=("{sin}, {cos}", "sincos({angle})"),
)


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.jl`` (see `symdh.codegen.generate`)."""
    program = write_program(robot, _LANGUAGE)
    stem = file_stem(robot.name)
    text = render(
        "julia/module.jl.jinja",
        stem=stem,
        module=_module(stem),
        program=program,
        facts=program.facts,
        n=len(program.facts.joints),
        joint_lines=program.facts.joint_table("q[{}]", first=1),
        ik=script_section(robot, program.facts, _LANGUAGE, SCRIPT, lock, wanted=ik),
        **script_context(_LANGUAGE, SCRIPT),
    )
    return (GeneratedFile(f"{stem}.jl", text),)


def _module(stem: str) -> str:
    """Return the name of the module, with a capital as Julia has it."""
    name = stem[0].upper() + stem[1:]
    return f"{name}Arm" if name in _RESERVED else name


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    program = write_program(robot, _LANGUAGE)
    main = render(
        "julia/check.jl.jinja",
        file=files[0].name,
        module=_module(file_stem(robot.name)),
        rows=poses.rows,
        parameters=required_values(program, poses.parameters),
        inverse=poses.inverse is not None,
    )
    # Not called check.jl: the table may be.
    driver = GeneratedFile("symdh_check_poses.jl", main)
    command = (find_program("julia"), "--startup-file=no", driver.name)
    return CheckProgram((driver,), (command,))
