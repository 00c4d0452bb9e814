"""Task vectors and their derivatives, against the oracle's poses in 50 digits."""

from __future__ import annotations

import json
import math
import subprocess
from functools import cache
from itertools import permutations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from evaluate import MP, number, value_of
from oracle import FIFTY_DIGITS, Arm, elementary, read_arm, read_arm_file

from symdh.cli.main import run
from symdh.derivation.task import task_document
from symdh.errors import UnsupportedError
from symdh.kinematics.rotation import Atan2, named_sequence
from symdh.kinematics.task import (
    AnalyticJacobian,
    Choice,
    Coordinate,
    EulerAngle,
    Heading,
    analytic_jacobian,
    task_numbers,
    task_vector,
)
from symdh.render.terminal import render_chapters
from symdh.robot import Robot
from symdh.table import load_table, loads_table, parse_expression
from tools import require_tool

ROOT = Path(__file__).parent.parent
TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
BY_NAME = {path.stem: path for path in TABLES}
SEQUENCES = sorted(
    {*("".join(p) for p in permutations("xyz", 3))} | {a + b + a for a, b in permutations("xyz", 2)}
)
POSES = 4
#: Step of central differences in 50 digits: their error is about its square.
STEP = MP.mpf("1e-16")
Capture = pytest.CaptureFixture[str]
Point = dict[str, Any]


@cache
def robot_of(name: str) -> Robot:
    return load_table(str(BY_NAME[name])).robot


@cache
def arm_of(name: str) -> Arm:
    return read_arm_file(BY_NAME[name])


@cache
def fitting(name: str) -> AnalyticJacobian:
    return analytic_jacobian(task_vector(robot_of(name)))


def points(arm: Arm, count: int = POSES, seed: int = 21) -> list[Point]:
    """Numbers of 50 digits for all names of a table; parameters without a value get one."""
    names = [name for name, _ in arm.variables]
    return [
        {
            **{name: number(f"0.{3 + k}7") for k, name in enumerate(arm.parameters())},
            **{name: number(float(x)) for name, x in zip(names, row, strict=True)},
        }
        for row in arm.seeded_poses(count, seed)
    ]


def known(robot: Robot, point: Point) -> Point:
    """The point, with the table's own values for names that it leaves out."""
    return {**{s.name: value_of(v, {}) for s, v in robot.values.items()}, **point}


def pose(arm: Arm, point: Point) -> np.ndarray:
    return np.asarray(arm.pose(point, arithmetic=FIFTY_DIGITS))


def pose_slope(arm: Arm, point: Point, name: str) -> np.ndarray:
    """Derivative of the pose by a joint variable, by a central difference in 50 digits."""
    there, back = ({**point, name: point[name] + h} for h in (STEP, -STEP))
    return (pose(arm, there) - pose(arm, back)) / (2 * STEP)


def euler_product(name: str, angles: list[Any]) -> np.ndarray:
    first, second, third = (
        elementary("R" + letter, angle, (), FIFTY_DIGITS)
        for letter, angle in zip(name, angles, strict=True)
    )
    return np.asarray((first @ second @ third)[:3, :3])


def euler_slope(name: str, angles: list[Any], place: int) -> np.ndarray:
    """Derivative of the product of three rotations by one of the angles."""
    there, back = list(angles), list(angles)
    there[place] += STEP
    back[place] -= STEP
    return (euler_product(name, there) - euler_product(name, back)) / (2 * STEP)


def angle_numbers(found: AnalyticJacobian, point: Point) -> list[Any]:
    """What the package says the Euler angles are, worked out."""
    numbers = []
    for angle in found.vector.angles:
        if isinstance(angle.value, Atan2):
            y, x = value_of(angle.value.y, point), value_of(angle.value.x, point)
            numbers.append(MP.atan2(y, x))
        else:
            numbers.append(value_of(angle.value, point))
    return numbers


def check_against_the_oracle(found: AnalyticJacobian, arm: Arm, count: int = POSES) -> None:
    """Compare r and dr/dq with poses of the oracle and their differences.

    Euler angles are not extracted from the oracle's pose. Instead the rotations that they make are
    multiplied: the product must be the oracle's orientation, and by the chain rule its derivatives
    by the angles times their rates must be the derivative of the orientation.
    """
    vector = found.vector
    robot = vector.robot
    for given in points(arm, count):
        point = known(robot, given)
        reached = pose(arm, given)
        angles = angle_numbers(found, point)
        letters = {a.symbol.name: x for a, x in zip(vector.angles, angles, strict=True)}
        scale = 1 + max(abs(x) for x in reached.flat)
        if vector.sequence is not None:
            made = euler_product(vector.sequence.name, angles)
            assert abs(made - reached[:3, :3]).max() < 1e-40
        for k, variable in enumerate(robot.variables):
            slope = pose_slope(arm, given, variable.name)
            turned = 0 * slope[:3, :3]
            for r, component in enumerate(vector.components):
                rate = value_of(found.matrix[r, k], {**point, **letters})
                match component:
                    case Coordinate(axis=axis, value=value):
                        assert abs(value_of(value, point) - reached[axis, 3]) < 1e-40 * scale
                        assert abs(rate - slope[axis, 3]) < 1e-12 * scale
                    case Heading(axis=axis):
                        spin = slope[:3, :3] @ reached[:3, :3].T
                        assert abs(rate - spin[(axis + 2) % 3, (axis + 1) % 3]) < 1e-12
                    case EulerAngle(place=place):
                        assert vector.sequence is not None
                        turned += rate * euler_slope(vector.sequence.name, angles, place)
            if vector.sequence is not None:
                assert abs(turned - slope[:3, :3]).max() < 1e-12


@pytest.mark.parametrize("name", BY_NAME)
def test_vector_and_jacobian_of_every_table_agree_with_the_oracle(name: str) -> None:
    check_against_the_oracle(fitting(name), arm_of(name))


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("name", ["puma560", "ikbt_Minder13"])
def test_all_twelve_sequences_agree_with_the_oracle(name: str, sequence: str) -> None:
    found = analytic_jacobian(task_vector(robot_of(name), f"x y z {sequence}"))
    assert [type(c) for c in found.vector.components] == [Coordinate] * 3 + [EulerAngle] * 3
    check_against_the_oracle(found, arm_of(name), count=2)


@pytest.mark.parametrize("name", ["puma560", "ur5", "scara_rrpr", "zyz_wrist", "orion5", "sawyer"])
def test_the_numbers_are_those_of_the_formulas(name: str) -> None:
    found, arm, robot = fitting(name), arm_of(name), robot_of(name)
    for given in points(arm, 3):
        values = {
            symbol: parse_expression(repr(float(given[symbol.name])))
            for symbol in (*robot.variables, *robot.parameters)
            if symbol.name in given
        }
        point = known(robot, {s.name: value_of(v, {}) for s, v in values.items()})
        numbers = task_numbers(found, values)
        angles = angle_numbers(found, point)
        letters = {a.symbol.name: x for a, x in zip(found.vector.angles, angles, strict=True)}
        for component, got in zip(found.vector.components, numbers.vector, strict=True):
            match component:
                case Coordinate(value=value):
                    assert abs(value_of(value, point) - got) < 1e-14
                case Heading(angle=angle):
                    assert abs(MP.expj(value_of(angle, point)) - MP.expj(got)) < 1e-14
                case EulerAngle(symbol=symbol):
                    assert abs(MP.expj(letters[symbol.name]) - MP.expj(got)) < 1e-13
        slopes = np.array(numbers.jacobian)
        for (r, k), got in np.ndenumerate(slopes):
            told = value_of(found.matrix[r, k], {**point, **letters})
            assert abs(told - got) < 1e-12 * max(1, abs(told))


# -- which components ------------------------------------------------------------------------------


def components(robot: Robot, text: str | None = None) -> list[str]:
    """Components as ``x``, ``phi=...``, ``alpha_z=...``; Euler angles by sequence and place."""
    vector = task_vector(robot, text)
    shown = []
    for component in vector.components:
        match component:
            case Coordinate(axis=axis):
                shown.append(axis.name.lower())
            case Heading(axis=axis, angle=angle, planar=planar):
                letter = "phi" if planar else f"alpha_{axis.name.lower()}"
                shown.append(f"{letter}={angle}")
            case EulerAngle(place=place):
                assert vector.sequence is not None
                shown.append(f"{vector.sequence.name}{place + 1}")
    return shown


XYZ_ZYX = ["x", "y", "z", "zyx1", "zyx2", "zyx3"]


@pytest.mark.parametrize(
    ("name", "choice", "expected"),
    [
        ("planar_2r", Choice.PARALLEL, ["x", "y"]),
        ("planar_3r", Choice.PARALLEL, ["x", "y", "phi=theta1 + theta2 + theta3"]),
        ("planar_2r_p", Choice.PARALLEL, ["x", "y", "z"]),
        ("scara_rrpr", Choice.PARALLEL, ["x", "y", "z", "alpha_z=theta1 + theta2 - theta4"]),
        ("cartesian_ppp", Choice.SLIDING, ["x", "y", "z"]),
        ("elbow_3r", Choice.POSITION, ["x", "y", "z"]),
        ("spherical_rrp", Choice.POSITION, ["x", "y", "z"]),
        ("zyz_wrist", Choice.WRIST, ["zyz1", "zyz2", "zyz3"]),
        ("ikbt_Wrist", Choice.WRIST, ["zyx1", "zyx2", "zyx3"]),
        ("puma560", Choice.POSE, XYZ_ZYX),
        ("minimover_5r", Choice.POSE, ["x", "y", "z", "zyz1", "zyz2", "zyz3"]),
    ],
)
def test_the_structure_chooses_the_components(
    name: str, choice: Choice, expected: list[str]
) -> None:
    assert task_vector(robot_of(name)).choice is choice
    assert components(robot_of(name)) == expected


HEAD = "name: arm\nconvention: modified\nunits: {angle: deg, length: m}\njoints:\n"
TURNING = {
    "about a tilted axis": HEAD
    + "  - {theta: q1, d: 0.1, a: a1, alpha: beta}\nbase: [Tz(h), Rx(beta)]\n",
    "about four axes through one point": HEAD
    + "  - {theta: q1, d: 0, a: 0, alpha: 0}\n  - {theta: q2, d: 0, a: 0, alpha: 90 deg}\n"
    + "  - {theta: q3, d: 0, a: 0, alpha: -90 deg}\n  - {theta: q4, d: 0, a: 0, alpha: 90 deg}\n",
}


@pytest.mark.parametrize("text", TURNING.values(), ids=TURNING)
def test_a_hand_that_only_turns_is_asked_for_its_orientation(text: str) -> None:
    found = analytic_jacobian(task_vector(loads_table(text).robot))
    assert found.vector.choice is Choice.TURNING
    assert len(found.vector.angles) == len(found.vector.components) == 3
    check_against_the_oracle(found, read_arm(text))
    told = render_chapters(task_document(found).chapters, 100)
    assert "No joint moves the origin of the hand: its orientation in Euler angles:" in told


def test_the_scara_of_the_lecture() -> None:
    """r = (a1 c1 + a2 c12, a1 s1 + a2 s12, d1 + q3 + d4, q1 + q2 + q4)."""
    vector = task_vector(load_table(str(ROOT / "examples" / "scara.yaml")).robot)
    values = [c.angle if isinstance(c, Heading) else c.value for c in vector.components]
    printed = (
        "a1*cos(q1) + a2*cos(q1 + q2)",
        "a1*sin(q1) + a2*sin(q1 + q2)",
        "d1 + q3 + d4",
        "q1 + q2 + q4",
    )
    assert values == [parse_expression(text) for text in printed]


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("planar_2r", "x y phi", ["x", "y", "phi=theta1 + theta2"]),
        ("planar_2r", "y, x", ["y", "x"]),
        ("planar_2r", "p_x p_y alpha_z", ["x", "y", "alpha_z=theta1 + theta2"]),
        ("puma560", "X Y Z RPY", XYZ_ZYX),
        ("puma560", "zxz", ["zxz1", "zxz2", "zxz3"]),
        ("scara_rrpr", "z zyx", ["z", "zyx1", "zyx2", "zyx3"]),
    ],
)
def test_components_may_be_named(name: str, text: str, expected: list[str]) -> None:
    assert components(robot_of(name), text) == expected


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("puma560", "x y q", "there is no component 'q' of a task vector"),
        ("puma560", "x y zzy", "there is no sequence of Euler angles 'zzy'"),
        ("puma560", "x x", "x stands twice"),
        ("puma560", "zyz zyx", "the orientation is described twice"),
        ("puma560", "zyz zyz", "stands twice"),
        ("scara_rrpr", "phi zyx", "the orientation is described twice"),
        ("puma560", "x y phi", "only where all revolute axes are parallel"),
        ("scara_rrpr", "alpha_x", "its angle is alpha_z, not alpha_x"),
        ("scara_rrpr", "x y z zyz", "zyz is singular in every pose of scara_rrpr"),
        ("puma560", "  ", "names no component"),
    ],
)
def test_wrong_components_are_refused(name: str, text: str, says: str) -> None:
    with pytest.raises(UnsupportedError) as refused:
        task_vector(robot_of(name), text)
    assert says in str(refused.value)


TURNED = """\
name: turned
convention: standard
base: [{base}]
joints:
  - {{theta: q1, d: 0, a: a1, alpha: 0}}
  - {{theta: q2, d: 0, a: a2, alpha: 0}}
  - {{theta: q3, d: 0, a: 0, alpha: 0}}
tool: [{tool}]
values: {{a1: 1, a2: 0.5}}
"""


@pytest.mark.parametrize(
    ("base", "tool", "expected"),
    [
        ("Rz(90 deg)", "Tx(0.1)", ["x", "y", "phi=q1 + q2 + q3 + pi/2"]),
        ("Rx(90 deg)", "Rx(180 deg)", ["x", "z", "phi=-q1 - q2 - q3"]),
        ("Ry(90 deg)", "Rz(90 deg)", ["y", "z", "phi=q1 + q2 + q3 + pi/2"]),
        ("Tz(1)", "Rz(-90 deg)", ["x", "y", "phi=q1 + q2 + q3 - pi/2"]),
    ],
)
def test_the_one_angle_knows_base_and_tool(base: str, tool: str, expected: list[str]) -> None:
    text = TURNED.format(base=base, tool=tool)
    robot = loads_table(text).robot
    assert components(robot) == expected
    check_against_the_oracle(analytic_jacobian(task_vector(robot)), read_arm(text), count=2)


def test_a_tilted_plane_is_described_by_euler_angles() -> None:
    robot = loads_table(TURNED.format(base="Rx(30 deg)", tool="Tx(0.1)")).robot
    vector = task_vector(robot)
    assert vector.choice is Choice.POSITION
    with pytest.raises(UnsupportedError):
        task_vector(robot, "phi")


def test_letters_of_the_table_are_not_used_twice() -> None:
    text = TURNED.format(base="Rx(30 deg)", tool="Tx(0.1)").replace("q2", "phi")
    vector = task_vector(loads_table(text).robot, "zyx")
    assert [angle.symbol.name for angle in vector.angles] == ["alpha", "beta", "gamma"]


def test_a_skew_wrist_has_roll_pitch_and_yaw() -> None:
    """No sequence of rotations about the axes of a frame is that of axes 30 degrees apart."""
    rows = "".join(f"  - {{theta: q{k}, d: 0, a: 0, alpha: 30 deg}}\n" for k in (1, 2, 3))
    text = f"name: skew\nconvention: standard\njoints:\n{rows}"
    robot = loads_table(text).robot
    vector = task_vector(robot)
    assert vector.choice is Choice.WRIST
    assert components(robot) == ["zyx1", "zyx2", "zyx3"]
    check_against_the_oracle(analytic_jacobian(vector), read_arm(text), count=2)


# -- singular representations ----------------------------------------------------------------------


def test_a_singular_representation_is_refused_in_numbers() -> None:
    robot = robot_of("zyz_wrist")
    found = fitting("zyz_wrist")
    straight = dict.fromkeys(robot.variables, parse_expression("0"))
    with pytest.raises(UnsupportedError, match="zyz are singular at these values"):
        task_numbers(found, straight)
    bent = {**straight, robot.variables[1]: parse_expression("1e-6")}
    assert task_numbers(found, bent).jacobian == ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def test_where_the_representation_is_singular_is_said_in_joint_variables() -> None:
    assert str(fitting("zyz_wrist").vector.vanishing) == "sin(theta2)"
    assert str(fitting("puma560").vector.vanishing) == "cos(theta)"
    assert fitting("planar_3r").vector.vanishing is None
    never = task_vector(robot_of("scara_rrpr"), "zyx")
    assert never.vanishing == 1


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_the_refusal_advises_a_sequence_that_works(sequence: str) -> None:
    """At the identity and where a sequence is singular: the one advised is not."""
    robot = robot_of("ikbt_Wrist")
    zero = dict.fromkeys(robot.variables, parse_expression("0"))
    found = analytic_jacobian(task_vector(robot, sequence))
    if not named_sequence(sequence).proper:
        task_numbers(found, zero)
        return
    with pytest.raises(UnsupportedError) as refused:
        task_numbers(found, zero)
    advised = str(refused.value).rsplit(" ", 1)[1]
    task_numbers(analytic_jacobian(task_vector(robot, advised)), zero)


# -- the command -----------------------------------------------------------------------------------


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_command_says_why_and_what(empty: Path, capsys: Capture) -> None:
    assert run(["task", str(ROOT / "examples" / "scara.yaml")]) == 0
    shown = capsys.readouterr().out
    assert "All revolute axes are parallel to z" in shown
    assert "α_z = q₁ + q₂ + q₄" in shown
    assert run(["task", str(BY_NAME["zyz_wrist"])]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "B is singular where s₂ = 0" in shown
    assert run(["task", str(BY_NAME["puma560"])]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "B is singular where cos θ = 0, that is where r₃₁ is 1 or -1" in shown
    assert run(["task", str(BY_NAME["orion5"])]) == 0
    assert "six components and four joint variables" in capsys.readouterr().out


def test_the_reason_for_each_choice_is_told(empty: Path, capsys: Capture) -> None:
    for name, says in (
        ("cartesian_ppp", "No joint turns the hand, so its position says all:"),
        ("elbow_3r", "With three joints the position alone can be prescribed:"),
    ):
        assert run(["task", str(BY_NAME[name])]) == 0
        assert says in " ".join(capsys.readouterr().out.split())
    assert run(["task", str(BY_NAME["scara_rrpr"]), "--vector", "zyx"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "The task vector has the components that were asked for:" in shown
    assert "B is never singular for this arm, in which always θ = 0." in shown


def test_an_angle_that_two_joints_leave_open_follows(empty: Path, capsys: Capture) -> None:
    assert run(["task", str(BY_NAME["planar_2r"])]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert (
        "All revolute axes are parallel to z, so one angle says the orientation; two joints have "
        "to do with the position, and the angle follows: φ = θ₁ + θ₂."
    ) in shown


def test_one_component_has_one_row(empty: Path, capsys: Capture) -> None:
    """x = a1 c1 + a2 c12; a matrix of one row stands between plain brackets."""
    assert run(["task", str(BY_NAME["planar_2r"]), "--vector", "x"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "J = [ -(a₁ s₁ + a₂ s₁₂) -a₂ s₁₂ ]" in shown


def test_numbers_of_a_planar_arm_by_hand(empty: Path, capsys: Capture) -> None:
    """The elbow at (1, 0), the second link and the tool straight up."""
    text = TURNED.format(base="Tz(0)", tool="Tx(0.1)")
    Path("arm.yaml").write_text(text.replace("name", "units: {length: m}\nname"))
    settings = ("--set=q1=0", "--set=q2=90 deg", "--set=q3=0")
    assert run(["task", "arm.yaml", "--vector", "x y phi", *settings]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "a₁ = 1 m, a₂ = 0.5 m, q₁ = 0, q₂ = 90° and q₃ = 0" in shown
    rows = ("⎡ -0.6 -0.6 -0.1 ⎤", "⎢ 1 0 0 ⎥", "⎣ 1 1 1 ⎦")
    for entry in ("x = 1 m", "y = 0.6 m", "φ = 90°", *rows):
        assert entry in shown, entry


def test_json_is_read_back(empty: Path, capsys: Capture) -> None:
    path = BY_NAME["puma560"]
    settings = [f"--set=theta{k}={10 * k} deg" for k in range(1, 7)]
    assert run(["task", str(path), "--format", "json", "--vector", "x y z zyz", *settings]) == 0
    got = json.loads(capsys.readouterr().out)
    assert got["components"] == ["x", "y", "z", "phi", "theta", "psi"]
    robot = robot_of("puma560")
    point = known(robot, {f"theta{k}": number(10 * k) * MP.pi / 180 for k in range(1, 7)})
    letters = {
        name: value_of(parse_expression(text), point) for name, text in got["letters"].items()
    }
    for r, row in enumerate(got["jacobian"]):
        for k, text in enumerate(row):
            exact = value_of(parse_expression(text), {**point, **letters})
            assert abs(exact - got["values"]["jacobian"][r][k]) < 1e-12
    for text, value in zip(got["vector"], got["values"]["vector"], strict=True):
        assert abs(value_of(parse_expression(text), point) - value) < 1e-12
    assert got["singular_where_zero"] == "sin(theta)"


@pytest.mark.parametrize(
    ("name", "components", "angle"),
    [
        ("planar_3r", ["x", "y", "phi"], "theta1 + theta2 + theta3"),
        # Behind a twist of 180 deg the last axis points down.
        ("scara_rrpr", ["x", "y", "z", "alpha_z"], "theta1 + theta2 - theta4"),
    ],
)
def test_json_has_the_one_angle_of_parallel_axes(
    name: str, components: list[str], angle: str, empty: Path, capsys: Capture
) -> None:
    assert run(["task", str(BY_NAME[name]), "--format", "json"]) == 0
    got = json.loads(capsys.readouterr().out)
    assert got["components"] == components
    exact = parse_expression(angle)
    assert parse_expression(got["vector"][-1]) == exact
    slopes = [exact.coeff(variable) for variable in robot_of(name).variables]
    assert got["jacobian"][-1] == [str(slope) for slope in slopes]


FIXED = """\
name: fixed
convention: standard
joints:
  - {theta: 0, d: 1, a: 0, alpha: 0}
"""


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["puma560", "--vector", "x y zzz"], "there is no sequence of Euler angles 'zzz'"),
        (["puma560", "--vector", "x y w"], "there is no component 'w'"),
        (["puma560", "--set", "theta9=1 deg"], "theta9 is not in the table"),
        (["zyz_wrist", "--numeric"], "theta1, theta2, theta3 have no value"),
        (["zyz_wrist", *(f"--set=theta{k}=0" for k in (1, 2, 3))], "zyz are singular"),
        (["scara_rrpr", "--vector", "zyz"], "singular in every pose"),
    ],
)
@pytest.mark.parametrize("form", ["text", "latex", "json"])
def test_bad_input_is_told_and_writes_nothing(
    arguments: list[str], says: str, form: str, empty: Path, capsys: Capture
) -> None:
    table, *rest = arguments
    assert run(["task", str(BY_NAME[table]), *rest, "--format", form, "-o", "out.txt"]) == 2
    shown = capsys.readouterr()
    assert says in shown.err
    assert shown.out == ""
    assert list(empty.iterdir()) == []


def test_an_arm_that_does_not_move_has_no_task_vector(empty: Path, capsys: Capture) -> None:
    Path("fixed.yaml").write_text(FIXED)
    assert run(["task", "fixed.yaml"]) == 2
    assert "has no joint that moves" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["puma560", "pieper_generic", "scara_rrpr", "orion5"])
def test_the_document_compiles_and_no_line_is_too_wide(name: str, empty: Path) -> None:
    pdflatex = require_tool("pdflatex")
    assert run(["task", str(BY_NAME[name]), "--format", "latex", "-o", "out.tex"]) == 0
    command = [pdflatex, "-interaction=batchmode", "-halt-on-error", "out.tex"]
    ran = subprocess.run(command, capture_output=True, timeout=120, check=False)
    assert ran.returncode == 0
    assert "Overfull" not in Path("out.log").read_text(encoding="latin-1")


def test_nothing_depends_on_the_hash_seed(run_symdh: Runner) -> None:
    texts = set()
    for seed in ("0", "1", "2"):
        for form in ("text", "latex", "json"):
            ran = run_symdh(
                *("task", BY_NAME["ikbt_Minder13"], "--format", form), env={"PYTHONHASHSEED": seed}
            )
            assert ran.returncode == 0, ran.stderr
            texts.add(ran.stdout)
    assert len(texts) == 3


@pytest.mark.parametrize(
    ("third", "whole"),
    [
        ("2*pi/3 + 1", 3),
        ("10*pi/27", -8 * math.pi / 9),
        ("-10*pi/27", 8 * math.pi / 9),
        ("pi", math.pi),
        ("pi/4", 3 * math.pi / 4),
    ],
)
def test_angles_in_numbers_lie_in_one_turn(third: str, whole: float) -> None:
    found = fitting("planar_3r")
    robot = robot_of("planar_3r")
    values = dict.fromkeys(robot.variables, parse_expression(third))
    values |= {s: parse_expression("1") for s in robot.parameters if s not in robot.values}
    angle = task_numbers(found, values).vector[2]
    assert math.isclose(angle, whole, rel_tol=1e-12)
