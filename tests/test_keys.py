"""A key that is misspelt has one message: it is unknown, and not missing as well."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from symdh.errors import TableError
from symdh.table.axes import read_mechanism
from symdh.table.reader import read_table
from symdh.table.rotations import read_rotation_sheet
from symdh.table.source import Source, from_text

Reader = Callable[[Source], Any]

HEAD = "convention: standard\n"
CELLS = "theta: q, d: 0, a: 0, alpha: 0"
ROW = f"joints: [{{{CELLS}}}]\n"
COLUMNS, CELL_ROWS = "columns: [theta, d, a, alpha]\n", "rows: [[q, 0, 0, 0]]\n"
POINT, DIRECTION = "point: [0, 0, 0]", "direction: [0, 0, 1]"
AXIS = f"joints: [{{{POINT}, {DIRECTION}}}]\n"


def refused(reader: Reader, text: str) -> list[tuple[str, str]]:
    with pytest.raises(TableError) as caught:
        reader(from_text(text, "arm.yaml"))
    return [(f"{each.line}:{each.column}", each.message) for each in caught.value.diagnostics]


@pytest.mark.parametrize(
    ("reader", "text", "place", "right"),
    [
        (read_table, "convension: standard\n" + ROW, "1:1", "convention"),
        (read_table, "convension: standard\n" + COLUMNS + CELL_ROWS, "1:1", "convention"),
        (read_table, HEAD + ROW.replace("joints", "jonts"), "2:1", "joints"),
        (read_table, HEAD + ROW.replace("joints", "DH"), "2:1", "joints"),
        (read_table, HEAD + COLUMNS.replace("columns", "colums") + CELL_ROWS, "2:1", "columns"),
        (read_table, HEAD + COLUMNS + CELL_ROWS.replace("rows", "row"), "3:1", "rows"),
        (read_table, HEAD + ROW.replace("alpha", "alpah"), "2:33", "alpha"),
        (read_table, HEAD + ROW.replace("alpha", "twist"), "2:33", "alpha"),
        (read_mechanism, AXIS.replace("joints", "jonts"), "1:1", "joints"),
        (read_mechanism, AXIS.replace("point", "pont"), "1:11", "point"),
        (read_mechanism, AXIS.replace("direction", "Axis"), "1:29", "direction"),
        (read_mechanism, AXIS + "tool: {pont: [1, 0, 0]}\n", "2:8", "point"),
        (read_rotation_sheet, "rotaions: [Rx(1 deg) body]\n", "1:1", "rotations"),
        (read_rotation_sheet, "matrx: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n", "1:1", "matrix"),
    ],
)
def test_what_is_misspelt_is_not_missing(reader: Reader, text: str, place: str, right: str) -> None:
    ((at, message),) = refused(reader, text)
    assert at == place
    assert message.endswith(f"; did you mean {right}?")


@pytest.mark.parametrize(
    ("reader", "text", "unknown", "missing"),
    [
        (read_table, HEAD + "color: 1\n", "2:1", "joints is missing"),
        (read_table, HEAD + "color: 1\n" + COLUMNS, "2:1", "columns without rows"),
        (read_table, HEAD + "color: 1\n" + CELL_ROWS, "2:1", "rows without columns"),
        (read_table, "color: 1\n" + ROW, "1:1", "no convention is given"),
        (read_table, HEAD + ROW.replace("alpha", "color"), "2:33", "missing key alpha in row 1"),
        (read_table, HEAD + ROW.replace("a: 0, alpha", "alpah"), "2:27", "missing key a in row 1"),
        (read_mechanism, "color: 1\n", "1:1", "joints is missing"),
        (read_mechanism, AXIS.replace("point", "color"), "1:11", "missing key point in joint 1"),
        (read_mechanism, AXIS + "tool: {color: 1}\n", "2:8", "missing key point in tool"),
        (read_rotation_sheet, "color: 1\n", "1:1", "rotations is missing"),
    ],
)
def test_what_nothing_is_taken_for_is_missing_all_the_same(
    reader: Reader, text: str, unknown: str, missing: str
) -> None:
    found = refused(reader, text)
    assert len(found) == 2
    assert any(at == unknown and "unknown" in message for at, message in found)
    assert any(message.startswith(missing) for _, message in found)
