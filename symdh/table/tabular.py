"""What CSV and Markdown share: a header, rows of cells, and settings written around them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symdh.table.headers import PARAMETERS, read_header
from symdh.table.markup import unmarked
from symdh.table.nodes import MAX_SCALAR, MappingNode, Node, ScalarNode, SequenceNode
from symdh.table.source import Place, Source
from symdh.table.suggest import did_you_mean

SETTINGS = ("name", "title", "convention", "units", "base", "tool", "values", "limits")
"""The keys of a table that may stand around its rows."""

MAX_ROWS = 500
MAX_CELLS = 100

_ALIKE = 0.75

Line = tuple[int, str]
"""A line of a file and its number, from 1."""


def is_setting(key: str) -> bool:
    """Tell a setting, rightly spelt or nearly so, from the other keys and words of a document."""
    return key in SETTINGS or did_you_mean(key, SETTINGS, likeness=_ALIKE) != ""


def cell(source: Source, place: Place, text: str, *, quoted: bool = False) -> ScalarNode:
    """Return a cell whose text starts at `place`, freed of markup.

    Raises
    ------
    TableError
        When the text is too long.
    """
    if len(text) > MAX_SCALAR:
        message = f"text has {len(text)} characters, over {MAX_SCALAR}"
        raise source.error(place, message)
    plain, offsets = unmarked(text)
    return ScalarNode(plain, place.line, place.column, quoted=quoted, offsets=offsets)


def parameters_named(texts: Iterable[str]) -> int:
    """Return how many of the four parameters some texts name as headers do."""
    return len({read_header(text).column for text in texts}.intersection(PARAMETERS))


def table_of(
    source: Source,
    settings: Sequence[tuple[ScalarNode, Node]],
    header: Sequence[ScalarNode],
    rows: Sequence[Sequence[ScalarNode]],
) -> MappingNode:
    """Return settings, header and rows as the nodes that the same table has in YAML.

    Raises
    ------
    TableError
        When a setting is given twice.
    """
    lines_of_keys: dict[str, int] = {}
    for key, _ in settings:
        first = lines_of_keys.setdefault(key.text, key.line)
        if first != key.line:
            message = f"{key.text} is given twice, on line {first} and on line {key.line}"
            raise source.error(key.place(), message)
    top = header[0]
    columns, body = (ScalarNode(key, top.line, top.column) for key in ("columns", "rows"))
    listed = SequenceNode(tuple(map(_sequence, rows)), top.line, top.column)
    items = (*settings, (columns, _sequence(header)), (body, listed))
    return MappingNode(items, top.line, top.column)


def refuse_size(source: Source, lines: Sequence[Line]) -> None:
    """Refuse lines of a table that are more, or have more cells, than any arm needs.

    Raises
    ------
    TableError
    """
    for count, (number, line) in enumerate(lines):
        place = Place(number, 1, 1)
        if count > MAX_ROWS:
            raise source.error(place, f"table has more than {MAX_ROWS} rows")
        if sum(map(line.count, ",;\t|")) > MAX_CELLS:
            raise source.error(place, f"line has more than {MAX_CELLS} cells")


def _sequence(cells: Sequence[ScalarNode]) -> SequenceNode:
    return SequenceNode(tuple(cells), cells[0].line, cells[0].column)
