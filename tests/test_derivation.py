"""Every step of a derivation, worked out in numbers against the step before it and an oracle."""

from __future__ import annotations

import functools
import hashlib
import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from evaluate import MP, Reader, identity
from oracle import FIFTY_DIGITS, Arm, read_arm
from sympy import Expr, Integer, Symbol, cos, pi, sin, symbols

import symdh
from symdh.derivation import recursion as recursion_module
from symdh.derivation.blocks import (
    Chapter,
    Definitions,
    Display,
    Document,
    Entries,
    EntryStep,
    EntrySteps,
    Figure,
    Fitting,
    Identity,
    MatrixRow,
    NamedMatrix,
    Paragraph,
    ParameterTable,
    PoseResult,
    ProductResult,
)
from symdh.derivation.derive import derive
from symdh.derivation.products import same_polynomial
from symdh.derivation.style import Naming, Order, Style
from symdh.derivation.words import counted, number_word
from symdh.notation.nodes import (
    Call,
    Dot,
    Equation,
    Generic,
    Juxtaposed,
    Listed,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    PoseName,
    Product,
    Screw,
    Short,
    Sum,
    Tuple,
    leaves,
)
from symdh.render.terminal import render_chapters
from symdh.robot import JointType

ROOT = Path(__file__).parent
EXAMPLES = [
    path
    for path in sorted((ROOT.parent / "examples").glob("*.yaml"))
    if re.search(r"\{(theta|alpha):|^columns:", path.read_text(encoding="utf-8"), re.MULTILINE)
]
CORPUS = [
    ROOT / "data" / "tables" / f"{name}.yaml"
    for name in (
        "cartesian_ppp",
        "elbow_3r",
        "franka_panda",
        "ikbt_Axtman13",
        "ikbt_Olson13",
        "ikbt_UR5",
        "kinova_jaco",
        "orion5",
        "scara_rrpr",
        "zyz_wrist",
    )
]

HEAD = "name: {name}\nconvention: {convention}\nunits: {{angle: {angle}, length: m}}\njoints:\n"


def table(name: str, rows: str, convention: str = "standard", angle: str = "deg") -> str:
    joints = "".join(f"  - {{{row.strip()}}}\n" for row in rows.strip().splitlines())
    return HEAD.format(name=name, convention=convention, angle=angle) + joints


def row(theta: str, d: str, a: str, alpha: str) -> str:
    return f"theta: {theta}, d: {d}, a: {a}, alpha: {alpha}"


SPECIAL = {
    "only_fixed_rows": table(
        "only_fixed_rows",
        "theta: 30 deg, d: 1, a: 2, alpha: 90 deg\n"
        "theta: 0, d: h, a: 0, alpha: 45 deg, type: fixed",
    ),
    "one_joint": table("one_joint", row("theta1", "d1", "a1", "90 deg")),
    "one_zero_row": table("one_zero_row", row("0", "0", "0", "0")),
    "zero_rows": table(
        "zero_rows",
        "\n".join([row("0", "0", "0", "0"), row("theta2", "0", "0", "0")] * 2)
        .replace("theta2", "theta{}")
        .format(2, 4),
    ),
    "slides_alone": table(
        "slides_alone",
        "\n".join(
            row("0", f"q{k}", "0", f"{alpha} deg") for k, alpha in ((1, 90), (2, 90), (3, 0))
        ),
    ),
    "skew_slides": table(
        "skew_slides", "\n".join([row("0", "q1", "a1", "30 deg"), row("0", "q2 - 1", "0", "0")])
    ),
    "twelve_parallel": table(
        "twelve_parallel", "\n".join(row(f"q{k}", "0", f"a{k}", "0") for k in range(1, 13))
    ),
    "radians": table(
        "radians",
        "\n".join([row("q1 + 0.5 rad", "0", "a1", "1.2 rad"), row("q2", "0", "a2", "pi/2")]),
        angle="rad",
    )
    + "values: {q1: 0.3 rad, q2: -1.1 rad, a1: 0.25, a2: 0.5}\n",
    "symbolic_twist": table(
        "symbolic_twist",
        "\n".join([row("theta1", "d1", "a1", "alpha1"), row("theta2", "0", "a2", "alpha2")]),
    ),
    "symbolic_twist_modified": table(
        "symbolic_twist_modified",
        "\n".join([row("theta1", "d1", "a1", "alpha1"), row("theta2", "0", "a2", "alpha2")]),
        convention="modified",
    ),
    "base_and_tool": table(
        "base_and_tool",
        "\n".join([row("90 deg - q1", "0", "a1", "0"), row("0", "q2 + 0.5", "0", "90 deg")]),
    )
    + "base: [Tz(h), Ry(30 deg)]\ntool: [Rx(-90 deg), Tx(l)]\n",
    "offsets": table(
        "offsets",
        "\n".join(
            [
                row("theta1 + 90 deg", "0", "a1", "180 deg"),
                row("theta2 - 90 deg", "0", "a2", "180 deg"),
                row("-theta3", "d3", "0", "60 deg"),
                row("theta4 + 45 deg", "0", "a4", "0"),
            ]
        ),
    )
    + "values: {a1: 1, a2: 0.5}\n",
    "differences": table(
        "differences",
        "\n".join(
            [
                row("theta1", "0", "a1", "180 deg"),
                row("theta2", "0", "a2", "0"),
                row("theta3", "0", "a3", "180 deg"),
                row("theta4", "0", "a4", "0"),
            ]
        ),
    ),
    "names_spelt_out": table(
        "names_spelt_out",
        "\n".join([row("q1", "0", "s1", "0"), row("q2", "0", "c12", "90 deg")]),
    ),
    "partly_known": table(
        "partly_known", "\n".join([row("q1", "0", "a1", "0"), row("q2", "0", "a2", "0")])
    )
    + "values: {a1: 0.5, q1: 30 deg}\n",
    "all_known": table(
        "all_known", "\n".join([row("q1", "0", "a1", "0"), row("q2", "d2", "a2", "90 deg")])
    )
    + "values: {a1: 0.5, a2: 250 mm, d2: -0.1, q1: 30 deg, q2: -1.5 rad}\n",
}
TEXTS = {path.stem: path.read_text(encoding="utf-8") for path in EXAMPLES}
TEXTS |= {path.stem + "_of_corpus": path.read_text(encoding="utf-8") for path in CORPUS}
TEXTS |= SPECIAL

BIG = {
    f"skew_{n}_{convention}": table(
        f"skew_{n}",
        "\n".join(
            row(f"t{k}", f"d{k}", f"a{k}" if k % 2 else "0", ("90 deg", "-90 deg", f"w{k}")[k % 3])
            for k in range(1, n + 1)
        ),
        convention=convention,
    )
    + ends
    for n, convention, ends in (
        (14, "standard", ""),
        (14, "modified", "base: [Tz(h), Rx(90 deg)]\ntool: [Ty(l), Rz(30 deg)]\n"),
        (40, "standard", "tool: [Tz(0.1)]\n"),
    )
}

each_table = pytest.mark.parametrize("name", TEXTS)
each_big = pytest.mark.parametrize("name", BIG)
each_order = pytest.mark.parametrize("order", list(Order), ids=lambda order: order.value)


# -- the same table, read by the oracle -----------------------------------------------------------


def long_spelling(text: str) -> str:
    """Spell a table out for the oracle, which reads rows by key and guesses no unit."""
    content = yaml.load(text, Loader=yaml.BaseLoader)
    columns = content.pop("columns", None)
    if columns:
        content["joints"] = [dict(zip(columns, each, strict=True)) for each in content.pop("rows")]
    unit = content.get("units", {}).get("angle")
    for joint in content["joints"]:
        for angle in ("theta", "alpha"):
            if unit and re.fullmatch(r"[+-]?[\d.]+", joint[angle]):
                joint[angle] += f" {unit}"
    return yaml.safe_dump(content)


class Case:
    """A table as symdh and as the oracle read it, at one point."""

    def __init__(self, name: str) -> None:
        self.name = name
        text = (TEXTS | BIG)[name]
        self.robot = symdh.loads(text)
        self.arm: Arm = read_arm(long_spelling(text))
        names = [s.name for s in (*self.robot.variables, *self.robot.parameters)]
        # Any number will do for a length; angles are kept apart from each other.
        self.doubles = {each: _number_for(each) for each in names}
        self.point = {each: MP.mpf(x) for each, x in self.doubles.items()}
        self.joints = _joint_numbers(self.robot)
        self.reader = Reader(self.point, self.joints)

    def pose(self, start: str, end: str) -> np.ndarray:
        """Return the oracle's pose of a frame in an earlier one, both as text."""
        first = start if start == "base" else int(start)
        last = end if end == "tool" else int(end)
        if start == "base" and end == "0":
            last = 0
        known = {**self.arm.values, **self.doubles}
        return np.array(self.arm.pose(known_numbers(known), first, last, FIFTY_DIGITS))

    def document(self, order: Order = Order.RIGHT, naming: Naming = Naming.AUTO) -> Document:
        return derived(self.name, order, naming)


def known_numbers(known: Mapping[str, Any]) -> dict[str, float]:
    return {name: x for name, x in known.items() if isinstance(x, float)}


def _number_for(name: str) -> float:
    digest = hashlib.sha256(name.encode()).digest()
    return 0.3 + int.from_bytes(digest[:4], "big") / 2**32 * 2.5


def _joint_numbers(robot: symdh.Robot) -> dict[int, str]:
    """Number the turning joints: by the number that ends their names if all differ, else by row."""
    rows = {
        k: joint.variable.name
        for k, joint in enumerate(robot.joints, start=1)
        if joint.type is JointType.REVOLUTE and joint.variable is not None
    }
    found = {name: re.search(r"[a-z_]([1-9]\d?)$", name) for name in rows.values()}
    named = {int(match[1]): name for name, match in found.items() if match}
    return named if len(named) == len(rows) else rows


@functools.cache
def case_of(name: str) -> Case:
    return Case(name)


@functools.cache
def derived(name: str, order: Order, naming: Naming) -> Document:
    return derive(case_of(name).robot, order, naming)


def off_circle(text: str) -> Any:
    """Return a number for a sine or cosine as if it were a letter of its own."""
    digest = hashlib.sha256(text.encode()).digest()
    return MP.mpf(int.from_bytes(digest[:6], "big")) / 2**48 + MP.mpf("0.25")


def chapter(document: Document, title: str) -> Chapter:
    (found,) = [each for each in document.chapters if each.title.startswith(title)]
    return found


def blocks_of(document: Document, kind: type) -> list[Any]:
    return [block for each in document.chapters for block in each.blocks if isinstance(block, kind)]


def assert_equal(found: Any, expected: Any, where: str = "") -> None:
    error = np.max(np.abs(np.asarray(found - expected, dtype=object)))
    assert error < MP.mpf("1e-40") * (1 + np.max(np.abs(np.asarray(expected)))), where


# -- chapters -------------------------------------------------------------------------------------


@each_table
def test_there_are_just_the_chapters_that_the_table_asks_for(name: str) -> None:
    document = case_of(name).document()
    titles = [each.title for each in document.chapters]
    wanted = [
        "The table",
        "What the four parameters measure",
        "The transform of one link",
        "The links",
        "The product, from the hand to the base",
        "The result",
    ]
    if 0 < len(case_of(name).robot.variables) <= 10:  # beyond, the columns fill pages
        wanted += ["Velocity", "Singularities"]
    if case_of(name).robot.values:
        wanted.append("Numbers")
    assert titles == wanted
    assert all(each.blocks for each in document.chapters)
    for paragraph in blocks_of(document, Paragraph):
        assert any(part for part in paragraph.content)


@each_big
def test_a_big_arm_gets_the_recursion_for_product_and_result(name: str) -> None:
    titles = [each.title for each in case_of(name).document().chapters]
    assert titles[3:] == ["The links", "The pose by recursion"]


@pytest.mark.parametrize(
    ("joints", "titles"),
    [(8, ["Velocity", "Singularities"]), (9, ["Velocity"]), (10, ["Velocity"]), (11, [])],
)
def test_singularities_and_velocity_end_at_their_limits(joints: int, titles: list[str]) -> None:
    """Singularities are looked for with eight joints at most, velocity is told with ten."""
    rows = "\n".join(row("0", f"q{k}", "0", "0") for k in range(1, joints + 1))
    chapters = derive(symdh.loads(table("slides", rows))).chapters
    told = [c.title for c in chapters if c.title in ("Velocity", "Singularities")]
    assert told == titles


def test_the_order_is_told_in_the_heading() -> None:
    titles = [each.title for each in case_of("puma560").document(Order.LEFT).chapters]
    assert "The product, from base to hand" in titles


def test_the_head_of_a_document() -> None:
    document = derive(symdh.loads("title: 'My % arm'\n" + SPECIAL["one_joint"]))
    assert document.title == "My % arm"
    assert "Standard" in "".join(str(part) for part in document.subtitle)
    document = case_of("symbolic_twist_modified").document()
    assert document.title == "symbolic_twist_modified"
    assert "Modified" in "".join(str(part) for part in document.subtitle)


# -- the table ------------------------------------------------------------------------------------


@each_table
def test_the_cells_of_the_table_are_worth_what_was_typed(name: str) -> None:
    case = case_of(name)
    (shown,) = blocks_of(case.document(), ParameterTable)
    header = [leaf.letter for leaf in shown.header]
    standard = case.arm.convention == "standard"
    assert header == [
        "i",
        *(("theta", "d", "a", "alpha") if standard else ("alpha", "a", "d", "theta")),
    ]
    assert len(shown.rows) == case.robot.n
    scope = case.arm._scope(FIFTY_DIGITS, case.doubles)
    for number, (cells, typed) in enumerate(zip(shown.rows, case.arm.rows, strict=True), start=1):
        assert cells[0] == Number(value=number)
        for column, cell in zip(header[1:], cells[1:], strict=True):
            expected = scope.evaluate(typed[column], is_angle=column in ("theta", "alpha"))
            assert_equal(case.reader.value(cell), expected + MP.mpf(0))


@each_table
def test_stars_mark_the_joint_variables_and_nothing_else(name: str) -> None:
    case = case_of(name)
    (shown,) = blocks_of(case.document(), ParameterTable)
    names = [
        leaf
        for row in shown.rows
        for cell in row
        for leaf in leaves(cell)
        if isinstance(leaf, Name)
    ]
    variables = {variable for variable, _ in case.arm.variables}
    assert {leaf.text for leaf in names if leaf.starred} == variables
    assert not {leaf.text for leaf in names if not leaf.starred} & variables


@pytest.mark.parametrize(
    ("name", "note"),
    [
        ("puma560", "* joint variable. Six joints: 24 parameters, 18 of them constant."),
        ("scara", "* joint variable. Four joints: 16 parameters, 12 of them constant."),
        ("one_joint", "* joint variable. One joint: 4 parameters, 3 of them constant."),
        ("only_fixed_rows", "Two rows with no joints: 8 parameters, 8 of them constant."),
        ("one_zero_row", "One row with no joints: 4 parameters, 4 of them constant."),
        (
            "zero_rows",
            "* joint variable. Four rows with two joints: 16 parameters, 14 of them constant.",
        ),
        ("twelve_parallel", "* joint variable. Twelve joints: 48 parameters, 36 of them constant."),
        ("skew_14_standard", "* joint variable. 14 joints: 56 parameters, 42 of them constant."),
    ],
)
def test_the_table_counts_its_parameters(name: str, note: str) -> None:
    (shown,) = blocks_of(case_of(name).document(), ParameterTable)
    assert shown.notes[0] == (note,)


def test_notes_tell_of_base_tool_and_radians() -> None:
    (shown,) = blocks_of(case_of("base_and_tool").document(), ParameterTable)
    case = case_of("base_and_tool")
    base, tool = shown.notes[1], shown.notes[2]
    assert (base[0], tool[0]) == ("Base: ", "Tool: ")
    assert_equal(case.reader.operators(base[1]), case.pose("base", "0"))
    assert_equal(case.reader.operators(tool[1]), case.pose("2", "tool"))
    (shown,) = blocks_of(case_of("radians").document(), ParameterTable)
    assert ("Angles are in radians.",) in shown.notes
    (shown,) = blocks_of(case_of("puma560").document(), ParameterTable)
    assert len(shown.notes) == 1


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_sequence_of_a_row_is_its_link_transform(convention: str) -> None:
    document = case_of("puma560" if convention == "standard" else "rrp_modified").document()
    (display,) = [b for b in chapter(document, "The table").blocks if isinstance(b, Display)]
    sides = display.formula.sides
    (operators,) = [leaf for leaf in sides if isinstance(leaf, Juxtaposed)] or [
        side for side in sides[-1].sides if isinstance(side, Juxtaposed)
    ]
    assert_equal(generic_reader(convention).operators(operators), generic_link(convention))


# -- the general link -----------------------------------------------------------------------------

LINK = {"theta": 0.7, "d": 1.3, "a": -0.4, "alpha": 2.1}


def generic_reader(convention: str) -> Reader:
    before = {"standard": "i", "modified": "i-1"}[convention]
    index = {"theta": "i", "d": "i", "a": before, "alpha": before}
    return Reader({}, {}, {(n, index[n], ""): MP.mpf(x) for n, x in LINK.items()})


def generic_link(convention: str) -> np.ndarray:
    text = table("link", row("theta", "d", "a", "alpha"), convention)
    return np.array(read_arm(text).pose(LINK, 0, 1, FIFTY_DIGITS))


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("naming", [Naming.STANDARD, Naming.CRAIG])
def test_the_general_link_is_multiplied_out(convention: str, naming: Naming) -> None:
    name = {"standard": "symbolic_twist", "modified": "symbolic_twist_modified"}[convention]
    blocks = chapter(case_of(name).document(naming=naming), "The transform of one link").blocks
    reader = generic_reader(convention)
    factors, screws = [block.matrices for block in blocks if isinstance(block, MatrixRow)]
    (whole,) = [block for block in blocks if isinstance(block, NamedMatrix)]
    assert (len(factors), len(screws)) == (4, 2)
    product = identity()
    for factor in factors:
        frame, operator = factor.names
        assert isinstance(frame, PoseName)
        assert frame.craig is (naming is Naming.CRAIG)
        assert_equal(reader.matrix(factor.matrix), reader.motion(operator))
        product = product @ reader.matrix(factor.matrix)
    for a, b in itertools.pairwise(factors):
        assert a.names[0].end == b.names[0].start
    assert (factors[0].names[0].start, factors[-1].names[0].end) == ("i-1", "i")
    named = {each.names[0]: reader.matrix(each.matrix) for each in screws}
    for half, screw in zip((factors[:2], factors[2:]), screws, strict=True):
        pair = reader.matrix(half[0].matrix) @ reader.matrix(half[1].matrix)
        assert_equal(reader.matrix(screw.matrix), pair)
        assert {f.names[1].axis for f in half} == {screw.names[0].axis}
    pose, beside = whole.names
    assert (pose.start, pose.end) == ("i-1", "i")
    assert all(isinstance(screw, Screw) for screw in beside.items)
    assert_equal(named[beside.items[0]] @ named[beside.items[1]], reader.matrix(whole.matrix))
    assert_equal(product, generic_link(convention))
    assert_equal(reader.matrix(whole.matrix), generic_link(convention))


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_what_is_said_of_the_parameters_is_so(convention: str) -> None:
    """The entry that vanishes, the unit vectors and the two slides, on a link of numbers."""
    name = {"standard": "symbolic_twist", "modified": "symbolic_twist_modified"}[convention]
    blocks = chapter(case_of(name).document(), "What the four parameters").blocks
    link = generic_link(convention)
    reader = generic_reader(convention)
    for r, c in itertools.product(range(3), repeat=2):
        reader.generic["r", f"{r + 1}{c + 1}", ""] = link[r, c]
    here, before = np.array(link[:3, :3]), np.eye(3)
    directions = {
        (letter, index): axes[:, "xyz".index(letter)]
        for letter in "xz"
        for index, axes in (("i", here), ("i-1", before))
    }
    formulas = [block.formula for block in blocks if isinstance(block, Display)]
    (zero,) = [f for f in formulas if isinstance(f, Equation) and isinstance(f.sides[1], Dot)]
    entry, dot, nothing = zero.sides
    assert abs(reader.value(entry)) < MP.mpf("1e-45")
    assert nothing == Number(value=0)
    left, right = (directions[d.letter, d.index] for d in (dot.left, dot.right))
    assert abs(left @ right - reader.value(entry)) < 1e-30
    pairs = [f for f in formulas if isinstance(f, Listed)]
    assert len(pairs) == 2
    for pair in pairs:
        squares, entries = pair.items
        assert_equal(reader.value(squares.sides[0]), reader.value(squares.sides[1]))
        for printed, meant in zip(*(side.items for side in entries.sides), strict=True):
            assert_equal(reader.value(printed), reader.value(meant))
    (slides,) = [f for f in formulas if isinstance(f, Equation) and f.sides[0] == Generic("p")]
    arrow = sum(
        reader.value(term.factors[0]) * directions[term.factors[1].letter, term.factors[1].index]
        for term in slides.sides[1].terms
    )
    assert_equal(arrow, link[:3, 3])
    (definitions,) = [block for block in blocks if isinstance(block, Definitions)]
    assert {entry.term.letter for entry in definitions.entries} == {"theta", "d", "a", "alpha"}


# -- links, products, result ----------------------------------------------------------------------


def frames_of(node: Node) -> tuple[str, str]:
    match node:
        case PoseName(start=start, end=end):
            return start, end
        case Generic(letter="A", index=index):
            return str(int(index) - 1), index
    raise AssertionError(node)


def printed_matrices(document: Document) -> dict[Node, Matrix]:
    links = [b for b in chapter(document, "The links").blocks if isinstance(b, NamedMatrix)]
    return {block.names[0]: block.matrix for block in links}


@each_table
def test_every_link_is_what_its_motions_make(name: str) -> None:
    case = case_of(name)
    links = [b for b in chapter(case.document(), "The links").blocks if isinstance(b, NamedMatrix)]
    robot = case.robot
    assert len(links) == robot.n + bool(robot.base) + bool(robot.tool)
    for link in links:
        expected = case.pose(*frames_of(link.names[0]))
        assert_equal(case.reader.matrix(link.matrix), expected)
        operators = link.names[1] if len(link.names) > 1 else Juxtaposed(())
        assert_equal(case.reader.operators(operators), expected)


@each_table
@each_order
def test_every_product_agrees_with_the_oracle_and_its_steps(name: str, order: Order) -> None:
    """Factors were printed before, all entries are there, and all forms are worth the same."""
    case = case_of(name)
    document = case.document(order)
    known = printed_matrices(document)
    products = blocks_of(document, ProductResult)
    assert len(products) == len(known) - 1
    assert [product.final for product in products] == [p is products[-1] for p in products]
    for product in products:
        pose, factors = product.names
        start, end = frames_of(pose)
        assert [frames_of(f) for f in factors.items] == [
            (start, frames_of(factors.items[0])[1]),
            (frames_of(factors.items[1])[0], end),
        ]
        assert frames_of(factors.items[0])[1] == frames_of(factors.items[1])[0]
        left, right = (known[factor] for factor in factors.items)
        expected = case.pose(start, end)
        assert_equal(case.reader.matrix(product.matrix), expected)
        assert_steps(case, product, left, right, expected)
        known[pose] = product.matrix
    (result,) = blocks_of(document, PoseResult)
    by_frames = {frames_of(pose): matrix for pose, matrix in known.items()}
    assert by_frames[frames_of(result.whole.names[0])] == result.whole.matrix


def assert_steps(
    case: Case, product: ProductResult, left: Matrix, right: Matrix, expected: np.ndarray
) -> None:
    """Check each entry: its place, its forms, and that an identity is named just where one is used.

    Off the circle, where a cosine and a sine are any two numbers, row times column is what the
    first form says; the last form is the same there if and only if no identity was used.
    """
    assert len(product.steps) == 12
    letters = Reader(case.point, case.joints, letters=off_circle)
    raw = letters.matrix(left) @ letters.matrix(right)
    for position, step in enumerate(product.steps):
        column, line = divmod(position, 3)
        index = f"{line + 1}{column + 1}"
        assert step.name == (Generic("p", "xyz"[line]) if column == 3 else Generic("r", index))
        for form in step.forms:
            assert_equal(case.reader.value(form), expected[line, column])
        assert step.forms[-1] == product.matrix.rows[line][column]
        assert_equal(letters.value(step.forms[0]), raw[line, column])
        moved = abs(letters.value(step.forms[-1]) - raw[line, column]) > MP.mpf("1e-30")
        assert moved == (step.identity is not None) == (len(step.forms) == 2)
        if step.identity is not None:
            assert_identity(step)


def assert_identity(step: EntryStep) -> None:
    """Check that an identity's name says what happens."""
    first, last = step.forms
    single = last.node if isinstance(last, Negative) else last
    before, after = functions_in(first), functions_in(last)
    new = after - before
    assert step.identity is not None
    words = step.identity.value.split()
    if step.identity in (Identity.SQUARES, Identity.ANGLE_SUMS):
        assert bool(new) == (step.identity is Identity.ANGLE_SUMS)
        return
    assert isinstance(first, Sum)
    assert len(first.terms) == 2
    assert isinstance(single, (Short, Call))
    function = single.function[0]
    assert function == {"cosine": "c", "sine": "s"}[words[0]]
    minus = "-" in single.label if isinstance(single, Short) else "Negative" in repr(single)
    assert minus == (words[-1] == "difference")


def functions_in(node: Node) -> set[str]:
    found = {repr(leaf) for leaf in leaves(node) if isinstance(leaf, Short)}
    return found | set(re.findall(r"Call\(function='(?:cos|sin)'.*?\)\)", repr(node)))


@each_table
def test_the_result_lists_the_columns(name: str) -> None:
    case = case_of(name)
    (result,) = blocks_of(case.document(), PoseResult)
    start, end = frames_of(result.whole.names[0])
    robot = case.robot
    assert (start, end) == ("base" if robot.base else "0", "tool" if robot.tool else str(robot.n))
    expected = case.pose(start, end)
    assert_equal(case.reader.matrix(result.whole.matrix), expected)
    assert [group[0].name.letter for group in result.entries.groups] == list("nsap")
    for column, group in enumerate(result.entries.groups):
        for line, entry in enumerate(group):
            assert entry.name.index == "xyz"[line]
            assert_equal(case.reader.value(entry.forms[0]), expected[line, column])


def test_both_orders_lead_to_one_result() -> None:
    for name in ("puma560", "base_and_tool", "ur5"):
        results = [
            blocks_of(case_of(name).document(order), PoseResult)[0].whole.matrix for order in Order
        ]
        assert results[0] == results[1]


def test_the_orders_multiply_from_their_ends() -> None:
    steps = {
        order: [
            frames_of(p.names[0])
            for p in blocks_of(case_of("elbow_3r_of_corpus").document(order), ProductResult)
        ]
        for order in Order
    }
    assert steps[Order.RIGHT] == [("1", "3"), ("0", "3")]
    assert steps[Order.LEFT] == [("0", "2"), ("0", "3")]


@pytest.mark.parametrize("name", ["planar_2r", "planar_2r_modified"])
@pytest.mark.parametrize("naming", list(Naming))
def test_names_of_poses_follow_the_naming(name: str, naming: Naming) -> None:
    document = case_of(name).document(naming=naming)
    craig = naming is Naming.CRAIG or (naming is Naming.AUTO and name.endswith("modified"))
    poses = [
        leaf for node in nodes_of(document) for leaf in leaves(node) if isinstance(leaf, PoseName)
    ]
    assert poses
    assert {pose.craig for pose in poses} == {craig}
    letters = [
        leaf
        for node in nodes_of(document)
        for leaf in leaves(node)
        if isinstance(leaf, Generic) and leaf.letter == "A"
    ]
    assert bool(letters) == (not craig)


def test_one_link_alone_has_no_product() -> None:
    blocks = chapter(case_of("one_joint").document(), "The product").blocks
    assert [type(block) for block in blocks] == [Paragraph]


# -- legends --------------------------------------------------------------------------------------


def nodes_of(document: Document) -> Iterator[Node]:
    """Yield all formulas in reading order, those in running text included."""
    for block in (block for each in document.chapters for block in each.blocks):
        yield from nodes_in(block)


def nodes_in(block: object) -> Iterator[Node]:
    match block:
        case Paragraph(content=content):
            yield from (part for part in content if not isinstance(part, str))
        case ParameterTable(header=header, rows=rows, notes=notes):
            yield from header
            yield from (cell for row in rows for cell in row)
            yield from (part for note in notes for part in note if not isinstance(part, str))
        case Display(formula=formula):
            yield formula
        case Definitions(entries=entries):
            for entry in entries:
                yield entry.term
                yield from (part for part in entry.meaning if not isinstance(part, str))
        case NamedMatrix(names=names, matrix=matrix):
            yield from (*names, matrix)
        case MatrixRow(matrices=matrices):
            for each in matrices:
                yield from nodes_in(each)
        case EntrySteps(entries=steps):
            yield from (node for step in steps for node in (step.name, *step.forms))
        case ProductResult(names=names, matrix=matrix, steps=steps):
            yield from names
            yield from (node for step in steps for node in (step.name, *step.forms))
            yield matrix
        case Entries(groups=groups):
            yield from (n for group in groups for step in group for n in (step.name, *step.forms))
        case PoseResult(whole=whole, entries=entries):
            yield from nodes_in(whole)
            yield from nodes_in(entries)
        case Fitting(whole=whole, otherwise=otherwise):
            yield from nodes_in(whole)
            for each in otherwise:
                yield from nodes_in(each)
        case Figure(drawing=drawing):
            yield from (part for part in drawing.caption if not isinstance(part, str))
        case _:
            raise AssertionError(type(block))


def introduced_by(case: Case, node: Node) -> set[Short]:
    """Return the short forms that an equation of a legend introduces; check what it says."""
    match node:
        case Equation(sides=(Short() as short, Call() as meaning)):
            assert_equal(case.reader.value(short), case.reader.value(meaning))
            return {short}
        case Equation(
            sides=(Generic(index="i") as left, Call(arguments=(Generic() as angle,)) as right)
        ):
            assert right.function[0] == left.letter
            letter = angle.letter
            return {
                Short(left.letter, str(k))
                for k, name in case.joints.items()
                if re.fullmatch(rf"{letter}_?{k}", name)
            }
    return set()


@pytest.mark.parametrize("name", [*TEXTS, *BIG])
@each_order
def test_a_short_form_is_introduced_before_it_is_used(name: str, order: Order) -> None:
    case = case_of(name)
    known: set[Short] = set()
    used: set[Short] = set()
    for node in nodes_of(case.document(order)):
        new = introduced_by(case, node)
        known |= new
        here = {leaf for leaf in leaves(node) if isinstance(leaf, Short)}
        used |= here - new
        assert here <= known, f"{here - known} in {node}"
    if case.joints and name not in ("names_spelt_out",):
        assert used


def test_many_single_joints_are_introduced_in_one_line() -> None:
    links = chapter(case_of("puma560").document(), "The links")
    (legend,) = [b for b in links.blocks if isinstance(b, Paragraph) and b.content[0] == "Here "]
    assert len([part for part in legend.content if isinstance(part, Equation)]) == 2


def test_spelt_out_tables_need_no_legend() -> None:
    document = case_of("names_spelt_out").document()
    assert not any(isinstance(leaf, Short) for n in nodes_of(document) for leaf in leaves(n))
    assert not any("Here " in p.content for p in blocks_of(document, Paragraph))


# -- identities -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "order", "pose", "entry", "identity"),
    [
        ("planar_2r", "right", ("0", "2"), "11", Identity.COSINE_OF_SUM),
        ("planar_2r", "right", ("0", "2"), "21", Identity.SINE_OF_SUM),
        ("planar_2r", "right", ("0", "2"), "12", Identity.SINE_OF_SUM),
        ("planar_2r", "right", ("0", "2"), "x", Identity.ANGLE_SUMS),
        ("planar_2r", "right", ("0", "2"), "33", None),
        ("differences", "left", ("0", "2"), "11", Identity.COSINE_OF_DIFFERENCE),
        ("differences", "left", ("0", "2"), "21", Identity.SINE_OF_DIFFERENCE),
        ("puma560", "right", ("1", "6"), "x", Identity.ANGLE_SUMS),
        ("puma560", "right", ("0", "6"), "11", None),
    ],
)
def test_the_identity_of_an_entry(
    name: str, order: str, pose: tuple[str, str], entry: str, identity: Identity | None
) -> None:
    products = blocks_of(case_of(name).document(Order(order)), ProductResult)
    (product,) = [p for p in products if frames_of(p.names[0]) == pose]
    (step,) = [each for each in product.steps if each.name.index == entry]
    assert step.identity is identity


def test_equal_by_algebra_alone() -> None:
    a, b, q, p = symbols("a b q p", real=True)
    assert same_polynomial((a + b) * cos(q), a * cos(q) + b * cos(q))
    assert same_polynomial(cos(q) * cos(p), cos(p) * cos(q))
    assert not same_polynomial(cos(q) ** 2 + sin(q) ** 2, a / a)
    assert not same_polynomial(cos(q + p), cos(q) * cos(p) - sin(q) * sin(p))
    assert not same_polynomial(a * cos(q), b * cos(q))


# -- numbers --------------------------------------------------------------------------------------

NUMBERED = [name for name, text in TEXTS.items() if "\nvalues:" in text]


def table_values(case: Case) -> dict[str, Any]:
    scope = case.arm._scope(FIFTY_DIGITS, {})
    return {n: scope.evaluate(text, is_angle=False) for n, text in case.arm.values.items()}


def close_to_four_figures(shown: Any, expected: Any) -> bool:
    return bool(
        abs(shown - expected) <= max(MP.mpf("0.5001e-4"), abs(expected) * MP.mpf("0.5001e-4"))
    )


@pytest.mark.parametrize("name", NUMBERED)
def test_the_values_are_those_of_the_table(name: str) -> None:
    case = case_of(name)
    given = chapter(case.document(), "Numbers").blocks[0]
    shown = {
        part.sides[0].text: case.reader.value(part.sides[1])
        for part in given.content
        if isinstance(part, Equation)
    }
    expected = table_values(case)
    assert set(shown) == set(expected)
    for each, value in shown.items():
        assert_equal(value, expected[each])


@pytest.mark.parametrize("name", NUMBERED)
def test_numbers_put_in_give_the_position(name: str) -> None:
    case = case_of(name)
    values = {**case.point, **table_values(case)}
    reader = Reader(values, case.joints)
    robot = case.robot
    first, last = ("base" if robot.base else 0), ("tool" if robot.tool else robot.n)
    expected = np.array(case.arm.pose(values, first, last, FIFTY_DIGITS))
    blocks = chapter(case.document(), "Numbers").blocks
    for block in blocks:
        if not isinstance(block, Entries):
            continue
        for step in (step for group in block.groups for step in group):
            line = "xyz".index(step.name.index)
            assert_equal(reader.value(step.forms[0]), expected[line, 3])
            names = {leaf.text for leaf in leaves(step.forms[0]) if isinstance(leaf, Name)}
            assert not names & set(case.arm.values)
            for rounded in step.forms[1:]:
                assert close_to_four_figures(reader.value(rounded), expected[line, 3])
    for paragraph in (b for b in blocks[1:] if isinstance(b, Paragraph)):
        for part in paragraph.content:
            if isinstance(part, Equation) and not isinstance(part.sides[0], Name):
                assert_equal(reader.value(part.sides[0]), reader.value(part.sides[1]))


@pytest.mark.parametrize("name", NUMBERED)
def test_the_numeric_pose_is_the_oracles(name: str) -> None:
    """Joint variables without a value are zero there, and said to be."""
    case = case_of(name)
    robot, given = case.robot, table_values(case)
    blocks = chapter(case.document(), "Numbers").blocks
    matrices = [block for block in blocks if isinstance(block, NamedMatrix)]
    if {s.name for s in robot.parameters} - set(given):
        assert matrices == []
        return
    (shown,) = matrices
    lead = blocks[blocks.index(shown) - 1]
    missing = [s.name for s in robot.variables if s.name not in given]
    told = [
        side.text
        for part in lead.content
        if isinstance(part, Equation)
        for side in part.sides
        if isinstance(side, Name)
    ]
    assert sorted(told) == sorted(missing)
    zeros = dict.fromkeys(missing, MP.mpf(0))
    first, last = ("base" if robot.base else 0), ("tool" if robot.tool else robot.n)
    expected = np.array(case.arm.pose({**given, **zeros}, first, last, FIFTY_DIGITS))
    found = case.reader.matrix(shown.matrix)
    for line, column in np.ndindex(4, 4):
        assert close_to_four_figures(found[line, column], expected[line, column])


def test_unknown_angles_stay_in_the_position() -> None:
    blocks = chapter(case_of("partly_known").document(), "Numbers").blocks
    (entries,) = [block for block in blocks if isinstance(block, Entries)]
    (x, y) = entries.groups[0]
    assert (x.name.index, y.name.index) == ("x", "y")
    assert [leaf.label for leaf in leaves(x.forms[0]) if isinstance(leaf, Short)] == ["12"]
    assert len(x.forms) == 1


def numbers_of(rows: str, values: str) -> str:
    """Return the chapter of numbers as it is read on a terminal; of a table without units."""
    head = f"name: arm\nconvention: standard\nvalues: {{{values}}}\ncolumns: [theta, d, a, alpha]\n"
    return numbers_in(symdh.loads(f"{head}rows:\n{rows}"))


def numbers_in(robot: symdh.Robot) -> str:
    return " ".join(render_chapters([chapter(derive(robot), "Numbers")]).split())


def test_lengths_without_a_unit_are_plain_numbers() -> None:
    text = numbers_of("  - [q1, 0, a1, 0]\n", "a1: 2")
    assert "The table gives a₁ = 2." in text
    assert "With q₁ = 0 the pose is:" in text


def test_every_sum_of_known_angles_is_told() -> None:
    rows = "".join(f"  - [q{k}, 0, a{k}, 0]\n" for k in (1, 2, 3))
    text = numbers_of(rows, "q1: 10 deg, q2: 20 deg, q3: 30 deg, a1: 1, a2: 2, a3: 3")
    assert "Hence q₁ + q₂ = 30°, q₁ + q₂ + q₃ = 60°. The position becomes" in text


def test_values_that_no_position_needs_are_not_put_in() -> None:
    text = numbers_of("  - [q1, d1, 0, 0]\n", "q1: 30 deg")
    assert "The table gives q₁ = 30°." in text
    assert "The position becomes" not in text
    assert "pose" not in text  # d1 has no value


@pytest.mark.parametrize("known", [{}, {"q1": pi / 6}])
@pytest.mark.parametrize(("length", "value"), [("sqrt(a1)", -1), ("1/a1", 0)])
def test_no_numbers_where_a_length_is_not_real(
    length: str, value: int, known: Mapping[str, Expr]
) -> None:
    """A table with such values is refused; a robot made in Python may have them."""
    robot = symdh.loads(
        f"convention: standard\njoints: [{{theta: q1, d: 0, a: {length}, alpha: 0}}]"
    )
    numbers = {"a1": Integer(value), **known}
    values = {Symbol(name, real=True): number for name, number in numbers.items()}
    text = numbers_in(replace(robot, values=values))
    assert f"a₁ = {value}" in text
    assert "position" not in text
    assert "pose" not in text


def test_an_arm_without_a_closed_form_has_its_numeric_pose_alone() -> None:
    rows = "".join(f"  - [q{k}, 1, a{k}, 90 deg]\n" for k in range(1, 11))
    text = numbers_of(rows, ", ".join(f"a{k}: 1" for k in range(1, 11)))
    assert "The position becomes" not in text
    assert "q₁₀ = 0 the pose is:" in text


def test_a_recursion_from_a_base_that_is_not_there_has_no_equations_of_it() -> None:
    robot = case_of("skew_14_standard").robot
    assert not robot.base
    steps = [
        [
            b
            for b in recursion_module.chapter(Style(robot), start, 14).blocks
            if isinstance(b, EntrySteps)
        ]
        for start in ("base", 0)
    ]
    assert len(steps[0]) == len(steps[1]) == 14


# -- recursion ------------------------------------------------------------------------------------


def run_recursion(case: Case, part: Chapter, start: str, end: str) -> np.ndarray:
    """Execute the printed equations in the order in which they stand."""
    pose = identity()
    for column in range(3):
        reader = Reader(case.point, case.joints)
        displayed = [block.formula for block in part.blocks if isinstance(block, Display)]
        (begin,) = displayed
        for side in begin.sides[:-1]:
            reader.generic[side.letter, side.index, side.stage] = reader.value(begin.sides[-1])
        for line, axis in enumerate("xyz"):
            reader.generic["u", axis, end] = MP.mpf(int(line == column))
        for block in part.blocks:
            for step in block.entries if isinstance(block, EntrySteps) else ():
                name = step.name
                assert (name.letter, name.index, name.stage) not in reader.generic
                (form,) = step.forms
                reader.generic[name.letter, name.index, name.stage] = reader.value(form)
        for line, axis in enumerate("xyz"):
            pose[line, column] = reader.generic["u", axis, start]
            pose[line, 3] = reader.generic["p", axis, start]
    return pose


@each_big
def test_the_equations_of_a_recursion_give_the_pose(name: str) -> None:
    case = case_of(name)
    robot = case.robot
    start, end = ("base" if robot.base else "0"), ("tool" if robot.tool else str(robot.n))
    part = chapter(case.document(), "The pose by recursion")
    assert_equal(run_recursion(case, part, start, end), case.pose(start, end))


@each_big
def test_the_way_back_is_told_by_the_way_there(name: str) -> None:
    case = case_of(name)
    style = Style(case.robot)
    there = recursion_module.chapter(style, 1, case.robot.n)
    back = recursion_module.chapter(style, case.robot.n, 1)
    assert back.blocks[:-1] == there.blocks
    assert_equal(
        run_recursion(case, back, "1", str(case.robot.n)), case.pose("1", str(case.robot.n))
    )
    note = back.blocks[-1]
    assert "transpose" in "".join(part for part in note.content if isinstance(part, str))
    # Its origin is (-n.p, -s.p, -a.p).
    origin = [part for part in note.content if isinstance(part, Tuple)][-1]
    forward = case.pose("1", str(case.robot.n))
    inverse = -forward[:3, :3].T @ forward[:3, 3]
    columns = dict(zip("nsap", forward[:3].T, strict=True))
    for line, component in enumerate(origin.items):
        assert isinstance(component, Negative)
        value = -(columns[component.node.left.letter] @ columns[component.node.right.letter])
        assert_equal(value, inverse[line])


def test_zero_terms_do_not_show_in_a_recursion() -> None:
    case = case_of("skew_14_standard")
    for block in chapter(case.document(), "The pose by recursion").blocks:
        for step in block.entries if isinstance(block, EntrySteps) else ():
            terms = step.forms[0].terms if isinstance(step.forms[0], Sum) else step.forms
            assert not any(term == Number(value=0) for term in terms if len(terms) > 1)
            assert not any(
                isinstance(f, Number) and f.value in (0, 1)
                for term in terms
                for f in (term.factors if isinstance(term, Product) else ())
            )


# -- words ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("count", "text"),
    [
        (0, "no joints"),
        (1, "one joint"),
        (6, "six joints"),
        (12, "twelve joints"),
        (13, "13 joints"),
    ],
)
def test_counts_in_words(count: int, text: str) -> None:
    assert counted(count, "joint") == text
    assert text.startswith(number_word(count))
