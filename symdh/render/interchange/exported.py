"""What an export gives."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Exported:
    """A table in another format.

    Attributes
    ----------
    text : str
    notes : tuple of str
        What the format cannot say, or what had to be assumed for it.
    """

    text: str
    notes: tuple[str, ...] = ()
