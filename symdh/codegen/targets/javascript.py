"""JavaScript: an ES module without dependencies, and its TypeScript types.

``fk(q)`` gives the rows of T, 4 x 4, ``jacobian(q)`` those of J, 6 x n, ``fk_jacobian(q)`` both;
``ik(T)`` goes back.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Symbol

from symdh.codegen.calls import JAVASCRIPT
from symdh.codegen.functions import Language, required_values, write_program
from symdh.codegen.inverse.javascript import OWN, SCRIPT
from symdh.codegen.inverse.script import script_context, script_section
from symdh.codegen.names import file_stem, words
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses, find_program
from symdh.robot import Robot
from symdh.templating import render

#: Keywords of JavaScript (in modules) and TypeScript, and the globals that the module reads.
_KEYWORDS = words(
    """
    abstract any arguments as async await boolean break case catch class const constructor continue
    debugger declare default delete do double else enum eval export extends false final finally
    float for from function get goto if implements import in instanceof int interface let long
    module native new null number of package private protected public require return set short
    static string super switch symbol synchronized this throw throws transient true try type typeof
    undefined var void volatile while with yield
    Infinity Math NaN Object RangeError TypeError globalThis
    q T J N_JOINTS fk jacobian fk_jacobian checkArguments
    """
)
_RESERVED = _KEYWORDS | OWN


_LANGUAGE = Language(calls=JAVASCRIPT, is_reserved=_RESERVED.__contains__, element="q[{}]")


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.mjs`` and ``NAME.d.mts`` (see `symdh.codegen.generate`)."""
    program = write_program(robot, _LANGUAGE)
    stem = file_stem(robot.name)
    context = {
        "stem": stem,
        "program": program,
        "facts": program.facts,
        "n": len(program.facts.joints),
        "joint_lines": program.facts.joint_table("q[{}]"),
        "ik": script_section(robot, program.facts, _LANGUAGE, SCRIPT, lock, wanted=ik),
        **script_context(_LANGUAGE, SCRIPT),
    }
    return (
        GeneratedFile(f"{stem}.mjs", render("javascript/module.mjs.jinja", **context)),
        GeneratedFile(f"{stem}.d.mts", render("javascript/types.d.mts.jinja", **context)),
    )


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    program = write_program(robot, _LANGUAGE)
    main = render(
        "javascript/check.mjs.jinja",
        module=files[0].name,
        rows=poses.rows,
        parameters=required_values(program, poses.parameters),
        inverse=poses.inverse is not None,
    )
    # Not called check.mjs: the table may be.
    driver = GeneratedFile("symdh_check_poses.mjs", main)
    command = (find_program("node", "nodejs"), driver.name)
    return CheckProgram((driver,), (command,))
