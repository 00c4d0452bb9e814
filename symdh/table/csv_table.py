"""A table as CSV: comments with settings, a line with the names of the columns, and the rows.

# convention: modified
alpha_{i-1},a_{i-1},d_i,theta_i
0,0,0,theta1
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from symdh.table.nodes import MappingNode, Node, ScalarNode, parse_nodes
from symdh.table.source import START, Place, Source
from symdh.table.tabular import (
    Line,
    cell,
    is_setting,
    parameters_named,
    refuse_size,
    table_of,
)

SEPARATORS = (",", ";", "\t")
MAX_SETTINGS = 50

# A spreadsheet quotes a line and fills it up with separators when it writes a file again.
_COMMENT = re.compile(r'[ \t]*"?#(?![ \t]*[,;\t])(?!")')
_SETTING = re.compile(r'(?P<mark>[ \t]*"?#[ \t]*)(?P<text>(?P<key>[A-Za-z][\w-]*)[ \t]*:(?:\s.*)?)')


def csv_nodes(source: Source) -> MappingNode:
    """Return the table that a text in CSV holds, with the nodes that it would have in YAML.

    Cells are separated by commas, semicolons or tabs, whichever the header has. Lines of
    comment start with #; one such as ``# convention: modified`` is a key of the table.

    Raises
    ------
    TableError
        When there is no line with names of columns, or a quote is not closed.
    """
    lines = list(enumerate(source.text.split("\n"), start=1))
    settings = _settings([line for line in lines if _COMMENT.match(line[1])], source)
    filled = [line for line in _table_lines(lines) if line[1].strip(" \t,;")]
    if not filled:
        raise source.error(START, "file has no rows; its first line names the columns")
    refuse_size(source, filled)
    separator = _separator(filled[0][1])
    header, *rows = (list(_cells(source, line, separator)) for line in filled)
    while len(header) > 1 and not header[-1].text:
        header.pop()
    for row in rows:
        while len(row) > len(header) and not row[-1].text:
            row.pop()
    return table_of(source, settings, header, rows)


def is_csv(text: str) -> bool:
    """Tell CSV from other forms by its first line, which names at least two parameters.

    A colon or a bracket at the start is YAML or JSON: ``columns: [theta, d, a, alpha]``.
    """
    lines = _table_lines(enumerate(text.split("\n"), start=1))
    first = next((line for _, line in lines if line.strip(" \t,;")), "")
    if ":" in first or first.lstrip()[:1] in ("{", "["):
        return False
    separator = _separator(first)
    return parameters_named(text.strip(' "') for text in first.split(separator)) > 1


def _table_lines(lines: Iterable[Line]) -> Iterator[Line]:
    return (line for line in lines if not _COMMENT.match(line[1]))


def _settings(comments: Sequence[Line], source: Source) -> list[tuple[ScalarNode, Node]]:
    """Read the comments that are settings, each by itself."""
    found: list[tuple[ScalarNode, Node]] = []
    for number, line in comments:
        match = _SETTING.fullmatch(line)
        if match is None or not is_setting(match["key"]):
            continue
        if len(found) >= MAX_SETTINGS:
            place = Place(number, 1, 1)
            raise source.error(place, f"more than {MAX_SETTINGS} settings in comments")
        text = match["text"].rstrip(" \t,;")
        if '"' in match["mark"]:
            text = text.removesuffix('"')
        before = "\n" * (number - 1) + " " * len(match["mark"])
        found += parse_nodes(source, before + text).items
    return found


def _separator(header: str) -> str:
    """Return the separator with which a header names the most parameters, or has most cells."""

    def merit(separator: str) -> tuple[int, int]:
        texts = header.split(separator)
        return parameters_named(text.strip(' "') for text in texts), len(texts)

    return max(SEPARATORS, key=merit)


def _cells(source: Source, line: Line, separator: str) -> Iterator[ScalarNode]:
    number, text = line
    blanks = " \t".replace(separator, "")
    start = 0
    while start <= len(text):
        while start < len(text) and text[start] in blanks:
            start += 1
        if text.startswith('"', start):
            end, written = _quoted(source, number, text, start)
            rest = text.find(separator, end)
            rest = len(text) if rest < 0 else rest
            if text[end:rest].strip(blanks):
                place = Place(number, end + 1, end + 1)
                raise source.error(place, "text after the quote that closes the cell")
            yield cell(source, Place(number, start + 1, start + 1), written, quoted=True)
            start = rest + 1
        else:
            end = text.find(separator, start)
            end = len(text) if end < 0 else end
            place = Place(number, start + 1, start + 1)
            yield cell(source, place, text[start:end].rstrip(blanks))
            start = end + 1


def _quoted(source: Source, number: int, text: str, start: int) -> tuple[int, str]:
    """Return where a quoted cell ends, and what stands in it; a doubled quote is a quote."""
    end = start + 1
    while True:
        end = text.find('"', end)
        if end < 0:
            place = Place(number, start + 1, start + 1)
            raise source.error(place, "this quote is not closed; a cell stands on one line")
        if text[end + 1 : end + 2] != '"':
            return end + 1, text[start + 1 : end].replace('""', '"')
        end += 2
