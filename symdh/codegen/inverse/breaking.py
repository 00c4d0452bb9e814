"""Long statements over several lines."""

from __future__ import annotations

import re

_WIDTH = 100
_INDENT = "    "
#: Where a statement is broken: between arguments, else before a sign, else before a factor.
_PLACES = (re.compile(r"(?<=[,|]) "), re.compile(r" (?=[+-] )"), re.compile(r" (?=[*/] )"))


def broken(text: str, depth: int) -> str:
    """Indent a statement, and break it where it is too long for one line."""
    begin = _INDENT * depth
    lines: list[str] = []
    for piece in _pieces(text, _WIDTH - len(begin) - len(_INDENT), _PLACES):
        room = _WIDTH - len(begin) - (len(_INDENT) if len(lines) > 1 else 0)
        if lines and len(lines[-1]) + 1 + len(piece) <= room:
            lines[-1] += f" {piece}"
        else:
            lines.append(piece)
    return f"\n{begin}{_INDENT}".join([begin + lines[0], *lines[1:]])


def broken_value(target: str, value: str, depth: int) -> str:
    """Indent ``target = value``, with brackets around a value that takes several lines."""
    line = f"{_INDENT * depth}{target}{value}"
    if len(line) <= _WIDTH:
        return line
    if _is_bracketed(value):
        return broken(target + value, depth)
    begin = _INDENT * depth
    return f"{begin}{target}(\n{broken(value, depth + 1)}\n{begin})"


def _is_bracketed(text: str) -> bool:
    """Say whether the bracket that opens a text closes at its very end."""
    depth = 0
    for place, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if depth == 0:
            return character == ")" and place == len(text) - 1
    return False


def _pieces(text: str, width: int, places: tuple[re.Pattern[str], ...]) -> list[str]:
    """Cut a text as little as it takes for each piece to fit on a line."""
    if len(text) <= width or not places:
        return [text]
    first, *others = places
    return [piece for part in first.split(text) for piece in _pieces(part, width, tuple(others))]
