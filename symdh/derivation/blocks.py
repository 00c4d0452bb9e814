"""A derivation as typed blocks: what is said and which formulas, never how they are laid out."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from symdh.derivation.drawing.shapes import Drawing
from symdh.derivation.text import Inline as Inline
from symdh.derivation.text import Text as Text
from symdh.notation.nodes import Matrix, Node


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


@dataclass(frozen=True, slots=True)
class Room:
    """Room to write an answer by hand.

    Attributes
    ----------
    lines : int
        Its height in lines of handwriting.
    label : Node or None
        What the answer begins with: ``A_1``.
    brackets : bool
        A matrix is wanted: empty brackets behind the label in place of a box.
    columns : tuple of Node
        A table is wanted: the heads of its columns, the first of which numbers its rows.
    """

    lines: int
    label: Node | None = None
    brackets: bool = False
    columns: tuple[Node, ...] = ()


@dataclass(frozen=True, slots=True)
class Question:
    """What a sheet asks for, in one sentence.

    Attributes
    ----------
    text : Text
    answer : tuple of Block or None
        None on a problem sheet: what is not there no writer can give away.
    room : Room
        Left in place of the answer.
    """

    text: Text
    answer: tuple[Block, ...] | None
    room: Room


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing with its caption below."""

    drawing: Drawing


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
    | Question
    | Figure
)


@dataclass(frozen=True, slots=True)
class Chapter:
    """A part of a derivation under one heading."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class SheetHead:
    """What makes a document a sheet of homework: its chapters are exercises.

    Attributes
    ----------
    problem : bool
        To be filled in by hand, so nothing on it may tell an answer.
    fields : tuple of str
        What the student writes on top, each before a blank rule.
    points : bool
        Whether each exercise has a place for its points.
    """

    problem: bool
    fields: tuple[str, ...] = ()
    points: bool = False


@dataclass(frozen=True, slots=True)
class Document:
    """A whole derivation.

    Attributes
    ----------
    title : str
        Free text of the table's author; renderers escape it.
    subtitle : Text
    chapters : tuple of Chapter
    preface : tuple of Block
        What stands before the first chapter.
    sheet : SheetHead or None
        None for a handout.
    """

    title: str
    subtitle: Text
    chapters: tuple[Chapter, ...]
    preface: tuple[Block, ...] = ()
    sheet: SheetHead | None = None

    @property
    def blocks(self) -> tuple[Block, ...]:
        """All blocks, those inside others left out."""
        return self.preface + tuple(block for each in self.chapters for block in each.blocks)
