"""Outside text to a `Robot`: tables in YAML, CSV and Markdown, expressions, single numbers."""

from __future__ import annotations

from symdh.table.amounts import check_settings, with_values
from symdh.table.expression import parse_expression, parse_quantity
from symdh.table.point import parse_point
from symdh.table.reader import LoadedTable, read_table
from symdh.table.setting import parse_setting
from symdh.table.source import decode, from_text, read_source
from symdh.table.units import ANGLE, LENGTH, Dimension
from symdh.table.uses import symbol_dimension

__all__ = [
    "ANGLE",
    "LENGTH",
    "Dimension",
    "LoadedTable",
    "check_settings",
    "load_table",
    "loads_table",
    "parse_expression",
    "parse_point",
    "parse_quantity",
    "parse_setting",
    "symbol_dimension",
    "with_values",
]


def load_table(path: str) -> LoadedTable:
    """Read the table in the file at `path`; ``-`` is standard input.

    Raises
    ------
    TableError
        With all diagnostics, when the table is wrong.
    ReadError
        When the file cannot be read.
    """
    return read_table(read_source(path))


def loads_table(text: str | bytes, filename: str = "<string>") -> LoadedTable:
    """Read a table from its text; `filename` is the name that diagnostics show.

    Raises
    ------
    TableError
        With all diagnostics, when the table is wrong.
    """
    decoded = decode(text, filename) if isinstance(text, bytes) else from_text(text, filename)
    return read_table(decoded)
