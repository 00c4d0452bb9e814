"""The line drawing of an arm: its geometry by the oracle, its labels, its two formats."""

from __future__ import annotations

import functools
import itertools
import math
import os
import re
import subprocess
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import SYMDH, Runner
from oracle import read_arm_file
from sympy import Float, Integer, Symbol, pi

import symdh
from symdh.derivation.blocks import Figure
from symdh.derivation.derive import derive
from symdh.derivation.drawing.choices import Choices
from symdh.derivation.drawing.draw import MAX_ROWS, Picture, draw
from symdh.derivation.drawing.painter import Bar, painted
from symdh.derivation.drawing.shapes import Drawing, Ellipse, Label, Line, Pen, Polygon
from symdh.derivation.drawing.skeleton import Chain
from symdh.derivation.drawing.solids import Body
from symdh.derivation.drawing.view import view_from
from symdh.derivation.frames import frames_document
from symdh.derivation.picture import drawings
from symdh.errors import LimitError, UnsupportedError
from symdh.frames import assign_frames
from symdh.render.drawing import DRAWING_FORMATS
from symdh.render.drawing.svg import render_svg
from symdh.render.drawing.text import figure, plain
from symdh.render.latex_math import LatexWriter
from symdh.render.page.page import render_page
from symdh.render.terminal import render_chapters
from symdh.robot import JointType
from symdh.table.axes import read_mechanism
from symdh.table.source import read_source
from tools import require_tool

ROOT = Path(__file__).parent
EXAMPLES = ROOT.parent / "examples"
TABLES = sorted((ROOT / "data" / "tables").glob("*.yaml"))
SVG = "{http://www.w3.org/2000/svg}"

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)


def arm(rows: str, more: str = "", convention: str = "standard") -> symdh.Robot:
    head = f"name: arm\nconvention: {convention}\nunits: {{angle: deg, length: m}}\n"
    return symdh.loads(f"{head}joints:\n{rows}{more}")


def chain(count: int, row: str = "{{theta: q{0}, d: d{0}, a: a{0}, alpha: 90 deg}}") -> symdh.Robot:
    return arm("".join(f"  - {row.format(k)}\n" for k in range(1, count + 1)))


#: Arms that are not in the corpus: long, without any length, planar and upright, all symbols.
OTHERS = {
    "12 joints": chain(12),
    "12 in a plane": chain(12, "{{theta: q{0}, d: 0, a: a{0}, alpha: 0}}"),
    "14 joints": chain(14),
    "one joint": arm("  - {theta: q, d: 0, a: 0, alpha: 0}\n"),
    "one slide": arm("  - {theta: 0, d: q, a: 0, alpha: 0}\n"),
    "no joint": arm("  - {theta: 0, d: h, a: 2, alpha: 0}\n"),
    "upright plane": arm(
        "  - {theta: q1, d: 0, a: 1, alpha: 0}\n  - {theta: q2, d: 0, a: 2, alpha: 180 deg}\n",
        "base: [Tz(1), Rx(90 deg)]\n",
    ),
    "skew": arm(
        "  - {theta: q1, d: d1, a: a1, alpha: alpha1}\n"
        "  - {theta: 90 deg - q2, d: d2, a: -3, alpha: alpha2}\n"
        "  - {theta: 30 deg, d: 2*q3 + 0.5, a: 0, alpha: 0}\n",
        "tool: [Tx(l_tool), Ry(45 deg)]\n",
        "modified",
    ),
    "far apart": arm(
        "  - {theta: q1, d: 1e-9, a: 333333333, alpha: 90 deg}\n"
        "  - {theta: q2, d: 0, a: 1, alpha: 0}\n"
    ),
}
each_other = pytest.mark.parametrize("robot", OTHERS.values(), ids=OTHERS)


@functools.cache
def drawing(table: Path) -> Drawing:
    return draw(symdh.load(table))


def labels_of(picture: Drawing) -> list[Label]:
    return [shape for shape in picture.shapes if isinstance(shape, Label)]


def texts(picture: Drawing) -> list[str]:
    return sorted(plain(label.text) for label in labels_of(picture))


def origins(picture: Drawing) -> np.ndarray:
    dots = [s for s in picture.shapes if isinstance(s, Ellipse) and s.pen is Pen.ORIGIN]
    return np.array([dot.centre for dot in dots if dot.first > 1])


# -- geometry -------------------------------------------------------------------------------------


def oracle_origins(table: Path, numbers: dict[Symbol, float]) -> np.ndarray:
    """Return the origins of the frames in the base, one a row, in the table's unit."""
    oracle = read_arm_file(table)
    values = {symbol.name: np.float64(size) for symbol, size in numbers.items()}
    frames: list[str | int] = [*(["base"] if oracle.base else []), *range(oracle.n + 1)]
    frames += ["tool"] if oracle.tool else []
    poses = [oracle.pose(values, "base", frame) for frame in frames]
    return np.array([np.array(pose[:3, 3], dtype=float) for pose in poses])


@each_table
def test_frames_are_where_the_oracle_has_them(table: Path) -> None:
    picture = Picture(symdh.load(table), choices=Choices(to_scale=True, azimuth=20, elevation=35))
    expected = oracle_origins(table, picture.numbers)
    placed = np.array([placement.origin for _, placement in picture.skeleton.frames])
    longest = picture.chain.longest
    assert placed == pytest.approx(expected * (picture.scale / longest if longest else 1), abs=1e-6)


@pytest.mark.parametrize("name", ["puma560", "stanford_textbook", "franka_panda", "pieper_generic"])
def test_origins_on_paper_are_those_of_an_orthographic_view(name: str) -> None:
    """Turn the world so that the eye is on its x axis, by the oracle's matrices, and drop x."""
    table = ROOT / "data" / "tables" / f"{name}.yaml"
    choices = Choices(to_scale=True, azimuth=-50, elevation=20)
    picture = Picture(symdh.load(table), choices=choices)
    shown = origins(picture.drawing())
    a, e = np.radians(-50), np.radians(20)
    turn_z = np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])
    turn_y = np.array([[np.cos(e), 0, np.sin(e)], [0, 1, 0], [-np.sin(e), 0, np.cos(e)]])
    seen = (turn_y @ turn_z @ oracle_origins(table, picture.numbers).T).T[:, 1:]
    seen *= picture.scale / picture.chain.longest
    distinct = [seen[0]]
    for point in seen[1:]:
        if all(np.hypot(*(point - other)) > 1e-3 for other in distinct):
            distinct.append(point)
    assert shown - shown[0] == pytest.approx(np.array(distinct) - distinct[0], abs=2e-3)


def test_short_lengths_are_drawn_longer_and_their_order_stays() -> None:
    robot = arm(
        "  - {theta: q1, d: -1, a: 4, alpha: 90 deg}\n  - {theta: q2, d: 0, a: 0.01, alpha: 0}\n"
    )
    scheme, true = (Chain(robot, {}, to_scale) for to_scale in (False, True))
    # By hand: the root of a quarter is a half; a hundredth is drawn as the shortest length.
    assert [scheme.shown(size) for size in (4, -1, 0)] == [1.0, -0.5, 0.0]
    assert 0.3 < scheme.shown(0.01) < 0.5
    assert [true.shown(size) for size in (4, -1, 0.01)] == [1.0, -0.25, 0.0025]


def test_a_planar_arm_lies_in_the_paper() -> None:
    """theta1 = 30 deg, theta2 = 60 deg: the second link is upright, by hand."""
    theta1, theta2 = (Symbol(name, real=True) for name in ("theta1", "theta2"))
    robot = symdh.load(EXAMPLES / "planar_2r.yaml")
    picture = draw(robot, {theta1: pi / 6, theta2: pi / 3}, Choices(to_scale=True))
    o0, o1, o2 = origins(picture)
    assert math.atan2(*(o1 - o0)[::-1]) == pytest.approx(math.pi / 6, abs=1e-4)
    assert math.atan2(*(o2 - o1)[::-1]) == pytest.approx(math.pi / 2, abs=1e-4)
    a1, a2 = (float(robot.values[Symbol(name, real=True)]) for name in ("a1", "a2"))
    assert np.hypot(*(o1 - o0)) / np.hypot(*(o2 - o1)) == pytest.approx(a1 / a2, abs=1e-3)
    assert texts(picture) == sorted(["a₁", "a₂", "θ₁", "θ₂", "x₀", "x₁", "x₂", "y₀", "y₁", "y₂"])


@pytest.mark.parametrize(("degrees", "shown"), [(7, False), (9, True), (-7, False), (-9, True)])
def test_an_angle_that_is_too_small_to_be_seen_has_no_arc(degrees: int, shown: bool) -> None:
    """Below eight degrees an arc would be shorter than its arrow: it has neither line nor name."""
    theta1, theta2 = (Symbol(name, real=True) for name in ("theta1", "theta2"))
    robot = symdh.load(EXAMPLES / "planar_2r.yaml")
    picture = draw(robot, {theta1: degrees * pi / 180, theta2: pi / 3})
    assert ("θ₁" in texts(picture)) is shown
    arcs = [s for s in picture.shapes if isinstance(s, Line) and s.pen is Pen.TURN]
    assert len(arcs) == 1 + shown


@pytest.mark.parametrize(
    ("alpha1", "second", "more", "flat"),
    [
        ("0", "theta: q2, d: 0", "", True),
        ("180 deg", "theta: q2, d: 0", "base: [Tx(1), Rx(90 deg)]\n", True),
        ("90 deg", "theta: 0, d: q2", "", True),
        ("0", "theta: q2, d: 1", "", False),
        ("90 deg", "theta: q2, d: 0", "", False),
        ("0", "theta: 0, d: q2", "", False),
        ("0", "theta: q2, d: 0", "tool: [Tz(1)]\n", False),
    ],
)
def test_which_arms_are_planar(alpha1: str, second: str, more: str, flat: bool) -> None:
    rows = f"  - {{theta: q1, d: 0, a: 1, alpha: {alpha1}}}\n  - {{{second}, a: 1, alpha: 0}}\n"
    assert Picture(arm(rows, more)).view.flat is flat


def test_values_that_are_known_are_drawn() -> None:
    robot = symdh.load(EXAMPLES / "puma560.yaml")
    theta2 = Symbol("theta2", real=True)
    picture = Picture(robot, {theta2: Float("0.5")})
    assert picture.numbers[theta2] == 0.5
    assert set(picture.numbers) == {*robot.parameters, *robot.variables}
    assert "θ₂ = 28.6°" in plain(picture.drawing().caption)


def test_a_joint_stays_within_its_limits() -> None:
    robot = arm(
        "  - {theta: q1, d: 1, a: 1, alpha: 90 deg}\n  - {theta: 0, d: q2, a: 0, alpha: 0}\n",
        "limits: {q1: [20 deg, 25 deg], q2: [0.1, 0.3]}\n",
    )
    numbers = Picture(robot).numbers
    assert math.radians(20) <= numbers[Symbol("q1", real=True)] <= math.radians(25)
    assert 0.1 < numbers[Symbol("q2", real=True)] < 0.3


@each_table
def test_every_axis_and_every_length_has_its_label(table: Path) -> None:
    robot = symdh.load(table)
    found = {part for text in texts(drawing(table)) for part in text.split(", ")}
    flat = "y₀" in found
    for frame in range(robot.n + 1):
        index = str(frame).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
        assert {f"{letter}{index}" for letter in ("xy" if flat else "xz")} <= found
    lengths = [joint.d for joint in robot.joints] + [joint.a for joint in robot.joints]
    symbols = {length.name for length in lengths if length.is_Symbol}
    ascii_found = {text.translate(str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")) for text in found}
    assert symbols <= ascii_found
    turning = [joint for joint in robot.joints if joint.type is JointType.REVOLUTE]
    assert flat or len({text for text in found if text[0] == "θ"}) == len(turning)


# -- what covers what -----------------------------------------------------------------------------


def test_what_is_nearer_is_painted_later() -> None:
    """Seen from the x axis, of two crossed bars the one at x = 10 is in front."""
    view = view_from(0, 0)
    near, far = Bar((10.0, -50.0, 0.0), (10.0, 50.0, 0.0)), Bar((0.0, 0.0, -50.0), (0.0, 0.0, 50.0))
    for bars in ([near, far], [far, near]):
        shapes = painted(view, bars, [])
        pens = [shape.pen for shape in shapes]
        assert pens == [Pen.LINK, Pen.GAP, Pen.LINK]
        assert isinstance(shapes[-1], Line)
        assert shapes[-1].points == (view.point(near.start), view.point(near.end))


@pytest.mark.parametrize(("height", "last"), [(30.0, Pen.LINK), (-30.0, Pen.BODY)])
def test_of_a_body_and_a_bar_the_nearer_is_painted_last(height: float, last: Pen) -> None:
    """Seen from above, a bar that passes over a body hides it, and one below is hidden."""
    view = view_from(0, 90)
    body = Body(1, JointType.REVOLUTE, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), 3.0, 5.0)
    bar = Bar((-50.0, 0.0, height), (50.0, 0.0, height))
    assert painted(view, [bar], [body])[-1].pen is last


def test_the_ground_stands_below_a_level_first_axis() -> None:
    """Seen from the side: a plate on edge, ten points below the body, and a post between."""
    rows = (
        "  - {alpha: 90 deg, a: 0, d: 0, theta: q1}\n  - {alpha: 90 deg, a: 2, d: 0, theta: q2}\n"
    )
    shapes = draw(arm(rows, convention="modified"), choices=Choices(0, 0)).shapes
    (plate,) = (s for s in shapes if isinstance(s, Polygon) and s.pen is Pen.GROUND)
    body = next(s for s in shapes if isinstance(s, Ellipse) and s.pen is Pen.BODY)
    height = min(
        y for s in shapes if isinstance(s, Line) and s.pen is Pen.BODY for _, y in s.points
    )
    assert {round(y, 6) for _, y in plate.points} == {round(height - 10, 6)}
    post = next(s for s in shapes if isinstance(s, Line) and s.pen is Pen.LINK)
    assert sorted(round(y, 6) for _, y in post.points) == [round(height - 10, 6), round(height, 6)]
    assert body.centre[1] > height


def test_labels_that_fit_at_no_scale_are_drawn_whole() -> None:
    """Twelve joints whose names are 38 characters long."""
    long = "".join(
        f"  - {{theta: q{k}_{'a' * 35}, d: d{k}_{'b' * 30}, a: a{k}_{'c' * 30}, alpha: 90 deg}}\n"
        for k in range(1, 13)
    )
    drawn = draw(arm(long))
    assert drawn.width > 430  # a page holds 420
    for label in labels_of(drawn):
        x, y = label.centre
        assert label.width / 2 <= x <= drawn.width - label.width / 2
        assert label.height / 2 <= y <= drawn.height - label.height / 2


def test_a_bar_ends_at_the_body_that_it_enters() -> None:
    body = Body(1, JointType.REVOLUTE, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), 3.0, 5.0)
    # Along the axis: from -10 to 10 it is inside from -5 to 5, a quarter to three quarters.
    assert body.within((0, 0, -10), (0, 0, 10)) == pytest.approx((0.25, 0.75))
    # Across it, off the middle by 0: inside from -3 to 3 of -6 .. 6.
    assert body.within((-6, 0, 0), (6, 0, 0)) == pytest.approx((0.25, 0.75))
    assert body.within((-6, 4, 0), (6, 4, 0)) is None
    assert body.within((-6, 0, 6), (6, 0, 6)) is None
    box = Body(1, JointType.PRISMATIC, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), 3.0, 5.0)
    assert box.within((-6, 2.9, 0), (6, 2.9, 0)) == pytest.approx((0.25, 0.75))
    assert box.within((-6, 3.1, 0), (6, 3.1, 0)) is None


# -- labels ---------------------------------------------------------------------------------------


def covered(a: Label, b: Label) -> float:
    """Return the part of the smaller label that the other covers."""
    (ax, ay), (bx, by) = a.centre, b.centre
    width = min(ax + a.width / 2, bx + b.width / 2) - max(ax - a.width / 2, bx - b.width / 2)
    height = min(ay + a.height / 2, by + b.height / 2) - max(ay - a.height / 2, by - b.height / 2)
    if width <= 0 or height <= 0:
        return 0.0
    return width * height / min(a.width * a.height, b.width * b.height)


@each_table
def test_labels_are_inside_and_apart(table: Path) -> None:
    picture = drawing(table)
    labels = labels_of(picture)
    for label in labels:
        assert label.width / 2 <= label.centre[0] <= picture.width - label.width / 2
        assert label.height / 2 <= label.centre[1] <= picture.height - label.height / 2
    assert max(covered(a, b) for a, b in itertools.combinations(labels, 2)) <= 0.2


@each_other
def test_other_arms_are_drawn_too(robot: symdh.Robot) -> None:
    picture = draw(robot)
    assert 0 < picture.width < 440
    assert 0 < picture.height < 345
    worst = [covered(a, b) for a, b in itertools.combinations(labels_of(picture), 2)]
    assert sum(each > 0.2 for each in worst) <= 1
    ElementTree.fromstring(render_svg(picture))


@pytest.mark.parametrize(
    "robot", [OTHERS[name] for name in ("one joint", "one slide", "no joint", "skew")]
)
@pytest.mark.parametrize(("azimuth", "elevation"), [(0, 90), (0, 0), (90, -90), (180, 0)])
def test_any_direction_to_look_from(robot: symdh.Robot, azimuth: float, elevation: float) -> None:
    picture = draw(robot, choices=Choices(azimuth, elevation, y_axes=True, feet=True))
    assert 0 < picture.width < 440
    ElementTree.fromstring(render_svg(picture))


def test_an_axis_seen_end_on_is_a_ring() -> None:
    """From above z points at the eye: a ring with a dot, and no arrow."""
    picture = draw(OTHERS["one slide"], choices=Choices(0, 90))
    z_axes = [shape for shape in picture.shapes if shape.pen is Pen.Z_AXIS]
    assert [type(shape) for shape in z_axes if not isinstance(shape, Label)] == [Ellipse, Ellipse]
    assert "z₀" in " ".join(texts(picture))


def test_a_label_is_given_the_room_that_it_takes() -> None:
    """The estimate is no less than the width in print, which is set a tenth smaller."""
    writer = LatexWriter()
    for table in TABLES[:20]:
        for label in labels_of(drawing(table)):
            printed = sum(
                5.0 if isinstance(part, str) else writer.width(part) for part in label.text
            )
            assert label.width >= 0.9 * 9 / 10.95 * printed


# -- formats --------------------------------------------------------------------------------------


@each_table
def test_svg_is_xml_that_says_what_it_shows(table: Path) -> None:
    picture = drawing(table)
    root = ElementTree.fromstring(render_svg(picture))
    assert root.tag == f"{SVG}svg"
    assert root.findtext(f"{SVG}title") == picture.title
    assert root.findtext(f"{SVG}desc") == plain(picture.caption)
    _, _, width, height = map(float, root.attrib["viewBox"].split())
    shown = root.findall(f"{SVG}text")
    assert len(shown) == len(labels_of(picture))
    for text in shown:
        assert 0 < float(text.attrib["x"]) < width
        assert 0 < float(text.attrib["y"]) < height
    for shape in (*root.iter(f"{SVG}polyline"), *root.iter(f"{SVG}polygon")):
        for x, y in (map(float, point.split(",")) for point in shape.attrib["points"].split()):
            assert -1 <= x <= width + 1
            assert -1 <= y <= height + 1


def test_a_hostile_title_is_text_in_svg() -> None:
    text = (EXAMPLES / "planar_2r.yaml").read_text(encoding="utf-8")
    title = "</title><script>alert(1)</script> & <b>"
    own = re.sub(r"^title:.*$", f"title: '{title}'", text, flags=re.MULTILINE)
    root = ElementTree.fromstring(render_svg(draw(symdh.loads(own))))
    assert root.findtext(f"{SVG}title") == f"Skeleton of {title}"
    assert not list(root.iter(f"{SVG}script"))


def test_coordinates_have_two_decimals() -> None:
    assert [figure(x) for x in (1.0, 0.125001, -0.0001, 12.3456)] == ["1", "0.13", "0", "12.35"]
    tikz = DRAWING_FORMATS["tex"](drawing(TABLES[0]))
    assert not re.search(r"\d\.\d{3}", tikz.split("useasboundingbox")[1])


@pytest.mark.parametrize("name", ["14 joints", "skew", "upright plane", "one slide"])
def test_tikz_compiles_alone(name: str, tmp_path: Path) -> None:
    pdflatex = require_tool("pdflatex")
    tikz = DRAWING_FORMATS["tex"](draw(OTHERS[name], choices=Choices(y_axes=True, feet=True)))
    (tmp_path / "arm.tex").write_text(tikz, encoding="utf-8")
    (tmp_path / "page.tex").write_text(
        "\\documentclass{article}\\usepackage{tikz}\\usepackage[textwidth=160mm]{geometry}"
        "\\begin{document}\\noindent\n\\input{arm}\n\\end{document}\n",
        encoding="utf-8",
    )
    ran = subprocess.run(
        [pdflatex, "-interaction=nonstopmode", "-halt-on-error", "-draftmode", "page.tex"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout[-1500:]
    assert "Overfull" not in ran.stdout


@pytest.mark.parametrize("name", ["puma560", "planar_2r"])
def test_the_same_bytes_whatever_the_hash_seed(name: str) -> None:
    found = set()
    for seed in ("0", "1", "4711"):
        for form in ("svg", "tikz"):
            command = [SYMDH, "draw", EXAMPLES / f"{name}.yaml", "-o", "-", "--format", form]
            environment = {**os.environ, "PYTHONHASHSEED": seed}
            ran = subprocess.run(command, env=environment, capture_output=True, check=True)
            found.add(ran.stdout)
    assert len(found) == 2


# -- in documents ---------------------------------------------------------------------------------


def test_the_handout_and_the_page_have_the_drawing() -> None:
    robot = symdh.load(EXAMPLES / "scara.yaml")
    document = derive(robot)
    assert any(isinstance(block, Figure) for block in document.chapters[0].blocks)
    page = render_page(document, robot)
    assert page.count('<svg xmlns="http://www.w3.org/2000/svg" class="symdh-arm"') == 1
    text = render_chapters(document.chapters[:1])
    assert "svg" not in text


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_story_of_the_frames_has_axes_and_points(convention: str) -> None:
    """By hand: each joint of the SCARA arm has its b_k, and its axis is drawn as a line."""
    loaded = read_mechanism(read_source(str(EXAMPLES / "mechanisms" / "scara_axes.yaml")))
    found = assign_frames(loaded.mechanism, symdh.Convention(convention))
    figures = [
        block
        for chapter in frames_document(found).chapters
        for block in chapter.blocks
        if isinstance(block, Figure)
    ]
    assert len(figures) == 1
    shown = {part for text in texts(figures[0].drawing) for part in text.split(", ")}
    assert {"b₁", "b₂", "b₃", "b₄"} <= shown
    lines = [s for s in figures[0].drawing.shapes if s.pen is Pen.AXIS_LINE]
    assert len(lines) == 4


def test_no_drawing_is_no_error_in_a_document() -> None:
    long = chain(MAX_ROWS + 1, "{{theta: q{0}, d: 0, a: 1, alpha: 0}}")
    with pytest.raises(LimitError, match="15 rows"):
        draw(long)
    assert not any(isinstance(b, Figure) for c in derive(long).chapters for b in c.blocks)
    root = arm("  - {theta: q, d: sqrt(k), a: 0, alpha: 0}\n")
    unreal = replace(root, values={root.parameters[0]: Integer(-1)})
    with pytest.raises(UnsupportedError, match="no real value"):
        draw(unreal)
    assert drawings(unreal) == ()


# -- at the command line and in a notebook --------------------------------------------------------


def test_the_ending_tells_the_format(tmp_path: Path, run_symdh: Runner) -> None:
    table = EXAMPLES / "scara.yaml"
    for name, start in (("arm.svg", "<svg"), ("arm.tex", "% Written by symdh")):
        ran = run_symdh("draw", table, "-o", name)
        assert ran.returncode == 0
        assert ran.stderr.startswith(f"wrote {name}  ")
        assert (tmp_path / name).read_text(encoding="utf-8").startswith(start)
    assert run_symdh("draw", table, "-o", "-").stdout.startswith("<svg")
    assert "tikzpicture" in run_symdh("draw", table, "--format", "tikz", "-o", "-").stdout
    ran = run_symdh("draw", table, "-o", "arm.png")
    assert ran.returncode == 2
    assert "use .svg or .tex, or give --format" in ran.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["arm.svg", "arm.tex"]


def test_a_drawing_replaces_no_file_of_yours(tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "arm.svg").write_text("<svg>mine</svg>", encoding="utf-8")
    ran = run_symdh("draw", EXAMPLES / "scara.yaml", "-o", "arm.svg")
    assert ran.returncode == 3
    assert (tmp_path / "arm.svg").read_text(encoding="utf-8") == "<svg>mine</svg>"
    for _ in range(2):
        ran = run_symdh("draw", EXAMPLES / "scara.yaml", "-o", "own.svg")
        assert ran.returncode == 0


def test_options_change_the_drawing(run_symdh: Runner) -> None:
    plain_run = ["draw", EXAMPLES / "puma560.yaml", "-o", "-"]
    options = (
        ["--set", "theta1=10 deg"],
        ["--azimuth", "20"],
        ["--elevation", "90"],
        ["--to-scale"],
        ["--y-axes"],
    )
    found = [run_symdh(*plain_run, *option).stdout for option in ([], *options)]
    assert len(set(found)) == len(found)
    assert all(text.startswith("<svg") for text in found)
    wrong = run_symdh(*plain_run, "--set", "nobody=1")
    assert wrong.returncode == 2
    assert "nobody" in wrong.stderr
    assert run_symdh(*plain_run, "--elevation", "91").returncode == 2


def test_a_long_arm_is_over_the_limit(tmp_path: Path, run_symdh: Runner) -> None:
    rows = "".join(f"  - {{theta: q{k}, d: 0, a: 1, alpha: 0}}\n" for k in range(MAX_ROWS + 1))
    (tmp_path / "t.yaml").write_text(f"name: t\nconvention: standard\njoints:\n{rows}")
    ran = run_symdh("draw", "t.yaml")
    assert ran.returncode == 4
    assert "no more than 14" in ran.stderr


def test_a_notebook_shows_what_it_is_given() -> None:
    robot = symdh.load(EXAMPLES / "scara.yaml")
    table = ElementTree.fromstring(robot._repr_html_().replace("<br>", " "))
    formulas = [e.text for e in table.iter() if e.get("class") == "formula"]
    assert formulas[:3] == ["$i$", "$\\theta_{i}$", "$d_{i}$"]
    assert len(formulas) == 5 * 5
    pose = symdh.forward_kinematics(robot)._repr_latex_()
    assert pose == robot._repr_latex_()
    assert OTHERS["12 joints"]._repr_latex_() is None  # its closed form would fill pages
    assert pose is not None
    assert pose.startswith("$\\displaystyle {}^{0}T_{4} = ")
    story = symdh.derive(robot)._repr_html_()
    assert story.count("<h3>") == len(derive(robot).chapters)
    assert "<script" not in story
    assert re.search(r"\$\$[^$]*A_\{1\}", story)
    assert symdh.draw(robot)._repr_svg_() == render_svg(draw(robot))
