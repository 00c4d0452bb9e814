"""A Python extension around the generated C: a project of its own that pip installs.

``NAME_ext.fk(q)`` takes (..., n) to (..., 4, 4) as the Python module does, at the speed of C;
``out=`` takes the result, so that a loop allocates nothing. ``NAME_ext.ik(T)`` goes back.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.facts import Facts, facts_of
from symdh.codegen.inverse.found import LEFT_OUT, Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.section import Section, locked_note
from symdh.codegen.names import PYTHON_KEYWORDS, Scope, comment_text, file_stem
from symdh.codegen.targets import GeneratedFile, c
from symdh.codegen.verification import CheckProgram, Poses
from symdh.robot import Robot
from symdh.templating import render

_RESERVED = PYTHON_KEYWORDS | {"q", "out", "T", "seed", "limits"}


@dataclass(frozen=True, slots=True)
class _Result:
    """A matrix that a function fills: its number of rows, and of columns as C writes it."""

    name: str
    rows: int
    columns: int


@dataclass(frozen=True, slots=True)
class _Function:
    """A function of the module: its name, its results, and the first line of its help."""

    name: str
    results: tuple[_Result, ...]
    summary: str


@dataclass(frozen=True, slots=True)
class _Inverse(Section):
    """The inverse kinematics of the C that is wrapped."""

    limits: bool = False


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.h``, ``NAME.c``, ``NAME_ext.c``, ``setup.py``, ``pyproject.toml``.

    See `symdh.codegen.generate`. As in C, parameters that have a value are compiled in, the others
    are keyword arguments, and a robot without joint variables gets no Jacobian.
    """
    header, source = c.generate(robot, lock=lock, ik=ik)
    facts = facts_of(robot)
    stem = file_stem(robot.name)
    context = {
        "stem": stem,
        "module": f"{stem}_ext",
        "facts": facts,
        "n": len(facts.joints),
        "joint_lines": facts.joint_table("q[..., {}]"),
        "parameters": _keywords(robot),
        "functions": _functions(len(facts.joints)),
        "ik": _inverse(robot, facts, lock, wanted=ik),
    }
    return (
        header,
        source,
        GeneratedFile(f"{stem}_ext.c", render("python-ext/module.c.jinja", **context)),
        GeneratedFile("setup.py", render("python-ext/setup.py.jinja", **context)),
        GeneratedFile("pyproject.toml", render("python-ext/pyproject.toml.jinja", **context)),
    )


def _keywords(robot: Robot) -> list[tuple[str, str]]:
    """Return the keyword arguments in the order of the C struct, with what the table calls them."""
    free: list[Symbol] = [symbol for symbol in robot.parameters if symbol not in robot.values]
    names = Scope(_RESERVED.__contains__).take_symbols(free)
    return [(name, comment_text(symbol.name)) for symbol, name in names.items()]


def _inverse(robot: Robot, facts: Facts, lock: tuple[Symbol, ...], *, wanted: bool) -> _Inverse:
    program = inverse_program(robot, None, lock) if wanted else LEFT_OUT
    if isinstance(program, Missing):
        return _Inverse(program.reason)
    return _Inverse(
        reason="",
        plan=program,
        limits=any(joint.limits for joint in facts.joints),
        locked_note=locked_note(facts, program),
    )


def _functions(n: int) -> list[_Function]:
    T, J = _Result("T", 4, 4), _Result("J", 6, n)
    functions = [
        _Function("fk", (T,), "Return the pose of the end of the arm, shape (..., 4, 4)."),
        _Function("jacobian", (J,), f"Return the geometric Jacobian, shape (..., 6, {n})."),
        _Function("fk_jacobian", (T, J), "Return the pose and the Jacobian together."),
    ]
    return functions if n else functions[:1]


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    names = [name for name, _ in _keywords(robot)]
    main = render(
        "python/check.py.jinja",
        stem=f"{file_stem(robot.name)}_ext",
        rows=poses.rows,
        parameters=list(zip(names, map(repr, poses.parameters.values()), strict=True)),
        inverse=poses.inverse is not None,
    )
    driver = GeneratedFile("symdh_check_poses.py", main)
    build = (sys.executable, "setup.py", "--quiet", "build_ext", "--inplace")
    commands = (build, (sys.executable, driver.name))
    return CheckProgram((driver,), commands)
