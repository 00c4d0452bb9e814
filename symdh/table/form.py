"""The forms in which a table may be written: YAML, CSV, and Markdown."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PurePath

from symdh.table.csv_table import csv_nodes, is_csv
from symdh.table.markdown_table import is_markdown, markdown_nodes
from symdh.table.nodes import MappingNode, parse_nodes
from symdh.table.source import Source


@dataclass(frozen=True, slots=True)
class Form:
    """A form of tables.

    Attributes
    ----------
    endings : tuple of str
        Of file names.
    nodes : callable
        Returns the keys of a table and their values; a `TableError` when the text is not of this
        form.
    convention : str
        How one says the convention, for a message.
    """

    endings: tuple[str, ...]
    nodes: Callable[[Source], MappingNode]
    convention: str


YAML = Form(
    (".yaml", ".yml", ".json"),
    parse_nodes,
    "Write `convention: standard` or `convention: modified`",
)
CSV = Form(
    (".csv", ".tsv"),
    csv_nodes,
    "Write a line `# convention: standard` or `# convention: modified`, "
    "or name the columns a_i or a_{i-1}",
)
MARKDOWN = Form(
    (".md", ".markdown"),
    markdown_nodes,
    "Write `convention: standard` or `convention: modified` between lines of --- on top, "
    "or name the columns a_i or a_{i-1}",
)


def form_of(source: Source) -> Form:
    """Return the form of a table: the ending of its file tells it, or else its text."""
    ending = PurePath(source.filename).suffix.lower()
    for form in (YAML, CSV, MARKDOWN):
        if ending in form.endings:
            return form
    if is_markdown(source.text):
        return MARKDOWN
    return CSV if is_csv(source.text) else YAML
