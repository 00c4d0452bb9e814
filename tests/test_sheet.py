"""Homework: the problem sheet and its solution are one sheet, and the problem tells nothing."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from symdh.derivation.blocks import (
    Block,
    Document,
    EntryStep,
    Figure,
    NamedMatrix,
    Paragraph,
    ParameterTable,
    ProductResult,
    Question,
)
from symdh.derivation.sheet import sheet
from symdh.derivation.style import Style
from symdh.errors import UnsupportedError
from symdh.kinematics.forward import has_closed_form, link_transform, transform
from symdh.kinematics.frame import first_frame, last_frame
from symdh.notation.nodes import Node
from symdh.notation.writing import weight
from symdh.render.latex import render_latex
from symdh.render.latex_math import LatexWriter
from symdh.render.page.page import render_page
from symdh.robot import Robot
from symdh.table import load_table, loads_table
from tools import require_tool

ROOT = Path(__file__).parent.parent
CORPUS = sorted((ROOT / "tests/data/tables").glob("*.yaml"))
#: All of them pass; a part is enough for every day.
TABLES = [*sorted((ROOT / "examples").glob("*.yaml")), *CORPUS[::6]]
SHOWN = ("planar_2r", "scara", "puma560", "rrp_modified")
Runner = Callable[..., Any]


def robot_of(path: Path) -> Robot:
    return load_table(str(path)).robot


def example(name: str) -> Robot:
    return robot_of(ROOT / "examples" / f"{name}.yaml")


def questions(document: Document) -> list[Question]:
    return [b for chapter in document.chapters for b in chapter.blocks if isinstance(b, Question)]


def without_answers(document: Document) -> list[tuple[str, tuple[Block, ...]]]:
    return [
        (
            chapter.title,
            tuple(
                replace(block, answer=None) if isinstance(block, Question) else block
                for block in chapter.blocks
            ),
        )
        for chapter in document.chapters
    ]


@pytest.mark.parametrize("path", TABLES, ids=lambda path: path.stem)
def test_both_sheets_ask_the_same(path: Path) -> None:
    robot = robot_of(path)
    problem, solution = sheet(robot, "problem"), sheet(robot, "solution")
    assert without_answers(problem) == without_answers(solution)
    assert problem.preface == solution.preface
    assert problem.title == solution.title
    asked, solved = questions(problem), questions(solution)
    assert len(asked) >= robot.n + 1
    assert all(each.answer is None for each in asked)
    assert all(each.answer for each in solved)
    assert all(2 <= each.room.lines <= 16 for each in asked)


def told(robot: Robot) -> Iterator[str]:
    """Yield the LaTeX of each entry of each link and of the pose that is more than a number."""
    style, writer = Style(robot), LatexWriter()
    matrices = [link_transform(robot, i) for i in range(1, robot.n + 1)]
    start, end = first_frame(robot), last_frame(robot)
    if has_closed_form(robot, start, end):
        matrices.append(transform(robot, start, end))
    for matrix in matrices:
        for node in (entry for row in style.notation.matrix(matrix).rows for entry in row):
            if weight(node) > 1:
                yield writer.text(node)


@pytest.mark.parametrize("name", SHOWN)
def test_a_problem_sheet_tells_no_answer(name: str) -> None:
    robot = example(name)
    document = sheet(robot, "problem", points=True)
    # KaTeX and the style come with every page and know nothing of the arm.
    page = re.sub(r"(?s)<(script|style)>.*?</\1>", "", render_page(document, robot))
    for text in (render_latex(document), page):
        # Short forms are explained with a running index and not by those that occur.
        assert not re.search(r"[cs]_\{\d", text)
        for entry in told(robot):
            assert entry not in text
        assert "Solution" not in text
    for mark in ("canvas", "ARM", 'id="pose"', "slider"):
        assert mark not in page
    solution = render_latex(sheet(robot, "solution"))
    assert sum(entry in solution for entry in told(robot)) > 3


def test_numbers_are_left_out_too() -> None:
    # x = 0.5 cos 30 + 0.4 cos 75 = 0.5365
    robot = example("planar_2r")
    for render in (render_latex, lambda document: render_page(document, robot)):
        assert "0.5365" not in render(sheet(robot, "problem"))
        assert "0.5365" in render(sheet(robot, "solution"))


def test_exercises_follow_from_the_table() -> None:
    titles = [chapter.title for chapter in sheet(example("puma560"), "problem").chapters]
    assert titles == [
        *("One link", "The links", "The products", "The pose", "Numbers"),
        *("Velocity", "Singularities"),
    ]
    bare = [chapter.title for chapter in sheet(example("rrp_modified"), "problem").chapters]
    assert "Numbers" not in bare


@pytest.mark.parametrize(
    ("rows", "exercises"),
    [
        # One row is its own pose, and one joint has no singularity worth a question.
        ("  - [q1, 0, a1, 0]\n", ["Velocity"]),
        ("  - [q1, 0, a1, 0]\nvalues: {a1: 2}\n", ["Numbers", "Velocity"]),
        # d1 is open, so no number can be asked for.
        ("  - [q1, d1, 0, 0]\nvalues: {q1: 30 deg}\n", ["Velocity"]),
        ("  - [0, 1, a1, 0]\n", []),
        ("  - [q1, 0, a1, 0]\n  - [p2, 0, a2, 0]\n", ["The pose", "Velocity", "Singularities"]),
        # Too long to be done by hand: six skew links, ten at right angles.
        ("".join(f"  - [q{k}, d{k}, a{k}, alpha{k}]\n" for k in range(1, 7)), []),
        ("".join(f"  - [q{k}, 1, 1, 90 deg]\n" for k in range(1, 11)), []),
    ],
)
def test_only_what_can_be_done_by_hand_is_asked(rows: str, exercises: list[str]) -> None:
    head = "name: arm\nconvention: standard\ncolumns: [theta, d, a, alpha]\nrows:\n"
    made = sheet(loads_table(head + rows).robot, "problem")
    assert [chapter.title for chapter in made.chapters] == ["One link", "The links", *exercises]


def test_no_short_forms_where_joints_have_several_letters() -> None:
    head = "name: arm\nconvention: standard\ncolumns: [theta, d, a, alpha]\nrows:\n"
    for second, told in (("q2", True), ("p2", False)):
        rows = f"  - [q1, 0, a1, 0]\n  - [{second}, 0, a2, 0]\n"
        preface = sheet(loads_table(head + rows).robot, "problem").preface
        texts = [str(block.content[0]) for block in preface if isinstance(block, Paragraph)]
        assert any(text.startswith("Short forms") for text in texts) is told


def test_the_table_can_be_asked_for() -> None:
    robot = example("scara")
    problem = sheet(robot, "problem", ask_table=True)
    assert problem.chapters[0].title == "The table"
    assert not any(isinstance(block, ParameterTable) for block in problem.blocks)
    assert any(isinstance(block, Figure) for block in problem.preface)
    room = questions(problem)[0].room
    assert (room.lines, len(room.columns)) == (4, 5)
    (answer,) = questions(sheet(robot, "solution", ask_table=True))[0].answer or ()
    assert isinstance(answer, ParameterTable)
    # The drawing names the lengths; the twist is to be seen.
    assert "180^" not in render_latex(problem)


def test_a_table_is_not_asked_for_without_a_drawing() -> None:
    rows = "".join(f"  - {{theta: q{k}, d: 0, a: a{k}, alpha: 0}}\n" for k in range(1, 41))
    robot = loads_table(f"name: ruler\nconvention: standard\njoints:\n{rows}").robot
    with pytest.raises(UnsupportedError, match="no drawing"):
        sheet(robot, "problem", ask_table=True)


def test_the_links_are_lettered() -> None:
    links = sheet(example("scara"), "problem").chapters[1]
    texts = [block.text[0] for block in links.blocks if isinstance(block, Question)]
    assert texts == [f"({letter}) " for letter in "abcd"]


def test_letters_are_doubled_after_the_26th_question() -> None:
    head = "name: arm\nconvention: standard\ncolumns: [theta, d, a, alpha]\nrows:\n"
    rows = "".join(f"  - [0, q{k}, 0, 0]\n" for k in range(1, 54))
    links = sheet(loads_table(head + rows).robot, "problem").chapters[1]
    texts = [block.text[0] for block in links.blocks if isinstance(block, Question)]
    assert [texts[k] for k in (0, 25, 26, 51, 52)] == ["(a) ", "(z) ", "(aa) ", "(zz) ", "(aaa) "]


def test_the_solution_answers_with_what_the_handout_says() -> None:
    robot = example("stanford")
    blocks = [block for each in questions(sheet(robot, "solution")) for block in each.answer or ()]
    matrices = [block for block in blocks if isinstance(block, NamedMatrix)]
    products = [block for block in blocks if isinstance(block, ProductResult)]
    assert len(matrices) >= robot.n
    assert len(products) == robot.n - 1
    last = products[-1]
    assert last.matrix == Style(robot).notation.matrix(transform(robot, 0, robot.n))
    assert all(isinstance(step, EntryStep) and isinstance(step.name, Node) for step in last.steps)


def test_no_legend_for_an_arm_that_only_slides() -> None:
    path = next(path for path in CORPUS if path.stem == "cartesian_ppp")
    preface = sheet(robot_of(path), "problem").preface
    texts = [block.content[0] for block in preface if isinstance(block, Paragraph)]
    assert not any(str(text).startswith("Short forms") for text in texts)


@pytest.mark.parametrize("kind", ["problem", "solution"])
@pytest.mark.parametrize("name", SHOWN)
def test_sheets_compile_and_nothing_runs_over(name: str, kind: str, tmp_path: Path) -> None:
    require_tool("pdflatex")
    text = render_latex(sheet(example(name), kind, points=True))
    (tmp_path / "sheet.tex").write_text(text, encoding="utf-8")
    ran = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "sheet.tex"],
        cwd=tmp_path,
        capture_output=True,
        timeout=120,
        check=False,
    )
    log = (tmp_path / "sheet.log").read_text(encoding="utf-8", errors="replace")
    assert ran.returncode == 0, log[-2000:]
    assert not re.findall(r"^Overfull.*", log, re.MULTILINE)


def test_files_are_named_after_the_sheet(tmp_path: Path, run_symdh: Runner) -> None:
    table = ROOT / "examples" / "planar_2r.yaml"
    done = run_symdh("derive", table, "--sheet", "problem")
    assert done.returncode == 0
    assert "⁰T₂" not in done.stdout
    names = {path.name for path in (tmp_path / "planar_2r").iterdir()}
    assert names == {"planar_2r_problem.tex", "planar_2r_problem.html"}
    assert run_symdh("derive", table, "--sheet", "solution").returncode == 0
    names = {path.name for path in (tmp_path / "planar_2r").iterdir()}
    assert names >= {"planar_2r_problem.tex", "planar_2r_solution.tex"}
    assert run_symdh("html", table, "--sheet", "problem").returncode == 0
    assert (tmp_path / "planar_2r_problem.html").is_file()
    shown = run_symdh("latex", table, "--sheet", "solution", "--points")
    assert "points" in shown.stdout


def test_the_same_sheet_whatever_the_hash_seed(run_symdh: Runner) -> None:
    table = ROOT / "examples" / "scara.yaml"
    texts = {
        run_symdh("latex", table, "--sheet", "solution", env={"PYTHONHASHSEED": seed}).stdout
        for seed in ("1", "2", "3")
    }
    assert len(texts) == 1
    assert "Exercise" in texts.pop()
