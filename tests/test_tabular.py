"""Tables in CSV and Markdown: what they give, where they are wrong, and nothing that they break."""

from __future__ import annotations

from pathlib import Path

import pytest
from conftest import Runner
from hypothesis import given, settings
from hypothesis import strategies as st

from symdh.errors import TableError
from symdh.robot import AngleUnit, Convention, LengthUnit
from symdh.table import load_table, loads_table
from symdh.table.headers import read_header
from symdh.table.markup import unmarked

TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))

CRAIG = """\
name: craig
title: 'An arm, with "quotes"'
convention: modified
units: {angle: deg, length: mm}
joints:
  - {alpha: 0, a: 0, d: 0, theta: theta1}
  - {alpha: -90, a: L1, d: 0.5 m, theta: theta2 - 90}
  - {alpha: 0, a: 20, d: q3, theta: 0, type: prismatic}
tool: [Tx(a4), Rz(90 deg)]
values: {L1: 6, a4: 9 cm}
limits: {theta1: [-170, 170]}
"""
COMMENTS = """\
# The second arm of the lecture
# name: craig
# title: 'An arm, with "quotes"'
# convention: modified
# units: {angle: deg, length: mm}
# tool: [Tx(a4), Rz(90 deg)]
# values: {L1: 6, a4: 9 cm}
# limits: {theta1: [-170, 170]}
"""
FRONT = "---\n" + CRAIG.partition("joints")[0] + CRAIG[CRAIG.index("tool") :] + "---\n"


def found_in(text: str | bytes, filename: str) -> list[tuple[str, str]]:
    """Return the errors of a bad table as place and message."""
    with pytest.raises(TableError) as caught:
        loads_table(text, filename)
    return [
        (f"{d.line}:{d.column}", d.message)
        for d in caught.value.diagnostics
        if d.severity.value == "error"
    ]


# What a good table gives


@pytest.mark.parametrize(
    "rows",
    [
        "alpha_{i-1},a_{i-1},d_i,theta_i,type\n"
        "0,0,0,theta1,\n-90,L1,0.5 m,theta2 - 90,\n0,20,q3,0,prismatic\n",
        "#;α;a;d;θ;Joint type\n1;0;0;0;θ₁;\n2;−90;L1;0.5 m;θ₂ − 90;revolute\n3;0;20;q3;0;linear\n",
        "\t\u03b1\u1d62\u208b\u2081\ta(i-1)\td\t\u03b8\n"
        "1\t0\t0\t0\t theta_1 \n2\t-90°\tL1\t50 cm\ttheta2 - pi/2\n3\t0\t2 cm\tq3\t0\n",
        '"Joint","Link twist (deg)","Link length [mm]","d/mm","Joint angle"\n'
        '"1","0","0","0","theta1"\n2,-90,L1,500,theta2 - 90\n,,,,\n3,0,"20",q3,0,,\n',
        '\n"alpha_deg","a_mm","d","theta °",Comment\r\n'
        '0,0,0,theta1,first\r\n-90,"L1",0.5 m,theta2 - 90,"a ""wrist"", more"\r\n0,20,q3,0,\r\n',
    ],
    ids=["comma", "semicolon", "tab", "quoted", "crlf"],
)
def test_csv_reads_as_the_same_table_in_yaml(rows: str) -> None:
    loaded = loads_table(b"\xef\xbb\xbf" + (COMMENTS + rows).encode(), "x.csv")
    assert loaded.warnings == ()
    assert loaded.robot == loads_table(CRAIG).robot


@pytest.mark.parametrize(
    "rows",
    [
        "| i | alpha_{i-1} | a_{i-1} | d_i | theta_i |\n|---|:-:|--:|:--|---|\n"
        "| 1 | 0 | 0 | 0 | theta1 |\n| 2 | -90 | L1 | 0.5 m | theta2 - 90 |\n"
        "| 3 | 0 | 20 | q3 | 0 |\n",
        "$i$ | $\\alpha_{i-1}$ | $a_{i-1}$ | $d_i$ | $\\theta_i$ | **notes**\n"
        "-|-|-|-|-|-\n1 | $0$ | 0 | 0 | $\\theta_1$ | x\n"
        "2 | $-\\frac{\\pi}{2}$ | $L_{1}$ | `0.5 m` | $\\theta_{2} - 90^\\circ$ | a \\| b\n"
        "3 | 0 | 2\\*10 | $q_3$ | 0 | x\n\nfoot | note\n",
        "| no | yes |\n|---|---|\n| 1 | 2 |\n\n```\n| theta | d | a | alpha |\n|-|-|-|-|\n```\n\n"
        "# Heading\n  | θ | d | a | α |\n  |---|---|---|---|\n"
        "  | θ1 | 0 | 0 | 0 |\n  | θ2 − 90° | 0.5 m | L1 | −90° |\n  | 0 | q3 | 20 mm | 0 |\n",
    ],
    ids=["plain", "latex", "among others"],
)
def test_markdown_reads_as_the_same_table_in_yaml(rows: str) -> None:
    loaded = loads_table(f"{FRONT}\nSome *text*.\n\n{rows}\n", "x.md")
    assert loaded.warnings == ()
    assert loaded.robot == loads_table(CRAIG).robot


def test_keys_of_a_document_are_left_to_it() -> None:
    front = "---\nauthor: somebody\nlayout: page\nname: arm\n---\n"
    rows = "| θ_i | d_i | a_i | α_i |\n|-|-|-|-|\n| q1 | 0 | L | 0 |\n"
    robot = loads_table(front + rows, "x.md").robot
    assert (robot.name, robot.convention, robot.n) == ("arm", Convention.STANDARD, 1)


@pytest.mark.parametrize(
    ("text", "joints"),
    [
        ("theta,d,a_i,alpha_i\nq1,0,L,0\n", 1),
        ("# convention: standard\ntheta;d;a;alpha\nq1;0;0;0\nq2;0;0;0\n", 2),
        ("Words.\n\ntheta | d | a_i | alpha_i\n--|--|--|--\nq1 | 0 | L | 0\n", 1),
        ("---\nconvention: standard\n---\n\n|theta|d|a|alpha|\n|-|-|-|-|\n|q1|0|L|0|\n", 1),
        ("---\nconvention: standard\njoints: [{theta: q1, d: 0, a: 0, alpha: 0}]\n", 1),
        ('{"columns": ["theta", "d", "a_i", "alpha_i"], "rows": [[q,0,0,0]]}', 1),
        ("columns: [theta, d, a_i, alpha_i]\nrows: [[q1, 0, 0, 0]]\n", 1),
    ],
)
def test_without_an_ending_the_text_tells_the_form(text: str, joints: int) -> None:
    loaded = loads_table(text, "<stdin>")
    assert (loaded.robot.n, loaded.warnings) == (joints, ())


@pytest.mark.parametrize(
    ("header", "column", "unit", "convention"),
    [
        ("θ_i", "theta", "", None),
        ("Theta", "theta", "", None),
        ("th", "theta", "", None),
        ("THETA_I [°]", "theta", "°", None),
        ("$\\theta_i$ ($^\\circ$)", "theta", "", None),
        ("joint angle", "theta", "", None),
        ("alpha_{i-1}", "alpha", "", "modified"),
        ("α_{i−1}", "alpha", "", "modified"),
        ("\\alpha_{i-1}", "alpha", "", "modified"),
        ("αᵢ₋₁ [rad]", "alpha", "rad", "modified"),
        ("alpha_i", "alpha", "", "standard"),
        ("α_j", "alpha", "", None),
        ("α_{j-1}", "alpha", "", "modified"),
        ("twist/deg", "alpha", "deg", None),
        ("a", "a", "", None),
        ("a [mm]", "a", "mm", None),
        ("a_mm", "a", "mm", None),
        ("a_in", "a", "in", None),
        ("a_{i-1} (m)", "a", "m", "modified"),
        ("a_{i}", "a", "", "standard"),
        ("r", "a", "", None),
        ("l_i", "a", "", "standard"),
        ("Link length (millimetres)", "a", "millimetres", None),
        ("d_i", "d", "", None),
        ("d, cm", "d", "cm", None),
        ("link offset", "d", "", None),
        ("#", "i", "", None),
        ("Joint", "joint", "", None),
        ("Joint Type", "type", "", None),
        ("beta", None, "", None),
        ("a_x", None, "", None),
        ("d [furlong]", "d", "furlong", None),
        ("x" * 5000, None, "", None),
        (f"link{' ' * 50}length", "a", "", None),  # sixty characters are the most
        (f"link{' ' * 51}length", None, "", None),
    ],
)
def test_headers(header: str, column: str | None, unit: str, convention: str | None) -> None:
    # The degree sign of LaTeX is markup, which a cell has lost before its header is read.
    read = read_header(unmarked(header)[0])
    told = read.convention.value if read.convention else None
    expected_unit = "°" if "circ" in header else unit
    assert (read.column, read.unit, told) == (column, expected_unit, convention)


@pytest.mark.parametrize(
    ("header", "convention", "warnings"),
    [
        ("theta_i,d_i,a_i,alpha_i", Convention.STANDARD, []),
        ("theta_i,d_i,a_{i-1},alpha_{i-1}", Convention.MODIFIED, []),
        ("theta_i,d_i,a,alpha", Convention.STANDARD, ["1:1"]),
        ("theta,d,a_j,alpha_j", Convention.STANDARD, ["1:1"]),
    ],
)
def test_the_index_tells_the_convention(
    header: str, convention: Convention, warnings: list[str]
) -> None:
    loaded = loads_table(f"{header}\nq1,0,L,0\n", "x.csv")
    assert loaded.robot.convention is convention
    assert [f"{d.line}:{d.column}" for d in loaded.warnings] == warnings


def test_an_index_that_the_table_contradicts_is_a_warning() -> None:
    text = "# convention: standard\ntheta_i,d_i,a_{i-1},alpha_{i-1}\nq1,0,L,0\n"
    loaded = loads_table(text, "x.csv")
    assert loaded.robot.convention is Convention.STANDARD
    (warning,) = loaded.warnings
    assert (warning.line, warning.column) == (2, 13)
    assert "modified" not in warning.source
    assert "standard" in warning.message


def test_the_columns_of_yaml_tell_the_same() -> None:
    text = "columns: ['alpha_{i-1} [deg]', 'a_{i-1}', d_i, theta]\nrows: [[90, L, 0, q1]]\n"
    loaded = loads_table(text)
    assert loaded.warnings == ()
    assert loaded.robot.convention is Convention.MODIFIED
    (joint,) = loaded.robot.joints
    assert str(joint.alpha) == "pi/2"


def test_units_of_all_columns_are_those_of_the_table() -> None:
    text = "theta [deg],d (mm),a [mm],alpha/deg\n# values: {d2: 30}\nq1,5,30,90\n30,d2,0,0\n"
    robot = loads_table(text, "x.csv").robot
    assert (robot.units.angle, robot.units.length) == (AngleUnit.DEGREE, LengthUnit.MILLIMETRE)
    assert [str(value) for value in robot.values.values()] == ["30"]
    first, _ = robot.joints
    assert (str(first.d), str(first.a), str(first.alpha)) == ("5", "30", "pi/2")


def test_columns_may_differ_in_their_units() -> None:
    text = "theta [deg],d [m],a [mm],alpha [rad]\nq1 - 45,0.2,30 + L,-1\n60,d2 + 1 cm,2*5,pi/2\n"
    robot = loads_table(text, "x.csv").robot
    assert (robot.units.angle, robot.units.length) == (None, LengthUnit.METRE)
    first, second = robot.joints
    assert [str(x) for x in (first.theta, first.d, first.a, first.alpha)] == (
        ["q1 - pi/4", "1/5", "L + 3/100", "-1"]
    )
    assert [str(x) for x in (second.theta, second.d, second.a, second.alpha)] == (
        ["pi/3", "d2 + 1/100", "1/100", "pi/2"]
    )


# Where a bad table is wrong


def test_the_caret_stands_under_the_quote_that_is_not_closed() -> None:
    with pytest.raises(TableError) as caught:
        loads_table('theta,d,a_i,alpha_i\nq1,0,"0,0\n', "arm.csv")
    _, row, caret = str(caught.value).splitlines()
    assert row[caret.index("^")] == '"'


@pytest.mark.parametrize(
    ("text", "errors"),
    [
        ("theta,d,a_i,alpha_i\nq1,0,5 (,0\n", [("2:8", "")]),
        ('theta,d,a_i,alpha_i\nq1, 0,"2 ** x",0\n', [("2:9", "exponent")]),
        ("theta;d;a_i;alpha_i\nq1;0;0,5;0\n", [("2:7", "decimal point is .")]),
        (
            "theta,d,a_i,alpha_i\nq1,0,0,5,90 deg\nq2,0,0\n",
            [("2:1", "5 cells, and there are 4 columns; a decimal point"), ("3:1", "3 cells")],
        ),
        ("theta,d,a_i,alpha_i\nq1,,x,0\n", [("2:4", "write 0 for zero")]),
        ("theta,d,a_i\nq1,0,0\n", [("1:1", "missing column alpha")]),
        ("theta,d,a_i,a\nq1,0,0,0\n", [("1:1", "missing column alpha"), ("1:13", "given twice")]),
        ("theta,d,a_i,alpha_i,mass\nq1,0,0,0,3\n", [("1:21", "column mass unknown")]),
        ("theta,d,a_i,alpha_i,\nq1,0,0,0,3\n", [("2:1", "5 cells")]),
        ("theta,d,a_i,alpha_i,r\nq1,0,0,0,3\n", [("1:21", "there is a column a")]),
        ("alpha,d,theta,r\n0,0,q1,0\n", [("1:15", "Khalil")]),
        ("alpha_i,a_{i-1},d,theta\n0,0,0,q1\n", [("1:9", "modified convention")]),
        (
            "theta [mm],d [deg],a_i [x],alpha_i\nq1,0,0,0\n",
            [("1:1", "use deg"), ("1:12", "use m,"), ("1:20", "unit x")],
        ),
        ("theta [deg],d [m],a [mm],alpha\nq1,0,k*(L + 5),0\n", [("2:7", "unit of this product")]),
        ("theta,d,a_i,alpha_i\nq1,0,0,90\n", [("2:8", "an angle needs a unit")]),
        ('theta,d,a_i,alpha_i\nq1,0,"0,0\n', [("2:6", "not closed")]),
        ('theta,d,a_i,alpha_i\nq1,0,"0"1,0\n', [("2:9", "after the quote")]),
        ("# convension: modified\ntheta,d,a,alpha\nq1,0,0,0\n", [("1:3", "convention?")]),
        ("# units: {angle: grad}\ntheta,d,a_i,alpha_i\nq1,0,0,0\n", [("1:18", "grad unknown")]),
        ("# name: a\n# name: b\ntheta,d,a_i,alpha_i\nq1,0,0,0\n", [("2:3", "given twice")]),
        ("#name: [\ntheta,d,a_i,alpha_i\nq1,0,0,0\n", [("1:9", "")]),
        ("theta,d,a_i,alpha_i\nq1" + "," * 101 + "\n", [("2:1", "more than 100 cells")]),
        ("1,2,3,4\n5,6,7,8\n", [("1:1", "no names of columns")]),
        ("theta,d,a_i,alpha_i\n", [("1:1", "at least one row")]),
        ("# nothing\n\n", [("1:1", "no rows")]),
        ("", [("1:1", "no rows")]),
    ],
)  # fmt: skip
def test_mistakes_in_csv(text: str, errors: list[tuple[str, str]]) -> None:
    found = found_in(text, "x.csv")
    assert [place for place, _ in found] == [place for place, _ in errors]
    for (_, message), (_, says) in zip(found, errors, strict=True):
        assert says in message


HEADER = "| theta | d | a_i | alpha_i |\n|---|---|---|---|\n"


@pytest.mark.parametrize(
    ("text", "errors"),
    [
        (HEADER + "| q1 | 0 | 0 | 2\\*3 mm |\n", [("3:16", "a length, where an angle")]),
        (HEADER + "| $\\theta_1 + foo(1)$ | 0 | 0 | 0 |\n", [("3:15", "foo is not a known")]),
        (HEADER + "| q1 | 0 | $\\sqrt{2}$ | 0 |\n", [("3:13", "unexpected character \\")]),
        (HEADER + "| q1\n", [("3:3", "1 cells")]),
        (HEADER + "| q1 | 0 | 0 |\n| q2 | 0 |  | 0 |\n", [("3:3", "3 cells"), ("4:12", "empty")]),
        (HEADER + "| q1 | 0 | 0 | 0 |\n\n" + HEADER, [("5:1", "the first is on line 1")]),
        ("| theta | d | a | alpha |\n|---|---|---|\n| q | 0 | 0 | 0 |\n", [("2:1", "3 cells")]),
        ("| theta | d |\n|---|---|\n| q | 0 |\n", [("1:3", "missing columns a, alpha")]),
        ("words\n", [("1:1", "no table of joints")]),
        ("---\nname: x\n---\n", [("1:1", "no table of joints")]),
        ("---\nunits: {angel: deg}\n---\n" + HEADER + "| q1 | 0 | 0 | 0 |\n", [("2:9", "angle?")]),
        ("---\nname: [\n---\n" + HEADER + "| q1 | 0 | 0 | 0 |\n", [("2:", "")]),
        ("", [("1:1", "no table of joints")]),
    ],
)
def test_mistakes_in_markdown(text: str, errors: list[tuple[str, str]]) -> None:
    found = found_in(text, "x.md")
    assert len(found) == len(errors)
    for (place, message), (expected, says) in zip(found, errors, strict=True):
        assert place.startswith(expected), message
        assert says in message


def test_the_caret_stands_below_the_mistake_in_a_cell_with_markup() -> None:
    with pytest.raises(TableError) as caught:
        loads_table(HEADER + "| $\\theta_{1} + 2 \\cdot foo(1)$ | 0 | 0 | 0 |\n", "x.md")
    _, line, caret = str(caught.value.diagnostics[0]).split("\n")
    assert line[caret.index("^") :].startswith("foo(1)")


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("$-\\frac{\\pi}{2}$", "-(pi)/(2)"),
        ("90^{\\circ}", "90°"),
        ("$q_{12}\\,$", "q_12 "),
        ("2\\*L\\_1", "2*L_1"),
        ("−1", "-1"),
        ("theta1 - 90 deg", "theta1 - 90 deg"),
        ("\\sqrt{2}", "\\sqrt{2}"),
    ],
)
def test_markup_is_taken_out(text: str, plain: str) -> None:
    found, places = unmarked(text)
    assert found == plain
    assert places == () or (len(places), places[-1]) == (len(plain) + 1, len(text))


# There and back, and on the command line


@pytest.mark.parametrize("ending", ["csv", "md"])
def test_a_converted_table_is_read_like_the_first(
    ending: str, tmp_path: Path, run_symdh: Runner
) -> None:
    form = {"csv": "csv", "md": "markdown"}[ending]
    (tmp_path / "arm.yaml").write_text(CRAIG)
    target = tmp_path / f"other.{ending}"
    for _ in range(2):  # the second time, symdh knows the file for its own
        assert run_symdh("convert", "arm.yaml", "--to", form, "-o", target).returncode == 0
    assert load_table(str(target)).robot == load_table(str(tmp_path / "arm.yaml")).robot
    shown = [run_symdh("show", table).stdout for table in ("arm.yaml", target)]
    assert shown[0] == shown[1] != ""
    piped = run_symdh("show", "-", input=target.read_text())
    assert piped.stdout == shown[0]


@pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)
def test_the_corpus_comes_back(table: Path) -> None:
    from symdh.render.interchange import export

    robot = load_table(str(table)).robot
    for form, name in (("csv", "x.csv"), ("markdown", "x.md")):
        loaded = loads_table(export(robot, form).text, name)
        assert (loaded.robot, loaded.warnings) == (robot, ())


def test_a_spreadsheet_may_write_the_file_again() -> None:
    """It quotes cells with commas, and fills the lines of comment up with separators."""
    text = COMMENTS.replace("\n", ",,,\n").replace(
        "# units: {angle: deg, length: mm},,,", '"# units: {angle: deg, length: mm}",,,'
    )
    rows = "theta,d,a,alpha\ntheta1,0,0,0\ntheta2 - 90,0.5 m,L1,-90\n0,q3,20,0\n"
    assert loads_table(text + rows, "x.csv").robot == loads_table(CRAIG).robot


# Nothing breaks it

SIGNS = r"""
| - , ; " # --- theta d a alpha _{i-1} q1 0 90 deg $ \ { } [mm] ( ) ` ``` name: units ° r −
|---|---|---|---| \frac{1}{2}
"""
PIECES = st.sampled_from(
    [*SIGNS.split(), "\n", "\t", " ", "\u00a0", "\ufeff", "| theta | d | a | alpha |\n", "---\n"]
)


@given(st.lists(PIECES, max_size=60).map("".join), st.sampled_from(["x.csv", "x.md", "x"]))
@settings(max_examples=400, deadline=None)
def test_any_text_is_a_table_or_has_located_errors(text: str, name: str) -> None:
    try:
        loads_table(text, name)
    except TableError as error:
        lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        for found in error.diagnostics:
            assert 1 <= found.line <= len(lines)
            assert found.column >= 1


@given(st.binary(max_size=200), st.sampled_from(["x.csv", "x.md", "x"]))
@settings(max_examples=200, deadline=None)
def test_any_bytes_are_refused_or_read(data: bytes, name: str) -> None:
    try:
        loads_table(data, name)
    except TableError as error:
        assert error.diagnostics


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("theta,d,a,alpha\n" + "q,0,0,0\n" * 100_000, "x.csv"),
        ("," * 1_000_000, "x.csv"),
        ("theta,d,a,alpha\n" + "," * 1_000_000, "x.csv"),
        ('"' * 1_000_000, "x.csv"),
        ("# name: x\n" * 100_000 + "theta,d,a,alpha\nq,0,0,0\n", "x.csv"),
        ("a " * 500_000 + ",theta", "x.csv"),
        ("|" * 1_000_000 + "\n" + "|-" * 20_000, "x.md"),
        ("a|b\n-|-\n" * 100_000, "x.md"),
        (HEADER + "| " + "\\frac{" * 300 + " |\n", "x.md"),
        (HEADER + "| $" + "{" * 1900 + "$ |\n" * 50, "x.md"),
        ("---\n" + "name: x\n" * 100_000 + "---\n" + HEADER, "x.md"),
    ],
    ids=range(11),
)
def test_too_much_of_anything_is_refused(text: str, name: str) -> None:
    assert found_in(text, name)
