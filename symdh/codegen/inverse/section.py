"""What the templates of every language get as ``ik``."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from symdh.codegen.facts import Facts
from symdh.codegen.inverse.program import Program
from symdh.codegen.inverse.writing import WrittenProgram, WrittenSolve


@dataclass(frozen=True)
class Section:
    """The inverse kinematics of a robot in one language, or the reason why there is none.

    Attributes
    ----------
    reason : str
        Why there is no inverse kinematics; the other fields have no meaning then.
    program : WrittenProgram or None
    plan : Program or None
    locked_note : str
        What the documentation of the seed says of locked joints.
    start : str
        How a joint variable of the seed is read: ``found->start[{}]``.
    first : int
        What the language counts elements from.
    """

    reason: str
    program: WrittenProgram | None = None
    plan: Program | None = None
    locked_note: str = ""
    start: str = ""
    first: int = 0

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
    def locked(self) -> list[int]:
        """The places, from 0, of the joint variables that are held."""
        return [k for k in range(len(self.given.turning)) if k not in self.given.free]

    @property
    def kinds(self) -> frozenset[str]:
        """The kinds of unknowns that there are."""
        return frozenset(s.kind for s in self.written.statements if isinstance(s, WrittenSolve))

    def seed(self, seed: Iterable[tuple[int, int]]) -> str:
        """Write what an unknown is when it is free: signs and places, from 0, of the seed."""
        signed = (
            f" {'+' if sign > 0 else '-'} {self.start.format(place + self.first)}"
            for sign, place in seed
        )
        return "".join(signed).removeprefix(" + ").strip()


def locked_note(facts: Facts, program: Program) -> str:
    """Return what the documentation of the seed says of locked joints; empty without any."""
    held = [joint.name for k, joint in enumerate(facts.joints) if k not in program.free]
    return f"; so does {' and '.join(held)}, which is locked" if held else ""
