"""MATLAB and Octave: one function file a function.

``NAME_fk(q)`` gives T, 4 x 4, ``NAME_jacobian(q)`` J, 6 x n, ``NAME_fk_jacobian(q)`` both;
``NAME_ik(T)`` goes back.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Symbol

from symdh.codegen.calls import CALLS
from symdh.codegen.functions import Language, required_values, write_program
from symdh.codegen.graph import Op
from symdh.codegen.inverse.matlab import OWN, SCRIPT
from symdh.codegen.inverse.script import script_context, script_section
from symdh.codegen.names import file_stem, words
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses, find_program
from symdh.errors import UnsupportedError
from symdh.robot import Robot
from symdh.templating import render

_CALLS = CALLS | {Op.POW: "realpow"}

#: Keywords of MATLAB and Octave, and the functions that the files call.
_KEYWORDS = words(
    """
    arguments break case catch classdef continue do else elseif end end_try_catch
    end_unwind_protect endclassdef endenumeration endevents endfor endfunction endif endmethods
    endparfor endproperties endspmd endswitch endwhile enumeration events for function global if
    import methods otherwise parfor persistent properties return spmd switch try until
    unwind_protect unwind_protect_cleanup while
    ans error fieldnames isempty isfield nargin numel setdiff struct zeros
    q p T J known given check_arguments
    """
)
_RESERVED = _KEYWORDS | OWN | frozenset(_CALLS.values())

#: Longest name of MATLAB; it cuts what is longer, without an error.
_LONGEST_NAME = 63


_LANGUAGE = Language(calls=_CALLS, is_reserved=_RESERVED.__contains__, element="q({})", first=1)


def generate(
    robot: Robot, *, lock: tuple[Symbol, ...] = (), ik: bool = True
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME_fk.m``, ``NAME_jacobian.m``, ``NAME_fk_jacobian.m``.

    And ``NAME_ik.m`` where the arm has a closed form. See `symdh.codegen.generate`.
    """
    stem = file_stem(robot.name)
    if len(f"{stem}_fk_jacobian") > _LONGEST_NAME:
        raise UnsupportedError(
            f"{stem}_fk_jacobian is longer than the {_LONGEST_NAME} letters that MATLAB allows a "
            "name; give the table a shorter one"
        )
    program = write_program(robot, _LANGUAGE)
    inverse = script_section(robot, program.facts, _LANGUAGE, SCRIPT, lock, wanted=ik)
    context = {
        "stem": stem,
        "program": program,
        "facts": program.facts,
        "n": len(program.facts.joints),
        "joint_lines": program.facts.joint_table("q({})", first=1),
        "ik": inverse,
        **script_context(_LANGUAGE, SCRIPT),
    }
    files = [
        GeneratedFile(
            f"{stem}_{function.name}.m",
            render("matlab/function.m.jinja", function=function, **context),
        )
        for function in program.functions
    ]
    if inverse.program is not None:
        files.append(GeneratedFile(f"{stem}_ik.m", render("matlab/ik.m.jinja", **context)))
    return tuple(files)


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    program = write_program(robot, _LANGUAGE)
    main = render(
        "matlab/check.m.jinja",
        stem=file_stem(robot.name),
        rows=poses.rows,
        parameters=required_values(program, poses.parameters),
        inverse=poses.inverse is not None,
    )
    driver = GeneratedFile("symdh_check_poses.m", main)
    octave = find_program("octave-cli", "octave")
    command = (octave, "--norc", "--no-history", "--quiet", driver.name)
    return CheckProgram((driver,), (command,))
