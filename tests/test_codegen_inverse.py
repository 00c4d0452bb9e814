"""Generated inverse kinematics: compiled, imported, run, and judged by the oracle's poses."""

from __future__ import annotations

import functools
import math
import os
import re
import subprocess
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from conftest import Runner
from generated import STRICT_C, import_generated
from inverse_checks import hard_poses
from inverse_code import Loaded, compile_inverse, load
from sympy import Float, Rational, Symbol

import symdh
from symdh.codegen import TARGETS, GeneratedFile, Target, generate
from symdh.codegen.graph import Graph
from symdh.codegen.inverse import found as search
from symdh.codegen.inverse.breaking import Layout, broken, broken_value
from symdh.codegen.inverse.found import Missing
from symdh.codegen.inverse.lowering import inverse_program
from symdh.codegen.inverse.polynomials import Polynomials
from symdh.codegen.inverse.program import Compute, Kind, Program, Propose, Solve
from symdh.codegen.inverse.steps import KINDS, lower_steps
from symdh.codegen.inverse.trigonometric import Trigonometry
from symdh.derivation.inverse.steps import RULES
from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.inverse import inverse_kinematics
from symdh.kinematics.inverse.solution import Rule
from symdh.templating.catalogue import shipped
from tools import new_folder, require_tool

DATA = Path(__file__).parent / "data"
TABLES = sorted((DATA / "tables").glob("*.yaml"))
INDEX = {entry["name"]: entry for entry in yaml.safe_load((DATA / "index.yaml").read_text())}
#: An arm with seven joints has a closed form with one of them locked.
CLOSED = [
    path
    for path in TABLES
    if INDEX[path.stem]["expect"]["closed_form"] and INDEX[path.stem]["dof"] < 7
]
OPEN = [path for path in TABLES if path not in CLOSED]
#: Random poses of each table; SYMDH_IK_POSES asks for more.
POSES = int(os.environ.get("SYMDH_IK_POSES", "40"))
FEW = max(3, POSES // 100)
#: Hard poses of each kind; tests/check_singular.py tries more.
HARD = 10

PLANAR = """
name: planar
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0.5, alpha: 0}
  - {theta: theta2, d: 0, a: 0.3, alpha: 0}
"""

each_closed = pytest.mark.parametrize("table", CLOSED, ids=lambda path: path.stem)


@functools.cache
def loaded(table: Path) -> Loaded:
    return load(table, new_folder(table.stem))


def table_named(name: str) -> Path:
    return DATA / "tables" / f"{name}.yaml"


def planar(folder: Path, text: str = PLANAR) -> tuple[Any, Any]:
    """`planar_ik` and the module of a table, which moves two joints."""
    robot = symdh.loads(text)
    header, source = generate(robot, "c")
    return compile_inverse(header, source, folder, 2), import_generated(
        generate(robot, "python"), folder
    )


@pytest.mark.parametrize(("name", "joint"), [("kuka_iiwa7", "theta3"), ("franka_panda", "theta7")])
def test_a_locked_joint_keeps_the_value_of_the_seed(name: str, joint: str, tmp_path: Path) -> None:
    arm = load(table_named(name), tmp_path, [joint])
    place = int(joint[-1]) - 1
    q = arm.arm.seeded_poses(POSES, seed=12)
    for k, (own, goal) in enumerate(zip(q, arm.pose(q), strict=True)):
        answers, _ = arm.c(goal, own)
        assert arm.apart(answers[0], own) < 1e-6
        assert np.allclose(answers[:, place], own[place])
        assert arm.missed_by(answers, goal) <= 1e-9
        if k < FEW:
            assert len(arm.python.ik(goal, seed=own)) == len(answers)


def planar_pose(q1: float, q2: float) -> np.ndarray:
    """Worked by hand: two links of 0.5 and 0.3 in a plane."""
    pose = np.eye(4)
    pose[:2, 3] = (
        0.5 * math.cos(q1) + 0.3 * math.cos(q1 + q2),
        0.5 * math.sin(q1) + 0.3 * math.sin(q1 + q2),
    )
    return pose


# ------------------------------------------------------------------------------- random poses


@each_closed
def test_c_finds_the_joint_values_again_and_nothing_false(table: Path) -> None:
    arm = loaded(table)
    q = arm.arm.seeded_poses(POSES, seed=3)
    for own, goal in zip(q, arm.pose(q), strict=True):
        answers, _ = arm.c(goal)
        assert arm.apart(answers, own).min() < 1e-6
        assert arm.missed_by(answers, goal) <= 1e-9


@each_closed
def test_python_and_the_solver_give_as_many_answers_as_c(table: Path) -> None:
    arm = loaded(table)
    robot = symdh.load(table)
    values = {s: Float(arm.values[s.name], 17) for s in robot.parameters if s.name in arm.values}
    solver = inverse_kinematics(robot).solver(values)
    q = arm.arm.seeded_poses(FEW, seed=5)
    for own, goal in zip(q, arm.pose(q), strict=True):
        in_c, _ = arm.c(goal, own)
        in_python = arm.python.ik(goal, seed=own, **arm.values)
        assert len(in_c) == len(in_python) == len(solver.solve(goal))
        assert arm.apart(in_c[0], own) < 1e-6
        assert arm.apart(in_python[0], own) < 1e-6
        assert arm.missed_by(in_python, goal) <= 1e-9
        for answer in in_c:
            assert arm.apart(in_python, answer).min() < 1e-6


# -------------------------------------------------------------------------------- singular poses


def test_poses_of_right_angles_have_answers() -> None:
    """Every joint at a multiple of 90 degrees: wrists straight, elbows stretched, all at once."""
    drawn = np.random.default_rng(9)
    tried = good = 0
    for table in CLOSED:
        arm = loaded(table)
        q = arm.arm.seeded_poses(20, seed=8)
        q = np.where(arm.turns, drawn.integers(-2, 3, q.shape) * np.pi / 2, q)
        for goal in arm.pose(q):
            answers, _ = arm.c(goal)
            tried += 1
            good += len(answers) > 0 and arm.missed_by(answers, goal) <= 1e-9
    assert good >= 0.99 * tried


@pytest.mark.parametrize("size", [0.0, 1e-7, 1e-13])
def test_poses_at_and_beside_a_singularity_have_answers(size: float) -> None:
    """Each joint in turn at 0 and at 90 degrees, and a little beside it."""
    tried = good = 0
    for name in ("puma560", "ur5", "stanford_textbook", "minimover_5r", "kuka_kr5", "elbow_3r"):
        arm = loaded(table_named(name))
        for joint in np.flatnonzero(arm.turns):
            for angle in (0.0, np.pi / 2):
                q = arm.arm.seeded_poses(4, seed=int(joint))
                q[:, joint] = angle + size
                for goal in arm.pose(q):
                    answers, _ = arm.c(goal)
                    tried += 1
                    good += len(answers) > 0 and arm.missed_by(answers, goal) <= 1e-9
    assert good >= 0.99 * tried


@each_closed
def test_hard_poses_of_every_kind_have_answers(table: Path) -> None:
    """Joints at and beside zero, elbows straight and folded, all at right angles."""
    arm = loaded(table)
    tried = good = 0
    for q in hard_poses(table, HARD).values():
        for goal in arm.pose(q):
            answers, _ = arm.c(goal)
            assert arm.missed_by(answers, goal) <= 1e-9
            tried += 1
            good += len(answers) > 0
    assert good >= 0.99 * tried


def test_a_free_joint_takes_another_value_where_the_seed_has_none_that_reaches(
    tmp_path: Path,
) -> None:
    """Poses at which the seed's value of a free joint, and poses beside them, lead nowhere."""
    stretched = np.array([[0, 0, 0.3, 0, np.pi, 0, 0], [-np.pi / 2, 0, 0.3, 0, 0, 0, 0]])
    beside = np.array([[1.59424551, -1.98685208, 0.32810675, -2.30806615, 0.0, -1.63010231]])
    double = np.array([[-0.23539532, -1.65419333, 1e-7, -2.37934481, 1.97207778, 0.18665702]])
    for name, lock, poses in (
        ("kuka_iiwa7", ["theta3"], stretched),
        ("three_parallel_only", [], beside),
        ("ikbt_ArmRobo", [], double),
    ):
        arm = load(table_named(name), tmp_path, lock)
        seed = np.where([name_ in lock for name_, _ in arm.arm.variables], 0.3, 0.0)
        for goal in arm.pose(poses):
            for answers in (arm.c(goal, seed)[0], arm.python.ik(goal, seed=seed)):
                assert len(answers)
                assert arm.missed_by(answers, goal) <= 1e-9


def test_generated_code_does_not_read_what_the_task_does_not_give_of_a_turned_base(
    tmp_path: Path,
) -> None:
    """Two links on a wall: worked by hand as on the floor, with z for y."""
    in_c, in_python = planar(tmp_path, PLANAR + "base: [Rx(90 deg)]\n")
    pose = np.eye(4)
    pose[:3, 3] = 0.5, math.nan, 0.3
    mirrored = 2 * math.atan2(0.3, 0.5)
    wanted = sorted([(0.0, math.pi / 2), (mirrored, -math.pi / 2)])
    assert np.allclose(sorted(map(tuple, in_c(pose)[0])), wanted, atol=1e-12)
    assert np.allclose(sorted(map(tuple, in_python.ik(pose))), wanted, atol=1e-12)


def test_python_rescues_what_c_rescues() -> None:
    arm = loaded(table_named("ur5"))
    quarters = np.array([[1, -2, 0, -1, 2, 2], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]])
    for goal in arm.pose(quarters * np.pi / 2):
        answers = arm.python.ik(goal)
        assert len(answers)
        assert arm.missed_by(answers, goal) <= 1e-9


def test_a_free_joint_has_the_value_of_the_seed_and_is_reported() -> None:
    """With theta5 = 0 joints 4 and 6 of a PUMA turn about one line: one of them is free."""
    arm = loaded(table_named("puma560"))
    q = np.array([[0.3, -0.5, 0.7, 0.2, 0.0, 0.4]])
    (goal,) = arm.pose(q)
    seed = [0.0, 0.0, 0.0, 1.25, 0.0, 0.0]
    in_c, masks = arm.c(goal, seed)
    in_python, free = arm.python.ik_free(goal, seed=seed, **arm.values)
    assert any(mask == 1 << 3 for mask in masks)
    for answer, mask in zip(in_c, masks, strict=True):
        if mask >> 3 & 1:
            assert answer[3] == pytest.approx(1.25, abs=1e-12)
    assert free.shape == in_python.shape
    assert np.allclose(in_python[free[:, 3], 3], 1.25)
    # Joints 4 and 6 together turn as they did.
    assert np.isclose(in_c[:, 3] + in_c[:, 5], 0.6).any()


def test_answers_away_from_singularities_have_no_free_joint() -> None:
    arm = loaded(table_named("puma560"))
    q = arm.arm.seeded_poses(5, seed=2)
    assert all(mask == 0 for goal in arm.pose(q) for mask in arm.c(goal)[1])


# ------------------------------------------------------------------------------ small and by hand


def test_two_links_have_the_two_answers_worked_by_hand(tmp_path: Path) -> None:
    """At (0.5, 0.3): theta2 = +-90 degrees; the elbow at (0.5, 0) or its mirror image."""
    pose = np.eye(4)
    pose[:2, 3] = 0.5, 0.3
    mirrored = 2 * math.atan2(0.3, 0.5)
    wanted = sorted([(0.0, math.pi / 2), (mirrored, -math.pi / 2)])
    in_c, in_python = planar(tmp_path)
    assert np.allclose(sorted(map(tuple, in_c(pose)[0])), wanted, atol=1e-12)
    assert np.allclose(sorted(map(tuple, in_python.ik(pose))), wanted, atol=1e-12)


def test_the_boundary_has_one_answer_and_beyond_it_there_is_none(tmp_path: Path) -> None:
    in_c, in_python = planar(tmp_path)
    for reach, count in ((0.8, 1), (0.8 * (1 + 1e-13), 1), (0.801, 0), (0.2, 1), (0.199, 0)):
        pose = np.eye(4)
        pose[:2, 3] = reach * math.cos(0.7), reach * math.sin(0.7)
        assert len(in_c(pose)[0]) == len(in_python.ik(pose)) == count, reach


def test_beside_the_boundary_both_answers_are_right(tmp_path: Path) -> None:
    in_c, _ = planar(tmp_path)
    for bent in (1e-3, 1e-4, 1e-5):
        answers = in_c(planar_pose(0.4, bent))[0]
        assert np.allclose(sorted(answers[:, 1]), [-bent, bent], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300])
def test_what_is_no_number_has_no_answer(bad: float) -> None:
    for name in ("puma560", "planar_2r", "zyz_wrist"):
        arm = loaded(table_named(name))
        (goal,) = arm.pose(arm.arm.seeded_poses(1, seed=1))
        compared = [(axis, 3) for axis in arm.axes]
        compared += [(0, 0), (2, 1)] if arm.with_orientation else []
        for place in compared:
            spoilt = goal.copy()
            spoilt[place] = bad
            assert len(arm.c(spoilt)[0]) == 0
            assert arm.python.ik(spoilt, **arm.values).shape == (0, len(arm.turns))


def test_entries_that_the_task_does_not_give_are_not_read(tmp_path: Path) -> None:
    in_c, in_python = planar(tmp_path)
    pose = planar_pose(0.3, 0.9)
    pose[:3, :3] = math.nan
    pose[2, 3] = math.inf
    pose[3] = 7.0
    assert len(in_c(pose)[0]) == len(in_python.ik(pose)) == 2


def test_a_rotation_that_is_a_little_off_is_mended_and_none_is_refused() -> None:
    arm = loaded(table_named("puma560"))
    (goal,) = arm.pose(arm.arm.seeded_poses(1, seed=4))
    rough = np.asarray(goal, dtype=np.float32).astype(float)
    answers, _ = arm.c(rough)
    assert len(answers) == len(arm.c(goal)[0]) == len(arm.python.ik(rough, **arm.values))
    assert arm.missed_by(answers, goal) < 1e-6
    for spoil in (np.diag([1.0, 1.0, 1.1, 1.0]), np.diag([1.0, 1.0, -1.0, 1.0])):
        assert len(arm.c(goal @ spoil)[0]) == 0
        assert len(arm.python.ik(goal @ spoil, **arm.values)) == 0


def test_the_answer_nearest_to_the_seed_comes_first() -> None:
    for name in ("puma560", "ur5", "scara_rrpr"):
        arm = loaded(table_named(name))
        q = arm.arm.seeded_poses(4, seed=6)
        for own, goal in zip(q, arm.pose(q), strict=True):
            for answers in (arm.c(goal, own)[0], arm.python.ik(goal, seed=own, **arm.values)):
                moved = answers - own
                moved = np.where(arm.turns, np.mod(moved + np.pi, 2 * np.pi) - np.pi, moved)
                moved[:, ~arm.turns] /= arm.reach
                far = np.linalg.norm(moved, axis=1)
                assert (np.diff(far) >= -1e-9).all()


def test_without_a_seed_the_order_is_that_of_the_branches() -> None:
    arm = loaded(table_named("puma560"))
    (goal,) = arm.pose(arm.arm.seeded_poses(1, seed=4))
    assert np.allclose(arm.c(goal)[0], arm.python.ik(goal, **arm.values), atol=1e-9)


def test_limits_move_angles_by_full_turns_and_part_the_answers(tmp_path: Path) -> None:
    text = PLANAR + "limits: {theta1: [90 deg, 400 deg], theta2: [0, 180 deg]}\n"
    in_c, in_python = planar(tmp_path, text)
    pose = planar_pose(math.radians(-80), math.radians(40))
    answers, _ = in_c(pose)
    # -80 and, mirrored, elbow first: both shoulders lie in the limits a full turn further.
    assert len(answers) == 2
    assert (answers[:, 0] >= math.pi / 2).all()
    assert np.isclose(answers[:, 0], math.radians(280)).any()
    assert np.allclose(in_python.ik(pose), answers)
    within = in_python.ik(pose, limits=True)
    assert np.allclose(within, [[math.radians(280), math.radians(40)]])
    import ctypes

    test = ctypes.CDLL(str(tmp_path / "planar.so")).planar_within_limits
    pointer = ctypes.POINTER(ctypes.c_double)
    found = [test(np.ascontiguousarray(q).ctypes.data_as(pointer)) for q in answers]
    assert sorted(found) == [0, 1]


@pytest.mark.parametrize("wrong", [np.eye(3), np.zeros((2, 4, 4)), 1.0])
def test_python_refuses_a_wrong_shape(wrong: Any, tmp_path: Path) -> None:
    _, module = planar(tmp_path)
    with pytest.raises(ValueError, match=r"T must have shape \(4, 4\)"):
        module.ik(wrong)
    with pytest.raises(ValueError, match=r"seed must have shape \(2,\)"):
        module.ik(np.eye(4), seed=[1.0, 2.0, 3.0])


def test_parameters_may_be_called_like_what_the_code_uses_itself(tmp_path: Path) -> None:
    text = PLANAR.replace("a: 0.5", "a: seed").replace("a: 0.3", "a: goal")
    module = import_generated(generate(symdh.loads(text), "python"), tmp_path)
    answers = module.ik(planar_pose(0.2, 0.8), seed_=0.5, goal=0.3)
    assert np.isclose(answers, [0.2, 0.8]).all(axis=1).any()
    header, source = generate(symdh.loads(text.replace("goal", "found")), "c")
    in_c = compile_inverse(header, source, tmp_path, 2, [0.5, 0.3])
    assert np.isclose(in_c(planar_pose(0.2, 0.8))[0], [0.2, 0.8]).all(axis=1).any()


# ---------------------------------------------------------------------------- no closed form


@pytest.mark.parametrize("table", OPEN, ids=lambda path: path.stem)
def test_without_a_closed_form_the_head_says_why(table: Path) -> None:
    robot = symdh.load(table)
    header, source = generate(robot, "c")
    (module,) = generate(robot, "python")
    assert "_ik(" not in header.text + source.text
    assert "def ik" not in module.text
    head = header.text.partition("#ifndef")[0]
    docstring = module.text.partition("import")[0]
    assert "No inverse kinematics: " in head
    assert "No inverse kinematics: " in docstring
    if INDEX[table.stem]["dof"] == 7:
        assert "7 joints move" in head


def test_a_long_arm_is_refused_at_once() -> None:
    rows = "".join(
        f"  - {{theta: q{k}, d: 0.1, a: 0.2, alpha: {90 if k % 2 else -90} deg}}\n"
        for k in range(1, 51)
    )
    robot = symdh.loads(f"name: long_arm\nconvention: standard\njoints:\n{rows}")
    begin = time.process_time()
    missing = inverse_program(robot)
    assert time.process_time() - begin < 1.0
    assert isinstance(missing, search.Missing)


def test_a_search_that_takes_too_long_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search, "SECONDS", 0.0)
    text = PLANAR.replace("0.5", "0.51")
    (module,) = generate(symdh.loads(text), "python")
    assert (
        "No inverse kinematics: the search for a closed form was stopped after 0 s." in module.text
    )


# ------------------------------------------------------------------------------- left out, as asked


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.name)
def test_it_is_left_out_where_nobody_wants_it(
    target: Target, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing but the search and its section go; the rest of the files is the same."""
    robot = symdh.loads(PLANAR.replace("0.5", "0.52"))

    def searched(*arguments: object) -> None:
        raise AssertionError("the closed form was searched")

    monkeypatch.setattr(search, "_searched", searched)
    files = target.generate(robot, ik=False)
    text = "".join(file.text for file in files)
    assert re.search(r"\bik\b|_ik\(|IK", text) is None
    assert "No inverse kinematics: it was left out, as asked." in text
    assert "jacobian" in text


def test_the_commands_leave_it_out(run_symdh: Runner, tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(PLANAR, encoding="utf-8")
    for command in (["code", "--target", "c", "--target", "python"], ["derive"]):
        ran = run_symdh(command[0], "arm.yaml", *command[1:], "-o", command[0], "--no-ik")
        assert ran.returncode == 0, ran.stderr
        for name in ("planar.h", "planar.c", "planar.py"):
            text = (tmp_path / command[0] / name).read_text(encoding="utf-8")
            assert "_ik(" not in text
            assert "def ik" not in text
        ran = run_symdh(command[0], "arm.yaml", *command[1:], "-o", command[0])
        assert "int planar_ik(" in (tmp_path / command[0] / "planar.c").read_text(encoding="utf-8")


def test_nothing_is_held_in_what_is_left_out(run_symdh: Runner, tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(PLANAR, encoding="utf-8")
    ran = run_symdh("code", "arm.yaml", "--target", "c", "--no-ik", "--lock", "theta1")
    assert ran.returncode == 2
    assert "--lock is for the inverse kinematics, which --no-ik leaves out" in ran.stderr


# -------------------------------------------------------------------------------- the program


def programs() -> list[Program]:
    found = []
    for name in ("puma560", "ur5", "stanford_textbook", "scara_rrpr", "ikbt_ArmRobo"):
        robot = symdh.load(table_named(name))
        program = inverse_program(robot, robot.values)
        assert isinstance(program, Program)
        found.append(program)
    return found


def test_loops_are_nested_and_the_last_statement_proposes() -> None:
    for program in programs():
        *before, last = program.statements
        assert isinstance(last, Propose)
        depth = 0
        for statement in before:
            assert statement.depth == depth
            depth += isinstance(statement, Solve) and statement.opens
        assert last.depth == depth


def test_nothing_is_computed_before_what_it_needs() -> None:
    for program in programs():
        there = set(program.goal)
        for statement in program.statements:
            match statement:
                case Compute():
                    for assignment in statement.assignments:
                        assert leaves(assignment.node) <= there
                case Solve():
                    for option in statement.options:
                        for node in (*option.coefficients, *option.scales):
                            assert leaves(node) <= there
                    there |= set(statement.results)
                case Propose():
                    assert all(leaves(node) <= there for node in statement.values)


def test_cosines_have_the_numbers_of_their_joints() -> None:
    form = inverse_kinematics(symdh.load(DATA / "tables" / "puma560.yaml")).form
    assert form is not None
    names = lower_steps(form, {}).names.values()
    cosines = {name for name in names if name.startswith("c")}
    assert cosines == {"c1", "c2", "c3", "c23", "c4", "c5", "c6"}


def test_every_option_names_what_it_writes_twice_and_what_would_be_long() -> None:
    """Also one that only stands by: it names what nobody has computed before its turn."""
    names_of_its_own = 0
    for program in programs():
        there: set[Any] = set()
        for statement in program.statements:
            match statement:
                case Compute():
                    there |= {assignment.node for assignment in statement.assignments}
                case Solve():
                    for option in statement.options:
                        own = [assignment.node for assignment in option.assignments]
                        names_of_its_own += len(own)
                        named = there.union(own)
                        lines = [written(node, named, is_value=True) for node in own]
                        roots = (*option.coefficients, *option.scales)
                        lines += [written(node, named) for node in roots]
                        every = [node for line in lines for node in line]
                        assert len(every) == len(set(every))
                        # A part with five operations has a name: four, an operator, four.
                        assert max(map(len, lines)) <= 9
    assert names_of_its_own > 0


def written(node: Any, named: set[Any], is_value: bool = False) -> list[Any]:
    """Return each operation of a line as often as it stands there; of a name, none."""
    if node.value is not None or (node in named and not is_value):
        return []
    inner = [each for arg in node.args for each in written(arg, named)]
    return inner if node.op.name == "NEG" else [node, *inner]


def leaves(node: Any) -> set[Any]:
    if node.value is not None:
        return set() if node.op.name == "CONSTANT" else {node}
    return set().union(*(leaves(arg) for arg in node.args))


def test_a_statement_is_broken_only_where_it_is_too_long() -> None:
    value = "first + second + " + "x" * 75
    assert len("    " + value + ";") == 97
    for layout in (Layout(), Layout(more=" ...")):
        assert broken(f"{value}yyy;", 1, layout) == f"    {value}yyy;"
    assert broken(f"{value}yyyy;", 1) == f"    first + second\n        {value[15:]}yyyy;"
    assert broken_value("x = ", value[:-2], 1, Layout(end=";")) == f"    x = {value[:-2]};"
    assert broken_value("x = ", value, 1, Layout(end=";")) == f"    x = (\n        {value}\n    );"


def test_long_statements_break_between_arguments_then_at_signs() -> None:
    text = "call(" + ", ".join(f"argument{k} + {k}.0" for k in range(12)) + ");"
    lines = broken(text, 2).split("\n")
    assert all(len(line) <= 100 for line in lines)
    assert all(line.endswith((",", ";")) for line in lines)
    assert " ".join(line.strip() for line in lines) == text
    value = " + ".join(f"term{k}" for k in range(30))
    lines = broken_value("x = ", value, 1).split("\n")
    assert lines[0] == "    x = ("
    assert lines[-1] == "    )"
    assert all(len(line) <= 100 for line in lines)


# ------------------------------------------------------------------------------ the text of it


@pytest.mark.parametrize("name", ["puma560", "ur5", "pieper_generic", "stanford_textbook"])
def test_lines_are_short_and_the_text_is_always_the_same(name: str) -> None:
    robot = symdh.load(table_named(name))
    files = [file for target in ("c", "python") for file in generate(robot, target)]
    again = [file for target in ("c", "python") for file in generate(robot, target)]
    assert files == again
    assert all(len(line) <= 100 for file in files for line in inverse_part(file).split("\n"))


def inverse_part(file: GeneratedFile) -> str:
    return file.text.partition("Inverse kinematics.")[2] or file.text.partition("def ik(")[2]


@pytest.mark.parametrize("name", ["ur5", "ikbt_ArmRobo", "spherical_rrp", "scara_rrpr"])
@pytest.mark.parametrize(
    "command",
    [
        ["g++", "-x", "c++", "-std=c++98", "-pedantic", "-Wno-variadic-macros", "-Wno-long-long"],
        ["g++", "-x", "c++", "-std=c++20", "-Wuseless-cast"],
        ["clang", "-std=c99", "-Wunused-macros", "-Wunused-function", "-Wunreachable-code"],
        ["clang", "-std=c2x", "-Wcomma", "-Wconditional-uninitialized", "-Wcast-align"],
    ],
    ids=["c++98", "c++20", "clang-c99", "clang-c2x"],
)
def test_compilers_accept_it(name: str, command: list[str], tmp_path: Path) -> None:
    program, *flags = command
    for file in generate(symdh.load(table_named(name)), "c"):
        (tmp_path / file.name).write_text(file.text, encoding="utf-8")
    strict = [flag for flag in STRICT_C if program != "clang" or "double" not in flag]
    built = subprocess.run(
        [require_tool(program), *flags, *strict, "-c", f"{name}.c", "-o", "out.o"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stderr


DRIVER = """
#include "{stem}.h"
#include <math.h>
#include <stdio.h>

typedef {real} real;

int main(void)
{{
    static const real hard[] = {{
        0, (real)1e-7, (real)1.5707963267948966, (real)3.141592653589793, (real)1e-300, (real)0.7}};
    static const real wild[] = {{(real)NAN, (real)HUGE_VAL, (real)-HUGE_VAL, (real){huge}}};
    real q[{n}], T[16], J[6 * {n}], answers[{stem}_IK_MAX][{n}];
    unsigned masks[{stem}_IK_MAX];
    int total = 0;
    for (int k = 0; k < 400; ++k) {{
        for (int j = 0; j < {n}; ++j) {{
            q[j] = hard[(k * (j + 3) + k / 7 + j) % 6] * (real)(k % 2 ? 1 : -1);
        }}
        {stem}_fk(q, T);
        total += {stem}_ik(T, k % 3 ? q : 0, answers, k % 5 ? masks : 0);
        T[k % 12] = k % 5 == 4 ? -T[k % 12] : wild[k % 5 % 4];
        total += {stem}_ik(T, 0, answers, masks);
        q[k % {n}] = wild[k % 4];
        total += {stem}_ik(T, q, answers, masks);
        {stem}_fk_jacobian(q, T, J);
        total += {stem}_ik(T, q, answers, masks);
    }}
    printf("%d", total);
    return 0;
}}
"""


@pytest.mark.parametrize(("precision", "huge"), [("double", "1e300"), ("float", "1e30")])
@pytest.mark.parametrize("name", ["ur5", "ikbt_ArmRobo", "stanford_textbook", "pieper_generic"])
def test_sanitizers_have_nothing_to_say(
    name: str, precision: str, huge: str, tmp_path: Path
) -> None:
    """Singular poses, and NaN, infinity and huge numbers in pose, seed and joint values."""
    robot = symdh.load(table_named(name))
    header, source = generate(robot, "c", precision=precision)
    for file in (header, source):
        (tmp_path / file.name).write_text(file.text, encoding="utf-8")
    stem, n = source.name.removesuffix(".c"), len(robot.variables)
    driver = DRIVER.format(stem=stem, n=n, real=precision, huge=huge)
    (tmp_path / "driver.c").write_text(driver, encoding="utf-8")
    sanitized = "-fsanitize=address,undefined,float-divide-by-zero"
    built = subprocess.run(
        [
            *(require_tool("gcc"), "-std=c99", "-g", "-O1", sanitized, "-fno-sanitize-recover=all"),
            *("driver.c", source.name, "-o", "driver", "-lm"),
        ],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stderr
    ran = subprocess.run([tmp_path / "driver"], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert int(ran.stdout) > 400


# ------------------------------------------------------------------------------- nothing forgotten


def test_every_rule_is_told_and_becomes_code() -> None:
    finding = set(Rule) - {Rule.NAMES, Rule.SUM}
    assert set(RULES) == finding
    assert set(KINDS) == finding


def test_every_language_has_a_helper_for_every_kind_of_equation() -> None:
    with_helpers = [t for t in shipped().values() if '"line" in ik.kinds' in t.text]
    assert len(with_helpers) == 6
    for template in with_helpers:
        for kind in Kind:
            assert f'"{kind.value}" in ik.kinds' in template.text, template.name


def test_a_length_without_code_is_the_reason_for_no_ik() -> None:
    base, exponent = Symbol("l", real=True), Symbol("m", real=True)
    robot = symdh.loads(PLANAR)
    first, second = robot.joints
    found = inverse_program(replace(robot, joints=(replace(first, a=base**exponent), second)))
    assert isinstance(found, Missing)
    assert found.reason == "no code can be generated for l__m"  # ** could end a comment


def test_a_joint_that_is_not_there_cannot_be_locked() -> None:
    with pytest.raises(UnsupportedError, match="theta9 is no joint variable of planar; these"):
        generate(symdh.loads(PLANAR), "c", lock=(Symbol("theta9", real=True),))


def test_polynomials_in_one_angle_are_added_and_multiplied() -> None:
    """By powers of e^(ix), those from 0 up, each with its real and its imaginary part."""
    graph = Graph()
    x, y, zero, one = graph.symbol(Symbol("x")), graph.symbol(Symbol("y")), graph.zero, graph.one
    trigonometry = Trigonometry(Polynomials(graph, [], range(0), {}))
    a, b = {0: (x, zero), 1: (x, y)}, {1: (y, zero), 2: (one, x)}
    assert trigonometry.added(a, b) == {
        0: (x, zero),
        1: (graph.add(x, y), y),
        2: (one, x),
    }
    assert trigonometry.added(a, b, -1) == {
        0: (x, zero),
        1: (graph.sub(x, y), y),
        2: (graph.neg(one), graph.neg(x)),
    }
    assert trigonometry.product({}, a) == {}
    # cos x = (e^(ix) + e^(-ix)) / 2, so its square is 1/2 + (e^(2ix) + e^(-2ix)) / 4.
    half, quarter = graph.constant(Rational(1, 2)), graph.constant(Rational(1, 4))
    assert trigonometry.product({1: (half, zero)}, {1: (half, zero)}) == {
        0: (half, zero),
        2: (quarter, zero),
    }


def test_a_long_value_in_brackets_gets_no_others() -> None:
    terms = " + ".join(f"term{k:02}" for k in range(20))
    for value, brackets in ((f"({terms})", 1), (f"({terms}) * 2", 2), (f"({terms}) * (a + b)", 3)):
        text = broken_value("x = ", value, 1)
        assert max(map(len, text.split("\n"))) <= 100
        assert text.count("(") == text.count(")") == brackets
        inner = value if brackets == 1 else f"({value})"
        assert re.sub(r"\s+", "", text) == re.sub(r"\s+", "", f"x={inner}")


def test_the_seed_is_said_to_hold_what_is_locked() -> None:
    robot = symdh.loads(f"{PLANAR}  - {{theta: t3, d: 0, a: 1, alpha: 0}}\n")
    (locked,) = generate(robot, "python", lock=(Symbol("t3", real=True),))
    assert "so does t3, which is locked" in re.sub(r"\s+", " ", locked.text)
    (plain,) = generate(robot, "python")
    assert "which is locked" not in plain.text
