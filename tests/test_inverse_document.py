"""The derivation of inverse kinematics as a teacher reads it: nothing comes before it is told."""

from __future__ import annotations

import functools
import math
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from inverse_checks import CLOSED, DATA, derived, pose_of, symbol
from oracle import read_arm
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
from symdh.kinematics.inverse import check
from symdh.kinematics.inverse.inverse import inverse_kinematics
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
from symdh.render.latex import render_latex
from symdh.render.terminal import render_chapters

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
