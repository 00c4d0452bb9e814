"""The name and the title of a table."""

from __future__ import annotations

import keyword
import re
from pathlib import PurePath

from symdh.table.cells import scalar
from symdh.table.nodes import Node
from symdh.table.report import Report

MAX_NAME = 64
MAX_TITLE = 200
FALLBACK = "robot"

_OUTSIDE = re.compile(r"[^A-Za-z0-9_ .-]")

# Files and functions are named after the table, so its name must be none of these.
_C_WORDS = frozenset(
    """
    alignas alignof and asm auto bool break case catch char class compl complex const constexpr
    continue decltype default delete do double else enum explicit export extern false float for
    friend goto if imaginary inline int long mutable namespace new noexcept not nullptr operator or
    private protected public register requires restrict return short signed sizeof static struct
    switch template this throw true try typedef typeid typename typeof union unsigned using virtual
    void volatile while xor
    """.split()  # noqa: SIM905
)
_PYTHON_WORDS = frozenset(keyword.kwlist)
_DEVICES = re.compile(r"(?:con|prn|aux|nul|com[1-9]|lpt[1-9])(?:\..*)?", re.IGNORECASE)


def read_name(node: Node, report: Report) -> str:
    """Read the name of a table, which files and functions are named after."""
    text = scalar(node, "a name", report)
    if text is None:
        return FALLBACK
    reason = why_no_name(text.text)
    if reason is not None:
        report.error(text.place(), reason)
    return text.text


def why_no_name(name: str) -> str | None:
    """Say why a text cannot be the name of a table, or return None when it can."""
    outside = _OUTSIDE.search(name)
    if not name.strip():
        return "name is empty"
    if outside:
        return f"name has the character {outside[0]}; allowed are A-Z a-z 0-9 _ . - and spaces"
    if len(name) > MAX_NAME:
        return f"name has {len(name)} characters, over {MAX_NAME}"
    if not name[0].isalnum():
        return f"name starts with {name[0]}; it must start with a letter or digit"
    if name[-1] in " .":
        return "name ends with a space or a dot"
    if not re.search("[A-Za-z]", name):
        return "name has no letter"
    return _why_taken(name)


def default_name(filename: str) -> str:
    """Return the name of a table that gives none: that of its file, as far as it can be one."""
    name = _OUTSIDE.sub("_", PurePath(filename).stem).strip()[:MAX_NAME]
    return FALLBACK if filename.startswith("<") or why_no_name(name) else name


def read_title(node: Node, report: Report) -> str | None:
    """Read the title of a table: any text on one line, printed as it stands."""
    text = scalar(node, "a title", report)
    if text is None:
        return None
    if "\n" in text.text or "\t" in text.text:
        report.error(text.place(), "title must be a text on one line, without tabs")
    if len(text.text) > MAX_TITLE:
        report.error(text.place(), f"title has {len(text.text)} characters, over {MAX_TITLE}")
    return text.text.strip() or None


def _why_taken(name: str) -> str | None:
    if name in _C_WORDS:
        return f"name {name} is a keyword of C or C++; choose another, such as {name}_arm"
    if name in _PYTHON_WORDS:
        return f"name {name} is a keyword of Python; choose another, such as {name}_arm"
    if _DEVICES.fullmatch(name):
        return f"name {name} is a device on Windows and cannot name a file"
    return None
