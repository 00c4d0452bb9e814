"""Rotations one after another, a matrix and a point, from a YAML file or the command line.

units: {angle: deg, length: m}
rotations: [Rx(45) body, Ry(60) body, Rz(90) fixed]
point: [1, 2, 3]
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from symdh.errors import Diagnostic
from symdh.robot import Axis, Units
from symdh.table.amounts import refuse_values
from symdh.table.cells import Cell, CellReader, scalar
from symdh.table.keys import read_keys
from symdh.table.labels import read_title
from symdh.table.lexer import ExpressionError
from symdh.table.nodes import Node, ScalarNode, SequenceNode, parse_nodes
from symdh.table.numbers import read_values
from symdh.table.report import Report
from symdh.table.settings import read_units
from symdh.table.source import START, Source, from_text
from symdh.table.suggest import brief, did_you_mean
from symdh.table.units import ANGLE, LENGTH, NUMBER, Dimension
from symdh.table.uses import dimensions_of_symbols

MAX_ROTATIONS = 50
NO_UNITS = Units()

KEYS = ("title", "units", "rotations", "matrix", "point", "values", "notes")
_KEY_ALIASES = {"steps": "rotations", "rotation": "rotations", "name": "title", "r": "matrix"}

_HEAD = re.compile(r"([^\s(),;]+)[ \t]*(\(?)")
_WORD = re.compile(r"[^\s,;]+")
_GAP = re.compile(r"[ \t,;]*")
_AS_BLANKS = str.maketrans("[]", "  ")
_AXES = {f"R{axis.name.lower()}": axis for axis in Axis}
_ABOUT = {"body": False, "fixed": True}
_ABOUT_ALIASES = {
    **dict.fromkeys(("moving", "own", "current", "new", "local", "intrinsic", "mobile"), "body"),
    **dict.fromkeys(("space", "world", "base", "global", "extrinsic", "original"), "fixed"),
}


@dataclass(frozen=True, slots=True)
class GivenRotation:
    """One rotation as it was typed.

    Attributes
    ----------
    axis : Axis
    angle : sympy.Expr
        Radians.
    fixed : bool
        Whether it is about the fixed axis; else it is about the body's own.
    """

    axis: Axis
    angle: Expr
    fixed: bool


@dataclass(frozen=True, slots=True)
class RotationSheet:
    """What a file or a command line says about rotations.

    Attributes
    ----------
    rotations : tuple of GivenRotation
        In the order in which they happen; empty where a matrix is given.
    matrix : tuple of 9 Expr, or None
        By rows.
    point : tuple of 3 Expr, or None
    units : Units
    values : mapping of Symbol to Expr
    title : str or None
    warnings : tuple of Diagnostic
    """

    rotations: tuple[GivenRotation, ...] = ()
    matrix: tuple[Expr, ...] | None = None
    point: tuple[Expr, ...] | None = None
    units: Units = NO_UNITS
    values: Mapping[Symbol, Expr] = field(default_factory=dict)
    title: str | None = None
    warnings: tuple[Diagnostic, ...] = ()


def read_rotation_sheet(source: Source) -> RotationSheet:
    """Read a YAML file that holds ``rotations`` or a ``matrix``.

    Raises
    ------
    TableError
        With every mistake at its line and column.
    """
    report = Report(source)
    keys = read_keys(parse_nodes(source), KEYS, report, _KEY_ALIASES)
    sections = keys.nodes
    title = read_title(sections["title"], report) if "title" in sections else None
    reader = CellReader(report, read_units(sections.get("units"), report))
    given, cells = _read_rotations(sections.get("rotations"), reader)
    matrix = _read_list(sections.get("matrix"), "matrix", NUMBER, 9, reader)
    point = _read_list(sections.get("point"), "point", LENGTH, 3, reader)
    if "rotations" in sections and "matrix" in sections:
        report.error(sections["matrix"].place(), "give either rotations or a matrix")
    if keys.lack("rotations", "matrix"):
        report.error(START, "rotations is missing: the list of rotations (or a matrix)")
    cells += [*(matrix or ()), *(point or ())]
    uses = dimensions_of_symbols((cell.value, cell.dimension) for cell in cells)
    symbols = {symbol for cell in cells for symbol in cell.names}
    values = read_values(sections.get("values"), symbols, uses, reader)
    refuse_values(cells, values, report)
    reader.warn_of_bare_lengths()
    report.raise_errors()
    return RotationSheet(
        given,
        _amounts(matrix),
        _amounts(point),
        reader.units,
        values,
        title,
        report.diagnostics(),
    )


def parse_rotations(text: str, name: str = "ROTATIONS") -> RotationSheet:
    """Read ``Rx(45 deg) body, Rz(90 deg) fixed``; diagnostics call the text `name`, line 1.

    Raises
    ------
    TableError
        With every mistake at its column.
    """
    node, reader = _line(text, name)
    given, _ = _read_rotations(node, reader)
    reader.report.raise_errors()
    return RotationSheet(given, warnings=reader.report.diagnostics())


def parse_matrix(text: str, name: str = "--matrix") -> tuple[Expr, ...]:
    """Read nine numbers by rows, separated by blanks, commas or semicolons.

    Raises
    ------
    TableError
        With every mistake at its column.
    """
    node, reader = _line(text, name)
    cells = _read_list(node, "matrix", NUMBER, 9, reader)
    reader.report.raise_errors()
    return _amounts(cells) or ()


def _line(text: str, name: str) -> tuple[ScalarNode, CellReader]:
    """Return one line of the command line as the reader of files sees a text."""
    source = from_text(text, name)
    node = ScalarNode(source.text, 1, 1)
    report = Report(source)
    if "\n" in source.text:
        raise source.error(node.place(source.text.index("\n")), "this must stand on one line")
    return node, CellReader(report, NO_UNITS)


def _read_rotations(
    node: Node | None, reader: CellReader
) -> tuple[tuple[GivenRotation, ...], list[Cell]]:
    """Read a list of rotations, or one text with several."""
    if node is None:
        return (), []
    found: list[GivenRotation] = []
    cells: list[Cell] = []
    for item in node.items if isinstance(node, SequenceNode) else (node,):
        text = scalar(item, "a rotation such as Rx(45 deg) body", reader.report)
        if text is None:
            reader.complete = False
            continue
        try:
            for given, cell in _rotations_of(text, reader):
                found.append(given)
                cells.append(cell)
        except ExpressionError as problem:
            reader.report.error(text.place(problem.offset), problem.message)
            reader.complete = False
    if not found and reader.complete:
        message = "there is no rotation here; write them as Rx(45 deg) body, Rz(90 deg) fixed"
        reader.report.error(node.place(), message)
    if len(found) > MAX_ROTATIONS:
        reader.report.error(node.place(), f"{len(found)} rotations, over {MAX_ROTATIONS}")
    return tuple(found), cells


def _rotations_of(node: ScalarNode, reader: CellReader) -> Iterator[tuple[GivenRotation, Cell]]:
    """Read the rotations of one text: each an axis, an angle, and whose axis it is."""
    text = node.text
    offset = _after_gap(text, 0)
    while offset < len(text):
        head = _HEAD.match(text, offset)
        if head is None:
            wanted = "write rotations as Rx(45 deg) body"
            raise ExpressionError(offset, f"unexpected {text[offset]}; {wanted}")
        if head[1] not in _AXES:
            raise ExpressionError(offset, _why_no_rotation(head[1]))
        if not head[2]:
            raise ExpressionError(offset, f"{head[1]} needs its angle in parentheses: {head[1]}(…)")
        end = _closing(text, head.end())
        cell = reader.read_part(node, head.end(), end, ANGLE)
        offset, fixed = _about(text, _after_gap(text, end + 1), text[offset : end + 1])
        if cell is not None:
            yield GivenRotation(_AXES[head[1]], cell.value, fixed), cell
        offset = _after_gap(text, offset)


def _about(text: str, offset: int, rotation: str) -> tuple[int, bool]:
    """Read ``body`` or ``fixed``; return where it ends and whether it was fixed."""
    word = _WORD.match(text, offset)
    if word is None or word[0].startswith(tuple(_AXES)):
        shown = brief(rotation)
        message = f"whose axis is that? write {shown} body (its own) or {shown} fixed"
        raise ExpressionError(offset, message)
    if word[0] not in _ABOUT:
        hint = did_you_mean(word[0], _ABOUT, _ABOUT_ALIASES) or "; write body or fixed"
        raise ExpressionError(offset, f"{brief(word[0])} is neither body nor fixed{hint}")
    return word.end(), _ABOUT[word[0]]


def _why_no_rotation(name: str) -> str:
    right = next((each for each in _AXES if each.lower() == name.lower()), None)
    hint = f"; did you mean {right}?" if right else f"; the rotations are {', '.join(_AXES)}"
    return f"{brief(name)} is not a rotation{hint}"


def _closing(text: str, start: int) -> int:
    """Return the offset of the bracket that closes the one before `start`."""
    depth = 1
    for offset in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[offset], 0)
        if depth == 0:
            return offset
    raise ExpressionError(len(text), "missing )")


def _after_gap(text: str, offset: int) -> int:
    gap = _GAP.match(text, offset)
    return gap.end() if gap else offset


def _read_list(
    node: Node | None, key: str, dimension: Dimension, count: int, reader: CellReader
) -> list[Cell] | None:
    """Read a fixed number of expressions: a list, a list of lists, or one text."""
    if node is None:
        return None
    cells = [
        reader.read_part(text, start, end, dimension)
        for text, start, end in _parts(node, reader.report)
    ]
    complete = [cell for cell in cells if cell is not None]
    if len(cells) != count:
        message = f"a {key} has {count} numbers, and here are {len(cells)}"
        reader.report.error(node.place(), message)
    return complete


def _parts(node: Node, report: Report) -> Iterator[tuple[ScalarNode, int, int]]:
    """Yield the texts of the numbers of a list, of its lists, or of one text."""
    if isinstance(node, SequenceNode):
        for item in node.items:
            if isinstance(item, SequenceNode):
                yield from _parts(item, report)
            else:
                text = scalar(item, "a number", report)
                if text is not None:
                    yield text, 0, len(text.text)
        return
    text = scalar(node, "a list of numbers", report)
    if text is not None:
        yield from ((text, start, end) for start, end in _split(text.text))


def _split(text: str) -> Iterator[tuple[int, int]]:
    """Yield where the numbers of one text start and end.

    They are separated by commas where there is one outside of parentheses, else by blanks; rows
    may be ended by semicolons in both cases, and stand in square brackets as in other languages.
    """
    if text.count("[") == text.count("]"):
        text = text.translate(_AS_BLANKS)
    depths = _depths(text)
    commas = any(c == "," and not depth for c, depth in zip(text, depths, strict=True))
    breaks = ",;" if commas else "; \t"
    start = 0
    for end in range(len(text) + 1):
        if end < len(text) and (depths[end] or text[end] not in breaks):
            continue
        number = text[start:end].strip()
        # Between commas there must be something; several blanks are as good as one.
        if number or (commas and end < len(text) and text[end] == ","):
            first = text.index(number, start)
            yield first, first + len(number)
        start = end + 1


def _depths(text: str) -> list[int]:
    """Return how many brackets enclose each character."""
    depths, depth = [], 0
    for character in text:
        depth = max(depth - (character == ")"), 0)
        depths.append(depth)
        depth += character == "("
    return depths


def _amounts(cells: list[Cell] | None) -> tuple[Expr, ...] | None:
    return None if cells is None else tuple(cell.value for cell in cells)
