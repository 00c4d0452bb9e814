r"""The handout as LaTeX: every table compiles, nothing runs off the page, text prints as itself."""

from __future__ import annotations

import functools
import os
import re
import subprocess
import unicodedata
from dataclasses import replace
from pathlib import Path

import pytest
from hostile import TITLES
from sympy import Rational, Symbol, cos, sin

import symdh
from symdh.derivation.blocks import (
    Chapter,
    Display,
    Document,
    Entries,
    EntryStep,
    NamedMatrix,
    Paragraph,
)
from symdh.derivation.derive import derive
from symdh.derivation.style import Naming, Order, Style
from symdh.kinematics.chain import link_word
from symdh.notation import Notation, total_width
from symdh.notation.nodes import Equation, Generic, Juxtaposed, Matrix, Name, Node, Rounded, Sum
from symdh.render.latex import render_latex, render_transform
from symdh.render.latex_math import LatexWriter
from symdh.render.latex_text import latex_text
from symdh.render.layout import LINE
from symdh.render.pdf import compile_pdf
from tools import require_tool

ROOT = Path(__file__).parent
EXAMPLES = [
    path
    for path in sorted((ROOT.parent / "examples").glob("*.yaml"))
    if re.search(r"\{(theta|alpha):|^columns:", path.read_text(encoding="utf-8"), re.MULTILINE)
]
CORPUS = sorted((ROOT / "data" / "tables").glob("*.yaml"))
TABLES = [*EXAMPLES, *CORPUS]

#: Read by nothing but pdflatex with the packages that a plain TeX installation has.
PACKAGES = {
    *("fontenc", "inputenc", "lmodern", "geometry"),
    *("amsmath", "mathtools", "booktabs", "tikz", "hyperref"),
}
FRAGMENT_PREAMBLE = r"""\documentclass[11pt,a4paper]{article}
\usepackage[T1]{fontenc}
\usepackage[utf8]{inputenc}
\usepackage{lmodern}
\usepackage[textwidth=160mm]{geometry}
\usepackage{amsmath,mathtools,booktabs,tikz}
\allowdisplaybreaks
\begin{document}
\input{fragment}
\end{document}
"""

each_table = pytest.mark.parametrize(
    "table", TABLES, ids=lambda path: f"{path.parent.name}/{path.stem}"
)


@functools.cache
def handout(table: Path) -> str:
    return render_latex(derive(symdh.load(table)))


def typeset(tex: str, folder: Path, *, draft: bool = True) -> str:
    """Run pdflatex once and return its log; fail when TeX finds an error."""
    pdflatex = require_tool("pdflatex")
    (folder / "handout.tex").write_text(tex, encoding="utf-8")
    flags = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    environment = {**os.environ, "max_print_line": "10000", "openin_any": "p", "openout_any": "p"}
    ran = subprocess.run(
        [pdflatex, *flags, *(["-draftmode"] if draft else []), "handout.tex"],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=120,
        check=False,
    )
    log = (folder / "handout.log").read_text(encoding="utf-8", errors="replace")
    errors = re.findall(r"^!.*\n(?:.*\n){0,6}", log, re.MULTILINE)
    assert ran.returncode == 0, errors or log[-2000:]
    return log


def overfull(log: str) -> list[str]:
    return re.findall(r"^Overfull \\[hv]box.*", log, re.MULTILINE)


def printed(tex: str, folder: Path) -> str:
    """Return the text of the pages, as a reader who copies it gets it."""
    log = typeset(tex, folder, draft=False)
    assert overfull(log) == []
    return text_of(folder / "handout.pdf")


def text_of(pdf: Path) -> str:
    ran = subprocess.run(
        [require_tool("pdftotext"), "-layout", "-enc", "UTF-8", pdf, "-"],
        capture_output=True,
        encoding="utf-8",
        timeout=60,
        check=True,
    )
    return ran.stdout


def document(*blocks: Paragraph | Display | Entries, title: str = "Title") -> Document:
    return Document(title, ("Subtitle",), (Chapter("Chapter", blocks),))


# -- every table ----------------------------------------------------------------------------------


@each_table
def test_no_line_of_a_handout_is_too_long(table: Path, tmp_path: Path) -> None:
    log = typeset(handout(table), tmp_path)
    assert overfull(log) == []
    assert "LaTeX Warning: Reference" not in log
    assert not re.search(r"^Missing character", log, re.MULTILINE)


@pytest.mark.parametrize("name", ["puma560", "scara", "planar_2r_modified"])
@pytest.mark.parametrize("order", list(Order))
def test_letter_paper_and_the_other_ways_of_writing(
    name: str, order: Order, tmp_path: Path
) -> None:
    robot = symdh.load(ROOT.parent / "examples" / f"{name}.yaml")
    for naming in (Naming.STANDARD, Naming.CRAIG):
        text = render_latex(derive(robot, order, naming), paper="letter")
        assert "letterpaper" in text
        assert "a4paper" not in text
        assert overfull(typeset(text, tmp_path)) == []


@pytest.mark.parametrize("name", ["puma560", "rrp_modified", "stanford", "planar_2r"])
def test_a_fragment_stands_in_a_document_of_ones_own(name: str, tmp_path: Path) -> None:
    robot = symdh.load(ROOT.parent / "examples" / f"{name}.yaml")
    fragment = render_latex(derive(robot), fragment=True)
    assert r"\documentclass" not in fragment
    assert r"\usepackage" not in re.sub(r"^%.*$", "", fragment, flags=re.MULTILINE)
    (tmp_path / "fragment.tex").write_text(fragment, encoding="utf-8")
    assert overfull(typeset(FRAGMENT_PREAMBLE, tmp_path)) == []


@each_table
def test_only_the_packages_that_are_promised(table: Path) -> None:
    text = handout(table)
    found = re.findall(r"\\usepackage(?:\[[^]]*\])?\{([^}]*)\}", text)
    assert {name for each in found for name in each.split(",")} <= PACKAGES


def test_the_test_sees_a_line_that_is_too_long(tmp_path: Path) -> None:
    wide = r"\documentclass{article}\begin{document}\[" + "x+" * 300 + r"x\]\end{document}"
    assert len(overfull(typeset(wide, tmp_path))) == 1


# -- a big arm, wide numbers ----------------------------------------------------------------------


def arm(rows: str, more: str = "", name: str = "arm", convention: str = "standard") -> symdh.Robot:
    head = f"name: {name}\nconvention: {convention}\nunits: {{angle: deg, length: mm}}\n"
    return symdh.loads(f"{head}joints:\n{rows}{more}")


def pose_alone(robot: symdh.Robot) -> Document:
    """Return the derivation of the pose, without the chapters on velocity."""
    whole = derive(robot)
    chapters = [c for c in whole.chapters if c.title not in ("Velocity", "Singularities")]
    assert len(chapters) < len(whole.chapters)
    return replace(whole, chapters=tuple(chapters))


def test_a_recursion_fits_the_page(tmp_path: Path) -> None:
    rows = "".join(
        f"  - {{theta: theta{k}, d: d{k}, a: a{k}, alpha: {('90 deg', f'alpha{k}')[k % 2]}}}\n"
        for k in range(1, 16)
    )
    text = render_latex(derive(arm(rows, "base: [Tz(h)]\ntool: [Tx(l_tool), Ry(30 deg)]\n")))
    assert "The pose by recursion" in text
    assert overfull(typeset(text, tmp_path)) == []


def test_twelve_parallel_joints_fit_the_page(tmp_path: Path) -> None:
    rows = "".join(f"  - {{theta: q{k}, d: 0, a: a{k}, alpha: 0}}\n" for k in range(1, 13))
    assert overfull(typeset(render_latex(derive(arm(rows))), tmp_path)) == []


WIDE = """\
  - {theta: theta1, d: 123456.789012, a: 98765.4321, alpha: 90 deg}
  - {theta: theta2 + 12.3456789 deg, d: 0.000000123456, a: 1234567/7654321, alpha: -90 deg}
  - {theta: theta3, d: 333333333333, a: a_upper_arm_length, alpha: 12.5 deg}
"""


def test_wide_numbers_fit_the_page(tmp_path: Path) -> None:
    robot = arm(WIDE, "values: {a_upper_arm_length: 1234567890.123456}\n")
    assert overfull(typeset(render_latex(pose_alone(robot)), tmp_path)) == []


LONG_NAMES = """\
  - {theta: shoulder_rotation, d: shoulder_height, a: upper_arm_length, alpha: twist_of_arm}
  - {theta: elbow_rotation, d: elbow_offset, a: forearm_length, alpha: 0}
  - {theta: wrist_rotation, d: 0, a: hand_length, alpha: 0}
"""


def test_long_names_fit_the_page(tmp_path: Path) -> None:
    assert overfull(typeset(render_latex(pose_alone(arm(LONG_NAMES))), tmp_path)) == []


def test_estimated_widths_are_near_those_of_tex(tmp_path: Path) -> None:
    r"""Boxes measured by TeX are no wider than what the writer says, within the 6 % of margin."""
    q = [Symbol(f"theta{k}", real=True) for k in range(1, 7)]
    robot = symdh.load(ROOT.parent / "examples" / "puma560.yaml")
    notation, writer = Notation(robot), LatexWriter()
    pose = robot.T()
    expressions = [pose[r, c] for r in range(3) for c in range(4)]
    expressions += [
        sum(q[1:], q[0]) + Rational(355, 113),
        cos(2 * q[0]) * sin(q[1] - q[2]) ** 2 * Symbol("L_tool", real=True),
        (q[0] + 1) / (q[1] - 2) * Rational(5, 7),
    ]
    nodes: list[Node] = [notation.write(e) for e in expressions]
    nodes += [Rounded("-1.2345e-7"), robot_matrix(robot)]
    lines = [
        rf"\setbox0\hbox{{$\displaystyle {writer.text(node)}$}}\message{{<W\the\wd0>}}"
        for node in nodes
    ]
    text = render_latex(document(Paragraph(("x",))))
    log = typeset(text.replace(r"\end{document}", "\n".join(lines) + "\n\\end{document}"), tmp_path)
    measured = [float(width) for width in re.findall(r"<W([\d.]+)pt>", log)]
    assert len(measured) == len(nodes)
    for node, width in zip(nodes, measured, strict=True):
        estimate = total_width(writer.pieces(node))
        assert width <= estimate / 0.94, writer.text(node)
        assert estimate <= 1.25 * width + 6, writer.text(node)


def robot_matrix(robot: symdh.Robot) -> Node:
    return Notation(robot).matrix(robot.A(1))


def test_a_long_entry_is_broken_into_lines_that_fit(tmp_path: Path) -> None:
    q = Symbol("theta1", real=True)
    robot = symdh.load(ROOT.parent / "examples" / "puma560.yaml")
    long = sum((Symbol(f"a{k}", real=True) * cos(k * q) for k in range(2, 60)), start=q)
    entry = EntryStep(Generic("p", "x"), (Notation(robot).write(long),), None)
    text = render_latex(document(Entries(((entry,),))))
    assert text.count(r"&\qquad") >= 3
    assert overfull(typeset(text, tmp_path)) == []


def test_a_long_formula_that_is_no_equation_is_broken(tmp_path: Path) -> None:
    long = Sum(tuple(Name(f"length_{k}") for k in range(1, 40)))
    text = render_latex(document(Display(long)))
    assert text.count(r"&\qquad") >= 3
    assert [text.count(f"{{{k}}}") for k in (1, 20, 39)] == [1, 1, 1]
    assert overfull(typeset(text, tmp_path)) == []


# -- text -----------------------------------------------------------------------------------------

HOSTILE = [
    *TITLES,
    "quotes \" ' ` “double” ‘single’",
    "dots… deg° x² m³ 5µ 2×3",
]


def bare(text: str) -> str:
    """Return text without spaces and typographic variants: raised figures, ligatures, dots."""
    return re.sub(r"\s+", "", unicodedata.normalize("NFKC", text))


@pytest.mark.parametrize("title", HOSTILE)
def test_a_hostile_title_prints_as_itself(title: str, tmp_path: Path) -> None:
    shown = printed(
        render_latex(document(Paragraph((f"Text {title} end.",)), title=title)), tmp_path
    )
    assert bare(shown).count(bare(title)) == 2
    assert {each.name for each in tmp_path.iterdir()} <= {
        f"handout.{ending}" for ending in ("tex", "log", "aux", "pdf", "out")
    }


def test_hostile_titles_print_as_themselves_in_lualatex_too(tmp_path: Path) -> None:
    require_tool("lualatex")
    tex = render_latex(document(*(Paragraph((f"Text {title} end.",)) for title in TITLES)))
    (tmp_path / "handout.pdf").write_bytes(compile_pdf(tex, engine="lualatex"))
    shown = bare(text_of(tmp_path / "handout.pdf"))
    assert [title for title in TITLES if bare(f"Text {title} end.") not in shown] == []


@pytest.mark.parametrize(
    ("title", "shown"),
    [
        ("Ärmchen für Übung ß", "Ärmchen für Übung ß"),
        ("Łódź, Čapek, Þór, ñandú, Œuvre", "Łódź, Čapek, Þór, ñandú, Œuvre"),
        ("angles θ and Ω", "angles θ and Ω"),
        ("en–dash and em—dash", "en–dash and em—dash"),
        # What the fonts lack loses its accents, or is named by its code.
        ("Nguyễn", "Nguyen"),
        ("机器人", "[U+673A][U+5668][U+4EBA]"),
        ("arm 🦾", "arm [U+1F9BE]"),
        ("zero\u200bwidth", "zero[U+200B]width"),
    ],
)
def test_letters_of_the_world(title: str, shown: str, tmp_path: Path) -> None:
    text = printed(render_latex(document(Paragraph(("Text.",)), title=title)), tmp_path)
    assert bare(shown) in bare(text)


@pytest.mark.parametrize("title", ["word " * 60, "Handhabungsgerät " * 25])
def test_a_long_title_is_wrapped(title: str, tmp_path: Path) -> None:
    text = printed(render_latex(document(Paragraph(("Text.",)), title=title.strip())), tmp_path)
    assert len(re.findall(title.split()[0], text)) == len(title.split())


def test_no_character_of_a_title_reaches_tex_as_a_command() -> None:
    every = "".join(map(chr, range(0x20, 0x250))) + "\u2028\u202e\ufeff\U0001f9be"
    text = latex_text(every)
    left = re.sub(r"\\[a-zA-Z]+(?:\{\}|\{\\?[A-Za-z0-9]+\})|\\[{}$&#_%]|\{\}", "", text)
    assert not set(left) & set("\\{}$&#_%^\"<>|`'")
    assert re.findall(r"[^\x20-\x7e\u00a0-\u017e]", left) == []


def test_control_characters_do_not_break_the_document(tmp_path: Path) -> None:
    title = "a\tb\nc\rd\x01e\x1bf\x7fg\x00h"
    text = printed(render_latex(document(Paragraph(("Text.",)), title=title)), tmp_path)
    assert "a b c d[U+0001]e[U+001B]f[U+007F]gh" in text


def test_every_letter_that_is_passed_on_is_in_the_font(tmp_path: Path) -> None:
    letters = "".join(chr(code) for code in range(0xA0, 0x180) if chr(code).isprintable())
    text = render_latex(document(Paragraph((" ".join(letters),))))
    log = typeset(text, tmp_path)
    assert not re.search(r"Missing character|not set up for use", log)


# -- what a web page can show ---------------------------------------------------------------------

KATEX_LACKS = (
    r"\prescript",
    r"{multline",
    r"\intertext",
    r"\left",
    r"\right",
    r"\shortintertext",
    r"\mathmakebox",
    r"\mathllap",
    r"\ensuremath",
    r"\text{\ensuremath",
)


@each_table
def test_formulas_stay_inside_what_a_web_page_can_show(table: Path) -> None:
    text = handout(table).partition(r"\begin{document}")[2]
    for macro in KATEX_LACKS:
        assert not re.search(re.escape(macro) + r"(?![a-z])", text), macro


# -- single formulas ------------------------------------------------------------------------------


def test_one_transform_is_one_formula() -> None:
    robot = symdh.load(ROOT.parent / "examples" / "planar_2r.yaml")
    rows = (
        r"c_{12} & -s_{12} & 0 & a_{1} c_{1} + a_{2} c_{12}",
        r"s_{12} & c_{12} & 0 & a_{1} s_{1} + a_{2} s_{12}",
        "0 & 0 & 1 & 0",
        "0 & 0 & 0 & 1",
    )
    body = r" \\ ".join(rows)
    matrix = rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"
    assert render_transform(robot, 0, 2) == rf"{{}}^{{0}}T_{{2}} = {matrix}"
    craig = render_transform(robot, 0, 2, Naming.CRAIG)
    assert craig == rf"{{}}^{{0}}_{{2}}T = {matrix}"


def test_craigs_indices_stand_flush_with_the_letter() -> None:
    robot = symdh.load(ROOT.parent / "examples" / "planar_2r_modified.yaml")
    name = render_transform(robot, "base", 2).partition(" = ")[0]
    assert name == r"{}^{\mathrm{base}}_{\hphantom{\mathrm{bas}}2}T"
    back = render_transform(robot, 2, "base").partition(" = ")[0]
    assert back == r"{}^{\hphantom{\mathrm{bas}}2}_{\mathrm{base}}T"


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (Name("theta1"), r"\theta_{1}"),
        (Name("theta1", starred=True), r"\theta_{1}^{*}"),
        (Name("L_tool"), r"L_{\mathrm{tool}}"),
        (Name("errno"), r"\mathit{errno}"),
        (Name("a_1_2"), r"a_{1,2}"),
        (Generic("z", "i-1", hat=True), r"\hat z_{i-1}"),
        (Generic("p", "x", stage="3"), r"p_{x}^{(3)}"),
        (Rounded("-1.5e-7"), r"-1.5\cdot 10^{-7}"),
        (Equation((Name("a"), Name("b"))), "a = b"),
    ],
)
def test_symbols(node: Node, text: str) -> None:
    assert LatexWriter().text(node) == text


def test_a_matrix_of_twelve_columns_compiles(tmp_path: Path) -> None:
    """Plain amsmath stops at ten."""
    row = tuple(Name(f"a{k}") for k in range(12))
    shown = Display(Equation((Name("J"), Matrix((row, row)))))
    assert overfull(typeset(render_latex(document(shown)), tmp_path)) == []


def test_a_product_of_many_motions_is_broken(tmp_path: Path) -> None:
    robot = arm(LONG_NAMES)
    assert overfull(typeset(render_latex(pose_alone(robot)), tmp_path)) == []
    motions = Style(robot).operators(link_word(robot, 1) + link_word(robot, 2))
    wide = NamedMatrix((Name("A"), Juxtaposed(motions)), Matrix(((Name("a1"),),)))
    text = render_latex(Document("T", ("S",), (Chapter("C", (wide,)),)))
    assert overfull(typeset(text, tmp_path)) == []


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (Name("theta1", dotted=True), r"\dot \theta_{1}"),
        (Name("shoulder_turn", dotted=True), r"\dot{\mathit{shoulder}}_{\mathrm{turn}}"),
    ],
)
def test_accents_stand_over_whole_letters(node: Node, text: str, tmp_path: Path) -> None:
    assert LatexWriter().text(node) == text
    typeset(render_latex(document(Display(node))), tmp_path)


def test_the_line_keeps_its_margin() -> None:
    assert pytest.approx(0.94 * 160 / 25.4 * 72.27, abs=0.5) == LINE
