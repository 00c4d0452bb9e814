"""Words of elementary motions, as in ``tool: [Tx(a4), Rz(90 deg)]``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from symdh.robot import Axis, Motion, MotionKind
from symdh.table.cells import Cell, CellReader, scalar
from symdh.table.lexer import ExpressionError
from symdh.table.nodes import Node, ScalarNode, SequenceNode
from symdh.table.suggest import brief
from symdh.table.units import ANGLE, LENGTH

MAX_MOTIONS = 50

_HEAD = re.compile(r"([^\s(),]+)[ \t]*(\(?)")
_GAP = re.compile(r"[ \t,]*")
_KINDS = {"R": (MotionKind.ROTATION, ANGLE), "T": (MotionKind.TRANSLATION, LENGTH)}
_MOTIONS = {f"{kind}{axis.name.lower()}": (kind, axis) for kind in _KINDS for axis in Axis}


@dataclass(frozen=True, slots=True)
class PlacedMotion:
    """An elementary motion and the cell of its amount."""

    motion: Motion
    cell: Cell


@dataclass(frozen=True, slots=True)
class _Letter:
    """The text of one motion, ``Tx(a4)``: its name, and where its amount starts and ends."""

    name: str
    offset: int
    start: int
    end: int


def read_word(key: str, node: Node, reader: CellReader) -> list[PlacedMotion]:
    """Read the word under the key `key`: a list of motions, or one text with several."""
    nodes = node.items if isinstance(node, SequenceNode) else (node,)
    motions: list[PlacedMotion] = []
    for item in nodes:
        text = scalar(item, "a motion such as Tx(a4)", reader.report)
        if text is None:
            reader.complete = False
        else:
            motions.extend(_read_text(text, reader))
    if len(motions) > MAX_MOTIONS:
        reader.report.error(node.place(), f"{key} has {len(motions)} motions, over {MAX_MOTIONS}")
    return motions


def _read_text(node: ScalarNode, reader: CellReader) -> Iterator[PlacedMotion]:
    try:
        for letter in _letters(node.text):
            kind_name, axis = _MOTIONS[letter.name]
            kind, dimension = _KINDS[kind_name]
            cell = reader.read_part(node, letter.start, letter.end, dimension)
            if cell is not None:
                yield PlacedMotion(Motion(kind, axis, cell.value), cell)
    except ExpressionError as problem:
        reader.report.error(node.place(problem.offset), problem.message)
        reader.complete = False


def _letters(text: str) -> Iterator[_Letter]:
    """Split ``Rz(90 deg) Tx(a1)`` into its motions."""
    offset = _after_gap(text, 0)
    while offset < len(text):
        head = _HEAD.match(text, offset)
        if head is None:
            raise ExpressionError(offset, f"unexpected {text[offset]}; write motions as Tx(a4)")
        if head[1] not in _MOTIONS:
            raise ExpressionError(offset, _why_no_motion(head[1]))
        if not head[2]:
            raise ExpressionError(
                offset, f"{head[1]} needs its amount in parentheses: {head[1]}(…)"
            )
        end = _closing(text, head.end())
        yield _Letter(head[1], offset, head.end(), end)
        offset = _after_gap(text, end + 1)


def _after_gap(text: str, offset: int) -> int:
    gap = _GAP.match(text, offset)
    return gap.end() if gap else offset


def _closing(text: str, start: int) -> int:
    """Return the offset of the bracket that closes the one before `start`."""
    depth = 1
    for offset in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[offset], 0)
        if depth == 0:
            return offset
    raise ExpressionError(len(text), "missing ); in a list, quote a motion that holds a comma")


def _why_no_motion(name: str) -> str:
    right = next((motion for motion in _MOTIONS if motion.lower() == name.lower()), None)
    hint = f"; did you mean {right}?" if right else f"; the motions are {', '.join(_MOTIONS)}"
    return f"{brief(name)} is not a motion{hint}"
