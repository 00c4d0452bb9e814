"""Inverse kinematics: derived where there is a closed form, right at every pose, else honest."""

from __future__ import annotations

import json
import math
import os
import random
from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import combinations_with_replacement, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from inverse_checks import (
    CLOSED,
    DATA,
    INDEX,
    LOCKS,
    OPEN,
    TABLES,
    apart,
    arm_of,
    derived,
    hard_poses,
    held,
    missed_by,
    newton_from_everywhere,
    pose_of,
    reach_of,
    solver_of,
    symbol,
)
from oracle import Arm, read_arm
from random_arms import parallel_arm, short_arm, wrist_arm
from sympy import Expr, Float, Integer, Rational, Symbol, cos, pi, sin

import symdh
from symdh.derivation.inverse import Solved, inverse_document
from symdh.derivation.inverse.known_parts import is_told
from symdh.errors import LimitError, UnsupportedError
from symdh.kinematics.inverse import clock, fallback, inverse, numeric, roots
from symdh.kinematics.inverse.branches import Branches, branches_of
from symdh.kinematics.inverse.check import tried
from symdh.kinematics.inverse.evaluate import Evaluator
from symdh.kinematics.inverse.fallback import nominal
from symdh.kinematics.inverse.goal import goal_of
from symdh.kinematics.inverse.inverse import InverseKinematics, Method, inverse_kinematics
from symdh.kinematics.inverse.point import Point
from symdh.kinematics.inverse.pool import Combination, Pool
from symdh.kinematics.inverse.posture import Part
from symdh.kinematics.inverse.refine import refined
from symdh.kinematics.inverse.ring import InverseRing
from symdh.kinematics.inverse.roots import _roots, real_angles
from symdh.kinematics.inverse.search import closed_form
from symdh.kinematics.inverse.solution import ClosedForm, Rule, Tried
from symdh.kinematics.inverse.structure import structure
from symdh.kinematics.inverse.task import InverseTask, Kind, inverse_task
from symdh.render.inverse_json import inverse_json
from symdh.render.latex import render_latex
from symdh.render.terminal import render_chapters
from symdh.robot import Convention, JointType, Limits
from symdh.table import parse_expression
from tools import require_tool

#: Random poses of each table, and hard ones of each kind; tests/check_inverse.py tries more.
POSES = int(os.environ.get("SYMDH_IK_POSES", "30"))
HARD = 10

each_closed = pytest.mark.parametrize("table", CLOSED, ids=lambda path: path.stem)


# ---------------------------------------------------------------- what is derived


@each_closed
def test_a_closed_form_is_derived_in_time(table: Path) -> None:
    found, seconds = derived(table)
    assert found.method is Method.CLOSED_FORM
    assert found.form is not None
    assert seconds < 5
    branches = INDEX[table.stem]["expect"].get("branches")
    if isinstance(branches, int):
        assert found.form.most_solutions == branches


@pytest.mark.parametrize("table", CLOSED, ids=lambda path: path.stem)
def test_the_task_is_that_of_the_index(table: Path) -> None:
    task = derived(table)[0].task
    wanted = INDEX[table.stem]["task"]
    if isinstance(wanted, list):
        letters = ["xyz"[axis] for axis in task.axes]
        letters += ["phi"] if task.kind is Kind.PLANAR else []
        assert letters == wanted
    elif wanted == "orientation":
        assert task.kind is Kind.ORIENTATION
    elif len(arm_of(table).variables) > 3:
        assert task.kind is Kind.POSE


@each_closed
def test_every_printed_equation_holds(table: Path) -> None:
    """Equations, expanded forms and names, with the oracle's pose and random joint values."""
    form = derived(table)[0].form
    assert form is not None
    arm = arm_of(table)
    q = held(table, arm.seeded_poses(1, seed=8))[0]
    letters = numbers_of_letters(form, arm, pose_of(arm, q), q)
    scale = max(1.0, arm.reach()) ** 4
    for step in form.steps:
        for generator, element in step.definitions:
            letters[generator] = value_of(form, element, letters)
        for used in step.equations:
            equations = [used.equation]
            while equations:
                equation = equations.pop()
                equations += equation.parents
                assert abs(value_of(form, equation.element, letters)) < 1e-9 * scale
                for left, right in equation.sides:
                    difference = value_of(form, left - right, letters)
                    assert abs(difference) < 1e-9 * scale
            assert abs(value_of(form, used.element, letters)) < 1e-9 * scale


def numbers_of_letters(
    form: ClosedForm, arm: Arm, goal: np.ndarray, q: np.ndarray
) -> dict[int, float]:
    """Numbers for the letters of a form, from the oracle's pose and the table's own values."""
    robot = form.arm.given
    named = {symbol(name): Float(q[k]) for k, (name, _) in enumerate(arm.variables)}
    known = {**robot.values, **named}
    known |= {letter: m.xreplace(known) for letter, m in form.arm.meanings.items()}
    front, hand = (
        np.array([float(part.xreplace(known)) for part in offset])
        for offset in (form.arm.front, form.arm.hand)
    )
    rotation = goal[:3, :3]
    w = goal[:3, 3] - front - rotation @ hand
    given = [*rotation.T.ravel(), *w, *(-rotation.T @ w)]
    ring = form.ring
    letters = {
        k: float(letter.xreplace(known))
        for k, letter in enumerate(ring.letters[: ring.first_name])
        if not ring.first_goal <= k < ring.first_goal + 15
    }
    return letters | {ring.first_goal + k: float(x) for k, x in enumerate(given)}


def value_of(form: ClosedForm, element: Any, letters: Mapping[int, float]) -> float:
    total = 0.0
    for powers, coefficient in element.terms():
        value = float(coefficient.numerator) / float(coefficient.denominator)
        for k, power in enumerate(powers):
            if power:
                value *= letters[k] ** power
        total += value
    return total


def test_nothing_symbolic_is_a_float() -> None:
    form = derived(DATA / "tables" / "pieper_generic.yaml")[0].form
    assert form is not None
    for step in form.steps:
        for element in (*step.coefficients, *(used.element for used in step.equations)):
            assert not form.ring.expression(element).atoms(Float)


def test_symbols_need_no_values() -> None:
    arm = symdh.loads(
        "{name: two, convention: standard, columns: [theta, d, a, alpha], "
        "rows: [[q1, 0, l1, 0], [q2, 0, l2, 0]]}"
    )
    found = inverse_kinematics(arm)
    assert found.method is Method.CLOSED_FORM
    with pytest.raises(UnsupportedError, match="l1"):
        found.solver()


# ---------------------------------------------------------------- what it gives


@each_closed
def test_random_poses_give_their_joint_values_again(table: Path) -> None:
    found, arm = derived(table)[0], arm_of(table)
    solver = solver_of(table)
    q = held(table, arm.seeded_poses(POSES, seed=TABLES.index(table)))
    goals = pose_of(arm, q)
    for truth, goal in zip(q, goals, strict=True):
        answers = solver.solve(goal.tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)


@pytest.mark.parametrize(
    "name",
    ["planar_3r", "elbow_3r", "scara_rrpr", "puma560", "ur5", "three_parallel_only",
     "pieper_generic", "ikbt_ArmRobo", "kuka_iiwa7"],
)  # fmt: skip
def test_the_number_of_solutions_is_that_of_an_independent_search(name: str) -> None:
    table = DATA / "tables" / f"{name}.yaml"
    found, arm = derived(table)[0], arm_of(table)
    for truth in held(table, arm.seeded_poses(2, seed=77)):
        goal = pose_of(arm, truth)
        answers = solver_of(table).solve(goal.tolist())
        free = [k for k, (v, _) in enumerate(arm.variables) if v != LOCKS.get(name)]
        others = newton_from_everywhere(arm, found, goal, truth, free)
        assert len(answers) == len(others)
        for other in others:
            assert min(apart(arm, answer.q, other) for answer in answers) < 1e-5


@each_closed
def test_singular_poses_have_answers(table: Path) -> None:
    """Multiples of 90 degrees, single joints at and near them, a straight wrist and elbow."""
    answered = count = 0
    for q in hard_poses(table, HARD).values():
        count += len(q)
        for goal in pose_of(arm_of(table), q):
            answers = solver_of(table).solve(goal.tolist())
            answered += bool(answers)
            missed = missed_by(arm_of(table), derived(table)[0], answers, goal)
            assert missed < 1e-9 * reach_of(arm_of(table))
    assert answered >= 0.99 * count


@pytest.mark.parametrize("name", ["planar_2r", "elbow_3r", "puma560", "ur5", "kuka_kr5"])
def test_out_of_reach_is_no_answer(name: str) -> None:
    goal = np.eye(4)
    goal[:3, 3] = [30.0, 20.0, 10.0]
    assert solver_of(DATA / "tables" / f"{name}.yaml").solve(goal.tolist()) == []


@pytest.mark.parametrize("name", ["planar_2r", "elbow_3r", "planar_3r"])
def test_on_the_boundary_both_solutions_are_one(name: str) -> None:
    """The elbow is straight: theta_2 of the planar arms, theta_3 of the other."""
    table = DATA / "tables" / f"{name}.yaml"
    arm = arm_of(table)
    q = arm.seeded_poses(20, seed=4)
    q[:, 2 if name == "elbow_3r" else 1] = 0.0
    solver = solver_of(table)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        assert min(apart(arm, answer.q, truth) for answer in solver.solve(goal.tolist())) < 1e-5


def test_a_free_joint_keeps_the_value_of_the_seed() -> None:
    table = DATA / "tables" / "puma560.yaml"
    arm = arm_of(table)
    truth = np.array([0.3, -0.4, 0.5, 0.6, 0.0, 0.7])
    seed = [0.0, 0.0, 0.0, 1.1, 0.0, 0.0]
    answers = solver_of(table).solve(pose_of(arm, truth).tolist(), seed)
    straight = [a for a in answers if abs(a.q[4]) < 1e-9]
    assert straight
    assert all(a.free == (symbol("theta4"),) and a.q[3] == 1.1 for a in straight)


def test_answers_come_nearest_to_the_seed_first() -> None:
    table = DATA / "tables" / "puma560.yaml"
    truth = arm_of(table).seeded_poses(1, seed=2)[0]
    goal = pose_of(arm_of(table), truth).tolist()
    answers = solver_of(table).solve(goal, list(truth))
    assert len(answers) == 8
    assert apart(arm_of(table), answers[0].q, truth) < 1e-9


WITH_ENDS = """
name: mounted
convention: {convention}
units: {{angle: deg, length: m}}
joints:
{joints}
base: [Tz(0.5), Rz(30 deg), Tx(0.2), Rx(40 deg)]
tool: [Tz(0.1), Rx(90 deg), Tx(0.3)]
values: {{{values}}}
limits: {{theta1: [-90 deg, 90 deg]}}
"""


@pytest.mark.parametrize("name", ["puma560", "ikbt_Puma", "scara_rrpr", "elbow_3r", "planar_3r"])
def test_base_and_tool_are_part_of_the_arm(name: str) -> None:
    lines = (DATA / "tables" / f"{name}.yaml").read_text().splitlines()
    values = lines[-1].partition("{")[2].rstrip("}")
    convention = next(line for line in lines if line.startswith("convention")).split()[1]
    joints = "\n".join(line for line in lines if line.startswith("  - "))
    text = WITH_ENDS.format(convention=convention, joints=joints, values=values)
    robot, arm = symdh.loads(text), read_arm(text)
    task = "x y z" if name == "elbow_3r" else "pose"
    found = inverse_kinematics(robot, task)
    assert found.method is Method.CLOSED_FORM
    solver = found.solver()
    q = arm.seeded_poses(20, seed=6)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver.solve(goal.tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        if task == "pose":
            assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)
        for answer in answers:
            assert answer.within_limits == (abs(answer.q[0]) <= math.pi / 2 + 1e-6)


@pytest.mark.parametrize("turns", [-3, -1, 1, 3])
def test_half_a_turn_is_positive(turns: int) -> None:
    """Angles lie in (-180 deg, 180 deg]."""
    solver = inverse_kinematics(symdh.load(DATA / "tables" / "planar_2r.yaml")).solver()
    assert solver.judge.wrapped(0, turns * math.pi) == math.pi


def test_a_limit_that_is_no_number_is_none() -> None:
    """A limit from Python may be a formula: of known lengths it holds, of others it is none."""
    robot = symdh.load(DATA / "tables" / "planar_2r.yaml")
    fifth, other, zero = symbol("a1") / 5, symbol("L"), Integer(0)
    for lower, upper, within in (
        (-fifth, fifth, [False, False]),
        (-other, other, [True, True]),
        (zero, other, [True, True]),
        (other, zero, [True, True]),
    ):
        bound = replace(robot, limits={symbol("theta2"): Limits(lower, upper)})
        answers = inverse_kinematics(bound).solver().solve(at(0.6, 0.3))  # a_1 is 0.5
        assert all(abs(answer.q[1]) > 0.1 for answer in answers)
        assert [answer.within_limits for answer in answers] == within


def assert_solved(text: str, task: str | None = None, count: int = 10) -> InverseKinematics:
    """Derive a closed form and let the oracle say that random poses are solved."""
    arm, found = read_arm(text), inverse_kinematics(symdh.loads(text), task)
    assert found.method is Method.CLOSED_FORM
    solver = found.solver()
    q = arm.seeded_poses(count, seed=12)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver.solve(goal.tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)
    return found


ODD_SLIDES = {
    "RRP": """
  - {theta: theta1, d: 0.3, a: 0, alpha: 0}
  - {theta: theta2, d: 0.1, a: 0.2, alpha: 90 deg}
  - {theta: 20 deg, d: q3 + 0.1, a: 0.15, alpha: 40 deg}
""",
    "RRP, as far as it goes": """
  - {theta: theta1, d: 0, a: 0, alpha: 0}
  - {theta: theta2, d: 0, a: -0.32, alpha: -90 deg}
  - {theta: 0, d: q3, a: 0, alpha: alpha3}
values: {alpha3: 45 deg}
""",
    "PRP": """
  - {theta: 20 deg, d: q1, a: 0, alpha: 0}
  - {theta: theta2, d: 0.1, a: 0.2, alpha: 70 deg}
  - {theta: 10 deg, d: q3, a: 0.15, alpha: 40 deg}
""",
}


@pytest.mark.parametrize("kind", ODD_SLIDES)
def test_a_slide_behind_an_odd_twist_drops_out(kind: str) -> None:
    """In a modified table the twist stands in the slide's own row, so no entry is free of it."""
    text = (
        "name: odd\nconvention: modified\nunits: {angle: deg, length: m}\n"
        f"joints:{ODD_SLIDES[kind]}tool: [Tx(0.1), Tz(0.2)]\n"
    )
    found = assert_solved(text, count=50)
    assert found.form is not None
    equations = [used.equation for step in found.form.steps for used in step.equations]
    used = {equation.combination for equation in equations}
    used |= {parent.combination for equation in equations for parent in equation.parents}
    assert Combination.WITHOUT_SLIDE in used
    steps = render_chapters(inverse_document(found).chapters)
    assert "so that the slide that stands in both drops out" in " ".join(steps.split())


@pytest.mark.parametrize(
    ("base", "task"), [("Rx(90 deg)", "x z"), ("Tz(0.4), Ry(90 deg)", "y z"), ("Rx(35 deg)", "x y")]
)
def test_a_base_that_is_turned_mixes_no_coordinate_that_is_not_given(base: str, task: str) -> None:
    """A planar arm on a wall is as simple as on the floor; what is not given is never read."""
    text = (DATA / "tables" / "planar_2r.yaml").read_text() + f"base: [{base}]\n"
    robot, arm = symdh.loads(text), read_arm(text)
    found = inverse_kinematics(robot, task)
    assert found.method is Method.CLOSED_FORM
    solver = found.solver()
    others = [k for k in range(3) if "xyz"[k] not in task]
    q = arm.seeded_poses(20, seed=4)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        goal[others, 3] = 7.0
        goal[:3, :3] = np.eye(3)
        answers = solver.solve(goal.tolist())
        assert len(answers) == 2
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6


def test_joints_that_repeat_what_others_do_are_to_be_held() -> None:
    """Four parallel axes: a plane has three ways to move, and a fourth joint has no value."""
    rows = "".join(f"  - {{theta: q{k}, d: 0, a: 0.{k}, alpha: 0}}\n" for k in range(1, 5))
    robot = symdh.loads(f"name: snake\nconvention: standard\njoints:\n{rows}")
    with pytest.raises(
        UnsupportedError, match="4 joints that move, and they move the hand in 3 ways only"
    ) as raised:
        inverse_kinematics(robot)
    named = str(raised.value).rpartition("with --lock ")[2].split()[0]
    held_robot = inverse_kinematics(robot, None, [symbol(named)])
    assert held_robot.method is Method.CLOSED_FORM


def test_a_quadratic_in_a_slide_has_two_values() -> None:
    text = """
name: slanted
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.3, a: 0.2, alpha: 90 deg}
  - {theta: 0, d: q2, a: 0.1, alpha: 60 deg}
"""
    assert_solved(text, "x y", count=20)


@pytest.mark.parametrize(
    "angles", [(0.3, 1.2, -2.0, 2.9), (math.pi, 0.5, -0.5, 1.0), (0.7, 0.7, -1.0, 2.0)]
)
def test_trigonometric_roots(angles: tuple[float, ...]) -> None:
    """A polynomial made of known roots gives them back; a double one may come twice."""
    polynomial = {0: 1.0 + 0j}
    for first, second in (angles[:2], angles[2:]):
        # cos((first - second) / 2) - cos(y - (first + second) / 2) vanishes at both angles.
        middle = (first + second) / 2
        factor = {0: math.cos((first - second) / 2) + 0j}
        factor[1] = -0.5 * complex(math.cos(middle), -math.sin(middle))
        factor[-1] = factor[1].conjugate()
        product: dict[int, complex] = {}
        for i, x in polynomial.items():
            for j, y in factor.items():
                product[i + j] = product.get(i + j, 0) + x * y
        polynomial = product
    found = real_angles(polynomial)
    for angle in angles:
        assert min(abs(math.remainder(x - angle, 2 * math.pi)) for x in found) < 1e-6
    for x in found:
        assert min(abs(math.remainder(x - angle, 2 * math.pi)) for angle in angles) < 1e-6


# ---------------------------------------------------------------- arms that nobody has drawn


@pytest.mark.parametrize(
    ("family", "seed"),
    [(wrist_arm, 3), (wrist_arm, 11), (parallel_arm, 4), (parallel_arm, 9)]
    + [(short_arm, seed) for seed in (1, 4, 8, 9, 12, 15, 18, 21, 24)],
    ids=lambda x: x.__name__ if callable(x) else str(x),
)
def test_random_arms_are_solved(family: Callable[[int], str], seed: int) -> None:
    text = family(seed)
    arm, found = read_arm(text), inverse_kinematics(symdh.loads(text))
    assert found.method is Method.CLOSED_FORM
    solver = found.solver()
    q = arm.seeded_poses(8, seed=seed)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver.solve(goal.tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)


def test_a_hand_that_stays_in_a_plane_is_not_asked_for_three_coordinates() -> None:
    """Three joints of which the last two are parallel after a fixed row: a position of rank two."""
    text = short_arm(16)
    found = inverse_kinematics(symdh.loads(text))
    assert found.task.kind is Kind.POSE
    assert found.task.reachable_only


def test_two_joints_that_move_the_hand_on_a_circle_are_asked_for_the_angle_too() -> None:
    """Craig's 2R without a tool: its last frame is at joint 2, so theta_2 does not move p."""
    text = """
name: two
convention: modified
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0, alpha: 0}
  - {theta: theta2, d: 0, a: 0.4, alpha: 0}
"""
    found, arm = inverse_kinematics(symdh.loads(text)), read_arm(text)
    assert found.task.kind is Kind.PLANAR
    assert found.method is Method.CLOSED_FORM
    truth = np.array([0.4, 0.9])
    answers = found.solver().solve(pose_of(arm, truth).tolist())
    assert len(answers) == 1
    assert apart(arm, answers[0].q, truth) < 1e-9


def test_a_length_that_is_given_as_zero_breaks_no_step() -> None:
    """PUMA without its offsets: the equations of the arm that has them are not divided by zero."""
    arm = symdh.load(DATA / "tables" / "puma560.yaml")
    found = inverse_kinematics(arm)
    solver = found.solver({symbol("a3"): Float(0), symbol("d3"): Float(0)})
    q = arm_of(DATA / "tables" / "puma560.yaml").seeded_poses(5, seed=3)
    for truth in q:
        goal = solver.judge.chain.pose(truth)  # type: ignore[attr-defined]
        assert any(np.allclose(answer.q, truth, atol=1e-6) for answer in solver.solve(goal))


# ---------------------------------------------------------------- where there is no closed form


@pytest.mark.parametrize("table", OPEN, ids=lambda path: path.stem)
def test_without_a_closed_form_it_says_so_and_searches(table: Path) -> None:
    found, arm = derived(table)[0], arm_of(table)
    assert found.method is Method.ONE_JOINT
    text = render_chapters(inverse_document(found).chapters, width=2000)
    assert text.startswith("No closed form")
    assert "What is offered instead is a search over θ₁" in text
    q = held(table, arm.seeded_poses(3, seed=3))
    again = 0
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver_of(table).solve(goal.tolist())
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)
        again += any(apart(arm, answer.q, truth) < 1e-6 for answer in answers)
    assert again >= 2


#: d, a and alpha in quarter turns, as the makers give them.
UR10E = ((0.1807, 0, 1), (0, -0.6127, 0), (0, -0.57155, 0), (0.17415, 0, 1), (0.11985, 0, -1),
         (0.11655, 0, 0))  # fmt: skip
PUMA560 = ((0, 0, 0), (0.2435, 0, -1), (-0.0934, 0.4318, 0), (0.4331, 0.0203, 1), (0, 0, -1),
           (0, 0, 1))  # fmt: skip


def calibrated(name: str, convention: str, rows: tuple[tuple[float, float, float], ...]) -> str:
    """A table whose parameters are all 1e-5 off."""
    drawn = random.Random(3)

    def off(value: float) -> str:
        return f"{value + drawn.choice((-1e-5, 1e-5)):.12f}"

    joints = "".join(
        f"  - {{theta: theta{k} + {off(0)} rad, d: {off(d)}, a: {off(a)}, "
        f"alpha: {off(quarters * math.pi / 2)} rad}}\n"
        for k, (d, a, quarters) in enumerate(rows, start=1)
    )
    head = f"name: {name}\nconvention: {convention}\nunits: {{angle: rad, length: m}}\n"
    return f"{head}joints:\n{joints}"


@pytest.mark.parametrize(
    ("name", "convention", "rows"),
    [
        ("ur10e", "standard", UR10E),
        ("puma560", "modified", PUMA560),
    ],
    ids=["ur10e", "puma560"],
)
def test_a_calibrated_arm_is_solved_by_its_nominal_arm(
    name: str, convention: str, rows: tuple[tuple[float, float, float], ...]
) -> None:
    text = calibrated(name, convention, rows)
    robot, arm = symdh.loads(text), read_arm(text)
    found = inverse_kinematics(robot)
    assert found.method is Method.NOMINAL
    document = render_chapters(inverse_document(found).chapters, width=2000)
    assert document.startswith("No closed form")
    assert "improved on the true arm by Newton's method" in document
    solver = found.solver()
    q = arm.seeded_poses(12, seed=1)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver.solve(goal.tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)
    others = newton_from_everywhere(arm, found, goal, truth, range(6))
    assert len(others) == len(answers)


def test_a_nominal_arm_has_to_differ() -> None:
    assert nominal(symdh.load(DATA / "tables" / "ur5.yaml")) is None


def test_seven_joints_need_a_lock_and_one_is_named() -> None:
    iiwa = symdh.load(DATA / "tables" / "kuka_iiwa7.yaml")
    with pytest.raises(UnsupportedError, match="with --lock theta3 there is a closed form"):
        inverse_kinematics(iiwa)


def test_the_time_budget_is_kept() -> None:
    table = DATA / "tables" / "pieper_generic.yaml"
    with pytest.raises(LimitError, match="time-limit"):
        inverse_kinematics(symdh.load(table), seconds=0.0)


def test_the_time_is_looked_at_inside_of_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """Time that runs out while equations are multiplied stops the search all the same."""
    looks = 0

    def one_second_later() -> float:
        nonlocal looks
        looks += 1
        return float(looks)

    monkeypatch.setattr(clock, "process_time", one_second_later)
    robot = symdh.load(DATA / "tables" / "spherical_rrp.yaml")
    assert isinstance(closed_form(robot, seconds=1e9), ClosedForm)
    assert looks > 100  # far more often than once for each of the three steps
    for seconds in (5, looks // 2, looks - 5):
        tried = closed_form(robot, seconds=seconds)
        assert isinstance(tried, Tried)
        assert tried.timed_out


def test_an_impossible_task_is_refused() -> None:
    puma = symdh.load(DATA / "tables" / "puma560.yaml")
    with pytest.raises(UnsupportedError, match="3 numbers for 6 joints"):
        inverse_kinematics(puma, "x y z")
    with pytest.raises(UnsupportedError, match="no task"):
        inverse_kinematics(puma, "roll")


# ---------------------------------------------------------------- what degenerates, and what is odd


def at(x: float, y: float, z: float = 0.0) -> list[list[float]]:
    """A goal at a point; the orientation is that of the base."""
    return [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]]


def test_turns_that_make_a_right_angle_together_have_no_letter() -> None:
    """30 deg of the base and 60 deg of the row are 90 deg: no cosine of their sum is in a step."""
    found = assert_solved(
        """
name: wall
convention: modified
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.1, a: 0.3, alpha: 60 deg}
  - {theta: theta2, d: 0.2, a: 0.4, alpha: 0}
base: [Rx(30 deg), Tx(0.3)]
tool: [Tx(0.1), Tz(0.2)]
""",
        "x z",
    )
    assert found.form is not None
    assert set(found.form.ring.constants) <= {pi / 6, pi / 3}


def test_a_slide_may_have_a_gear_and_a_twist_any_angle() -> None:
    """d = q_2/2: the arm goes out half as far; the twist is a number of radians, no part of pi."""
    text = """
name: geared
convention: standard
units: {angle: rad, length: m}
joints:
  - {theta: theta1, d: 0.3, a: 0.2, alpha: beta}
  - {theta: 0, d: q2/2, a: 0.1, alpha: 0}
values: {beta: 0.3}
"""
    found = assert_solved(text)
    # Only the slide is along z before the twist: p_z = 0.3 + cos(0.3) q_2/2.
    (first, *_) = found.solver().solve(pose_of(read_arm(text), np.array([0.4, 0.5])).tolist())
    assert 0.3 + math.cos(0.3) * first.q[1] / 2 == pytest.approx(0.3 + math.cos(0.3) / 4)


def test_a_wrist_that_cannot_come_to_the_first_axis_has_no_answer_there() -> None:
    """PUMA: the wrist stays d_3 = 0.15 m off the axis of joint 1."""
    assert solver_of(DATA / "tables" / "puma560.yaml").solve(at(0.0, 0.0, 0.9)) == []


def test_a_goal_just_out_of_reach_is_tried_hard_and_has_no_answer() -> None:
    """The arm reaches 0.5 + 0.4 m; a few micrometres farther no starting point helps."""
    table = DATA / "tables" / "planar_2r.yaml"
    reach = reach_of(arm_of(table))
    assert len(solver_of(table).solve(at(reach * (1 - 4e-6), 0.0))) == 2
    assert solver_of(table).solve(at(reach * (1 + 4e-6), 0.0)) == []


BESIDE = """
name: beside
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0.3, alpha: 0}
  - {theta: 40 deg, d: 0, a: 0.1, alpha: beta}
  - {theta: 0, d: q3, a: 0.3, alpha: 0}
"""
SINE, COSINE = math.sin(math.radians(40)), math.cos(math.radians(40))
#: How far the hand is from the first axis where q_3 is 0: sides of 0.3 and 0.4 m, 140 deg between.
FAR = math.sqrt(0.25 + 0.24 * COSINE)


def test_a_slide_behind_a_twist_is_out_or_back() -> None:
    """beta = 90 deg: p = (0.3 + 0.4 c + s q_3, 0.4 s - c q_3) for c and s of 40 deg, then turned.

    So its square is that for q_3 = 0 and 0.6 s q_3 + q_3^2.
    """
    found = inverse_kinematics(symdh.loads(BESIDE), "x y")
    assert found.form is not None
    assert found.form.steps[0].rule is Rule.SLIDE_SQUARE
    solver = found.solver({symbol("beta"): pi / 2})
    answers = solver.solve(at(0.0, FAR))
    assert sorted(answer.q[1] for answer in answers) == pytest.approx([-0.6 * SINE, 0.0])
    least = math.sqrt(FAR**2 - (0.3 * SINE) ** 2)
    assert len(solver.solve(at(0.0, least + 1e-3))) == 2
    assert solver.solve(at(0.0, least - 1e-3)) == []


@pytest.mark.parametrize("beta", [Integer(0), pi])
def test_a_slide_that_changes_nothing_that_is_asked_for_is_free(beta: Expr) -> None:
    """Without the twist the slide is along z: on the circle any value will do.

    Its quadratic equation is then 0 q^2 + 0 q + C = 0; it had no answer at all once.
    """
    solver = inverse_kinematics(symdh.loads(BESIDE), "x y").solver({symbol("beta"): beta})
    (answer,) = solver.solve(at(0.3 + 0.4 * COSINE, 0.4 * SINE), [0.0, 0.7])
    assert answer.q == pytest.approx((0.0, 0.7))
    assert answer.free == (symbol("q3"),)


def test_off_the_circle_a_free_slide_does_not_help() -> None:
    solver = inverse_kinematics(symdh.loads(BESIDE), "x y").solver({symbol("beta"): Integer(0)})
    assert solver.solve(at(0.3, 0.5)) == []


def test_a_quadratic_without_its_square_is_linear() -> None:
    """0 q^2 + 2 q - 1 = 0 has the one value 1/2; no arm is known that comes to such steps."""
    form = inverse_kinematics(symdh.loads(BESIDE), "x y").form
    assert form is not None
    slide, *others = form.steps
    assert slide.rule is Rule.SLIDE_SQUARE
    ring = form.ring
    linear = replace(slide, coefficients=(ring.zero, 2 * ring.one, -ring.one))
    evaluator = Evaluator(replace(form, steps=(linear, *others)), {symbol("beta"): pi / 2}, {})
    assert [proposal.q[1] for proposal in evaluator.proposals(at(0.0, 0.5), [0.0, 0.0])] == [0.5]


def test_steps_need_numbers_for_all_letters() -> None:
    form = inverse_kinematics(symdh.loads(BESIDE)).form
    assert form is not None
    with pytest.raises(UnsupportedError, match="beta has no value: put it under 'values:'"):
        Evaluator(form, {}, {})


def test_newtons_method_stops_where_the_arm_is_straight() -> None:
    """theta_2 = 0: no joint moves the hand towards the base, and the values stay what they are."""
    rows = "rows: [[q1, 0, 1, 0], [q2, 0, 1, 0]]"
    text = f"{{name: two, convention: standard, columns: [theta, d, a, alpha], {rows}}}"
    found = inverse_kinematics(symdh.loads(text))
    judge = found.solver().judge
    q, error = refined(judge.chain, found.task, at(1.5, 0.0), [0.0, 0.0], [0, 1], 9)
    assert (q, error) == ([0.0, 0.0], 0.5)


def test_a_constant_has_no_real_angles() -> None:
    assert real_angles({}) == []
    assert real_angles({1: 0j, 0: 0j, -1: 0j}) == []
    assert real_angles({0: 2.0 + 0j}) == []
    # 1e-20 beside 2 is rounding.
    assert real_angles({1: 1e-20 + 0j, 0: 2.0 + 0j, -1: 1e-20 + 0j}) == []


def test_roots_that_fall_together_on_the_way_part_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """z^2 - 3 z + 2 = (z - 1)(z - 2), from two starting points that are one."""
    monkeypatch.setattr(roots, "exp", lambda z: 1.0 + 0j)
    assert sorted(x.real for x in _roots([2 + 0j, -3 + 0j, 1 + 0j])) == pytest.approx([1, 2])


def test_an_orientation_may_be_asked_for_by_name() -> None:
    """The position of the goal is nothing that is given: any will do."""
    table = DATA / "tables" / "puma560.yaml"
    robot, arm = symdh.load(table), arm_of(table)
    found = inverse_kinematics(robot, "orientation", [symbol(f"theta{k}") for k in (1, 2, 3)])
    assert found.task.kind is Kind.ORIENTATION
    assert found.method is Method.CLOSED_FORM
    truth = np.array([0.0, 0.0, 0.0, 0.3, 0.6, -0.8])
    goal = pose_of(arm, truth)
    goal[:3, 3] = 9.0
    answers = found.solver().solve(goal.tolist())
    assert len(answers) == 2
    assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-9
    assert missed_by(arm, found, answers, goal) < 1e-9


def test_two_equations_may_lose_an_angle_that_stands_alike_in_both() -> None:
    """The difference is linear in the other angle, and is used like any other equation."""
    assert_solved(short_arm(1641))


def test_what_is_divided_by_when_an_angle_is_eliminated_is_known() -> None:
    """Both equations hold theta_2 behind c_4, and c_4 is what is looked for."""
    found = assert_solved("""
name: arm
convention: standard
units: {length: m}
joints:
  - {a: 0.3, alpha: 90 deg, theta: theta1, d: 0}
  - {a: 0, alpha: 90 deg, theta: theta2 + 10 deg, d: 0.2}
  - {a: 0.1, alpha: 0, theta: 0, d: q3}
  - {a: 0, alpha: 90 deg, theta: theta4, d: 0.1}
  - {a: 0, alpha: 90 deg, theta: 90 deg, d: q5}
  - {a: 0, alpha: 0, theta: theta6, d: 0}
""")
    assert found.form is not None
    assert_introduced(found.form)
    (step,) = (step for step in found.form.steps if step.rule is Rule.HALF_ANGLE)
    assert step.scales


# ---------------------------------------------------------------- what numbers a goal is made of


PLANE, POSE = DATA / "tables" / "planar_3r.yaml", DATA / "tables" / "puma560.yaml"


@pytest.mark.parametrize(
    ("name", "kind", "axes", "reachable_only"),
    [
        ("puma560", Kind.POSE, (0, 1, 2), False),
        ("minimover_5r", Kind.POSE, (0, 1, 2), True),
        ("scara_rrpr", Kind.POSE, (0, 1, 2), True),
        ("elbow_3r", Kind.POSITION, (0, 1, 2), False),
        ("planar_3r", Kind.PLANAR, (0, 1), False),
        ("planar_2r", Kind.POSITION, (0, 1), False),
        ("zyz_wrist", Kind.ORIENTATION, (), False),
    ],
)
def test_what_is_asked_of_an_arm(
    name: str, kind: Kind, axes: tuple[int, ...], reachable_only: bool
) -> None:
    robot = symdh.load(DATA / "tables" / f"{name}.yaml")
    expected = InverseTask(kind, axes, reachable_only)
    assert inverse_task(robot, len(robot.variables)) == expected


def test_a_goal_is_a_pose_or_the_coordinates_of_the_task() -> None:
    task = derived(PLANE)[0].task
    c, s = math.cos(0.3), math.sin(0.3)
    expected = ((c, -s, 0.0, 0.5), (s, c, 0.0, 0.2), (0.0, 0.0, 1.0, 0.0))
    assert goal_of(task, [0.5, 0.2, 0.3]) == expected
    rows = [x for row in expected for x in row]
    assert goal_of(task, rows) == goal_of(task, [*rows, 0, 0, 0, 1]) == expected
    assert goal_of(derived(POSE)[0].task, rows) == expected


@pytest.mark.parametrize(
    ("table", "numbers", "message"),
    [
        (PLANE, [0.5, math.inf, 0.3], "a pose needs finite numbers"),
        (PLANE, [0.5, 0.2], r"is 3 numbers \(the position x y and the angle phi\), 12 .* are 2"),
        (POSE, [0.5, 0.2, 0.3], r"of this arm is 12 numbers \(three rows .* are 3"),
        (POSE, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1], "the last row of a pose is 0 0"),
        (POSE, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0], "are a reflection, no rotation"),
        (POSE, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.1, 0], "miss being orthonormal by 0.2"),
    ],
)
def test_numbers_that_are_no_goal_are_refused(
    table: Path, numbers: list[float], message: str
) -> None:
    with pytest.raises(UnsupportedError, match=message):
        goal_of(derived(table)[0].task, numbers)


@pytest.mark.parametrize(
    "name", ["planar_2r", "pieper_generic", "three_parallel_only", "yaskawa_hc10"]
)
def test_the_farthest_goal_is_out_of_reach_and_farther_ones_are_refused(name: str) -> None:
    solver = derived(DATA / "tables" / f"{name}.yaml")[0].solver()
    assert solver.solve([[1, 0, 0, 1e30], [0, 1, 0, -1e30], [0, 0, 1, 1e30]]) == []
    for length in (1.001e30, -1e300, math.inf, math.nan):
        with pytest.raises(UnsupportedError, match=r"a position up to the limit of 1e\+30, not"):
            solver.solve([[1, 0, 0, 0], [0, 1, 0, length], [0, 0, 1, 0]])


@pytest.mark.parametrize("name", ["planar_2r", "puma560", "pieper_generic", "spherical_rrp"])
@pytest.mark.parametrize("scale", [Rational(1, 10**9), Integer(10) ** 6])
def test_an_arm_of_any_size_has_the_same_answers(name: str, scale: Expr) -> None:
    robot = symdh.load(DATA / "tables" / f"{name}.yaml")
    lengths = {s: v * scale for s, v in robot.values.items() if s in robot.parameters}
    assert len(lengths) >= 2
    found = [inverse_kinematics(each) for each in (robot, replace(robot, values=lengths))]
    assert found[0].task == found[1].task
    assert found[0].structure == found[1].structure
    slides = {joint.variable for joint in robot.joints if joint.type is JointType.PRISMATIC}
    units = [float(scale) if variable in slides else 1.0 for variable in robot.variables]
    q = np.array([0.3, 0.7, -0.4, 0.5, 0.9, -0.8][: len(units)])
    plain, scaled = (
        [np.array(answer.q) / unit for answer in solver.solve(solver.judge.chain.pose(q * unit))]
        for solver, unit in ((found[0].solver(), 1.0), (found[1].solver(), units))
    )
    assert len(plain) == len(scaled) > 1
    np.testing.assert_allclose(plain, scaled, atol=1e-9)


def test_lengths_over_the_limit_are_refused() -> None:
    lengths = Symbol("a1", real=True), Symbol("a2", real=True)
    found = derived(DATA / "tables" / "planar_2r.yaml")[0]
    longest = dict.fromkeys(lengths, Integer(10) ** 30 / 2)
    assert len(found.solver(longest).solve([[1, 0, 0, 6e29], [0, 1, 0, 0], [0, 0, 1, 0]])) == 2
    longer = dict.fromkeys(lengths, Integer(10) ** 30)
    with pytest.raises(UnsupportedError, match=r"lengths and locked joints up to .* not 2e\+30"):
        found.solver(longer)
    slide = Symbol("d3", real=True)
    held = inverse_kinematics(symdh.load(DATA / "tables" / "spherical_rrp.yaml"), "x y", [slide])
    held.solver({slide: -(Integer(10) ** 30)})
    with pytest.raises(UnsupportedError, match=r"lengths and locked joints up to .* not -1e\+31"):
        held.solver({slide: -(Integer(10) ** 31)})


def test_an_angle_is_about_the_axis_of_a_plane_x_y() -> None:
    text = PLANE.read_text() + "base: [Rx(90 deg)]\n"
    found = inverse_kinematics(symdh.loads(text), "x z phi")
    with pytest.raises(UnsupportedError, match="an angle needs a plane x y; give the pose"):
        goal_of(found.task, [0.5, 0.2, 0.3])


# ---------------------------------------------------------------- lengths that may not be real


ROOT = """
name: two
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: sqrt(L - 1), alpha: 0}
  - {theta: theta2, d: 0, a: 0.5, alpha: 0}
"""


@pytest.mark.parametrize(("length", "value"), [("L - 1", 1.25), ("L - 9", 9.25)])
def test_a_length_under_a_root_is_drawn_so_that_it_is_real(length: str, value: float) -> None:
    """What no value is given for is tried out with numbers; not all of them make an arm."""
    text = ROOT.replace("L - 1", length)
    arm = read_arm(text.replace(f"sqrt({length})", "0.5"))
    found = inverse_kinematics(symdh.loads(text))
    assert found.method is Method.CLOSED_FORM
    assert branches_of(found.form).steps[0].names == ("right-hand solution", "left-hand solution")
    truth = np.array([0.3, 0.8])
    answers = found.solver({symbol("L"): Float(value)}).solve(pose_of(arm, truth).tolist())
    assert len(answers) == 2
    assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-9


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({symbol("L"): Rational(1, 2)}, r"these values make sqrt\(L - 1000000\) equal to sqrt"),
        ({}, r"no numbers were found that make sqrt\(L - 1000000\) a real"),
    ],
)
def test_an_arm_that_is_not_real_is_refused(values: dict[Symbol, Expr], message: str) -> None:
    arm = symdh.loads(ROOT.replace("L - 1", "L - 1e6"))
    with pytest.raises(UnsupportedError, match=message):
        inverse_kinematics(replace(arm, values=values))


def test_a_twist_that_the_values_leave_open_is_refused() -> None:
    """The arctangent of what is divided by zero lies between two bounds, and has no value."""
    arm = symdh.loads(ROOT.replace("alpha: 0", "alpha: atan(1/h)", 1))
    with pytest.raises(UnsupportedError, match=r"these values make atan\(1/h\) infinite"):
        inverse_kinematics(replace(arm, values={symbol("h"): Integer(0)}))


def test_a_length_that_the_users_number_makes_complex_is_refused() -> None:
    found = inverse_kinematics(symdh.loads(ROOT))
    with pytest.raises(UnsupportedError, match="is not a real number"):
        found.solver({symbol("L"): Float(0.5)})


# ---------------------------------------------------------------- what there is to hold


GENERAL = "".join(
    f"  - {{theta: theta{k}, d: 0.{k}, a: 0.{k}, alpha: {9 * k} deg}}\n" for k in range(1, 9)
)


def of_general_rows(count: int) -> symdh.Robot:
    rows = "".join(GENERAL.splitlines(keepends=True)[:count])
    return symdh.loads(f"name: odd\nconvention: standard\nunits: {{angle: deg}}\njoints:\n{rows}")


@pytest.mark.parametrize("seconds", [0.0, 0.1])
def test_without_time_no_joint_to_hold_is_named(seconds: float) -> None:
    with pytest.raises(UnsupportedError, match=r"hold one of them with --lock NAME \(.*\)$"):
        inverse_kinematics(of_general_rows(7), seconds=seconds)


def test_eight_joints_need_two_locks() -> None:
    with pytest.raises(UnsupportedError, match=r"six numbers: hold 2 of them with --lock NAME"):
        inverse_kinematics(of_general_rows(8))
    with pytest.raises(UnsupportedError, match="odd has 8 joints that move; six can be solved"):
        closed_form(of_general_rows(8))


def test_where_no_joint_to_hold_leaves_a_closed_form_none_is_named(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(inverse, "closed_form", lambda *given, **named: Tried((), ()))
    with pytest.raises(UnsupportedError, match=r"hold one of them with --lock NAME \(.*\)$"):
        inverse_kinematics(of_general_rows(7))


def test_a_joint_with_a_gear_is_the_one_to_hold() -> None:
    """Only with theta_1 held does each joint that is left turn by its variable."""
    text = (DATA / "tables" / "kuka_iiwa7.yaml").read_text()
    geared = symdh.loads(text.replace("theta: theta1,", "theta: 2*theta1,"))
    with pytest.raises(UnsupportedError, match=r"with --lock theta1 there is a closed form$"):
        inverse_kinematics(geared)


def test_a_joint_that_is_none_cannot_be_held() -> None:
    with pytest.raises(UnsupportedError, match="theta9 is no joint variable of puma560; these are"):
        inverse_kinematics(symdh.load(POSE), None, [symbol("theta9")])


# ---------------------------------------------------------------- where nothing is found


@pytest.mark.parametrize(("name", "solutions"), [("planar_2r", 2), ("puma560", 8)])
def test_least_squares_come_last(
    name: str, solutions: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With no closed form, of the arm or of a part, random starts are left; they are good ones."""
    monkeypatch.setattr(inverse, "closed_form", lambda *given, **named: Tried((), ()))
    table = DATA / "tables" / f"{name}.yaml"
    found, arm = inverse_kinematics(symdh.load(table)), arm_of(table)
    assert (found.method, found.form, found.searched) == (Method.LEAST_SQUARES, None, None)
    assert "damped least squares" in render_chapters(inverse_document(found).chapters, width=2000)
    truth = arm.seeded_poses(1, seed=5)[0]
    goal = pose_of(arm, truth)
    for seed in (None, list(truth)):
        answers = found.solver().solve(goal.tolist(), seed)
        assert len(answers) == solutions
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)
    assert apart(arm, answers[0].q, truth) < 1e-6  # nearest to the seed


def test_trials_say_how_many_were_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[int] = []
    closed = tried(derived(DATA / "tables" / "planar_2r.yaml")[0], 7, progress=done.append)
    assert done == [1, 2, 3, 4, 5, 6, 7]
    assert (closed.found, closed.missed, closed.counts) == (7, [], {2: 7})
    monkeypatch.setattr(inverse, "closed_form", lambda *given, **named: Tried((), ()))
    monkeypatch.setattr(fallback, "_STARTS", 0)
    nothing = tried(inverse_kinematics(symdh.load(DATA / "tables" / "planar_2r.yaml")), 7)
    assert (nothing.poses, nothing.found, nothing.counts) == (7, 0, {0: 7})
    assert len(nothing.missed) == 5  # a few of them
    assert nothing.worst == 0


# ---------------------------------------------------------------- what is told


def told(name: str, lock: str | None = None) -> str:
    robot = symdh.load(DATA / "tables" / f"{name}.yaml")
    found = inverse_kinematics(robot, None, [symbol(lock)] if lock else [])
    return render_chapters(inverse_document(found).chapters, width=200)


def test_the_planar_arm_follows_the_lecture() -> None:
    """Squared and added; the arccosine; rho and psi at once; theta_1 = psi - atan2(x, y)."""
    text = told("planar_2r")
    route = [
        "p_x = a₁ c₁ + a₂ c₁₂",
        "p_y = a₁ s₁ + a₂ s₁₂",
        "p_x² + p_y² = a₁² + a₂² + 2 a₁ a₂ c₂",
        "So\n\n  c₂ = (p_x² + p_y² - a₁² - a₂²)/(2 a₁ a₂)",
        "arccosine",
        "(1) right-hand solution, (2) left-hand solution",
        "p_x = c₁ (a₁ + a₂ c₂) - a₂ s₁ s₂",
        "a₁ + a₂ c₂ = ρ₁ sin ψ₁",
        "a₂ s₂ = ρ₁ cos ψ₁",
        "p_x = ρ₁ sin(ψ₁ - θ₁)",
        "p_y = ρ₁ cos(ψ₁ - θ₁)",
        "θ₁ = ψ₁ - atan2(p_x, p_y)",
    ]
    place = 0
    for line in route:
        assert line in text[place:], line
        place = text.index(line, place)


@pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)
def test_the_structure_is_read_off_the_rows(table: Path) -> None:
    """Axes of neighbours meet where there is a twist and no length between them."""
    robot = symdh.load(table)
    moving = [i for i, joint in enumerate(robot.joints) if joint.type is not JointType.FIXED]
    between = 0 if robot.convention is Convention.STANDARD else 1

    def turn(*rows: int) -> bool:
        return all(robot.joints[i].type is JointType.REVOLUTE for i in rows) and (
            list(rows) == list(range(rows[0], rows[-1] + 1))
        )

    def meet(row: int) -> bool:
        joint = robot.joints[row + between]
        return sin(joint.alpha) != 0 and joint.a.xreplace(dict(robot.values)) == 0

    def spherical(rows: list[int]) -> tuple[int, ...] | None:
        if len(rows) < 3 or not turn(*rows) or not all(map(meet, rows[:2])):
            return None
        level = robot.joints[rows[1]].d.xreplace(dict(robot.values)) == 0
        return tuple(row + 1 for row in rows) if level else None

    found = structure(robot)
    pairs = [pair for pair in pairwise(moving) if turn(*pair) and meet(pair[0])]
    assert found.crossing == tuple((a + 1, b + 1) for a, b in pairs)
    assert found.wrist == spherical(moving[-3:])
    assert found.shoulder == spherical(moving[:3])


def test_products_in_the_last_row_of_a_rotation_are_put_by_the_others() -> None:
    form = derived(POSE)[0].form
    assert form is not None
    ring, point = form.ring, Point(form.ring, seed=3)
    last = [ring.goal(name) for name in ("r_31", "r_32", "r_33")]
    for a, b in combinations_with_replacement(last, 2):
        other = ring.orthonormal(ring.gens[0] * a * b + a)
        assert point.value(other) == point.value(ring.gens[0] * a * b + a)
        assert all(sum(powers[ring.gens.index(x)] for x in last) <= 1 for powers in other)


@pytest.mark.parametrize(("twist", "doublings"), [("11.25 deg", 4), ("2.8125 deg", 6)])
def test_a_part_of_a_turn_is_exact_at_a_point(twist: str, doublings: int) -> None:
    """The angle doubled again and again is 180 degrees, by cos 2x = 2 cos^2 x - 1."""
    rows = "".join(
        f"  - {{theta: q{i}, d: {i}, a: {i}, alpha: {angle}}}\n"
        for i, angle in enumerate((twist, twist, "0"), start=1)
    )
    form = inverse_kinematics(symdh.loads(ROOT.partition("  -")[0] + rows)).form
    assert form is not None
    ring, point = form.ring, Point(form.ring, seed=3)
    (angle,) = ring.constants
    cosine = point.values[ring.place[cos(angle)]]
    for _ in range(doublings):
        cosine = (2 * cosine * cosine - 1) % point.prime
    assert cosine == point.prime - 1


def test_the_structure_stands_at_the_start() -> None:
    puma = told("puma560")
    assert puma.index("joints 4, 5 and 6 meet in one point") < puma.index("Joint 1\n")
    ur5 = told("ur5")
    assert ur5.index("joints 2, 3 and 4 are parallel") < ur5.index("Joint 1\n")
    assert "w_x = p_x - d₆ r₁₃" in ur5
    shoulder = told("spherical_shoulder_6r")
    assert shoulder.index("centre of the shoulder") < shoulder.index("Joint 4\n")


@each_closed
def test_each_step_tells_its_unknown_once_and_compiles_to_latex(table: Path) -> None:
    found = derived(table)[0]
    form = found.form
    assert form is not None
    found_unknowns = [step.unknown for step in form.steps if not step.definitions]
    assert len(found_unknowns) == len(set(found_unknowns))
    document = inverse_document(found)
    # The table, what is given, the links, and the solutions; sums that are plain have no chapter.
    told_steps = [step for step in form.steps if is_told(form, step)]
    assert len(document.chapters) == len(told_steps) + 4
    assert {step.rule for step in form.steps if step not in told_steps} <= {Rule.SUM}
    tex = render_latex(document)
    assert tex.count(r"\section{") == len(told_steps) + 4
    assert tex.isascii()


@each_closed
def test_symbols_are_introduced_before_they_are_used(table: Path) -> None:
    form = derived(table)[0].form
    assert form is not None
    assert_introduced(form)


def assert_introduced(form: ClosedForm) -> None:
    """An unknown that a step uses, and a name of a known part, has been found before.

    What an elimination has left is solved for its own unknown, and may hold it.
    """
    ring = form.ring
    known: set[int] = set()
    named: set[int] = set()
    for step in form.steps:
        own = {step.unknown} if step.rule is Rule.HALF_ANGLE else set()
        elements = *(element for _, element in step.definitions), *step.scales
        for found, uses in ((known, elements), (known | own, step.coefficients)):
            for element in uses:
                assert unknowns_in(ring, element) <= found
                assert {k for k in generators_in(element) if k >= ring.first_name} <= named
        named |= {generator for generator, _ in step.definitions}
        assert {part for _, part in step.parts} <= known
        known.add(step.unknown)


def generators_in(element: Any) -> set[int]:
    return {k for powers in element for k, power in enumerate(powers) if power}


def unknowns_in(ring: InverseRing, element: Any) -> set[int]:
    angles = 2 * len(ring.forms)
    found = [k for k in generators_in(element) if k < ring.unknown_gens]
    return {k // 2 if k < angles else k - angles + len(ring.forms) for k in found}


def test_equations_are_cut_beside_joints_that_move() -> None:
    """Rows 1, 2 and 4 move: at the base or behind 1 or 2, and before 2 or 4 or at the hand."""
    found = inverse_kinematics(
        symdh.loads("""
name: fixed_between
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: 0.3, alpha: 0}
  - {theta: theta2, d: 0, a: 0.4, alpha: 0}
  - {type: fixed, theta: 30 deg, d: 0, a: 0.2, alpha: 0}
  - {theta: theta4, d: 0, a: 0.2, alpha: 0}
""")
    )
    assert found.form is not None
    pool = Pool(found.form.ring, frozenset(found.form.ring.goal_names))
    cuts = {(split.i, split.j) for split in pool.splits}
    assert cuts == {(0, 1), (0, 3), (0, 4), (1, 3), (1, 4), (2, 3), (2, 4)}


def test_no_equation_is_longer_than_it_needs_to_be() -> None:
    """No equation that is compared has more than 16 terms: arms that are taught, and two whose
    squares are short only where what is known stands on one side."""
    for name in ("planar_2r", "spherical_rrp", "scara_rrpr", "minimover_5r", "stanford_textbook",
                 "puma560", "ur5", "ikbt_KR16", "three_parallel_only"):  # fmt: skip
        form = derived(DATA / "tables" / f"{name}.yaml")[0].form
        assert form is not None
        for step in form.steps:
            for used in step.equations:
                assert len(used.element) <= 16, (name, form.ring.unknown_expression(step.unknown))


def test_the_numbers_name_their_branches() -> None:
    table = DATA / "tables" / "planar_2r.yaml"
    found = derived(table)[0]
    goal = pose_of(arm_of(table), np.array([0.5, 0.8])).tolist()
    solved = Solved(goal, solver_of(table).solve(goal))
    text = render_chapters(inverse_document(found, solved).chapters[-2:-1], width=200)
    assert "It has two solutions, angles in degrees" in text
    first = next(line for line in text.splitlines() if line.startswith("  1 "))
    assert first.split() == ["1", "28.648°", "45.837°"]
    assert "1: right-hand solution." in text
    assert "2: left-hand solution." in text


# ---------------------------------------------------------------- what branches are called


def names_and_poses(name: str, count: int) -> tuple[Branches, list[tuple[Any, Any]]]:
    """Branches of a table, and each answer for some goals with the joint values of it."""
    table = DATA / "tables" / f"{name}.yaml"
    form = derived(table)[0].form
    assert form is not None
    found = []
    for goal in pose_of(arm_of(table), arm_of(table).seeded_poses(count, seed=21)):
        answers = solver_of(table).solve(goal.tolist())
        found += [(answer.branches, np.array(answer.q)) for answer in answers]
    return branches_of(form), found


def origin(name: str, q: np.ndarray, frame: int) -> np.ndarray:
    return np.asarray(pose_of(arm_of(DATA / "tables" / f"{name}.yaml"), q, 0, frame)[:3, 3])


@pytest.mark.parametrize("name", ["puma560", "staubli_tx40", "abb_irb140", "elbow_3r"])
def test_elbow_up_is_up(name: str) -> None:
    """Standard tables: frame 1 is at the shoulder, 2 at the elbow, and the wrist is after link 3.

    Seen along the axes, the elbow is up where it is higher than the line from the shoulder to the
    wrist; poses with the wrist above or below the shoulder are left out.
    """
    branches, found = names_and_poses(name, 20)
    arm = arm_of(DATA / "tables" / f"{name}.yaml")
    wrist = 3 if name == "elbow_3r" else 4
    tried = 0
    for taken, q in found:
        hinge = pose_of(arm, q, 0, 1)[:3, 2]
        ahead = np.cross(hinge, [0.0, 0.0, 1.0])
        shoulder, elbow, hand = (origin(name, q, frame) for frame in (1, 2, wrist))
        reached, bent = np.dot(ahead, hand - shoulder), np.dot(ahead, elbow - shoulder)
        if abs(reached) > 0.05:
            height = (elbow - shoulder)[2] - (hand - shoulder)[2] * bent / reached
            tried += 1
            assert ("elbow up" in branches.names(taken, q)) == (height > 0)
    assert tried > len(found) / 2


def test_the_left_shoulder_is_left() -> None:
    """PUMA: the wrist centre is d_3 off the plane of the arm, along z of frame 1."""
    branches, found = names_and_poses("puma560", 10)
    arm = arm_of(DATA / "tables" / "puma560.yaml")
    for taken, q in found:
        goal = origin("puma560", q, 4)
        hinge = pose_of(arm, q, 0, 1)[:3, 2]
        offset = np.dot(goal, hinge) * hinge
        left = np.cross(goal, offset)[2] > 0
        assert ("shoulder left" in branches.names(taken, q)) == left


def test_the_right_hand_solution_has_the_elbow_on_the_right() -> None:
    branches, found = names_and_poses("planar_2r", 20)
    assert branches.steps[0].names == ("right-hand solution", "left-hand solution")
    for taken, q in found:
        elbow, hand = origin("planar_2r", q, 1), origin("planar_2r", q, 2)
        right = np.cross(hand, elbow)[2] < 0
        assert ("right-hand solution" in branches.names(taken, q)) == right


@pytest.mark.parametrize("name", ["abb_irb140", "kuka_kr5", "fanuc_r2000ib_200r"])
def test_an_arm_faces_the_goal_where_its_shoulder_is_on_the_goals_side(name: str) -> None:
    """Standard tables with a_1: the origin of frame 1 is the shoulder, that of 4 the wrist."""
    branches, found = names_and_poses(name, 10)
    met = set()
    for taken, q in found:
        shoulder, wrist = origin(name, q, 1), origin(name, q, 4)
        facing = np.dot(shoulder[:2], wrist[:2]) > 0
        met.add(facing)
        assert ("facing the goal" in branches.names(taken, q)) == facing
    assert len(met) == 2


@pytest.mark.parametrize("name", ["scara_rrpr", "planar_3r", "planar_2r_p"])
def test_the_left_elbow_is_left(name: str) -> None:
    """The elbow is the origin of frame 1; left is seen from above, ahead to the third axis."""
    branches, found = names_and_poses(name, 20)
    for taken, q in found:
        left = np.cross(origin(name, q, 2), origin(name, q, 1))[2] > 0
        assert ("elbow left" in branches.names(taken, q)) == left


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("planar_2r", "joint 1 to the point p"),
        ("elbow_3r", "joint 2 to the point w"),
        ("planar_3r", "joint 1 to the axis of joint 3"),
        ("ur5", "joint 2 to the axis of joint 4"),
        ("puma560", "joint 2 to the centre of the wrist"),
    ],
)
def test_an_elbow_is_beside_the_line_to_what_the_forearm_carries(name: str, line: str) -> None:
    form = derived(DATA / "tables" / f"{name}.yaml")[0].form
    assert form is not None
    features = (step.feature for step in branches_of(form).steps)
    (elbow,) = (each for each in features if each is not None and each.part is Part.ELBOW)
    assert f"the line from the axis of {line}" in elbow.meaning


@pytest.mark.parametrize("name", ["stanford_textbook", "spherical_rrp", "cylindrical_rpp_wrist"])
def test_a_slide_is_forward_where_its_d_is_positive(name: str) -> None:
    branches, found = names_and_poses(name, 10)
    for taken, q in found:
        assert ("slide 3 forward" in branches.names(taken, q)) == (q[2] > 0)


def names_of(form: ClosedForm | Tried) -> set[str]:
    assert isinstance(form, ClosedForm)
    steps = branches_of(form).steps
    return {name for step in steps if step.feature is not None for name in step.feature.names}


def test_a_slide_whose_sign_hangs_on_a_letter_is_not_called_forward() -> None:
    """d = d_3 + h: without a number for h nobody can say which d_3 is out along the axis."""
    text = (DATA / "tables" / "spherical_rrp.yaml").read_text().replace("d: d3", "d: d3 + h")
    assert not {name for name in names_of(closed_form(symdh.loads(text))) if "slide" in name}
    known = symdh.loads(text.replace("values: {", "values: {h: -2, "))
    assert names_of(closed_form(known)) >= {"slide 3 forward", "slide 3 backward"}
    # d is 0.5, and d_3 itself 2.5; and -0.5 and 1.5 for the other value.
    form = closed_form(known)
    assert isinstance(form, ClosedForm)
    branches = branches_of(form)
    solver = inverse_kinematics(known).solver()
    for answer in solver.solve(solver.judge.chain.pose((0.3, 0.8, 2.5))):
        forward = answer.q[2] - 2 > 0
        assert ("slide 3 forward" in branches.names(answer.branches, answer.q)) == forward


@pytest.mark.parametrize(("twist", "named"), [(90, True), (40, False)])
def test_an_elbow_is_up_where_its_axis_is_level(twist: int, named: bool) -> None:
    """Axes 2 and 3 at 40 deg to the first: there is no up or left that the elbow could be."""
    text = f"""
name: tilted
convention: standard
units: {{angle: deg, length: m}}
joints:
  - {{theta: theta1, d: 0.3, a: 0.2, alpha: {twist} deg}}
  - {{theta: theta2, d: 0, a: 0.4, alpha: 0}}
  - {{theta: theta3, d: 0, a: 0.3, alpha: 0}}
"""
    names = names_of(closed_form(symdh.loads(text), "x y z"))
    assert any("elbow" in name for name in names) == named


def test_an_elbow_that_is_held_is_neither_up_nor_down() -> None:
    arm = symdh.load(DATA / "tables" / "elbow_3r.yaml")
    assert any("elbow" in name for name in names_of(closed_form(arm, "x y z")))
    assert not any(
        "elbow" in name for name in names_of(closed_form(arm, "x z", [symbol("theta3")]))
    )


QUARTIC = """
name: three_parallel
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.3, a: 0.1, alpha: 90 deg}
  - {theta: theta2, d: 0.1, a: 0.3, alpha: 0}
  - {theta: theta3, d: 0.2, a: 0.25, alpha: 0}
  - {theta: theta4, d: 0.1, a: 0.15, alpha: 90 deg}
  - {theta: theta5, d: 0.12, a: 0.1, alpha: -90 deg}
  - {theta: theta6, d: 0.1, a: 0.05, alpha: 0}
"""


def test_the_roots_of_a_quartic_are_numbered() -> None:
    """Of four roots any two may be real, and no side of the arm tells which."""
    form = closed_form(symdh.loads(QUARTIC))
    assert isinstance(form, ClosedForm)
    first = branches_of(form).steps[0]
    assert first.step.rule is Rule.HALF_ANGLE
    assert first.feature is None
    assert first.names == tuple(f"theta5 root {k}" for k in (1, 2, 3, 4))


@pytest.mark.parametrize("name", ["puma560", "ur5", "stanford_textbook"])
def test_a_wrist_is_flipped_where_its_middle_angle_is_negative(name: str) -> None:
    """These wrists have alpha_4 = -alpha_5, so the axes 4 and 6 are in line where theta_5 is 0."""
    branches, found = names_and_poses(name, 6)
    arm = arm_of(DATA / "tables" / f"{name}.yaml")
    flips = set()
    for taken, q in found:
        axes = [pose_of(arm, q, 0, k)[:3, 2] for k in (3, 4, 5)]
        flipped = np.dot(np.cross(axes[0], axes[2]), axes[1]) < 0
        flips.add((flipped, q[4] < 0))
        assert ("wrist flipped" in branches.names(taken, q)) == flipped
    assert len(flips) == 2  # the sign of theta_5 says it too


@pytest.mark.parametrize("name", ["puma560", "scara_rrpr", "stanford_textbook", "staubli_tx40"])
def test_the_table_of_branches_is_that_of_the_answers(name: str) -> None:
    """What the handout calls a combination of branches is what every answer is called."""
    branches, found = names_and_poses(name, 30)
    assert len(branches.together) == math.prod(each.step.branches for each in branches.steps)
    for taken, q in found:
        assert branches.together[taken] == branches.names(taken, q)


def test_a_name_that_depends_on_the_goal_is_not_given_to_a_branch() -> None:
    """UR5: the line from the shoulder to the wrist may point back, so the elbow may be either."""
    branches, found = names_and_poses("ur5", 30)
    elbow = branches.steps[-1]
    assert elbow.names == ()
    met = {(taken, branches.names(taken, q)[-1]) for taken, q in found}
    assert len(met) > len({taken for taken, _ in met})
    assert "depends on the goal" in told("ur5")


# ---------------------------------------------------------------- the command


def test_the_command_derives(run_symdh: Runner) -> None:
    done = run_symdh("ik", DATA / "tables" / "planar_2r.yaml")
    assert done.returncode == 0
    assert "Squared and added, they give" in done.stdout


def test_the_command_solves_a_pose(run_symdh: Runner) -> None:
    table = DATA / "tables" / "planar_2r.yaml"
    done = run_symdh("ik", table, "--pose", "0.6 0.3", "--format", "json")
    solutions = json.loads(done.stdout)["solutions"]
    assert len(solutions) == 2
    for solution in solutions:
        reached = pose_of(arm_of(table), np.array(solution["q"]))
        assert abs(reached[:2, 3] - [0.6, 0.3]).max() < 1e-12


def test_json_names_the_entries_of_a_known_part() -> None:
    """With three joints found, e_rc are the entries of the rotation from frame 3 to frame 6."""
    table = DATA / "tables" / "puma560.yaml"
    steps = json.loads(inverse_json(derived(table)[0]))["steps"]
    (names,) = (step["names"] for step in steps if step["rule"] == "names for known parts")
    arm, q = arm_of(table), np.array([0.3, -0.4, 0.5, 0.6, -0.7, 0.8])
    goal, part = pose_of(arm, q, 0, 6), pose_of(arm, q, 3, 6)
    known = {f"r{r + 1}{c + 1}": goal[r][c] for r in range(3) for c in range(3)}
    known |= {f"theta{k}": q[k - 1] for k in range(1, 7)}
    values = {symbol(name): value for name, value in known.items()}
    assert len(names) == 9
    for name, text in names.items():
        row, column = (int(digit) - 1 for digit in name.removeprefix("e_"))
        value = float(parse_expression(text).evalf(subs=values))
        assert abs(value - part[row][column]) < 1e-12


def test_the_command_solves_the_pose_of_joint_values(run_symdh: Runner) -> None:
    settings = [f"--set=theta{k}={10 * k} deg" for k in range(1, 7)]
    done = run_symdh("ik", DATA / "tables" / "puma560.yaml", *settings, "--near=theta1=10 deg")
    assert done.returncode == 0
    assert "It has eight solutions" in done.stdout
    first = next(line for line in done.stdout.splitlines() if line.startswith("  1 "))
    assert first.split() == ["1", "10°", "20°", "30°", "40°", "50°", "60°"]


def test_the_command_checks(run_symdh: Runner) -> None:
    done = run_symdh("ik", DATA / "tables" / "kuka_iiwa7.yaml", "--lock", "theta3", "--check", "20")
    assert done.returncode == 0
    assert "random poses: 20; joint values found again at 20" in done.stdout


def test_the_command_writes_latex(run_symdh: Runner, tmp_path: Path) -> None:
    done = run_symdh(
        "ik", DATA / "tables" / "scara_rrpr.yaml", "--format", "latex", "-o", "scara.tex"
    )
    assert done.returncode == 0
    assert r"\section{Joint 3}" in (tmp_path / "scara.tex").read_text()


def test_the_command_writes_a_page_and_a_pdf(run_symdh: Runner, tmp_path: Path) -> None:
    require_tool("pdflatex")
    table = DATA / "tables" / "planar_2r.yaml"
    assert run_symdh("ik", table, "--format", "html").returncode == 0
    assert "Joint 2" in (tmp_path / "planar_2r_ik.html").read_text()
    assert run_symdh("ik", table, "--format", "pdf").returncode == 0
    assert (tmp_path / "planar_2r_ik.pdf").read_bytes().startswith(b"%PDF")


def test_a_pipe_gets_no_progress(run_symdh: Runner) -> None:
    done = run_symdh("ik", DATA / "tables" / "puma560.yaml", "--check", "60")
    assert done.stderr == ""


def test_a_terminal_gets_raised_inverses() -> None:
    assert "A₁⁻¹ G = A₂ A₃ A₄ A₅ A₆" in told("puma560")


@pytest.mark.parametrize(
    ("name", "arguments", "status", "message"),
    [
        ("puma560", ["--lock", "theta9"], 2, "theta9 is no joint variable"),
        ("puma560", ["--pose", "1 2 3"], 2, "12 numbers"),
        ("puma560", ["--pose", "1 0 0 0  0 1 0 0  0 1 1 0"], 2, "no rotation"),
        ("puma560", ["--pose", "1 0 0 0  0 1 0 0  0 0 -1 0"], 2, "reflection"),
        ("planar_2r", ["--pose", "0.1 oops"], 2, "plain numbers"),
        ("planar_2r", ["--pose", "0.1 oops"], 2, "'oops' is none"),
        ("planar_2r", ["--task", "x phi q"], 2, "no task"),
        ("planar_2r", ["--task", "x"], 2, "gives 1 number for 2 joints"),
        ("planar_2r", ["--lock", "theta1", "--lock", "theta2"], 2, "every joint locked"),
        ("planar_2r", ["--near", "theta1=1"], 2, "give --pose"),
        ("planar_2r", ["--near", "theta7=1", "--pose", "0.1 0.1"], 2, "--near:1:1: theta7"),
        ("planar_2r", ["--check", "3"], 2, "--check prints a report"),
        ("kuka_iiwa7", [], 2, "--lock"),
        ("pieper_generic", ["--time-limit", "0.001"], 4, "time-limit"),
    ],
)
def test_the_command_refuses(
    run_symdh: Runner, tmp_path: Path, name: str, arguments: list[str], status: int, message: str
) -> None:
    table = DATA / "tables" / f"{name}.yaml"
    done = run_symdh("ik", table, *arguments, "-o", "out.txt")
    assert done.returncode == status
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_hash_seeds_change_nothing(run_symdh: Runner) -> None:
    table = DATA / "tables" / "ur5.yaml"
    texts = {run_symdh("ik", table, env={"PYTHONHASHSEED": seed}).stdout for seed in ("1", "77")}
    assert len(texts) == 1


def test_what_is_stuck_says_how_far_it_came() -> None:
    robot = symdh.load(DATA / "tables" / "ikbt_Issue4.yaml")
    tried = closed_form(robot)
    assert not isinstance(tried, ClosedForm)
    assert tried.missing
    assert not tried.timed_out


def test_a_pose_is_shaken_by_a_small_turn_and_a_small_step() -> None:
    """The turn is I + [w]x to first order, so it is the unit matrix but for what is skew."""
    unit = tuple(tuple(float(r == c) for c in range(4)) for r in range(4))
    direction = [0.1, -0.2, 0.3, 0.5, -0.6, 0.7]
    shaken = np.array(numeric._shaken(unit, 1e-3, 2.0, direction))
    turn = shaken[:3, :3]
    assert np.allclose(turn + turn.T, 2 * np.eye(3), rtol=0, atol=1e-15)
    w = np.array([turn[2, 1], turn[0, 2], turn[1, 0]])
    assert np.allclose(w, [1e-4, -2e-4, 3e-4], rtol=0, atol=1e-15)
    assert np.allclose(shaken[:3, 3], [1e-3, -1.2e-3, 1.4e-3], rtol=0, atol=1e-15)


def test_of_two_slides_along_one_line_one_is_too_many() -> None:
    """The first and the third slide are parallel: five joints, two ways to shift, two to turn.

    The second is found all the same, before the search comes to its end.
    """
    robot = symdh.loads(
        "name: arm\nconvention: standard\nunits: {angle: deg, length: m}\njoints:\n"
        "  - {theta: 0, d: q1, a: 0, alpha: 90}\n"
        "  - {theta: 0, d: q2, a: 0, alpha: 90}\n"
        "  - {theta: 0, d: q3, a: 0, alpha: 40}\n"
        "  - {theta: q4, d: 0.2, a: 0.4, alpha: 50}\n"
        "  - {theta: q5, d: 0.3, a: 0.2, alpha: 20}\n"
    )
    with pytest.raises(UnsupportedError, match="5 joints that move, and they move the hand in 4 w"):
        inverse_kinematics(robot)
    found = inverse_kinematics(robot, locked=[symbol("q1")])
    assert found.method is Method.CLOSED_FORM
    assert tried(found, 30).found == 30
