"""Conversion between the conventions, and every format that a table is written in."""

from __future__ import annotations

import csv
import functools
import json
import re
import subprocess
import sys
import types
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from oracle import EXTENDED, FIFTY_DIGITS, METRES, Arm, elementary, read_arm, read_arm_file
from sympy import Integer
from urdf_fk import read_chain

import symdh
from symdh.cli.main import run
from symdh.errors import LimitError, UnsupportedError
from symdh.frames.conversion import convert
from symdh.render.interchange import FORMATS, export
from symdh.render.table_yaml import table_yaml
from symdh.robot import Convention, Robot
from tools import require_tool

ROOT = Path(__file__).parent.parent
TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
EXAMPLES = sorted(
    path
    for path in (ROOT / "examples").glob("*.yaml")
    if {"joints", "rows"} & set(yaml.safe_load(path.read_text())) and "axes" not in path.name
)
POSES = 100
Capture = pytest.CaptureFixture[str]

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)

#: Everything that the formats treat apart: offsets, signs, fixed rows, millimetres, both words.
CROOKED = """\
name: crooked
title: "it's: a {{crooked}} | *arm*, <50> % & co"
convention: {convention}
units: {{angle: deg, length: mm}}
joints:
  - {{theta: 90 deg - q1, d: d1, a: 100, alpha: 30 deg}}
  - {{theta: 25 deg, d: 20 - q2, a: 40, alpha: -70 deg}}
  - {{theta: 10 deg, d: h3, a: 5, alpha: 45 deg, type: fixed}}
  - {{theta: q4 + 0.3 rad, d: 60, a: -30, alpha: 90 deg}}
  - {{theta: 15 deg, d: q5 + 12, a: 10, alpha: 20 deg}}
  - {{theta: -q6, d: 7, a: 8, alpha: 9 deg}}
base: [Tx(1), Rz(20 deg), Rx(15 deg), Tx(4)]
tool: [Rx(40 deg), Tx(3), Ty(-2), Rz(10 deg)]
values: {{d1: 50, h3: 35}}
limits: {{q1: [-100 deg, 2 rad], q2: [-100, 300]}}
"""
#: The same without the fixed row, which DHRobot has no link for.
MOVING = re.sub(r".*type: fixed.*\n", "", CROOKED).replace(", h3: 35", "")
OPEN = "convention: standard\njoints: [{theta: q1, d: 0, a: a1, alpha: 0}]\n"
BOTH = ("standard", "modified")


def other(convention: Convention) -> Convention:
    return Convention.MODIFIED if convention is Convention.STANDARD else Convention.STANDARD


@functools.cache
def load(table: Path) -> symdh.Robot:
    return symdh.load(table)


def named(arm: Arm, q: np.ndarray) -> dict[str, Any]:
    return {name: q[..., k] for k, (name, _) in enumerate(arm.variables)}


def in_metres(arm: Arm, poses: np.ndarray) -> np.ndarray:
    poses = np.array(poses)
    poses[..., :3, 3] *= float(METRES[arm.length])
    return poses


def si_values(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Joint values as the formats in metres take them."""
    scale = [1.0 if turns else float(METRES[arm.length]) for _, turns in arm.variables]
    return q * np.array(scale)


# -- conventions -----------------------------------------------------------------------------------


@each_table
def test_the_other_convention_has_the_same_pose(table: Path) -> None:
    robot, arm = load(table), read_arm_file(table)
    converted = convert(robot, other(robot.convention))
    assert converted.convention is not robot.convention
    there = read_arm(table_yaml(converted))
    assert there.convention == converted.convention.value
    q = arm.seeded_poses(POSES, seed=TABLES.index(table))
    difference = np.abs(there.pose(named(arm, q)) - arm.pose(named(arm, q)))
    assert difference.max() <= arm.tolerance() * 1e-3  # the oracle carries 64 bits
    for values in q[:2]:
        numbers = named(arm, values)
        exact = there.pose(numbers, arithmetic=FIFTY_DIGITS)
        expected = arm.pose(numbers, arithmetic=FIFTY_DIGITS)
        assert all(abs(x - y) < 1e-45 for x, y in zip(exact.flat, expected.flat, strict=True))


@each_table
def test_there_and_back_is_the_same_table(table: Path) -> None:
    robot = load(table)
    assert convert(convert(robot, other(robot.convention)), robot.convention) == robot
    assert convert(robot, robot.convention) is robot


@pytest.mark.parametrize("convention", BOTH)
def test_base_and_tool_take_what_rows_have_no_place_for(convention: str) -> None:
    text = CROOKED.format(convention=convention)
    robot, arm = symdh.loads(text), read_arm(text)
    converted = convert(robot, other(robot.convention))
    there = read_arm(table_yaml(converted))
    q = arm.seeded_poses(POSES, seed=1)
    assert np.abs(there.pose(named(arm, q)) - arm.pose(named(arm, q))).max() < 1e-14
    back = read_arm(table_yaml(convert(converted, robot.convention)))
    assert np.abs(back.pose(named(arm, q)) - arm.pose(named(arm, q))).max() < 1e-14
    assert converted.limits == robot.limits
    assert converted.title == robot.title


def test_the_planar_arm_of_the_lectures_in_both_conventions() -> None:
    # The last link of the modified table is a tool; in the standard one it is a_2.
    craig = symdh.load(ROOT / "examples" / "planar_2r_modified.yaml")
    standard = yaml.safe_load(table_yaml(convert(craig, Convention.STANDARD)))
    assert standard["joints"] == [
        {"theta": "theta1", "d": 0, "a": "a1", "alpha": 0},
        {"theta": "theta2", "d": 0, "a": "a2", "alpha": 0},
    ]
    assert "tool" not in standard
    back = yaml.safe_load(
        table_yaml(convert(convert(craig, Convention.STANDARD), craig.convention))
    )
    assert back["tool"] == ["Tx(a2)"]


def test_the_puma_as_craig_would_have_it() -> None:
    robot = symdh.load(ROOT / "examples" / "puma560.yaml")
    rows = yaml.safe_load(table_yaml(convert(robot, Convention.MODIFIED)))["joints"]
    # Craig's table has alpha_{i-1} and a_{i-1} of the link before; d_i and theta_i stay.
    assert [(row["alpha"], row["a"], row["d"]) for row in rows] == [
        (0, 0, "d1"),
        ("90 deg", 0, 0),
        (0, "a2", "d3"),
        ("-90 deg", "a3", "d4"),
        ("90 deg", 0, 0),
        ("-90 deg", 0, 0),
    ]


def test_a_value_goes_with_its_symbol() -> None:
    robot = symdh.loads(
        "convention: standard\nunits: {length: m}\njoints:\n"
        "  - {theta: q1, d: 0, a: 0, alpha: 0}\n  - {theta: q2, d: 0, a: a2, alpha: 0}\n"
        "tool: [Tx(-a2)]\nvalues: {a2: 1}\n"
    )
    merged = convert(convert(robot, Convention.MODIFIED), Convention.STANDARD)
    assert merged.joints[-1].a == 0
    assert merged.tool == ()
    assert dict(merged.values) == {}
    assert symdh.loads(table_yaml(merged)).joints == merged.joints


def test_fifty_joints() -> None:
    rows = "".join(
        f"  - {{theta: q{i} + {i} deg, d: 0.{i:02}, a: 0.{51 - i:02}, alpha: {7 * i} deg}}\n"
        for i in range(1, 51)
    )
    text = f"name: snake\nconvention: standard\nunits: {{angle: deg, length: m}}\njoints:\n{rows}"
    robot, arm = symdh.loads(text), read_arm(text)
    converted = convert(robot, Convention.MODIFIED)
    there = read_arm(table_yaml(converted))
    q = arm.seeded_poses(POSES, seed=50)
    assert np.abs(there.pose(named(arm, q)) - arm.pose(named(arm, q))).max() <= arm.tolerance()
    assert convert(converted, Convention.STANDARD) == robot


def test_a_word_that_would_be_too_long_for_a_table() -> None:
    motions = ", ".join(["Ty(1)"] * 50)
    robot = symdh.loads(
        "name: long_tool\nconvention: standard\njoints: [{theta: q1, d: 0, a: 1, alpha: 0}]\n"
        f"tool: [{motions}]\n"
    )
    with pytest.raises(LimitError, match="tool of long_tool would have over 50 motions"):
        convert(robot, Convention.MODIFIED)


_amounts = st.sampled_from(["0", "0.25", "-1.5", "L"])
_angles = st.sampled_from(["0", "90 deg", "-30 deg", "180 deg", "0.7 rad", "beta0"])
_letters = st.one_of(
    st.builds("T{}({})".format, st.sampled_from("xyz"), _amounts),
    st.builds("R{}({})".format, st.sampled_from("xyz"), _angles),
)


@given(st.data(), st.sampled_from(BOTH))
@settings(max_examples=60, deadline=None, derandomize=True)
def test_any_words_and_rows(data: st.DataObject, convention: str) -> None:
    rows = []
    for i in range(data.draw(st.integers(1, 4))):
        shape = f"a: {data.draw(_amounts)}, alpha: {data.draw(_angles)}, variable: q{i}"
        if data.draw(st.booleans()):
            rows.append(f"{{theta: q{i}, d: {data.draw(_amounts)}, {shape}, type: revolute}}")
        else:
            rows.append(f"{{theta: {data.draw(_angles)}, d: q{i}, {shape}, type: prismatic}}")
    base, tool = (data.draw(st.lists(_letters, max_size=4)) for _ in "bt")
    text = (
        f"name: any\nconvention: {convention}\nunits: {{length: m}}\njoints:\n"
        + "".join(f"  - {row}\n" for row in rows)
        + f"base: [{', '.join(base)}]\ntool: [{', '.join(tool)}]\n"
    )
    robot = symdh.loads(text)
    converted = convert(robot, other(robot.convention))
    q = np.random.default_rng(0).uniform(-1, 1, (5, len(rows)))
    numbers: dict[str, Any] = {f"q{i}": q[:, i] for i in range(len(rows))}
    numbers |= {"L": np.full(5, 0.375), "beta0": np.full(5, 0.9)}
    poses = [_pose_of_words(each, numbers) for each in (robot, converted)]
    assert np.abs(poses[0] - poses[1]).max() < 1e-15
    again = convert(converted, robot.convention)
    assert np.abs(_pose_of_words(again, numbers) - poses[0]).max() < 1e-15
    assert symdh.loads(table_yaml(converted)).joints == converted.joints


def _pose_of_words(robot: Robot, numbers: dict[str, Any]) -> np.ndarray:
    """Multiply what the rows of a robot say, in the oracle's own matrices and order."""

    def value(e: Any) -> Any:
        scopes = [{s: float(numbers[s.name][k]) for s in e.free_symbols} for k in range(5)]
        return np.array([np.longdouble(str(e.subs(scope).evalf(25))) for scope in scopes])

    shape = (5,)
    pose = elementary("Tx", 0.0, shape, EXTENDED)
    order = "Rz:theta Tz:d Tx:a Rx:alpha"
    if robot.convention is Convention.MODIFIED:
        order = "Rx:alpha Tx:a Rz:theta Tz:d"
    steps = [(f"{m.kind.value}{m.axis.name.lower()}", m.amount) for m in robot.base]
    for joint in robot.joints:
        steps += [(s.split(":")[0], getattr(joint, s.split(":")[1])) for s in order.split()]
    steps += [(f"{m.kind.value}{m.axis.name.lower()}", m.amount) for m in robot.tool]
    for kind, amount in steps:
        pose = pose @ elementary(kind, value(amount), shape, EXTENDED)
    return pose


@pytest.mark.parametrize("unit", ["deg", "rad"])
@pytest.mark.parametrize(
    "angle",
    [
        "k*(b0 + 0.1 rad)",
        "k*(b0 - 5 deg)",
        "k*(0.25 rad + m*(b0 + (1/7) rad))",
        "(b0 - 2 rad)*cos(k*(b0 + 0.1 rad))",
        "k*abs(b0 + 0.1 rad) + 30 deg",
        "k*atan2(h + 0.5 m, 2 m)*(b0 + 1 rad)",
    ],
)
def test_a_sum_inside_a_product_keeps_its_unit(angle: str, unit: str) -> None:
    robot = symdh.loads(
        f"name: inner\nconvention: standard\nunits: {{angle: {unit}, length: m}}\n"
        f"joints:\n  - {{theta: q1, d: 0, a: 1, alpha: '{angle}'}}\nbase: ['Rx({angle})']\n"
    )
    for text in (table_yaml(robot), export(robot, "json").text):
        again = symdh.loads(text)
        assert again.joints == robot.joints
        assert again.base == robot.base


def test_a_factor_in_a_table_of_radians_stays_a_factor() -> None:
    robot = symdh.loads(
        "name: inner\nconvention: standard\nunits: {angle: rad, length: m}\n"
        "joints:\n  - {theta: q1, d: 0, a: 1, alpha: (k + 1)*b0}\n"
    )
    assert "rad" not in table_yaml(robot).split("joints:")[1]
    assert symdh.loads(table_yaml(robot)).joints == robot.joints


NAMED = """\
name: named
convention: standard
joints:
  - {theta: q1 + k, d: 1, a: pi/7, alpha: 2*pi/7, variable: q1}
  - {theta: pi/7, d: h + q2, a: 0, alpha: -pi/7, type: prismatic, variable: q2}
  - {theta: 0, d: 3, a: 0, alpha: 0}
  - {theta: 0, d: h, a: 0, alpha: 0, type: fixed}
values: {k: 3*pi/7}
"""


@pytest.mark.parametrize("form", ["yaml", "json", "csv", "markdown"])
def test_named_variables_and_odd_parts_of_a_turn_come_back(form: str) -> None:
    robot = symdh.loads(NAMED)
    assert [str(variable) for variable in robot.variables] == ["q1", "q2"]
    text = export(robot, form).text
    assert symdh.loads(text) == robot
    assert "-pi/7" in text
    assert "1*pi" not in text


# -- text formats ----------------------------------------------------------------------------------


@pytest.mark.parametrize("table", [*TABLES, *EXAMPLES], ids=lambda path: path.stem)
@pytest.mark.parametrize("form", ["yaml", "json", "csv", "markdown"])
def test_symdh_reads_its_own_table_back(table: Path, form: str) -> None:
    robot = load(table)
    assert symdh.loads(export(robot, form).text) == robot


@pytest.mark.parametrize("convention", BOTH)
@pytest.mark.parametrize("form", ["yaml", "json", "csv", "markdown"])
def test_types_offsets_titles_and_words_come_back(convention: str, form: str) -> None:
    robot = symdh.loads(CROOKED.format(convention=convention))
    assert symdh.loads(export(robot, form).text) == robot


def test_json_says_everything_as_text() -> None:
    shown = json.loads(export(symdh.loads(CROOKED.format(convention="modified")), "json").text)
    assert shown["convention"] == "modified"
    assert shown["units"] == {"angle": "deg", "length": "mm"}
    assert list(shown["joints"][0]) == ["alpha", "a", "d", "theta"]
    assert shown["joints"][2]["type"] == "fixed"
    assert shown["joints"][0]["theta"] == "-q1 + 90 deg"
    assert shown["base"] == ["Tx(1)", "Rz(20 deg)", "Rx(15 deg)", "Tx(4)"]
    assert shown["values"] == {"d1": "50", "h3": "35"}
    assert shown["limits"]["q1"] == ["-100 deg", "2 rad"]


@pytest.mark.parametrize(
    ("convention", "header"),
    [
        ("standard", ["theta_i", "d_i", "a_i", "alpha_i", "type"]),
        ("modified", ["alpha_{i-1}", "a_{i-1}", "d_i", "theta_i", "type"]),
    ],
)
def test_csv_has_the_rows(convention: str, header: list[str]) -> None:
    robot = symdh.loads(CROOKED.format(convention=convention))
    exported = export(robot, "csv")
    lines = exported.text.splitlines()
    comments = [line for line in lines if line.startswith("#")]
    assert "# units: {angle: deg, length: mm}" in comments
    first, *rows = csv.reader(lines[len(comments) :])
    assert first == header
    assert len(rows) == 6
    by_name = [dict(zip(first, row, strict=True)) for row in rows]
    assert [row["d_i"] for row in by_name] == ["d1", "20 - q2", "h3", "60", "q5 + 12", "7"]
    assert [row["type"] for row in by_name] == ["", "", "fixed", "", "", ""]
    assert exported.notes == ()


def test_markdown_is_one_table_with_the_rest_on_top() -> None:
    text = export(symdh.loads(CROOKED.format(convention="standard")), "markdown").text
    lines = text.splitlines()
    rows = [line for line in lines if line.startswith("|")]
    assert {row.count("|") for row in rows} == {7}
    assert [cell.strip() for cell in rows[0].strip("|").split("|")][:3] == ["i", "theta_i", "d_i"]
    assert set(rows[1]) <= set("|- ")
    assert len(rows) == 2 + 6
    top = lines.index("---", 1)
    assert r"\*arm\*" in lines[top + 2]
    assert r"\<50\>" in lines[top + 2]
    assert "convention: standard" in lines[:top]
    assert yaml.safe_load("\n".join(lines[:top]))["tool"] == (
        ["Rx(40 deg)", "Tx(3)", "Ty(-2)", "Rz(10 deg)"]
    )


def test_a_product_in_a_markdown_cell_is_no_emphasis() -> None:
    robot = symdh.loads("convention: standard\njoints: [{theta: q1, d: 2*h*k, a: 0, alpha: 0}]\n")
    assert r"2\*h\*k" in export(robot, "markdown").text


@pytest.mark.parametrize("table", [*EXAMPLES, "crooked"], ids=lambda path: Path(path).stem)
def test_the_latex_table_compiles(table: Path | str, tmp_path: Path) -> None:
    pdflatex = require_tool("pdflatex")
    robot = load(table) if isinstance(table, Path) else crooked("modified")[0]
    body = export(robot, "latex-table").text
    assert body.count("\\\\\n") == robot.n + 1
    (tmp_path / "rows.tex").write_text(
        "\\documentclass{article}\\usepackage[T1]{fontenc}\\usepackage{amsmath,booktabs,textcomp}\n"
        f"\\begin{{document}}\n{body}\\end{{document}}\n"
    )
    ran = subprocess.run(
        [pdflatex, "-interaction=nonstopmode", "-halt-on-error", "rows.tex"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    assert ran.returncode == 0, ran.stdout[-2000:]
    assert "Overfull" not in ran.stdout


# -- formats of numbers ----------------------------------------------------------------------------


def crooked(convention: str, text: str = CROOKED) -> tuple[Robot, Arm]:
    text = text.format(convention=convention)
    return symdh.loads(text), read_arm(text)


def check(fk: Callable[[np.ndarray], np.ndarray], arm: Arm, seed: int) -> None:
    """Compare a model in metres with the oracle's poses of its table."""
    q = arm.seeded_poses(POSES, seed=seed)
    expected = in_metres(arm, arm.pose(named(arm, q)))
    assert np.abs(fk(si_values(arm, q)) - expected).max() <= arm.tolerance()


@each_table
def test_urdf_has_the_pose_of_the_table(table: Path) -> None:
    chain = read_chain(export(load(table), "urdf").text, "base_link", "tool0")
    check(chain.pose, read_arm_file(table), TABLES.index(table))


@pytest.mark.parametrize("convention", BOTH)
def test_urdf_of_offsets_signs_and_fixed_rows(convention: str) -> None:
    robot, arm = crooked(convention)
    exported = export(robot, "urdf")
    chain = read_chain(exported.text, "base_link", "tool0")
    check(chain.pose, arm, 3)
    assert chain.names == ["q1", "q2", "q4", "q5", "q6"]
    assert chain.types == ["revolute", "prismatic", "continuous", "prismatic", "continuous"]
    limits = [joint.find("limit") for joint in chain.joints if joint.attrib["type"] != "fixed"]
    assert [
        None if each is None else (float(each.attrib["lower"]), float(each.attrib["upper"]))
        for each in limits
    ] == [
        (pytest.approx(-100 * np.pi / 180, abs=1e-15), 2.0),
        (-0.1, 0.3),
        None,
        (-1000.0, 1000.0),
        None,
    ]
    assert exported.notes == ("q5 has no limits in the table and URDF wants some: 1000 m each way",)


def test_a_variable_may_have_the_name_of_a_fixed_joint() -> None:
    robot = symdh.loads(
        "name: a\nconvention: standard\njoints: [{theta: tool, d: 0, a: 1, alpha: 0}]\n"
        "tool: [Tx(2)]\n"
    )
    chain = read_chain(export(robot, "urdf").text, "base_link", "tool0")
    names = [joint.attrib["name"] for joint in chain.joints]
    assert len(set(names)) == len(names) == 2
    assert export(robot, "urdf").notes == (
        "the table gives no unit of length; its lengths are written as metres",
    )


@pytest.mark.parametrize("pitch", ["90 deg", "-90 deg"])
def test_urdf_of_a_frame_that_points_straight_up_or_down(pitch: str) -> None:
    # Roll and yaw are then about one line, and only their sum or difference is told.
    text = (
        "name: up\nconvention: standard\nunits: {length: m}\n"
        "joints: [{theta: q1, d: 0, a: 1, alpha: 0}]\n"
        f"tool: [Rz(30 deg), Ry({pitch}), Rx(20 deg)]\n"
    )
    chain = read_chain(export(symdh.loads(text), "urdf").text, "base_link", "tool0")
    check(chain.pose, read_arm(text), 8)


def test_matlab_names_no_two_joints_alike() -> None:
    robot = symdh.loads(
        "name: a\nconvention: standard\njoints:\n"
        "  - {theta: to_tool, d: 0, a: 1, alpha: 0}\n"
        "  - {theta: fixed3, d: 0, a: 1, alpha: 0}\n"
        "  - {theta: 0, d: 0, a: 1, alpha: 0}\ntool: [Tx(2)]\n"
    )
    bodies = read_matlab(export(robot, "matlab").text).bodies
    assert [body.joint for body in bodies] == ["to_tool", "fixed3", "fixed3_", "to_tool_"]


@each_table
def test_matlab_has_the_pose_of_the_table(table: Path) -> None:
    tree = read_matlab(export(load(table), "matlab").text)
    check(tree.pose, read_arm_file(table), TABLES.index(table))


@pytest.mark.parametrize("convention", BOTH)
def test_matlab_of_offsets_signs_and_fixed_rows(convention: str) -> None:
    robot, arm = crooked(convention)
    tree = read_matlab(export(robot, "matlab").text)
    check(tree.pose, arm, 4)
    assert [body.joint for body in tree.bodies if body.type != "fixed"] == [
        name for name, _ in arm.variables
    ]
    assert tree.bodies[-1].name == "tool"
    limits = {body.joint: body.limits for body in tree.bodies if body.limits}
    assert limits["q2"] == (-0.1, 0.3)
    assert limits["q1"] == (pytest.approx(-100 * np.pi / 180, abs=1e-15), 2.0)


@each_table
def test_rtb_has_the_pose_of_the_table(table: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    robot = load(table)
    build = run_rtb(export(robot, "rtb").text, monkeypatch)
    check(build.pose, read_arm_file(table), TABLES.index(table))


@pytest.mark.parametrize("convention", BOTH)
def test_rtb_of_offsets_and_signs(convention: str, monkeypatch: pytest.MonkeyPatch) -> None:
    robot, arm = crooked(convention, MOVING)
    built = run_rtb(export(robot, "rtb").text, monkeypatch)
    check(built.pose, arm, 5)
    assert built.links[0].qlim == [pytest.approx(-100 * np.pi / 180, abs=1e-15), 2.0]


@pytest.mark.parametrize("convention", BOTH)
def test_rtb_takes_outer_fixed_rows_into_base_and_tool(
    convention: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    fixed = "  - {theta: 10 deg, d: 35, a: 5, alpha: 45 deg, type: fixed}\n"
    text = (
        f"name: outer\nconvention: {convention}\nunits: {{angle: deg, length: mm}}\n"
        f"joints:\n{fixed}"
        f"  - {{theta: q1, d: 1, a: 2, alpha: 90 deg}}\n{fixed}base: [Rz(5 deg)]\n"
    )
    built = run_rtb(export(symdh.loads(text), "rtb").text, monkeypatch)
    check(built.pose, read_arm(text), 6)


def test_rtb_says_that_it_has_no_fixed_link() -> None:
    with pytest.raises(UnsupportedError, match="row 3 is fixed and stands between two joints"):
        export(crooked("standard")[0], "rtb")


def test_rtb_wants_a_joint_that_moves() -> None:
    still = symdh.loads(
        "name: post\nconvention: standard\njoints: [{theta: 0, d: 1, a: 0, alpha: 0}]\n"
    )
    with pytest.raises(UnsupportedError, match=r"^no joint of post moves: there is no DHRobot"):
        export(still, "rtb")


@pytest.mark.parametrize("name", ["pi", "np", "end", "DHRobot", "robot", "numpy"])
def test_names_that_a_language_has_itself(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (
        "name: NAME\nconvention: standard\nunits: {length: m}\n"
        "joints:\n  - {theta: q1, d: 0, a: 1, alpha: 90 deg}\ntool: [Ty(1)]\n"
    )
    robot = symdh.loads(text.replace("NAME", name))
    check(run_rtb(export(robot, "rtb").text, monkeypatch).pose, read_arm(text), 7)
    function = re.search(r"function robot = (\w+)\(\)", export(robot, "matlab").text)
    assert function is not None
    assert function[1] not in ("pi", "end", "robot")


@pytest.mark.parametrize("form", ["urdf", "rtb", "matlab"])
def test_what_a_format_of_numbers_cannot_hold(form: str) -> None:
    double = symdh.loads("convention: standard\njoints: [{theta: 2*q1, d: 0, a: 1, alpha: 0}]\n")
    with pytest.raises(UnsupportedError, match="joint 1 moves 2 times its variable q1"):
        export(double, form)
    open_length = symdh.loads(
        "convention: standard\njoints: [{theta: q1, d: 0, a: a1, alpha: 0}]\n"
    )
    with pytest.raises(UnsupportedError, match="a1 has no value"):
        export(open_length, form)
    root = symdh.loads("convention: standard\njoints: [{theta: q1, d: 0, a: sqrt(a1), alpha: 0}]\n")
    (a1,) = root.parameters
    with pytest.raises(UnsupportedError, match="not a real number"):
        export(replace(root, values={a1: Integer(-1)}), form)


def test_there_is_no_other_format() -> None:
    with pytest.raises(UnsupportedError, match="yaml, json, csv"):
        export(load(TABLES[0]), "xml")


# -- reading MATLAB and the Robotics Toolbox as their manuals define them --------------------------


@dataclass
class Body:
    name: str
    joint: str
    type: str
    parent: str = ""
    limits: tuple[float, ...] | None = None
    before: np.ndarray = field(default_factory=lambda: np.eye(4))
    after: np.ndarray = field(default_factory=lambda: np.eye(4))


@dataclass
class Tree:
    bodies: list[Body]

    def pose(self, q: np.ndarray) -> np.ndarray:
        """Poses of the last body: parent to joint, the joint about or along z, joint to body."""
        pose = np.broadcast_to(np.eye(4, dtype=np.longdouble), (*q.shape[:-1], 4, 4))
        place = 0
        parent = "base"
        for body in self.bodies:
            assert body.parent == parent
            parent = body.name
            pose = pose @ body.before
            if body.type != "fixed":
                kind = "Rz" if body.type == "revolute" else "Tz"
                pose = pose @ elementary(kind, q[..., place], q.shape[:-1], EXTENDED)
                place += 1
            pose = pose @ body.after
        return pose


def numbers_of(text: str) -> list[float]:
    return [_number(word) for word in text.split()]


def _number(word: str) -> float:
    match = re.fullmatch(r"(-?)(?:(\d+)\*)?pi(?:/(\d+))?", word)
    if match is None:
        return float(word)
    sign = -1 if match[1] else 1
    return sign * int(match[2] or 1) * np.pi / int(match[3] or 1)


def read_matlab(text: str) -> Tree:
    """Read the statements one by one; whatever is none of them fails."""
    lines = [line for line in text.splitlines() if line and not line.startswith("%")]
    assert re.fullmatch(r"function robot = \w+\(\)", lines.pop(0))
    assert lines.pop(0) == 'robot = rigidBodyTree("DataFormat", "row");'
    assert lines.pop() == "end"
    bodies: list[Body] = []
    name = ""
    for line in lines:
        if match := re.fullmatch(r'body = rigidBody\("(\w+)"\);', line):
            name = match[1]
        elif match := re.fullmatch(r'joint = rigidBodyJoint\("(\w+)", "(\w+)"\);', line):
            bodies.append(Body(name, match[1], match[2]))
        elif match := re.fullmatch(
            r'setFixedTransform\(joint, \[([^\]]*)\](?:, "(\w+)")?\);', line
        ):
            set_fixed_transform(bodies[-1], match[1], match[2])
        elif match := re.fullmatch(r"joint\.PositionLimits = \[(.*)\];", line):
            bodies[-1].limits = tuple(numbers_of(match[1]))
        elif match := re.fullmatch(r'addBody\(robot, body, "(\w+)"\);', line):
            bodies[-1].parent = match[1]
        else:
            assert line == "body.Joint = joint;"
    assert len({body.name for body in bodies}) == len(bodies)
    assert len({body.joint for body in bodies}) == len(bodies)
    return Tree(bodies)


def set_fixed_transform(body: Body, numbers: str, notation: str | None) -> None:
    """MathWorks' manual: a revolute joint ignores theta, a prismatic one d."""
    if notation is None:
        body.before = np.array([numbers_of(row) for row in numbers.split(";")])
        return
    a, alpha, d, theta = numbers_of(numbers)
    theta = 0.0 if body.type == "revolute" else theta
    d = 0.0 + d if body.type != "prismatic" else 0.0
    words = {"Rz": theta, "Tz": d, "Tx": a, "Rx": alpha}
    order = ("Rz", "Tz", "Tx", "Rx") if notation == "dh" else ("Rx", "Tx", "Rz", "Tz")
    product = elementary("Tx", 0.0, (), EXTENDED)
    for kind in order:
        product = product @ elementary(kind, np.longdouble(words[kind]), (), EXTENDED)
    if notation == "dh":
        body.after = product
    else:
        body.before = product


@dataclass
class Link:
    """A link of the Robotics Toolbox: q is turned round by flip, then the offset is added."""

    modified: bool
    prismatic: bool
    d: float = 0.0
    a: float = 0.0
    alpha: float = 0.0
    theta: float = 0.0
    offset: float = 0.0
    flip: bool = False
    qlim: list[float] | None = None

    def A(self, q: np.ndarray) -> np.ndarray:
        q = (-q if self.flip else q) + self.offset
        theta, d = (self.theta, q) if self.prismatic else (q, self.d)
        words = {"Rz": theta, "Tz": d, "Tx": self.a, "Rx": self.alpha}
        order = ("Rx", "Tx", "Rz", "Tz") if self.modified else ("Rz", "Tz", "Tx", "Rx")
        product = elementary("Tx", 0.0, np.shape(q), EXTENDED)
        for kind in order:
            product = product @ elementary(kind, words[kind], np.shape(q), EXTENDED)
        return product


class FakeDHRobot:
    def __init__(self, links: Sequence[Link], name: str) -> None:
        self.links, self.name = links, name
        self.base = self.tool = np.eye(4)

    def pose(self, q: np.ndarray) -> np.ndarray:
        pose = np.broadcast_to(self.base, (*q.shape[:-1], 4, 4))
        for place, link in enumerate(self.links):
            pose = pose @ link.A(q[..., place])
        return pose @ self.tool


def run_rtb(source: str, monkeypatch: pytest.MonkeyPatch) -> FakeDHRobot:
    """Import the source with stand-ins for the toolbox, and build the robot."""
    toolbox: Any = types.ModuleType("roboticstoolbox")
    toolbox.DHRobot = FakeDHRobot
    for convention, modified in (("DH", False), ("MDH", True)):
        for kind in ("Revolute", "Prismatic"):
            made = functools.partial(Link, modified, kind == "Prismatic")
            setattr(toolbox, kind + convention, made)
    spatial: Any = types.ModuleType("spatialmath")
    spatial.SE3 = lambda matrix: matrix
    monkeypatch.setitem(sys.modules, "roboticstoolbox", toolbox)
    monkeypatch.setitem(sys.modules, "spatialmath", spatial)
    scope: dict[str, Any] = {}
    exec(compile(source, "rtb.py", "exec"), scope)
    (function,) = re.findall(r"^def (\w+)\(\):", source, re.MULTILINE)
    built = scope[function]()
    assert isinstance(built, FakeDHRobot)
    return built


# -- the command -----------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.yaml").write_text(MOVING.format(convention="standard"))
    return tmp_path


def test_every_format_by_the_command(folder: Path, capsys: Capture) -> None:
    robot = symdh.load("arm.yaml")
    for form in FORMATS:
        assert run(["convert", "arm.yaml", "--to", form.name]) == 0
        shown = capsys.readouterr()
        exported = form.write(robot)
        assert shown.out == exported.text
        assert shown.err == "".join(f"note: {note}\n" for note in exported.notes)


def test_markdown_may_begin_with_a_tag_as_urdf_does(folder: Path, capsys: Capture) -> None:
    rows = "| theta_i | d_i | a_i | alpha_i |\n|---|---|---|---|\n| q1 | 0 | 2 | 0 |\n"
    Path("notes.md").write_text(f"<!-- convention: standard -->\n\n{rows}")
    assert run(["convert", "notes.md", "--to", "csv"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "q1,0,2,0"


def test_a_file_is_written_and_kept(folder: Path, capsys: Capture) -> None:
    command = ["convert", "arm.yaml", "--to", "modified", "-o", "craig.yaml"]
    assert run(command) == 0
    assert capsys.readouterr().err.startswith("wrote craig.yaml")
    assert symdh.load("craig.yaml") == symdh.Robot.of(
        convert(symdh.load("arm.yaml"), Convention.MODIFIED)
    )
    assert run(command) == 0
    assert "(unchanged)" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "status", "says"),
    [
        (["arm.yaml"], 2, "--to"),
        (["arm.yaml", "--to", "modified", "--chain", "a", "b"], 2, "--chain needs a URDF file"),
        (["arm.yaml", "--to", "dxf"], 2, "'dxf'"),
        (["none.yaml", "--to", "csv"], 3, "no such file"),
        (["bad.yaml", "--to", "csv"], 2, "bad.yaml:1:1"),
        (["open.yaml", "--to", "urdf"], 2, "a1 has no value"),
        (["arm.yaml", "--to", "csv", "--tolerance", "-1"], 2, "--tolerance"),
    ],
)
def test_nothing_is_written_on_an_error(
    arguments: list[str], status: int, says: str, folder: Path, capsys: Capture
) -> None:
    Path("bad.yaml").write_text("nonsense: 1\n")
    Path("open.yaml").write_text(
        "convention: standard\njoints: [{theta: q1, d: 0, a: a1, alpha: 0}]\n"
    )
    before = {path.name for path in folder.iterdir()}
    assert run(["convert", *arguments, "-o", "out.txt"]) == status
    shown = capsys.readouterr()
    assert says in shown.err
    assert shown.out == ""
    assert {path.name for path in folder.iterdir()} == before


def test_the_same_bytes_whatever_the_hash_seed(folder: Path) -> None:
    script = (
        "import sys; from symdh.cli.main import run\n"
        f"for name in {[form.name for form in FORMATS]!r}:\n"
        "    assert run(['convert', 'arm.yaml', '--to', name]) == 0"
    )
    outputs = {
        subprocess.run(
            [sys.executable, "-c", script],
            cwd=folder,
            env={"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(outputs) == 1
