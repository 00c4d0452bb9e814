"""Frames, exact transforms between any two of them, numeric poses, and the limits of both."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import mpmath
import numpy as np
import pytest
from oracle import FIFTY_DIGITS, Arm, read_arm, read_arm_file
from sympy import ImmutableMatrix, Integer, Rational, Symbol, cos, eye, pi, sin

import symdh
from symdh.codegen import generate
from symdh.derivation.derive import derive
from symdh.errors import LimitError, UnsupportedError
from symdh.kinematics.chain import chain_word, link_word, segment
from symdh.kinematics.forward import (
    CLOSED_FORM_LIMIT,
    forward_kinematics,
    has_closed_form,
    link_transform,
    transform,
)
from symdh.kinematics.frame import (
    Frame,
    checked,
    first_frame,
    frame_from_text,
    last_frame,
    place,
)
from symdh.kinematics.numeric import NumericMatrix, check_values, pose
from symdh.motion import rotation, translation
from symdh.motion.size import closed_form_size
from symdh.render.latex import render_latex
from symdh.robot import Axis

DATA = Path(__file__).parent / "data" / "tables"
ULP = 2.0**-52

BOTH_ENDS = """
name: both_ends
convention: {convention}
units: {{angle: deg, length: m}}
joints:
  - {{theta: theta1, d: d1, a: 0.25, alpha: 90 deg}}
  - {{theta: 0, d: q2, a: a2, alpha: 30 deg}}
  - {{theta: theta3, d: 0.125, a: 0, alpha: 0}}
base: [Tz(0.5), Rx(90 deg)]
tool: [Tx(0.1), Ry(-45 deg), Tz(0.3)]
values: {{d1: 0.4, a2: 0.35}}
"""


def both_ends(convention: str = "standard") -> tuple[symdh.Robot, Arm]:
    text = BOTH_ENDS.format(convention=convention)
    return symdh.loads(text), read_arm(text)


def skew_arm(n: int) -> symdh.Robot:
    """An arm of n joints, each perpendicular to the one before."""
    rows = "\n".join(
        f"  - {{theta: t{i}, d: d{i}, a: a{i}, alpha: {90 * (-1) ** i} deg}}"
        for i in range(1, n + 1)
    )
    return symdh.loads(f"name: skew{n}\nconvention: standard\njoints:\n{rows}\n")


both_conventions = pytest.mark.parametrize("convention", ["standard", "modified"])


# -- frames ---------------------------------------------------------------------------------------


def test_the_frames_of_an_arm_stand_in_chain_order() -> None:
    robot, _ = both_ends()
    frames: list[Frame] = ["base", 0, 1, 2, 3, "tool"]
    assert [place(robot, frame) for frame in frames] == [-1, 0, 1, 2, 3, 4]
    assert (first_frame(robot), last_frame(robot)) == ("base", "tool")
    bare = skew_arm(2)
    assert (first_frame(bare), last_frame(bare)) == (0, 2)


@pytest.mark.parametrize(
    ("text", "frame"),
    [("base", "base"), ("Tool", "tool"), (" BASE ", "base"), ("0", 0), ("3", 3), ("03", 3)],
)
def test_a_frame_is_read_from_text(text: str, frame: Frame) -> None:
    assert frame_from_text(both_ends()[0], text) == frame


@pytest.mark.parametrize(
    "text",
    ["4", "-1", "", "tools", "1.0", "+1", "1e0", "٣", "²", "99999999999", "0x1", "None", "1\n2"],
)
def test_a_frame_that_is_not_there_is_named_with_those_that_are(text: str) -> None:
    with pytest.raises(UnsupportedError) as caught:
        frame_from_text(both_ends()[0], text)
    assert "both_ends has base, 0 to 3, tool" in str(caught.value)
    assert "there is no frame" in str(caught.value)


@pytest.mark.parametrize("frame", [-1, 4, True, False, 1.0, "1", "Base", None, (), Integer(1)])
def test_only_frames_are_frames(frame: object) -> None:
    robot, _ = both_ends()
    with pytest.raises(UnsupportedError, match="there is no frame"):
        checked(robot, frame)  # type: ignore[arg-type]
    calls: list[Callable[[], object]] = [
        lambda: transform(robot, 0, frame),  # type: ignore[arg-type]
        lambda: transform(robot, frame, 0),  # type: ignore[arg-type]
        lambda: chain_word(robot, frame, 3),  # type: ignore[arg-type]
        lambda: pose(robot, 0, frame, {}),  # type: ignore[arg-type]
    ]
    for call in calls:
        with pytest.raises(UnsupportedError, match="there is no frame"):
            call()


@pytest.mark.parametrize("row", [0, 4, -1, True])
def test_a_link_that_is_not_there(row: int) -> None:
    with pytest.raises(UnsupportedError, match="there is no frame"):
        link_transform(both_ends()[0], row)


# -- words ----------------------------------------------------------------------------------------


def test_the_conventions_differ_in_their_words_alone() -> None:
    theta1, d1 = Symbol("theta1", real=True), Symbol("d1", real=True)
    about_z = (rotation(Axis.Z, theta1), translation(Axis.Z, d1))
    along, twist = translation(Axis.X, Rational(1, 4)), rotation(Axis.X, pi / 2)
    assert link_word(both_ends("standard")[0], 1) == (*about_z, along, twist)
    modified = link_word(both_ends("modified")[0], 1)
    assert set(modified[:2]) == {along, twist}
    assert modified[2:] == about_z


@both_conventions
def test_a_chain_is_made_of_its_segments(convention: str) -> None:
    robot, _ = both_ends(convention)
    assert segment(robot, -1) == robot.base
    assert segment(robot, 3) == robot.tool
    links = [link_word(robot, i) for i in (1, 2, 3)]
    assert chain_word(robot, 0, 3) == sum(links, start=())
    assert chain_word(robot, "base", "tool") == (*robot.base, *sum(links, start=()), *robot.tool)
    assert chain_word(robot, 2, 2) == ()


# -- exact transforms -----------------------------------------------------------------------------

POINT = {"theta1": 0.7, "q2": -0.31, "theta3": 2.3}


def value_at(robot: symdh.Robot, matrix: ImmutableMatrix) -> np.ndarray:
    known = {**robot.values, **{Symbol(n, real=True): Rational(x) for n, x in POINT.items()}}
    return np.array(matrix.xreplace(known).evalf(30).tolist(), dtype=float)


def seen_from_zero(arm: Arm) -> dict[Frame, np.ndarray]:
    """Return the oracle's pose of every frame in frame 0."""
    poses: dict[Frame, np.ndarray] = {i: arm.pose(POINT, 0, i) for i in (0, 1, 2, 3)}
    poses["base"] = np.linalg.inv(np.array(arm.pose(POINT, "base", 0), dtype=float))
    poses["tool"] = arm.pose(POINT, 0, "tool")
    return {frame: np.array(pose, dtype=float) for frame, pose in poses.items()}


@both_conventions
@pytest.mark.parametrize("start", ["base", 0, 1, 2, 3, "tool"])
def test_every_transform_agrees_with_the_oracle(convention: str, start: Frame) -> None:
    robot, arm = both_ends(convention)
    for end in seen_from_zero(arm):
        exact = value_at(robot, transform(robot, start, end))
        expected = np.linalg.inv(seen_from_zero(arm)[start]) @ seen_from_zero(arm)[end]
        assert np.abs(exact - expected).max() < 1e-14


@both_conventions
def test_a_transform_to_itself_is_the_identity(convention: str) -> None:
    robot, _ = both_ends(convention)
    for frame in ("base", 0, 1, 2, 3, "tool"):
        assert transform(robot, frame, frame) == eye(4)


@both_conventions
def test_the_way_back_transposes_the_way_there(convention: str) -> None:
    robot, _ = both_ends(convention)
    there, back = transform(robot, "base", "tool"), transform(robot, "tool", "base")
    assert back[:3, :3] == there[:3, :3].T
    assert back.row(3) == there.row(3) == ImmutableMatrix([[0, 0, 0, 1]])


@both_conventions
def test_base_and_tool_of_a_table_without_them_are_its_ends(convention: str) -> None:
    text = BOTH_ENDS.format(convention=convention)
    bare = "\n".join(line for line in text.splitlines() if not line.startswith(("base", "tool")))
    robot = symdh.loads(bare)
    assert transform(robot, "base", 0) == transform(robot, 3, "tool") == eye(4)
    assert transform(robot, "base", "tool") == transform(robot, 0, 3)


def test_link_transforms_are_transforms_between_neighbours() -> None:
    robot, _ = both_ends()
    for i in (1, 2, 3):
        assert link_transform(robot, i) == transform(robot, i - 1, i)


def test_forward_kinematics_holds_the_links_and_the_pose() -> None:
    robot, _ = both_ends()
    result = forward_kinematics(robot)
    assert (result.start, result.end) == ("base", "tool")
    assert result.links == tuple(link_transform(robot, i) for i in (1, 2, 3))
    assert result.pose == transform(robot, "base", "tool") == result.between("base", "tool")
    assert result.between(3, 1) == transform(robot, 3, 1)


# -- the limit ------------------------------------------------------------------------------------


def test_past_the_limit_there_is_no_closed_form() -> None:
    robot = skew_arm(30)
    size = closed_form_size(chain_word(robot, 0, 30))
    assert size > CLOSED_FORM_LIMIT
    for start, end in ((0, 30), (30, 0)):
        with pytest.raises(LimitError) as caught:
            transform(robot, start, end)
        assert caught.value.exit_status == 4
        assert f"skew30 from {start} to {end}" in str(caught.value)
        assert f"{size:,} operations, over the limit of 2,000" in str(caught.value)
    assert not has_closed_form(robot, 0, 30)
    assert forward_kinematics(robot).pose is None
    assert len(forward_kinematics(robot).links) == 30


def test_a_size_of_many_digits_is_told_as_a_power_of_ten() -> None:
    robot = skew_arm(60)
    digits = len(str(closed_form_size(chain_word(robot, 0, 60))))
    with pytest.raises(LimitError, match=rf"about 10\^{digits - 1} operations"):
        transform(robot, 0, 60)


def test_a_part_of_a_long_arm_still_has_a_closed_form() -> None:
    robot = skew_arm(30)
    assert has_closed_form(robot, 12, 16)
    expected = eye(4)
    for i in (13, 14, 15, 16):
        expected = expected * link_transform(robot, i)
    point = {s: Rational(k + 1, 7) for k, s in enumerate((*robot.variables, *robot.parameters))}
    difference = transform(robot, 12, 16).xreplace(point) - expected.xreplace(point)
    assert max(abs(x) for x in difference.evalf(30)) < Rational(1, 10**24)


def test_the_limit_counts_what_is_not_parallel() -> None:
    """Fifty parallel joints have a small closed form; the limit is on size, not on joints."""
    rows = "\n".join(f"  - {{theta: t{i}, d: 0, a: a{i}, alpha: 0}}" for i in range(1, 51))
    robot = symdh.loads(f"name: snake\nconvention: standard\njoints:\n{rows}\n")
    assert has_closed_form(robot, 0, 50)
    total = sum(robot.variables, start=Integer(0))
    result = transform(robot, 0, 50)
    assert (result[0, 0], result[1, 0]) == (cos(total), sin(total))
    assert len(result[0, 3].args) == 50


# -- numbers --------------------------------------------------------------------------------------


def largest_error(numbers: NumericMatrix, expected: np.ndarray) -> float:
    return float(max(abs(mpmath.mpf(numbers[r][c]) - expected[r, c]) for r, c in np.ndindex(4, 4)))


@pytest.mark.parametrize("name", ["puma560", "kuka_iiwa7", "scara_rrpr", "ikbt_KR16", "sawyer"])
def test_a_numeric_pose_is_the_double_next_to_the_truth(name: str) -> None:
    """Worked out in 40 digits and rounded once: half a unit in the last place of each entry."""
    robot, arm = symdh.load(DATA / f"{name}.yaml"), read_arm_file(DATA / f"{name}.yaml")
    for q in arm.seeded_poses(20, seed=7):
        numbers = dict(zip((n for n, _ in arm.variables), map(float, q), strict=True))
        exact = {Symbol(n, real=True): Rational(x) for n, x in numbers.items()}
        expected = arm.pose(numbers, arithmetic=FIFTY_DIGITS)
        found = pose(robot, "base", "tool", exact)
        for r, c in np.ndindex(4, 4):
            allowed = ULP * float(abs(expected[r, c])) / 2 + 1e-35
            assert abs(mpmath.mpf(found[r][c]) - expected[r, c]) <= allowed * 1.0001


@both_conventions
def test_numeric_poses_run_both_ways(convention: str) -> None:
    robot, arm = both_ends(convention)
    values = {Symbol(n, real=True): Rational(x) for n, x in POINT.items()}
    there = arm.pose(POINT, 1, "tool", arithmetic=FIFTY_DIGITS)
    assert largest_error(pose(robot, 1, "tool", values), there) < 2e-16
    back = np.array(pose(robot, "tool", 1, values)) @ np.array(pose(robot, 1, "tool", values))
    assert np.abs(back - np.eye(4)).max() < 1e-15


def test_entries_that_cancel_are_exactly_zero() -> None:
    robot = symdh.loads(
        "name: arm\nconvention: standard\nunits: {angle: deg}\njoints:\n"
        "  - {theta: theta1, d: 0, a: 1, alpha: 0}\n  - {theta: theta2, d: 0, a: 1, alpha: 0}\n"
    )
    t1, t2 = robot.variables
    assert pose(robot, 0, 2, {t1: pi / 2, t2: pi})[0][3] == 0.0
    # cos(1) - cos(-1) cancels in digits and not by a rule of sympy's.
    reached = pose(robot, 0, 2, {t1: Integer(1), t2: pi - 2})
    assert reached[0][3] == 0.0
    assert reached[1][3] == pytest.approx(2 * np.sin(1.0), abs=1e-15)


def test_a_small_entry_is_not_taken_for_zero() -> None:
    robot = symdh.loads(
        "name: arm\nconvention: standard\njoints:\n  - {theta: theta1, d: 0, a: 0, alpha: 0}\n"
    )
    (t1,) = robot.variables
    assert pose(robot, 0, 1, {t1: Rational(1, 10**20)})[1][0] == 1e-20


def test_given_values_win_over_those_of_the_table() -> None:
    robot, _ = both_ends()
    d1 = Symbol("d1", real=True)
    zero = dict.fromkeys(robot.variables, Integer(0))
    assert pose(robot, 0, 1, zero)[2][3] == 0.4
    assert pose(robot, 0, 1, {**zero, d1: Integer(7)})[2][3] == 7.0


def test_symbols_without_a_value_are_all_named() -> None:
    robot, _ = both_ends()
    with pytest.raises(UnsupportedError) as caught:
        pose(robot, "base", "tool", {})
    assert str(caught.value).startswith("q2, theta1, theta3 have no value")
    assert "--set q2=NUMBER" in str(caught.value)
    with pytest.raises(UnsupportedError, match=r"^theta3 has no value"):
        pose(robot, 2, 3, {})


def test_only_the_symbols_on_the_way_need_a_value() -> None:
    robot, _ = both_ends()
    assert pose(robot, 3, "tool", {})[0][3] == pytest.approx(0.1 - 0.3 * np.sqrt(0.5), abs=1e-16)
    check_values(chain_word(robot, 3, "tool"), {})


def test_names_are_listed_by_number_not_by_letter() -> None:
    with pytest.raises(UnsupportedError, match=r"^t2, t9, t10 have no value"):
        check_values(
            tuple(rotation(Axis.Z, Symbol(name, real=True)) for name in ("t10", "t9", "t2")), {}
        )


@pytest.mark.parametrize(
    ("length", "at_four", "bad", "says"),
    [
        ("1/k", 0.25, 0, "make 1/k infinite"),
        ("sqrt(k)", 2.0, -1, "equal to I, which is not a real"),
    ],
)
def test_values_that_make_no_real_length_are_refused(
    length: str, at_four: float, bad: int, says: str
) -> None:
    robot = symdh.loads(
        "name: arm\nconvention: standard\njoints:\n"
        f"  - {{theta: theta1, d: 0, a: {length}, alpha: 0}}\n"
    )
    (t1,), (k,) = robot.variables, robot.parameters
    assert pose(robot, 0, 1, {t1: Integer(0), k: Integer(4)})[0][3] == at_four
    with pytest.raises(UnsupportedError, match=says):
        pose(robot, 0, 1, {t1: Integer(0), k: Integer(bad)})


# -- size -----------------------------------------------------------------------------------------


def test_fifty_joints_are_derived_written_and_coded_in_five_seconds() -> None:
    robot = skew_arm(50)
    start = time.process_time()
    text = render_latex(derive(robot))
    files = [file for target in ("python", "c") for file in generate(robot, target)]
    spent = time.process_time() - start
    assert text.count(r"\mathrm{Trans}(x,\,a_{50})") >= 1
    assert {file.name.rpartition(".")[2] for file in files} == {"py", "c", "h"}
    assert spent < 5.0
