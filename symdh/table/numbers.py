"""The known numbers of a table: values of its symbols, and limits of its joints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from sympy import Expr, Symbol

from symdh.robot import Limits
from symdh.table.cells import Cell, CellReader
from symdh.table.names import canonical_name
from symdh.table.nodes import MappingNode, Node, ScalarNode, SequenceNode
from symdh.table.suggest import brief, did_you_mean_symbol
from symdh.table.units import Dimension

Uses = Mapping[Symbol, set[Dimension]]


def read_values(
    node: Node | None, symbols: set[Symbol], uses: Uses, reader: CellReader
) -> dict[Symbol, Expr]:
    """Read ``values``: an exact number for each symbol, in what the symbol measures.

    Parameters
    ----------
    node : Node or None
    symbols : set of Symbol
        Those that stand in the table.
    uses : mapping of Symbol to set of Dimension
        What they measure there; see `dimensions_of_symbols`.
    reader : CellReader
    """
    values = {}
    for symbol, key, value in _entries("values", node, symbols, reader):
        measured = uses.get(symbol, set())
        if len(measured) > 1:
            message = f"{symbol} is used as an angle and as a length; no one value can be both"
            reader.report.error(key.place(), message)
            continue
        number = _read_number(value, next(iter(measured), None), reader)
        if number is not None:
            values[symbol] = number.value
    return values


def read_limits(
    node: Node | None, variables: Mapping[Symbol, Dimension], reader: CellReader
) -> dict[Symbol, Limits]:
    """Read ``limits``: the lower and the upper bound of joint variables."""
    limits = {}
    for symbol, _, value in _entries("limits", node, set(variables), reader):
        bounds = _read_bounds(value, variables[symbol], reader)
        if bounds is not None:
            limits[symbol] = bounds
    return limits


def _read_bounds(node: Node, dimension: Dimension, reader: CellReader) -> Limits | None:
    if not isinstance(node, SequenceNode) or len(node.items) != 2:
        reader.report.error(node.place(), "limits are a list of two numbers: [lower, upper]")
        return None
    lower, upper = (_read_number(item, dimension, reader) for item in node.items)
    if lower is None or upper is None:
        return None
    if (lower.value - upper.value).is_positive:
        reader.report.error(node.place(), "lower limit is above upper limit")
    return Limits(lower.value, upper.value)


def _read_number(node: Node, dimension: Dimension | None, reader: CellReader) -> Cell | None:
    cell = reader.read(node, dimension)
    if cell is None:
        return None
    for symbol, place in cell.names.items():
        reader.report.error(place, f"a number is wanted here, and {symbol} is a name")
        return None
    return cell


def _entries(
    section: str, node: Node | None, known: set[Symbol], reader: CellReader
) -> Iterator[tuple[Symbol, ScalarNode, Node]]:
    """Yield the symbols of a section with their keys and values, and note what is wrong."""
    if node is None or (isinstance(node, ScalarNode) and not node.text):
        return
    if not isinstance(node, MappingNode):
        message = f"{section} must be a mapping of names, such as {{{_EXAMPLES[section]}}}"
        reader.report.error(node.place(), message)
        return
    seen: set[Symbol] = set()
    for key, value in node.items:
        symbol = Symbol(canonical_name(key.text.strip()), real=True)
        if symbol in seen:
            reader.report.error(key.place(), f"{brief(key.text)} is given twice; both are {symbol}")
        elif symbol in known:
            seen.add(symbol)
            yield symbol, key, value
        elif reader.complete:
            reader.report.error(key.place(), _why_unknown(section, key.text, symbol, known))


_EXAMPLES = {"values": "a1: 0.4 m", "limits": "theta1: [-90 deg, 90 deg]"}
_KNOWN_AS = {"values": "is not in the table", "limits": "is not a joint variable"}


def _why_unknown(section: str, written: str, symbol: Symbol, known: set[Symbol]) -> str:
    hint = did_you_mean_symbol(symbol.name, sorted(name.name for name in known))
    return f"{brief(written)} {_KNOWN_AS[section]}{hint}"
