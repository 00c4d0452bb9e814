"""Joint axes in YAML -> a mechanism, with the place of everything that can be wrong.

name: arm
convention: standard
joints:
  - {variable: theta1, point: [0, 0, 0], direction: [0, 0, 1]}
  - {variable: theta2, point: [a1, 0, 0], direction: [0, 0, 1]}
tool: {point: [a1 + a2, 0, 0], approach: [0, 0, 1], sliding: [0, 1, 0]}

In place of points and directions the frames themselves may be given: ``matrices``, a list of
poses by rows.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from sympy import Expr, Integer, Symbol

from symdh.errors import Diagnostic, Severity, TableError
from symdh.mechanism import (
    TOLERANCE,
    ZERO,
    FrameChoice,
    JointAxis,
    Last,
    Mechanism,
    Pose,
    ToolFrame,
    Vector,
)
from symdh.robot import JointType, Units
from symdh.table.amounts import refuse_values
from symdh.table.cells import Cell, CellReader, scalar
from symdh.table.joint_type import TYPES
from symdh.table.keys import Keys, read_keys
from symdh.table.labels import default_name, read_name, read_title
from symdh.table.names import CONSTANT, canonical_name, why_reserved
from symdh.table.nodes import MappingNode, Node, ScalarNode, SequenceNode, parse_nodes
from symdh.table.numbers import read_limits, read_values
from symdh.table.report import Report
from symdh.table.settings import read_convention, read_units
from symdh.table.source import START, Place, Source
from symdh.table.suggest import brief, did_you_mean
from symdh.table.units import ANGLE, LENGTH, NUMBER, Dimension
from symdh.table.uses import dimensions_of_symbols

MAX_JOINTS = 50
MAX_TOLERANCE = Integer(1) / 100

_T = TypeVar("_T")

KEYS = (
    *("name", "title", "convention", "units", "joints", "tool", "frames", "last", "tolerance"),
    *("matrices", "values", "limits", "notes"),
)
JOINT_KEYS = ("type", "variable", "point", "direction", "home", "z", "notes")
TOOL_KEYS = ("point", "approach", "sliding", "normal")
FRAME_KEYS = ("x", "origin")
_ALIASES = {"axes": "joints", "q": "variable", "axis": "direction", "position": "point"}
_REVERSE = "reverse"
_LOCATION = ("point", "direction")
_NOWHERE: Vector = (ZERO, ZERO, ZERO)
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_TYPES = {name: kind for name, kind in TYPES.items() if kind is not JointType.FIXED}

#: A part of the file by the name that `symdh.frames` gives it: ``("joint", 2, "direction")``.
Places = Mapping[tuple[str | int, ...], Place]


@dataclass(frozen=True)
class LoadedMechanism:
    """A mechanism that could be read.

    Attributes
    ----------
    mechanism : Mechanism
    warnings : tuple of Diagnostic
    """

    mechanism: Mechanism
    warnings: tuple[Diagnostic, ...]
    source: Source
    places: Places

    def warning(self, subject: tuple[str | int, ...], message: str) -> Diagnostic:
        """Return a warning about a part of the mechanism at its place in the file."""
        return replace(self.diagnostic(subject, message), severity=Severity.WARNING)

    def diagnostic(self, subject: tuple[str | int, ...], message: str) -> Diagnostic:
        """Return an error about a part of the mechanism at its place in the file."""
        while subject and subject not in self.places:
            subject = subject[:-1]
        return self.source.diagnostic(self.places.get(subject, START), message)


def read_mechanism(source: Source) -> LoadedMechanism:
    """Read a file of joint axes.

    Raises
    ------
    TableError
        With every mistake at its line and column.
    """
    return _Reader(source).read()


class _Reader:
    """Reads one file; `places` remembers where the parts stand."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.report = Report(source)
        self.places: dict[tuple[str | int, ...], Place] = {}
        self.cells: list[Cell] = []
        self.reader = CellReader(self.report, Units())

    def read(self) -> LoadedMechanism:
        keys = self._mapping(parse_nodes(self.source), KEYS, "the file")
        sections = keys.nodes
        report = self.report
        self.reader = CellReader(report, read_units(sections.get("units"), report))
        convention = (
            read_convention(sections["convention"], report) if "convention" in sections else None
        )
        name = read_name(sections["name"], report) if "name" in sections else None
        title = read_title(sections["title"], report) if "title" in sections else None
        matrices = sections.get("matrices")
        poses = self._matrices(matrices)
        if matrices is None:
            axes = self._joints(keys)
        else:
            # Counted as they stand in the file: a frame with an error still has its joint.
            written = len(matrices.items) if isinstance(matrices, SequenceNode) else 1
            axes = self._given_joints(written - 1, sections.get("joints"))
        tool = self._tool(sections.get("tool"))
        choices = self._frames(sections.get("frames"), len(axes))
        last = self._last(sections.get("last"))
        tolerance = self._tolerance(sections.get("tolerance"))
        self._refuse_variables_elsewhere(axes)
        uses = dimensions_of_symbols((cell.value, cell.dimension) for cell in self.cells)
        kinds = {axis.variable: _dimension(axis.type) for axis in axes}
        uses |= {variable: {kind} for variable, kind in kinds.items()}
        symbols = {symbol for cell in self.cells for symbol in cell.names} | set(kinds)
        values = read_values(sections.get("values"), symbols, uses, self.reader)
        refuse_values(self.cells, values, report)
        limits = read_limits(sections.get("limits"), kinds, self.reader)
        self.reader.warn_of_bare_lengths()
        report.raise_errors()
        mechanism = Mechanism(
            name=name or default_name(self.source.filename),
            axes=tuple(axes),
            tool=tool,
            choices=choices,
            last=last,
            tolerance=tolerance,
            convention=convention,
            poses=tuple(poses),
            values=values,
            limits=limits,
            title=title,
            units=self.reader.units,
        )
        return LoadedMechanism(mechanism, report.diagnostics(), self.source, self.places)

    def _mapping(self, node: Node, known: Collection[str], where: str) -> Keys:
        if isinstance(node, MappingNode):
            return read_keys(node, known, self.report, _ALIASES, f" in {where}")
        self.report.error(node.place(), f"{where} must be a mapping of keys")
        return Keys({}, frozenset(known))  # nothing more is said about keys

    def _matrices(self, node: Node | None) -> list[Pose]:
        """Read frames L_0 .. L_n, each as three or four rows of four numbers."""
        if node is None:
            return []
        if not isinstance(node, SequenceNode) or len(node.items) < 2:
            self.report.error(node.place(), "matrices must be a list of two frames or more")
            return []
        poses = []
        for number, item in enumerate(node.items):
            self.places["matrix", number] = item.place()
            pose = self._pose(number, item)
            if pose is not None:
                poses.append(pose)
        return poses

    def _pose(self, number: int, node: Node) -> Pose | None:
        rows = (
            [row for row in node.items if isinstance(row, SequenceNode)]
            if (isinstance(node, SequenceNode))
            else []
        )
        if [len(row.items) for row in rows] not in ([4] * 3, [4] * 4):
            self.report.error(node.place(), f"frame {number} needs three rows of four numbers")
            return None
        cells = [
            self._cell(item, LENGTH if k == 3 else NUMBER)
            for row in rows[:3]
            for k, item in enumerate(row.items)
        ]
        values = [cell.value for cell in cells if cell is not None]
        if len(values) != 12:
            return None
        bottom = [self._cell(item, NUMBER) for row in rows[3:] for item in row.items]
        if bottom and [cell and cell.value for cell in bottom] != [0, 0, 0, 1]:
            self.report.error(rows[3].place(), "the last row of a pose is [0, 0, 0, 1]")
            return None
        x, y, z, origin = ((values[k], values[k + 4], values[k + 8]) for k in range(4))
        return x, y, z, origin

    def _given_joints(self, count: int, node: Node | None) -> list[JointAxis]:
        """Read the joints between given frames: what they do, not where they are."""
        if node is None:
            names = (Symbol(f"theta{k}", real=True) for k in range(1, count + 1))
            return [JointAxis(JointType.REVOLUTE, _NOWHERE, _NOWHERE, name) for name in names]
        if not isinstance(node, SequenceNode) or len(node.items) != count:
            self.report.error(node.place(), f"{count + 1} frames need {count} joints")
            return []
        axes: list[JointAxis] = []
        for number, item in enumerate(node.items, start=1):
            axis = self._joint(number, item, axes, located=False)
            if axis is not None:
                axes.append(axis)
        return axes

    def _joints(self, keys: Keys) -> list[JointAxis]:
        node = keys.nodes.get("joints")
        if node is None:
            if keys.lack("joints"):
                self.report.error(START, "joints is missing: the list of joint axes")
            return []
        if not isinstance(node, SequenceNode) or not node.items:
            self.report.error(node.place(), "joints must be a list of axes, each starting with -")
            return []
        if len(node.items) > MAX_JOINTS:
            place = node.items[MAX_JOINTS].place()
            self.report.error(place, f"joints has {len(node.items)} entries, over {MAX_JOINTS}")
            return []
        axes: list[JointAxis] = []
        for number, item in enumerate(node.items, start=1):
            axis = self._joint(number, item, axes)
            if axis is not None:
                axes.append(axis)
        return axes

    def _joint(
        self, number: int, node: Node, before: Sequence[JointAxis], located: bool = True
    ) -> JointAxis | None:
        self.places["joint", number] = node.place()
        if not isinstance(node, MappingNode):
            self.report.error(node.place(), f"joint {number} must be a mapping: {{point: ...}}")
            return None
        known = JOINT_KEYS if located else [k for k in JOINT_KEYS if k not in _LOCATION]
        found = self._mapping(node, known, f"joint {number}")
        keys = found.nodes
        for key in _LOCATION if located else ():
            if key in keys:
                self.places["joint", number, key] = keys[key].place()
            elif found.lack(key):
                self.report.error(node.place(), f"missing key {key} in joint {number}")
        kind = self._word(keys.get("type"), "type of joint", _TYPES, JointType.REVOLUTE)
        variable = self._variable(number, kind, keys.get("variable"), before)
        point: Vector | None = _NOWHERE
        direction: Vector | None = _NOWHERE
        if located:
            point = self._vector(keys.get("point"), LENGTH, "point")
            direction = self._vector(keys.get("direction"), NUMBER, "direction")
        home = self._cell(keys.get("home"), _dimension(kind))
        backwards = self._word(keys.get("z"), "value of z", {"along": False, _REVERSE: True}, False)
        if point is None or direction is None or variable is None:
            return None
        value = ZERO if home is None else home.value
        return JointAxis(kind, point, direction, variable, home=value, reverse=backwards)

    def _variable(
        self, number: int, kind: JointType, node: Node | None, before: Sequence[JointAxis]
    ) -> Symbol | None:
        letter = "theta" if kind is JointType.REVOLUTE else "d"
        if node is None:
            return Symbol(f"{letter}{number}", real=True)
        text = scalar(node, "the name of a symbol", self.report)
        if text is None:
            return None
        name = canonical_name(text.text.strip())
        reason = why_reserved(name)
        if reason is None and (name == CONSTANT or not _NAME.fullmatch(name)):
            reason = f"{brief(text.text)} is not the name of a symbol"
        symbol = Symbol(name, real=True)
        if reason is None and any(axis.variable == symbol for axis in before):
            reason = f"{name} already drives another joint"
        if reason is not None:
            self.report.error(text.place(), reason)
            return None
        return symbol

    def _tool(self, node: Node | None) -> ToolFrame | None:
        if node is None:
            return None
        self.places["tool",] = node.place()
        written = self._mapping(node, TOOL_KEYS, "tool")
        keys = written.nodes
        for key, value in keys.items():
            self.places["tool", key] = value.place()
        if written.lack("point"):
            self.report.error(node.place(), "missing key point in tool")
        point = self._vector(keys.get("point"), LENGTH, "point")
        found = {
            key: self._vector(keys.get(key), NUMBER, key) for key in TOOL_KEYS if key != "point"
        }
        given = [key for key in found if key in keys]
        if len(given) == 1:
            message = f"{given[0]} alone does not say how the tool is turned; give another of "
            others = " or ".join(key for key in found if key not in given)
            self.report.error(keys[given[0]].place(), message + others)
        if len(given) == 3:
            message = "two of approach, sliding and normal say it all; leave normal out"
            self.report.error(keys["normal"].place(), message)
        if point is None:
            return None
        return ToolFrame(point, *_approach_and_sliding(found))

    def _frames(self, node: Node | None, n: int) -> dict[int, FrameChoice]:
        if node is None:
            return {}
        numbers = [str(i) for i in range(n + 1)]
        entries = self._mapping(node, numbers, "frames").nodes
        return {int(key): self._frame(int(key), value) for key, value in entries.items()}

    def _frame(self, number: int, node: Node) -> FrameChoice:
        self.places["frame", number] = node.place()
        keys = self._mapping(node, FRAME_KEYS, f"frame {number}").nodes
        for key, value in keys.items():
            self.places["frame", number, key] = value.place()
        origin = self._vector(keys.get("origin"), LENGTH, "origin")
        x = keys.get("x")
        if isinstance(x, ScalarNode) and x.text.strip() == _REVERSE:
            return FrameChoice(reverse_x=True, origin=origin)
        if isinstance(x, ScalarNode):
            self.report.error(x.place(), "x is a direction [0, 1, 0], or reverse")
            return FrameChoice()
        return FrameChoice(x=self._vector(x, NUMBER, "x"), origin=origin)

    def _last(self, node: Node | None) -> Last:
        return self._word(node, "place of the last frame", {e.value: e for e in Last}, Last.TOOL)

    def _tolerance(self, node: Node | None) -> Expr:
        if node is None:
            return TOLERANCE
        cell = self.reader.read(node, NUMBER)
        if cell is None:
            return TOLERANCE
        if not cell.value.is_Rational or not 0 <= cell.value <= MAX_TOLERANCE:
            self.report.error(cell.place, f"tolerance is a number from 0 to {MAX_TOLERANCE}")
            return TOLERANCE
        return cell.value

    def _vector(self, node: Node | None, dimension: Dimension, what: str) -> Vector | None:
        if node is None:
            return None
        if not isinstance(node, SequenceNode) or len(node.items) != 3:
            self.report.error(node.place(), f"{what} is a list of three: [x, y, z]")
            return None
        cells = [self._cell(item, dimension) for item in node.items]
        x, y, z = (None if cell is None else cell.value for cell in cells)
        return None if x is None or y is None or z is None else (x, y, z)

    def _cell(self, node: Node | None, dimension: Dimension) -> Cell | None:
        if node is None:
            return None
        cell = self.reader.read(node, dimension)
        if cell is not None:
            self.cells.append(cell)
        return cell

    def _word(self, node: Node | None, what: str, known: Mapping[str, _T], default: _T) -> _T:
        text = None if node is None else scalar(node, f"a {what}", self.report)
        if text is None:
            return default
        word = text.text.strip().lower()
        if word not in known:
            hint = did_you_mean(word, known) or f"; use {' or '.join(known)}"
            self.report.error(text.place(), f"{what} {brief(word)} unknown{hint}")
        return known.get(word, default)

    def _refuse_variables_elsewhere(self, axes: Sequence[JointAxis]) -> None:
        """Note every joint variable that stands in a point, a direction or a home value."""
        variables = {axis.variable for axis in axes}
        for cell in self.cells:
            for symbol, place in cell.names.items():
                if symbol in variables:
                    message = f"{symbol} moves a joint; the axes are given in the home position"
                    self.report.error(place, message)


def _dimension(kind: JointType) -> Dimension:
    return LENGTH if kind is JointType.PRISMATIC else ANGLE


def _approach_and_sliding(
    found: Mapping[str, Vector | None],
) -> tuple[Vector | None, Vector | None]:
    """Return both vectors, one of them from the normal vector where that is given instead."""
    approach, sliding, normal = found["approach"], found["sliding"], found["normal"]
    if normal is not None and approach is not None:
        return approach, _cross(approach, normal)
    if normal is not None and sliding is not None:
        return _cross(normal, sliding), sliding
    return approach, sliding


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def located(
    loaded: LoadedMechanism, faults: Sequence[tuple[tuple[str | int, ...], str]]
) -> TableError:
    """Return faults that were found later as an error with their places."""
    found = [loaded.diagnostic(subject, message) for subject, message in faults]
    return TableError(sorted(found, key=lambda each: (each.line, each.column)))
