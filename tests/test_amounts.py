"""Numbers that a table or a user gives to symbols, and what they make of the amounts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from conftest import Runner
from sympy import (
    Expr,
    Float,
    Integer,
    Rational,
    Symbol,
    atan,
    atan2,
    cos,
    nan,
    pi,
    sin,
    sqrt,
    tan,
    zoo,
)

from symdh.errors import TableError, UnsupportedError
from symdh.table import loads_table, with_values
from symdh.table.axes import read_mechanism
from symdh.table.rotations import read_rotation_sheet
from symdh.table.source import from_text

A, B, Q = (Symbol(name, real=True) for name in "abq")
HALF = Rational(1, 2)
TINY = Rational(1, 10**30)


@pytest.mark.parametrize(
    ("amount", "known", "found"),
    [
        (A + B, {A: HALF}, B + HALF),
        (A + B, {A: HALF, B: Integer(2)}, Rational(5, 2)),
        (Q, {A: HALF}, Q),
        (cos(A), {A: pi / 3}, HALF),
        (sqrt(A), {A: Integer(2)}, sqrt(2)),
        (1 / A, {A: Float(4)}, Float(0.25)),
        (A**-32, {A: Integer(10)}, Rational(1, 10**32)),
        (cos(A) ** 2 - A, {A: Integer(0)}, Integer(1)),
        # What is small on the way is not nothing.
        (atan2(1, A), {A: tan(TINY)}, atan2(1, tan(TINY))),
        (A / TINY, {A: sin(TINY)}, sin(TINY) / TINY),
        (sqrt(cos(A) ** 2 + sin(A) ** 2 - 1), {A: HALF}, sqrt(cos(HALF) ** 2 + sin(HALF) ** 2 - 1)),
    ],
)
def test_numbers_are_put_in(amount: Expr, known: Mapping[Symbol, Expr], found: Expr) -> None:
    assert with_values(amount, known) == found


@pytest.mark.parametrize(
    ("amount", "known", "message"),
    [
        (1 / (A - B), {A: HALF, B: HALF}, r"1/\(a - b\) infinite: a division by zero"),
        (Q + 1 / A, {A: Integer(0)}, r"make q \+ 1/a infinite"),
        (sqrt(A), {A: Integer(-4)}, r"make sqrt\(a\) equal to 2\*I, which is not a real number"),
        (Q + sqrt(A), {A: Integer(-4)}, r"equal to q \+ 2\*I, which is not a real number"),
        (atan(A / B), {A: HALF, B: Integer(0)}, r"make atan\(a/b\) infinite: a division by zero"),
        (atan(A / B), {B: Integer(0)}, r"make atan\(a/b\) infinite: a division by zero"),
        (A / B, {A: Integer(0), B: Integer(0)}, "make a/b infinite: a division by zero"),
        (A, {A: nan}, "make a infinite"),
        (A, {A: zoo}, "make a infinite"),
        (1 / (cos(A) ** 2 + sin(A) ** 2 - 1), {A: HALF}, r"- 1\) infinite: a division by zero"),
        (A**3, {A: -(Integer(10) ** 30)}, r"equal to -1.00e\+90, over the limit of 1e77"),
        (A**400, {A: Integer(2) ** 50}, r"make a\*\*400 a number of over 14,000 bits"),
        (A - B, {A: Rational(1, 2**7500), B: Integer(2) ** 7500}, "over 14,000 bits"),
        ((A + HALF) ** 7500, {A: Integer(0)}, "over 14,000 bits"),
    ],
)
def test_what_is_no_number_is_refused(
    amount: Expr, known: Mapping[Symbol, Expr], message: str
) -> None:
    with pytest.raises(UnsupportedError, match=message):
        with_values(amount, known)


HEAD = "convention: standard\nunits: {angle: rad, length: m}\n"
ROWS = "joints: [{theta: q1, d: 0, a: L - 1, alpha: 0}]\n"


@pytest.mark.parametrize(
    ("text", "places"),
    [
        (ROWS.replace("L - 1", "sqrt(L - 1)"), ["3:31"]),
        (ROWS.replace("L - 1", "1/(L - 0.5)"), ["3:31"]),
        (ROWS.replace("q1", "q1 + 1/(L - 0.5)"), ["3:18"]),
        (ROWS.replace("L - 1", "1/(L - 0.5)").replace("d: 0", "d: sqrt(-L)"), ["3:25", "3:38"]),
        (ROWS + "tool: [Tx(L), Tz(sqrt(-L))]\n", ["4:18"]),
        (ROWS.replace("L - 1", "q"), None),
        (ROWS, None),
    ],
)
def test_the_values_of_a_table_make_numbers_of_its_cells(
    text: str, places: list[str] | None
) -> None:
    table = f"{HEAD}{text}values: {{L: 0.5}}\n" if "L" in text else HEAD + text
    if places is None:
        assert loads_table(table).robot.n == 1
        return
    with pytest.raises(TableError) as refused:
        loads_table(table)
    found = refused.value.diagnostics
    assert [f"{each.line}:{each.column}" for each in found] == places
    assert all(each.message.startswith("these values make ") for each in found)


def test_the_values_of_axes_and_rotations_make_numbers_too() -> None:
    axes = "joints: [{point: [0, 0, 1/L], direction: [0, 0, 1]}]\nvalues: {L: 0}\n"
    with pytest.raises(TableError, match="infinite") as refused:
        read_mechanism(from_text(axes, "axes.yaml"))
    assert [(each.line, each.column) for each in refused.value.diagnostics] == [(1, 25)]
    sheet = "units: {angle: rad}\nrotations: [Rx(acos(u)) body]\nvalues: {u: 2}\n"
    with pytest.raises(TableError, match="not a real number") as refused:
        read_rotation_sheet(from_text(sheet, "turns.yaml"))
    assert [(each.line, each.column) for each in refused.value.diagnostics] == [(2, 16)]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("L=0.5", "these values make sqrt(L - 1) equal to sqrt(2)*I/2, which is not a real number"),
        ("d=1e30", "these values make d**3 equal to 1.00e+90, over the limit of 1e77"),
    ],
)
@pytest.mark.parametrize("command", ["eval", "ik", "draw"])
def test_numbers_that_a_user_sets_are_judged_too(
    command: str, given: str, message: str, tmp_path: Path, run_symdh: Runner
) -> None:
    row = "{theta: q1, d: d^3, a: sqrt(L - 1), alpha: 0}"
    (tmp_path / "arm.yaml").write_text(f"{HEAD}joints: [{row}]\n")
    done = run_symdh(command, "arm.yaml", "--set", given, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr == f"error: {message}\n"
    assert not done.stdout
