"""What the inverse kinematics of a robot is made of in languages that are compiled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.facts import Facts
from symdh.codegen.inverse.program import Kind, Program
from symdh.codegen.inverse.section import Section, locked_note
from symdh.codegen.inverse.writing import WrittenProgram, WrittenProposal
from symdh.robot import Robot


@dataclass(frozen=True, slots=True)
class Access:
    """How the branches read what they are given.

    Attributes
    ----------
    start : str
        A joint variable of the seed: ``found->start[{}]``.
    field : str
        A parameter: ``found->p->{}``.
    goal : str
        An entry of the goal: ``T[{place}]``, or ``T[{row}][{column}]``.
    """

    start: str
    field: str
    goal: str


@dataclass(frozen=True)
class CompiledSection(Section):
    """What the template of a compiled language gets as ``ik``.

    Attributes
    ----------
    reads : tuple of (place, name)
        What the branches read first.
    limits : tuple of (lower, upper)
        As literals, None where the table gives none; empty where it gives none at all.
    """

    reads: tuple[tuple[str, str], ...] = ()
    limits: tuple[tuple[str, str] | None, ...] = ()

    @property
    def most(self) -> int:
        """The most answers."""
        return self.given.most_solutions

    @property
    def n(self) -> int:
        """How many joint variables there are."""
        return len(self.given.turning)

    @property
    def n_free(self) -> int:
        """How many joint variables are found."""
        return len(self.given.free)

    @property
    def free(self) -> tuple[int, ...]:
        """Their places."""
        return self.given.free

    @property
    def axes(self) -> tuple[int, ...]:
        """Coordinates of the position that are compared."""
        return self.given.axes

    @property
    def with_orientation(self) -> bool:
        """Whether the rotation is compared."""
        return self.given.with_orientation

    @property
    def rows(self) -> int:
        """How many numbers are compared."""
        return len(self.axes) + 3 * self.with_orientation

    @property
    def turning(self) -> tuple[bool, ...]:
        """Which joint variables are angles."""
        return self.given.turning

    @property
    def angles(self) -> int:
        """How many joint variables are angles."""
        return sum(self.turning)

    @property
    def values(self) -> int:
        """The most values that one unknown has."""
        return 4 if Kind.ROOTS.value in self.kinds else 2

    @property
    def masks(self) -> str:
        """Which joints are free, an expression."""
        last = self.written.statements[-1]
        assert isinstance(last, WrittenProposal)
        return " | ".join(f"{name}.free_joints" for name in last.unknowns)


def section(
    robot: Robot,
    facts: Facts,
    program: Program,
    written: WrittenProgram,
    access: Access,
    fields: Mapping[Symbol, str],
) -> CompiledSection:
    """Gather the inverse kinematics of a robot that has been written in a language.

    Parameters
    ----------
    robot : Robot
    facts : Facts
    program : Program
    written : WrittenProgram
    access : Access
    fields : mapping of Symbol to str
        The fields of the struct of parameters.
    """
    places = {variable: access.start.format(k) for k, variable in enumerate(robot.variables)}
    places |= {symbol: access.field.format(name) for symbol, name in fields.items()}
    read = [(places[symbol], name) for symbol, name in written.reads]
    goal = [
        (access.goal.format(place=place, row=place // 4, column=place % 4), name)
        for name, place in written.goal
    ]
    limits = tuple(joint.limits for joint in facts.joints)
    return CompiledSection(
        reason="",
        program=written,
        plan=program,
        reads=(*read, *goal),
        limits=limits if any(limits) else (),
        locked_note=locked_note(facts, program),
        start=access.start,
    )
