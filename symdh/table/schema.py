"""The JSON Schema (draft-07) of a table, for editors that complete and check YAML."""

from __future__ import annotations

from importlib.resources import files

SCHEMA_FILE = "dh_table.schema.json"
"""The file name under which the starter table looks for the schema, beside itself."""


def schema_text() -> str:
    """Return the schema as JSON text."""
    return files("symdh.table").joinpath("schema.json").read_text(encoding="utf-8")
