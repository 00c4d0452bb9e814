"""Generated inverse kinematics in JavaScript, MATLAB and Julia.

node and Octave run it; the oracle judges the answers, and generated Python says how many there are.
Julia's text is run by a small interpreter of ours, where a parser of Julia is installed; Julia
itself has never run it.
"""

from __future__ import annotations

import functools
import math
import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from generated import import_generated
from inverse_code import FLOATS, Loaded, load
from inverse_script import LANGUAGES, Reply, Request, octave, run, write
from julia_subset import JuliaError, Module, julia_parser
from oracle import read_arm_file
from sympy import Symbol

import symdh
from symdh.codegen import GeneratedFile, generate
from symdh.codegen.inverse.script import filled
from symdh.robot import Robot
from tools import find_tool, new_folder, require_tool

DATA = Path(__file__).parent / "data"
TABLES = {path.stem: path for path in sorted((DATA / "tables").glob("*.yaml"))}
INDEX = {entry["name"]: entry for entry in yaml.safe_load((DATA / "index.yaml").read_text())}
#: An arm with seven joints has a closed form with one of them locked.
CLOSED = [
    name for name in TABLES if INDEX[name]["expect"]["closed_form"] and INDEX[name]["dof"] < 7
]
OPEN = [name for name in TABLES if name not in CLOSED]
#: Every kind of equation, slides, a wrist without lengths, arms with two to six joints.
FEW = ["puma560", "ikbt_ArmRobo", "spherical_rrp", "scara_rrpr", "zyz_wrist", "planar_2r"]
#: SYMDH_IK_TABLES=all runs every arm with a closed form, SYMDH_IK_POSES more poses of each.
CHOSEN = CLOSED if os.environ.get("SYMDH_IK_TABLES") == "all" else FEW
POSES = int(os.environ.get("SYMDH_IK_POSES", "20"))

PLANAR = """
name: planar
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0.5, alpha: 0}
  - {theta: theta2, d: 0, a: 0.3, alpha: 0}
"""
#: Two values of the slide from A q^2 + B q + C = 0, which no table of the corpus needs.
SQUARE = """
name: square
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.2, a: 0, alpha: 50 deg}
  - {theta: 90 deg, d: q2, a: 0, alpha: 180 deg}
  - {theta: theta3, d: 0, a: 0.3, alpha: 50 deg}
"""
#: Symbols without values, one of them called like a word of every language's; base and tool.
SYMBOLIC = """
name: symbolic
convention: modified
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: end, a: 0, alpha: 0}
  - {theta: theta2, d: 0, a: seed, alpha: 90 deg}
  - {theta: 90 deg - theta3, d: 0, a: goal, alpha: 0}
base: [Tz(0.2), Rx(30 deg)]
tool: [Tx(length)]
values: {seed: 0.15}
"""
TURNTABLE = """
name: turntable
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.1, a: 0.4, alpha: 0}
"""

in_each_language = pytest.mark.parametrize("language", LANGUAGES)
TARGETS = tuple(LANGUAGES)
in_each_target = pytest.mark.parametrize("target", TARGETS)


@functools.cache
def loaded(name: str) -> Loaded:
    return load(TABLES[name], new_folder(name))


@functools.cache
def written(
    language: str, table: str, locked: tuple[str, ...] = ()
) -> tuple[Path, Robot, tuple[GeneratedFile, ...]]:
    """A folder with the files of a table: the name of one of the corpus, or the text of another."""
    robot = symdh.load(TABLES[table]) if table in TABLES else symdh.loads(table)
    options: dict[str, object] = {"lock": tuple(Symbol(name, real=True) for name in locked)}
    files = generate(robot, language, **(options if locked else {}))
    folder = new_folder(robot.name)
    write(files, folder)
    return folder, robot, files


def ask(
    language: str,
    table: str,
    requests: Sequence[Request],
    values: dict[str, float] | None = None,
    locked: tuple[str, ...] = (),
) -> list[Reply]:
    folder, robot, _ = written(language, table, locked)
    n = len(robot.variables)
    return LANGUAGES[language](robot.name, folder, n, requests, values or {})


def answers(language: str, table: str, goal: np.ndarray, **wishes: Any) -> np.ndarray:
    """Joint values for one pose."""
    (reply,) = ask(language, table, [Request(goal, **wishes)])
    return reply.q


def planar_pose(q1: float, q2: float) -> np.ndarray:
    """Worked by hand: two links of 0.5 and 0.3 in a plane."""
    pose = np.eye(4)
    pose[:2, 3] = (
        0.5 * math.cos(q1) + 0.3 * math.cos(q1 + q2),
        0.5 * math.sin(q1) + 0.3 * math.sin(q1 + q2),
    )
    return pose


def test_a_comment_is_broken_between_words_alone() -> None:
    text = "word " * 18 + "left-handed " + "x" * 120 + " end"
    lines = filled(text, "# ", "#   ").splitlines()
    assert lines == ["# " + "word " * 17 + "word", "#   left-handed", "#   " + "x" * 120, "#   end"]


# ------------------------------------------------------------------------------- random poses


@in_each_language
@pytest.mark.parametrize("name", CHOSEN)
def test_the_joint_values_are_found_again_and_nothing_false(name: str, language: str) -> None:
    arm = loaded(name)
    q = arm.arm.seeded_poses(POSES, seed=3)
    goals = arm.pose(q)
    requests = [Request(goal, own) for goal, own in zip(goals, q, strict=True)]
    for reply, own, goal in zip(ask(language, name, requests), q, goals, strict=True):
        assert arm.apart(reply.q[0], own) < 1e-6
        assert arm.missed_by(reply.q, goal) <= 1e-9
        in_python = arm.python.ik(goal, seed=own, **arm.values)
        assert len(reply.q) == len(in_python)
        for answer in reply.q:
            assert arm.apart(in_python, answer).min() < 1e-6
        assert not reply.free.any()


@in_each_language
@pytest.mark.parametrize(("name", "joint"), [("kuka_iiwa7", "theta3"), ("franka_panda", "theta7")])
def test_a_locked_joint_keeps_the_value_of_the_seed(name: str, joint: str, language: str) -> None:
    arm = load(TABLES[name], new_folder(name), [joint])
    place = int(joint[-1]) - 1
    q = arm.arm.seeded_poses(8, seed=12)
    goals = arm.pose(q)
    requests = [Request(goal, own) for goal, own in zip(goals, q, strict=True)]
    replies = ask(language, name, requests, locked=(joint,))
    for reply, own, goal in zip(replies, q, goals, strict=True):
        assert arm.apart(reply.q[0], own) < 1e-6
        assert np.allclose(reply.q[:, place], own[place])
        assert arm.missed_by(reply.q, goal) <= 1e-9
        assert len(reply.q) == len(arm.c(goal, own)[0])


@in_each_language
def test_a_square_equation_has_both_values(language: str, tmp_path: Path) -> None:
    assert_answers_like_python(language, SQUARE, {}, tmp_path)


@in_each_language
def test_symbols_without_values_base_and_tool(language: str, tmp_path: Path) -> None:
    values = {"end": 0.4, "seed": 0.15, "goal": 0.5, "length": 0.3}
    assert_answers_like_python(language, SYMBOLIC, values, tmp_path)


@in_each_language
def test_one_joint(language: str, tmp_path: Path) -> None:
    assert_answers_like_python(language, TURNTABLE, {}, tmp_path)


def assert_answers_like_python(
    language: str, text: str, values: dict[str, float], folder: Path
) -> None:
    """Compare with the oracle and with Python; `values` are for all parameters, table's or not."""
    (folder / "arm.yaml").write_text(text, encoding="utf-8")
    arm = read_arm_file(folder / "arm.yaml")
    module = import_generated(generate(symdh.loads(text), "python"), folder)
    q = arm.seeded_poses(8, seed=21)
    named = {name: q[:, k] for k, (name, _) in enumerate(arm.variables)}
    named |= {name: np.full(len(q), value) for name, value in values.items()}
    goals = np.asarray(arm.pose(named, arithmetic=FLOATS), dtype=float)
    requests = [Request(goal, own) for goal, own in zip(goals, q, strict=True)]
    given = {called(language, name): x for name, x in values.items()}
    in_python = {called("python", name): x for name, x in values.items()}
    for reply, own, goal in zip(ask(language, text, requests, given), q, goals, strict=True):
        assert np.allclose(reply.q[0], own, atol=1e-6)
        assert np.allclose(reply.q, module.ik(goal, seed=own, **in_python), atol=1e-6)


#: What a language calls parameters whose names it has for itself.
RENAMED = {
    "matlab": {"end", "goal"},
    "python": {"seed"},
    "javascript": {"seed", "goal"},
    "julia": {"end", "seed", "goal", "length"},
}


def called(language: str, name: str) -> str:
    return f"{name}_" if name in RENAMED[language] else name


# -------------------------------------------------------------------------------- singular poses


@in_each_language
def test_poses_of_right_angles_have_answers(language: str) -> None:
    """Every joint at a multiple of 90 degrees: wrists straight, elbows stretched, all at once."""
    drawn = np.random.default_rng(9)
    tried = good = 0
    for name in ("puma560", "ur5", *FEW[1:]):
        arm = loaded(name)
        q = arm.arm.seeded_poses(POSES, seed=8)
        q = np.where(arm.turns, drawn.integers(-2, 3, q.shape) * np.pi / 2, q)
        goals = arm.pose(q)
        for reply, goal in zip(ask(language, name, list(map(Request, goals))), goals, strict=True):
            tried += 1
            good += len(reply.q) > 0 and arm.missed_by(reply.q, goal) <= 1e-9
    assert good >= 0.99 * tried


@in_each_language
def test_poses_at_and_beside_a_singularity_have_answers(language: str) -> None:
    """Each joint in turn at 0 and at 90 degrees, and a little beside it."""
    tried = good = 0
    for name in ("puma560", "stanford_textbook", "minimover_5r"):
        arm = loaded(name)
        poses = []
        for joint in np.flatnonzero(arm.turns):
            for angle in (0.0, 1e-7, 1e-13, np.pi / 2, np.pi / 2 + 1e-7):
                q = arm.arm.seeded_poses(2, seed=int(joint))
                q[:, joint] = angle
                poses.append(q)
        goals = arm.pose(np.concatenate(poses))
        for reply, goal in zip(ask(language, name, list(map(Request, goals))), goals, strict=True):
            tried += 1
            good += len(reply.q) > 0 and arm.missed_by(reply.q, goal) <= 1e-9
    assert good >= 0.99 * tried


@in_each_language
def test_a_free_joint_has_the_value_of_the_seed_and_is_reported(language: str) -> None:
    """With theta5 = 0 joints 4 and 6 of a PUMA turn about one line: one of them is free."""
    arm = loaded("puma560")
    (goal,) = arm.pose(np.array([[0.3, -0.5, 0.7, 0.2, 0.0, 0.4]]))
    (reply,) = ask(language, "puma560", [Request(goal, [0.0, 0.0, 0.0, 1.25, 0.0, 0.0])])
    is_free = reply.free[:, 3]
    assert is_free.any()
    assert not reply.free[:, [0, 1, 2, 4, 5]].any()
    assert np.allclose(reply.q[is_free, 3], 1.25, atol=1e-12)
    # Joints 4 and 6 together turn as they did.
    assert np.isclose(reply.q[:, 3] + reply.q[:, 5], 0.6).any()


# ------------------------------------------------------------------------------ small and by hand


@in_each_language
def test_two_links_have_the_two_answers_worked_by_hand(language: str) -> None:
    """At (0.5, 0.3): theta2 = +-90 degrees; the elbow at (0.5, 0) or its mirror image."""
    pose = np.eye(4)
    pose[:2, 3] = 0.5, 0.3
    mirrored = 2 * math.atan2(0.3, 0.5)
    wanted = sorted([(0.0, math.pi / 2), (mirrored, -math.pi / 2)])
    assert np.allclose(sorted(map(tuple, answers(language, PLANAR, pose))), wanted, atol=1e-12)


@in_each_language
def test_the_boundary_has_one_answer_and_beyond_it_there_is_none(language: str) -> None:
    reaches = {0.8: 1, 0.8 * (1 + 1e-13): 1, 0.801: 0, 0.2: 1, 0.199: 0}
    poses = []
    for reach in reaches:
        pose = np.eye(4)
        pose[:2, 3] = reach * math.cos(0.7), reach * math.sin(0.7)
        poses.append(Request(pose))
    replies = ask(language, PLANAR, poses)
    assert [len(reply.q) for reply in replies] == list(reaches.values())


@in_each_language
def test_what_is_no_number_has_no_answer(language: str) -> None:
    for name in ("puma560", "planar_2r", "zyz_wrist"):
        arm = loaded(name)
        (goal,) = arm.pose(arm.arm.seeded_poses(1, seed=1))
        places = [(axis, 3) for axis in arm.axes] + ([(0, 0), (2, 1)] * arm.with_orientation)
        requests = []
        for place in places:
            for bad in (math.nan, math.inf, -math.inf, 1e300):
                spoilt = goal.copy()
                spoilt[place] = bad
                requests.append(Request(spoilt))
        assert all(len(reply.q) == 0 for reply in ask(language, name, requests))


@in_each_language
def test_entries_that_the_task_does_not_give_are_not_read(language: str) -> None:
    pose = planar_pose(0.3, 0.9)
    pose[:3, :3] = math.nan
    pose[2, 3] = math.inf
    pose[3] = 7.0
    assert len(answers(language, PLANAR, pose)) == 2


@in_each_language
def test_a_rotation_that_is_a_little_off_is_mended_and_none_is_refused(language: str) -> None:
    arm = loaded("puma560")
    (goal,) = arm.pose(arm.arm.seeded_poses(1, seed=4))
    rough = np.asarray(goal, dtype=np.float32).astype(float)
    stretched, mirrored = (goal @ np.diag([1.0, 1.0, z, 1.0]) for z in (1.1, -1.0))
    whole, mended, *refused = ask(
        language, "puma560", list(map(Request, (goal, rough, stretched, mirrored)))
    )
    assert len(whole.q) == len(mended.q) == 8
    assert arm.missed_by(mended.q, goal) < 1e-6
    assert [len(reply.q) for reply in refused] == [0, 0]


@in_each_language
def test_the_answer_nearest_to_the_seed_comes_first(language: str) -> None:
    for name in ("puma560", "scara_rrpr"):
        arm = loaded(name)
        q = arm.arm.seeded_poses(4, seed=6)
        requests = [Request(goal, own) for goal, own in zip(arm.pose(q), q, strict=True)]
        for reply, own in zip(ask(language, name, requests), q, strict=True):
            moved = reply.q - own
            moved = np.where(arm.turns, np.mod(moved + np.pi, 2 * np.pi) - np.pi, moved)
            moved[:, ~arm.turns] /= arm.reach
            assert (np.diff(np.linalg.norm(moved, axis=1)) >= -1e-9).all()


@in_each_language
def test_without_a_seed_the_order_is_that_of_the_branches(language: str) -> None:
    arm = loaded("puma560")
    (goal,) = arm.pose(arm.arm.seeded_poses(1, seed=4))
    found = answers(language, "puma560", goal)
    assert np.allclose(found, arm.python.ik(goal, **arm.values), atol=1e-9)


@in_each_language
def test_limits_move_angles_by_full_turns_and_part_the_answers(language: str) -> None:
    text = PLANAR + "limits: {theta1: [90 deg, 400 deg], theta2: [0, 180 deg]}\n"
    pose = planar_pose(math.radians(-80), math.radians(40))
    whole, within = ask(language, text, [Request(pose), Request(pose, limits=True)])
    # -80 and, mirrored, elbow first: both shoulders lie in the limits a full turn further.
    assert len(whole.q) == 2
    assert (whole.q[:, 0] >= math.pi / 2).all()
    assert np.isclose(whole.q[:, 0], math.radians(280)).any()
    assert np.allclose(within.q, [[math.radians(280), math.radians(40)]])
    assert within.free.shape == (1, 2)


# ----------------------------------------------------------------------------------- each language


def test_javascript_says_what_is_wrong() -> None:
    folder, _, _ = written("javascript", SYMBOLIC)
    script = """\
import { fk, ik, JOINT_LIMITS } from "./symbolic.mjs";
const I = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
const given = { end: 1, goal_: 1, length: 1 };
const tell = (call) => { try { return call(); } catch (e) { return `${e}`; } };
console.log(tell(() => ik(I.slice(1), given)));
console.log(tell(() => ik([[1], [2], [3], [4]], given)));
console.log(tell(() => ik(I, { ...given, seed: [1, 2] })));
console.log(tell(() => ik(I)));
const rows = fk([0.1, 0.2, 0.3], given).map((row) => Float64Array.from(row));
const [q] = ik(rows, { ...given, seed: Float64Array.of(0.1, 0.2, 0.3) });
console.log(q.map((x) => x.toFixed(3)).join(" "));
console.log(JOINT_LIMITS.length);
"""
    (folder / "wrong.mjs").write_text(script, encoding="utf-8")
    assert run([require_tool("node"), "wrong.mjs"], folder).splitlines() == [
        "RangeError: T must be 4 rows of 4 numbers",
        "RangeError: T must be 4 rows of 4 numbers",
        "RangeError: seed must hold 3 numbers, not 2",
        "TypeError: the table has no value for end: give one, ik(T, { end: 1 })",
        "0.100 0.200 0.300",
        "3",
    ]


def test_matlab_says_what_is_wrong_and_has_help() -> None:
    folder, _, _ = written("matlab", SYMBOLIC)
    output = octave(
        """\
1;
function tell(call)
  try
    call();
  catch problem
    printf('%s | %s\\n', problem.identifier, problem.message);
  end
end
p = struct('end_', 1, 'goal_', 1, 'length', 1);
tell(@() symbolic_ik(eye(3), [], false, p));
tell(@() symbolic_ik(eye(4), [1, 2], false, p));
tell(@() symbolic_ik(eye(4)));
q = symbolic_ik(symbolic_fk([0.1, 0.2, 0.3], p), [0.1; 0.2; 0.3], false, p);
printf('%.3f ', q(1, :));
printf('\\n%s', get_help_text('symbolic_ik'));
""",
        folder,
    )
    first, second, third, fourth, *text = output.splitlines()
    assert first == "symbolic_ik:size | T must be 4 x 4"
    assert second == "symbolic_ik:size | seed must hold 3 numbers, not 2"
    assert third == "symbolic_ik:parameter | the table has no value for p.end_: set it"
    assert fourth.split() == ["0.100", "0.200", "0.300"]
    shown = "\n".join(text)
    assert shown.startswith("SYMBOLIC_IK  Inverse kinematics of symbolic: all joint values")
    assert "p.end_  must be set  (end of the table)" in shown
    example = re.search(r"Example:\n\n((?:       .*\n?)+)", shown)
    assert example is not None
    assert "q =" in octave(example[1], folder)


TYPED = """\
import { fk, ik, ik_free, JOINT_LIMITS, Joints, Pose } from "./symbolic.mjs";
const T: Pose = fk([0, 0, 0], { end: 1, goal_: 1, length: 1 });
const answers: Joints[] = ik(T, { end: 1, goal_: 1, length: 1, seed: [0, 0, 0], limits: true });
const { q, free } = ik_free([new Float64Array(4)], { end: 1, goal_: 1, length: 1, seed_: 2 });
const first: [number, number, number] = q[0];
const whether: boolean = free[0][2];
const low: number = JOINT_LIMITS[0][0];
// @ts-expect-error: the table has no value for end
ik(T, { goal_: 1, length: 1 });
// @ts-expect-error: so it has none at all
ik(T);
// @ts-expect-error: no such option
ik(T, { end: 1, goal_: 1, length: 1, nearest: true });
export { answers, first, whether, low };
"""


def test_typescript_accepts_what_is_right_and_nothing_else() -> None:
    compiler = find_tool("tsc")
    folder, _, _ = written("javascript", SYMBOLIC)
    (folder / "typed.mts").write_text(TYPED, encoding="utf-8")
    strict = ["--strict", "--noEmit", "--target", "es2022", "--module", "nodenext"]
    run([compiler, *strict, "typed.mts"], folder)


@pytest.mark.parametrize("name", ["puma560", "scara_rrpr", "zyz_wrist"])
def test_typescript_accepts_the_modules_themselves(name: str) -> None:
    """What its comments declare is what the code does, and ECMAScript 2016 is enough for it."""
    compiler = find_tool("tsc")
    _, _, (module, _) = written("javascript", name)
    bare = new_folder(name)
    (bare / module.name).write_text(module.text, encoding="utf-8")
    options = ["--noEmit", "--checkJs", "--strict", "false", "--target", "es2016"]
    run([compiler, *options, "--lib", "es2016", "--module", "es2015", module.name], bare)


def test_julia_says_what_is_wrong() -> None:
    _, _, (file,) = written("julia", SYMBOLIC)
    module = Module(julia_parser(), file.text)
    given = {"end_": 1.0, "goal_": 1.0, "length_": 1.0}
    with pytest.raises(JuliaError, match=r"T must be 4 x 4, not \(3, 3\)"):
        module.call("ik", np.eye(3), **given)
    with pytest.raises(JuliaError, match="seed must hold 3 numbers, not 2"):
        module.call("ik", np.eye(4), seed=np.zeros(2), **given)
    with pytest.raises(JuliaError, match="keyword end_ is not given"):
        module.call("ik", np.eye(4))
    with pytest.raises(JuliaError, match="no keyword nearest"):
        module.call("ik", np.eye(4), nearest=1.0, **given)
    T = module.call("fk", np.array([0.1, 0.2, 0.3]), **given)
    answers = module.call("ik", T, seed=np.array([0.1, 0.2, 0.3]), **given)
    assert np.allclose(answers[0], [0.1, 0.2, 0.3])


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("return q[0]", "index 0 of 3"),
        ("return q[4]", "index 4 of 3"),
        ("return zeros(3, 4)[4, 1]", "index 4 of 3"),
        ("return r[1]", "r is not defined"),
        ("for k in 1:3\n s = k\n end\n return s", "s is not defined"),
        ("if length(q)\n return q\n end", "must be a Bool"),
        ("return f(q, q)", "f takes 1 arguments"),
        ("return sqrt(q[1] - 2.0)", "DomainError"),
        ("return cos(q[1] / 0.0)", "DomainError"),
        ("return [1.0, 2.0] * q", "another thing"),
    ],
)
def test_the_interpreter_of_julia_refuses_what_julia_refuses(body: str, message: str) -> None:
    module = Module(julia_parser(), f"module M\nfunction f(q)\n {body}\n end\nend\n")
    with pytest.raises(JuliaError, match=message):
        module.call("f", np.array([1.0, 2.0, 3.0]))


# ------------------------------------------------------------------------------ the text of it


@in_each_target
@pytest.mark.parametrize("name", OPEN)
def test_without_a_closed_form_the_head_says_why(name: str, target: str) -> None:
    files = generate(symdh.load(TABLES[name]), target)
    assert not any(re.search(r"\bik(_free)?\(", file.text) for file in files)
    assert not any(file.name.endswith("_ik.m") for file in files)
    head = " ".join(files[0].text[:4000].replace("%", " ").replace(" *", " ").split())
    assert "No inverse kinematics: " in head
    if INDEX[name]["dof"] == 7:
        assert "7 joints move" in head


@in_each_target
@pytest.mark.parametrize("name", ["planar_2r", "kuka_iiwa7"])
def test_it_may_be_left_out_and_the_head_says_so(name: str, target: str) -> None:
    robot = symdh.load(TABLES[name])
    files = generate(robot, target, ik=False)
    for file in files:
        text = file.text.replace("No inverse kinematics: it was left out, as asked.", "")
        assert not re.search(r"\bik|inverse", text, re.IGNORECASE)
    assert "it was left out, as asked." in files[0].text
    forward = [file.name for file in generate(robot, target) if not file.name.endswith("_ik.m")]
    assert [file.name for file in files] == forward


@in_each_target
@pytest.mark.parametrize("name", ["puma560", "pieper_generic", "stanford_textbook", "zyz_wrist"])
def test_lines_are_short_and_the_text_is_always_the_same(name: str, target: str) -> None:
    robot = symdh.load(TABLES[name])
    files = generate(robot, target)
    assert files == generate(robot, target)
    for file in files:
        assert file.text.isascii()
        assert file.text.endswith("\n")
        assert not re.search(r"[ \t]$", file.text, re.MULTILINE)
        assert "\n\n\n" not in file.text
        long = [line for line in inverse_part(file).splitlines() if len(line) > 100]
        assert long == []


def inverse_part(file: GeneratedFile) -> str:
    if file.name.endswith(".m"):
        return file.text if file.name.endswith("_ik.m") else ""
    return file.text[file.text.rindex("limit of each joint variable") :]
