"""All that is wrong with one table, collected so that a user sees it at once."""

from __future__ import annotations

from symdh.errors import Diagnostic, Severity, TableError
from symdh.table.source import Place, Source

MAX_ERRORS = 100


class Report:
    """Diagnostics of one source, in the order in which they are found."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self._diagnostics: list[Diagnostic] = []

    def error(self, place: Place, message: str) -> None:
        """Note an error.

        Raises
        ------
        TableError
            When there are so many that more of them help nobody.
        """
        self._add(place, message, Severity.ERROR)
        if self._errors() >= MAX_ERRORS:
            self._add(place, f"stopped after {MAX_ERRORS} errors", Severity.ERROR)
            raise TableError(self.diagnostics())

    def warning(self, place: Place, message: str) -> None:
        """Note a warning."""
        self._add(place, message, Severity.WARNING)

    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Return what was noted, in the order of the file."""
        return tuple(sorted(self._diagnostics, key=lambda found: (found.line, found.column)))

    def raise_errors(self) -> None:
        """Raise a `TableError` with every diagnostic if one of them is an error."""
        if self._errors():
            raise TableError(self.diagnostics())

    def _add(self, place: Place, message: str, severity: Severity) -> None:
        self._diagnostics.append(self.source.diagnostic(place, message, severity))

    def _errors(self) -> int:
        return sum(found.severity is Severity.ERROR for found in self._diagnostics)
