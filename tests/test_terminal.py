"""Results on a terminal: no line is wider than it, and nothing is lost to make that so."""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path

import numpy as np
import pytest
from oracle import read_arm
from sympy import Integer, Symbol, cos

import symdh
from symdh.derivation.blocks import (
    Chapter,
    Definition,
    Definitions,
    Display,
    EntryStep,
    EntrySteps,
    MatrixRow,
    NamedMatrix,
    Paragraph,
    ParameterTable,
)
from symdh.derivation.style import Naming, Style
from symdh.derivation.table import chapter as table_chapter
from symdh.kinematics.forward import transform
from symdh.kinematics.frame import first_frame, last_frame
from symdh.kinematics.numeric import pose
from symdh.notation import Notation, Shorthand
from symdh.notation.nodes import Generic, Name, Number, Short
from symdh.render.terminal import render_chapters, render_numbers, render_result
from symdh.render.unicode_math import UnicodeWriter

ROOT = Path(__file__).parent
EXAMPLES = [
    path
    for path in sorted((ROOT.parent / "examples").glob("*.yaml"))
    if re.search(r"\{(theta|alpha):|^columns:", path.read_text(encoding="utf-8"), re.MULTILINE)
]
WIDTHS = (40, 57, 80, 100, 132, 200)
SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉₋", "0123456789-")

each_example = pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)


def columns(line: str) -> int:
    """Count the columns that a line takes on a terminal."""
    return sum(unicodedata.combining(character) == 0 for character in line)


def skew_arm(n: int, more: str = "") -> symdh.Robot:
    rows = "".join(
        f"  - {{theta: t{k}, d: d{k}, a: a{k}, alpha: {90 * (-1) ** k} deg}}\n"
        for k in range(1, n + 1)
    )
    return symdh.loads(f"name: skew\nconvention: standard\njoints:\n{rows}{more}")


def whole(robot: symdh.Robot, width: int, naming: Naming = Naming.AUTO) -> str:
    return render_result(robot, first_frame(robot), last_frame(robot), width, naming)


def breakable(line: str) -> bool:
    """Say whether a line holds another place to break: a sign after its first term."""
    _, _, right = line.partition(" = ")
    return bool(re.search(r"\S [+-] \S", right or line.strip()))


@each_example
@pytest.mark.parametrize("width", WIDTHS)
def test_no_line_is_wider_than_the_terminal(path: Path, width: int) -> None:
    lines = whole(symdh.load(path), width).splitlines()
    assert len(lines) > 3
    assert [line for line in lines if columns(line) > width] == []


@pytest.mark.parametrize("width", range(40, 201, 7))
def test_a_recursion_fits_too(width: int) -> None:
    lines = whole(skew_arm(20), width).splitlines()
    assert [line for line in lines if columns(line) > width and breakable(line)] == []
    assert [line for line in lines if columns(line) > max(width, 60)] == []


@each_example
def test_breaking_changes_the_layout_alone(path: Path) -> None:
    """The entries of a narrow terminal, joined again, are those of a very wide one."""
    robot = symdh.load(path)
    style = Style(robot)
    matrix = style.notation.matrix(transform(robot, first_frame(robot), last_frame(robot)))
    writer = UnicodeWriter()
    narrow = whole(robot, 40).partition("\n\nHere ")[0]
    if "⎡" in narrow:
        return
    found: dict[str, str] = {}
    name = ""
    for line in narrow.splitlines()[1:]:
        left, equals, right = line.partition(" = ")
        if equals:
            name = left.strip()
            found[name] = right
        else:
            found[name] += " " + line.strip()
    entries = {
        ("p_" + "xyz"[row] if column == 3 else "r" + "₁₂₃"[row] + "₁₂₃"[column]): writer.text(
            matrix.rows[row][column]
        )
        for row in range(3)
        for column in range(4)
    }
    assert found == entries


@pytest.mark.parametrize(
    ("width", "shape"), [(200, "beside"), (50, "beside"), (36, "below"), (33, "entries")]
)
def test_a_matrix_stands_as_long_as_it_fits(width: int, shape: str) -> None:
    robot = symdh.load(ROOT.parent / "examples" / "planar_2r.yaml")
    lines = whole(robot, width).splitlines()
    if shape == "beside":
        assert [line[0:1] for line in lines[:4]] == [" ", "⁰", " ", " "]
        assert lines[1].startswith("⁰T₂ = ⎢")
    elif shape == "below":
        assert lines[0] == "⁰T₂ ="
        assert [line.strip()[0] for line in lines[1:5]] == list("⎡⎢⎢⎣")
    else:
        assert lines[0] == "⁰T₂:"
        assert lines[1] == "  r₁₁ = c₁₂"
    matrix_lines = [line for line in lines if line.strip()[:1] in tuple("⎡⎢⎣")]
    assert len({columns(line) for line in matrix_lines}) <= 1


def test_the_brackets_of_a_matrix_close_above_each_other() -> None:
    robot = symdh.load(ROOT.parent / "examples" / "scara.yaml")
    first, *_, last = (lines := whole(robot, 200).splitlines()[:4])
    assert len({len(line) for line in lines}) == 1
    assert (first[-1], last[-1]) == ("⎤", "⎦")


@each_example
def test_the_legend_tells_every_short_form(path: Path) -> None:
    robot = symdh.load(path)
    text = whole(robot, 80)
    result, _, legend = text.partition("\n\nHere ")
    used = set(re.findall(r"\b[cs][₀-₉₋,]+", result))
    meanings = " ".join(legend.split())
    general = "cᵢ = cos" in meanings
    for short in used:
        single = len(short) == 2
        assert f"{short} = " in meanings or (general and single), short


def test_namings() -> None:
    robot = symdh.load(ROOT.parent / "examples" / "planar_2r.yaml")
    assert whole(robot, 80, Naming.STANDARD).splitlines()[1].startswith("⁰T₂ = ")
    assert whole(robot, 80, Naming.CRAIG).splitlines()[1].startswith("⁰₂T = ")
    modified = symdh.load(ROOT.parent / "examples" / "planar_2r_modified.yaml")
    assert "T = " in whole(modified, 80).splitlines()[1]


def test_the_identity_has_no_legend() -> None:
    robot = symdh.load(ROOT.parent / "examples" / "planar_2r.yaml")
    text = render_result(robot, 1, 1)
    assert re.findall(r"\d", text.replace("¹", "").replace("₁", "")) == list("1000010000100001")
    assert "Here" not in text


def test_a_recursion_stands_in_for_what_is_too_large() -> None:
    text = whole(skew_arm(20), 80)
    assert "It is given link by link instead" in " ".join(text.split())
    assert "⎡" not in text
    backwards = render_result(skew_arm(20), 20, 0, 80)
    assert "rigid inverse" in backwards


# -- numbers --------------------------------------------------------------------------------------


def test_a_numeric_pose_is_rounded_and_nothing_else() -> None:
    text = """
name: arm
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.4, a: 0.25, alpha: 90 deg}
  - {theta: theta2, d: 0, a: 1234.5, alpha: 0}
"""
    robot = symdh.loads(text)
    values = dict(zip(robot.variables, (Integer(1), Integer(2)), strict=True))
    lines = render_numbers(0, 2, pose(robot, 0, 2, values)).splitlines()
    body = [re.sub(r"⁰T₂ =|[⎡⎢⎣⎤⎥⎦]", " ", line).split() for line in lines]
    shown = np.array([[float(x) for x in row] for row in body])
    expected = np.array(read_arm(text).pose({"theta1": 1.0, "theta2": 2.0}, 0, 2), dtype=float)
    assert np.abs(shown - expected).max() <= 0.5e-4 * np.abs(expected).max()
    assert np.abs(shown[:, :3] - expected[:, :3]).max() <= 0.5001e-4


# -- blocks ---------------------------------------------------------------------------------------


def test_chapters_stand_under_their_titles() -> None:
    name = NamedMatrix((Name("A"),), Notation(symdh.loads(ONE)).matrix(symdh.loads(ONE).T()))
    chapters = [
        Chapter("First", (Paragraph(("Text with ", Name("theta1"), ".")), Display(Name("a1")))),
        Chapter("Second", (MatrixRow((name, name)), EntrySteps((STEP,)))),
    ]
    text = render_chapters(chapters, 60)
    assert text.startswith("First\n─────\n\nText with θ₁.\n\n  a₁\n\nSecond\n──────\n\n")
    assert text.count("⎡") == 2
    assert text.endswith("  x = 1")


ONE = "name: one\nconvention: standard\njoints:\n  - {theta: theta1, d: 0, a: a1, alpha: 0}\n"
STEP = EntryStep(Generic("x"), (Number(Integer(1)),), None)


def test_a_block_that_a_terminal_does_not_know_is_refused() -> None:
    meaning = Definitions((Definition(Name("a1"), ("a length",)),))
    with pytest.raises(TypeError, match=r"^no terminal text for Definitions$"):
        render_chapters([Chapter("T", (meaning,))])


def test_the_table_stands_in_columns() -> None:
    robot = symdh.load(ROOT.parent / "examples" / "puma560.yaml")
    blocks = table_chapter(Style(robot)).blocks
    table = next(block for block in blocks if isinstance(block, ParameterTable))
    text = render_chapters([Chapter("T", (table,))], 80)
    head, rule, *rows = text.splitlines()[3:11]
    assert head.split() == ["i", "θᵢ", "dᵢ", "aᵢ", "αᵢ"]
    assert set(rule.strip()) == {"─"}
    assert len({len(line) for line in (head, rule, *rows)}) == 1
    assert rows[0].split() == ["1", "θ₁*", "d₁", "0", "90°"]


def test_formulas_in_running_text_are_not_torn() -> None:
    formula = Notation(symdh.loads(ONE)).write(Symbol("a", real=True) + Symbol("b", real=True))
    text = render_chapters([Chapter("T", (Paragraph(("word " * 7, formula, " end")),))], 40)
    assert "a + b" in text
    assert all(columns(line) <= 40 for line in text.splitlines())


def test_labels_are_lowered_and_what_cannot_be_is_marked() -> None:
    writer = UnicodeWriter()
    assert writer.text(Short("c", "1-2,10")) == "c₁₋₂,₁₀"
    assert writer.text(Name("L_tool")) == "Lₜₒₒₗ"
    assert writer.text(Name("L_big")) == "L_big"
    assert writer.text(Name("alpha_max")) == "αₘₐₓ"
    assert writer.text(Generic("z", "i-1", hat=True)) == "z\u0302ᵢ₋₁"
    assert writer.width(Generic("z", "i-1", hat=True)) == 4


def test_spelt_out_functions() -> None:
    robot = skew_arm(4)
    notation = Notation(robot, Shorthand.none(robot))
    product = cos(robot.variables[0]) * Symbol("a1", real=True)
    assert UnicodeWriter().text(notation.write(product)) == "a₁ cos t₁"
