"""Singularities: the rank of the oracle's Jacobian on the symbolic sets and off them."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from oracle import Arm
from sympy import (
    Add,
    Expr,
    Float,
    Integer,
    Matrix,
    Rational,
    Symbol,
    cos,
    lambdify,
    pi,
    sin,
    sqrt,
    symbols,
    sympify,
    tan,
)
from test_velocity import (
    TABLES,
    arm_of,
    assert_close,
    evaluated,
    expected_jacobian,
    load,
    numbers_of,
    table_named,
)

import symdh
from symdh.derivation.derive import derive
from symdh.derivation.singularity import chapter
from symdh.derivation.style import Style
from symdh.errors import DerivationError, LimitError, UnsupportedError
from symdh.kinematics.frame import Frame
from symdh.kinematics.singular import Factor, Kind, Singularities, singularities
from symdh.kinematics.singular.factors import HalfAngles
from symdh.kinematics.singular.short_form import parallel_runs, short_form
from symdh.kinematics.singular.solving import _angles, zeros
from symdh.kinematics.singular.trig_ring import TrigRing
from symdh.kinematics.velocity import jacobian
from symdh.render.terminal import render_chapters
from symdh.table import parse_expression

ON, OFF = 20, 1000
STARTS = 400
#: Least singular value, beside the largest, under which a matrix has lost rank, and over which it
#: has not: rounding leaves 5e-14 on the singular sets, and no random pose comes nearer than 3e-8.
LOST, KEPT = 1e-11, 1e-9

each_table = pytest.mark.parametrize("table", TABLES, ids=lambda path: path.stem)
THETA = {i: Symbol(f"theta{i}", real=True) for i in range(1, 8)}


@functools.cache
def found_for(table: Path) -> Singularities:
    return singularities(load(table))


def matrices(found: Singularities, arm: Arm, q: np.ndarray) -> np.ndarray:
    """The rows that the result is about, from the oracle; all six where the frame was chosen."""
    whole = expected_jacobian(arm, q)
    return whole[..., list(found.rows), :] if found.point is None else whole


def least(found: Singularities, arm: Arm, q: np.ndarray) -> np.ndarray:
    """The singular value that decides about the rank, beside the largest one."""
    values = np.linalg.svd(matrices(found, arm, q).astype(float), compute_uv=False)
    return np.asarray(values[..., found.rank - 1] / values[..., 0])


def roots(
    robot: symdh.Robot, conditions: tuple[Expr, ...], arm: Arm, count: int
) -> Iterator[np.ndarray]:
    """Yield joint values at which all conditions vanish: Gauss-Newton from random poses."""
    exact = [condition.xreplace(dict(robot.values)) for condition in conditions]
    value = lambdify([robot.variables], exact, "numpy")
    slope = lambdify([robot.variables], [[e.diff(v) for v in robot.variables] for e in exact])
    for q in arm.seeded_poses(STARTS, seed=count):
        for _ in range(60):
            residue = np.array(value(q), dtype=float)
            if np.abs(residue).max() < 1e-14:
                break
            step = np.linalg.lstsq(np.array(slope(q), dtype=float), residue, rcond=1e-8)[0]
            q = q - step * min(1.0, 0.5 / (np.abs(step).max() + 1e-30))
        if np.abs(np.array(value(q), dtype=float)).max() < 1e-12:
            yield q


def first(points: Iterator[np.ndarray], count: int) -> np.ndarray:
    return np.array([q for q, _ in zip(points, range(count), strict=False)])


@each_table
def test_the_rank_drops_where_a_factor_vanishes(table: Path) -> None:
    robot, arm, found = load(table), arm_of(table), found_for(table)
    for factor in found.factors or ():
        points = first(roots(robot, (factor.expression,), arm, ON), ON)
        assert len(points) == ON, factor
        assert least(found, arm, points).max() < LOST, factor


@each_table
def test_plus_prevails_in_a_factor(table: Path) -> None:
    for factor in found_for(table).factors or ():
        terms = factor.expression.as_ordered_terms()
        minus = sum(term.could_extract_minus_sign() for term in terms)
        assert 2 * minus <= len(terms), factor
        assert 2 * minus < len(terms) or not terms[0].could_extract_minus_sign(), factor


@each_table
def test_the_rank_drops_where_all_of_a_remaining_set_vanish(table: Path) -> None:
    robot, arm, found = load(table), arm_of(table), found_for(table)
    for conditions in found.remaining:
        points = first(roots(robot, conditions, arm, ON), ON)
        assert len(points) == ON, conditions
        assert least(found, arm, points).max() < LOST, conditions


@each_table
def test_the_rank_is_kept_off_the_sets(table: Path) -> None:
    robot, arm, found = load(table), arm_of(table), found_for(table)
    q = arm.seeded_poses(OFF, seed=99)
    assert least(found, arm, q).min() > KEPT
    if len(found.joints) > found.rank or found.rank < 6:
        whole = np.linalg.matrix_rank(matrices(found, arm, q).astype(float))
        assert set(whole) == {found.rank}
    for factor in found.factors or ():
        assert np.abs(evaluated(robot, [[factor.expression]], q)).min() > 0


@each_table
def test_the_product_is_the_determinant(table: Path) -> None:
    robot, arm, found = load(table), arm_of(table), found_for(table)
    if not found.is_square or found.factors is None:
        assert len(found.rows) != len(found.joints)
        return
    if found.point is not None and len(found.rows) < 6:
        return  # rows along the axes of a frame of its own; the next test has those
    q = arm.seeded_poses(100, seed=5)
    rows = list(found.rows)
    matrix = expected_jacobian(arm, q, in_=found.frame)[..., rows, :].astype(float)
    product = evaluated(robot, [[found.product]], q)[..., 0, 0]
    assert_close(product, np.linalg.det(matrix), 1e-12)


@pytest.mark.parametrize("name", ["planar_3r", "scara_rrpr", "zyz_wrist", "ikbt_Arm_3"])
def test_the_determinant_of_the_rows_that_are_left(name: str) -> None:
    table = table_named(name)
    robot, arm, found = load(table), arm_of(table), found_for(table)
    assert found.is_square
    assert found.point is not None
    q = arm.seeded_poses(100, seed=6)
    matrix = moved_to(arm, q, found.point, found.frame)
    others = [row for row in range(6) if row not in found.rows]
    assert np.abs(matrix[..., others, :]).max(initial=0) < 1e-12
    product = evaluated(robot, [[found.product]], q)[..., 0, 0]
    assert_close(product, np.linalg.det(matrix[..., list(found.rows), :]), 1e-12)


def moved_to(arm: Arm, q: np.ndarray, point: Frame, frame: Frame) -> np.ndarray:
    """The Jacobian of the last link at the origin of `point`, along the axes of `frame`.

    That origin may stand behind joints that move the link: v' = v + omega x (p' - p).
    """
    whole = expected_jacobian(arm, q, in_=frame)
    numbers = numbers_of(arm, q)
    last, there, turn = (arm.pose(numbers, "base", f) for f in ("tool", point, frame))
    way = np.swapaxes(turn[..., :3, :3], -1, -2) @ (there - last)[..., :3, 3:]
    linear = whole[..., :3, :] + np.cross(whole[..., 3:, :], way, axis=-2)
    return np.concatenate([linear, whole[..., 3:, :]], axis=-2).astype(float)


@each_table
def test_zeros_are_zeros(table: Path) -> None:
    robot, found = load(table), found_for(table)
    for factor in found.factors or ():
        for zero in factor.zeros:
            (variable,) = factor.variables
            number = factor.expression.xreplace({variable: zero}).xreplace(dict(robot.values))
            assert abs(number.evalf(30)) < 1e-25
            assert not zero.atoms(Float)
        turning = [v for v in factor.variables if v in {j.variable for j in robot.joints}]
        assert turning == list(factor.variables)


def factors_of(name: str) -> tuple[Factor, ...]:
    factors = found_for(table_named(name)).factors
    assert factors is not None
    return factors


def test_the_planar_arm() -> None:
    found = found_for(table_named("planar_2r"))
    a1, a2 = symbols("a1 a2", real=True)
    assert found.product == a1 * a2 * sin(THETA[2])
    assert found.rows == (0, 1)
    (factor,) = found.factors or ()
    assert factor.zeros == (0, pi)
    assert factor.meaning is not None
    assert (factor.meaning.kind, factor.meaning.joints) == (Kind.ELBOW, (1, 2))


def test_the_puma() -> None:
    found = found_for(table_named("puma560"))
    a2, a3, d4 = symbols("a2 a3 d4", real=True)
    c23, s23 = cos(THETA[2] + THETA[3]), sin(THETA[2] + THETA[3])
    expected = {
        a2 * cos(THETA[2]) + a3 * c23 - d4 * s23: Kind.SHOULDER,
        a3 * sin(THETA[3]) + d4 * cos(THETA[3]): Kind.ELBOW,
        sin(THETA[5]): Kind.WRIST,
    }
    assert named(found) == expected
    assert (found.point, found.constant) == (4, a2)


def test_the_ur5() -> None:
    found = found_for(table_named("ur5"))
    a2, a3, d5 = symbols("a2 a3 d5", real=True)
    t2, t3, t4 = THETA[2], THETA[3], THETA[4]
    shoulder = a2 * cos(t2) + a3 * cos(t2 + t3) + d5 * sin(t2 + t3 + t4)
    expected = {shoulder: Kind.SHOULDER, sin(t3): Kind.ELBOW, sin(THETA[5]): Kind.WRIST}
    assert named(found) == expected


def named(found: Singularities) -> dict[Expr, Kind | None]:
    assert found.factors is not None
    return {f.expression: f.meaning.kind if f.meaning else None for f in found.factors}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("spherical_rrp", {"sin(theta2)": 1, "d3": 2}),
        ("scara_rrpr", {"sin(theta2)": 1}),
        ("stanford_textbook", {"sin(theta2)": 1, "d3": 2, "sin(theta5)": 1}),
        ("zyz_wrist", {"sin(theta2)": 1}),
        ("cartesian_ppp", {}),
        ("minimover_5r", {"sin(theta3)": 1}),
        ("kuka_iiwa7", {"sin(theta4)": 1}),
    ],
)
def test_factors_of_well_known_arms(name: str, expected: dict[str, int]) -> None:
    assert {str(f.expression): f.power for f in factors_of(name)} == expected


def test_the_arm_with_seven_joints_is_singular_in_pairs_too() -> None:
    found = found_for(table_named("kuka_iiwa7"))
    pairs = {frozenset(map(str, each)) for each in found.remaining}
    assert pairs == {
        frozenset({"sin(theta2)", "sin(theta6)"}),
        frozenset({"sin(theta2)", "cos(theta3)"}),
        frozenset({"sin(theta6)", "cos(theta5)"}),
    }
    assert found.is_complete
    assert not found.is_square


def table_text(rows: str, more: str = "") -> str:
    return (
        "name: arm\nconvention: standard\nunits: {angle: deg, length: m}\n"
        f"columns: [theta, d, a, alpha]\nrows:\n{rows}{more}"
    )


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (lambda c, s: 1 + c, (pi,)),
        (lambda c, s: c - 1, (0,)),
        (lambda c, s: 2 * s + 2, (-pi / 2,)),
        (lambda c, s: s - 1, (pi / 2,)),
        (lambda c, s: c, (-pi / 2, pi / 2)),
        (lambda c, s: 3 * s, (0, pi)),
        (lambda c, s: c + s, (-pi / 4, 3 * pi / 4)),
        (lambda c, s: 1 + 2 * c, (2 * pi / 3, -2 * pi / 3)),
        (lambda c, s: c**2 - s, ()),
    ],
)
def test_zeros_of_one_joint(
    make: Callable[[Any, Any], Any], expected: tuple[Expr | int, ...]
) -> None:
    """By hand: a cos x + b sin x + c = 0."""
    ring = TrigRing(load(table_named("planar_2r")))
    k = ring.angles.index(THETA[2])
    element = make(ring.ring.gens[2 * k], ring.ring.gens[2 * k + 1])
    assert zeros(ring, element, THETA[2]) == expected


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        # t = 1 and t = 2, 90 deg and that of cosine -3/5: (1 - t)(2 - t) = 2 - 3t + t^2.
        (lambda c, s: (3 - 3 * s + c,), {"cos - 3*sin + 3": 1}),
        # t = 1 and t = infinity: (1 - t)(1 + t^2)^-1 = (1 + c - s)/2.
        (lambda c, s: (1 + c - s,), {"cos - sin + 1": 1}),
        # (1 - t)(1 + t) and (1 - t)^2: the odd one of three finds its partner first.
        (lambda c, s: (c, 1 - s), {"cos": 1, "sin - 1": 1}),
        (lambda c, s: (s, s, 1 + c), {"sin": 2, "cos + 1": 1}),
    ],
)
def test_factors_come_back_from_half_angles(
    make: Callable[[Any, Any], Any], expected: dict[str, int]
) -> None:
    """By hand, with c = (1 - t^2)/(1 + t^2) and s = 2t/(1 + t^2)."""
    assert half_factors(lambda halves, c, s: halves.pieces(make(c, s))) == expected


@pytest.mark.parametrize(("letters", "factors"), [(9, 2), (10, 1)])
def test_a_polynomial_in_many_letters_stays_one_factor(letters: int, factors: int) -> None:
    """(x_1 .. x_n + 1)(x_1 .. x_n + 2): 3^n monomials could be in it."""
    halves = HalfAngles(TrigRing(load(table_named("pieper_generic"))))
    product = halves.ring.mul(*halves.ring.gens[:letters])
    assert len(list(halves._split((product + 1) * (product + 2)))) == factors


def test_a_half_that_is_alone_comes_back_as_its_square() -> None:
    """c vanishes at +-90 deg and 1 - s at 90 deg, twice: together at t = 1, once.

    (1 - t)^2/(1 + t^2) = 1 - s vanishes there and nowhere else.
    """
    found = half_factors(lambda halves, c, s: halves.pieces([c]) & halves.pieces([1 - s]))
    assert found == {"sin - 1": 1}


def half_factors(make: Callable[[HalfAngles, Any, Any], Any]) -> dict[str, int]:
    """The factors of a product in half angles of one joint, with their powers."""
    ring = TrigRing(load(table_named("planar_2r")))
    k = ring.angles.index(THETA[2])
    halves = HalfAngles(ring)
    pieces = make(halves, ring.ring.gens[2 * k], ring.ring.gens[2 * k + 1])
    names = {cos(THETA[2]): Symbol("cos"), sin(THETA[2]): Symbol("sin")}
    return {str(ring.expression(f).xreplace(names)): power for f, power in halves.factors(pieces)}


def test_a_long_run_of_parallel_joints_is_read_as_single_functions() -> None:
    rows = "".join(f"  - [q{i}, 0, a{i}, 0]\n" for i in (1, 2, 3, 4, 5))
    robot = symdh.loads(table_text(rows))
    ring = TrigRing(robot)
    runs = parallel_runs(ring, robot)
    assert [len(run.angles) for run in runs] == [5]
    whole = Add(*robot.variables)
    cosine, sine = ring.cosine_and_sine(whole)
    assert len(cosine) == len(sine) == 16
    assert short_form(ring, runs, cosine - 3 * sine) == cos(whole) - 3 * sin(whole)


def test_a_joint_that_turns_the_other_way_is_taken_off() -> None:
    robot = symdh.loads(table_text("  - [q1, 0, a1, 0]\n  - [-q2, 0, a2, 0]\n"))
    ring = TrigRing(robot)
    q1, q2 = robot.variables
    whole = ring.product(ring.cosine_and_sine(q1)[0], ring.cosine_and_sine(q1 - q2)[0])
    assert len(whole) == 2
    assert short_form(ring, parallel_runs(ring, robot), whole) == cos(q1) * cos(q1 - q2)


def test_one_turning_joint_between_slides() -> None:
    """The slides are z_0 and z_2 = s_2 x_0 - c_2 z_0, in line where theta_2 is 0 or 180 deg.

    That is no wrist, no elbow and no shoulder: there is one axis alone.
    """
    rows = "  - [0, d1, 0, 90]\n  - [q2, 0, a2, 90]\n  - [0, d3, 0, 0]\n"
    found = singularities(symdh.loads(table_text(rows)))
    (factor,) = found.factors or ()
    assert abs(found.product) == abs(sin(Symbol("q2", real=True)))
    assert set(factor.zeros) == {0, pi}
    assert factor.meaning is None


@pytest.mark.parametrize(
    "at", [(Symbol("b", real=True), Symbol("a", real=True), 0), (pi, tan(pi / 12), sqrt(2))]
)
def test_a_point_may_have_lengths_that_the_table_has_not(at: tuple[Expr, Expr, Expr]) -> None:
    q1, q2, a1, a2 = (Symbol(name, real=True) for name in ("q1", "q2", "a1", "a2"))
    robot = symdh.loads(table_text("  - [q1, 0, a1, 0]\n  - [q2, 0, a2, 0]\n"))
    found = singularities(robot, at=[sympify(x) for x in at])
    x, y = at[0] + a2, at[1]
    hand = Matrix(
        [
            a1 * cos(q1) + x * cos(q1 + q2) - y * sin(q1 + q2),
            a1 * sin(q1) + x * sin(q1 + q2) + y * cos(q1 + q2),
        ]
    )
    determinant = hand.jacobian([q1, q2]).det()
    for numbers in ((0.3, 0.8, 1.1, 0.7), (-2.1, 0.4, 0.6, 0.9)):
        known = dict(zip((q1, q2, a1, a2), numbers, strict=True))
        known |= {Symbol("a", real=True): 0.35, Symbol("b", real=True): -0.2}
        wanted = abs(determinant.subs(known).evalf())
        assert abs(abs(found.product.subs(known).evalf()) - wanted) < 1e-12


def test_lengths_may_be_sums_and_powers() -> None:
    found = singularities(symdh.loads(table_text("  - [q1, 0, L + 1, 0]\n  - [q2, 0, L**2, 0]\n")))
    L, q2 = Symbol("L", real=True), Symbol("q2", real=True)
    assert (found.product - (L + 1) * L**2 * sin(q2)).expand() == 0


def test_one_turning_joint_and_two_slides() -> None:
    """A cylindrical arm is singular where the hand is on the first axis: det J = d3."""
    rows = "  - [q1, 0, 0, 0]\n  - [0, d2, 0, -90]\n  - [0, d3, 0, 0]\n"
    found = singularities(symdh.loads(table_text(rows)))
    assert abs(found.product) == abs(Symbol("d3", real=True))


def test_factors_that_do_not_make_the_determinant_are_no_result(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = HalfAngles.factors
    monkeypatch.setattr(HalfAngles, "factors", lambda self, minor: whole(self, minor)[1:])
    with pytest.raises(DerivationError, match="the factors of planar_2r do not make its determ"):
        singularities(load(table_named("planar_2r")))


def test_redundant_planar_arm() -> None:
    found = singularities(
        symdh.loads(table_text("".join(f"  - [q{i}, 0, a{i}, 0]\n" for i in (1, 2, 3, 4))))
    )
    assert (found.rank, len(found.joints), found.factors) == (3, 4, ())
    assert [sorted(map(str, each)) for each in found.remaining] == [["sin(q2)", "sin(q3)"]]


def test_two_joints_on_one_axis_cost_a_rank() -> None:
    """Joints 1 and 2 turn about one line, joint 3 about one at right angles to it.

    So two columns are equal at every pose, and the third is never a multiple of them.
    """
    rows = "  - [q1, 0, 0, 0]\n  - [q2, 0, a2, 90]\n  - [q3, 0, a3, 0]\n"
    found = singularities(symdh.loads(table_text(rows)))
    assert (found.rank, len(found.joints), found.factors, found.remaining) == (2, 3, (), ())
    text = " ".join(render_chapters([chapter(Style(found.robot), found)]).split())
    assert (
        "The matrix J has the rank 2 at best. It loses rank where all minors of two rows and "
        "columns vanish. They have no factor in common that depends on the pose." in text
    )
    assert "drops" not in text


def test_gear_offset_and_symbolic_twist() -> None:
    rows = "  - [2*q1, 0, a1, 0]\n  - [30 deg - 3*q2, 0, a2, 0]\n"
    (factor,) = singularities(symdh.loads(table_text(rows))).factors or ()
    assert {zero - factor.zeros[0] for zero in factor.zeros} == {0, pi / 3}
    for zero in factor.zeros:
        turn = (pi / 6 - 3 * zero) / pi
        assert turn.is_Integer or abs(turn.evalf(20) - round(turn.evalf(20))) < 1e-15
    twisted = singularities(
        symdh.loads(table_text("  - [q1, 0, a1, alpha1]\n  - [q2, 0, a2, 0]\n"))
    )
    assert twisted.rank == 2


def test_an_elbow_may_be_stretched_by_the_tool() -> None:
    """The last frame lies on axis 2; only the tool is ahead of it."""
    text = table_text("  - [theta1, 0, a1, 0]\n  - [theta2, 0, 0, 0]\n", "tool: [Tx(L)]\n")
    (factor,) = singularities(symdh.loads(text)).factors or ()
    assert factor.meaning is not None
    assert factor.meaning.kind is Kind.ELBOW
    assert (factor.meaning.joints, factor.meaning.point) == ((1, 2), "tool")


def test_a_point_matters_where_positions_are_looked_at() -> None:
    robot = load(table_named("planar_2r"))
    tip = singularities(robot, at=(Rational(0), Rational(1), Rational(0)))
    (factor,) = tip.factors or ()
    a2 = Symbol("a2", real=True)
    assert (factor.expression - (a2 * sin(THETA[2]) + cos(THETA[2]))).is_zero
    assert len(factor.zeros) == 2


@pytest.mark.parametrize(
    ("module", "limit", "least", "name"),
    [
        ("determinant", "MAX_TERMS", 3, "pieper_generic"),
        ("factors", "MAX_READ", 3, "pieper_generic"),
        ("singularities", "MAX_ENTRIES", 20, "pieper_generic"),
        # Seven columns for a rank of six: seven minors.
        ("singularities", "MAX_MINORS", 6, "kuka_iiwa7"),
    ],
)
def test_an_arm_over_the_limit_says_so(
    module: str, limit: str, least: int, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # By its full name: the package has a function of that of the last module.
    monkeypatch.setattr(import_module(f"symdh.kinematics.singular.{module}"), limit, least)
    robot = load(table_named(name))
    found = singularities(robot)
    assert found.factors is None
    with pytest.raises(UnsupportedError, match="limit"):
        _ = found.product
    text = render_chapters([chapter(Style(robot), found)])
    assert "over symdh's limit" in " ".join(text.split())


@pytest.mark.parametrize(
    ("a", "b", "c", "count"),
    [
        (3, 4, 2, 2),
        (3, -4, 2, 2),
        (0, 3, 1, 2),
        (2, 0, -1, 2),
        (1, -5, 0, 2),
        (0, 2, 0, 2),
        (2, 0, 0, 2),
        (3, 0, 3, 1),
        (3, 0, -3, 1),
        (0, 3, 3, 1),
        (0, 3, -3, 1),
    ],
)
def test_every_angle_of_an_equation(a: int, b: int, c: int, count: int) -> None:
    """Put in, as numbers: a cos x + b sin x + c = 0."""
    angles = [float(x.evalf(20)) for x in _angles(Integer(a), Integer(b), Integer(c))]
    assert all(abs(a * math.cos(x) + b * math.sin(x) + c) < 1e-14 for x in angles)
    assert len({round(math.cos(x) + 2 * math.sin(x), 9) for x in angles}) == len(angles) == count


def test_as_many_minors_as_the_limit_allows_are_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    module = import_module("symdh.kinematics.singular.singularities")
    monkeypatch.setattr(module, "MAX_MINORS", 7)
    table = table_named("kuka_iiwa7")
    assert singularities(load(table)).factors == found_for(table).factors


def test_too_many_alternatives_are_not_written_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """The factors stand, and it is said that they are not all; see the same arm without a limit."""
    monkeypatch.setattr("symdh.kinematics.singular.conditions.MAX_ALTERNATIVES", 1)
    found = singularities(load(table_named("kuka_iiwa7")))
    assert found.factors == found_for(table_named("kuka_iiwa7")).factors
    assert (found.remaining, found.is_complete) == ((), False)
    text = render_chapters([chapter(Style(found.robot), found)])
    assert "too long to be written out" in " ".join(text.split())


def test_many_joints_are_refused_at_once(run_symdh: Runner, tmp_path: Path) -> None:
    rows = "".join(f"  - [q{i}, 0, a{i}, 0]\n" for i in range(1, 31))
    snake = symdh.loads(table_text(rows))
    with pytest.raises(LimitError, match="at most 8"):
        singularities(snake)
    with pytest.raises(LimitError, match="limit of 20"):
        jacobian(snake)
    titles = [chapter.title for chapter in derive(snake).chapters]
    assert not {"Velocity", "Singularities"} & set(titles)
    (tmp_path / "snake.yaml").write_text(table_text(rows))
    assert run_symdh("singular", "snake.yaml").returncode == 4
    assert run_symdh("jacobian", "snake.yaml").returncode == 4


def test_no_joint_no_singularity() -> None:
    with pytest.raises(UnsupportedError, match="no joint"):
        singularities(load(table_named("planar_2r")), of=0)


def test_what_is_not_told_is_said_not_to_be() -> None:
    found = found_for(table_named("sawyer"))
    assert (found.factors, found.remaining, found.is_complete) == ((), (), False)
    text = render_chapters([chapter(Style(found.robot), found)])
    assert "too long to be written out" in " ".join(text.split())


def test_the_command_in_json(run_symdh: Runner) -> None:
    table = table_named("ur5")
    ran = run_symdh("singular", table, "--format", "json")
    assert (ran.returncode, ran.stderr) == (0, "")
    printed = json.loads(ran.stdout)
    product = parse_expression(printed["constant"])
    for factor in printed["factors"]:
        product = product * parse_expression(factor["expression"]) ** factor["power"]
    q = arm_of(table).seeded_poses(20, seed=3)
    robot = load(table)
    expected = np.linalg.det(expected_jacobian(arm_of(table), q).astype(float))
    assert_close(evaluated(robot, [[product]], q)[..., 0, 0], expected, 1e-12)
    assert [f["name"] for f in printed["factors"]] == ["shoulder", "elbow", "wrist"]


def test_the_command_in_words(run_symdh: Runner) -> None:
    ran = run_symdh("singular", table_named("planar_2r"), env={"COLUMNS": "80"})
    assert "det(J) = a₁ a₂ s₂" in ran.stdout
    assert "θ₂ = 0 or θ₂ = 180°" in " ".join(ran.stdout.split())
    latex = run_symdh("singular", table_named("planar_2r"), "--format", "latex")
    assert r"\operatorname{det}(J) & = a_{1} a_{2} s_{2}" in latex.stdout


def test_the_chapter_stands_in_the_handout() -> None:
    titles = [chapter.title for chapter in derive(load(table_named("scara_rrpr"))).chapters]
    assert titles[-3:] == ["Velocity", "Singularities", "Numbers"]
