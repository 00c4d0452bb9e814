"""The inverse kinematics of a robot as scripts hold it: JavaScript, MATLAB and Julia.

They share one plan: small helpers that return the values of an unknown, loops over these, and a
record of the search that the helpers are given. A language says how it reads an element; its
template lays the rest out.
"""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from functools import partial

from sympy import Symbol

from symdh.codegen.facts import Facts
from symdh.codegen.functions import Language
from symdh.codegen.inverse.breaking import Layout, broken, broken_value
from symdh.codegen.inverse.constants import NUMBERS, SENTENCES, SETTLE
from symdh.codegen.inverse.found import LEFT_OUT, Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.section import Section, locked_note
from symdh.codegen.inverse.writing import WrittenProgram, write_program
from symdh.codegen.listing import Local
from symdh.codegen.names import Scope
from symdh.robot import Robot

_WIDTH = 100


@dataclass(frozen=True)
class Script:
    """How a language spells what inverse kinematics needs beside its `Language`.

    Attributes
    ----------
    goal : str
        How an entry of the goal is read, by row and column: ``goal[{}][{}]``.
    start : str
        How a joint variable of the seed is read: ``start[{}]``.
    parameter : str
        How a parameter is read: ``p.{}``.
    infinity : str
    layout : Layout
    """

    goal: str
    start: str
    parameter: str
    infinity: str
    layout: Layout


@dataclass(frozen=True)
class ScriptSection(Section):
    """What the templates of a script get as ``ik``.

    Attributes
    ----------
    reads : tuple of Local
        What the branches read first, parameters aside.
    parameters : tuple of str
        The parameters that they read.
    limits : tuple of (lower, upper)
        Of each joint variable, infinite where the table gives none.
    """

    reads: tuple[Local, ...] = ()
    parameters: tuple[str, ...] = ()
    limits: tuple[tuple[str, str], ...] = ()

    @property
    def about(self) -> str:
        """What is compared, for the documentation."""
        return (
            f"What is compared: {self.given.description}. Each answer has passed forward "
            "kinematics: it misses the pose by less than 1e-9 of the arm's reach."
        )

    @property
    def about_pose(self) -> str:
        """What is asked for."""
        rough = "; its rotation may be off by 1e-4" if self.given.with_orientation else ""
        return f"pose of the end of the arm in its base frame, 4 x 4{rough}"

    @property
    def about_seed(self) -> str:
        """What a seed does."""
        return (
            "With them the nearest answer comes first. A joint that the pose leaves free, at a "
            f"singular pose, keeps its value of the seed, else 0{self.locked_note}."
        )

    @property
    def about_answers(self) -> str:
        """How many there are, and where their angles lie."""
        most = self.given.most_solutions
        return (
            f"at most {most}, none where the pose is out of reach or holds no numbers. Angles from "
            "-pi to pi, moved by full turns into the limits of the table where that is possible."
        )


def script_section(
    robot: Robot,
    facts: Facts,
    language: Language,
    script: Script,
    locked: tuple[Symbol, ...] = (),
    *,
    wanted: bool = True,
) -> ScriptSection:
    """Write the inverse kinematics of a robot in a language.

    Parameters
    ----------
    robot : Robot
    facts : Facts
    language : Language
        Its reserved names hold those of the section.
    script : Script
    locked : tuple of Symbol
        Joint variables that are held at what the seed says.
    wanted : bool
        Whether the file is to have it.
    """
    program = inverse_program(robot, None, locked) if wanted else LEFT_OUT
    if isinstance(program, Missing):
        return ScriptSection(program.reason)
    scope = Scope(language.is_reserved)
    symbols = scope.take_symbols([*robot.parameters, *robot.variables])
    fields = {symbol: script.parameter.format(symbols[symbol]) for symbol in robot.parameters}
    written = write_program(program, language.calls, symbols, scope, fields, language.printer)
    return ScriptSection(
        reason="",
        program=written,
        plan=program,
        reads=_reads(robot, language, script, written),
        parameters=tuple(name for symbol, name in written.reads if symbol in fields),
        limits=tuple(
            joint.limits or (f"-{script.infinity}", script.infinity) for joint in facts.joints
        ),
        locked_note=locked_note(facts, program),
        start=script.start,
        first=language.first,
    )


def script_context(language: Language, script: Script) -> dict[str, object]:
    """Return what the templates need beside ``ik``: numbers, sentences, and how lines break."""
    return {
        **NUMBERS,
        "sentences": SENTENCES,
        "settle": SETTLE,
        "first": language.first,
        "wrap": partial(broken, layout=script.layout),
        "wrap_value": partial(broken_value, layout=script.layout),
        "filled": filled,
    }


def filled(text: str, begin: str, behind: str | None = None) -> str:
    """Set a sentence as lines of a comment, the first begun by `begin`, the others by `behind`."""
    return textwrap.fill(
        text,
        _WIDTH,
        initial_indent=begin,
        subsequent_indent=begin if behind is None else behind,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _reads(
    robot: Robot, language: Language, script: Script, written: WrittenProgram
) -> tuple[Local, ...]:
    """Return the locked joints and the entries of the goal that the branches read."""
    first = language.first
    places = {
        variable: script.start.format(place)
        for place, variable in enumerate(robot.variables, first)
    }
    held = [Local(name, places[symbol]) for symbol, name in written.reads if symbol in places]
    entries = [
        Local(name, script.goal.format(place // 4 + first, place % 4 + first))
        for name, place in written.goal
    ]
    return (*held, *entries)
