"""What can be wrong with a mechanism, and which part of it that is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from symdh.errors import UnsupportedError

#: A part of a mechanism: ``("joint", 2, "direction")``, ``("frame", 1, "x")``, ``("tool",)``.
Subject = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that is wrong, and where."""

    subject: Subject
    message: str


class AssignmentError(UnsupportedError):
    """No table can be made; `faults` says why, all of it at once."""

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults = tuple(faults)
        super().__init__("; ".join(fault.message for fault in self.faults))
