"""The names of what can be answered: ``A1``, ``T02``, ``0T2``, ``T(0, 2)[1,4]``, ``px``, ``J``."""

from __future__ import annotations

import re
from dataclasses import dataclass

from symdh.table.answers.model import End, Jacobian, Link, Pose, Subject
from symdh.table.lexer import ExpressionError
from symdh.table.suggest import brief, did_you_mean

EXAMPLES = "A1, T02, 0T2, T(0, 2), T02[1,4], pose, p, px, r11, J"
#: Keys of an answer file beside those names.
KEYS = ("name", "rows", "columns", "numbers", "notes")

_WORDS = (*KEYS, "pose", "jacobian", "A1", "T01", "px", "py", "pz", "R", "p", "J")
_WHOLE = ("pose", "T", "fk")
_SPELLING = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹₀₁₂₃₄₅₆₇₈₉", "01234567890123456789", "{}")
_LINK = re.compile(r"A_?(\d{1,3})")
_CALL = re.compile(r"T_?\((\w+),(\w+)\)")
_SIDES = re.compile(r"(\d{1,3}|base)_?T_?(\d{1,3}|tool)")
_SPLIT = re.compile(r"T_?(\d{1,3})_(\d{1,3})|(\d{1,3})_(\d{1,3})_?T")
_RUN = re.compile(r"T_?(\d{2,6})|(\d{2,6})_?T")
_ENTRY = re.compile(r"\[(\d+),(\d+)\]")
_PART = re.compile(r"p([xyz])|r_?([123])([123])|([nsoa])([xyz])|([pRnsoa])")
_COLUMN_OF = {"n": 0, "s": 1, "o": 1, "a": 2, "p": 3}

#: Rows and columns of a matrix, from 0.
Cells = tuple[tuple[tuple[int, int], ...], ...]


@dataclass(frozen=True, slots=True)
class Target:
    """What one key asks for.

    Attributes
    ----------
    subject : Subject
    shapes : tuple of Cells
        The cells that may stand under it, row by row; the first is the usual one.
    """

    subject: Subject
    shapes: tuple[Cells, ...]


def read_target(text: str, n: int, joints: int) -> Target:
    """Read the name of a matrix, of a part of one, or of one entry.

    Parameters
    ----------
    text : str
    n : int
        Rows of the table.
    joints : int
        Columns of the Jacobian.

    Raises
    ------
    ExpressionError
        When the text names nothing, or something that the table does not have.
    """
    name = re.sub(r"\s+", "", text).translate(_SPELLING)
    part = _PART.fullmatch(name)
    if part is not None:
        return Target(Pose(), (_part(part),))
    head, inner = _parted(name)
    subject, rows, columns = _subject(head, n, joints, text)
    if not inner:
        whole = _block(rows, columns)
        return Target(subject, (whole, whole[:3]) if rows == 4 else (whole,))
    if not isinstance(subject, Jacobian) and inner.startswith("."):
        part = _PART.fullmatch(inner[1:])
        if part is None:
            message = f"{brief(inner)} is no part of a pose: write .p, .R, .px or .r11"
            raise ExpressionError(0, message)
        return Target(subject, (_part(part),))
    found = _ENTRY.fullmatch(inner)
    if found is None:
        raise ExpressionError(0, f"{brief(inner)} is no entry: write [row,column], from 1")
    row, column = int(found[1]), int(found[2])
    if not (1 <= row <= rows and 1 <= column <= columns):
        raise ExpressionError(0, f"{brief(head)} has {rows} rows and {columns} columns")
    return Target(subject, ((((row - 1, column - 1),),),))


def _parted(name: str) -> tuple[str, str]:
    """Part ``T02[1,4]`` and ``T02.px`` into the matrix and what is taken of it."""
    found = re.search(r"[\[.]", name)
    return (name[: found.start()], name[found.start() :]) if found else (name, "")


def _part(found: re.Match[str]) -> Cells:
    """Return the cells of p, R, n, px, r11 and the like."""
    component, row, column, letter, axis, block = found.groups()
    if component:
        return ((("xyz".index(component), 3),),)
    if row:
        return (((int(row) - 1, int(column) - 1),),)
    if letter:
        return ((("xyz".index(axis), _COLUMN_OF[letter]),),)
    if block == "R":
        return _block(3, 3)
    return tuple(((r, _COLUMN_OF[block]),) for r in range(3))


def _block(rows: int, columns: int) -> Cells:
    return tuple(tuple((r, c) for c in range(columns)) for r in range(rows))


def _subject(head: str, n: int, joints: int, written: str) -> tuple[Subject, int, int]:
    """Return whose entries are meant, and how many rows and columns it has."""
    if head in ("J", "jacobian"):
        return Jacobian(), 6, joints
    if head in _WHOLE:
        return Pose(), 4, 4
    link = _LINK.fullmatch(head)
    if link is not None:
        row = int(link[1])
        if not 1 <= row <= n:
            raise ExpressionError(0, f"there is no A{row}: the table has rows 1 to {n}")
        return Link(row), 4, 4
    ends = _ends(head, n)
    if ends is None:
        hint = did_you_mean(written, _WORDS)
        message = f"{brief(written)} names nothing to answer{hint or f' (such as {EXAMPLES})'}"
        raise ExpressionError(0, message)
    start, end = (_frame(each, n) for each in ends)
    return Pose(start, end), 4, 4


def _ends(head: str, n: int) -> tuple[str, str] | None:
    """Return the two frames in the name of a pose."""
    for pattern in (_CALL, _SIDES, _SPLIT):
        found = pattern.fullmatch(head)
        if found is not None:
            first, second = (group for group in found.groups() if group is not None)
            return first, second
    run = _RUN.fullmatch(head)
    if run is None:
        return None
    digits = run[1] or run[2]
    cuts = [(digits[:k], digits[k:]) for k in range(1, len(digits))]
    fitting = [pair for pair in cuts if all(_is_frame(each, n) for each in pair)]
    if len(fitting) > 1:
        choices = " or ".join(f"T({first}, {second})" for first, second in fitting)
        raise ExpressionError(0, f"{brief(head)} reads two ways: write {choices}")
    return (fitting or cuts)[0]


def _is_frame(digits: str, n: int) -> bool:
    return digits == str(int(digits)) and int(digits) <= n


def _frame(text: str, n: int) -> End:
    if text == "base":
        return "base"
    if text == "tool":
        return "tool"
    if text.isdigit() and int(text) <= n:
        return int(text)
    raise ExpressionError(0, f"there is no frame {brief(text)}: the table has base, 0 to {n}, tool")
