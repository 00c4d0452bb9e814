"""The handout in Typst: the same pages as in LaTeX, nothing off the page, text prints as itself."""

from __future__ import annotations

import re
import subprocess
import sys
import time
import unicodedata
from pathlib import Path

import pytest
from conftest import Runner
from hostile import TITLES
from sympy import Rational

import symdh
from symdh.derivation.blocks import Chapter, Display, Document, NamedMatrix, Paragraph
from symdh.derivation.derive import derive
from symdh.derivation.frames import frames_document
from symdh.derivation.inverse import inverse_document
from symdh.errors import LimitError, OutputError
from symdh.frames import assign_frames
from symdh.kinematics.inverse.inverse import inverse_kinematics
from symdh.notation.nodes import (
    Call,
    Degrees,
    Equation,
    Fraction,
    Generic,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Pi,
    PoseName,
    Power,
    Product,
    Root,
    Rounded,
    Short,
    Sum,
    Tuple,
    Unit,
)
from symdh.render import pdf
from symdh.render.latex import render_latex
from symdh.render.latex_math import LatexWriter
from symdh.render.pdf import compile_pdf, compile_typst, find_engine
from symdh.render.typst import render_typst
from symdh.render.typst_math import TypstWriter
from symdh.render.typst_text import typst_text
from symdh.table.axes import read_mechanism
from symdh.table.source import read_source
from tools import require_tool

pytest.importorskip("typst")

ROOT = Path(__file__).parent
EXAMPLES = ROOT.parent / "examples"
CORPUS = ROOT / "data" / "tables"

#: Of A4; the margins are 25 mm, punctuation at the end of a line may hang over by part of itself.
PAGE, MARGIN, HANGING = 595.28, 70.87, 3.5


def document(*blocks: Paragraph | Display | NamedMatrix, title: str = "Title") -> Document:
    return Document(title, ("Subtitle",), (Chapter("Chapter", blocks),))


def pages(content: bytes, folder: Path, *options: str) -> str:
    (folder / "handout.pdf").write_bytes(content)
    ran = subprocess.run(
        [require_tool("pdftotext"), *options, "-enc", "UTF-8", "handout.pdf", "-"],
        cwd=folder,
        capture_output=True,
        encoding="utf-8",
        timeout=60,
        check=True,
    )
    return ran.stdout


def printed(written: Document, folder: Path) -> str:
    return pages(compile_typst(render_typst(written)), folder, "-layout")


def outside(content: bytes, folder: Path, page: float = PAGE, margin: float = MARGIN) -> list[str]:
    """Return the words that stand in a margin."""
    found = pages(content, folder, "-bbox")
    words = re.findall(r'xMin="(\S+)" yMin="(\S+)" xMax="(\S+)" yMax="(\S+)">([^<]*)', found)
    assert words
    return [
        word
        for left, top, right, bottom, word in words
        if float(left) < margin - 0.1
        or float(right) > page - margin + HANGING
        or float(top) < 60
        or float(bottom) > 805
    ]


def story(name: str) -> Document:
    """Return a document by the table or mechanism that it tells of."""
    if name == "frames":
        axes = read_source(str(EXAMPLES / "mechanisms" / "scara_axes.yaml"))
        return frames_document(assign_frames(read_mechanism(axes).mechanism, None))
    if name == "inverse":
        return inverse_document(inverse_kinematics(symdh.load(EXAMPLES / "puma560.yaml")))
    folder = EXAMPLES if (EXAMPLES / f"{name}.yaml").is_file() else CORPUS
    return derive(symdh.load(folder / f"{name}.yaml"))


# -- whole documents ------------------------------------------------------------------------------

STORIES = [
    *("planar_2r", "scara", "puma560", "ur5", "rrp_modified"),
    "kinova_jaco",
    *("inverse", "frames"),
]


@pytest.mark.parametrize("name", STORIES)
def test_nothing_stands_in_a_margin(name: str, tmp_path: Path) -> None:
    assert outside(compile_typst(render_typst(story(name))), tmp_path) == []


def test_nothing_stands_in_a_margin_of_letter_paper(tmp_path: Path) -> None:
    content = compile_typst(render_typst(story("puma560"), paper="letter"))
    assert outside(content, tmp_path, page=612, margin=79.2) == []


def test_the_test_sees_what_runs_off_the_page(tmp_path: Path) -> None:
    wide = Equation((Name("x"), Product(tuple(Name(f"a{k}") for k in range(90)))))
    content = compile_typst(render_typst(document(Display(wide))))
    assert outside(content, tmp_path) != []


@pytest.mark.parametrize("name", ["planar_2r", "scara", "rrp_modified", "frames"])
def test_both_papers_say_the_same(name: str, tmp_path: Path) -> None:
    """Letters and digits of the two PDFs, whatever the order in which a page lays them out."""
    require_tool("pdflatex")
    told = story(name)

    def letters(content: bytes) -> dict[str, int]:
        text = unicodedata.normalize("NFKD", pages(content, tmp_path))
        known = {"ϕ": "φ", "ϵ": "ε"}
        kept = [known.get(c, c) for c in text if c.isalnum()]
        return {c: kept.count(c) for c in set(kept)}

    ours, latex = (
        letters(compile_typst(render_typst(told))),
        letters(compile_pdf(render_latex(told))),
    )
    # Page numbers differ with the number of pages; nothing else does.
    differing = {c for c in {*ours, *latex} if ours.get(c, 0) != latex.get(c, 0)}
    assert all(c.isdigit() and abs(ours[c] - latex[c]) <= 1 for c in differing)


def test_the_same_handout_gives_the_same_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    text = render_typst(story("planar_2r"))
    first = compile_typst(text)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000000000")
    monkeypatch.setenv("TZ", "Pacific/Auckland")
    time.sleep(1.1)
    assert compile_typst(text) == first
    assert b"/CreationDate" not in first
    assert b"symdh" in first


# -- formulas -------------------------------------------------------------------------------------

FORMULAS: list[tuple[Node, str]] = [
    (Equation((Name("theta12"), Name("L_tool"))), "θ12=Ltool"),
    (Name("phi_elbow2b"), "ϕelbow2b"),
    (Name("errno"), "errno"),
    (Product((Name("sin1"), Name("frac"), Name("mat"))), "sin1fracmat"),
    (Name("q1", starred=True), "q1∗"),
    (Generic("r", "31", stage="12"), "r31(12)"),
    (Short("c", "1-2"), "c1−2"),
    (Short("s", "1,10"), "s1,10"),
    (PoseName("0", "10", craig=True), "010T"),
    (PoseName("i-1", "tool", craig=False), "i−1Ttool"),
    (Degrees(Rational(45, 2)), "22.5°"),
    (Rounded("-1.5e-07"), "−1.5⋅10−07"),
    (Sum((Name("a"), Negative(Name("b")))), "a−b"),
    (Product((Number(Rational(2)), Unit("mm"))), "2mm"),
    (Tuple((Name("x"), Name("y"))), "(x,y)"),
    (Call("atan2", (Name("x"), Name("y"))), "atan2(x,y)"),
    (Call("sin", (Name("x"),)), "sinx"),
    (Call("asin", (Sum((Name("x"), Name("y"))),)), "arcsin(x+y)"),
    (Power(Sum((Name("a"), Name("b"))), Rational(3)), "(a+b)3"),
    (Power(Name("a1"), Rational(2)), "a21"),
    (Product((Number(Rational(2)), Pi())), "2π"),
    (Generic("z", "i+1"), "zi+1"),
]


@pytest.fixture(scope="module")
def formulas(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The texts of all formulas, from one document with a mark before each."""
    blocks = [
        block for formula, _ in FORMULAS for block in (Paragraph(("Mark",)), Display(formula))
    ]
    text = printed(document(*blocks), tmp_path_factory.mktemp("formulas"))
    without_numbers = re.sub(r"\n\s*\d+\s*\f", "\n", text)
    return without_numbers.split("Mark")


@pytest.mark.parametrize("place", range(len(FORMULAS)), ids=lambda k: FORMULAS[k][1])
def test_a_formula_is_printed(place: int, formulas: list[str]) -> None:
    """As the text of the page; scripts follow their letter, in whatever order."""
    found = "".join(unicodedata.normalize("NFKC", formulas[place + 1]).split())
    assert sorted(found) == sorted(unicodedata.normalize("NFKC", FORMULAS[place][1]))


@pytest.mark.parametrize(
    "formula",
    [
        *(formula for formula, _ in FORMULAS),
        Fraction(Name("a"), Sum((Name("b"), Name("c")))),
        Root(Sum((Name("b"), Name("c")))),
        Call("abs", (Name("x"),)),
        Matrix(((Number(Rational(1, 2)), Name("x")), (Name("y"), Tuple((Name("u"), Name("v")))))),
    ],
    ids=lambda value: str(value)[:40],
)
def test_widths_are_those_of_latex(formula: Node) -> None:
    """So that both break lines at the same places."""
    assert TypstWriter().width(formula) == LatexWriter().width(formula)


# -- text -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("title", [*TITLES, "naïve x² Ω φ"])
def test_a_title_prints_as_itself(title: str, tmp_path: Path) -> None:
    written = document(Paragraph((title, " inside")), title=title)
    page = "".join(printed(written, tmp_path).split())
    expected = unicodedata.normalize("NFKC", "".join(title.split()))
    page = unicodedata.normalize("NFKC", page).replace("ϕ", "φ")
    assert page.count(expected.replace("ϕ", "φ")) == 2


def test_every_character_of_ascii_prints_as_itself(tmp_path: Path) -> None:
    signs = "".join(chr(code) for code in range(33, 127))
    twins = " ".join(2 * sign for sign in signs)
    text = printed(document(Paragraph((f"{signs} {twins} end",))), tmp_path)
    page = "".join(text.replace("\u00ad", "").split())
    assert signs in page
    assert "".join(twins.split()) in page


def test_what_the_font_lacks_is_told_by_its_code(tmp_path: Path) -> None:
    page = printed(document(Paragraph(("ệ あ \u0007 \u202e 😀 end",))), tmp_path)
    assert "e [U+3042] [U+0007] [U+202E] [U+1F600] end" in page


def test_white_space_is_a_space() -> None:
    assert typst_text("a\tb\nc\u2028d") == "a b c d"
    assert typst_text("a\u00a0b") == "a~b"  # Typst's own sign for a space that is not broken


# -- the run --------------------------------------------------------------------------------------


def test_a_run_that_does_not_end_is_ended() -> None:
    endless = "#for i in range(99999) { for j in range(99999) { let product = i * j } }"
    start = time.monotonic()
    with pytest.raises(LimitError, match="typst did not end within 1 s and was stopped"):
        compile_typst(endless, time_limit=1.0)
    assert time.monotonic() - start < 6


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("#nosuch", "unknown variable: nosuch"),
        ('#read("/etc/passwd")', "file not found"),
        ('#read("../../../../etc/passwd")', "typst failed"),
        ('#import "@preview/cetz:0.3.1"', "failed to download package"),
    ],
)
def test_what_fails_says_why(text: str, says: str) -> None:
    with pytest.raises(OutputError, match=re.escape(says)):
        compile_typst(text)


def test_a_module_in_the_folder_is_not_picked_up(tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "typst.py").write_text("raise SystemExit('picked up')")
    ran = run_symdh("pdf", EXAMPLES / "planar_2r.yaml", "-o", "a.pdf", "--engine", "typst")
    assert (ran.returncode, ran.stdout) == (0, ""), ran.stderr
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF-")


def test_typst_is_taken_where_there_is_no_tex(tmp_path: Path, run_symdh: Runner) -> None:
    ran = run_symdh("pdf", EXAMPLES / "planar_2r.yaml", env={"PATH": str(tmp_path)})
    assert ran.returncode == 0, ran.stderr
    assert b"Typst" in (tmp_path / "planar_2r.pdf").read_bytes()
    again = run_symdh("pdf", EXAMPLES / "planar_2r.yaml", env={"PATH": str(tmp_path)})
    assert "(unchanged)" in again.stderr


def test_tex_is_taken_before_typst() -> None:
    require_tool("pdflatex")
    assert find_engine() in ("latexmk", "pdflatex")


def test_without_both_the_message_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "typst", None)
    monkeypatch.setattr(pdf.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(OutputError, match=r"pip install 'symdh\[pdf\]'"):
        compile_typst("x")
    with pytest.raises(OutputError) as caught:
        compile_pdf("x", engine=find_engine())
    assert "apt install texlive-latex-recommended" in str(caught.value)
    assert "pip install 'symdh[pdf]'" in str(caught.value)


def test_a_preamble_in_latex_is_not_for_typst(tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "own.tex").write_text("% mine")
    options = ("--engine", "typst", "--preamble", "own.tex")
    ran = run_symdh("pdf", EXAMPLES / "planar_2r.yaml", *options)
    assert ran.returncode == 2
    assert "--preamble is LaTeX" in ran.stderr


def test_what_typst_refuses_is_kept(tmp_path: Path, run_symdh: Runner) -> None:
    own = tmp_path / "own" / "typst" / "document.typ.jinja"
    own.parent.mkdir(parents=True)
    own.write_text("// Written by symdh\n#nosuch\n")
    options = ("-o", "a.pdf", "--engine", "typst", "--templates", "own")
    ran = run_symdh("pdf", EXAMPLES / "planar_2r.yaml", *options)
    assert ran.returncode == 3
    assert "typst failed: unknown variable: nosuch; the Typst is kept in a.typ" in ran.stderr
    assert "#nosuch" in (tmp_path / "a.typ").read_text()
    assert not (tmp_path / "a.pdf").exists()
