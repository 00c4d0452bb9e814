"""A small `make accuracy`: some tables, and few poses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from accuracy import ORACLE_LIMIT, TABLES, apart, line, measure
from oracle import FIFTY_DIGITS

from tools import require_tool

NAMED = ("planar_2r", "scara_rrpr", "puma560", "ur5", "franka_panda", "kuka_iiwa7")


@pytest.mark.parametrize("name", NAMED)
def test_every_kind_of_code_is_within_its_limit(name: str) -> None:
    require_tool("gcc")
    (table,) = (table for table in TABLES if table.stem == name)
    row = measure(table, poses=400, sample=20)
    assert len(row.errors) == 8
    # Whatever rounds is off by something: a figure of 0 would mean that nothing was compared.
    assert all(0.0 < error <= row.limit for error in row.errors.values())
    assert row.oracle <= ORACLE_LIMIT
    assert row.is_good
    assert not replace(row, oracle=1.0).is_good
    assert not replace(row, errors={"one": row.limit + 0.01}).is_good
    assert not replace(row, errors={"one": 1.0, "two": float("nan")}).is_good
    assert line(row.table, "1", "2", ["3"]).startswith(row.table)


def test_extended_numbers_are_compared_with_all_their_bits() -> None:
    third = np.array([np.longdouble(1) / 3])
    exact = FIFTY_DIGITS.array(["1"]) / 3
    assert 0.0 < apart(third, exact) < 2.0**-64
    assert apart(third.astype(np.float64), exact) > 2.0**-56
