"""A routine written out in one language: the lines that its templates lay out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.graph import Node, Op
from symdh.codegen.names import Scope
from symdh.codegen.printer import Printer
from symdh.codegen.routine import Routine


@dataclass(frozen=True, slots=True)
class Local:
    """A local variable and the text that it is set to."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class Entry:
    """An entry of a matrix, by row and column from 0, and the text that it is set to."""

    matrix: str
    row: int
    column: int
    text: str


@dataclass(frozen=True)
class Listing:
    """The lines of a routine.

    Attributes
    ----------
    inputs : frozenset of Symbol
        The symbols that are read at all; a language may warn of reading others.
    locals : tuple of Local
    entries : tuple of Entry
    """

    inputs: frozenset[Symbol]
    locals: tuple[Local, ...]
    entries: tuple[Entry, ...]


def write_listing(
    routine: Routine,
    functions: Mapping[Op, str],
    symbols: Mapping[Symbol, str],
    scope: Scope,
    printer: type[Printer] = Printer,
) -> Listing:
    """Write a routine in one language.

    Parameters
    ----------
    routine : Routine
    functions : mapping of Op to str
        What the language calls the functions of its mathematics library.
    symbols : mapping of Symbol to str
        Identifiers of the joint variables and parameters.
    scope : Scope
        Where the locals live; it has given out those identifiers.
    printer : type of Printer
        How the language writes expressions.
    """
    names: dict[Node, str] = {node: symbols[node.exact] for node in routine.inputs}
    for assignment in routine.assignments:
        names[assignment.node] = scope.take(assignment.name)
    write = printer(functions, names)
    return Listing(
        inputs=frozenset(node.exact for node in routine.inputs),
        locals=tuple(Local(names[a.node], write.definition(a.node)) for a in routine.assignments),
        entries=tuple(
            Entry(o.matrix, o.row, o.column, write.expression(o.node)) for o in routine.outputs
        ),
    )
