"""What both writers of drawings share: numbers, and a caption as plain text."""

from __future__ import annotations

from symdh.derivation.text import Text
from symdh.render.unicode_math import UnicodeWriter

_MATH = UnicodeWriter()


def figure(value: float) -> str:
    """Write a coordinate: two decimals are a hundredth of a point."""
    # The first rounding keeps the last bit of a sine, which differs from machine to machine,
    # from deciding the second.
    text = f"{round(value, 6):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def plain(text: Text) -> str:
    """Return text with its formulas as Unicode."""
    return "".join(part if isinstance(part, str) else _MATH.text(part) for part in text)
