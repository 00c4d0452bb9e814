"""Everything symdh raises on purpose, and the diagnostics that a table error carries."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum


class Severity(Enum):
    """How bad a diagnostic is: an error stops the work, a warning does not."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One remark on an input file, with its place.

    Attributes
    ----------
    message : str
        What is wrong and, where it fits, what to write instead.
    filename : str
        The file as the user named it; ``<stdin>`` for standard input.
    line, column : int
        Place, counted from 1. Inside a quoted value the column is counted as if the quotes
        were not there.
    source : str
        The text of that line, empty when there is none.
    caret : int
        Column (from 1) under which the caret is drawn in `source`.
    severity : Severity
        Error or warning.
    """

    message: str
    filename: str
    line: int
    column: int
    source: str = ""
    caret: int = 1
    severity: Severity = Severity.ERROR

    def __str__(self) -> str:
        label = "" if self.severity is Severity.ERROR else "warning: "
        head = f"{self.filename}:{self.line}:{self.column}: {label}{self.message}"
        if not self.source.strip():
            return head
        return f"{head}\n{excerpt(self.source, self.caret)}"


def excerpt(source: str, caret: int, width: int = 100) -> str:
    """Show a source line with a caret below it, cut to `width` characters around the caret."""
    source = source.replace("\t", " ")
    start = max(0, min(caret - 1 - width // 2, len(source) - width))
    shown = source[start : start + width]
    lead = "…" if start else ""
    tail = "…" if start + width < len(source) else ""
    gap = " " * (caret - 1 - start + len(lead))
    return f"    {lead}{shown}{tail}\n    {gap}^"


class SymdhError(Exception):
    """Base of every error that symdh raises on purpose; its text is fit for a user."""

    exit_status = 2


class TableError(SymdhError):
    """An input file is wrong; `diagnostics` says where and why, all of it at once."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(d) for d in self.diagnostics))

    def __reduce__(self) -> tuple[type[TableError], tuple[tuple[Diagnostic, ...]]]:
        """Let the error travel between processes with its diagnostics."""
        return type(self), (self.diagnostics,)


class UnsupportedError(SymdhError):
    """The request is well formed but outside what symdh can do, e.g. a frame that is not there."""


class DerivationError(SymdhError):
    """A derivation could not be made; a defect of symdh or a form that it does not know."""


class ReadError(SymdhError):
    """A file cannot be read: missing, a directory, no permission."""

    exit_status = 3


class OutputError(SymdhError):
    """A file cannot be written; what was there before is untouched."""

    exit_status = 3


class LimitError(SymdhError):
    """A stated limit on time or size was reached."""

    exit_status = 4
