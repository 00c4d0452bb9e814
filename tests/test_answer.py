"""``symdh answer``: what is right, whatever its form; what is wrong, and by which slip."""

from __future__ import annotations

import csv
import io
import json
import math
import re
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import sympy as sp
from oracle import read_arm_file

from symdh.cli.main import run
from symdh.errors import TableError, UnsupportedError
from symdh.kinematics.answers import JudgedClaim, JudgedSheet, circle, judge
from symdh.kinematics.answers.circle import UndecidedError, _known_values, equal_in_ring
from symdh.kinematics.answers.equality import Sameness, compare
from symdh.kinematics.answers.figures import Written
from symdh.kinematics.answers.numbers import value
from symdh.notation.short_names import ShortNames
from symdh.robot import Robot
from symdh.table import load_table, loads_table
from symdh.table.answers import blank_answers, read_answers
from symdh.table.source import from_text

EXAMPLES = Path(__file__).parent.parent / "examples"
Runner = Callable[..., Any]

#: Offsets, a slide with one, a base and a tool; nothing in examples/ has them all.
WITH_OFFSETS = """\
name: offsets
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: q1, d: d1, a: 0, alpha: 90 deg}
  - {theta: 90 deg - q2, d: 0, a: a2, alpha: 0}
  - {theta: 0, d: q3 + 0.25, a: 0, alpha: 90 deg}
base: [Tz(h)]
tool: [Tx(b)]
"""
TABLES = {path.stem: path.read_text(encoding="utf-8") for path in sorted(EXAMPLES.glob("*.yaml"))}
TABLES["offsets"] = WITH_OFFSETS
TABLES["planar_2r_p"] = TABLES["planar_2r"].replace(", theta1: 30 deg, theta2: 45 deg", "")

# -- matrices worked out here, by multiplying elementary ones --------------------------------------

S = {
    name: sp.Symbol(name, real=True)
    for name in (
        *(f"theta{k}" for k in range(1, 7)),
        *("q1", "q2", "q3", "q4", "a1", "a2", "a3", "d1", "d2", "d3", "d4", "d6", "h", "b"),
    )
}
RIGHT_ANGLE = sp.pi / 2


def turn(axis: str, angle: Any) -> sp.Matrix:
    c, s = sp.cos(angle), sp.sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = sp.eye(4)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def shift(axis: str, length: Any) -> sp.Matrix:
    matrix = sp.eye(4)
    matrix["xyz".index(axis), 3] = length
    return matrix


def standard(theta: Any, d: Any, a: Any, alpha: Any) -> sp.Matrix:
    return turn("z", theta) * shift("z", d) * shift("x", a) * turn("x", alpha)


def modified(theta: Any, d: Any, a: Any, alpha: Any) -> sp.Matrix:
    return turn("x", alpha) * shift("x", a) * turn("z", theta) * shift("z", d)


STANFORD = (
    (S["theta1"], S["d1"], 0, -RIGHT_ANGLE),
    (S["theta2"], S["d2"], 0, RIGHT_ANGLE),
    (0, S["d3"], 0, 0),
    (S["theta4"], 0, 0, -RIGHT_ANGLE),
    (S["theta5"], 0, 0, RIGHT_ANGLE),
    (S["theta6"], S["d6"], 0, 0),
)
PUMA = (
    (S["theta1"], S["d1"], 0, RIGHT_ANGLE),
    (S["theta2"], 0, S["a2"], 0),
    (S["theta3"], S["d3"], S["a3"], -RIGHT_ANGLE),
    (S["theta4"], S["d4"], 0, RIGHT_ANGLE),
    (S["theta5"], 0, 0, -RIGHT_ANGLE),
    (S["theta6"], 0, 0, 0),
)
SCARA = (
    (S["q1"], S["d1"], S["a1"], 0),
    (S["q2"], 0, S["a2"], 0),
    (0, S["q3"], 0, 0),
    (S["q4"], S["d4"], 0, sp.pi),
)
PLANAR = ((S["theta1"], 0, S["a1"], 0), (S["theta2"], 0, S["a2"], 0))
RRP = (
    (S["theta1"], 0, 0, 0),
    (S["theta2"], 0, 0, RIGHT_ANGLE),
    (0, S["d3"], S["a2"], RIGHT_ANGLE),
)
SLIDE = S["q3"] + sp.Rational(1, 4)
OFFSETS = (
    (S["q1"], S["d1"], 0, RIGHT_ANGLE),
    (RIGHT_ANGLE - S["q2"], 0, S["a2"], 0),
    (0, SLIDE, 0, RIGHT_ANGLE),
)


def chain(rows: Sequence[Sequence[Any]], link: Callable[..., sp.Matrix] = standard) -> sp.Matrix:
    product = sp.eye(4)
    for row in rows:
        product = product * link(*row)
    return product


def changed(rows: Sequence[Sequence[Any]], row: int, **cells: Any) -> tuple[tuple[Any, ...], ...]:
    """Return rows with some cells of one of them, counted from 1, replaced."""
    names = ("theta", "d", "a", "alpha")
    new = tuple(cells.get(name, old) for name, old in zip(names, rows[row - 1], strict=True))
    return (*(tuple(r) for r in rows[: row - 1]), new, *(tuple(r) for r in rows[row:]))


def block(name: str, matrix: sp.Matrix) -> str:
    """Write a matrix as an answer, products multiplied out as sympy prints them."""
    rows = [
        ", ".join(f"'{sp.expand(matrix[r, c])}'" for c in range(matrix.cols))
        for r in range(matrix.rows)
    ]
    return f"'{name}':\n" + "".join(f"  - [{row}]\n" for row in rows)


# -- the sheets ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Case:
    """An answer sheet.

    `wrong` has the verdict of each entry that is not right, by its claim and its label; all others
    must be right. `hints` has a piece of the hint of each claim that has one.
    """

    name: str
    table: str
    answers: str
    wrong: dict[tuple[str, str], str] = field(default_factory=dict)
    hints: dict[str, str] = field(default_factory=dict)


def slip(name: str, table: str, key: str, matrix: sp.Matrix, hint: str) -> Case:
    """Return a sheet whose one matrix comes of a slip; which entries it spoils is left open."""
    return Case(name, table, block(key, matrix), {(key, "*"): "*"}, {key: hint})


DEGREE = 180 / math.pi
C, SN = sp.cos, sp.sin
T1, T2 = S["theta1"], S["theta2"]

CASES = [
    # right, in other forms than the textbook's
    Case(
        "angle sums expanded, double and half angles, tangents",
        "planar_2r",
        """
        T02:
          - [c1*c2 - s1*s2, -sin(theta1)*c2 - c1*sin(theta2), 0, a1*c1 + a2*(c1*c2 - s1*s2)]
          - [tan(theta1 + theta2)*c12, "(1 - s12**2)/c12", 0, "s1*(a1 + a2*c2) + c1*a2*s2"]
          - [0, 0, 1, 0]
        A1[1,1]: 2*cos(theta1/2)**2 - 1
        A1[2,1]: 2*sin(theta1/2)*cos(theta1/2)
        A1[1,2]: cos(theta1 + 90 deg)
        A1[2,2]: sin(theta1 + 450 deg)
        A1[1,4]: a1*(cos(theta1 + 30 deg)*sqrt(3)/2 + sin(theta1 + 30 deg)/2)
        A1[2,4]: -a1*sin(-theta1)
        """,
    ),
    Case("every spelling of a name", "planar_2r", """
        A_1: [[C1, -S1, 0, a_1*c1], [s_1, c_1, 0, a1*S1], [0, 0, 1, 0], [0, 0, 0, 1]]
        0T2[1,4]: a1*c_{1} + a2*c_{12}
        "T(0, 2).py": a1*sin(θ1) + a2*s_12
        ⁰T₂[1,1]: c12
        T0_2.R: [[c12, -s12, 0], [s12, c12, 0], [0, 0, 1]]
        p: [a1*c1 + a2*c12, a1*s1 + a2*s12, 0]
        r21: s12
        """),
    Case("the whole PUMA, multiplied out", "puma560", block("pose", chain(PUMA))),
    Case("the wrist of the PUMA", "puma560", block("3T6", chain(PUMA[3:]))),
    Case("the whole Stanford arm, multiplied out", "stanford", block("T06", chain(STANFORD))),
    Case("the SCARA arm, multiplied out", "scara", block("T(0,4)", chain(SCARA))),
    Case("a modified table", "rrp_modified", block("2T3", modified(*RRP[2]))
         + block("03T", chain(RRP, modified))),
    Case("base, tool and offsets", "offsets", block("pose", shift("z", S["h"]) * chain(OFFSETS)
         * shift("x", S["b"])) + block("A3", standard(*OFFSETS[2]))),
    Case("the way back", "planar_2r", block("T20", chain(PLANAR).inv())),
    Case("with the table's numbers for the lengths", "planar_2r", "px: 0.5*c1 + 2/5*c12"),
    Case("parameters by their index", "puma560",
         "A2[1,4]: a2*c2\nA4[3,4]: d4\nA1[3,2]: sin(alpha1)"),
    Case("a Jacobian", "planar_2r", """
        J:
          - [-a1*s1 - a2*s12, -a2*s12]
          - [a1*c1 + a2*c12, a2*c12]
          - [0, 0]
          - [0, 0]
          - [0, 0]
          - [1, 1]
        """),
    Case("rows read off a figure", "planar_2r_modified", """
        columns: [a, alpha, theta, d]
        rows: [[0, 0, theta1, 0], [a1, 360 deg, theta_2, 0]]
        """),
    Case("rows of another choice of frames", "planar_2r", """
        rows:
          - {theta: theta1 + 180 deg, d: 0, a: -a1, alpha: 0}
          - {theta: theta2 - 180 deg, d: 0, a: a2, alpha: 0}
        """, hints={"rows": "another choice of frames"}),
    # right in numbers: by hand, x = 0.5 cos 30 + 0.4 cos 75 and y = 0.5 sin 30 + 0.4 sin 75
    Case("numbers, rounded, cut and exact", "planar_2r", """
        numbers:
          px: 0.53654
          py: 0.636
          T02[1,1]: 0.258
          T02[2,2]: 0.2588
          r21: cos(15 deg)
          T01[1,1]: sqrt(3)/2
          p: [536.5 mm, 63.637 cm, 0]
        """),
    Case("numbers at other values", "planar_2r", """
        numbers: {at: {theta1: 60 deg, theta2: 30, a1: 1}, px: 0.500, py: 1.266}
        """),
    # wrong in one entry
    Case("signs", "planar_2r", "px: -a1*c1 - a2*c12\npy: a1*s1 - a2*s12\nA1[1,2]: s1",
         {("px", "[1,4]"): "SIGN", ("py", "[2,4]"): "SIGN", ("A1[1,2]", "[1,2]"): "SIGN"}),
    Case("sine and cosine swapped", "puma560", """
        A2[1,4]: a2*s2
        T12[2,4]: a2*cos(theta2)
        A1[1,1]: s1
        r33: c23*c4*s5 + s23*s5
        T02[1,4]: a2*s1*c2
        """,
         {("A2[1,4]", "[1,4]"): "SWAPPED", ("T12[2,4]", "[2,4]"): "SWAPPED",
          ("A1[1,1]", "[1,1]"): "SWAPPED", ("r33", "[3,3]"): "*",
          ("T02[1,4]", "[1,4]"): "SWAPPED"}),
    Case("an angle that is not the sum", "planar_2r", "px: a1*c1 + a2*c2",
         {("px", "[1,4]"): "WRONG"}),
    Case("a rounded number in a formula", "planar_2r",
         "T01[1,4]: a1*(0.866*cos(theta1 + 30 deg) + sin(theta1 + 30 deg)/2)",
         {("T01[1,4]", "[1,4]"): "COARSE"}),
    Case("blanks are no mistakes, and not right", "planar_2r",
         "p: [_, a1*s1 + a2*s12, 0]\npx: ''",
         {("p", "[1,4]"): "BLANK", ("px", "[1,4]"): "BLANK"}),
    Case("numbers rounded too coarsely", "planar_2r",
         "numbers: {px: 0.54, py: 0.641, r11: 0.3, r21: 0.96}",
         {("px in numbers", "[1,4]"): "COARSE", ("py in numbers", "[2,4]"): "COARSE",
          ("r11 in numbers", "[1,1]"): "COARSE", ("r21 in numbers", "[2,1]"): "COARSE"}),
    Case("a number with the wrong sign, and one in millimetres", "planar_2r",
         "numbers: {r12: 0.9659, px: 536.5}",
         {("r12 in numbers", "[1,2]"): "SIGN", ("px in numbers", "[1,4]"): "WRONG"}),
    # slips in a row's matrix
    slip("other convention, one link", "stanford", "A1", modified(*STANFORD[0]), "modified"),
    slip("other convention, modified table", "rrp_modified", "A3", standard(*RRP[2]), "standard"),
    slip("alpha and theta exchanged", "puma560", "A1",
         standard(RIGHT_ANGLE, S["d1"], 0, T1),
         "alpha and theta of row 1 exchanged"),
    slip("a and d exchanged", "puma560", "A2", standard(T2, S["a2"], 0, 0),
         "a and d of row 2 exchanged"),
    slip("offset in theta forgotten", "offsets", "A2", standard(-S["q2"], 0, S["a2"], 0),
         "the offset in theta of row 2 is forgotten"),
    slip("offset in d forgotten", "offsets", "A3", standard(0, S["q3"], 0, RIGHT_ANGLE),
         "the offset in d of row 3 is forgotten"),
    slip("twist with the wrong sign", "stanford", "A2", standard(T2, S["d2"], 0, -RIGHT_ANGLE),
         "alpha of row 2 has the wrong sign"),
    slip("d forgotten", "puma560", "A1", standard(T1, 0, 0, RIGHT_ANGLE),
         "d of row 1 is forgotten"),
    slip("a forgotten", "scara", "A2", standard(S["q2"], 0, 0, 0), "a of row 2 is forgotten"),
    slip("rows off by one", "puma560", "A3", standard(S["theta3"], S["d3"], S["a2"], 0),
         "those of row 2: off by one row"),
    slip("another row's matrix", "stanford", "A4", standard(*STANFORD[4]), "this is A5"),
    slip("transposed", "puma560", "A3", standard(*PUMA[2]).T, "transposed"),
    slip("rotation transposed", "minimover_5r", "A1", turn("z", T1).T, "*"),
    slip("inverted", "scara", "A1", standard(*SCARA[0]).inv(), "A1 inverted"),
    # slips in a pose
    slip("pose in the other convention", "stanford", "T06", chain(STANFORD, modified),
         "read in the modified convention"),
    slip("alpha and theta exchanged everywhere", "scara", "pose",
         chain([(alpha, d, a, theta) for theta, d, a, alpha in SCARA]),
         "alpha and theta exchanged in every row"),
    slip("one offset forgotten in the pose", "offsets", "T03",
         chain(changed(OFFSETS, 3, d=S["q3"])), "the offset in d of row 3 is forgotten"),
    slip("all offsets forgotten", "offsets", "T03",
         chain(changed(changed(OFFSETS, 3, d=S["q3"]), 2, theta=-S["q2"])),
         "the offsets are forgotten"),
    slip("base forgotten", "offsets", "pose", chain(OFFSETS) * shift("x", S["b"]),
         "the base is forgotten"),
    slip("tool forgotten", "planar_2r_modified", "pose",
         turn("z", T1) * shift("x", S["a1"]) * turn("z", T2), "the tool is forgotten"),
    slip("a d forgotten on the way", "puma560", "T03", chain(changed(PUMA, 3, d=0)[:3]),
         "d of row 3 is forgotten"),
    slip("one frame too few", "puma560", "T03", chain(PUMA[:2]), "this is T(0, 2)"),
    slip("wrong order", "planar_2r", "T02", chain(PLANAR[::-1]),
         "A1 and A2 multiplied in the wrong"),
    slip("reverse order", "puma560", "T03", chain(PUMA[2::-1]), "reverse order"),
    slip("pose inverted", "scara", "T02", chain(SCARA[:2]).inv(), "inverted"),
    Case("halves of the Jacobian exchanged", "planar_2r",
         "J: [[0, 0], [0, 0], [1, 1], [-a1*s1 - a2*s12, -a2*s12], "
         "[a1*c1 + a2*c12, a2*c12], [0, 0]]",
         {("J", "*"): "*"}, {"J": "angular velocity stands above"}),
    # slips in rows
    Case("alpha and theta exchanged in a row", "puma560", """
        rows:
          - {theta: 90 deg, d: d1, a: 0, alpha: theta1}
          - {theta: theta2, d: 0, a: a2, alpha: 0}
          - {theta: theta3, d: d3, a: a3, alpha: -90}
          - {theta: theta4, d: d4, a: 0, alpha: 90}
          - {theta: theta5, d: 0, a: 0, alpha: -90}
          - {theta: theta6, d: 0, a: 0, alpha: 0}
        """,
         {("rows", "theta of row 1"): "WRONG", ("rows", "alpha of row 1"): "WRONG"},
         {"rows": "alpha and theta of row 1 exchanged"}),
    Case("a row with a sign and an offset", "offsets", """
        rows:
          - {theta: q1, d: d1, a: 0, alpha: -90}
          - {theta: -q2, d: 0, a: a2, alpha: 0}
          - {theta: 0, d: 0.25 + q3, a: 0, alpha: 90}
        """,
         {("rows", "alpha of row 1"): "SIGN", ("rows", "theta of row 2"): "WRONG"},
         {"rows": "the offset in theta of row 2 is forgotten"}),
    Case("rows written for the other convention", "rrp_modified", """
        rows:
          - {theta: theta1, d: 0, a: 0, alpha: 90 deg}
          - {theta: theta2, d: 0, a: a2, alpha: 90 deg}
          - {theta: 0, d: d3, a: 0, alpha: 0}
        """,
         {("rows", "alpha of row 1"): "WRONG", ("rows", "a of row 2"): "WRONG",
          ("rows", "a of row 3"): "WRONG", ("rows", "alpha of row 3"): "WRONG"},
         {"rows": "one row off, as in the standard convention"}),
    Case("a row missing", "planar_2r", "rows: [{theta: theta1, d: 0, a: a1, alpha: 0}]",
         {("rows", f"{name} of row 2"): "BLANK" for name in ("theta", "d", "a", "alpha")},
         {"rows": "2 rows, and here are 1"}),
]  # fmt: skip


def judged(table: str, answers: str) -> JudgedSheet:
    robot = loads_table(TABLES[table], f"{table}.yaml").robot
    return judge_text(robot, answers)


def judge_text(robot: Robot, answers: str) -> JudgedSheet:
    return judge(robot, read_answers(from_text(answers, "a.yaml"), robot, ShortNames(robot)))


def dedented(text: str) -> str:
    lines = text.split("\n")
    margin = min((len(x) - len(x.lstrip()) for x in lines[1:] if x.strip()), default=0)
    return "\n".join([lines[0], *(x[margin:] for x in lines[1:])])


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_sheet_is_judged_as_it_deserves(case: Case) -> None:
    sheet = judged(case.table, dedented(case.answers))
    assert sheet.total > 0
    for claim in sheet.claims:
        spoilt = (claim.name, "*") in case.wrong
        if spoilt:
            assert claim.right < len(claim.entries), claim.name
        for each in claim.entries:
            expected = case.wrong.get((claim.name, each.label), "RIGHT")
            assert spoilt or expected in ("*", each.verdict.name), (claim.name, each)
        wanted = case.hints.get(claim.name)
        assert wanted == "*" or (wanted or "") in claim.hint, claim.hint
        assert bool(wanted) or not claim.hint, claim.hint


def test_there_are_sheets_enough() -> None:
    assert len(CASES) >= 30
    assert len({case.table for case in CASES}) >= 6


# -- numbers against the oracle --------------------------------------------------------------------


@pytest.mark.parametrize("name", ["puma560", "stanford", "scara", "ur5"])
def test_numeric_poses_are_those_of_the_oracle(name: str) -> None:
    arm = read_arm_file_of(name)
    at = {variable: 0.3 + 0.2 * k for k, (variable, _) in enumerate(arm.variables)}
    pose = arm.pose(at)
    rows = [[f"{float(x):.6f}" for x in row] for row in pose[:3]]
    robot = loads_table(TABLES[name]).robot
    turning = {variable for variable, turns in arm.variables if turns}
    given = ", ".join(f"{v}: {x} {'rad' if v in turning else 'm'}" for v, x in at.items())
    text = f"numbers:\n  at: {{{given}}}\n  pose: {json.dumps(rows)}\n"
    sheet = judge_text(robot, text)
    assert sheet.right == sheet.total == 12


@pytest.mark.parametrize("name", ["puma560", "ur5"])
@pytest.mark.parametrize(
    ("factor", "hint"), [(DEGREE, "degrees taken for radians"), (1 / DEGREE, "radians taken for")]
)
def test_the_wrong_unit_of_angles_is_named(name: str, factor: float, hint: str) -> None:
    arm = read_arm_file_of(name)
    at = {variable: 0.35 + 0.2 * k for k, (variable, _) in enumerate(arm.variables)}
    pose = arm.pose({variable: x * factor for variable, x in at.items()})
    rows = [[f"{float(x):.6f}" for x in row] for row in pose[:3]]
    given = ", ".join(f"{v}: {x} rad" for v, x in at.items())
    robot = loads_table(TABLES[name]).robot
    text = f"numbers:\n  at: {{{given}}}\n  pose: {json.dumps(rows)}\n"
    (claim,) = judge_text(robot, text).claims
    assert claim.right < 12
    assert hint in claim.hint


def read_arm_file_of(name: str) -> Any:
    """Read an example in the long spelling, which is the only one that the oracle knows."""
    from symdh.render.table_yaml import table_yaml

    path = EXAMPLES / f"{name}.yaml"
    if "\ncolumns:" in path.read_text(encoding="utf-8"):
        from oracle import read_arm

        return read_arm(table_yaml(load_table(str(path)).robot))
    return read_arm_file(path)


# -- the ring --------------------------------------------------------------------------------------

X, Y = sp.symbols("x y", real=True)
ODD = 37 * sp.pi / 180
IDENTITIES = [
    (sp.sin(X) ** 2 + sp.cos(X) ** 2, sp.Integer(1)),
    (sp.cos(X + Y), sp.cos(X) * sp.cos(Y) - sp.sin(X) * sp.sin(Y)),
    (sp.sin(3 * X), 3 * sp.sin(X) - 4 * sp.sin(X) ** 3),
    (sp.tan(X) / (1 + sp.tan(X) ** 2), sp.sin(2 * X) / 2),
    (sp.cos(X - sp.pi / 3), sp.cos(X) / 2 + sp.sqrt(3) * sp.sin(X) / 2),
    (sp.cos(X + sp.pi / 12) * 4,
     (sp.sqrt(6) + sp.sqrt(2)) * sp.cos(X) - (sp.sqrt(6) - sp.sqrt(2)) * sp.sin(X)),
    (sp.sin(X / 2) ** 2, (1 - sp.cos(X)) / 2),
    (sp.sqrt(X**2 + Y * (Y + 2 * X)) ** 3, sp.sqrt(X**2 + 2 * X * Y + Y**2) * (X + Y) ** 2),
    (1 / (X + Y) - 1 / (X - Y), -2 * Y / (X**2 - Y**2)),
    (sp.sqrt(2) * sp.sqrt(3) * X, sp.sqrt(6) * X),
    ((sp.sqrt(2) + sp.sqrt(3)) ** 2 * X, (5 + 2 * sp.sqrt(2) * sp.sqrt(3)) * X),
    ((sp.sqrt(5) * X + sp.sqrt(7)) * (sp.sqrt(5) * X - sp.sqrt(7)), 5 * X**2 - 7),
    (sp.atan2(Y * 2, X + X), sp.atan2(Y + Y, 2 * X)),
    (sp.cos(ODD + X), sp.cos(ODD) * sp.cos(X) - sp.sin(ODD) * sp.sin(X)),
]  # fmt: skip


@pytest.mark.parametrize(("left", "right"), IDENTITIES, ids=lambda e: str(e))
def test_the_ring_proves_identities(left: sp.Expr, right: sp.Expr) -> None:
    assert equal_in_ring(left, right)
    assert not equal_in_ring(left, right + X)
    assert not equal_in_ring(left, -right)


def test_functions_of_different_arguments_are_different_letters() -> None:
    first, second = sp.atan2(Y, X), sp.atan2(X, Y)
    assert equal_in_ring(first - second + sp.Abs(X), sp.Abs(X) - (second - first))
    assert not equal_in_ring(first + sp.Abs(X), second + sp.Abs(X))
    assert not equal_in_ring(sp.Abs(X) * sp.Abs(Y), sp.Abs(X) ** 2)


def test_a_root_of_a_quotient_is_one_letter_without_a_relation() -> None:
    """Roots of equal quotients are one letter; what its square is, the ring does not know."""
    root, same = sp.sqrt(1 + 1 / X), sp.sqrt((X + 1) / X)
    assert root != same  # as they are written
    assert equal_in_ring(root * Y, Y * same)
    assert not equal_in_ring(root, sp.sqrt(1 - 1 / X))
    assert not equal_in_ring(root**3, root + root / X)
    assert compare(root**3, root + root / X, [{X: 0.3}, {X: 1.7}]) is Sameness.BY_NUMBER


@pytest.mark.parametrize("parts", range(1, 121))
def test_sines_of_parts_of_pi_that_are_known_have_no_quotient(parts: int) -> None:
    """The ring takes their numerators: no bottom is lost, and their squares add up to 1."""
    values = _known_values(sp.pi, sp.Rational(1, parts))
    for part in values or ():
        assert sp.fraction(sp.together(part))[1].is_Integer
    angle = sp.pi / parts
    assert equal_in_ring(sp.cos(angle + X), sp.cos(angle) * sp.cos(X) - sp.sin(angle) * sp.sin(X))


def test_the_ring_gives_up_before_a_product_is_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(circle, "_MOST_PRODUCTS", 4)
    assert not equal_in_ring((X + Y) * (X - Y), X)  # 2 by 2 terms
    with pytest.raises(UndecidedError):
        equal_in_ring((X + Y + 1) * (X - Y), X)  # 3 by 2


def test_the_ring_gives_up_before_a_square_of_a_sine_is_put_into_too_much(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """sin^2 is 1 - cos^2, two terms for each term that it stands before."""
    monkeypatch.setattr(circle, "_MOST_PRODUCTS", 5)
    sine = sp.sin(X)
    assert not equal_in_ring(sine * (sine * Y + sine * X), X)  # two squares, four terms
    with pytest.raises(UndecidedError):
        equal_in_ring(sine * (sine * Y + sine * X + sine), X)  # three squares, six terms


def test_the_ring_gives_up_in_time() -> None:
    letters = sp.symbols("a:h", real=True)
    with pytest.raises(UndecidedError):
        equal_in_ring(sum(letters) ** 32, (letters[0] + sum(letters[1:])) ** 32 + X)


@pytest.mark.parametrize(
    "expression", [sp.acos(4 * X), 1 / (X - sp.Rational(1, 2)), sp.sqrt(X - 1), Y**Y]
)
def test_what_has_no_real_value_is_not_a_number(expression: sp.Expr) -> None:
    """Out of the domain, a division by zero, complex, too large."""
    assert math.isnan(value(expression, {X: 0.5, Y: 1e3}))


def test_what_the_ring_cannot_prove_is_decided_by_number() -> None:
    # cos 20 deg is a root of 8x^3 - 6x - 1, a relation that the ring does not have.
    sheet = judged("planar_2r", "px: (8*cos(20 deg)**3 - 6*cos(20 deg))*(a1*c1 + a2*c12)")
    (each,) = sheet.claims[0].entries
    assert each.verdict.name == "RIGHT"
    assert "50 digits" in each.finding.note


def test_a_root_of_a_square_is_right_for_positive_lengths_only() -> None:
    (each,) = judged("planar_2r", "A1[1,4]: sqrt(a1**2)*c1").claims[0].entries
    assert each.verdict.name == "RIGHT"
    assert "positive" in each.finding.note


UPRIGHT = "theta1: 90 deg, theta2: 0, a1: 500, a2: 400"


@pytest.mark.parametrize(
    ("table", "answers", "verdict", "told"),
    [
        ("planar_2r", "nx: c12", "RIGHT", ""),
        ("planar_2r", "T(base, tool)[1,1]: c12", "RIGHT", ""),
        # Neither right but for rounding nor near it.
        ("planar_2r", "px: 0.7*c1*c2", "WRONG", ""),
        # As often wrong as right: for half of the turns of joint 1.
        ("planar_2r", "A1[2,1]: abs(s1)", "WRONG", ""),
        ("planar_2r", "A1[2,1]: sqrt(1 - c1**2)", "WRONG", ""),
        # Imaginary for lengths, which are positive at the first points.
        ("planar_2r", "A1[2,1]: sqrt(-a1)", "WRONG", ""),
        ("planar_2r", "A1[1,1]: c1*(cos(65*theta1)**2 + sin(65*theta1)**2)", "RIGHT", "50 digits"),
        ("planar_2r", "A1[1,1]: (abs(a1)*c1 + abs(a2)*c1)/(abs(a1) + abs(a2))", "RIGHT", ""),
        ("planar_2r", "numbers: {'A1[1,1]': 0.866}", "RIGHT", ""),
        ("planar_2r", "numbers: {px: sqrt(a1 - 1)}", "WRONG", "it has no real value"),
        ("planar_2r", "numbers: {px: 5.3654}", "WRONG", "off by a factor of 10:"),
        ("planar_2r", "numbers: {px: 53.654}", "WRONG", "off by a factor of 100:"),
        ("planar_2r", "numbers: {px: 536.54}", "WRONG", "off by a factor of 1000:"),
        ("planar_2r", "numbers: {px: 0.0053654}", "WRONG", "off by a factor of 100:"),
        ("planar_2r", "numbers: {px: 0.17885}", "WRONG", ""),
        # What counts as near depends on the reach for lengths, and for nothing else.
        ("planar_2r", f"numbers: {{at: {{{UPRIGHT}}}, px: 0.02}}", "COARSE", "near"),
        ("planar_2r", f"numbers: {{at: {{{UPRIGHT}}}, 'pose[4,4]': 1.5}}", "WRONG", ""),
        ("planar_2r", f"numbers: {{at: {{{UPRIGHT}}}, r11: 0.02}}", "WRONG", ""),
        ("planar_2r", "J[1,1]: 5*a1", "WRONG", ""),
        ("planar_2r", "T20[1,4]: 5*a1", "WRONG", ""),
        ("offsets", "pose[1,4]: 5*b", "WRONG", ""),
    ],
)
def test_a_single_answer(table: str, answers: str, verdict: str, told: str) -> None:
    (claim,) = judged(table, answers).claims
    (each,) = claim.entries
    assert each.verdict.name == verdict
    assert told in each.finding.note
    assert not claim.hint


@pytest.mark.parametrize(
    ("table", "rows", "cell", "verdict", "told"),
    [
        ("planar_2r", "[theta1, 0, a1, 0], [theta2, 0, a2, 0]", "theta of row 1", "RIGHT", ""),
        ("planar_2r", "[theta1, '', a1, 0], [theta2, 0, a2, 0]", "d of row 1", "BLANK", ""),
        ("planar_2r", "[theta1, 0, 7*a1, 0], [theta2, 0, a2, 0]", "a of row 1", "WRONG", ""),
        (
            "planar_2r",
            "[theta1, 0, a1, 0], [theta2, 0, a2, 0], [0, 0, a2, 0]",
            "a of row 3",
            "WRONG",
            "no such row",
        ),
        (
            "offsets",
            "[q1, d1, 0, 90 rad], [90 deg - q2, 0, a2, 0], [0, q3 + 0.25, 0, 90 deg]",
            "alpha of row 1",
            "WRONG",
            "degrees given where radians are meant",
        ),
        (
            "offsets",
            "[q1, d1, 0, 90 deg*pi/180], [90 deg - q2, 0, a2, 0], [0, q3 + 0.25, 0, 90 deg]",
            "alpha of row 1",
            "WRONG",
            "radians given where degrees are meant",
        ),
    ],
)
def test_rows_as_lists(table: str, rows: str, cell: str, verdict: str, told: str) -> None:
    (claim,) = judged(table, f"rows: [{rows}]").claims
    found = {each.label: each for each in claim.entries}
    assert found[cell].verdict.name == verdict
    assert told in found[cell].finding.note
    others = {each.verdict.name for label, each in found.items() if label != cell}
    assert others == {"RIGHT"} or "row 3" in cell


def test_rows_with_a_blank_are_no_other_choice_of_frames() -> None:
    """d of 5 and -5 on parallel axes cancel: right together, but not with one of them alone."""
    (whole,) = judged("planar_2r", "rows: [[theta1, 5, a1, 0], [theta2, -5, a2, 0]]").claims
    assert {each.verdict.name for each in whole.entries} == {"RIGHT"}
    assert "another choice of frames" in whole.hint
    (part,) = judged("planar_2r", "rows: [[theta1, 5, a1, 0], [theta2, '', a2, 0]]").claims
    found = {each.label: each.verdict.name for each in part.entries}
    assert (found.pop("d of row 1"), found.pop("d of row 2")) == ("WRONG", "BLANK")
    assert set(found.values()) == {"RIGHT"}
    assert part.hint == ""


def test_equal_in_double_precision_is_not_equal() -> None:
    points = [{X: 0.3}, {X: 0.7}]
    assert compare(X, X * (1 + sp.Rational(1, 10**14)), points) is Sameness.DIFFERENT
    assert compare(sp.sin(2 * X), 2 * sp.sin(X) * sp.cos(X), points) is Sameness.PROVEN


def test_base_and_tool_forgotten_together() -> None:
    (claim,) = judged("offsets", block("pose", chain(OFFSETS))).claims
    assert "base and tool are forgotten" in claim.hint


def test_a_name_that_reads_two_ways_is_refused() -> None:
    rows = "\n".join(f"  - {{theta: q{k}, d: 0, a: a{k}, alpha: 0}}" for k in range(1, 14))
    robot = loads_table(f"name: ruler\nconvention: standard\njoints:\n{rows}\n").robot
    with pytest.raises(TableError, match=r"T111 reads two ways: write T\(1, 11\) or T\(11, 1\)"):
        judge_text(robot, "T111[1,1]: 1")
    # So many rows are not searched for the one that was read wrongly.
    (claim,) = judge_text(robot, "T(0, 13)[1,4]: 5*a1").claims
    assert (claim.entries[0].verdict.name, claim.hint) == ("WRONG", "")


@pytest.mark.parametrize(
    "hard",
    [
        X**65,
        sp.cos(65 * X),
        1 / (sp.cos(X) ** 2 + sp.sin(X) ** 2 - 1),
    ],
)
def test_the_ring_says_what_it_does_not_decide(hard: sp.Expr) -> None:
    with pytest.raises(UndecidedError):
        equal_in_ring(hard, X)


def test_an_arm_without_a_closed_form_has_entries_that_are_sure() -> None:
    rows = "\n".join(f"  - {{theta: q{k}, d: d{k}, a: a{k}, alpha: 90 deg}}" for k in range(1, 11))
    robot = loads_table(f"name: ten\nconvention: standard\njoints:\n{rows}\n").robot
    (claim,) = judge_text(robot, "T(0, 10)[4,4]: 1").claims
    assert claim.entries[0].verdict.name == "RIGHT"
    assert "decided by number" in claim.entries[0].finding.note
    with pytest.raises(UnsupportedError, match=r"a\.yaml:1:9: the Jacobian of ten has no closed"):
        judge_text(robot, "J[1,1]: 0")


def test_an_arm_without_a_closed_form_is_judged_by_number() -> None:
    rows = "\n".join(f"  - {{theta: q{k}, d: d{k}, a: a{k}, alpha: 90 deg}}" for k in range(1, 11))
    robot = loads_table(f"name: ten\nconvention: standard\njoints:\n{rows}\n").robot
    sheet = judge_text(robot, "T(0, 10)[1,1]: c1\nA10[1,4]: a10*c10\nT0_2[3,3]: cos(180 deg)\n")
    (first,), (second,), _ = (claim.entries for claim in sheet.claims)
    assert first.verdict.name == "WRONG"
    assert second.verdict.name == "RIGHT"


# -- how exact a number is -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value", "last", "digits"),
    [
        ("0.4330", 0.4330, 1e-4, 4),
        ("12", 12.0, 1.0, 2),
        ("-1.50e-2", -0.0150, 1e-4, 3),
        ("433.0 mm", 0.4330, 1e-4, 4),
        ("sqrt(3)/2", 0.8660254, 0.0, 3),
        ("0.866*2", 1.732, 1.732e-3, 3),
    ],
)
def test_how_exact_a_number_is_written(text: str, value: float, last: float, digits: int) -> None:
    written = Written.of(text, value)
    assert written.last == pytest.approx(last)
    assert written.digits == digits


# -- what cannot be read ---------------------------------------------------------------------------

MISTAKES = {
    "A1: [[c1, -s1, 0, a1*c3]]": (1, 5, "A1 has 4 rows of 4"),
    "px: a1*c3": (1, 8, "did you mean c2?"),
    "px: a3*c1": (1, 5, "did you mean a2?"),
    "px: 'a1*c_{1} + a2*c_{12} + a3'": (1, 28, "did you mean a2?"),
    "A3: 1": (1, 1, "there is no A3"),
    "T03: 1": (1, 1, "there is no frame 3"),
    "A1[5,1]: 1": (1, 1, "4 rows and 4 columns"),
    "pse: 1": (1, 1, "did you mean pose?"),
    "px: [1, 2]": (1, 5, "one entry"),
    "p: [1, 2]": (1, 4, "a list of 3"),
    "px: a1 c1": (1, 8, "write * for a product"),
    "px: {a: 1}": (1, 5, "not a mapping"),
    "numbers: 3": (1, 10, "must be a mapping"),
    "numbers: {at: {theta9: 3}}": (1, 16, "did you mean theta2?"),
    "rows: 3": (1, 7, "must be a list"),
    "rows: [{theta: 1, d: 0, a: 0}]": (1, 8, "missing key alpha"),
    "columns: [a]": (1, 10, "columns without rows"),
    "name: Anna": (1, 1, "no answer here"),
    "T02.q: 1": (1, 1, ".q is no part of a pose: write .p, .R, .px or .r11"),
    "T02[x]: 1": (1, 1, "[x] is no entry: write [row,column], from 1"),
    "A1: [[1, 0, 0, 0], [0, 1, 0], [0, 0, 1, 0], [0, 0, 0, 1]]": (1, 5, "here row 2 has 3"),
    "rows: [{theta: theta1 +, d: 0, a: a1, alpha: 0}]": (1, 24, "ends early"),
    "\n".join(
        f"T({i}, {j})[{r},{c}]: 1"
        for i in range(3)
        for j in range(3)
        for r in range(1, 5)
        for c in range(1, 5)
    )
    + "\n"
    + "\n".join(f"A{i}[{r},{c}]: 1" for i in (1, 2) for r in range(1, 5) for c in range(1, 5))
    + "\n"
    + "\n".join(f"r{r}{c}: 1" for r in "123" for c in "123")
    + "\n"
    + "\n".join(f"J[{r},{c}]: 1" for r in range(1, 7) for c in (1, 2))
    + "\npx: 1\npy: 1\npz: 1\nnx: 1\n": (1, 1, "201 answers, over 200"),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_what_cannot_be_read_is_located(text: str) -> None:
    line, column, message = MISTAKES[text]
    with pytest.raises(TableError) as caught:
        judged("planar_2r", text)
    found = caught.value.diagnostics[0]
    assert (found.line, found.column) == (line, column)
    assert message in found.message


def test_a_number_without_values_is_located() -> None:
    with pytest.raises(UnsupportedError, match=r"a\.yaml:2:7: theta1, theta2 have no value"):
        judged("planar_2r_p", "numbers:\n  px: 0.5\n")


def test_all_mistakes_are_told_at_once() -> None:
    with pytest.raises(TableError) as caught:
        judged("planar_2r", "px: a1*\npy: foo\nA9: 1\n")
    assert [found.line for found in caught.value.diagnostics] == [1, 2, 3]


HOSTILE = {
    "import": "px: __import__('os').system('true')",
    "attribute": "px: a1.__class__",
    "call": "px: open(a1)",
    "nesting": "px: " + "(" * 400 + "1" + ")" * 400,
    "tower of powers": "px: 9**9**9**9**9",
    "power of a sum": "px: " + "(a1 + a2 + c1 + s1 + c2 + s2)**32*" * 20 + "1",
    "powers of powers": "px: (((a1 + c1)**32)**32)**32",
    "many angles": "px: " + " + ".join(f"cos({k}*theta1)" for k in range(1, 120)),
    "big multiple": "px: cos(99999999*theta1)",
    "long expression": "px: a1" + "+a1" * 900,
    "yaml tag": "px: !!python/object/apply:os.system [true]",
    "yaml aliases": "a: &a [1, 1]\nb: &b [*a, *a]\npx: *b",
    "deep yaml": "px: " + "[" * 200 + "]" * 200,
    "many keys": "\n".join(f"T02[1,{1 + k % 4}] {'#' if False else ''}: {k}" for k in range(4000)),
    "huge number": "px: 1" + "0" * 1000,
    "huge exponent": "px: 1e999999",
    "null byte": "px: a1\0",
    "division by zero": "px: 1/0",
    "division by a hidden zero": "px: 1/(s1**2 + c1**2 - 1)",
    "tangents of nothing": "px: tan(theta1 - theta1 + 90 deg)",
    "name of a formula": "name: '=cmd|calc'\npx: a1",
    "unknown frames": "T(99999999999999999999, 1): 1",
    "list": "- px",
    "empty": "",
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_hostile_answers_end_quickly(text: str) -> None:
    start = time.process_time()
    try:
        sheet = judged("planar_2r", text)
        assert sheet.right < sheet.total
    except TableError as error:
        assert all(found.message for found in error.diagnostics)
    # Far above what is needed, and far below what an explosion takes.
    assert time.process_time() - start < 20


# -- the command -----------------------------------------------------------------------------------


@pytest.fixture
def sheets(tmp_path: Path) -> Path:
    (tmp_path / "arm.yaml").write_text(TABLES["planar_2r"])
    (tmp_path / "anna.yaml").write_text("name: Anna\npx: a1*c1 + a2*c12\npy: a1*s1 + a2*s12\n")
    (tmp_path / "ben.yaml").write_text("name: =Ben\npx: a1*s1 + a2*s12\nT02[1,1]: c12\n")
    (tmp_path / "carl.yaml").write_text("px: a1*c7\n")
    return tmp_path


def test_exit_status_and_report(sheets: Path, run_symdh: Runner) -> None:
    good = run_symdh("answer", "arm.yaml", "anna.yaml", cwd=sheets)
    assert (good.returncode, good.stderr) == (0, "")
    assert "anna.yaml (Anna): 2 of 2 right" in good.stdout
    wrong = run_symdh("answer", "arm.yaml", "ben.yaml", cwd=sheets)
    assert wrong.returncode == 1
    assert "sine and cosine swapped" in wrong.stdout
    assert "a1*c1" not in wrong.stdout
    told = run_symdh("answer", "arm.yaml", "ben.yaml", "--solution", cwd=sheets)
    assert "right is a1*c1 + a2*c12" in told.stdout
    bad = run_symdh("answer", "arm.yaml", "carl.yaml", cwd=sheets)
    assert bad.returncode == 2
    assert "carl.yaml:1:8: c7 is neither" in bad.stderr
    assert bad.stdout == ""
    missing = run_symdh("answer", "arm.yaml", "nobody.yaml", cwd=sheets)
    assert missing.returncode == 3


MIXED = """\
A1: [[s1, -s1, 0, a1*c1], [s1, c1, 0, a1*s1], [0, 0, 1, 0], [0, 0, 0, 1]]
rows: [[theta1, 0, a1, 0], [theta2, a2, 0, 0], [0, 0, 0, 0]]
numbers: {px: 0.7}
"""


def test_a_report_marks_each_entry(sheets: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """px = 0.5 cos 30 + 0.4 cos 75 = 0.5365; the third row is one too many."""
    (sheets / "mixed.yaml").write_text(MIXED)
    command = ["answer", str(sheets / "arm.yaml"), str(sheets / "mixed.yaml"), "--solution"]
    assert run(command) == 1
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    first = lines.index("✗ A1             15 of 16 right")
    assert lines[first + 1 : first + 5] == ["⇄ ✓ ✓ ✓", *["✓ ✓ ✓ ✓"] * 3]
    assert "✗ 0.7: wrong; right is 0.5365" in lines
    rows = lines.index("✗ rows           6 of 12 right")
    assert lines[rows + 1 : rows + 4] == ["✓ ✓ ✓ ✓", "✓ ✗ ✗ ✓", "✗ ✗ ✗ ✗"]
    assert "✗ a of row 3 = 0: wrong (the table has no such row)" in lines
    assert any(line.startswith("hint: the table has 2 rows, and here are 3;") for line in lines)
    assert run([*command, "--format", "json"]) == 1
    (sheet,) = json.loads(capsys.readouterr().out)["sheets"]
    expected = [each["expected"] for claim in sheet["answers"] for each in claim["entries"]]
    assert expected[:2] == ["c1", "-s1"]
    assert "0.5365" in expected
    assert expected[-4:] == [None] * 4


def test_a_term_with_the_wrong_sign_is_named(
    sheets: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The right one is px = a1 c1 + a2 c12."""
    (sheets / "sign.yaml").write_text("px: a1*c1 - a2*c12\n")
    assert run(["answer", str(sheets / "arm.yaml"), str(sheets / "sign.yaml")]) == 1
    shown = capsys.readouterr().out
    assert "± a1*c1 - a2*c12: right but for the sign (of the term -a2*c12)" in shown


def test_many_sheets_give_a_line_each(sheets: Path, run_symdh: Runner) -> None:
    done = run_symdh("answer", "arm.yaml", "carl.yaml", "anna.yaml", "ben.yaml", cwd=sheets)
    assert done.returncode == 2
    assert [line.split()[0] for line in done.stdout.splitlines()] == ["anna.yaml", "ben.yaml"]
    assert "2/2" in done.stdout
    assert "1 of 3 files could not be checked" in done.stderr


def test_the_grade_book(sheets: Path, run_symdh: Runner) -> None:
    done = run_symdh("answer", "arm.yaml", "anna.yaml", "ben.yaml", "--format", "csv", cwd=sheets)
    rows = list(csv.reader(io.StringIO(done.stdout)))
    assert rows == [
        ["file", "name", "right", "total", "px", "py", "T02[1,1]"],
        ["anna.yaml", "Anna", "2", "2", "1", "1", ""],
        ["ben.yaml", "'=Ben", "1", "2", "0", "", "1"],
    ]


def test_json(sheets: Path, run_symdh: Runner) -> None:
    done = run_symdh("answer", "arm.yaml", "ben.yaml", "--format", "json", cwd=sheets)
    (sheet,) = json.loads(done.stdout)["sheets"]
    assert (sheet["name"], sheet["right"], sheet["total"]) == ("=Ben", 1, 2)
    assert sheet["answers"][0]["entries"][0]["verdict"] == "swapped"
    assert "expected" not in done.stdout


@pytest.mark.parametrize("name", sorted(TABLES))
def test_a_blank_answer_file_reads_back_all_blank(name: str) -> None:
    robot = loads_table(TABLES[name], f"{name}.yaml").robot
    sheet = judge_text(robot, blank_answers(robot))
    assert sheet.total >= 16 * (robot.n + 1)
    assert {each.verdict.name for claim in sheet.claims for each in claim.entries} == {"BLANK"}


@pytest.mark.parametrize(
    ("rows", "more", "name"),
    [
        (2, "", "T02"),
        (9, "", "T09"),
        (10, "", "pose"),  # T010 would read two ways
        (2, "base: Tz(b)\n", "pose"),  # from base to 2, which is no T02
        (2, "tool: Tz(e)\n", "pose"),
    ],
)
def test_a_blank_answer_file_asks_for_the_whole_chain(rows: int, more: str, name: str) -> None:
    joints = "".join(f"  - {{theta: t{k}, d: 0, a: a{k}, alpha: 0}}\n" for k in range(rows))
    robot = loads_table(f"convention: standard\n{more}joints:\n{joints}", "arm.yaml").robot
    asked = [line[:-1] for line in blank_answers(robot).splitlines() if re.match(r"\w+:$", line)]
    assert asked == [*(f"A{k + 1}" for k in range(rows)), name]


def test_blank_writes_a_file_and_keeps_one_that_is_there(sheets: Path, run_symdh: Runner) -> None:
    done = run_symdh("answer", "arm.yaml", "--blank", "-o", "new.yaml", cwd=sheets)
    assert done.returncode == 0
    assert (sheets / "new.yaml").read_text().startswith("# Answers to: Planar arm")
    again = run_symdh("answer", "arm.yaml", "--blank", "-o", "new.yaml", cwd=sheets)
    assert again.returncode == 3
    assert "is there already" in again.stderr
    nothing = run_symdh("answer", "arm.yaml", cwd=sheets)
    assert nothing.returncode == 2


def test_the_example_is_judged_as_its_comments_say() -> None:
    text = (EXAMPLES / "answers" / "planar_2r.yaml").read_text(encoding="utf-8")
    robot = loads_table(TABLES["planar_2r"]).robot
    sheet = judge_text(robot, text)
    expected = [line.rpartition("#")[2].strip() for line in text.splitlines() if "  # " in line]
    assert len(expected) == len(sheet.claims)
    for wanted, claim in zip(expected, sheet.claims, strict=True):
        assert wanted in told(claim)


def told(claim: JudgedClaim) -> str:
    """Return all that is said of a claim."""
    verdicts = (f"{each.verdict.value} {each.finding.note}" for each in claim.entries)
    return "\n".join([*verdicts, claim.hint])
