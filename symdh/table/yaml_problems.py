"""PyYAML's errors and positions in the terms of someone who has typed a table."""

from __future__ import annotations

import re
from typing import Protocol

import yaml

from symdh.table.source import Place


class Mark(Protocol):
    """PyYAML's position, counted from 0."""

    @property
    def line(self) -> int:
        """Line, from 0."""

    @property
    def column(self) -> int:
        """Column, from 0."""


def place_of(mark: Mark | None) -> Place:
    """Return a position of PyYAML as a place; all that it reads or refuses in a text has one."""
    assert mark is not None
    return Place(mark.line + 1, mark.column + 1, mark.column + 1)


_PLAIN_WORDS = (
    (r"found character '\\t'", "a tab cannot stand here; indent with spaces"),
    (
        r"found character '(.+)' that cannot start any token",
        r"a text cannot start with \1; put it in quotes",
    ),
    (
        r"mapping values are not allowed",
        "unexpected `:`; is the indentation right, or does a text need quotes?",
    ),
    (r"could not find expected ':'", "missing `:` after a key"),
    (
        r"expected ',' or '\]'",
        "missing , or ] in the list [...]; quote a text that holds { } [ ] ,",
    ),
    (r"expected ',' or '\}'", "missing , or } in the mapping {...}; quote a text that holds { }"),
    (r"sequence entries are not allowed", "a list entry `- ` cannot stand here; use its own line"),
    (r"expected <block end>", "the indentation does not fit the lines above"),
    (r"expected the node content", "a value is missing, or a text needs quotes"),
    (
        r"found unknown escape character '(.+)'",
        r"\\\1 is no escape; use single quotes around a text with a backslash",
    ),
    (r"expected alphabetic or numeric character", "a text cannot start with * or &; quote it"),
    (r"line break, but found|chomping", "a text cannot start with | or >; put it in quotes"),
    (r"mapping keys are not allowed", "a text cannot start with ?; put it in quotes"),
    (r"expected URI", "a tag is not allowed; quote a text with !"),
    (r"expected '<document start>'", "text before or after the mapping of the table"),
    (r"but found another document", "more than one document; a file holds one table"),
)


def plain_words(problem: yaml.MarkedYAMLError) -> str:
    """Say what is wrong with the text of a table where PyYAML says it in its own terms."""
    text = problem.problem or "not YAML"
    if "quoted scalar" in (problem.context or "") and "unexpected" in text:
        opened = place_of(problem.context_mark)
        return f"the quote opened on line {opened.line}, column {opened.column} is not closed"
    for pattern, words in _PLAIN_WORDS:
        match = re.search(pattern, text)
        if match:
            return match.expand(words) + _opened_on(problem)
    return f"not YAML: {text}"


def _opened_on(problem: yaml.MarkedYAMLError) -> str:
    context, mark = problem.context_mark, problem.problem_mark
    if context is None or mark is None or context.line == mark.line:
        return ""
    return f" (what is being read starts on line {context.line + 1})"
