"""Long statements over several lines."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import accumulate

_WIDTH = 100
_ARGUMENTS = re.compile(r"(?<=[,|]) ")
#: Where a statement is broken: between arguments, else before a sign, else before a factor.
_BEFORE = (_ARGUMENTS, re.compile(r" (?=[+-] )"), re.compile(r" (?=[*/] )"))
#: The same where a line that begins with a sign would be a statement of its own.
_BEHIND = (_ARGUMENTS, re.compile(r"(?<= [+-]) "), re.compile(r"(?<= [*/]) "))


@dataclass(frozen=True, slots=True)
class Layout:
    """How a language sets statements over several lines.

    Attributes
    ----------
    indent : str
        One step of it.
    more : str
        What a line ends with that goes on in the next.
    behind_signs : bool
        Whether a line ends, not begins, with the sign between two terms.
    end : str
        What ends ``target = value``.
    """

    indent: str = "    "
    more: str = ""
    behind_signs: bool = False
    end: str = ""


_PLAIN = Layout()


def broken(text: str, depth: int, layout: Layout = _PLAIN) -> str:
    """Indent a statement, and break it where it is too long for one line."""
    begin, indent = layout.indent * depth, layout.indent
    if len(begin) + len(text) <= _WIDTH:
        return begin + text
    width = _WIDTH - len(begin) - len(layout.more)
    lines: list[str] = []
    for piece in _pieces(text, width - len(indent), _BEHIND if layout.behind_signs else _BEFORE):
        room = width - (len(indent) if len(lines) > 1 else 0)
        if lines and len(lines[-1]) + 1 + len(piece) <= room:
            lines[-1] += f" {piece}"
        else:
            lines.append(piece)
    return f"{layout.more}\n{begin}{indent}".join([begin + lines[0], *lines[1:]])


def broken_value(target: str, value: str, depth: int, layout: Layout = _PLAIN) -> str:
    """Indent ``target = value``, with brackets around a value that takes several lines."""
    begin = layout.indent * depth
    line = f"{begin}{target}{value}{layout.end}"
    if len(line) <= _WIDTH:
        return line
    if _is_bracketed(value):
        return broken(target + value + layout.end, depth, layout)
    inner = broken(value + layout.more, depth + 1, layout)
    return f"{begin}{target}({layout.more}\n{inner}\n{begin}){layout.end}"


def _is_bracketed(text: str) -> bool:
    """Say whether the bracket that opens a text closes at its very end."""
    signs = ((character == "(") - (character == ")") for character in text)
    depths = list(accumulate(signs))
    return text.startswith("(") and depths.index(0) == len(text) - 1


def _pieces(text: str, width: int, places: tuple[re.Pattern[str], ...]) -> list[str]:
    """Cut a text as little as it takes for each piece to fit on a line."""
    if len(text) <= width or not places:
        return [text]
    first, *others = places
    return [piece for part in first.split(text) for piece in _pieces(part, width, tuple(others))]
