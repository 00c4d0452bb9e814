"""From the text of an expression to its tokens."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum, auto

from symdh.table.names import GREEK_LETTERS, SUBSCRIPT_DIGITS
from symdh.table.source import describe

MAX_EXPRESSION = 500


class ExpressionError(Exception):
    """An expression is wrong at `offset` (from 0) in its text; callers know where that stands."""

    def __init__(self, offset: int, message: str) -> None:
        super().__init__(message)
        self.offset = offset
        self.message = message


class TokenKind(Enum):
    """Kinds of tokens."""

    NUMBER = auto()
    NAME = auto()
    OPERATOR = auto()
    END = auto()


@dataclass(frozen=True, slots=True)
class Token:
    """A token and its offset, from 0, in the text of the expression."""

    kind: TokenKind
    text: str
    offset: int


_TOKEN = re.compile(
    rf"""[ \t]*(?:
        (?P<NUMBER>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
      | (?P<NAME>[A-Za-z{GREEK_LETTERS}][A-Za-z0-9_{GREEK_LETTERS}]*[{SUBSCRIPT_DIGITS}]*)
      | (?P<OPERATOR>\*\*|[-+*/^(),°])
    )""",
    re.VERBOSE,
)

_SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789", strict=True))
_HINTS = {
    "\u00a0": "write an ordinary space",
    "\u2212": "write -",
    "\u2013": "write -",
    "\u2014": "write -",
    "\u00d7": "write *",
    "\u00b7": "write *",
    "\u22c5": "write *",
    "\u00f7": "write /",
    "\u221a": "write sqrt(...)",
    "\u00ba": "write deg or °",
    "\u2032": "write a name of letters, digits and _",
    **{character: f"write **{digit}" for character, digit in _SUPERSCRIPTS.items()},
}


def tokenize(text: str, longest: int = MAX_EXPRESSION) -> list[Token]:
    """Split an expression of at most `longest` characters into tokens; the last one is the end.

    Raises
    ------
    ExpressionError
        At the first character that no expression holds, and when the text is too long.
    """
    if len(text) > longest:
        raise ExpressionError(longest, f"expression is longer than {longest} characters")
    end = len(text.rstrip(" \t"))
    tokens = []
    offset = 0
    while offset < end:
        match = _TOKEN.match(text, offset)
        if match is None:
            raise _unexpected(text, offset)
        kind = str(match.lastgroup)
        tokens.append(Token(TokenKind[kind], match[kind], match.start(kind)))
        offset = match.end()
    tokens.append(Token(TokenKind.END, "", end))
    return tokens


def _unexpected(text: str, offset: int) -> ExpressionError:
    while text[offset] in " \t":
        offset += 1
    character = text[offset]
    if character.isascii():
        return ExpressionError(offset, f"unexpected character {character}")
    hint = _HINTS.get(character)
    message = f"character {describe(character)} is not allowed"
    return ExpressionError(offset, f"{message}; {hint}" if hint else message)
