"""A table as Markdown: settings as YAML between lines of ---, and one table with pipes.

---
convention: modified
---
| i | alpha_{i-1} | a_{i-1} | d_i | theta_i |
|---|-------------|---------|-----|---------|
| 1 | 0           | 0       | 0   | theta1  |
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from symdh.table.nodes import MappingNode, Node, ScalarNode, parse_nodes
from symdh.table.source import START, Place, Source
from symdh.table.tabular import cell, is_setting, parameters_named, refuse_size, table_of

_RULE = re.compile(r"[ \t]*\|?[ \t]*:?-+:?[ \t]*(?:\|[ \t]*:?-+:?[ \t]*)*\|?[ \t]*")
_PIPE = re.compile(r"\\.|\|")
_FENCE = re.compile(r"[ \t]*(`{3,}|~{3,})")
MAX_LINE = 10_000
"""Characters of the header of a table and of the line below it."""

_FEW = 2


@dataclass(frozen=True, slots=True)
class _PipeTable:
    """The lines of one table: its header at `first`, a rule, and rows up to before `end`."""

    first: int
    end: int


def markdown_nodes(source: Source) -> MappingNode:
    """Return the table that a text in Markdown holds, with the nodes that it would have in YAML.

    Raises
    ------
    TableError
        When there is no table of joints in the text, or more than one.
    """
    lines = source.text.split("\n")
    begin = _end_of_front_matter(lines)
    table = _the_table(source, lines, list(_tables(lines, begin)))
    refuse_size(source, list(enumerate(lines[table.first : table.end], start=table.first + 1)))
    header = _cells(source, lines, table.first)
    width = len(_spans(lines[table.first + 1]))
    if width != len(header):
        message = f"the line below the header has {width} cells, and the header {len(header)}"
        raise source.error(Place(table.first + 2, 1, 1), message)
    rows = [_cells(source, lines, index) for index in range(table.first + 2, table.end)]
    return table_of(source, _settings(source, lines, begin), header, rows)


def is_markdown(text: str) -> bool:
    """Tell Markdown from other forms by a table with pipes whose header names parameters."""
    lines = text.split("\n")
    tables = _tables(lines, _end_of_front_matter(lines))
    return any(_parameters(lines, table) >= _FEW for table in tables)


def _end_of_front_matter(lines: Sequence[str]) -> int:
    """Return the index of the line after the front matter; 0 where there is none."""
    if lines[0].rstrip() != "---":
        return 0
    ends = (i for i, line in enumerate(lines[1:], start=1) if line.rstrip() in ("---", "..."))
    return next(ends, -1) + 1


def _settings(source: Source, lines: Sequence[str], begin: int) -> list[tuple[ScalarNode, Node]]:
    """Read the front matter; keys that a table does not have belong to the document."""
    text = "\n".join(["", *lines[1 : begin - 1]])
    if begin == 0 or not any(line.partition("#")[0].strip() for line in lines[1 : begin - 1]):
        return []
    items = parse_nodes(source, text).items
    return [(key, node) for key, node in items if is_setting(key.text)]


def _tables(lines: Sequence[str], begin: int) -> Iterator[_PipeTable]:
    """Yield the tables with pipes, those in fenced blocks of code left out."""
    fence = ""
    index = begin
    while index < len(lines):
        mark = _FENCE.match(lines[index])
        if mark and (not fence or mark[1].startswith(fence)):
            fence = "" if fence else mark[1]
        elif not fence and _is_rule(lines, index, begin):
            end = index + 1
            while end < len(lines) and "|" in lines[end]:
                end += 1
            yield _PipeTable(index - 1, end)
            index = end
            continue
        index += 1


def _is_rule(lines: Sequence[str], index: int, begin: int) -> bool:
    rule, header = lines[index], lines[index - 1]
    if len(rule) > MAX_LINE or len(header) > MAX_LINE:
        return False
    return index > begin and "|" in rule and "|" in header and _RULE.fullmatch(rule) is not None


def _the_table(source: Source, lines: Sequence[str], tables: Sequence[_PipeTable]) -> _PipeTable:
    """Return the table of joints among the tables of a document."""
    fitting = [table for table in tables if _parameters(lines, table) >= _FEW]
    if len(fitting) > 1:
        line = fitting[1].first + 1
        message = (
            f"a second table; a file holds one, and the first is on line {fitting[0].first + 1}"
        )
        raise source.error(Place(line, 1, 1), message)
    if fitting:
        return fitting[0]
    if len(tables) == 1:
        return tables[0]
    wanted = "a header such as | theta_i | d_i | a_i | alpha_i | and |---|---|---|---| below it"
    raise source.error(START, f"there is no table of joints here: {wanted}")


def _parameters(lines: Sequence[str], table: _PipeTable) -> int:
    line = lines[table.first]
    return parameters_named(line[start:end].replace("\\", "") for start, end in _spans(line))


def _cells(source: Source, lines: Sequence[str], index: int) -> list[ScalarNode]:
    line = lines[index]
    return [
        cell(source, Place(index + 1, start + 1, start + 1), line[start:end])
        for start, end in _spans(line)
    ]


def _spans(line: str) -> list[tuple[int, int]]:
    r"""Return where the text of each cell starts and ends; a pipe in a cell is written ``\|``."""
    pipes = [match.start() for match in _PIPE.finditer(line) if match[0] == "|"]
    borders = [-1, *pipes, len(line)]
    spans = [(left + 1, right) for left, right in pairwise(borders)]
    if len(spans) > 1 and not line[slice(*spans[0])].strip():
        del spans[0]
    if len(spans) > 1 and not line[slice(*spans[-1])].strip():
        del spans[-1]
    return [_stripped(line, start, end) for start, end in spans]


def _stripped(line: str, start: int, end: int) -> tuple[int, int]:
    text = line[start:end]
    lead = len(text) - len(text.lstrip())
    # The place of an empty cell is after the blank that follows its pipe.
    return (start + lead, start + len(text.rstrip())) if text.strip() else (start + 1, start + 1)
