"""Long lines of C, broken behind a comma or before an operator."""

from __future__ import annotations

import re

#: Longest line of generated code.
WIDTH = 100

_BREAK = re.compile(r"(?<=,) | (?=[-+*/] )")


def fold(text: str) -> str:
    """Break the lines of a C file that are too long, comments and directives aside."""
    return "\n".join(map(_fold_line, text.split("\n")))


def _fold_line(line: str) -> str:
    if len(line) <= WIDTH or line.startswith(("#", " *", "/*")):
        return line
    margin = " " * (len(line) - len(line.lstrip()))
    first, *pieces = _BREAK.split(line.strip())
    lines = [margin + first]
    for piece in pieces:
        if len(f"{lines[-1]} {piece}") <= WIDTH:
            lines[-1] += f" {piece}"
        else:
            # Set off from the lines below by more than a step.
            lines.append(f"{margin}        {piece}")
    return "\n".join(lines)
