"""The derivation of inverse kinematics as a teacher reads it: nothing comes before it is told."""

from __future__ import annotations

import functools
import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from inverse_checks import CLOSED, DATA, derived, pose_of, symbol
from oracle import read_arm
from sympy import Integer
from test_latex import overfull, typeset

import symdh
from symdh.cli.main import run
from symdh.derivation.blocks import (
    Chapter,
    Display,
    Document,
    EntrySteps,
    MatrixRow,
    NamedMatrix,
    Paragraph,
    ParameterTable,
)
from symdh.derivation.inverse import Solved, inverse_document
from symdh.derivation.inverse.half_angle import half_angle
from symdh.derivation.inverse.names import Writer, goal_letters
from symdh.derivation.inverse.singular import around
from symdh.derivation.inverse.structure import missing_structure
from symdh.derivation.inverse.telling import Telling
from symdh.derivation.style import Style
from symdh.kinematics.inverse import check
from symdh.kinematics.inverse.branches import branches_of
from symdh.kinematics.inverse.inverse import InverseKinematics, Method, inverse_kinematics
from symdh.kinematics.inverse.solution import Rule, Tried
from symdh.kinematics.inverse.structure import Structure
from symdh.notation.names import split_name
from symdh.notation.nodes import (
    Equation,
    Generic,
    Name,
    Node,
    Number,
    PoseName,
    Short,
    Sum,
    leaves,
)
from symdh.render import pdf
from symdh.render.inverse_json import inverse_json
from symdh.render.latex import render_latex
from symdh.render.terminal import render_chapters
from symdh.render.unicode_math import UnicodeWriter

each_closed = pytest.mark.parametrize("table", CLOSED, ids=lambda path: path.stem)

EXAMPLES = Path(__file__).parents[1] / "examples"

#: What a paragraph says before a letter that it introduces.
_INTRODUCED_BY = ("With a length ", " and an angle ", "point ", "called ", "Of its entries ")
#: No equation has more terms on both sides; the arms named below honestly need more.
_MOST_TERMS = 11
_LONGER = {
    # Twists of 55, 70 and 80 degrees leave a sine or a cosine in every term of a quartic's start.
    "pieper_generic": 18,
    # A joint is held, and its sine and cosine stay in every product.
    "franka_panda": 14,
    # Three offsets of the hand that are carried back through two joints.
    "three_parallel_only": 12,
}


@functools.cache
def document_of(table: Path) -> Document:
    return inverse_document(derived(table)[0])


def told(table: Path) -> str:
    return render_chapters(inverse_document(inverse_kinematics(symdh.load(table))).chapters, 200)


def in_order(text: str, lines: list[str]) -> None:
    place = 0
    for line in lines:
        assert line in text[place:], line
        place = text.index(line, place) + len(line)


# ---------------------------------------------------------------- introduced before it is used


def symbol_of(leaf: Node) -> tuple[str, ...] | None:
    """What a symbol is known by, however it was written; None for what is none."""
    match leaf:
        case Name(text=text):
            return split_name(text)
        case Generic(letter="*"):
            return None
        case Generic(letter=letter, index=index, stage=stage):
            return (letter, index, stage) if stage else (letter, index)
        case Short(function=function, label=label):
            return function, label, "of an angle"
        case PoseName(start=start, end=end):
            return "pose", start, end
    return None


def symbols(*nodes: Node) -> set[tuple[str, ...]]:
    return {s for node in nodes for leaf in leaves(node) if (s := symbol_of(leaf)) is not None}


class Reader:
    """Reads a document from the beginning and keeps what it has been told."""

    def __init__(self) -> None:
        self.known: set[tuple[str, ...]] = set()
        self.unknown: list[str] = []

    def read(self, document: Document) -> list[str]:
        for chapter in document.chapters:
            for block in chapter.blocks:
                self._read(block)
        return self.unknown

    def _read(self, block: object) -> None:
        match block:
            case ParameterTable(header=header, rows=rows, notes=notes) if not self.known:
                self.known |= symbols(*header, *(cell for row in rows for cell in row))
                ends = [part for note in notes for part in note if not isinstance(part, str)]
                self.known |= symbols(*ends)
            case ParameterTable(header=header, rows=rows):
                self._define_cells(header, rows)
            case Paragraph(content=content):
                self._paragraph(content)
            case NamedMatrix(names=names, matrix=matrix):
                self.known |= symbols(names[0], matrix)
                self._use(block, *names)
            case MatrixRow(matrices=matrices):
                for each in matrices:
                    self._use(each.matrix, each.matrix)
                    self.known |= symbols(*each.names)
            case EntrySteps(entries=entries):
                for entry in entries:
                    self._define(Equation((entry.name, *entry.forms)))
            case Display(formula=formula):
                self._define(formula)
            case _:
                raise AssertionError(f"a block that this test does not read: {block}")

    def _define_cells(self, header: tuple[Node, ...], rows: tuple[tuple[Node, ...], ...]) -> None:
        self._use("table", *header, *(cell for row in rows for cell in row))

    def _paragraph(self, content: tuple[object, ...]) -> None:
        introducing = False
        for part in content:
            if isinstance(part, str):
                listing = introducing and part in {", ", " and "}
                introducing = listing or part.endswith(_INTRODUCED_BY)
            elif isinstance(part, Equation):
                self._define(part)
            elif introducing:
                self.known |= symbols(part)  # type: ignore[arg-type]
            else:
                self._use(content, part)  # type: ignore[arg-type]

    def _define(self, formula: Node) -> None:
        """A formula that begins with a symbol of its own defines it."""
        if isinstance(formula, Equation):
            first, *rest = formula.sides
            names = first.sides if isinstance(first, Equation) else (first,)
            if all(symbol_of(n) is not None and symbol_of(n) not in self.known for n in names):
                self._use(formula, *rest)
                self.known |= symbols(*names)
                return
        self._use(formula, formula)

    def _use(self, where: object, *nodes: Node) -> None:
        unknown = sorted(s for s in symbols(*nodes) - self.known if not self._is_one_of(s))
        self.unknown += [f"{s} in {where}" for s in unknown]

    def _is_one_of(self, symbol: tuple[str, ...]) -> bool:
        """A_1 where A_i has been told, the pose of frame 2 in frame 1 as that of i in i-1, c_1."""
        if symbol[-1] == "of an angle" and len(symbol[1]) == 1:
            return (symbol[0], "i") in self.known
        if symbol[0] == "pose" and all(part.isdigit() for part in symbol[1:]):
            return ("pose", "i-1", "i") in self.known and int(symbol[2]) == int(symbol[1]) + 1
        return symbol[0] == "A" and symbol[1].isdigit() and ("A", "i") in self.known


@each_closed
def test_every_symbol_is_introduced_before_it_is_used(table: Path) -> None:
    assert Reader().read(document_of(table)) == []


@pytest.mark.parametrize("name", ["planar_2r_modified", "rrp_modified", "minimover_5r", "ur5"])
def test_symbols_of_the_examples_are_introduced_too(name: str) -> None:
    found = inverse_kinematics(symdh.load(EXAMPLES / f"{name}.yaml"))
    assert Reader().read(inverse_document(found)) == []


def test_the_reader_of_this_test_notices_what_is_not_introduced() -> None:
    document = document_of(DATA / "tables" / "planar_2r.yaml")
    without = tuple(c for c in document.chapters if c.title != "The links")
    unknown = Reader().read(Document(document.title, document.subtitle, without))
    assert any("'c', '12'" in each for each in unknown)
    assert any("'a', '1'" in each for each in Reader().read(
        Document(document.title, document.subtitle, document.chapters[1:])
    ))  # fmt: skip


@each_closed
def test_a_letter_means_one_thing(table: Path) -> None:
    """A length rho and an angle psi are given a value once."""
    defined = [
        symbol
        for block in document_of(table).blocks
        if isinstance(block, EntrySteps)
        for entry in block.entries
        if (symbol := symbol_of(entry.name)) is not None and symbol[0] in {"rho", "psi"}
    ]
    assert len(defined) == len(set(defined))


# ---------------------------------------------------------------- length


def formulas(chapter: Chapter) -> Iterator[Node]:
    for block in chapter.blocks:
        match block:
            case EntrySteps(entries=entries):
                for entry in entries:
                    yield Equation((entry.name, *entry.forms))
            case Display(formula=formula):
                yield formula


def terms(node: Node) -> int:
    """The terms of a side, those in brackets too."""
    match node:
        case Equation(sides=sides):
            return sum(terms(side) for side in sides)
        case Sum(terms=parts):
            return sum(terms(part) for part in parts)
        case Number(value=0):
            return 0
        case _:
            nested = [getattr(node, "node", None), *getattr(node, "factors", ())]
            nested += [getattr(node, name, None) for name in ("numerator", "radicand", "base")]
            inside = [terms(part) for part in nested if part is not None]
            return max([1, sum(n for n in inside if n > 1)])


@each_closed
def test_no_equation_is_long(table: Path) -> None:
    most = _LONGER.get(table.stem, _MOST_TERMS)
    for chapter in document_of(table).chapters:
        for formula in formulas(chapter):
            assert terms(formula) <= most, (chapter.title, terms(formula))


# ---------------------------------------------------------------- the route of the books


def test_the_last_joint_of_a_spherical_wrist_needs_no_division() -> None:
    """Row 3 of A_4^-1 E = A_5 A_6 is (-s_6, -c_6, 0): true at theta_5 = 0 as well."""
    text = told(EXAMPLES / "puma560.yaml")
    in_order(
        text,
        [
            "Joint 6\n",
            "A₄⁻¹ E = A₅ A₆",
            "s₆ = e₂₁ c₄ - e₁₁ s₄",
            "c₆ = e₂₂ c₄ - e₁₂ s₄",
            "θ₆ = atan2(s₆, c₆)",
        ],
    )
    assert "/s₅" not in text


def test_the_puma_is_solved_as_in_the_books() -> None:
    """The square of the wrist's distance over 2 a_2; theta_2 by the vector (k_2, w_z)."""
    in_order(
        told(EXAMPLES / "puma560.yaml"),
        [
            "the centre of the wrist",
            "d₃ = w_x s₁ - w_y c₁",
            "w_x² + w_y² + w_z² = a₂² + a₃² + d₃² + d₄² + 2 a₂ a₃ c₃ - 2 a₂ d₄ s₃",
            "k₁ = (w_x² + w_y² + w_z² - a₂² - a₃² - d₃² - d₄²)/(2 a₂)",
            "a₃ c₃ - d₄ s₃ = k₁",
            "ρ₂ = √(a₃² + d₄²)",
            "k₂ = w_x c₁ + w_y s₁",
            "ψ₃ = atan2(w_z, k₂)",
            "c₅",
        ],
    )


def test_the_ur5_takes_its_last_joint_from_the_row_with_s5() -> None:
    """Row 3 of A_1^-1 G: (s_5 c_6, -s_5 s_6, c_5); another pair where theta_5 is zero."""
    in_order(
        told(EXAMPLES / "ur5.yaml"),
        [
            "Joint 6\n",
            "s₆ = (r₂₂ c₁ - r₁₂ s₁)/s₅",
            "c₆ = (r₁₁ s₁ - r₂₁ c₁)/s₅",
            "Where s₅ is zero, this pair says nothing: the axes of joints 4 and 6 are parallel",
            "s₂₃₄ c₅ c₆ + c₂₃₄ s₆ = r₃₁",
            "e_x² + e_y² = a₂² + a₃² + 2 a₂ a₃ c₃",
            "θ₄ = θ₂₃₄ - θ₂ - θ₃",
        ],
    )


def test_the_minimover_reads_theta_234_off_the_approach_vector() -> None:
    """With alpha_4 = 90 deg, A_1^-1 G has (s_234, -c_234, 0) in its third column."""
    text = told(EXAMPLES / "minimover_5r.yaml")
    in_order(text, ["r₃₃ = c₂₃₄", "s₂₃₄ = r₁₃ c₁ + r₂₃ s₁", "θ₂₃₄ = atan2(s₂₃₄, c₂₃₄)"])
    assert "Joints 2 and 3 together" not in text


def test_a_letter_that_was_given_is_used_again() -> None:
    """k_1 = p_x c_1 + p_y s_1 comes back in d_3."""
    in_order(
        told(EXAMPLES / "rrp_modified.yaml"),
        ["k₁ = p_x c₁ + p_y s₁", "k₁ c₂ + p_z s₂ = a₂", "d₃ = k₁ s₂ - p_z c₂"],
    )


def test_branches_are_named_in_the_table() -> None:
    text = told(EXAMPLES / "puma560.yaml")
    rows = [line for line in text.splitlines() if line.lstrip().startswith(("1 ", "8 "))]
    assert any("shoulder left, elbow down, wrist flipped" in row for row in rows)
    assert any("shoulder right, elbow down, wrist not flipped" in row for row in rows)


# ---------------------------------------------------------------- remarks that hold


def test_an_angle_is_not_called_free_where_the_goal_is_out_of_reach() -> None:
    """With the wrist's centre on the first axis the PUMA's d_3 cannot be there; SCARA turns."""
    puma = told(EXAMPLES / "puma560.yaml")
    assert "w_x and w_y are both zero" not in puma
    assert "Where ρ₁² is less than d₃², the goal is out of reach" in puma
    assert "q₁ is free; then the point w lies on the axis of joint 1" in told(
        EXAMPLES / "scara.yaml"
    )


def test_aligned_axes_are_named() -> None:
    assert "the axes of joints 4 and 6 are in line" in told(EXAMPLES / "puma560.yaml")
    assert "the axes of joints 4 and 6 are parallel" in told(EXAMPLES / "ur5.yaml")
    wrist = told(DATA / "tables" / "zyz_wrist.yaml")
    assert "the axes of joints 1 and 3 are in line" in wrist
    assert "meet in one point, which no joint moves" in wrist


@pytest.mark.parametrize("length", ["0.4318", "-0.4318"])
def test_printed_branches_are_those_of_the_numbers(length: str) -> None:
    """theta_3 = psi_2 +- acos(k_1 / rho_2), worked out by hand with the sign that is printed.

    Dividing by 2 a_2 with a_2 < 0 turns the equation round, and the two solutions with it.
    """
    text = (EXAMPLES / "puma560.yaml").read_text().replace("a2: 0.4318", f"a2: {length}")
    found = inverse_kinematics(symdh.loads(text))
    printed = render_chapters(inverse_document(found).chapters, 200)
    signs = [1 if f"θ₃⁽{k}⁾ = ψ₂ +" in printed else -1 for k in "¹²"]
    assert signs[0] == -signs[1]
    arm = read_arm(text)
    a2, a3, d1, d3, d4 = float(length), 0.0203, 0.67183, 0.15005, 0.4318
    seen = set()
    for q in arm.seeded_poses(6, seed=3):
        goal = pose_of(arm, q)
        x, y, z = goal[0][3], goal[1][3], goal[2][3] - d1
        k = (x * x + y * y + z * z - a2**2 - a3**2 - d3**2 - d4**2) / (2 * a2)
        for answer in found.solver({}).solve(goal.tolist()):
            branch = answer.branches[1]
            theta = math.atan2(-d4, a3) + signs[branch] * math.acos(k / math.hypot(a3, d4))
            assert abs(math.remainder(theta - answer.q[2], 2 * math.pi)) < 1e-9
            seen.add(branch)
    assert seen == {0, 1}


# ---------------------------------------------------------------- the numbers of an example


def solved_document(name: str, q: list[float]) -> tuple[Document, list[float]]:
    table = DATA / "tables" / f"{name}.yaml"
    found = inverse_kinematics(symdh.load(table))
    goal = pose_of(read_arm(table.read_text()), np.array(q)).tolist()
    solved = Solved(goal, found.solver({}).solve(goal))
    return inverse_document(found, solved), list(solved.answers[0].q)


def test_an_example_puts_the_numbers_in() -> None:
    """rho and psi worked out with plain floats from the lengths of the table."""
    document, (first, second) = solved_document("planar_2r", [0.5, 0.8])
    lengths = symdh.load(DATA / "tables" / "planar_2r.yaml").values
    a1, a2 = (float(lengths[symbol(name)]) for name in ("a1", "a2"))
    y, x = a1 + a2 * math.cos(second), a2 * math.sin(second)
    text = render_chapters(document.chapters[-1:], 200)
    in_order(
        text,
        [
            "An example",
            "Joint 2:",
            f"θ₂ = {math.degrees(second):.3f}°",
            "Joint 1:",
            f"ρ₁ = {math.hypot(x, y):.4f}",
            f"ψ₁ = {math.degrees(math.atan2(y, x)):.3f}°",
            f"θ₁ = {math.degrees(first):.3f}°",
        ],
    )


@pytest.mark.parametrize(
    ("name", "q"),
    [
        ("puma560", [0.3, 0.4, 0.5, 0.6, 0.7, 0.8]),
        ("ur5", [0.3, 0.4, 0.5, 0.6, 0.7, 0.8]),
        ("minimover_5r", [0.3, 0.4, 0.5, 0.6, 0.7]),
        ("scara_rrpr", [0.3, 0.4, 0.1, 0.6]),
    ],
)
def test_symbols_of_an_example_are_those_of_the_derivation(name: str, q: list[float]) -> None:
    document, _ = solved_document(name, q)
    assert document.chapters[-1].title == "An example"
    assert Reader().read(document) == []


def test_a_branch_without_a_name_is_called_as_in_the_derivation() -> None:
    document, _ = solved_document("minimover_5r", [0.3, 0.4, 0.5, 0.6, 0.7])
    numbers = render_chapters(document.chapters[-2:-1], 200)
    assert "1: θ₁⁽¹⁾, elbow up." in numbers
    assert "theta" not in numbers


# ---------------------------------------------------------------- on paper


@pytest.mark.parametrize(
    "name", ["pieper_generic", "franka_panda", "three_parallel_only", "kinova_jaco", "puma560"]
)
def test_no_line_runs_off_the_page(name: str, tmp_path: Path) -> None:
    """The arms with the longest equations."""
    log = typeset(render_latex(document_of(DATA / "tables" / f"{name}.yaml")), tmp_path)
    assert overfull(log) == []


def test_a_row_that_does_not_move_is_told_to_be_part_of_its_neighbour() -> None:
    """The Jaco's first joint is held for the search; its motion stands before A_2."""
    text = render_chapters(document_of(DATA / "tables" / "kinova_jaco.yaml").chapters, 200)
    assert "A₁ does not move and is made part of A₂." in text


THREE_IN_A_PLANE = """\
name: arm
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0.5, alpha: 0}
  - {theta: theta2, d: 0, a: 0.4, alpha: 0}
  - {theta: theta3, d: 0, a: 0.1, alpha: 0}
"""


def test_the_angle_of_a_goal_is_in_the_units_of_the_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """At 30, 60 and 10 degrees: x = 0.5 cos 30 + 0.1 cos 100, y = 0.65 + 0.1 sin 100."""
    (tmp_path / "arm.yaml").write_text(THREE_IN_A_PLANE)
    x = 0.5 * math.cos(math.radians(30)) + 0.1 * math.cos(math.radians(100))
    y = 0.65 + 0.1 * math.sin(math.radians(100))
    assert run(["ik", str(tmp_path / "arm.yaml"), "--pose", f"{x} {y} 100"]) == 0
    assert re.search(r"^ +1 +30° +60° +10°$", capsys.readouterr().out, re.MULTILINE)


def test_a_closed_form_that_misses_a_pose_is_a_failure(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """None is known that does, so one of five poses is counted as missed here."""
    (tmp_path / "arm.yaml").write_text(THREE_IN_A_PLANE)

    def missed(*arguments: object) -> check.Trials:
        return check.Trials(5, found=4, counts=Counter({2: 5}), missed=[(0.5, 1.0, -1.5)])

    monkeypatch.setattr(check, "tried", missed)
    assert run(["ik", str(tmp_path / "arm.yaml"), "--check", "5"]) == 2
    said = capsys.readouterr().err
    assert "random poses: 5; joint values found again at 4" in said
    assert "not found again (radians): 0.500000, 1.000000, -1.500000" in said


def test_without_tex_typst_makes_the_pdf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("typst")
    (tmp_path / "arm.yaml").write_text(THREE_IN_A_PLANE)
    monkeypatch.setattr(pdf, "find_engine", lambda: pdf.TYPST)
    made = tmp_path / "arm.pdf"
    assert run(["ik", str(tmp_path / "arm.yaml"), "--format", "pdf", "-o", str(made)]) == 0
    content = made.read_bytes()
    assert content.startswith(b"%PDF-")
    assert b"Typst" in content


# ---------------------------------------------------------------- arms that ask for other words


def arm_of(rows: str, more: str = "", convention: str = "standard") -> symdh.Robot:
    head = f"name: arm\nconvention: {convention}\nunits: {{angle: deg, length: m}}\n"
    return symdh.loads(f"{head}columns: [theta, d, a, alpha]\nrows:\n{rows}{more}")


def arm_told(robot: symdh.Robot, task: str | None = None, lock: str = "") -> str:
    """The derivation for an arm, its white space made single spaces."""
    found = inverse_kinematics(robot, task, [symbol(lock)] if lock else [])
    return " ".join(render_chapters(inverse_document(found).chapters, 200).split())


def table_found(name: str) -> InverseKinematics:
    return derived(DATA / "tables" / f"{name}.yaml")[0]


SPHERE = "  - [theta1, 0, 0, 60]\n  - [theta2, {d2}, a2, 60]\n  - [0, q3, 0, 0]\n"


def test_a_slide_that_stands_in_a_square_has_two_values() -> None:
    """|p|^2 = q3^2 + d2^2 + a2^2 + 2 q3 d2 cos 60 deg, for z_1 and z_2 enclose 60 degrees."""
    told_all = arm_told(arm_of(SPHERE.format(d2="d2")), "x y z")
    in_order(
        told_all,
        [
            "k₁ = p_x² + p_y² + p_z² - a₂² - d₂²",
            "q₃² - k₁ + d₂ q₃ = 0",
            "q₃⁽¹⁾ = (-d₂ + √(4 k₁ + d₂²))/2 q₃⁽²⁾ = (-d₂ - √(4 k₁ + d₂²))/2",
            "Where the radicand is negative, the goal is out of reach.",
        ],
    )
    in_order(
        arm_told(arm_of(SPHERE.format(d2="0")), "x y z"),
        ["k₁ = p_x² + p_y² + p_z² - a₂²", "q₃² - k₁ = 0", "q₃⁽¹⁾ = √(k₁) q₃⁽²⁾ = -√(k₁)"],
    )


PLANE = "  - [theta1, 0, a1, 0]\n  - [theta2, 0, a2, 0]\n"


@pytest.mark.parametrize(
    ("task", "base", "tool", "says"),
    [
        # Of a whole pose T known motions at both ends are taken off.
        ("pose", True, True, "The base and the tool of the table are known, and T is what remains"),
        ("pose", True, False, "The base of the table is known, and T is what remains without it."),
        ("pose", False, True, "The tool of the table is known, and T is what remains without it."),
        # The base turns y into the plane and z out of it, and z is not given.
        ("x y", True, False, "The base of the table is part of A₁."),
        ("x y", False, True, "The tool of the table is part of A₂."),
        ("x y", True, True, "The base of the table is part of A₁. The tool of the table is part"),
    ],
)
def test_what_becomes_of_base_and_tool_is_told(
    task: str, base: bool, tool: bool, says: str
) -> None:
    more = "base: [Rx(30 deg)]\n" * base + "tool: [Ry(40 deg), Tx(0.1)]\n" * tool
    text = arm_told(arm_of(PLANE, more), task)
    assert says in text
    sentences = ("is known, and", "are known, and", "is part of")
    assert sum(map(text.count, sentences)) == says.count(" is part") + (" known, " in says)


def test_one_unknown_has_no_order() -> None:
    assert "The unknowns are found in the order" in arm_told(arm_of(PLANE))
    text = arm_told(arm_of(PLANE), lock="theta2")
    assert "Wanted: one joint, θ₁." in text
    assert "θ₂ is locked and known." in text
    assert "in the order" not in text


SUM = """
  - [theta1, d1, a1, 0]
  - [{second}, d2, {a2}, -90]
  - [theta3, 0, 0, 90]
  - [theta4, 0, 0, 90]
"""


@pytest.mark.parametrize(
    ("second", "a2", "name", "meaning"),
    [
        ("theta2", "a2", "θ₁₂", "θ₁ + θ₂"),
        # No letter is that of both joints.
        ("q2", "a2", "σ₁₂", "θ₁ + q₂"),
        ("q2", "sigma", "τ₁₂", "θ₁ + q₂"),
        # A length that looks like a short form leaves the table without any.
        ("theta2", "c12", "σ₁,₂", "θ₁ + θ₂"),
    ],
)
def test_a_sum_of_joints_has_a_name_of_its_own(
    second: str, a2: str, name: str, meaning: str
) -> None:
    """z_3 = (s_3 c_12, s_3 s_12, c_3) by hand, so that r_12 and r_22 give the sum."""
    text = arm_told(arm_of(SUM.format(second=second, a2=a2)), "pose")
    in_order(
        text,
        [
            f"An unknown of its own is {name} = {meaning}",
            f"{name}⁽¹⁾ = atan2(r₂₂, r₁₂) {name}⁽²⁾ = {name}⁽¹⁾ + 180°",
            f"Where r₁₂ and r₂₂ are both zero, {name} is free",
            f"no. {name}",
            f"1 {name}⁽¹⁾ 2 {name}⁽²⁾",
        ],
    )


@pytest.mark.parametrize(("third", "branch"), [(0.5, "¹"), (-0.5, "²")])
@pytest.mark.parametrize(("second", "name"), [("theta2", "θ₁₂"), ("q2", "σ₁₂")])
def test_a_solution_tells_which_value_of_a_sum_it_has(
    second: str, name: str, third: float, branch: str
) -> None:
    """atan2(r_22, r_12) is the sum itself where s_3 is positive, else it is half a turn off."""
    lengths = "values: {d1: 0.1, a1: 0.4, d2: 0.2, a2: 0.5}\n"
    robot = arm_of(SUM.format(second=second, a2="a2"), lengths)
    found = inverse_kinematics(robot, "pose")
    q = dict(zip(robot.variables, (0.3, 0.4, third, 0.6), strict=True))
    goal = robot.T().xreplace({**robot.values, **q}).tolist()
    goal = [[float(entry) for entry in row] for row in goal]
    (answer,) = found.solver().solve(goal)
    assert list(answer.q) == pytest.approx(list(q.values()), abs=1e-9)
    document = inverse_document(found, Solved(goal, [answer]))
    assert f"1: {name}⁽{branch}⁾." in render_chapters(document.chapters[-2:-1])
    assert Reader().read(document) == []


def test_a_letter_of_the_table_is_not_given_again() -> None:
    """The length a2 of the example is called k1: what is known is k_2."""
    text = re.sub(r"\ba2\b", "k1", (EXAMPLES / "rrp_modified.yaml").read_text())
    document = inverse_document(inverse_kinematics(symdh.loads(text)))
    in_order(
        render_chapters(document.chapters, 200),
        ["k₂ = p_x c₁ + p_y s₁", "k₂ c₂ + p_z s₂ = k₁", "d₃ = k₂ s₂ - p_z c₂"],
    )


def test_a_minus_before_what_is_known_stands_before_the_fraction() -> None:
    """With k_2 = w_y / 2 - w_z cos 30 deg, q_3 c_2 = -k_2: the sign comes to the front."""
    rows = "  - [theta1, 0, a1, 30]\n  - [theta2, 0.1, a2, 90]\n  - [0, q3, 0, -90]\n"
    in_order(
        arm_told(arm_of(rows, convention="modified")),
        ["k₂ = 1/2 w_y - √3/2 w_z", "q₃ c₂ = √3/2 w_z - 1/2 w_y Hence q₃ = -k₂/c₂"],
    )


def test_equations_that_stand_there_are_not_collected_again() -> None:
    """The origin of frame 2 is (a2, -d2) turned by theta_1: that is a rotation as it stands."""
    rows = "  - [theta1, 0.3, 0, 0]\n  - [theta2, 0.2, 0.1, 90]\n  - [theta3, d3, 0, -90]\n"
    text = arm_told(arm_of(rows, convention="modified"), "pose")
    assert text.count("w_x = a₂ c₁ + d₂ s₁ w_y = a₂ s₁ - d₂ c₁") == 1
    assert "Collected" not in text
    assert "w_x = ρ₁ sin(ψ₁ - θ₁) w_y = ρ₁ cos(ψ₁ - θ₁)" in text


def test_a_pair_that_the_goal_may_spoil_is_not_promised() -> None:
    """Other pairs hold entries of the goal, so that nobody knows where they fail.

    z_1 and z_3 are at right angles to z_2, and parallel where cos theta_2 = 0, by hand; behind a
    slide there are no three axes of which that could be said.
    """
    rows = "  - [theta1, 0, a1, 90]\n  - [theta2 + 90, 0.4, a2, -90]\n  - [theta3, 0, a3, 90]\n"
    text = arm_told(arm_of(rows, convention="modified"), "x y phi")
    may = "Another pair of entries may serve there; where none does, θ₁ is free:"
    parallel = "the axes of joints 1 and 3 are parallel"
    assert f"Where c₂ is zero, this pair says nothing: {parallel}. {may} then {parallel}" in text
    slide = "  - [theta1, 0.2, 0, 90]\n  - [90, q2, 0.8, 0]\n  - [theta3, 0.8, 0.4, -90]\n"
    text = arm_told(arm_of(f"{slide}  - [theta4, d4, 0.5, -90]\n"))
    assert f"Where c₃ is zero, this pair says nothing. {may} it may keep the value" in text


def writer_of(found: InverseKinematics) -> Writer:
    form = found.form
    assert form is not None
    return Writer(Style(form.arm.robot, leading=goal_letters(form)), form, branches_of(form))


def test_a_quotient_by_one_is_no_fraction() -> None:
    writer, text = writer_of(table_found("planar_2r")), UnicodeWriter().text
    half = symbol("a1") / 2
    assert text(writer.quotient(half, Integer(1))) == "1/2 a₁"
    assert text(writer.quotient(half, Integer(-1))) == "-1/2 a₁"


def test_squares_of_what_stands_alone_are_divided_by_nothing() -> None:
    """r_33 is the first component of a vector, what k_3 stands for a_1 times the second."""
    text = arm_told(
        arm_of(
            "  - [theta1, 0, a1, 90]\n  - [theta2 + 10 deg, d2, 0, 90]\n  - [0, q3, a3, 0]\n"
            "  - [theta4, d4, 0, 90]\n  - [90 deg, q5, 0, 90]\n  - [theta6, 0, 0, 0]\n"
        )
    )
    assert "r₃₃² + k₃²/a₁² = [cos 10°]² c₄² + [sin 10°]² c₄²" in text


def test_nothing_is_named_about_the_zero_of_a_sum() -> None:
    """Of the angle of one joint the axes beside it can be told, of that of several they cannot."""
    form = writer_of(table_found("minimover_5r")).form
    rows = [tuple(row for row, _ in each) for each in form.ring.forms]
    assert around(form, 2 * rows.index((2, 3, 4))) is None


def test_two_short_equations_need_no_letters_before_an_angle_is_eliminated() -> None:
    """For x and y with sin x = p and cos x = sin y: squared and added, sin^2 y + p^2 = 1."""
    found = inverse_kinematics(
        arm_of("  - [theta1, d1, a1, 70]\n  - [theta2, d2, a2, 50]\n"), "x y"
    )
    writer = writer_of(found)
    ring, form = writer.form.ring, writer.form
    (step,) = (step for step in form.steps if step.rule is Rule.HALF_ANGLE)
    letter = dict(zip(ring.letters, ring.ring.gens, strict=True))
    assert step.eliminated is not None
    goal = next(k for k in range(len(ring.letters)) if ring.is_given(k))
    known, sine = ring.letters[goal], writer.sine(step.unknown)
    one, zero = ring.one, ring.zero
    short = replace(step, coefficients=(one, zero, -letter[known], zero, one, -letter[sine]))
    blocks = half_angle(Telling(writer, "joint", replace(short, scales=())))
    text = " ".join(render_chapters([Chapter("T", tuple(blocks))], 200).split())
    write = UnicodeWriter().text
    x, y = (write(writer.unknown(k)) for k in (step.eliminated, step.unknown))
    assert f"These are two equations that hold {x} and {y} alone:" in text
    assert "With a letter" not in text
    squares = [f"{write(writer.expression(each))}²" for each in (sine, known)]
    assert any(f"{a} + {b} = 1" in text for a, b in (squares, squares[::-1]))


# ---------------------------------------------------------------- where there is no closed form


def test_what_is_missing_for_a_closed_form_is_said() -> None:
    bare = Structure((), None, None, ())
    assert missing_structure(bare, 5) == (
        "The rules that are known here do not settle every joint from what is given."
    )
    assert missing_structure(bare, 6).startswith("A closed form is known for six joints where")
    for shape in (
        replace(bare, wrist=(4, 5, 6)),
        replace(bare, shoulder=(1, 2, 3)),
        replace(bare, parallel=((2, 3, 4),)),
    ):
        (_, said) = missing_structure(shape, 6).split(". The structure ")
        assert said == "that the arm has is not enough for the rules that are known here."
    two = missing_structure(replace(bare, parallel=((2, 3),)), 6)
    assert two.startswith("The axes of joints 2 and 3 are parallel: their angles occur as sums. A")


def searched_only(name: str) -> InverseKinematics:
    """An arm as if no closed form of it were known, and the search had found one joint."""
    found = table_found(name)
    assert found.form is not None
    tried = Tried(found.form.steps[:1], (0,))
    return replace(found, method=Method.LEAST_SQUARES, form=None, tried=tried)


def test_a_search_says_that_it_is_one() -> None:
    found = searched_only("planar_2r")
    solver = found.solver()
    arm = read_arm((DATA / "tables" / "planar_2r.yaml").read_text())
    goal = pose_of(arm, np.array([0.5, 0.8])).tolist()
    solved = Solved(goal, solver.solve(goal))
    document = inverse_document(found, solved)
    assert [chapter.title for chapter in document.chapters] == ["No closed form", "Numbers"]
    text = " ".join(render_chapters(document.chapters, 200).split())
    assert "and the search came as far as one step." in text
    assert "What is offered instead is damped least squares from many starting points." in text
    assert "There is no closed form. Solved by damped least squares" in text
    assert "It has two solutions" in text
    assert "1:" not in text
    assert inverse_document(found).chapters == document.chapters[:1]
    content = json.loads(inverse_json(found, solved))
    assert (content["steps"], content["most_solutions"]) == ([], None)
    assert [answer["branches"] for answer in content["solutions"]] == [[], []]


@pytest.mark.parametrize(
    ("searched", "says"),
    [
        (False, "This goal has no solution: it is out of reach."),
        (True, "This goal has no solution that was found; there may be one all the same."),
    ],
)
def test_only_a_closed_form_knows_that_there_is_no_solution(searched: bool, says: str) -> None:
    """Ten metres are farther than an arm of two links of half a metre reaches."""
    found = table_found("planar_2r")
    found = searched_only("planar_2r") if searched else found
    goal = [[1.0, 0, 0, 10], [0, 1.0, 0, 0], [0, 0, 1.0, 0], [0, 0, 0, 1.0]]
    document = inverse_document(found, Solved(goal, found.solver().solve(goal)))
    assert document.chapters[-1].title == "Numbers"
    assert says in " ".join(render_chapters(document.chapters[-1:], 200).split())


def test_a_joint_that_is_free_is_named_beside_its_solution() -> None:
    """Where theta_2 is zero the first and the last axis of a ZYZ wrist are one."""
    found = table_found("zyz_wrist")
    answers = found.solver().solve(np.eye(4).tolist())
    text = render_chapters(inverse_document(found, Solved(np.eye(4).tolist(), answers)).chapters)
    assert re.search(r"\n1: .*singular, θ[₁₃] free\.", text)


def test_a_solution_outside_the_limits_is_marked() -> None:
    """theta_2 may not be negative, and one of the two solutions bends the elbow that way."""
    text = (DATA / "tables" / "planar_2r.yaml").read_text()
    found = inverse_kinematics(symdh.loads(f"{text}limits: {{theta2: [0, 170 deg]}}\n"))
    goal = pose_of(read_arm(text), np.array([0.5, 0.8])).tolist()
    answers = found.solver().solve(goal)
    numbers = render_chapters(inverse_document(found, Solved(goal, answers)).chapters[-2:-1])
    (outside,) = (k for k, answer in enumerate(answers, start=1) if answer.q[1] < 0)
    (line,) = (line for line in numbers.splitlines() if "outside the limits of the table" in line)
    assert line.startswith(f"{outside}: ")
