"""URDF into tables: what is read, what is refused and where, and that the pose is the same."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from oracle import read_arm, read_arm_file
from sympy import Rational, pi, sqrt
from urdf_fk import Chain, read_chain

import symdh
from symdh.cli.main import run
from symdh.errors import TableError
from symdh.frames.residual import residual
from symdh.frames.urdf_chain import table_of_chain
from symdh.render.interchange import FORMATS, export
from symdh.render.table_yaml import table_yaml
from symdh.robot import Convention, Robot
from symdh.table.source import from_text
from symdh.table.urdf import UrdfChain, read_urdf_chain
from symdh.table.xml_nodes import MAX_DEPTH, parse_xml

DATA = Path(__file__).parent / "data"
TABLES = sorted((DATA / "tables").glob("*.yaml"))
POSES = 100
NEAR = Rational(1, 100_000)
BOTH = tuple(Convention)
Capture = pytest.CaptureFixture[str]

both = pytest.mark.parametrize("convention", BOTH, ids=lambda convention: convention.value)

TWO = """\
<robot name="two">
  <link name="base"/> <link name="arm"/> <link name="hand"/>
  <joint name="one" type="continuous">
    <parent link="base"/> <child link="arm"/>
    <origin xyz="0 0 1" rpy="0 0 0"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="two" type="revolute">
    <parent link="arm"/> <child link="hand"/>
    <origin xyz="0.5 0 0" rpy="1.5708 0 0"/> <axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="0" velocity="0"/>
  </joint>
</robot>
"""
SECOND_AXIS = '1.5708 0 0"/> <axis xyz="0 0 1"/>'


def chain_of(text: str, ends: tuple[str, str] | None = None, near: Rational = NEAR) -> UrdfChain:
    return read_urdf_chain(from_text(text, "arm.urdf"), ends, near)


def imported(
    text: str, convention: Convention, ends: tuple[str, str] | None = None, near: Rational = NEAR
) -> Robot:
    return table_of_chain(chain_of(text, ends, near), convention, near).robot


def differences(robot: Robot, chain: Chain, seed: int = 0) -> tuple[float, float]:
    """Largest difference of positions and of rotation entries over 100 poses."""
    arm = read_arm(table_yaml(robot))
    assert arm.length == "m"
    q = chain.seeded_poses(POSES, seed)
    there = arm.pose({name: q[:, k] for k, (name, _) in enumerate(arm.variables)})
    difference = np.abs(there - chain.pose(q))
    return float(difference[:, :3, 3].max()), float(difference[:, :3, :3].max())


# -- the same pose ---------------------------------------------------------------------------------

#: File, ends, and by how much the decimals of the file miss what they stand for.
FILES = [
    ("six_axis.urdf", ("world", "tool0"), 1e-5),
    ("six_axis.urdf", ("base_link", "forearm"), 1e-11),
    ("six_axis.urdf", ("shoulder", "wrist_1"), 1.2e-5),
    ("slider_crooked.urdf", ("a", "e"), 2e-5),
    ("slider_crooked.urdf", ("a", "c"), 1e-14),
    ("two_hands.urdf", ("body", "finger_1"), 1e-14),
    ("two_hands.urdf", ("body", "left_hand"), 1e-14),
]


@both
@pytest.mark.parametrize(("name", "ends", "within"), FILES)
def test_the_pose_is_that_of_the_file(
    name: str, ends: tuple[str, str], within: float, convention: Convention
) -> None:
    text = (DATA / "urdf" / name).read_text()
    robot = imported(text, convention, ends)
    assert robot.convention is convention
    assert not robot.parameters
    chain = read_chain(text, *ends)
    position, turn = differences(robot, chain)
    assert position <= within
    assert turn <= within


@both
@pytest.mark.parametrize("near", [NEAR, Rational(0)], ids=["near", "at_its_word"])
@pytest.mark.parametrize("seed", range(12))
def test_random_chains(seed: int, near: Rational, convention: Convention) -> None:
    text = random_urdf(np.random.default_rng(seed))
    robot = imported(text, convention, ("l0", "l8"), near)
    position, turn = differences(robot, read_chain(text, "l0", "l8"), seed)
    assert max(position, turn) < 1e-11


def random_urdf(rng: np.random.Generator) -> str:
    """Eight joints, most at right angles, some crooked, some fixed, along any of their axes."""
    joints = []
    for i in range(8):
        kind = rng.choice(["revolute", "continuous", "prismatic", "fixed"], p=[0.3, 0.3, 0.2, 0.2])
        kind = "continuous" if i in (0, 5) else kind
        quarters = [0.0, 1.5707963267948966, -1.5707963267948966, 3.141592653589793]
        rpy = rng.choice(quarters, 3) if rng.random() < 0.7 else np.round(rng.uniform(-3, 3, 3), 3)
        xyz = np.round(rng.choice([0, 1], 3) * rng.uniform(-1, 1, 3), 4)
        axis = rng.permutation([rng.choice([-1, 1]), 0, 0])
        joints.append(
            f'<joint name="j{i}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/>'
            f'<origin xyz="{_words(xyz)}" rpy="{_words(rpy)}"/><axis xyz="{_words(axis)}"/>'
            '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        )
    links = "".join(f'<link name="l{i}"/>' for i in range(9))
    return f'<robot name="random">{links}{"".join(joints)}</robot>'


def _words(numbers: np.ndarray) -> str:
    return " ".join(repr(float(number)) for number in numbers)


@both
@pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)
def test_a_table_comes_back_from_its_own_urdf(table: Path, convention: Convention) -> None:
    arm = read_arm_file(table)
    robot = imported(export(symdh.load(table), "urdf").text, convention)
    back = read_arm(table_yaml(robot))
    q = arm.seeded_poses(POSES, seed=TABLES.index(table))
    expected = arm.pose({name: q[:, k] for k, (name, _) in enumerate(arm.variables)})
    there = back.pose({name: q[:, k] for k, (name, _) in enumerate(back.variables)})
    assert np.abs(there - expected).max() <= 8 * arm.tolerance()


def test_the_table_that_a_plain_arm_gives() -> None:
    table = yaml.safe_load(table_yaml(imported(TWO, Convention.MODIFIED)))
    assert table["name"] == "two"
    assert table["units"] == {"angle": "deg", "length": "m"}
    assert [(row["theta"], row["alpha"], row["a"]) for row in table["joints"]] == [
        ("theta1", 0, 0),
        ("theta2", "90 deg", 0.5),
    ]
    assert table["limits"] == {"theta2": ["-1 rad", "2 rad"]}


def test_fifty_joints_and_no_more() -> None:
    def text(count: int) -> str:
        links = "".join(f'<link name="l{i}"/>' for i in range(count + 1))
        joints = "".join(
            f'<joint name="j{i}" type="continuous"><parent link="l{i}"/><child link="l{i + 1}"/>'
            f'<origin xyz="0.1 0 0.2" rpy="{1.5707963267948966 * (i % 2)} 0 0"/>'
            '<axis xyz="0 0 1"/></joint>'
            for i in range(count)
        )
        return f'<robot name="snake">{links}{joints}</robot>'

    position, turn = differences(
        imported(text(50), Convention.STANDARD), read_chain(text(50), "l0", "l50")
    )
    assert max(position, turn) < 1e-12
    with pytest.raises(TableError, match="51 moving joints, over 50"):
        chain_of(text(51))


# -- what decimals stand for -----------------------------------------------------------------------


def test_decimals_near_a_multiple_of_15_degrees_are_that() -> None:
    chain = chain_of(TWO)
    (snap,) = chain.snaps
    assert (snap.written, snap.value, snap.count) == ("1.5708", pi / 2, 1)
    assert snap.change == pytest.approx(1.5708 - np.pi / 2, rel=1e-9)
    assert chain.joints[1].meant.rpy[0] == pi / 2
    assert chain.joints[1].written.rpy[0] == Rational("1.5708")


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("0.5236", pi / 6),
        ("-2.0944", -2 * pi / 3),
        ("0.2618", pi / 12),
        ("6.2831853", 2 * pi),
        ("-4.6e-16", 0),
        ("1.2e-300", 0),
        ("+3.14159", pi),
        ("-12.566371", -4 * pi),
        ("12.828170", Rational("12.828170")),  # 15 degrees over two turns
        ("1.57", Rational("1.57")),
        ("0.0001", Rational("0.0001")),
        (".5", Rational("0.5")),
        ("1e1", 10),
    ],
)
def test_what_an_angle_stands_for(written: str, meant: Any) -> None:
    chain = chain_of(TWO.replace("1.5708", written))
    assert chain.joints[1].meant.rpy[0] == meant
    assert bool(chain.snaps) == (meant != Rational(written))


@pytest.mark.parametrize(
    ("limit", "limits", "warning"),
    [
        ('lower="-1" upper="2"', (-1, 2), ""),
        ('lower="-1.5708" upper="100"', (-pi / 2, 100), ""),
        ('lower="2" upper="-1"', None, "10:5: lower limit is above upper limit; left out"),
        ('lower="2" upper="2"', None, ""),
    ],
)
def test_limits(limit: str, limits: tuple[Any, Any] | None, warning: str) -> None:
    chain = chain_of(TWO.replace('lower="-1" upper="2"', limit))
    found = chain.joints[1].limits
    assert (found and (found.lower, found.upper)) == limits
    said = [f"{w.line}:{w.column}: {w.message}" for w in chain.warnings]
    assert said == ([warning] if warning else [])


def test_the_tolerance_is_the_users() -> None:
    assert chain_of(TWO, near=Rational(0)).joints[1].meant.rpy[0] == Rational("1.5708")
    assert chain_of(TWO, near=Rational(0)).snaps == ()
    wide = chain_of(TWO.replace("1.5708", "1.57"), near=Rational(1, 1000))
    assert wide.joints[1].meant.rpy[0] == pi / 2


@pytest.mark.parametrize(("near", "most"), [(NEAR, 1e-5), (Rational(0), 1e-11)])
def test_the_residual_is_the_difference_that_is_there(near: Rational, most: float) -> None:
    text = (DATA / "urdf" / "six_axis.urdf").read_text()
    chain = chain_of(text, ("world", "tool0"), near)
    robot = table_of_chain(chain, Convention.STANDARD, near).robot
    found = residual(chain, robot)
    position, turn = differences(robot, read_chain(text, "world", "tool0"))
    assert found.poses == POSES
    assert found.position <= 2 * most
    assert found.rotation <= 2 * most
    if near:  # of other poses than those here, so alike but not the same
        assert 0.3 < found.position / position < 3
        assert 0.3 < found.rotation / turn < 3


def test_a_residual_that_is_there_is_seen() -> None:
    chain = chain_of(TWO)
    wrong = imported(TWO.replace("0.5 0 0", "0.503 0 0"), Convention.STANDARD)
    assert residual(chain, wrong).position == pytest.approx(0.003, rel=1e-2)
    turned = imported(TWO.replace("1.5708", "1.6"), Convention.STANDARD)
    assert residual(chain, turned).rotation == pytest.approx(0.0292, rel=1e-2)


@pytest.mark.parametrize(
    ("axis", "length"),
    [
        ("0.70711 0 0.70711", ""),
        ("0.577 -0.577 0.577", "0.999393"),
        ("0.6001 0 0.8", "1.00006"),
        ("0.600001 0 0.8", ""),
    ],
)
def test_an_axis_with_few_digits_is_made_a_unit_vector(axis: str, length: str) -> None:
    text = TWO.replace(SECOND_AXIS, f'0 0 0"/> <axis xyz="{axis}"/>')
    chain = chain_of(text)
    assert sum(entry**2 for entry in chain.joints[1].meant.axis) == 1
    assert [warning.message for warning in chain.warnings] == (
        [f"the axis has length {length}; read as a unit vector"] if length else []
    )
    robot = imported(text, Convention.STANDARD)
    assert max(differences(robot, read_chain(text, "base", "hand"))) < 1e-14


def test_an_axis_between_the_coordinate_axes_is_exact() -> None:
    """Its squares are 1/3 and 2/3."""
    chain = chain_of(TWO.replace(SECOND_AXIS, '0 0 0"/> <axis xyz="0.57735 0 -0.81650"/>'))
    assert chain.joints[1].meant.axis == (sqrt(3) / 3, 0, -sqrt(6) / 3)


def test_an_axis_that_no_simple_fractions_fit_keeps_its_direction() -> None:
    # The squares nearest to 0.0064, 0.0841 and 0.9095 with denominators up to 12 are 0, 1/12 and
    # 10/11, which do not add up to 1.
    chain = chain_of(TWO.replace(SECOND_AXIS, '0 0 0"/> <axis xyz="0.08 0.29 0.9537"/>'))
    x, y, z = chain.joints[1].meant.axis
    assert x**2 + y**2 + z**2 == 1
    assert (x / z, y / z) == (Rational(800, 9537), Rational(2900, 9537))


def test_nearly_parallel_axes_are_parallel_and_that_is_said(
    tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(TWO.replace("1.5708 0 0", "0.000002 0 0"))
    assert run(["convert", str(path)]) == 0
    shown = capsys.readouterr()
    assert yaml.safe_load(shown.out)["joints"][0]["alpha"] == 0
    assert "read 0.000002 as 0" in shown.err
    # An axis vector has no angle to read as zero; its direction is near that of the other axis.
    path.write_text(TWO.replace(SECOND_AXIS, '0 0 0"/> <axis xyz="0 2e-6 1"/>'))
    assert run(["convert", str(path)]) == 0
    shown = capsys.readouterr()
    assert yaml.safe_load(shown.out)["joints"][0]["alpha"] == 0
    assert "axis 2: parallel to axis 1 within the tolerance, off by 2.0e-06 rad" in shown.err


# -- what is refused -------------------------------------------------------------------------------

LINKS = '<link name="base"/> <link name="arm"/> <link name="hand"/>'
LOOP = '<joint name="back" type="fixed"><parent link="hand"/><child link="base"/></joint></robot>'
SECOND = '<joint name="more" type="fixed"><parent link="base"/><child link="hand"/></joint></robot>'
BRANCH = (
    '<link name="eye"/><joint name="neck" type="fixed"><parent link="arm"/><child link="eye"/>'
    "</joint></robot>"
)

#: What is replaced in TWO by what, and the start of the message with its line and column.
BAD = [
    ("</robot>", LOOP, "4:40: the joints from link arm lead back to it: a closed chain"),
    ("</robot>", SECOND, "12:67: link hand is carried by joint two already: a closed chain"),
    ("</robot>", BRANCH, "7:3: the robot branches at link arm; name the chain: --chain base TIP"),
    ('type="revolute"', 'type="floating"', "7:27: a floating joint cannot be in a serial arm"),
    ('type="revolute"', 'type="planar"', "7:27: a planar joint cannot be in a serial arm"),
    ('type="revolute"', 'type="revolut"', "7:27: type revolut unknown; did you mean revolute?"),
    ('type="revolute"', 'type="ball"', "7:27: type ball unknown; use revolute, continuous"),
    ('type="revolute"', "", '7:3: <joint> needs type="…"'),
    ('effort="0"', 'effort="0"/><mimic joint="one"', "10:45: this joint follows one;"),
    ('<link name="hand"/>', "", "8:39: there is no link hand"),
    (
        '<child link="hand"/>',
        '<child link="hnad"/>',
        "8:39: there is no link hnad; did you mean hand?",
    ),
    ('<child link="hand"/>', "", "7:3: joint has no <child>"),
    ('<parent link="arm"/>', "<parent/>", '8:5: <parent> needs link="…"'),
    ('name="hand"/>', 'name="arm"/>', "2:54: link arm is there already"),
    ('name="two" type', 'name="one" type', "7:16: joint one is there already"),
    (LINKS, "", "1:1: the robot has no links"),
    ('<link name="hand"/>', "<link/>", '2:42: <link> needs name="…"'),
    (LINKS, f'{LINKS} <link name="table"/>', "2:62: link table hangs on nothing, like base;"),
    (TWO, " \n", "1:1: file is empty"),
    (TWO, TWO.replace("continuous", "fixed").replace("revolute", "fixed"), "1:1: no joint of the"),
    (SECOND_AXIS, '0 0 0"/> <axis xyz="0 0 2"/>', "9:52: the axis has length 2, and a unit vector"),
    (SECOND_AXIS, '0 0 0"/> <axis xyz="0 1 1"/>', "9:52: the axis has length 1.41421"),
    (SECOND_AXIS, '0 0 0"/> <axis xyz="0 0 0"/>', "9:52: the axis is zero and has no direction"),
    ("0.5 0 0", "0.5 NaN 0", "9:22: NaN is not a number"),
    ("0.5 0 0", "0.5 0 inf", "9:24: inf is not a number"),
    ("0.5 0 0", "0.5 0", "9:18: three numbers are wanted here, not 2"),
    ("0.5 0 0", "0,5 0 0", "9:18: 0,5 is not a number"),
    ("0.5 0 0", "0x5 0 0", "9:18: 0x5 is not a number"),
    ("0.5 0 0", "1e99 0 0", "9:18: decimal exponent is not between"),
    ("0.5 0 0", "0." + "1" * 50 + " 0 0", "9:18: number has 52 characters, over 40"),
    ("0.5 0 0", "${l1} 0 0", "9:18: this is xacro; turn the file into URDF first"),
    ('lower="-1"', 'lower="one"', "10:19: one is not a number"),
    ("<robot name", "<sdf name", "12:3: this end tag does not close"),
    ("</robot>", "", "13:1: the file ends before the last tag is closed"),
    ("<robot", "<!DOCTYPE robot>\n<robot", "1:1: a DOCTYPE is not allowed"),
    (LINKS, '<xacro:property name="a"/>', "2:3: this is a xacro file"),
]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("old", "new", "message"), BAD)
def test_what_is_wrong_is_said_at_its_place(
    old: str, new: str, message: str, folder: Path, capsys: Capture
) -> None:
    assert old in TWO
    Path("arm.urdf").write_text(TWO.replace(old, new))
    status = run(["convert", "arm.urdf", "-o", "arm.yaml"])
    shown = capsys.readouterr()
    assert shown.out == ""
    assert status == 2
    assert shown.err.startswith(f"arm.urdf:{message}"), shown.err
    assert [path.name for path in folder.iterdir()] == ["arm.urdf"]


def test_all_mistakes_at_once(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(TWO.replace("0 0 1", "0 0 x").replace("revolute", "floating"))
    assert run(["convert", str(path)]) == 2
    assert "4 errors" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("ends", "message"),
    [
        (
            ("base", "hnad"),
            "1:1: the robot has no link hnad that --chain names; did you mean",
        ),
        (("x", "y"), "1:1: the robot has no link x that --chain names; it has base, arm, hand"),
        (("hand", "base"), "2:3: link base carries hand; write --chain base hand"),
        (("arm", "arm"), "1:1: --chain names one link twice"),
    ],
)
def test_ends_that_no_chain_joins(ends: tuple[str, str], message: str) -> None:
    with pytest.raises(TableError) as caught:
        chain_of(TWO, ends)
    assert str(caught.value).startswith(f"arm.urdf:{message}")


@pytest.mark.parametrize(
    ("ends", "message"),
    [
        (("body", "finger_2"), "32:5: this joint follows grip;"),
        (("body", "right"), "21:43: the axis has length 0.5"),
        (("right", "ball"), "34:29: a floating joint cannot be in a serial arm"),
        (("left", "right"), r"7:3: no chain leads from link left up to link right"),
        (None, r"11:3: the robot branches at link body; name the chain: --chain body TIP"),
    ],
)
def test_only_the_chain_has_to_be_one(ends: tuple[str, str] | None, message: str) -> None:
    text = (DATA / "urdf" / "two_hands.urdf").read_text()
    with pytest.raises(TableError) as caught:
        chain_of(text, ends)
    assert re.match(f"arm.urdf:{message}", str(caught.value)), str(caught.value)


def test_nothing_is_expanded_and_nothing_is_fetched(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("treasure")
    bombs = [
        '<!DOCTYPE robot [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]><robot name="&b;"/>',
        f'<!DOCTYPE robot [<!ENTITY a SYSTEM "file://{secret}">]><robot name="x">&a;</robot>',
        f'<!DOCTYPE robot SYSTEM "file://{secret}"><robot name="x"/>',
        '<!DOCTYPE robot [<!ENTITY % p "<!ENTITY a \'x\'>"> %p;]><robot name="x">&a;</robot>',
    ]
    for bomb in bombs:
        with pytest.raises(TableError, match="a DOCTYPE is not allowed") as caught:
            chain_of(bomb)
        assert "treasure" not in str(caught.value)
    with pytest.raises(TableError, match="an entity that XML does not have"):
        chain_of('<robot name="&a;"/>')


def test_depth_is_limited() -> None:
    with pytest.raises(TableError, match=f"nested deeper than {MAX_DEPTH} levels"):
        parse_xml(from_text("<a>" * 200_000, "deep.urdf"))


def test_text_between_elements_is_no_attribute() -> None:
    root = parse_xml(from_text('<robot name="two">ame="body" <link name="base"/></robot>', "x"))
    assert set(root.attributes) == {"name"}
    assert [link.attributes["name"].text for link in root.all("link")] == ["base"]


def test_places_of_attributes_whatever_stands_around_them() -> None:
    text = '<r\n  a = "1"\n\tb=\'x > y\'  ü="𝔘 &lt; 2"\n><é c="3"/></r>'
    root = parse_xml(from_text(text, "r.urdf"))
    assert {name: value.text for name, value in root.attributes.items()} == {
        "a": "1",
        "b": "x > y",
        "ü": "𝔘 < 2",
    }
    lines = text.split("\n")
    for name, value in root.attributes.items():
        place = value.place()
        start = lines[place.line - 1][place.column - 1 :]
        assert start.startswith(value.text.replace("<", "&lt;")), name
    (child,) = root.children
    assert (child.place().line, child.place().column) == (4, 2)
    assert child.attributes["c"].place().column == 8


# -- the command -----------------------------------------------------------------------------------


def test_the_command_prints_the_table_and_what_it_cost(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(TWO)
    assert run(["convert", str(path), "--chain", "base", "hand"]) == 0
    shown = capsys.readouterr()
    assert symdh.loads(shown.out) == symdh.Robot.of(imported(TWO, Convention.STANDARD))
    assert "theta1 is one, theta2 is two" in shown.out
    assert "note: read 1.5708 as pi/2; off by 3.7e-06 at most" in shown.err
    assert re.search(r"residual, the largest of 100 poses: \S+e[-+]\d\d m, 3\.7e-06 rad", shown.err)


@pytest.mark.parametrize("form", [each.name for each in FORMATS if each.name != "yaml"])
def test_urdf_straight_into_another_format(form: str, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(TWO)
    assert run(["convert", str(path), "--to", form]) == 0
    assert capsys.readouterr().out == export(imported(TWO, Convention.STANDARD), form).text


def test_urdf_comes_from_standard_input(run_symdh: Any) -> None:
    ran = run_symdh("convert", "-", "--to", "modified", input=TWO)
    assert ran.returncode == 0
    assert symdh.loads(ran.stdout) == symdh.Robot.of(imported(TWO, Convention.MODIFIED))
    assert ran.stderr.count("\n") == 2


def test_a_table_that_is_no_table_and_a_robot_that_is_no_robot(run_symdh: Any) -> None:
    ran = run_symdh("convert", "-", input="<html><body/></html>")
    assert ran.returncode == 2
    assert "<stdin>:1:1: root element is <html>; a URDF file starts with <robot>" in ran.stderr


def test_the_same_bytes_whatever_the_hash_seed() -> None:
    path = DATA / "urdf" / "six_axis.urdf"
    script = "import sys; from symdh.cli.main import run; sys.exit(run(sys.argv[1:]))"
    outputs = set()
    for seed in ("1", "2"):
        ran = subprocess.run(
            [sys.executable, "-c", script, "convert", str(path)],
            env={"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        )
        outputs.add((ran.stdout, ran.stderr))
    assert len(outputs) == 1


@pytest.mark.parametrize("joints", [15, 16])
def test_of_a_long_chain_the_work_is_announced(
    joints: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """From sixteen joints on it can take more than two seconds."""
    links = "".join(f'<link name="l{k}"/>' for k in range(joints + 1))
    between = "".join(
        f'<joint name="j{k}" type="revolute"><parent link="l{k}"/><child link="l{k + 1}"/>'
        f'<origin xyz="1 0 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>'
        for k in range(joints)
    )
    path = tmp_path / "arm.urdf"
    path.write_text(f'<robot name="arm">{links}{between}</robot>')
    assert run(["convert", str(path)]) == 0
    said = capsys.readouterr().err
    assert ("assigning frames to 16 joints ..." in said) == (joints == 16)
