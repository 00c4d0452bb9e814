"""`symdh code --verify`: right code passes, code with one wrong sign does not."""

from __future__ import annotations

import math
import re
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from conftest import Runner
from sympy import Integer, sqrt
from test_codegen import FORMULAS, L1, OBLIQUE, PLANAR, Q1, SCARA, STANDARD, STILL, revolute

import symdh
from symdh.codegen import generate, verification
from symdh.codegen.exact import ExactChain
from symdh.codegen.inverse.judging import judged
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.program import Program
from symdh.codegen.targets import python
from symdh.codegen.verification import CheckProgram, random_poses, verify
from symdh.errors import LimitError, OutputError, UnsupportedError
from symdh.motion import translation
from symdh.robot import Axis, Robot
from tools import require_language, require_tool

ROOT = Path(__file__).parent.parent
SCARA_TABLE = ROOT / "examples" / "scara.yaml"
ONE = Robot("one", STANDARD, (revolute(Q1, a=Integer(2)),))


@pytest.mark.parametrize("target", ["python", "c"])
@pytest.mark.parametrize("robot", [PLANAR, SCARA, OBLIQUE, FORMULAS, STILL], ids=lambda r: r.name)
def test_right_code_is_right(robot: Robot, target: str) -> None:
    require_tool("gcc")
    found = verify(robot, target, generate(robot, target), count=20)
    assert found.is_right
    assert found.poses == 20
    assert found.tolerance == 4 + 2 * robot.n
    assert 0 < found.error < found.tolerance / 2 or robot is STILL


def test_float_is_measured_in_eps_of_float() -> None:
    require_tool("gcc")
    found = verify(SCARA, "c", generate(SCARA, "c", precision="float"), count=20, is_single=True)
    assert found.is_right
    assert found.error > 0.1


@pytest.mark.parametrize("target", ["python", "c"])
def test_wrong_code_is_found_out(target: str) -> None:
    """2.0000000000001 for a length of 2: 450 eps of it."""
    require_tool("gcc")
    files = generate(ONE, target)
    wrong = [
        replace(file, text=re.sub(r"\b2\.0 \* ", f"{2 + 1e-13!r} * ", file.text)) for file in files
    ]
    assert wrong != list(files)
    found = verify(ONE, target, wrong, count=5)
    assert not found.is_right
    assert 100 < found.error < 500


@pytest.mark.parametrize(
    "target", ["python", "c", "cpp", "rust", "python-ext", "javascript", "matlab", "julia"]
)
@pytest.mark.parametrize("robot", [PLANAR, SCARA], ids=lambda r: r.name)
def test_right_answers_are_right(robot: Robot, target: str) -> None:
    require_language(target)
    found = verify(robot, target, generate(robot, target), count=20).inverse
    assert found is not None
    assert found.is_right
    assert (found.poses, found.found, found.answers) == (20, 20, 40)


def test_answers_of_floats_are_judged_as_such() -> None:
    require_tool("gcc")
    files = generate(SCARA, "c", precision="float")
    found = verify(SCARA, "c", files, count=20, is_single=True).inverse
    assert found is not None
    assert found.is_right
    assert 1e-8 < found.error < found.tolerance == 2e-5


def test_a_locked_joint_is_held_and_what_is_left_out_is_not_asked_for() -> None:
    iiwa = symdh.load(ROOT / "tests" / "data" / "tables" / "kuka_iiwa7.yaml")
    locked = (iiwa.variables[2],)
    found = verify(iiwa, "python", generate(iiwa, "python", lock=locked), count=5, lock=locked)
    assert found.inverse is not None
    assert found.inverse.found == 5
    left_out = verify(SCARA, "python", generate(SCARA, "python", ik=False), count=5, ik=False)
    assert left_out.is_right
    assert left_out.inverse is None


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        # A last step after the judge, 1e-8 off, and a branch that is never tried.
        ("return x - (2.0 * planar_ik_PI * turns);", "return (x + 1e-8) - (6.283185 * turns);"),
        ("x->count = 2;", "x->count = 1;"),
    ],
)
def test_wrong_answers_are_found_out(right: str, wrong: str) -> None:
    require_tool("gcc")
    arm = replace(PLANAR, name="planar")
    files = generate(arm, "c")
    changed = [replace(file, text=file.text.replace(right, wrong)) for file in files]
    assert changed != list(files)
    found = verify(arm, "c", changed, count=20)
    assert found.error <= found.tolerance
    assert found.inverse is not None
    assert not found.inverse.is_right
    assert not found.is_right


def test_answers_that_are_not_printed_are_missed(monkeypatch: pytest.MonkeyPatch) -> None:
    given = CheckProgram((), ((sys.executable, "-c", "print('1 ' * 16)"),))
    monkeypatch.setattr(python, "check_program", lambda *arguments: given)
    with pytest.raises(OutputError, match="did not print its answers"):
        verify(ONE, "python", (), count=1)


def test_nan_is_not_right(monkeypatch: pytest.MonkeyPatch) -> None:
    prints_nan = CheckProgram((), ((sys.executable, "-c", "print('nan ' * 16)"),))
    monkeypatch.setattr(python, "check_program", lambda *arguments: prints_nan)
    assert not verify(ONE, "python", (), count=1, ik=False).is_right


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("raise SystemExit('no such thing')", "no such thing"),
        ("print('1 2 3')", "did not print its poses"),
    ],
)
def test_code_that_does_not_run_is_reported(
    program: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = CheckProgram((), ((sys.executable, "-c", program),))
    monkeypatch.setattr(python, "check_program", lambda *arguments: given)
    with pytest.raises(OutputError, match=message):
        verify(ONE, "python", (), count=1)


def test_code_that_does_not_end_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    given = CheckProgram((), ((sys.executable, "-c", "import time; time.sleep(60)"),))
    monkeypatch.setattr(python, "check_program", lambda *arguments: given)
    monkeypatch.setattr(verification, "_TIME_LIMIT", 0.5)
    with pytest.raises(LimitError):
        verify(ONE, "python", (), count=1)


def test_poses_stay_within_the_limits_and_are_the_same_each_time() -> None:
    poses = random_poses(SCARA, 200)
    assert poses == random_poses(SCARA, 200)
    assert all(0 <= row[2] <= 0.15 for row in poses.joints)
    assert max(abs(row[1]) for row in poses.joints) > 2.5


def test_the_command_says_how_exact_the_code_is(run_symdh: Runner) -> None:
    require_tool("gcc")
    ran = run_symdh("code", SCARA_TABLE, "--target", "c", "--target", "python", "--verify")
    assert ran.returncode == 0
    lines = ran.stdout.splitlines()
    assert [line.split(":")[0] for line in lines] == ["python", "python", "c", "c"]
    assert all("100 poses" in line and line.endswith(": right") for line in lines)
    assert all("ik found the joints of 100 of 100 poses again; 200" in line for line in lines[1::2])


def test_the_command_says_which_compiler_is_missing(tmp_path: Path, run_symdh: Runner) -> None:
    ran = run_symdh(
        "code", SCARA_TABLE, "--target", "c", "--verify", env={"PATH": str(tmp_path / "nothing")}
    )
    assert ran.returncode == 3
    assert "cc or gcc or clang is not installed" in ran.stderr
    assert (tmp_path / "scara.c").exists()


def test_a_program_that_is_not_there_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    given = CheckProgram((), (("/nowhere/compiler",),))
    monkeypatch.setattr(python, "check_program", lambda *arguments: given)
    with pytest.raises(OutputError, match="cannot verify: compiler: No such file or directory"):
        verify(ONE, "python", (), count=1)


def test_answers_that_are_nan_are_not_right(monkeypatch: pytest.MonkeyPatch) -> None:
    """The one joint at any angle has a pose that is right here; the answer to it is none."""
    joints = random_poses(ONE, 1, is_single=False).joints[0]
    c, s = math.cos(joints[0]), math.sin(joints[0])
    pose = [c, -s, 0, 2 * c, s, c, 0, 2 * s, 0, 0, 1, 0, 0, 0, 0, 1]
    printed = f"{' '.join(map(repr, pose))}\nik nan"
    given = CheckProgram((), ((sys.executable, "-c", f"print({printed!r})"),))
    monkeypatch.setattr(python, "check_program", lambda *arguments: given)
    found = verify(ONE, "python", (), count=1)
    assert found.error <= found.tolerance
    assert found.inverse is not None
    assert math.isnan(found.inverse.error)
    assert (found.inverse.found, found.inverse.is_right, found.is_right) == (0, False, False)


def test_a_length_that_is_no_real_number_cannot_be_verified() -> None:
    arm = Robot("arm", STANDARD, (revolute(Q1, a=sqrt(L1)),))
    assert ExactChain(arm, {L1: 4.0}).lengths == 2
    with pytest.raises(UnsupportedError, match="has no value to verify with"):
        ExactChain(arm, {L1: -4.0})


def test_a_miss_is_a_part_of_the_reach() -> None:
    """The same arm in metres and in millimetres; the position counts beside the orientation."""
    metres = (ROOT / "tests" / "data" / "tables" / "puma560.yaml").read_text()
    numbers = re.compile(r"(?<=: )0\.\d+")
    millimetres = numbers.sub(lambda found: str(1000 * float(found[0])), metres)
    right, off = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], [0.1 + 1e-3, 0.2, 0.3, 0.4, 0.5, 0.6]
    errors = []
    for text in (metres, millimetres):
        robot = symdh.loads(text)
        plan = inverse_program(robot, None, ())
        assert isinstance(plan, Program)
        exact = ExactChain(robot, {})
        errors.append(judged(plan, exact, [right], [off], is_single=False).error)
    assert math.isclose(*errors, rel_tol=1e-9)
    assert 1e-4 < errors[0] < 2e-3


def test_a_check_passes_what_the_pose_calls_beyond_the_jacobian() -> None:
    """The root is in the base alone: the pose has it, no column of the Jacobian."""
    require_language("rust")
    robot = replace(ONE, base=(translation(Axis.Z, sqrt(L1)),))
    assert verify(robot, "rust", generate(robot, "rust"), count=3).is_right
