"""The inverse kinematics of a robot as its C files hold it: what their templates lay out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from symdh.codegen.facts import Facts
from symdh.codegen.graph import Op
from symdh.codegen.inverse.breaking import broken
from symdh.codegen.inverse.constants import NUMBERS, SENTENCES, SETTLE, held_joints
from symdh.codegen.inverse.found import Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.program import Kind
from symdh.codegen.inverse.writing import (
    WrittenProgram,
    WrittenProposal,
    WrittenSolve,
    write_program,
)
from symdh.codegen.names import Scope, words
from symdh.codegen.printer import Printer
from symdh.codegen.reserved import is_reserved_in_c
from symdh.robot import Robot

_OWN = ("T", "p", "q", "found")
#: Helpers and macros of the section, behind the name of the arm and ``_ik``.
_NAMES = words(
    """
    MAX PI angles apart branches error goal improve leave limits line open pair propose rescue roots
    search shift shifts slide sort square step turn turns unknown wave wrapped
    """
)


class _Printer(Printer):
    """Writes sums as MISRA C wants them."""

    brackets_products = True


@dataclass(frozen=True)
class CSection:
    """What the templates ``c/ik.h.jinja`` and ``c/ik.c.jinja`` get as ``ik``.

    Attributes
    ----------
    reason : str
        Why there is no inverse kinematics; the other fields have no meaning then.
    program : WrittenProgram or None
    head : str
        Of ``NAME_ik``, without the semicolon.
    most : int
        The most answers.
    n, rows : int
        How many joint variables there are, and how many numbers are compared.
    free, axes, with_orientation, description : as in `symdh.codegen.inverse.program.Program`
    turning : tuple of int
        1 for an angle, 0 for a slide.
    limits : tuple of (lower, upper)
        As literals; empty where the table gives none.
    reach : str
        The sum of the arm's lengths.
    reads : tuple of (place, name)
        What the branches read first.
    locked_note : str
    kinds : frozenset of str
        The kinds of unknowns that there are.
    used : frozenset of str
        The cosines, sines and slides that anything reads.
    """

    reason: str
    program: WrittenProgram | None = None
    head: str = ""
    most: int = 0
    n: int = 0
    rows: int = 0
    free: tuple[int, ...] = ()
    axes: tuple[int, ...] = ()
    with_orientation: bool = False
    turning: tuple[int, ...] = ()
    limits: tuple[tuple[str, str], ...] = ()
    reach: str = ""
    reads: tuple[tuple[str, str], ...] = ()
    description: str = ""
    locked_note: str = ""
    kinds: frozenset[str] = frozenset()
    used: frozenset[str] = field(default_factory=frozenset)

    @property
    def n_free(self) -> int:
        """How many joint variables are found."""
        return len(self.free)

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
        assert self.program is not None
        last = self.program.statements[-1]
        assert isinstance(last, WrittenProposal)
        return " | ".join(f"{name}.free_joints" for name in last.unknowns)


def c_section(
    robot: Robot,
    known: Mapping[Symbol, Expr],
    functions: Mapping[Op, str],
    stem: str,
    fields: Mapping[Symbol, str],
    facts: Facts,
    locked: tuple[Symbol, ...] = (),
) -> CSection:
    """Write the inverse kinematics of a robot in C.

    Parameters
    ----------
    robot : Robot
    known : mapping of Symbol to Expr
        Numbers that are compiled in.
    functions : mapping of Op to str
    stem : str
        What the names of the arm begin with.
    fields : mapping of Symbol to str
        The fields of the struct of parameters.
    facts : Facts
    locked : tuple of Symbol
        Joint variables that are held at what the seed says.
    """
    program = inverse_program(robot, known, locked)
    if isinstance(program, Missing):
        return CSection(program.reason)
    own = {*_OWN, *functions.values(), *(f"{stem}_ik_{name}" for name in _NAMES), f"{stem}_ik"}
    scope = Scope(lambda name: name in own or is_reserved_in_c(name))
    symbols = scope.take_symbols([*fields, *robot.variables])
    parameters = {symbol: f"p->{name}" for symbol, name in fields.items()}
    written = write_program(program, functions, symbols, scope, parameters, _Printer)
    n, held = len(robot.variables), held_joints(facts, program)
    return CSection(
        reason="",
        program=written,
        head=_head(stem, n, bool(fields)),
        most=program.most_solutions,
        n=n,
        rows=len(program.axes) + 3 * program.with_orientation,
        free=program.free,
        axes=program.axes,
        with_orientation=program.with_orientation,
        turning=tuple(int(turns) for turns in program.turning),
        limits=_limits(facts),
        reach=written.reach,
        reads=_reads(robot, written, fields),
        description=program.description,
        locked_note=f"; so does {held}, which is locked" if held else "",
        kinds=frozenset(s.kind for s in written.statements if isinstance(s, WrittenSolve)),
        used=written.used,
    )


def c_context() -> dict[str, object]:
    """Return what the templates need beside ``ik``: numbers, sentences, and how lines break."""
    return {**NUMBERS, "sentences": SENTENCES, "settle": SETTLE, "wrap": broken, "seed_of": _seed}


def _head(stem: str, n: int, with_parameters: bool) -> str:
    arguments = ["const double T[16]"]
    if with_parameters:
        arguments.append(f"const {stem}_params *p")
    arguments += ["const double *seed", f"double q[{stem}_IK_MAX][{n}]", "unsigned *free_joints"]
    return broken(f"int {stem}_ik({', '.join(arguments)})", 0)


def _seed(seed: tuple[tuple[int, int], ...]) -> str:
    """Write what an unknown is when it is free."""
    text = "".join(f" {'+' if sign > 0 else '-'} found->start[{place}]" for sign, place in seed)
    return text.removeprefix(" + ").strip()


def _limits(facts: Facts) -> tuple[tuple[str, str], ...]:
    if not any(joint.limits for joint in facts.joints):
        return ()
    return tuple(joint.limits or ("-HUGE_VAL", "HUGE_VAL") for joint in facts.joints)


def _reads(
    robot: Robot, written: WrittenProgram, fields: Mapping[Symbol, str]
) -> tuple[tuple[str, str], ...]:
    """Return what the branches read, and what they call it."""
    places = {variable: f"found->start[{k}]" for k, variable in enumerate(robot.variables)}
    places |= {symbol: f"found->p->{name}" for symbol, name in fields.items()}
    read = [(places[symbol], name) for symbol, name in written.reads]
    return (*read, *((f"T[{place}]", name) for name, place in written.goal))
