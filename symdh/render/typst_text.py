"""Free text as Typst markup: whatever it holds, it prints as itself and runs nothing."""

from __future__ import annotations

import re

from symdh.notation.names import GREEK
from symdh.render.latex_text import plain_letter

_NO_BREAK_SPACE = "\u00a0"
#: Typographic characters of the font that are no letters.
_PRINTED = frozenset("–—’‘“”…°²³µ×") | frozenset(GREEK.values())
#: Places where the font would make one sign of two, such as a dash of hyphens.
_LIGATURE = re.compile(r"(?<=-)(?=-)|(?<=,)(?=,)|(?<=`)(?=`)|(?<=')(?=')|(?<=[?!])(?=`)")
_APART = "\0"


def typst_text(text: str) -> str:
    """Escape text for Typst with the font New Computer Modern.

    Letters are restricted as in LaTeX (`latex_text`), so that both handouts read alike. White
    space of any kind is a space.
    """
    return "".join(_character(character) for character in _LIGATURE.sub(_APART, text))


def _character(character: str) -> str:
    if character == _APART:
        return "#box[];"
    if character == _NO_BREAK_SPACE:
        return "~"
    if character.isspace():
        return " "
    if character.isascii() and character.isalnum():
        return character
    if " " < character <= "~":
        return "\\" + character
    if character in _PRINTED or "\u00c0" <= character <= "\u017e":
        return character
    return "".join(_character(each) for each in plain_letter(character))
