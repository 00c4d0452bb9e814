"""Python: one module that needs NumPy alone.

``fk(q)`` takes (..., n) to (..., 4, 4), ``jacobian(q)`` to (..., 6, n), ``fk_jacobian(q)`` to both;
one pose through ``math``, many through NumPy or any other array namespace. ``ik(T)`` goes back.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.calls import PYTHON
from symdh.codegen.functions import Function, Language, write_program
from symdh.codegen.graph import Op
from symdh.codegen.inverse.python import PYTHON_OWN, python_context, python_section
from symdh.codegen.listing import Local
from symdh.codegen.names import PYTHON_KEYWORDS, file_stem, words
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses
from symdh.robot import Robot
from symdh.templating import render

#: Sine and cosine are arguments: those of `math` or of arrays. The others see parameters alone.
_CALLS = PYTHON | {Op.SIN: "sin", Op.COS: "cos"}

#: Written down, because the list of the running Python changes with its version.
_BUILTINS = words(
    """
    TypeError ValueError abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable
    chr classmethod compile complex copyright credits delattr dict dir divmod enumerate eval exec
    exit filter float format frozenset getattr globals hasattr hash help hex id input int isinstance
    issubclass iter len license list locals map max memoryview min next object oct open ord pow
    print property quit range repr reversed round set setattr slice sorted staticmethod str sum
    super tuple type vars zip
    """
)

#: Names that the template of the module uses itself.
_OWN = words(
    """
    fk jacobian fk_jacobian math sin cos struct sys np npt q T J numbers entries packed
    Any Callable N_JOINTS JOINT_NAMES JOINT_LIMITS
    """
)
_RESERVED = PYTHON_KEYWORDS | _BUILTINS | _OWN | PYTHON_OWN


@dataclass(frozen=True)
class _Body:
    """A function on numbers or arrays: its arguments, lines, and entries, matrix by matrix."""

    name: str
    arguments: tuple[str, ...]
    locals: tuple[Local, ...]
    entries: tuple[tuple[str, ...], ...]
    matrices: tuple[str, ...]


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.py`` (see `symdh.codegen.generate`)."""
    program = write_program(robot, Language(calls=_CALLS, is_reserved=_RESERVED.__contains__))
    facts = program.facts
    symbols = (*(parameter.name for parameter in program.parameters), *program.variables)
    stem = file_stem(robot.name)
    text = render(
        "python/module.py.jinja",
        stem=stem,
        facts=facts,
        joint_lines=facts.joint_table("q[..., {}]"),
        parameters=program.parameters,
        required=program.required,
        joint_names=[f'"{joint.name}"' for joint in facts.joints],
        joint_limits=[_limits(joint.limits) for joint in facts.joints],
        bodies={function.name: _body(function, symbols) for function in program.functions},
        ik=python_section(robot, facts, _RESERVED.__contains__, lock, wanted=ik),
        **python_context(),
    )
    return (GeneratedFile(f"{stem}.py", text),)


def _body(function: Function, symbols: tuple[str, ...]) -> _Body:
    return _Body(
        name=function.name,
        arguments=("sin", "cos", *symbols),
        locals=function.locals,
        entries=tuple(row for rows in function.results.values() for row in rows),
        matrices=tuple(function.results),
    )


def _limits(limits: tuple[str, str] | None) -> str:
    return f"({', '.join(limits)})" if limits else "None"


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    program = write_program(robot, Language(calls=_CALLS, is_reserved=_RESERVED.__contains__))
    names = [parameter.name for parameter in program.required]
    text = render(
        "python/check.py.jinja",
        stem=files[0].name.removesuffix(".py"),
        rows=poses.rows,
        parameters=list(zip(names, map(repr, poses.parameters.values()), strict=True)),
        inverse=poses.inverse is not None,
    )
    # Not called check.py: the table may be.
    driver = GeneratedFile("symdh_check_poses.py", text)
    command = (sys.executable, driver.name)
    return CheckProgram((driver,), (command,))
