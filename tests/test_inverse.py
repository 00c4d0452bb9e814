"""Inverse kinematics: derived where there is a closed form, right at every pose, else honest."""

from __future__ import annotations

import functools
import json
import math
import os
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from conftest import Runner
from oracle import Arithmetic, Arm, read_arm, read_arm_file
from sympy import Float, Symbol

import symdh
from symdh.derivation.inverse import Solved, inverse_document
from symdh.errors import LimitError, UnsupportedError
from symdh.kinematics.inverse.fallback import nominal
from symdh.kinematics.inverse.inverse import InverseKinematics, Method, inverse_kinematics
from symdh.kinematics.inverse.roots import real_angles
from symdh.kinematics.inverse.search import closed_form
from symdh.kinematics.inverse.solution import ClosedForm, Rule
from symdh.kinematics.inverse.task import Kind
from symdh.render.latex import render_latex
from symdh.render.terminal import render_chapters

DATA = Path(__file__).parent / "data"
TABLES = sorted((DATA / "tables").glob("*.yaml"))
INDEX = {entry["name"]: entry for entry in yaml.safe_load((DATA / "index.yaml").read_text())}
CLOSED = [path for path in TABLES if INDEX[path.stem]["expect"]["closed_form"]]
OPEN = [path for path in TABLES if not INDEX[path.stem]["expect"]["closed_form"]]

#: The joint that is held in the arms with seven, and what at.
LOCKS = {"franka_panda": "theta7", "kuka_iiwa7": "theta3", "sawyer": "theta3"}
HELD = 0.3
#: Random poses of each table; SYMDH_IK_POSES asks for more.
POSES = int(os.environ.get("SYMDH_IK_POSES", "100"))

FLOATS = Arithmetic(float, lambda x: np.asarray(x, dtype=float), np.pi, np.cos, np.sin, float)

each_closed = pytest.mark.parametrize("table", CLOSED, ids=lambda path: path.stem)


def symbol(name: str) -> Symbol:
    return Symbol(name, real=True)


def locks_of(table: Path) -> list[Symbol]:
    return [symbol(LOCKS[table.stem])] if table.stem in LOCKS else []


@functools.cache
def derived(table: Path) -> tuple[InverseKinematics, float]:
    """The inverse kinematics of a table, and the CPU seconds that it took."""
    robot = symdh.load(table)
    begin = time.process_time()
    found = inverse_kinematics(robot, None, locks_of(table))
    return found, time.process_time() - begin


@functools.cache
def solver_of(table: Path) -> Any:
    return derived(table)[0].solver({v: Float(HELD) for v in locks_of(table)})


@functools.cache
def arm_of(table: Path) -> Arm:
    return read_arm_file(table)


def pose_of(arm: Arm, q: np.ndarray) -> np.ndarray:
    """The oracle's poses of joint values (..., n)."""
    named = {name: q[..., k] for k, (name, _) in enumerate(arm.variables)}
    return np.asarray(arm.pose(named, arithmetic=FLOATS), dtype=float)


def held(table: Path, q: np.ndarray) -> np.ndarray:
    for k, (name, _) in enumerate(arm_of(table).variables):
        if name == LOCKS.get(table.stem):
            q[..., k] = HELD
    return q


def apart(arm: Arm, a: Any, b: Any) -> float:
    """Largest difference of joint values, angles up to full turns."""
    return max(
        abs(math.remainder(x - y, 2 * math.pi) if turns else x - y)
        for x, y, (_, turns) in zip(a, b, arm.variables, strict=True)
    )


def reach_of(arm: Arm) -> float:
    """The oracle's reach; a wrist has none, and its tolerance is that of a metre."""
    return arm.reach() or 1.0


def missed_by(arm: Arm, found: InverseKinematics, answers: Any, goal: np.ndarray) -> float:
    """By how much the oracle's poses of the answers miss what the task asks for."""
    if not answers:
        return 0.0
    error = abs(pose_of(arm, np.array([answer.q for answer in answers])) - goal)
    worst = max((error[:, axis, 3].max() for axis in found.task.axes), default=0.0)
    if found.task.with_orientation:
        worst = max(worst, reach_of(arm) * error[:, :3, :3].max())
    return float(worst)


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


def newton_from_everywhere(
    arm: Arm, found: InverseKinematics, goal: np.ndarray, truth: np.ndarray, free: list[int]
) -> list[np.ndarray]:
    """Damped least squares on the oracle's pose from 400 random starts, all at once."""
    rng = np.random.default_rng(5)
    q = np.repeat(truth[None, :], 400, axis=0)
    spread = np.array([np.pi if turns else 1.0 for _, turns in arm.variables])
    q[:, free] = rng.uniform(-1, 1, (400, len(free))) * spread[free]
    rows = [(axis, 3) for axis in found.task.axes]
    if found.task.with_orientation:
        rows += [(r, c) for r in range(3) for c in range(3)]
    pick = tuple(np.array(rows).T)

    def residual(values: np.ndarray) -> np.ndarray:
        error = pose_of(arm, values) - goal
        return np.asarray(error[..., pick[0], pick[1]])

    damping = np.full(len(q), 1e-2)
    error = residual(q)
    for _ in range(80):
        slope = np.stack(
            [(residual(q + 1e-6 * np.eye(q.shape[1])[k]) - error) / 1e-6 for k in free], axis=-1
        )
        normal = np.einsum("sra,srb->sab", slope, slope)
        normal += damping[:, None, None] * np.eye(len(free))
        step = np.linalg.solve(normal, np.einsum("sra,sr->sa", slope, -error)[..., None])[..., 0]
        trial = q.copy()
        trial[:, free] += step
        new = residual(trial)
        better = (new**2).sum(axis=1) < (error**2).sum(axis=1)
        q[better], error[better] = trial[better], new[better]
        damping = np.where(better, damping / 4, damping * 4).clip(1e-14, 1e6)
    solutions: list[np.ndarray] = []
    for values, miss in zip(q, error, strict=True):
        new = all(apart(arm, values, other) > 1e-4 for other in solutions)
        if abs(miss).max() < 1e-8 and new:
            solutions.append(values)
    return solutions


@each_closed
def test_singular_poses_have_answers(table: Path) -> None:
    """Multiples of 90 degrees, single joints at and near them, a straight wrist and elbow."""
    arm = arm_of(table)
    rng = np.random.default_rng(9)
    turns = np.array([turning for _, turning in arm.variables])
    count = len(turns)
    right = rng.integers(-1, 3, (60, count)) * np.pi / 2
    sets = [np.where(turns, right, rng.uniform(-0.5, 0.5, (60, count)))]
    for joint in (2, 4):
        for small in (0.0, 1e-7):
            if joint < count and turns[joint]:
                q = arm.seeded_poses(20, seed=joint)
                q[:, joint] = small
                sets.append(q)
    q = held(table, np.concatenate(sets))
    answered = 0
    for goal in pose_of(arm, q):
        answers = solver_of(table).solve(goal.tolist())
        answered += bool(answers)
        assert missed_by(arm, derived(table)[0], answers, goal) < 1e-9 * reach_of(arm)
    assert answered >= 0.99 * len(q)


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


def test_a_quadratic_in_a_slide_has_two_values() -> None:
    text = """
name: slanted
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0.3, a: 0.2, alpha: 90 deg}
  - {theta: 0, d: q2, a: 0.1, alpha: 60 deg}
"""
    robot, arm = symdh.loads(text), read_arm(text)
    found = inverse_kinematics(robot, "x y")
    assert found.method is Method.CLOSED_FORM
    for truth in arm.seeded_poses(20, seed=3):
        answers = found.solver().solve(pose_of(arm, truth).tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6


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


def calibrated_ur5() -> str:
    text = (DATA / "tables" / "ur5.yaml").read_text()
    text = text.replace("a: 0, alpha: 90 deg}", "a: 0.00002, alpha: 90.001 deg}", 1)
    return text.replace("d: 0, a: a3, alpha: 0}", "d: 0.00003, a: a3, alpha: 0.002 deg}")


def test_a_calibrated_arm_is_solved_by_its_nominal_arm() -> None:
    text = calibrated_ur5()
    robot, arm = symdh.loads(text), read_arm(text)
    found = inverse_kinematics(robot)
    assert found.method is Method.NOMINAL
    assert "nominal arm" in render_chapters(inverse_document(found).chapters, width=2000)
    solver = found.solver()
    q = arm.seeded_poses(30, seed=1)
    for truth, goal in zip(q, pose_of(arm, q), strict=True):
        answers = solver.solve(goal.tolist())
        assert min(apart(arm, answer.q, truth) for answer in answers) < 1e-6
        assert missed_by(arm, found, answers, goal) < 1e-9 * reach_of(arm)


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


def test_an_impossible_task_is_refused() -> None:
    puma = symdh.load(DATA / "tables" / "puma560.yaml")
    with pytest.raises(UnsupportedError, match="3 numbers for 6 joints"):
        inverse_kinematics(puma, "x y z")
    with pytest.raises(UnsupportedError, match="no task"):
        inverse_kinematics(puma, "roll")


# ---------------------------------------------------------------- what is told


def told(name: str, lock: str | None = None) -> str:
    robot = symdh.load(DATA / "tables" / f"{name}.yaml")
    found = inverse_kinematics(robot, None, [symbol(lock)] if lock else [])
    return render_chapters(inverse_document(found).chapters, width=200)


def test_the_planar_arm_follows_the_lecture() -> None:
    """Squared and added; the arccosine; rho and psi; theta_1 = psi - atan2(x, y)."""
    text = told("planar_2r")
    route = [
        "p_x = a₁ c₁ + a₂ c₁₂",
        "p_y = a₁ s₁ + a₂ s₁₂",
        "p_x² + p_y² = a₁² + a₂² + 2 a₁ a₂ c₂",
        "So\n\n  c₂ = (p_x² - a₁² - a₂² + p_y²)/(2 a₁ a₂)",
        "arccosine",
        "right-hand solution, elbow down, (2) left-hand solution",
        "k₁ = a₁ + a₂ c₂",
        "k₁ = ρ₁ sin ψ₁",
        "a₂ s₂ = ρ₁ cos ψ₁",
        "p_x = ρ₁ sin(ψ₁ - θ₁)",
        "p_y = ρ₁ cos(ψ₁ - θ₁)",
        "θ₁ = ψ₁ - atan2(p_x, p_y)",
    ]
    place = 0
    for line in route:
        assert line in text[place:], line
        place = text.index(line, place)


def test_the_structure_stands_at_the_start() -> None:
    puma = told("puma560")
    assert puma.index("joints 4, 5 and 6 meet in one point") < puma.index("Step 1")
    ur5 = told("ur5")
    assert ur5.index("joints 2, 3 and 4 are parallel") < ur5.index("Step 1")
    assert "w_x = p_x - d₆ r₁₃" in ur5
    shoulder = told("spherical_shoulder_6r")
    assert shoulder.index("centre of the shoulder") < shoulder.index("Step 1")


@each_closed
def test_each_step_tells_its_unknown_once_and_compiles_to_latex(table: Path) -> None:
    found = derived(table)[0]
    form = found.form
    assert form is not None
    found_unknowns = [step.unknown for step in form.steps if not step.definitions]
    assert len(found_unknowns) == len(set(found_unknowns))
    document = inverse_document(found)
    assert len(document.chapters) == len(form.steps) + 2
    tex = render_latex(document)
    assert tex.count(r"\section{Step") == len(form.steps)


@each_closed
def test_symbols_are_introduced_before_they_are_used(table: Path) -> None:
    """An unknown that a step uses, and a name of a known part, has been found before."""
    form = derived(table)[0].form
    assert form is not None
    ring = form.ring
    known: set[int] = set()
    named: set[int] = set()
    for step in form.steps:
        elements = [element for _, element in step.definitions]
        if step.rule is not Rule.HALF_ANGLE:
            elements += step.coefficients
        for element in elements:
            for powers in element:
                for k, power in enumerate(powers):
                    if power and k < 2 * len(ring.forms):
                        assert k // 2 in known
                    if power and k >= ring.first_name:
                        assert k in named
        named |= {generator for generator, _ in step.definitions}
        assert {part for _, part in step.parts} <= known
        known.add(step.unknown)


def test_no_equation_is_longer_than_it_needs_to_be() -> None:
    """The arms that are taught: no equation that is compared has more than 16 terms."""
    for name in ("planar_2r", "spherical_rrp", "scara_rrpr", "minimover_5r", "stanford_textbook",
                 "puma560", "ur5"):  # fmt: skip
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
    text = render_chapters(inverse_document(found, solved).chapters[-1:], width=200)
    assert "It has two solutions, angles in degrees" in text
    first = next(line for line in text.splitlines() if line.startswith("  1 "))
    assert first.split() == ["1", "28.648°", "45.837°"]
    assert "1: right-hand solution, elbow down." in text


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
    assert r"\section{Step 1: joint 3}" in (tmp_path / "scara.tex").read_text()


@pytest.mark.parametrize(
    ("name", "arguments", "status", "message"),
    [
        ("puma560", ["--lock", "theta9"], 2, "theta9 is no joint variable"),
        ("puma560", ["--pose", "1 2 3"], 2, "12 numbers"),
        ("puma560", ["--pose", "1 0 0 0  0 1 0 0  0 1 1 0"], 2, "no rotation"),
        ("puma560", ["--pose", "1 0 0 0  0 1 0 0  0 0 -1 0"], 2, "reflection"),
        ("planar_2r", ["--pose", "0.1 oops"], 2, "plain numbers"),
        ("planar_2r", ["--task", "x phi q"], 2, "no task"),
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
