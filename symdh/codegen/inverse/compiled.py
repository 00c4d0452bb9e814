"""What the inverse kinematics of a robot is made of in languages that are compiled."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.facts import Facts
from symdh.codegen.inverse.constants import held_joints
from symdh.codegen.inverse.program import Kind, Program
from symdh.codegen.inverse.writing import WrittenProgram, WrittenProposal, WrittenSolve
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
class Section:
    """What a template gets as ``ik``.

    Attributes
    ----------
    reason : str
        Why there is no inverse kinematics; the other fields have no meaning then.
    program : WrittenProgram or None
    plan : Program or None
    reads : tuple of (place, name)
        What the branches read first.
    limits : tuple of (lower, upper)
        As literals, None where the table gives none; empty where it gives none at all.
    locked_note : str
    start : str
        As in `Access`.
    """

    reason: str
    program: WrittenProgram | None = None
    plan: Program | None = None
    reads: tuple[tuple[str, str], ...] = ()
    limits: tuple[tuple[str, str] | None, ...] = ()
    locked_note: str = ""
    start: str = ""

    @property
    def given(self) -> Program:
        """The plan, which is there where there is no reason against it."""
        assert self.plan is not None
        return self.plan

    @property
    def written(self) -> WrittenProgram:
        """The program, likewise."""
        assert self.program is not None
        return self.program

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
    def locked(self) -> list[int]:
        """The places of the others, which are held."""
        return [k for k in range(self.n) if k not in self.free]

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
    def kinds(self) -> frozenset[str]:
        """The kinds of unknowns that there are."""
        return frozenset(s.kind for s in self.written.statements if isinstance(s, WrittenSolve))

    @property
    def masks(self) -> str:
        """Which joints are free, an expression."""
        last = self.written.statements[-1]
        assert isinstance(last, WrittenProposal)
        return " | ".join(f"{name}.free_joints" for name in last.unknowns)

    def seed(self, seed: Iterable[tuple[int, int]]) -> str:
        """Write what an unknown is when it is free."""
        signed = (f" {'+' if sign > 0 else '-'} {self.start.format(k)}" for sign, k in seed)
        return "".join(signed).removeprefix(" + ").strip()


def section(
    robot: Robot,
    facts: Facts,
    program: Program,
    written: WrittenProgram,
    access: Access,
    fields: Mapping[Symbol, str],
) -> Section:
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
    held = held_joints(facts, program)
    return Section(
        reason="",
        program=written,
        plan=program,
        reads=(*read, *goal),
        limits=limits if any(limits) else (),
        locked_note=f"; so does {held}, which is locked" if held else "",
        start=access.start,
    )
