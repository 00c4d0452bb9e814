"""A derivation as typed blocks: what is said and which formulas, never how they are laid out."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from symdh.notation.nodes import Matrix, Node

Inline = str | Node
Text = tuple[Inline, ...]


class Identity(Enum):
    """The identity that takes one form of an entry to the next; the value is how it is named."""

    COSINE_OF_SUM = "cosine of a sum"
    SINE_OF_SUM = "sine of a sum"
    COSINE_OF_DIFFERENCE = "cosine of a difference"
    SINE_OF_DIFFERENCE = "sine of a difference"
    ANGLE_SUMS = "angle sums, like terms collected"
    SQUARES = "squares of sine and cosine add to one"


@dataclass(frozen=True, slots=True)
class Paragraph:
    """Running text with formulas in it."""

    content: Text


@dataclass(frozen=True, slots=True)
class Definition:
    """A term and what it means."""

    term: Node
    meaning: Text


@dataclass(frozen=True, slots=True)
class Definitions:
    """A list of terms."""

    entries: tuple[Definition, ...]


@dataclass(frozen=True, slots=True)
class ParameterTable:
    """The Denavit-Hartenberg table as given; joint variables are starred names."""

    header: tuple[Node, ...]
    rows: tuple[tuple[Node, ...], ...]
    notes: tuple[Text, ...]


@dataclass(frozen=True, slots=True)
class Display:
    """One formula on a line of its own."""

    formula: Node


@dataclass(frozen=True, slots=True)
class NamedMatrix:
    """A matrix with its name and, in between, what it is the product of.

    A renderer prints it as a matrix where that fits and entry by entry where it does not.

    Attributes
    ----------
    names : tuple of Node
        Left-hand sides, outermost first: ``0T2`` and ``A_1 A_2``.
    matrix : Matrix
    """

    names: tuple[Node, ...]
    matrix: Matrix


@dataclass(frozen=True, slots=True)
class MatrixRow:
    """Short named matrices that stand side by side as far as they fit."""

    matrices: tuple[NamedMatrix, ...]


@dataclass(frozen=True, slots=True)
class EntryStep:
    """One entry of a product: the raw row times column, then what an identity makes of it."""

    name: Node
    forms: tuple[Node, ...]
    identity: Identity | None


@dataclass(frozen=True, slots=True)
class EntrySteps:
    """The entries of a product that an identity changes."""

    entries: tuple[EntryStep, ...]


@dataclass(frozen=True, slots=True)
class ProductResult:
    """One multiplication: the entries that an identity changed, then the whole product.

    Attributes
    ----------
    names : tuple of Node
        Left-hand sides, outermost first: ``0T2`` and ``A_1 A_2``.
    matrix : Matrix
        The product in its short form.
    steps : tuple of EntryStep
        All twelve entries; those that took an identity have two forms, the others one.
    final : bool
        The last product: its entries are the result and are printed there.
    """

    names: tuple[Node, ...]
    matrix: Matrix
    steps: tuple[EntryStep, ...]
    final: bool


@dataclass(frozen=True, slots=True)
class Entries:
    """Single entries with their names, in groups such as the columns n, s, a, p."""

    groups: tuple[tuple[EntryStep, ...], ...]


@dataclass(frozen=True, slots=True)
class PoseResult:
    """The pose: as a matrix where that fits, and always entry by entry."""

    whole: NamedMatrix
    explanation: Text
    entries: Entries


@dataclass(frozen=True, slots=True)
class Fitting:
    """A named matrix where it fits on a line, else what says the same in less width."""

    whole: NamedMatrix
    otherwise: tuple[Block, ...]


Block = (
    Paragraph
    | Definitions
    | ParameterTable
    | Display
    | NamedMatrix
    | MatrixRow
    | EntrySteps
    | ProductResult
    | Entries
    | PoseResult
    | Fitting
)


@dataclass(frozen=True, slots=True)
class Chapter:
    """A part of a derivation under one heading."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Document:
    """A whole derivation.

    Attributes
    ----------
    title : str
        Free text of the table's author; renderers escape it.
    subtitle : Text
    chapters : tuple of Chapter
    """

    title: str
    subtitle: Text
    chapters: tuple[Chapter, ...]
