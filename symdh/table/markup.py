r"""What a cell of a CSV or Markdown table says, without the markup of documents around it.

``$\theta_1$``, ``2\*L``, ``−90°`` and ``$\frac{\pi}{2}$`` are what people paste from documents.
"""

from __future__ import annotations

import re

_GREEK = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau"
_GREEK += " upsilon phi chi psi omega"
_NAMES = "|".join([*_GREEK.split(), "sin", "cos", "tan"])
_MARKUP = re.compile(
    rf"""
      \\[dt]?frac\s*\{{(?P<over>[^{{}}]*)\}}\s*\{{(?P<under>[^{{}}]*)\}}
    | (?P<degree>\^\s*\{{?\s*\\circ(?![A-Za-z])\s*\}}?|\\degree(?![A-Za-z]))
    | \\(?:var)?(?P<name>{_NAMES})(?![A-Za-z])
    | (?P<times>\\(?:cdot|times)(?![A-Za-z]))
    | (?P<space>\\[,;:! ]|\u00a0)
    | (?P<minus>\u2212)
    | _\{{(?P<subscript>[A-Za-z0-9]+)\}}
    | (?P<gone>[$`]|\\(?:left|right)(?![A-Za-z]))
    | \\(?P<escaped>[\\`*_{{}}\[\]<>()\#+.|~-])
    """,
    re.VERBOSE,
)
_WRITTEN = {"degree": "°", "times": "*", "space": " ", "minus": "-", "gone": ""}


def unmarked(text: str) -> tuple[str, tuple[int, ...]]:
    """Return a text without markup, and where its characters and its end stand in `text`.

    The places are empty when there is no markup. Markup that is not known stays, for the parser of
    expressions to complain of.
    """
    pieces = list(_pieces(text, 0))
    plain = "".join(piece for piece, _ in pieces)
    if plain == text:
        return text, ()
    places = [place for _, places in pieces for place in places]
    return plain, (*places, len(text))


def _pieces(text: str, shift: int) -> list[tuple[str, list[int]]]:
    """Split a text into pieces of plain text, each with the places of its characters."""
    pieces: list[tuple[str, list[int]]] = []
    end = 0
    for match in _MARKUP.finditer(text):
        pieces.append(_verbatim(text, end, match.start(), shift))
        if match.lastgroup == "under":
            pieces += _fraction(match, shift)
        elif match.lastgroup in _WRITTEN:
            written = _WRITTEN[match.lastgroup]
            pieces.append((written, [shift + match.start()] * len(written)))
        else:
            group = str(match.lastgroup)
            if group == "subscript":
                pieces.append(_verbatim(text, match.start(), match.start() + 1, shift))
            pieces.append(_verbatim(text, match.start(group), match.end(group), shift))
        end = match.end()
    pieces.append(_verbatim(text, end, len(text), shift))
    return pieces


def _fraction(match: re.Match[str], shift: int) -> list[tuple[str, list[int]]]:
    pieces = []
    for group, sign in (("over", ""), ("under", "/")):
        start = shift + match.start(group)
        opened = f"{sign}("
        pieces.append((opened, [start] * len(opened)))
        pieces += _pieces(match[group], start)
        pieces.append((")", [shift + match.end(group)]))
    return pieces


def _verbatim(text: str, start: int, end: int, shift: int) -> tuple[str, list[int]]:
    return text[start:end], [shift + index for index in range(start, end)]
