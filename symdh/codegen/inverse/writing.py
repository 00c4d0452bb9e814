"""A program of branches written with the names and functions of one language."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.graph import Node, Op
from symdh.codegen.inverse.program import Compute, Option, Program, Propose, Solve
from symdh.codegen.listing import Local
from symdh.codegen.names import Scope
from symdh.codegen.printer import Printer
from symdh.codegen.routine import reachable

#: Makes a printer of the names of functions and of nodes.
MakePrinter = Callable[[Mapping[Op, str], Mapping[Node, str]], Printer]


@dataclass(frozen=True, slots=True)
class WrittenCompute:
    """Locals to be set; `kind` is ``compute``."""

    depth: int
    locals: tuple[Local, ...]
    kind: str = "compute"


@dataclass(frozen=True, slots=True)
class WrittenOption:
    """What an option needs, and the texts of its coefficients and scales, in that order."""

    locals: tuple[Local, ...]
    arguments: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class WrittenSolve:
    """An unknown to be solved for.

    Attributes
    ----------
    depth : int
    kind : str
        The value of a `program.Kind`.
    name : str
        For a comment.
    unknown, index, free : str
        Names for the unknown itself, the number of one of its values, and the bit that says that
        the value is free.
    options : tuple of WrittenOption
    results : tuple of str
        Names for cosine and sine, or for the slide.
    is_angle : bool
    seed : tuple of (sign, place)
    place : int
    opens : bool
    """

    depth: int
    kind: str
    name: str
    unknown: str
    index: str
    free: str
    options: tuple[WrittenOption, ...]
    results: tuple[str, ...]
    is_angle: bool
    seed: tuple[tuple[int, int], ...]
    place: int
    opens: bool


@dataclass(frozen=True, slots=True)
class WrittenProposal:
    """Texts of the joint variables; names of the unknowns, and of the bits that say free."""

    depth: int
    values: tuple[str, ...]
    unknowns: tuple[str, ...]
    free: tuple[str, ...]
    kind: str = "propose"


Written = WrittenCompute | WrittenSolve | WrittenProposal


@dataclass(frozen=True)
class WrittenProgram:
    """A program in one language.

    Attributes
    ----------
    goal : tuple of (name, place)
        Entries of the goal that are read, by their place in row order.
    reads : tuple of (Symbol, name)
        Parameters and locked joint variables that are read.
    statements : tuple of Written
    used : frozenset of str
        The names of cosines, sines and slides that anything reads.
    reach : str
        The sum of the arm's lengths, parameters under their names.
    """

    goal: tuple[tuple[str, int], ...]
    reads: tuple[tuple[Symbol, str], ...]
    statements: tuple[Written, ...]
    used: frozenset[str]
    reach: str


def write_program(
    program: Program,
    functions: Mapping[Op, str],
    symbols: Mapping[Symbol, str],
    scope: Scope,
    parameters: Mapping[Symbol, str] | None = None,
    printer: MakePrinter = Printer,
) -> WrittenProgram:
    """Write a program in one language.

    Parameters
    ----------
    program : Program
    functions : mapping of Op to str
        What the language calls the functions of its mathematics library.
    symbols : mapping of Symbol to str
        Identifiers of joint variables and parameters.
    scope : Scope
        Where the locals live; it has given out those identifiers.
    parameters : mapping of Symbol to str, optional
        What parameters are called where the reach is computed, if not by their identifiers.
    printer : callable
        Makes what writes the language's expressions of functions and names, as `Printer` does.
    """
    return _Writing(program, functions, symbols, scope, printer).written(parameters or symbols)


class _Writing:
    def __init__(
        self,
        program: Program,
        functions: Mapping[Op, str],
        symbols: Mapping[Symbol, str],
        scope: Scope,
        printer: MakePrinter,
    ) -> None:
        self._program, self._functions, self._printing = program, functions, printer
        self._symbols, self._scope = symbols, scope
        self._names: dict[Node, str] = {}
        self._unknowns: list[tuple[str, str]] = []

    def written(self, parameters: Mapping[Symbol, str]) -> WrittenProgram:
        program = self._program
        read = _leaves(program)
        goal = []
        for place, node in enumerate(program.goal):
            if node in read:
                self._names[node] = self._scope.take(node.exact.name)
                goal.append((self._names[node], place))
        found = {node.exact: node for node in read if node.exact in self._symbols}
        self._names |= {node: self._symbols[symbol] for symbol, node in found.items()}
        reads = tuple((s, name) for s, name in self._symbols.items() if s in found)
        statements = tuple(self._statements())
        used = frozenset(self._names[node] for node in read)
        return WrittenProgram(tuple(goal), reads, statements, used, self._reach(parameters))

    def _reach(self, parameters: Mapping[Symbol, str]) -> str:
        node = self._program.reach
        names = {n: parameters[n.exact] for n in reachable([node]) if n.op is Op.SYMBOL}
        return self._printer(names).expression(node)

    def _statements(self) -> Iterator[Written]:
        for statement in self._program.statements:
            match statement:
                case Compute():
                    yield WrittenCompute(statement.depth, self._locals(statement, self._names))
                case Solve():
                    yield self._solve(statement)
                case Propose():
                    printer = self._printer(self._names)
                    values = tuple(printer.expression(node) for node in statement.values)
                    unknowns, free = zip(*self._unknowns, strict=True)
                    yield WrittenProposal(statement.depth, values, unknowns, free)

    def _solve(self, solve: Solve) -> WrittenSolve:
        options = tuple(self._option(option) for option in solve.options)
        unknown, index, free = (
            self._scope.take(f"{prefix}{solve.label}") for prefix in ("x", "k", "free")
        )
        self._unknowns.append((unknown, free))
        for node in solve.results:
            self._names[node] = self._scope.take(node.exact.name)
        return WrittenSolve(
            solve.depth,
            solve.kind.value,
            solve.name,
            unknown,
            index,
            free,
            options,
            tuple(self._names[node] for node in solve.results),
            len(solve.results) == 2,
            solve.seed,
            solve.place,
            solve.opens,
        )

    def _option(self, option: Option) -> WrittenOption:
        names = dict(self._names)
        own = self._locals(option, names)
        printer = self._printer(names)
        nodes = (*option.coefficients, *option.scales)
        return WrittenOption(own, tuple(printer.expression(node) for node in nodes))

    def _locals(self, where: Compute | Option, names: dict[Node, str]) -> tuple[Local, ...]:
        """Write assignments; their names are added to `names`."""
        found = []
        for assignment in where.assignments:
            text = self._printer(names).definition(assignment.node)
            names[assignment.node] = self._scope.take(assignment.name)
            found.append(Local(names[assignment.node], text))
        return tuple(found)

    def _printer(self, names: Mapping[Node, str]) -> Printer:
        return self._printing(self._functions, names)


def roots_of(program: Program) -> list[Node]:
    """Return what the statements of a program compute."""
    roots: list[Node] = []
    for statement in program.statements:
        match statement:
            case Compute():
                roots += [assignment.node for assignment in statement.assignments]
            case Solve():
                for option in statement.options:
                    roots += [*option.coefficients, *option.scales]
            case Propose():
                roots += statement.values
    return roots


def _leaves(program: Program) -> set[Node]:
    """Return the symbols that the statements of a program read."""
    return {node for node in reachable(roots_of(program)) if node.op is Op.SYMBOL}
