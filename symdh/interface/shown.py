"""Plain results as the kinds that show themselves."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

Shown = TypeVar("Shown")


def shown_as(kind: type[Shown], plain: Any) -> Shown:
    """Return a result as a kind with the same fields that also shows itself in a notebook."""
    return kind(**{field.name: getattr(plain, field.name) for field in fields(plain)})
