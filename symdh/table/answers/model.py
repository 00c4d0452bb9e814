"""What an answer file holds, once it is read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from sympy import Expr, Symbol

from symdh.table.source import Place

End = int | Literal["base", "tool"]


@dataclass(frozen=True, slots=True)
class Link:
    """A_i, the transform of row `row`."""

    row: int


@dataclass(frozen=True, slots=True)
class Pose:
    """The pose of frame `end` in frame `start`; None for the ends of the whole chain."""

    start: End | None = None
    end: End | None = None


@dataclass(frozen=True, slots=True)
class Jacobian:
    """The geometric Jacobian of the last frame, along the axes of the first."""


Subject = Link | Pose | Jacobian


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that a student wrote.

    Attributes
    ----------
    row, column : int
        Its place in the matrix that it belongs to, from 0.
    value : Expr or None
        Exact, short forms spelt out; None where the student left a blank.
    text : str
        As it is written.
    place : Place
    """

    row: int
    column: int
    value: Expr | None
    text: str
    place: Place


@dataclass(frozen=True, slots=True)
class Claim:
    """Entries of one matrix, under one key.

    Attributes
    ----------
    name : str
        The key as it is written.
    subject : Subject
        Whose entries they are.
    entries : tuple of Entry
        Row by row.
    numeric : bool
        Whether they are numbers for the values given with them.
    """

    name: str
    subject: Subject
    entries: tuple[Entry, ...]
    numeric: bool = False


@dataclass(frozen=True, slots=True)
class RowClaim:
    """One row of a Denavit-Hartenberg table.

    Attributes
    ----------
    number : int
        From 1.
    cells : mapping of str to Entry
        By ``theta``, ``d``, ``a`` and ``alpha``.
    """

    number: int
    cells: Mapping[str, Entry]


@dataclass(frozen=True, slots=True)
class AnswerSheet:
    """One student's answers.

    Attributes
    ----------
    filename : str
    student : str
        What the file says under ``name``, or nothing.
    claims : tuple of Claim
        In the order of the file.
    rows : tuple of RowClaim
    values : mapping of Symbol to Expr
        What the numeric entries are for, besides the table's own values.
    """

    filename: str
    student: str
    claims: tuple[Claim, ...]
    rows: tuple[RowClaim, ...]
    values: Mapping[Symbol, Expr]
