"""What is said about answers."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from enum import Enum

from sympy import Expr

from symdh.table.answers import Entry


class Verdict(Enum):
    """What an entry is."""

    RIGHT = "right"
    SIGN = "right but for the sign"
    SWAPPED = "sine and cosine swapped"
    COARSE = "rounded too coarsely"
    WRONG = "wrong"
    BLANK = "blank"


@dataclass(frozen=True, slots=True)
class Finding:
    """A verdict, and what there is to say beside it.

    Attributes
    ----------
    verdict : Verdict
    note : str
    term : Expr or None
        The term that the verdict is about, where it is about one alone.
    """

    verdict: Verdict
    note: str = ""
    term: Expr | None = None


@dataclass(frozen=True, slots=True)
class JudgedEntry:
    """One entry with its verdict.

    Attributes
    ----------
    label : str
        Which entry: ``[1,4]``, or ``alpha of row 2``.
    entry : Entry
    finding : Finding
    expected : Expr or float or None
        The right answer; None where no closed form is small enough.
    """

    label: str
    entry: Entry
    finding: Finding
    expected: Expr | float | None = None

    @property
    def verdict(self) -> Verdict:
        """What the entry is."""
        return self.finding.verdict


@dataclass(frozen=True, slots=True)
class JudgedClaim:
    """What stands under one key.

    Attributes
    ----------
    name : str
        The key, ``rows`` for the rows of a table.
    entries : tuple of JudgedEntry
    columns : int
        How many of them make a row when they are shown as a matrix.
    hint : str
        The slip that explains all of its mistakes, or nothing.
    """

    name: str
    entries: tuple[JudgedEntry, ...]
    columns: int
    hint: str = ""

    @property
    def right(self) -> int:
        """How many entries are right."""
        return sum(each.verdict is Verdict.RIGHT for each in self.entries)

    @property
    def counts(self) -> Counter[Verdict]:
        """How many entries there are of each verdict."""
        return Counter(each.verdict for each in self.entries)


@dataclass(frozen=True, slots=True)
class JudgedSheet:
    """One student's answers with all verdicts."""

    filename: str
    student: str
    claims: tuple[JudgedClaim, ...]

    @property
    def right(self) -> int:
        """How many entries are right."""
        return sum(claim.right for claim in self.claims)

    @property
    def total(self) -> int:
        """How many entries there are."""
        return sum(len(claim.entries) for claim in self.claims)
