"""Free text as LaTeX: whatever it holds, it prints as itself and runs nothing."""

from __future__ import annotations

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
    # A pair of braces keeps neighbours from becoming a ligature: two hyphens stay two hyphens.
    "-": "-{}",
    ",": ",{}",
    "?": "?{}",
    "!": "!{}",
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
}
_GREEK_LETTERS = {letter: name for name, letter in GREEK.items()}


def latex_text(text: str) -> str:
    """Escape text for LaTeX with T1 fonts.

    Letters that these fonts lack are printed without their accents where they have any, else by
    their code, so that every title compiles.
    """
    return "".join(_character(character) for character in text)


def _character(character: str) -> str:
    if character in _ESCAPED:
        return _ESCAPED[character]
    if character in _GREEK_LETTERS:
        name = _GREEK_LETTERS[character]
        return "o" if name == "omicron" else rf"\ensuremath{{\{name}}}"
    if ord(character) < 128 or "\u00c0" <= character <= "\u017e":
        return character
    base = unicodedata.normalize("NFKD", character)[0]
    if ord(base) < 128 and base.isalnum():
        return base
    return f"[U+{ord(character):04X}]"
