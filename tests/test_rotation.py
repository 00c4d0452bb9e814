"""Rotations: composing them, extracting angles, axis and quaternion, and `symdh rotate`.

The oracle multiplies elementary matrices of tests/oracle.py and builds rotations from axes and
quaternions by formulas written here; nothing is shared with the package.
"""

from __future__ import annotations

import json
import math
import re
import subprocess
from itertools import permutations, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from evaluate import MP, number, value_of
from oracle import EXTENDED, elementary, read_arm, read_arm_file
from sympy import Expr, ImmutableMatrix, Symbol, cos, pi, sin

from symdh.cli.main import run
from symdh.errors import TableError, UnsupportedError
from symdh.kinematics.rotation import (
    SEQUENCES,
    About,
    EulerSequence,
    Step,
    axis_angle,
    compose,
    degenerate_formula,
    describe,
    euler_angles,
    euler_formulas,
    inverse_rates,
    named_sequence,
    nearest_rotation,
    of_arm,
    quaternion,
    rates,
    rates_vanish,
    read_off,
)
from symdh.motion import rotation as turn
from symdh.robot import Axis, Units
from symdh.table import load_table, parse_expression, parse_point
from symdh.table.rotations import (
    parse_matrix,
    parse_rotations,
    read_rotation_sheet,
)
from symdh.table.source import from_text
from tools import require_tool

ROOT = Path(__file__).parent.parent
TABLES = Path(__file__).parent / "data" / "tables"
QUIZ = "Rx(45 deg) body, Ry(60 deg) body, Rz(90 deg) fixed"
NAMES = sorted(
    {*("".join(p) for p in permutations("xyz", 3))} | {a + b + a for a, b in permutations("xyz", 2)}
)
COUNT = 10_000
Capture = pytest.CaptureFixture[str]


def multiplied(name: str, angles: np.ndarray) -> np.ndarray:
    """R_i(first) R_j(second) R_k(third) for rows of angles; (..., 3, 3)."""
    shape = angles.shape[:-1]
    first, second, third = (
        elementary("R" + letter, EXTENDED.array(angles[..., k]), shape, EXTENDED)
        for k, letter in enumerate(name)
    )
    return np.asarray((first @ second @ third)[..., :3, :3])


def random_rotations(count: int, seed: int) -> np.ndarray:
    """Rotations, uniformly distributed: from normal quaternions."""
    parts = np.random.default_rng(seed).normal(size=(count, 4))
    return of_quaternion(parts / np.linalg.norm(parts, axis=1, keepdims=True))


def of_quaternion(parts: np.ndarray) -> np.ndarray:
    """v -> q v q*, its matrix written out."""
    w, x, y, z = np.moveaxis(np.asarray(parts, dtype=np.longdouble), -1, 0)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def of_axis(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Rodrigues: I + sin K + (1 - cos) K^2."""
    x, y, z = np.moveaxis(np.asarray(axis, dtype=np.longdouble), -1, 0)
    zero = np.zeros_like(x)
    cross = np.moveaxis(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]), (0, 1), (-2, -1))
    angle = np.asarray(angle, dtype=np.longdouble)[..., None, None]
    return np.asarray(
        np.eye(3) + np.sin(angle) * cross + 2 * np.sin(angle / 2) ** 2 * (cross @ cross)
    )


def plain(matrix: np.ndarray) -> Any:
    """Rows of doubles."""
    return tuple(tuple(float(x) for x in row) for row in matrix)


def degenerate_angles(name: str, count: int, seed: int) -> np.ndarray:
    """Angles of a sequence in which the second is singular, exactly or within 1e-9."""
    generator = np.random.default_rng(seed)
    angles = generator.uniform(-math.pi, math.pi, (count, 3))
    singular = np.array([0.0, math.pi] if name[0] == name[2] else [math.pi / 2, -math.pi / 2])
    miss = generator.choice([0.0, 0.0, 1e-9, -1e-9, 1e-11, 1e-13, 3e-15, -1e-16], count)
    angles[:, 1] = singular[generator.integers(0, 2, count)] + miss
    return angles


# -- the 12 sequences ------------------------------------------------------------------------------


def test_there_are_twelve_sequences() -> None:
    assert sorted(sequence.name for sequence in SEQUENCES) == NAMES
    assert len(NAMES) == 12
    assert named_sequence(" ZYZ ").axes == (Axis.Z, Axis.Y, Axis.Z)
    assert named_sequence("rpy").name == "zyx"


@pytest.mark.parametrize("name", ["zzy", "xy", "abc", "", "zyzx"])
def test_an_unknown_sequence_is_refused(name: str) -> None:
    with pytest.raises(UnsupportedError, match="zyz, "):
        named_sequence(name)


@pytest.mark.parametrize("name", NAMES)
def test_euler_angles_give_random_rotations_back(name: str) -> None:
    matrices = random_rotations(COUNT, seed=3)
    sequence = named_sequence(name)
    found = [euler_angles(plain(matrix), sequence) for matrix in matrices]
    for angles in ([each.angles for each in found], [each.other for each in found]):
        assert np.abs(multiplied(name, np.array(angles)) - matrices).max() < 1e-12
    outer = np.array([(each.first, each.third) for each in found])
    assert (np.abs(outer) <= math.pi).all()
    second = np.array([each.second for each in found])
    low, high = (0, math.pi) if sequence.proper else (-math.pi / 2, math.pi / 2)
    assert ((second >= low) & (second <= high)).all()


@pytest.mark.parametrize("name", NAMES)
def test_euler_angles_give_degenerate_rotations_back(name: str) -> None:
    matrices = multiplied(name, degenerate_angles(name, COUNT, seed=4))
    sequence = named_sequence(name)
    found = [euler_angles(plain(matrix), sequence) for matrix in matrices]
    for angles in ([each.angles for each in found], [each.other for each in found]):
        assert np.abs(multiplied(name, np.array(angles)) - matrices).max() < 1e-12
    assert sum(each.degenerate for each in found) > COUNT / 4
    assert all(each.first == 0 for each in found if each.degenerate)
    assert sum(not each.degenerate for each in found) > COUNT / 4


@pytest.mark.parametrize("name", NAMES)
def test_what_remains_at_a_singularity_is_the_sum_that_is_named(name: str) -> None:
    sequence = named_sequence(name)
    for quarter in range(-1, 3):
        second = quarter * math.pi / 2
        if abs(math.sin(second) if sequence.proper else math.cos(second)) > 0.5:
            continue
        matrix = multiplied(name, np.array([0.4, second, 1.1]))
        found = euler_angles(plain(matrix), sequence)
        assert found.degenerate
        sign = sequence.remaining_sign(found.second)
        assert math.isclose(sign * found.third, 0.4 + sign * 1.1, abs_tol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_the_formulas_are_those_of_the_numbers(name: str) -> None:
    sequence = named_sequence(name)
    letters = ImmutableMatrix(3, 3, lambda r, c: Symbol(f"r{r}{c}", real=True))
    for matrix in random_rotations(20, seed=5):
        point = {f"r{r}{c}": number(float(matrix[r, c])) for r in range(3) for c in range(3)}
        found = euler_angles(plain(matrix), sequence)
        for formula, angle in zip(euler_formulas(letters, sequence), found.angles, strict=True):
            told = MP.atan2(value_of(formula.y, point), value_of(formula.x, point))
            assert abs(float(told) - angle) < 1e-13
    for third, quarter in product((-2.0, 0.3, 3.0), range(4)):
        second = quarter * math.pi / 2
        if abs(math.sin(second) if sequence.proper else math.cos(second)) > 0.5:
            continue
        matrix = multiplied(name, np.array([0.0, second, third]))
        point = {f"r{r}{c}": number(float(matrix[r, c])) for r in range(3) for c in range(3)}
        formula = degenerate_formula(letters, sequence)
        told = MP.atan2(value_of(formula.y, point), value_of(formula.x, point))
        assert abs(float(told) - third) < 1e-12


def test_the_two_sequences_that_every_book_prints() -> None:
    r = ImmutableMatrix(3, 3, lambda r, c: Symbol(f"r{r + 1}{c + 1}", real=True))
    zyx, zyz = (euler_formulas(r, named_sequence(name)) for name in ("zyx", "zyz"))
    assert [(str(f.y), str(f.x)) for f in zyx] == [
        ("r21", "r11"),
        ("-r31", "sqrt(r32**2 + r33**2)"),
        ("r32", "r33"),
    ]
    assert [(str(f.y), str(f.x)) for f in zyz] == [
        ("r23", "r13"),
        ("sqrt(r31**2 + r32**2)", "r33"),
        ("r32", "-r31"),
    ]


# -- axis and angle, quaternion --------------------------------------------------------------------


def some_rotations(seed: int) -> np.ndarray:
    """Random ones, tiny ones, half turns and near half turns, and all 24 of the cube."""
    generator = np.random.default_rng(seed)
    axes = generator.normal(size=(4000, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = generator.choice([1e-12, 1e-9, 1e-5, math.pi, math.pi - 1e-9, math.pi - 1e-6], 4000)
    quarters = np.array(list(product(range(4), repeat=3))) * math.pi / 2
    cube = np.round(multiplied("zyz", quarters).astype(float))
    return np.concatenate([random_rotations(6000, seed), of_axis(axes, angles), cube])


def test_axis_and_angle_give_rotations_back() -> None:
    matrices = some_rotations(seed=6)
    found = [axis_angle(plain(matrix)) for matrix in matrices]
    axes = np.array([each.axis or (1, 0, 0) for each in found])
    back = of_axis(axes, np.array([each.angle for each in found]))
    assert np.abs(back - matrices).max() < 1e-12
    assert all(0 <= each.angle <= math.pi for each in found)
    assert np.abs(np.linalg.norm(axes, axis=1) - 1).max() < 1e-14


def test_the_quaternion_gives_rotations_back() -> None:
    matrices = some_rotations(seed=7)
    found = [quaternion(plain(matrix)) for matrix in matrices]
    parts = np.array([(each.w, *each.vector) for each in found])
    assert np.abs(of_quaternion(parts) - matrices).max() < 1e-12
    assert np.abs(np.linalg.norm(parts, axis=1) - 1).max() < 1e-14
    assert all(next(x for x in row if abs(x) > 1e-15) > 0 for row in parts)


def test_an_axis_that_is_not_there_is_not_named() -> None:
    assert axis_angle(plain(np.eye(3))).axis is None
    half = axis_angle(plain(np.diag([-1.0, 1.0, -1.0])))
    assert (half.axis, half.angle, half.either) == ((0.0, 1.0, 0.0), math.pi, True)


# -- is it a rotation ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rows", "says"),
    [
        ([[2, 0, 0], [0, 1, 0], [0, 0, 1]], "column n has length 2, not 1"),
        ([[1, 0, 0.1], [0, 1, 0], [0, 0, 1]], "column a has length 1.004"),
        ([[1, 0.6, 0], [0, 0.8, 0], [0, 0, 1]], "columns n and s have the product 0.6, not 0"),
        ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "determinant is -1, a reflection"),
        ([[0, 0, 0], [0, 0, 0], [0, 0, 0]], "column n has length 0"),
        ([[1, 0, 0], [0, 1, 2e-6], [0, -2e-6, 1]], None),
        ([[1, 0, 0], [0, 1, 2e-6], [0, 0, 1]], "columns s and a have the product 2e-06"),
        ([[1e200, 0, 0], [0, 1, 0], [0, 0, 1]], "column n has length"),
        ([[math.nan, 0, 0], [0, 1, 0], [0, 0, 1]], "column n has length"),
    ],
)
def test_what_is_no_rotation_is_refused(rows: list[list[float]], says: str | None) -> None:
    if says is None:
        nearest_rotation(rows)
        return
    with pytest.raises(UnsupportedError, match="not a rotation") as refused:
        nearest_rotation(rows)
    assert says in str(refused.value)


def test_the_nearest_rotation_is_orthonormal_and_near() -> None:
    generator = np.random.default_rng(8)
    for matrix in random_rotations(500, seed=8):
        noisy = matrix.astype(float) + generator.uniform(-1e-7, 1e-7, (3, 3))
        found = np.array(nearest_rotation(noisy.tolist()))
        assert np.abs(found.T @ found - np.eye(3)).max() < 1e-15 * 4
        # The orthogonal factor of the polar decomposition, by way of the singular values.
        left, _, right = np.linalg.svd(noisy)
        assert np.abs(found - left @ right).max() < 2e-14


# -- composing -------------------------------------------------------------------------------------


def step(text: str, about: About, angle: Expr) -> Step:
    return Step(Axis["XYZ"["xyz".index(text)]], angle, about)


def test_the_quiz_of_the_lecture() -> None:
    """Rz(90) Rx(45) Ry(60), multiplied by hand: rows (-row 2, row 1, row 3) of Rx(45) Ry(60)."""
    steps = (
        step("x", About.BODY, pi / 4),
        step("y", About.BODY, pi / 3),
        step("z", About.FIXED, pi / 2),
    )
    point = tuple(Symbol(name, real=True) for name in ("a", "b", "c"))
    done = compose(steps, point)
    by_hand = [
        ["-sqrt(6)/4", "-sqrt(2)/2", "sqrt(2)/4"],
        ["1/2", "0", "sqrt(3)/2"],
        ["-sqrt(6)/4", "sqrt(2)/2", "sqrt(2)/4"],
    ]
    expected = ImmutableMatrix([[parse_expression(text) for text in row] for row in by_hand])
    assert done.matrix == expected
    assert [each.axis for each in done.word] == [Axis.Z, Axis.X, Axis.Y]
    numbers = {"a": number("1.1"), "b": number("-2.3"), "c": number("0.7")}
    after = done.steps[-1].point
    assert after is not None
    for row, component in zip(by_hand, after, strict=True):
        terms = zip(row, numbers.values(), strict=True)
        told = sum(value_of(parse_expression(text), {}) * x for text, x in terms)
        assert abs(value_of(component, numbers) - told) < 1e-40


def test_fixed_axes_in_one_order_are_moving_axes_in_the_other() -> None:
    angles = [Symbol(name, real=True) for name in ("u", "v", "w")]
    fixed = compose([step(x, About.FIXED, a) for x, a in zip("xzy", angles, strict=True)])
    body = compose([step(x, About.BODY, a) for x, a in zip("yzx", angles[::-1], strict=True)])
    assert fixed.matrix == body.matrix
    assert fixed.word == body.word


def test_random_compositions_agree_with_numpy() -> None:
    generator = np.random.default_rng(9)
    for _ in range(60):
        letters = generator.choice(list("xyz"), 5)
        sides = generator.choice([About.BODY, About.FIXED], 5)
        values = generator.uniform(-3, 3, 5)
        names = [f"t{k}" for k in range(5)]
        steps = [
            step(x, side, Symbol(name, real=True))
            for x, side, name in zip(letters, sides, names, strict=True)
        ]
        expected = np.eye(3)
        for letter, side, value in zip(letters, sides, values, strict=True):
            one = elementary(f"R{letter}", EXTENDED.array(value), (), EXTENDED)[:3, :3]
            expected = expected @ one if side is About.BODY else one @ expected
        point = {name: number(float(value)) for name, value in zip(names, values, strict=True)}
        done = compose(steps)
        got = [[float(value_of(done.matrix[r, c], point)) for c in range(3)] for r in range(3)]
        assert np.abs(np.array(got) - expected).max() < 1e-14


def test_the_orientation_of_an_arm_is_the_rotation_of_its_transform() -> None:
    robot = load_table(str(TABLES / "planar_2r.yaml")).robot
    c, s = cos(sum(robot.variables)), sin(sum(robot.variables))
    found = of_arm(robot, 0, 2, {}, symbolic=True)
    assert found.matrix == ImmutableMatrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


# -- reading angles off ----------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_what_is_read_off_makes_the_same_rotation(name: str) -> None:
    """Words of a sequence, dressed with right-angle turns, are recognised, and rightly so."""
    generator = np.random.default_rng(10)
    sequence = named_sequence(name)
    symbols = [Symbol(text, real=True) for text in ("u", "v", "w")]
    values = {"u": 0.3, "v": -1.2, "w": 2.1}
    point = {key: number(value) for key, value in values.items()}
    for _ in range(25):
        present = generator.integers(0, 2, 3)
        quarters = generator.integers(-2, 3, 3)
        amounts = [
            s * int(p) + int(q) * pi / 2 for s, p, q in zip(symbols, present, quarters, strict=True)
        ]
        word = tuple(turn(axis, x) for axis, x in zip(sequence.axes, amounts, strict=True))
        found = read_off(word, sequence)
        assert found is not None
        wanted = multiplied(name, np.array([float(value_of(x, point)) for x in amounts]))
        got = multiplied(name, np.array([float(value_of(x, point)) for x in found]))
        assert np.abs(got - wanted).max() < 1e-14


def test_what_stands_in_another_order_is_not_read_off() -> None:
    u, v, w = (Symbol(name, real=True) for name in ("u", "v", "w"))
    word = (turn(Axis.Z, u), turn(Axis.Y, v), turn(Axis.Z, w))
    assert read_off(word, named_sequence("zyz")) == (u, v, w)
    assert read_off(word, named_sequence("zyx")) is None
    assert read_off((*word, turn(Axis.X, u)), named_sequence("zyz")) is None


# -- rates -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_the_rate_matrix_is_the_derivative_of_the_rotation(name: str) -> None:
    """R' R^T is the cross product with omega; by a central difference of the oracle's R."""
    sequence = named_sequence(name)
    first, second = Symbol("a", real=True), Symbol("b", real=True)
    matrix, inverse = rates(sequence, first, second), inverse_rates(sequence, first, second)
    for angles in np.random.default_rng(11).uniform(0.2, 1.3, (10, 3)):
        point = {"a": number(float(angles[0])), "b": number(float(angles[1]))}
        got = np.array([[float(value_of(matrix[r, c], point)) for c in range(3)] for r in range(3)])
        back = np.array(
            [[float(value_of(inverse[r, c], point)) for c in range(3)] for r in range(3)]
        )
        for k in range(3):
            h = 1e-6 * np.eye(3)[k]
            slope = (multiplied(name, angles + h) - multiplied(name, angles - h)) / 2e-6
            spin = slope @ multiplied(name, angles).T
            omega = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
            assert np.abs(got[:, k] - omega).max() < 1e-9
        assert np.abs(back @ got - np.eye(3)).max() < 1e-13
        vanishing = float(value_of(rates_vanish(sequence, second), point))
        assert math.isclose(abs(np.linalg.det(got)), abs(vanishing), rel_tol=1e-12)


# -- reading ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "column", "says"),
    [
        ("Rx(45) body", 4, "an angle needs a unit"),
        ("Rx(45 deg)", 11, "whose axis is that?"),
        ("Rx(45 deg), Ry(1 deg) body", 13, "whose axis is that?"),
        ("Rx(45 deg) moving", 12, "did you mean body?"),
        ("Rx(45 deg) world", 12, "did you mean fixed?"),
        ("Rx(45 deg) bdy", 12, "did you mean body?"),
        ("Rq(1 deg) body", 1, "Rq is not a rotation"),
        ("rx(1 deg) body", 1, "did you mean Rx?"),
        ("Tx(1) body", 1, "the rotations are Rx, Ry, Rz"),
        ("Rx 45 body", 1, "needs its angle in parentheses"),
        ("Rx(45 deg body", 15, "missing )"),
        ("Rx(0.5 m) body", 4, "this is a length, where an angle is wanted"),
        ("Rx(1/0) body", 5, "division by zero"),
        ("Rx() body", 4, "expression is empty"),
        ("", 1, "there is no rotation here"),
        ("(", 1, "unexpected ("),
        ("Rx(1 deg) body\nRy(1 deg) body", 15, "must stand on one line"),
        ("Rx(\u202e1 deg) body", 4, "is not allowed"),
        ("Rx(" + "1+" * 400 + "1 deg) body", 504, "longer than 500 characters"),
        ("Rx(1 deg) body " * 51, 1, "51 rotations, over 50"),
    ],
)
def test_wrong_rotations_are_told_at_their_column(text: str, column: int, says: str) -> None:
    with pytest.raises(TableError) as refused:
        parse_rotations(text)
    first = refused.value.diagnostics[0]
    assert (first.filename, first.line, first.column) == ("ROTATIONS", 1, column)
    assert says in first.message


def test_all_mistakes_of_a_line_are_told_that_can_be() -> None:
    with pytest.raises(TableError) as refused:
        parse_rotations("Rx(45) body, Ry(2 dge) fixed")
    assert [each.column for each in refused.value.diagnostics] == [4, 19]


@pytest.mark.parametrize(
    ("text", "column", "says"),
    [
        ("1 2 3", 1, "a matrix has 9 numbers, and here are 3"),
        ("1 0 0; 0 1 0; 0 0 1x", 20, "unexpected"),
        ("1,0,0,0,,0,0,0,1", 9, "expression is empty"),
        ("1 0 0 0 1 0 0 0 1m", 17, "this is a length, where a number is wanted"),
        ("[1 0 0; 0 1 0; 0 0 1", 1, "unexpected character ["),
        ("[[1,0,0],[0,1,0],[0,0,x y]]", 25, "unexpected"),
    ],
)
def test_wrong_matrices_are_told_at_their_column(text: str, column: int, says: str) -> None:
    with pytest.raises(TableError) as refused:
        parse_matrix(text)
    found = [(each.column, each.message) for each in refused.value.diagnostics]
    assert any(says in message for at, message in found if at == column), found


@pytest.mark.parametrize(
    "text",
    [
        "0 -1 0 1 0 0 0 0 1",
        "0,-1,0,1,0,0,0,0,1",
        "0 -1 0; 1 0 0; 0 0 1",
        "0, -1, 0; 1, 0, 0; 0, 0, 1",
        " 0  -1 0;1 0 0; 0 0 cos(0) ",
        "0, cos(90 deg) - 1, 0, atan2(1, 1)*4/pi, 0, 0, 0, 0, 1",
        "[0 -1 0; 1 0 0; 0 0 1]",
        "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]",
        "[ [0 -1 0] [1 0 0] [0 0 1] ]",
    ],
)
def test_matrices_may_be_typed_in_many_ways(text: str) -> None:
    assert parse_matrix(text) == (0, -1, 0, 1, 0, 0, 0, 0, 1)


def test_a_point_may_have_names() -> None:
    x, y, z = parse_point("a_1, 2*b, sqrt(2)", Units(), "--point")
    assert (str(x), str(y), str(z)) == ("a1", "2*b", "sqrt(2)")


SHEET = "units: {angle: deg}\nrotations: [Rx(u) body, Rz(90) fixed]\nvalues: {u: 30}\n"


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("rotatoins: [Rx(1 deg) body]", (1, 1), "did you mean rotations?"),
        ("units: {angle: deg}\nrotations: [Rx(1) body, Ry(2)]", (2, 30), "whose axis"),
        ("units: {angle: deg}\nrotations:\n  - Rx(1/0) body\n  - Ry(q*) body", (3, 9), "zero"),
        ("title: nothing", (1, 1), "rotations is missing"),
        ("rotations: Rx(1 deg) body\nmatrix: [1,0,0,0,1,0,0,0,1]", (2, 9), "either rotations"),
        ("matrix: [[1, 0], [0, 1]]", (1, 9), "9 numbers, and here are 4"),
        ("rotations: Rx(1 deg) body\npoint: [1, 2]", (2, 8), "3 numbers, and here are 2"),
        ("rotations: Rx(1 deg) body\npoint: [1, 2, 90 deg]", (2, 15), "a length is wanted"),
        ("rotations: {x: 1 deg}", (1, 12), "not a mapping"),
        (SHEET + "point: [1, 2, 3]\nunit: 1", (5, 1), "did you mean units?"),
        (SHEET.replace("u: 30", "v: 30"), (3, 10), "v is not in the table"),
        ("rotations: []", (1, 12), "there is no rotation here"),
        ("rotations: &a [Rx(1 deg) body]", (1, 12), "anchor"),
        ("matrix: {a: 1}", (1, 9), "a list of numbers is wanted here, not a mapping"),
        ("rotations: Rx(1 deg) body\npoint: [1, {a: 2}, 3]", (2, 12), "a number is wanted here"),
    ],
)
def test_wrong_sheets_are_told_at_their_place(text: str, place: tuple[int, int], says: str) -> None:
    with pytest.raises(TableError) as refused:
        read_rotation_sheet(from_text(text, "sheet.yaml"))
    found = [(each.line, each.column, each.message) for each in refused.value.diagnostics]
    assert any(says in message for *at, message in found if tuple(at) == place), found


def test_a_sheet_is_read() -> None:
    text = SHEET + "point: [1, b, 3]\nx-for-people: anything\n"
    sheet = read_rotation_sheet(from_text(text, "sheet.yaml"))
    assert [(each.axis.name, each.fixed) for each in sheet.rotations] == [("X", False), ("Z", True)]
    assert sheet.rotations[1].angle == pi / 2
    assert {key.name: value for key, value in sheet.values.items()} == {"u": pi / 6}
    assert sheet.point is not None


# -- the command -----------------------------------------------------------------------------------


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_command_answers_the_quiz(empty: Path, capsys: Capture) -> None:
    assert run(["rotate", QUIZ, "--point", "1,2,3"]) == 0
    shown = capsys.readouterr().out
    assert re.search(r"R₃ = Rz\(90°\) R₂ = ⎢ +1/2 +0 +√\(?3\)?/2 ⎥", shown)
    assert "Step 2: by 60° about the body's own y axis: on the right." in shown
    assert "Step 3: by 90° about the fixed z axis: on the left." in shown
    assert "R = Rz(90°) Rx(45°) Ry(60°)" in shown
    assert "at (1, 2, 3)" in shown
    told = [float(x) for x in re.findall(r"(?m)^  p\S+ = .* = (-?[\d.]+)$", shown)]
    rotated = np.array(
        [
            -math.sqrt(6) / 4 - math.sqrt(2) + 3 * math.sqrt(2) / 4,
            0.5 + 3 * math.sqrt(3) / 2,
            -math.sqrt(6) / 4 + math.sqrt(2) + 3 * math.sqrt(2) / 4,
        ]
    )
    assert np.abs(np.array(told) - rotated).max() < 1e-3
    assert list(empty.iterdir()) == []


def test_the_example_says_the_same_as_the_command_line(empty: Path, capsys: Capture) -> None:
    given = []
    example = ROOT / "examples" / "rotations" / "three_turns.yaml"
    for arguments in ([QUIZ, "--point", "1,2,3"], [str(example)]):
        assert run(["rotate", *arguments, "--format", "json"]) == 0
        given.append(json.loads(capsys.readouterr().out))
    assert given[0] == given[1]


def test_json_agrees_with_the_oracle(empty: Path, capsys: Capture) -> None:
    text = "Rx(0.3 rad) body, Rz(1.1 rad) fixed, Ry(-2 rad) body"
    assert run(["rotate", text, "--format", "json", "--point", "1,-2,0.5"]) == 0
    got = json.loads(capsys.readouterr().out)
    expected = multiplied("zxy", np.array([1.1, 0.3, -2.0]))
    assert np.abs(np.array(got["matrix"]) - expected).max() < 1e-15
    exact = [[float(value_of(parse_expression(x), {})) for x in row] for row in got["expressions"]]
    assert np.abs(np.array(exact) - expected).max() < 1e-15
    moved = np.array([float(value_of(parse_expression(x), {})) for x in got["moved"]])
    assert np.abs(moved - expected @ np.array([1, -2, 0.5])).max() < 1e-14
    for name in NAMES:
        back = multiplied(name, np.array(got["euler"][name]["angles"]))
        assert np.abs(back - expected).max() < 1e-14
    assert np.abs(of_quaternion(np.array(got["quaternion"])) - expected).max() < 1e-14
    about = of_axis(np.array(got["axis"]), np.array(got["angle"]))
    assert np.abs(about - expected).max() < 1e-14


@pytest.mark.parametrize("table", ["puma560", "ur5", "scara_rrpr", "spherical_rrp"])
def test_the_orientation_of_an_arm_agrees_with_the_oracle(
    table: str, empty: Path, capsys: Capture
) -> None:
    path = TABLES / f"{table}.yaml"
    arm = read_arm_file(path)
    values = dict(
        zip([n for n, _ in arm.variables], [0.4, -1.2, 0.3, 2.0, 0.7, -0.6], strict=False)
    )
    settings = [
        f"--set={name}={value}{' rad' if turns else ''}"
        for (name, turns), value in zip(arm.variables, values.values(), strict=True)
    ]
    assert run(["rotate", "--table", str(path), *settings, "--format", "json"]) == 0
    got = json.loads(capsys.readouterr().out)
    expected = arm.pose(values)[:3, :3]
    assert np.abs(np.array(got["matrix"]) - expected).max() < 1e-14
    back = multiplied("zyz", np.array(got["euler"]["zyz"]["angles"]))
    assert np.abs(back - expected).max() < 1e-14


def test_symbols_of_a_matrix_take_numbers(empty: Path, capsys: Capture) -> None:
    matrix = "[n 0 sin(t); 0 1 0; -sin(t) 0 n]"
    settings = ["--set", "n=0.6", "--set", "t=atan2(4, 3)"]
    assert run(["rotate", "--matrix", matrix, *settings, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)["matrix"]
    assert np.abs(np.array(found) - [[0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]]).max() < 1e-15
    assert run(["rotate", "--matrix", matrix, "--set", "t=1"]) == 2
    assert "an angle needs a unit" in capsys.readouterr().err
    assert run(["rotate", "--matrix", matrix, "--set", "p=1"]) == 2
    assert "p is not" in capsys.readouterr().err


def test_a_point_in_a_matrix(empty: Path, capsys: Capture) -> None:
    command = ["rotate", "--matrix", "0 -1 0; 1 0 0; 0 0 1", "--point", "1,2,3"]
    assert run([*command, "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["moved"] == ["-2", "1", "3"]


def test_a_point_carries_the_unit_of_the_arm(empty: Path, capsys: Capture) -> None:
    """By hand: a turn of 30 deg about z takes (2, 0, 0) to (2 cos 30 deg, 1, 0)."""
    rows = "joints:\n  - {theta: q1, d: 0, a: a1, alpha: 0}\n"
    Path("arm.yaml").write_text(f"name: arm\nconvention: standard\nunits: {{length: mm}}\n{rows}")
    command = ["rotate", "--table", "arm.yaml", "--point", "2,0,0"]
    assert run([*command, "--set=q1=30 deg"]) == 0
    shown = capsys.readouterr().out
    assert "p_x = 2 c₁ = 1.7321 mm" in shown
    assert "p_y = 2 s₁ = 1 mm" in shown
    assert run([*command, "--symbolic"]) == 0
    open_angle = capsys.readouterr().out
    assert "p_y = 2 s₁\n" in open_angle
    assert "p_z = 0 mm" in open_angle


def test_an_arm_without_a_closed_form_has_numbers(empty: Path, capsys: Capture) -> None:
    # No two of the ten axes are parallel at once: the formula would fill pages.
    joints = "".join(f"  - {{theta: q{i}, d: 1, a: 1, alpha: 90 deg}}\n" for i in range(1, 11))
    text = f"name: ten\nconvention: standard\njoints:\n{joints}"
    Path("ten.yaml").write_text(text)
    values = {f"q{i}": i / 4 for i in range(1, 11)}
    settings = [f"--set={name}={value} rad" for name, value in values.items()]
    assert run(["rotate", "--table", "ten.yaml", *settings, "--format", "json"]) == 0
    got = json.loads(capsys.readouterr().out)
    assert run(["rotate", "--table", "ten.yaml", *settings]) == 0
    assert "cos q₁" not in capsys.readouterr().out
    assert got["expressions"] is None
    expected = read_arm(text).pose(values)[:3, :3]
    assert np.abs(np.array(got["matrix"]) - expected).max() < 1e-14


def test_numbered_angles_have_short_forms(empty: Path, capsys: Capture) -> None:
    assert run(["rotate", "Rz(theta1) body, Rz(theta2) body", "--symbolic"]) == 0
    assert "c₁₂" in capsys.readouterr().out
    assert run(["rotate", "Rz(theta1) body, Rz(phi) body", "--symbolic"]) == 0
    assert "cos(θ₁ + φ)" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("rotation", "told"),
    [
        ("Rx(0 deg) body", ["This is the identity: there is no axis to name."]),
        (
            "Rx(180 deg) body",
            [
                "A half turn, about k̂ = (1, 0, 0) or its opposite.",
                "Here (w, x, y, z) = (0, 1, 0, 0).",
            ],
        ),
        (
            "Ry(0.0000001 rad) body",
            ["This rotation is close to it (sin θ below 0.000001): the last digits of φ and ψ"],
        ),
    ],
)
def test_rotations_at_the_edges(
    rotation: str, told: list[str], empty: Path, capsys: Capture
) -> None:
    assert run(["rotate", rotation, "--euler", "zyz"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    for text in told:
        assert text in shown


def test_a_sheet_in_radians_is_answered_in_radians(empty: Path, capsys: Capture) -> None:
    Path("rad.yaml").write_text("units: {angle: rad}\nrotations: [Rx(0.5) body]\n")
    assert run(["rotate", "rad.yaml", "--euler", "zyx"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "ψ = atan2(r₃₂, r₃₃) = 0.5" in shown
    assert "(φ, θ, ψ) = (3.1416, 3.1416, -2.6416)" in shown
    assert "°" not in shown


def test_a_degenerate_case_is_spelt_out(empty: Path, capsys: Capture) -> None:
    assert run(["rotate", "Rz(30 deg) body, Rz(20 deg) body", "--euler", "zyz"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "Degenerate where sin θ = 0, that is r₃₃ is 1 or -1" in shown
    assert "φ + ψ at θ = 0, φ - ψ at θ = 180°" in shown
    assert "There φ is set to zero, which leaves ψ = atan2(r₂₁, r₂₂)" in shown
    assert "only φ + ψ = 50° is determined, and with φ = 0 it is ψ = 50°" in shown
    assert "ZYZ is degenerate here" in shown
    assert "ZYX is degenerate here" not in shown


def test_symbols_give_formulas(empty: Path, capsys: Capture) -> None:
    assert run(["rotate", "Rz(phi) body, Ry(theta) body, Rz(psi) body", "--euler", "zyz"]) == 0
    shown = capsys.readouterr().out
    assert "one solution is φ = φ, θ = θ, ψ = ψ" in " ".join(shown.split())
    assert "All 12 sequences" not in shown
    assert run(["rotate", "--table", str(TABLES / "scara_rrpr.yaml"), "--symbolic"]) == 0
    assert "c₁₂₋₄" in capsys.readouterr().out
    family = "cos(q) 0-sin(q) 0; sin(q) cos(q) 0; 0 0 1"
    assert run(["rotate", "--matrix", family.replace("0-", "-"), "--symbolic"]) == 0


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ([], "one of them"),
        ([QUIZ, "--matrix", "1 0 0 0 1 0 0 0 1"], "one of them"),
        ([QUIZ, "--from", "1"], "--from and --to need --table"),
        ([QUIZ, "--euler", "zzz"], "there is no sequence of Euler angles 'zzz'"),
        ([QUIZ, "--point", "1,2"], "--point:1:4: a point has three"),
        ([QUIZ, "--set", "q=1"], "--set:1:1: q is not in the table"),
        (["Rx(45) body"], "ROTATIONS:1:4: an angle needs a unit: write 45 deg"),
        (["--matrix", "1 0 0 0 1 0 0 0 2"], "column a has length 2, not 1 (tolerance 1e-06)"),
        (["--matrix", "1 0 0 0 1 0 0 0 -1"], "determinant is -1"),
        (["--matrix", "1 0 0 0 1 0 0 0 q"], "q has no value; add --symbolic"),
        (["--matrix", "1 0 0 0 1 0 0 0 q", "--symbolic"], "not a rotation at q = "),
        (["--table", str(TABLES / "puma560.yaml"), "--to", "9"], "there is no frame 9"),
        (["--table", str(TABLES / "puma560.yaml")], "theta1, theta2"),
    ],
)
@pytest.mark.parametrize("form", ["text", "latex", "json"])
def test_bad_input_is_told_and_writes_nothing(
    arguments: list[str], says: str, form: str, empty: Path, capsys: Capture
) -> None:
    assert run(["rotate", *arguments, "--format", form, "-o", "out.txt"]) == 2
    shown = capsys.readouterr()
    assert says in shown.err
    assert shown.out == ""
    assert list(empty.iterdir()) == []


def test_a_matrix_that_is_not_real_is_refused(empty: Path, capsys: Capture) -> None:
    odd = Path("odd.yaml")
    odd.write_text("matrix: [1, 0, 0, 0, 1, 0, 0, 0, sqrt(k)]\n")
    assert run(["rotate", "odd.yaml", "--set", "k=-1"]) == 2
    assert "an entry of the matrix is 1.0*I, not a real number" in capsys.readouterr().err
    odd.write_text(odd.read_text() + "values: {k: -1}\n")
    assert run(["rotate", "odd.yaml"]) == 2
    assert "odd.yaml:1:34: these values make sqrt(k) equal to I" in capsys.readouterr().err


def test_a_bad_sheet_is_told_with_its_name(empty: Path, capsys: Capture) -> None:
    Path("steps.yaml").write_text("rotations:\n  - Rx(45 deg) moving\n")
    assert run(["rotate", "steps.yaml"]) == 2
    assert "steps.yaml:2:16: moving is neither body nor fixed" in capsys.readouterr().err
    assert run(["rotate", "missing.yaml"]) == 3


def test_a_rough_matrix_is_taken_with_a_wider_tolerance(empty: Path, capsys: Capture) -> None:
    rough = "0.7071 -0.7071 0; 0.7071 0.7071 0; 0 0 1"
    assert run(["rotate", "--matrix", rough]) == 2
    assert "tolerance 1e-06" in capsys.readouterr().err
    assert run(["rotate", "--matrix", rough, "--tolerance", "0.001"]) == 0
    shown = capsys.readouterr().out
    assert "The numbers given miss a rotation by up to" in shown
    assert re.search(r"ZYX +45° +0° +0°", shown)


@pytest.mark.parametrize(
    "arguments",
    [
        [QUIZ, "--point", "1,2,3", "--euler", "all"],
        ["--table", str(TABLES / "puma560.yaml"), "--symbolic", "--euler", "all"],
        ["--table", str(TABLES / "pieper_generic.yaml"), "--symbolic", "--euler", "all"],
        ["Rz(phi) body, Ry(theta) fixed, Rx(psi) body", "--point", "a,b,c"],
    ],
)
def test_the_document_compiles_and_no_line_is_too_wide(arguments: list[str], empty: Path) -> None:
    pdflatex = require_tool("pdflatex")
    assert run(["rotate", *arguments, "--format", "latex", "-o", "out.tex"]) == 0
    command = [pdflatex, "-interaction=batchmode", "-halt-on-error", "out.tex"]
    ran = subprocess.run(command, capture_output=True, timeout=120, check=False)
    assert ran.returncode == 0
    assert "Overfull" not in Path("out.log").read_text(encoding="latin-1")


def test_nothing_depends_on_the_hash_seed(run_symdh: Runner) -> None:
    texts = set()
    for seed in ("0", "1", "2"):
        for form in ("text", "latex", "json"):
            ran = run_symdh(
                "rotate",
                "Rz(b + a) body, Ry(c) fixed, Rz(a - b) body",
                *("--point", "z,y,x", "--format", form),
                env={"PYTHONHASHSEED": seed},
            )
            assert ran.returncode == 0, ran.stderr
            texts.add(ran.stdout)
    assert len(texts) == 3


def test_every_sequence_has_its_own_description() -> None:
    found = describe(plain(random_rotations(1, seed=12)[0]))
    assert [each.sequence for each in found.euler] == list(SEQUENCES)
    chosen = EulerSequence(Axis.Y, Axis.X, Axis.Y)
    assert found.of(chosen).sequence == chosen
