"""Tables: what a good one gives, and where a bad one is wrong."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
import time
from pathlib import Path

import jsonschema
import pytest
import yaml
from conftest import Runner
from sympy import Expr, Float, Integer, Rational, Symbol, cos, pi

from symdh.errors import Diagnostic, ReadError, Severity, TableError
from symdh.robot import (
    AngleUnit,
    Axis,
    Convention,
    JointType,
    LengthUnit,
    Limits,
    Motion,
    MotionKind,
    Robot,
    Units,
)
from symdh.table import (
    ANGLE,
    LENGTH,
    load_table,
    loads_table,
    parse_setting,
    symbol_dimension,
)
from symdh.table.headers import LABELS, PARAMETERS, TYPE, VARIABLE, column_name
from symdh.table.joint_type import TYPES
from symdh.table.near_pi import near_multiple
from symdh.table.reader import KEYS
from symdh.table.schema import SCHEMA_FILE, schema_text
from symdh.table.starter import STARTER
from symdh.table.units import ANGLE_UNITS, LENGTH_UNITS
from symdh.table.uses import dimensions_of_symbols

HEAD = "convention: standard\nname: arm\n"
ROW = "joints:\n  - {theta: q1, d: 0, a: 0, alpha: 0}\n"


def sym(name: str) -> Symbol:
    return Symbol(name, real=True)


def robot_of(text: str) -> Robot:
    """Load a table that must not even give a warning."""
    loaded = loads_table(text)
    assert loaded.warnings == ()
    return loaded.robot


def found_in(text: str | bytes) -> list[tuple[str, str]]:
    """Return the errors of a bad table as place and message."""
    with pytest.raises(TableError) as caught:
        loads_table(text, "arm.yaml")
    return [(f"{d.line}:{d.column}", d.message) for d in caught.value.diagnostics]


def rows(*joints: str) -> str:
    return HEAD + "joints:\n" + "".join(f"  - {{{joint}}}\n" for joint in joints)


# What a good table gives


def test_scara_of_the_design() -> None:
    robot = robot_of(
        """
        name: SCARA
        title: SCARA arm of exercise 3  # optional, printed as text
        convention: standard
        units: {angle: deg, length: mm}
        joints:
          - {theta: theta1, d: d1, a: a1, alpha: 0}
          - {theta: θ_2, d: 0,  a: a2, alpha: 0}
          - {theta: 0,      d: q3, a: 0,  alpha: 0}
          - {theta: 90 - q4,     d: d4, a: 0,  alpha: 180 deg}
        base: []
        tool: [Tx(a4), Rz(90 deg)]
        values: {a1: 250 mm, d1: 0.3 m, theta_1: 30 deg, a2: 200, θ2: 45}
        limits: {theta1: [-170 deg, 170], q3: [0, 150 mm]}
        """
    )
    assert (robot.name, robot.title) == ("SCARA", "SCARA arm of exercise 3")
    assert robot.convention is Convention.STANDARD
    assert robot.units == Units(AngleUnit.DEGREE, LengthUnit.MILLIMETRE)
    assert [joint.type.value for joint in robot.joints] == [
        "revolute",
        "revolute",
        "prismatic",
        "revolute",
    ]
    assert [v.name for v in robot.variables] == ["theta1", "theta2", "q3", "q4"]
    assert [p.name for p in robot.parameters] == ["d1", "a1", "a2", "d4", "a4"]
    assert robot.joints[3].theta == pi / 2 - sym("q4")
    assert robot.joints[3].alpha == pi
    assert robot.base == ()
    assert robot.tool == (
        Motion(MotionKind.TRANSLATION, Axis.X, sym("a4")),
        Motion(MotionKind.ROTATION, Axis.Z, pi / 2),
    )
    assert dict(robot.values) == {
        sym("a1"): 250,
        sym("d1"): 300,
        sym("theta1"): pi / 6,
        sym("a2"): 200,
        sym("theta2"): pi / 4,
    }
    assert dict(robot.limits) == {
        sym("theta1"): Limits(-17 * pi / 18, 17 * pi / 18),
        sym("q3"): Limits(Integer(0), Integer(150)),
    }


def test_homework_spelling_reads_the_same_as_rows() -> None:
    compact = robot_of(
        "name: arm\nconvention: modified\nunits: {angle: deg}\n"
        "columns: [i, α, 'a_{i-1}', d_i, θ, type]\n"
        "rows:\n  - [1, 0, 0, 0, θ₁, '']\n  - [2, 90, L1, 0, theta_2, revolute]\n"
    )
    plain = robot_of(
        "name: arm\nconvention: modified\nunits: {angle: deg}\njoints:\n"
        "  - {alpha: 0, a: 0, d: 0, theta: theta1}\n"
        "  - {alpha: 90 deg, a: L1, d: 0, theta: theta2}\n"
    )
    assert compact == plain


@pytest.mark.parametrize(
    ("header", "column"),
    [
        ("theta", "theta"),
        ("θ", "theta"),
        ("theta_i", "theta"),
        ("θᵢ", "theta"),
        ("$\\theta_i$", "theta"),
        ("alpha_{i-1}", "alpha"),
        ("alpha_i-1", "alpha"),
        ("αᵢ₋₁", "alpha"),
        ("$\\alpha_{i-1}$", "alpha"),
        ("a_{i-1}", "a"),
        ("a(i-1)", "a"),
        ("a_i", "a"),
        ("d_i", "d"),
        ("type", "type"),
        ("i", "i"),
        ("beta", None),
        ("a_j", None),
        ("type_i", None),
        ("", None),
    ],
)
def test_headers_of_columns(header: str, column: str | None) -> None:
    assert column_name(header) == column


@pytest.mark.parametrize(
    ("row", "kind", "variable"),
    [
        ("theta: q, d: 0, a: 0, alpha: 0", "revolute", "q"),
        ("theta: theta1, d: d1, a: 0, alpha: 0", "revolute", "theta1"),
        ("theta: 90 deg, d: d1, a: 0, alpha: 0", "prismatic", "d1"),
        ("theta: 0, d: 1/3, a: L, alpha: 0", "fixed", None),
        ("theta: phi, d: q1, a: 0, alpha: 0, type: prismatic", "prismatic", "q1"),
        ("theta: phi, d: q1, a: 0, alpha: 0, type: sliding", "prismatic", "q1"),
        ("theta: phi, d: q1, a: 0, alpha: 0, type: Linear", "prismatic", "q1"),
        ("theta: phi, d: q1, a: 0, alpha: 0, type: twisting", "revolute", "phi"),
        ("theta: phi, d: q1, a: 0, alpha: 0, type: fixed", "fixed", None),
        ("theta: phi, d: q1, a: 0, alpha: 0, variable: q1", "prismatic", "q1"),
        ("theta: phi + psi, d: 0, a: 0, alpha: 0, variable: psi", "revolute", "psi"),
        ("theta: theta1 + phi, d: 0, a: 0, alpha: 0", "revolute", "theta1"),
        ("theta: psi + phi, d: phi, a: 0, alpha: 0", "revolute", "psi"),
        ("theta: phi - 2*q1, d: 0, a: 0, alpha: 0", "revolute", "q1"),
        ("theta: 0, d: L3 + d3, a: L3, alpha: 0", "prismatic", "d3"),
    ],
)
def test_type_and_variable_are_read_off_the_row(row: str, kind: str, variable: str | None) -> None:
    (joint,) = robot_of(rows(row)).joints
    assert joint.type is JointType(kind)
    assert joint.variable == (sym(variable) if variable else None)


def test_motions_as_one_text() -> None:
    robot = robot_of(HEAD + ROW + 'base: "Rx(90 deg), Tz( 2*(h + 1) ) Ry(atan2(1, 1))"\n')
    assert robot.base == (
        Motion(MotionKind.ROTATION, Axis.X, pi / 2),
        Motion(MotionKind.TRANSLATION, Axis.Z, 2 * sym("h") + 2),
        Motion(MotionKind.ROTATION, Axis.Y, pi / 4),
    )


@pytest.mark.parametrize("written", ["Tx(a4) Rz(90 deg)", "Tx(a4)Rz(90 deg)", "Tx(a4) , Rz(pi/2)"])
def test_motions_in_a_row_need_no_gap(written: str) -> None:
    assert robot_of(HEAD + ROW + f'tool: "{written}"\n').tool == (
        Motion(MotionKind.TRANSLATION, Axis.X, sym("a4")),
        Motion(MotionKind.ROTATION, Axis.Z, pi / 2),
    )


def test_lengths_with_units_in_a_table_without() -> None:
    loaded = loads_table(rows("theta: q1, d: 300 mm, a: 0.2, alpha: 0"))
    assert loaded.robot.units.length is LengthUnit.METRE
    assert loaded.robot.joints[0].d == Rational(3, 10)
    (warning,) = loaded.warnings
    assert (warning.line, warning.column) == (4, 31)
    assert warning.severity is Severity.WARNING
    assert "read as metre" in warning.message


def test_a_table_without_any_unit_of_length_has_none() -> None:
    robot = robot_of(rows("theta: q1, d: 1/10, a: 0.2, alpha: 0"))
    assert robot.units.length is None
    assert (robot.joints[0].d, robot.joints[0].a) == (Rational(1, 10), Rational(1, 5))


def test_a_value_means_what_its_symbol_measures() -> None:
    robot = robot_of(
        HEAD + "units: {angle: deg, length: cm}\njoints:\n"
        "  - {theta: q1, d: k*h, a: L*cos(tilt), alpha: 2*beta}\n"
        "values: {beta: 30, tilt: 60, L: 0.2 m, h: 5, k: 2}\n"
    )
    values = {symbol.name: value for symbol, value in robot.values.items()}
    assert values == {"beta": pi / 6, "tilt": pi / 3, "L": 20, "h": 5, "k": 2}
    assert symbol_dimension(robot, sym("tilt")) == ANGLE
    assert symbol_dimension(robot, sym("q1")) == ANGLE
    assert symbol_dimension(robot, sym("h")) is None


@pytest.mark.parametrize("name", ["NO", "2R", "my arm", "a.b-c_d", "1e3", "null", "Double"])
def test_names_are_texts(name: str) -> None:
    assert robot_of(f"convention: standard\nname: {name}\n{ROW}").name == name


@pytest.mark.parametrize(
    ("filename", "name"),
    [
        ("dir/puma 560.yaml", "puma 560"),
        ("ärm.yaml", "robot"),
        ("double.yaml", "robot"),
        ("<stdin>", "robot"),
        ("-.yaml", "robot"),
    ],
)
def test_name_of_a_table_without_one(filename: str, name: str) -> None:
    assert loads_table("convention: standard\n" + ROW, filename).robot.name == name


def test_title_is_any_text() -> None:
    assert robot_of(HEAD + "title: '100% of_a#b & $x$ ~ ^ { } \\'\n" + ROW).title == (
        "100% of_a#b & $x$ ~ ^ { } \\"
    )


def test_missing_convention_is_a_warning() -> None:
    (warning,) = loads_table("name: arm\n" + ROW).warnings
    assert (warning.line, warning.column) == (1, 1)
    assert "standard (distal)" in warning.message


def test_keys_for_people_and_other_tools_are_left_alone() -> None:
    text = HEAD + "notes: |\n  two\n  lines\nx-plant: {cell: [1, 2]}\n" + ROW
    assert robot_of(text) == robot_of(HEAD + ROW)


@pytest.mark.parametrize("ending", ["\r\n", "\r"])
def test_line_ends_do_not_matter(ending: str) -> None:
    text = (HEAD + ROW).replace("\n", ending).encode()
    assert loads_table(text).robot == robot_of(HEAD + ROW)
    assert loads_table(b"\xef\xbb\xbf" + text).robot == robot_of(HEAD + ROW)


def test_no_floats_anywhere() -> None:
    robot = robot_of(rows("theta: q1 + 0.1 rad, d: 0.4318, a: 1e-3, alpha: 17.5 deg"))
    joint = robot.joints[0]
    assert not any(v.has(Float) for v in (joint.theta, joint.d, joint.a, joint.alpha))
    assert joint.alpha == Rational(175, 10) * pi / 180


# Where a bad table is wrong


@pytest.mark.parametrize(
    ("text", "where", "words"),
    [
        ("", "1:1", "empty"),
        ("# only a comment\n", "1:1", "empty"),
        ("---\n", "1:1", "empty"),
        ("- 1\n", "1:1", "top level must be a mapping"),
        ("arm\n", "1:1", "top level must be a mapping"),
        (HEAD + ROW + "---\n" + ROW, "5:1", "more than one document"),
        (HEAD + "joints:\n\t- {theta: q1}\n", "4:1", "a tab"),
        ("convention: standard\nname x\n" + ROW, "3:1", "missing `:`"),
        (HEAD + "title: a: b\n" + ROW, "3:9", "unexpected `:`"),
        (HEAD + "title: @x\n" + ROW, "3:8", "put it in quotes"),
        (HEAD + 'title: "a\\q"\n' + ROW, "3:11", "no escape"),
        (HEAD + 'title: "x\n' + ROW, "6:1", "quote opened on line 3, column 8 is not closed"),
        (HEAD + "joints:\n  - {theta: q1\nvalues: {}\n", "5:7", "missing , or }"),
        (HEAD + "columns: [a_{i-1}]\n", "3:13", "quote a text that holds"),
        (HEAD + "joints: &rows []\n", "3:9", "anchor &rows"),
        (HEAD + "joints: *rows\n", "3:9", "alias *rows"),
        (HEAD + "joints: !!python/name:os.system []\n", "3:9", "tag"),
        (HEAD + "base: {<<: 1}\n", "3:8", "merge key"),
        ("? [a]\n: 1\n", "1:3", "a key must be a text"),
        ("a: " + "[" * 50, "1:11", "nested deeper than 8"),
        ("".join(f"k{i}: 1\n" for i in range(30_000)), "9999:8", "more than 20000"),
        ("notes: " + "x" * 3000, "1:8", "3000 characters"),
        ("a: 1\nb: 2\na: 3\n", "3:1", "given twice, on line 1 and on line 3"),
        (HEAD + 'title: "a\\x00b"\n' + ROW, "3:8", "U+0000"),
        (HEAD + "title: a\u202eb\n" + ROW, "3:9", "U+202E RIGHT-TO-LEFT OVERRIDE"),
        (HEAD + "title: a\u2028b\n" + ROW, "3:9", "U+2028"),
        (HEAD + "title: a\x00b\n" + ROW, "3:9", "U+0000"),
        ("# ü\r\rname: Caf\xe9\n".encode("latin-1")[3:], "3:10", "byte 0xE9"),
        ("name: arm\n".encode("utf-16"), "1:1", "UTF-16"),
        ("name: arm\n".encode("utf-16-be"), "1:1", "UTF-16"),
        (b"#" * (1 << 20) + b"#", "1:1", "file is over 1 MiB"),
        ("#" * (1 << 20) + "#", "1:1", "text is over 1 MiB"),
        ("%YAML 2.0\n---\n" + HEAD + ROW, "1:1", "not YAML: found incompatible YAML document"),
    ],
)
def test_what_is_not_the_yaml_of_a_table(text: str | bytes, where: str, words: str) -> None:
    ((place, message),) = found_in(text)
    assert place == where
    assert words in message


@pytest.mark.parametrize(
    ("text", "where", "words"),
    [
        (HEAD, "1:1", "joints is missing"),
        (HEAD + "joints: []\n", "3:9", "joints is empty"),
        (HEAD + "joints:\n", "3:8", "joints is empty"),
        (HEAD + "joints: {theta: q1}\n", "3:9", "must be a list of rows"),
        (HEAD + "joints:\n  - q1\n", "4:5", "row 1 must be a mapping"),
        (HEAD + "rows: [[0]]\n", "3:7", "rows without columns"),
        (HEAD + "columns: [a]\n", "3:10", "columns without rows"),
        (HEAD + ROW + "rows: []\n", "5:7", "give the rows once"),
        (rows("theta: q1, d: 0, alpha: 0"), "4:5", "missing key a in"),
        (rows("theta: q1"), "4:5", "missing keys d, a, alpha"),
        (rows("thta: q1, theta: q1, d: 0, a: 0, alpha: 0"), "4:6", "did you mean theta?"),
        (rows("twist: 0, theta: q1, d: 0, a: 0, alpha: 0"), "4:6", "did you mean alpha?"),
        (rows("theta: q1, θ: q1, d: 0, a: 0, alpha: 0"), "4:17", "both are theta"),
        (rows("theta: q1, d: , a: 0, alpha: 0"), "4:19", "empty; write 0"),
        (rows("theta: [q1], d: 0, a: 0, alpha: 0"), "4:13", "not a list"),
        (rows("theta: {q1}, d: 0, a: 0, alpha: 0"), "4:13", "not a mapping"),
        (rows("theta: q1, d: 'L1 + 1/0', a: 0, alpha: 0"), "4:26", "division by zero"),
        (HEAD + "joints:\n  - theta: q1 +\n      q2\n", "4:12", "on one line"),
        (HEAD + "columns: [a, d, θ]\nrows: [[0, 0, q1]]\n", "3:10", "missing column alpha"),
        (HEAD + "columns: [a, d, θ, bet]\nrows: [[0, 0, q1, 0]]\n", "3:20", "column bet unknown"),
        (HEAD + "columns: [α, a, d, θ, alpha]\nrows: []\n", "3:23", "alpha is given twice"),
        (HEAD + "columns: [α, a, d, θ]\nrows:\n  - [0, 0]\n", "5:5", "2 cells, and there are 4"),
        (HEAD + "columns: [α, a, d, θ]\nrows:\n  - q1\n", "5:5", "row 1 must be a list"),
        (HEAD + "columns: 4\nrows:\n  - q1\n", "3:10", "columns must be a list"),
        (HEAD + "jonts: 3\n" + ROW, "3:1", "key jonts unknown; did you mean joints?"),
        (HEAD + "units: deg\n" + ROW, "3:8", "units must be a mapping"),
        (HEAD + "units: {angle: degrees}\n" + ROW, "3:16", "did you mean deg?"),
        (HEAD + "units: {length: metre}\n" + ROW, "3:17", "did you mean m?"),
        (HEAD + "units: {lenght: m}\n" + ROW, "3:9", "did you mean length?"),
        ("name: a\nconvention: craig\n" + ROW, "2:13", "did you mean modified?"),
        ("name: a\nconvention: distal\n" + ROW, "2:13", "did you mean standard?"),
        ("name: a\nconvention: x\n" + ROW, "2:13", "use standard or modified"),
        (rows("theta: q1, d: 0, a: 0, alpha: 90"), "4:36", "write 90 deg or pi/2"),
        (rows("theta: q1, d: 0, a: 0, alpha: 1 m"), "4:36", "this is a length"),
        (rows("type: rotary, theta: q1, d: 0, a: 0, alpha: 0"), "4:12", "did you mean revolute?"),
        (rows("theta: 0, d: 0, a: 0, alpha: 0, type: revolute"), "4:13", "joint 1 has no variable"),
        (rows("theta: q1, d: 0, a: 0, alpha: 0, type: prismatic"), "4:20", "has no variable"),
        (rows("theta: x + y, d: 0, a: 0, alpha: 0"), "4:13", "which symbol moves joint 1, x or y"),
        (rows("theta: x, d: 0, a: 0, alpha: 0, variable: y"), "4:48", "does not stand in theta"),
        (rows("theta: 0, d: 0, a: 0, alpha: 0, variable: y"), "4:48", "is fixed"),
        (rows("theta: 2*sin(q1), d: 0, a: 0, alpha: 0"), "4:19", "by itself or times a number"),
        (rows("theta: q1**2, d: 0, a: 0, alpha: 0"), "4:13", "by itself or times a number"),
        (rows("theta: sqrt(2)*q1, d: 0, a: 0, alpha: 0"), "4:21", "by itself or times"),
        (rows("theta: q1, d: 0, a: 0, alpha: q1"), "4:36", "q1 stands in alpha"),
        (rows("theta: q1, d: 2 + q1, a: 0, alpha: 0"), "4:24", "q1 stands in d"),
        (HEAD + ROW + "tool: [Tz(1), Rz(2*q1)]\n", "5:20", "cannot stand in base or tool"),
        (HEAD + ROW + "base: [Rw(1)]\n", "5:8", "the motions are Rx"),
        (HEAD + ROW + "base: [tx(1)]\n", "5:8", "did you mean Tx?"),
        (HEAD + ROW + "base: [Tx 1]\n", "5:8", "in parentheses"),
        (HEAD + ROW + "base: [Tx(1) Tz(2 + )]\n", "5:20", "ends early"),
        (HEAD + ROW + "base: {Tx: 1}\n", "5:7", "a motion such as Tx(a4)"),
        (HEAD + ROW + "values: {q2: 1 deg}\n", "5:10", "q2 is not in the table; did you mean q1?"),
        (HEAD + ROW + "values: {q1: q2}\n", "5:14", "a number is wanted here, and q2"),
        (HEAD + ROW + "values: {q1: 1 m}\n", "5:14", "this is a length"),
        (HEAD + ROW + "values: {q1: 0, q_1: 0}\n", "5:17", "both are q1"),
        (HEAD + ROW + "values: [q1]\n", "5:9", "must be a mapping"),
        (
            rows("theta: q1, d: p, a: 0, alpha: p") + "values: {p: 0}\n",
            "5:10",
            "as an angle and as",
        ),
        (HEAD + ROW + "limits: {q1: 3}\n", "5:14", "[lower, upper]"),
        (HEAD + ROW + "limits: {q1: [1 deg, -1 deg]}\n", "5:14", "lower limit is above"),
        (HEAD + ROW + "limits: {a1: [0, 1]}\n", "5:10", "a1 is not a joint variable"),
        (HEAD + ROW + "limits: {q1: [q1, 1 deg]}\n", "5:15", "a number is wanted here, and q1"),
        (HEAD + ROW + "values: {q1: [0]}\n", "5:14", "an expression is wanted here, not a list"),
        (HEAD + "columns: [theta, [d], a]\nrows: [[0]]\n", "3:18", "name of a column is wanted"),
        (HEAD + "columns: [theta, d, a, alpha]\nrows: 5\n", "4:7", "rows must be a list of rows"),
        ("name: arm\nconvention: [standard]\n" + ROW, "2:13", "a convention is wanted here"),
        (
            rows("theta: q1, d: 0, a: 0, alpha: 0", "theta: q2, d: q1, a: 0, alpha: 0"),
            "5:20",
            "joint variable q1 of joint 1 stands in d of joint 2",
        ),
        (
            HEAD + ROW + "tool: [" + "Tx(1), " * 51 + "]\n",
            "5:7",
            "tool has 51 motions, over 50",
        ),
        (HEAD + ROW + "tool: Tx(1) (2)\n", "5:13", "unexpected (; write motions as Tx(a4)"),
        (HEAD + ROW + "tool: Tx((1)\n", "5:13", "missing )"),
        (HEAD + "title: [x]\n" + ROW, "3:8", "a title is wanted here"),
        (HEAD + "title: " + "x" * 201 + "\n" + ROW, "3:8", "201 characters"),
        (HEAD + 'title: "a\\nb"\n' + ROW, "3:8", "one line"),
    ],
)
def test_what_is_wrong_with_a_table(text: str, where: str, words: str) -> None:
    found = found_in(text)
    assert where in [place for place, _ in found]
    assert words in dict(found)[where]


@pytest.mark.parametrize(
    ("decimal", "multiple"),
    [
        ("1.5708", Rational(1, 2)),
        ("-2.094", Rational(-2, 3)),
        ("12.5664", 4),
        ("13.08997", None),  # pi/6 over two turns
        ("1.55", None),
        ("0.001", None),
        ("3", None),
    ],
)
def test_what_a_decimal_may_stand_for(decimal: str, multiple: Expr | None) -> None:
    found = near_multiple(Rational(decimal))
    assert (found and found.multiple) == multiple


@pytest.mark.parametrize(
    ("row", "is_hinted"),
    [("0, 1, 5, 0, q1", True), ("0, q1, 0, q2, 0", False), ("0, 1, q1", False)],
)
def test_a_decimal_comma_is_suspected_between_numbers(row: str, is_hinted: bool) -> None:
    with pytest.raises(TableError) as caught:
        loads_table(f"{HEAD}columns: [alpha, a, d, theta]\nrows:\n  - [{row}]\n")
    (found,) = caught.value.diagnostics
    assert ("a decimal point is a point" in found.message) is is_hinted


@pytest.mark.parametrize(
    "name",
    [
        "'***'",
        "-rf",
        "..",
        "__init__",
        "'x */ int evil(void){} /*'",
        "'end\\'",
        "double",
        "class",
        "lambda",
        "con",
        "NUL",
        "'x '",
        "x.",
        "'7'",
        "''",
        "ärm",
        "[a]",
        "a" * 65,
        "'{{7*7}}'",
    ],
)
def test_names_that_cannot_name_a_file_or_a_function(name: str) -> None:
    found = found_in(f"convention: standard\nname: {name}\n{ROW}")
    assert [place for place, _ in found] == ["2:7"]


def test_two_joints_with_one_variable() -> None:
    row = "theta: q1, d: 0, a: 0, alpha: 0"
    ((place, message),) = found_in(rows(row, row))
    assert place == "5:13"
    assert "q1 already drives joint 1 (line 4)" in message


def test_at_most_two_hundred_joints() -> None:
    table = rows(*(f"theta: q{i}, d: 0, a: 0, alpha: 0" for i in range(201)))
    ((place, message),) = found_in(table)
    assert place == "204:5"
    assert "201 rows, over 200" in message


def test_all_errors_come_at_once_in_the_order_of_the_file() -> None:
    found = found_in(
        "limits: {q1: [1, -1]}\nname: double\nconvention: craig\njoints:\n"
        "  - {theta: q1, d: 1/0, a: 2 q, alpha: 90}\nvalues: {q1: x}\n"
    )
    places = [place for place, _ in found]
    assert places == ["1:14", "1:15", "1:18", "2:7", "3:13", "5:21", "5:30", "5:40", "6:14"]


def test_so_many_errors_that_it_stops() -> None:
    found = found_in("".join(f"key{i}: 1\n" for i in range(5000)))
    assert len(found) < 110
    assert "stopped after 100 errors" in found[-1][1]


def test_diagnostic_shows_the_line_and_the_character() -> None:
    with pytest.raises(TableError) as caught:
        loads_table(rows("theta: q1, d: '1/0', a: 0, alpha: 0"), "arm.yaml")
    (found,) = caught.value.diagnostics
    assert found == Diagnostic(
        message="division by zero",
        filename="arm.yaml",
        line=4,
        column=20 + 1,
        source="  - {theta: q1, d: '1/0', a: 0, alpha: 0}",
        caret=22,
    )
    assert found.source[found.caret - 1] == "/"


def test_an_unknown_name_is_no_news_where_an_expression_cannot_be_read() -> None:
    text = rows("theta: q1, d: 0, a: a1 +, alpha: 0") + "values: {b1: 1}\n"
    ((place, message),) = found_in(text)  # b1 could be what is missing after the +
    assert place == "4:30"
    assert "ends early" in message


def test_decimals_near_a_common_angle_are_a_warning_each() -> None:
    loaded = loads_table(rows("theta: 1.5708, d: q1, a: L1*sin(3.14159), alpha: 0"))
    assert loaded.robot.joints[0].theta == Rational(15708, 10_000)
    assert [(w.line, w.column, w.message[:14]) for w in loaded.warnings] == [
        (4, 13, "near pi/2 but "),
        (4, 38, "near pi but no"),
    ]


# Files


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    fifo = tmp_path / "pipe"
    os.mkfifo(fifo)
    missing = tmp_path / "missing.yaml"
    for path, words in (
        (missing, "no such file"),
        (tmp_path, "is a directory"),
        (fifo, "not a regular file"),
        (fifo / "below", "not a directory"),
        (Path("nul\0byte"), "not a file name"),
    ):
        with pytest.raises(ReadError, match=words) as caught:
            load_table(str(path))
        assert "\n" not in str(caught.value)
    with pytest.raises(ReadError, match="name of a file to read is empty"):
        load_table("")
    with pytest.raises(TableError, match=r"/dev/zero:1:1: file is over 1 MiB"):
        load_table("/dev/zero")


def test_standard_input() -> None:
    program = "from symdh.table import load_table; print(load_table('-').robot.name)"
    for text, name in ((HEAD + ROW, "arm"), ("convention: standard\n" + ROW, "robot")):
        done = subprocess.run(
            [sys.executable, "-c", program], input=text, capture_output=True, text=True, check=True
        )
        assert done.stdout == f"{name}\n"


def test_standard_input_that_cannot_be_read(run_symdh: Runner) -> None:
    closed = run_symdh("check", "-", preexec_fn=lambda: os.close(0))
    assert closed.returncode == 3
    assert closed.stderr.startswith("error: <stdin>: standard input is closed\n")

    def write_only() -> None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 0)

    unreadable = run_symdh("check", "-", preexec_fn=write_only)
    assert unreadable.returncode == 3
    assert unreadable.stderr.startswith("error: <stdin>: bad file descriptor\n")


def test_loading_is_quick() -> None:
    table = rows(*(f"theta: theta{i}, d: d{i}, a: a{i}, alpha: 90 deg" for i in range(1, 7)))
    loads_table(table)
    times = []
    for _ in range(5):
        begin = time.process_time()
        loads_table(table)
        times.append(time.process_time() - begin)
    assert min(times) < 0.01


# --set


def test_setting() -> None:
    robot = robot_of(
        HEAD + "units: {angle: deg, length: mm}\njoints:\n"
        "  - {theta: theta1, d: 0, a: a1, alpha: 0}\n"
    )
    assert symbol_dimension(robot, sym("a1")) == LENGTH
    assert parse_setting(robot, "θ_1 = 30") == (sym("theta1"), pi / 6)
    assert parse_setting(robot, "a1=0.5 m") == (sym("a1"), 500)
    for text, words in (
        ("a1", r"--set:1:3: missing ="),
        ("a2=1", r"--set:1:1: a2 is not in the table; did you mean a1\?"),
        ("a1=1 deg", r"--set:1:\d: this is an angle"),
        ("a1=1/0", r"--set:1:5: division by zero"),
        ("a1=", r"--set:1:\d: expression is empty"),
    ):
        with pytest.raises(TableError, match=f"^{words}"):
            parse_setting(robot, text)


# The schema and the starter


def test_starter_loads_without_a_word() -> None:
    robot = robot_of(STARTER)
    assert robot.n == 2
    assert STARTER.splitlines()[0] == f"# yaml-language-server: $schema={SCHEMA_FILE}"


def test_commented_parts_of_the_starter_load_too() -> None:
    before, after = STARTER.split("joints:\n")
    compact = after.split("has them:\n")[1].split("\n\n")[0].replace("# ", "")
    rest = after.split("\n\n", 2)[2]
    assert robot_of(f"{before}{compact}\n{rest}") == robot_of(STARTER)


def test_schema_accepts_the_tables_and_refuses_slips() -> None:
    schema = json.loads(schema_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    good = [STARTER, HEAD + ROW, HEAD + "columns: [α, a, d, θ]\nrows: [[0, 0, 0, q1]]\n"]
    for text in good:
        assert loads_table(text)
        assert list(validator.iter_errors(yaml.safe_load(text))) == []
    for bad in (
        HEAD,
        HEAD + ROW + "jonts: 1\n",
        HEAD + "joints: []\n",
        rows("theta: q1, d: 0, a: 0"),
        rows("theta: q1, d: 0, a: 0, alpha: 0, type: rotary"),
        HEAD + "units: {angle: degrees}\n" + ROW,
        HEAD + "tool: [Tw(1)]\n" + ROW,
    ):
        assert list(validator.iter_errors(yaml.safe_load(bad))) != []


def test_schema_knows_the_words_of_the_reader() -> None:
    schema = json.loads(schema_text())
    joint = schema["definitions"]["joint"]["properties"]
    units = schema["properties"]["units"]["properties"]
    assert set(schema["properties"]) == set(KEYS)
    assert set(joint) == {*PARAMETERS, "θ", "α", TYPE, VARIABLE, *LABELS}
    assert set(joint["type"]["enum"]) == set(TYPES)
    assert set(units["angle"]["enum"]) == set(ANGLE_UNITS)
    assert set(units["length"]["enum"]) == set(LENGTH_UNITS)


def test_a_name_may_stand_in_what_could_not_be_read() -> None:
    text = HEAD + ROW + "tool: [Tx(1), {Tx: h}]\nvalues: {h: 1}\n"
    ((place, message),) = found_in(text)
    assert place == "5:15"
    assert "a motion such as Tx(a4)" in message


def test_an_expression_that_measures_nothing_known_tells_of_angles_alone() -> None:
    a, b = sym("a"), sym("b")
    assert dimensions_of_symbols([(a + cos(2 * b), None)]) == {b: {ANGLE}}


def test_the_error_of_a_table_travels_between_processes_with_all_it_says() -> None:
    told = TableError(
        [Diagnostic("one", "a.yaml", 1, 2, "x", 1), Diagnostic("two", "a.yaml", 3, 4)]
    )
    back = pickle.loads(pickle.dumps(told))
    assert type(back) is TableError
    assert back.diagnostics == told.diagnostics
    assert str(back) == str(told)
