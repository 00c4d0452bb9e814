"""Free text as LaTeX: whatever it holds, it prints as itself and runs nothing."""

from __future__ import annotations

import re
import unicodedata

from symdh.notation.names import GREEK

_ESCAPED = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "_": r"\_",
    "%": r"\%",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"\textquotedbl{}",
    "'": r"\textquotesingle{}",
    "`": r"\textasciigrave{}",
    "–": "--",
    "—": "---",
    "’": r"\textquoteright{}",
    "‘": r"\textquoteleft{}",
    "“": r"\textquotedblleft{}",
    "”": r"\textquotedblright{}",
    "…": r"\ldots{}",
    "°": r"\textdegree{}",
    "²": r"\textsuperscript{2}",
    "³": r"\textsuperscript{3}",
    "µ": r"\textmu{}",
    "×": r"\texttimes{}",
    "\u00a0": "~",
    "\0": r"{\kern0pt}",  # stands for nothing; see latex_text
}
#: Of the letters with and without accents up to ž, those that the fonts do not have.
_LACKING = "ĦħĸĿŀŉŦŧ"
_GREEK_LETTERS = {letter: name for name, letter in GREEK.items()}


def latex_text(text: str) -> str:
    """Escape text for LaTeX with T1 fonts.

    Letters that these fonts lack are printed without their accents where they have any, else by
    their code, and so are control characters, so that every title compiles. White space of any
    kind is a space.
    """
    # Keeps twins from becoming a ligature: two hyphens stay two hyphens. To LuaTeX a pair of braces
    # would not be enough, and the names of < and > are the signs themselves.
    apart = re.sub(r"([-,<>])(?=\1)", "\\1\0", text)
    return "".join(_character(character) for character in apart)


def _character(character: str) -> str:
    if character in _ESCAPED:
        return _ESCAPED[character]
    if character in _GREEK_LETTERS:
        name = _GREEK_LETTERS[character]
        return "o" if name == "omicron" else rf"\ensuremath{{\{name}}}"
    accented = "\u00c0" <= character <= "\u017e" and character not in _LACKING
    if " " <= character <= "~" or accented:
        return character
    if character.isspace():
        return " "
    return plain_letter(character)


def plain_letter(character: str) -> str:
    """Return an ASCII letter or digit in place of one with marks, else the character's code."""
    base = unicodedata.normalize("NFKD", character)[0]
    if ord(base) < 128 and base.isalnum():
        return base
    return f"[U+{ord(character):04X}]"
