"""The functions that every target writes, in the notation of one language.

A target brings a `Language` and lays out what comes back; what its functions compute, how they
name things and what they say about the table is decided here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from sympy import Integer, Symbol

from symdh.codegen.facts import Facts, facts_of
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.jacobian import forward_jacobian_routine, jacobian_routine
from symdh.codegen.listing import Listing, Local, write_listing
from symdh.codegen.names import Scope, comment_text
from symdh.codegen.printer import Printer
from symdh.codegen.routine import Routine
from symdh.robot import Robot

#: The functions, in their order, and what each fills.
_RESULTS = {"fk": ("T",), "jacobian": ("J",), "fk_jacobian": ("T", "J")}
_ROUTINES = {
    "fk": forward_routine,
    "jacobian": jacobian_routine,
    "fk_jacobian": forward_jacobian_routine,
}
_TRIGONOMETRY = (Op.SIN, Op.COS)


@dataclass(frozen=True)
class Language:
    """How a language spells what all of them have.

    Attributes
    ----------
    calls : mapping of Op to str
        What the functions of its mathematics library are called.
    is_reserved : callable
        Says whether a name is the language's own, or that of the generated program.
    element, field : str or None
        How a joint variable and a parameter are read: ``q[{}]``, ``p.{}``. None where they are
        arguments of their own, and need no reading.
    first : int
        What the language counts elements from.
    pair : (str, str) or None
        How sine and cosine of one angle are taken in one call: ``("({sin}, {cos})",
        "sincos({angle})")``. Without it there are two calls.
    unused : str
        What stands in a pair for a sine or cosine that nothing reads.
    printer : type of Printer
    """

    calls: Mapping[Op, str]
    is_reserved: Callable[[str], bool]
    element: str | None = None
    field: str | None = None
    first: int = 0
    pair: tuple[str, str] | None = None
    unused: str = "_"
    printer: type[Printer] = Printer


@dataclass(frozen=True, slots=True)
class Parameter:
    """A length or angle that a caller may give.

    Attributes
    ----------
    name : str
        Its identifier.
    default : str or None
        The table's value as a literal; None where a caller must give one.
    original : str
        What the table calls it.
    """

    name: str
    default: str | None
    original: str


@dataclass(frozen=True)
class Function:
    """A function: its lines and its results.

    Attributes
    ----------
    name : str
        fk, jacobian or fk_jacobian.
    locals : tuple of Local
        What is read from the arguments, then what is computed, in order.
    results : dict of str to rows of str
        Every entry of T (4 x 4) and J (6 x n), zeros and ones included.
    calls : frozenset of Op
        The functions of the mathematics library that it needs.
    unread : tuple of str
        Of q and p, the arguments that it never looks at.
    """

    name: str
    locals: tuple[Local, ...]
    results: Mapping[str, tuple[tuple[str, ...], ...]]
    calls: frozenset[Op]
    unread: tuple[str, ...]


@dataclass(frozen=True)
class Program:
    """All that a target lays out: facts about the table, its symbols, functions.

    Attributes
    ----------
    facts : Facts
    variables : tuple of str
        Identifiers of the joint variables.
    parameters : tuple of Parameter
    functions : tuple of Function
        fk, jacobian, fk_jacobian.
    """

    facts: Facts
    variables: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    functions: tuple[Function, ...]

    @property
    def required(self) -> tuple[Parameter, ...]:
        """The parameters that the table gives no value."""
        return tuple(parameter for parameter in self.parameters if parameter.default is None)


def write_program(robot: Robot, language: Language) -> Program:
    """Write the functions of a robot in one language; its parameters stay open.

    Raises
    ------
    UnsupportedError
        When the table holds something that has no code.
    """
    names = _symbol_names(Scope(language.is_reserved), robot)
    write = language.printer(language.calls, {})
    parameters = tuple(
        Parameter(
            name=names[symbol],
            default=write.number(robot.values[symbol]) if symbol in robot.values else None,
            original=comment_text(symbol.name),
        )
        for symbol in robot.parameters
    )
    functions = tuple(
        _write_function(robot, language, name, routine(robot, splits_sums=True))
        for name, routine in _ROUTINES.items()
    )
    variables = tuple(names[symbol] for symbol in robot.variables)
    return Program(facts_of(robot), variables, parameters, functions)


def required_values(program: Program, values: Mapping[Symbol, float]) -> list[tuple[str, str]]:
    """Return name and literal of each parameter without a default, given numbers in their order."""
    names = [parameter.name for parameter in program.required]
    return list(zip(names, map(repr, values.values()), strict=True))


def _symbol_names(scope: Scope, robot: Robot) -> dict[Symbol, str]:
    """Name the symbols; a fresh scope gives each the same name in every function."""
    return scope.take_symbols([*robot.parameters, *robot.variables])


def _write_function(robot: Robot, language: Language, name: str, routine: Routine) -> Function:
    scope = Scope(language.is_reserved)
    names = _symbol_names(scope, robot)
    listing = write_listing(routine, language.calls, names, scope, language.printer)
    read = {"q": robot.variables, "p": robot.parameters if language.field else ()}
    return Function(
        name=name,
        locals=(*_reads(robot, language, listing, names), *_computed(routine, listing, language)),
        results={matrix: _rows(robot, language, listing, matrix) for matrix in _RESULTS[name]},
        calls=frozenset(routine.op_counts()) & frozenset(language.calls),
        unread=tuple(
            argument
            for argument, symbols in read.items()
            if not listing.inputs.intersection(symbols)
        ),
    )


def _reads(
    robot: Robot, language: Language, listing: Listing, names: Mapping[Symbol, str]
) -> Iterator[Local]:
    if language.element is not None:
        for place, variable in enumerate(robot.variables, language.first):
            if variable in listing.inputs:
                yield Local(names[variable], language.element.format(place))
    if language.field is not None:
        for parameter in robot.parameters:
            if parameter in listing.inputs:
                yield Local(names[parameter], language.field.format(names[parameter]))


def _computed(routine: Routine, listing: Listing, language: Language) -> Iterator[Local]:
    """Return the lines of a routine, sine and cosine of one angle in one where there is a pair."""
    if language.pair is None:
        yield from listing.locals
        return
    target, call = language.pair
    paired: dict[int, dict[Op, str]] = {}
    for assignment, local in zip(routine.assignments, listing.locals, strict=True):
        node = assignment.node
        if node.op in _TRIGONOMETRY:
            paired.setdefault(node.args[0].index, {})[node.op] = local.name
    for assignment, local in zip(routine.assignments, listing.locals, strict=True):
        node = assignment.node
        if node.op not in _TRIGONOMETRY:
            yield local
            continue
        pair = paired.pop(node.args[0].index, None)
        if pair is not None:
            sine, cosine = (pair.get(op, language.unused) for op in _TRIGONOMETRY)
            angle = local.text.partition("(")[2].removesuffix(")")
            yield Local(target.format(sin=sine, cos=cosine), call.format(angle=angle))


def _rows(
    robot: Robot, language: Language, listing: Listing, matrix: str
) -> tuple[tuple[str, ...], ...]:
    """Return the entries of a result; a pose ends in 0 0 0 1."""
    write = language.printer(language.calls, {})
    height, width = (4, 4) if matrix == "T" else (6, len(robot.variables))
    rows = [[write.number(Integer(0))] * width for _ in range(height)]
    if matrix == "T":
        rows[3][3] = write.number(Integer(1))
    for entry in listing.entries:
        if entry.matrix == matrix:
            rows[entry.row][entry.column] = entry.text
    return tuple(map(tuple, rows))
