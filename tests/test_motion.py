"""The algebra of elementary motions, against plain products of 4x4 matrices in mpmath."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import (
    Add,
    Expr,
    ImmutableMatrix,
    Integer,
    Mul,
    Pow,
    Rational,
    Symbol,
    cos,
    eye,
    pi,
    preorder_traversal,
    sin,
    symbols,
)

from symdh.motion import (
    Word,
    elementary,
    fuse,
    fuse_to_turn,
    inverse,
    inverse_transform,
    rotation,
    rotations,
    transform,
    translation,
)
from symdh.motion.matrices import orientation, position
from symdh.motion.size import closed_form_size
from symdh.motion.turn import IDENTITY, Turn
from symdh.motion.words import split_quarters
from symdh.robot import Axis, Motion, MotionKind

MP = mpmath.mp.clone()
MP.dps = 40
CLOSE = MP.mpf("1e-25")

NAMES = ("q1", "q2", "q3", "q4", "a1", "a2")
POINT = dict(
    zip(NAMES, map(Fraction, ("7/10", "-13/9", "11/4", "2/7", "8/5", "-3/11")), strict=True)
)
SYMBOLS = {name: Symbol(name, real=True) for name in NAMES}

q1, q2, q3, q4, a1, a2 = (SYMBOLS[name] for name in NAMES)
X, Y, Z = Axis


@dataclass(frozen=True)
class Amount:
    """An amount apart from sympy: a signed sum of names, a rational, and degrees."""

    names: tuple[tuple[str, int], ...] = ()
    number: Fraction = Fraction(0)
    degrees: int = 0

    def exact(self) -> Expr:
        number = Rational(self.number.numerator, self.number.denominator)
        named = sum((sign * SYMBOLS[name] for name, sign in self.names), start=Integer(0))
        return named + number + self.degrees * pi / 180

    def value(self) -> Any:
        total = MP.mpf(self.number.numerator) / self.number.denominator
        for name, sign in self.names:
            total += sign * MP.mpf(POINT[name].numerator) / POINT[name].denominator
        return total + self.degrees * MP.pi / 180


@dataclass(frozen=True)
class Step:
    """One of Rx Ry Rz Tx Ty Tz."""

    kind: MotionKind
    axis: Axis
    amount: Amount

    def motion(self) -> Motion:
        return Motion(self.kind, self.axis, self.amount.exact())

    def matrix(self) -> np.ndarray:
        """Return the 4x4 matrix by its definition, one axis at a time."""
        x = self.amount.value()
        zero, one = MP.mpf(0), MP.mpf(1)
        c, s = MP.cos(x), MP.sin(x)
        if self.kind is MotionKind.TRANSLATION:
            rows = [[one, zero, zero, zero], [zero, one, zero, zero], [zero, zero, one, zero]]
            rows["XYZ".index(self.axis.name)][3] = x
        elif self.axis.name == "X":
            rows = [[one, zero, zero, zero], [zero, c, -s, zero], [zero, s, c, zero]]
        elif self.axis.name == "Y":
            rows = [[c, zero, s, zero], [zero, one, zero, zero], [-s, zero, c, zero]]
        else:
            rows = [[c, -s, zero, zero], [s, c, zero, zero], [zero, zero, one, zero]]
        return np.array([*rows, [zero, zero, zero, one]], dtype=object)


RIGHT = st.sampled_from((0, 90, 180, 270, -90, -180, 360, 450))
ANY_ANGLE = st.builds(
    lambda unit, count: unit * count, st.sampled_from((15, 30, 45, 60, 90, 180)), st.integers(-7, 7)
)
ONE_NAME = st.tuples(st.tuples(st.sampled_from(NAMES[:4]), st.sampled_from((1, -1))))
NUMBER = st.fractions(min_value=-5, max_value=5, max_denominator=60)

ANGLE = st.one_of(
    st.builds(Amount, names=ONE_NAME),
    st.builds(Amount, names=ONE_NAME, degrees=RIGHT),
    st.builds(Amount, degrees=ANY_ANGLE),
    st.builds(Amount, degrees=RIGHT),
    st.builds(Amount, number=NUMBER),
)
LENGTH = st.one_of(
    st.builds(Amount, names=st.tuples(st.tuples(st.sampled_from(NAMES), st.just(1)))),
    st.builds(Amount, names=ONE_NAME, number=NUMBER),
    st.builds(Amount, number=NUMBER),
)
AXIS = st.sampled_from(list(Axis))
STEP = st.one_of(
    st.builds(Step, st.just(MotionKind.ROTATION), AXIS, ANGLE),
    st.builds(Step, st.just(MotionKind.TRANSLATION), AXIS, LENGTH),
)
STEPS = st.lists(STEP, max_size=9)

checked = settings(max_examples=80, deadline=None, derandomize=True)


def word_of(steps: Sequence[Step]) -> Word:
    return tuple(step.motion() for step in steps)


def product_of(steps: Sequence[Step]) -> np.ndarray:
    product = np.array([[MP.mpf(int(r == c)) for c in range(4)] for r in range(4)], dtype=object)
    for step in steps:
        product = product @ step.matrix()
    return product


def value_of(expression: Expr) -> Any:
    """Work out an exact expression at the point."""
    if expression.is_Rational:
        return MP.mpf(expression.p) / expression.q
    if expression is pi:
        return MP.pi
    if isinstance(expression, Symbol):
        return MP.mpf(POINT[expression.name].numerator) / POINT[expression.name].denominator
    parts = [value_of(part) for part in expression.args]
    if isinstance(expression, Add):
        return MP.fsum(parts)
    if isinstance(expression, Mul):
        return MP.fprod(parts)
    if isinstance(expression, Pow):
        return MP.power(*parts)
    return {cos: MP.cos, sin: MP.sin}[type(expression)](*parts)


def numeric(matrix: ImmutableMatrix) -> np.ndarray:
    """Put the point into an exact matrix."""
    rows, columns = matrix.shape
    values = [[value_of(matrix[r, c]) for c in range(columns)] for r in range(rows)]
    return np.array(values, dtype=object)


def assert_close(matrix: ImmutableMatrix, expected: np.ndarray) -> None:
    assert matrix.shape == expected.shape
    difference = np.abs(numeric(matrix) - expected).max()
    assert difference < CLOSE * max(1, np.abs(expected).max())


@checked
@given(STEP)
def test_an_elementary_matrix_is_that_of_its_definition(step: Step) -> None:
    assert_close(elementary(step.motion()), step.matrix())


@checked
@given(STEPS)
def test_a_transform_is_the_product_of_its_motions(steps: list[Step]) -> None:
    assert_close(transform(word_of(steps)), product_of(steps))


@checked
@given(STEPS)
def test_orientation_and_position_are_parts_of_the_transform(steps: list[Step]) -> None:
    expected = product_of(steps)
    columns = orientation(word_of(steps))
    assert_close(ImmutableMatrix(3, 3, lambda r, c: columns[c][r]), expected[:3, :3])
    assert_close(ImmutableMatrix(3, 1, position(word_of(steps))), expected[:3, 3:])


@checked
@given(STEPS)
def test_fusing_keeps_the_transform(steps: list[Step]) -> None:
    product = eye(4)
    for motion in fuse(word_of(steps)):
        product = product * elementary(motion)
    assert_close(ImmutableMatrix(product), product_of(steps))


@checked
@given(STEPS)
def test_fusing_twice_is_fusing_once(steps: list[Step]) -> None:
    once = fuse(word_of(steps))
    assert fuse(once) == once


@checked
@given(STEPS)
def test_no_neighbours_of_a_fused_word_add(steps: list[Step]) -> None:
    word, _ = fuse_to_turn(word_of(steps))
    assert len(word) <= len(steps)
    for first, second in itertools.pairwise(word):
        assert (first.kind, first.axis) != (second.kind, second.axis)
    for motion in word:
        assert not motion.amount.is_zero
        assert motion.kind is MotionKind.TRANSLATION or not split_quarters(motion)[1]


@checked
@given(STEPS)
def test_the_inverse_undoes_the_word(steps: list[Step]) -> None:
    word = word_of(steps)
    identity = product_of([])
    assert_close(ImmutableMatrix(transform(inverse(word)) * transform(word)), identity)
    assert_close(ImmutableMatrix(inverse_transform(word) * transform(word)), identity)
    assert inverse(inverse(word)) == word


@checked
@given(STEPS)
def test_the_inverse_transform_transposes_entry_for_entry(steps: list[Step]) -> None:
    word = word_of(steps)
    assert inverse_transform(word)[:3, :3] == transform(word)[:3, :3].T


@checked
@given(STEPS)
def test_a_word_and_its_inverse_fuse_to_nothing(steps: list[Step]) -> None:
    word = word_of(steps)
    assert fuse(word + inverse(word)) == ()


def test_the_empty_word_is_the_identity() -> None:
    assert transform(()) == inverse_transform(()) == eye(4)
    assert fuse(()) == inverse(()) == ()


def test_rotations_keep_their_order() -> None:
    word = (rotation(Z, q1), translation(X, a1), rotation(X, q2), translation(Z, a2))
    assert rotations(word) == (rotation(Z, q1), rotation(X, q2))


@pytest.mark.parametrize(
    ("word", "fused"),
    [
        ((rotation(Z, q1), rotation(Z, q2)), (rotation(Z, q1 + q2),)),
        ((translation(X, a1), translation(X, a2)), (translation(X, a1 + a2),)),
        # About and along one axis commute, and so do slides.
        (
            (rotation(Z, q1), translation(Z, a1), rotation(Z, q2)),
            (translation(Z, a1), rotation(Z, q1 + q2)),
        ),
        (
            (translation(X, a1), translation(Y, a2), translation(X, a2)),
            (translation(X, a1 + a2), translation(Y, a2)),
        ),
        # Rx(180) passes a turn about z by flipping its sign.
        (
            (rotation(Z, q1), rotation(X, pi), rotation(Z, q2), rotation(X, -pi)),
            (rotation(Z, q1 - q2),),
        ),
        # Rx(90) takes z to -y: Rx(90) Rz(q) = Ry(-q) Rx(90).
        ((rotation(X, pi / 2), rotation(Z, q1)), (rotation(Y, -q1), rotation(X, pi / 2))),
        ((rotation(X, pi / 2), rotation(X, 3 * pi / 2)), ()),
        ((rotation(Z, q1), rotation(Z, -q1)), ()),
        ((translation(X, a1), rotation(X, q1), translation(X, -a1)), (rotation(X, q1),)),
        # A pair that cancels lets what stood around it meet.
        (
            (rotation(Z, q1), rotation(X, q2), rotation(X, -q2), rotation(Z, q3)),
            (rotation(Z, q1 + q3),),
        ),
        ((rotation(Z, q1 + pi / 2), rotation(Z, q2 - pi / 2)), (rotation(Z, q1 + q2),)),
        # Angles that are no right angles stay where they are.
        (
            (rotation(X, pi / 3), rotation(Z, q1), rotation(X, -pi / 3)),
            (rotation(X, pi / 3), rotation(Z, q1), rotation(X, -pi / 3)),
        ),
        # Angles that add up to a right angle turn what stands behind them.
        (
            (rotation(X, pi / 4), rotation(X, pi / 4), rotation(Z, q1)),
            (rotation(Y, -q1), rotation(X, pi / 2)),
        ),
    ],
)
def test_the_rules_of_fusing(word: Word, fused: Word) -> None:
    assert set(fuse(word)) == set(fused)
    assert len(fuse(word)) == len(fused)


def functions_of(matrix: ImmutableMatrix) -> set[Expr]:
    return set(matrix.atoms(cos, sin))


def test_a_twist_of_180_degrees_merges_parallel_axes() -> None:
    """The fourth axis of a SCARA points down: its angle enters with a minus, twice with a plus."""
    word = (
        rotation(Z, q1),
        translation(X, a1),
        rotation(Z, q2),
        translation(X, a2),
        rotation(X, pi),
        rotation(Z, q4),
    )
    assert functions_of(transform(word)[:3, :3]) == {cos(q1 + q2 - q4), sin(q1 + q2 - q4)}
    back = transform((*word, rotation(X, -pi)))
    assert functions_of(back[:3, :3]) == {cos(q1 + q2 - q4), sin(q1 + q2 - q4)}


def test_parallel_axes_merge_across_a_slide() -> None:
    word = (
        rotation(Z, q1),
        translation(Z, a1),
        rotation(Z, q2),
        translation(Z, q3),
        rotation(Z, q4),
    )
    total = q1 + q2 + q4
    assert functions_of(transform(word)) == {cos(total), sin(total)}


@pytest.mark.parametrize("quarters", range(-4, 5))
def test_a_fixed_offset_folds_into_signs(quarters: int) -> None:
    entry = transform((rotation(Z, q1 + quarters * pi / 2),))[0, 0]
    assert entry == (cos(q1), -sin(q1), -cos(q1), sin(q1))[quarters % 4]


def test_axes_that_become_parallel_by_two_right_angles_merge() -> None:
    """Rx(90) Ry(90) Rx(-90) is a turn about z alone, so all turns between are about z as well."""
    word = (
        rotation(Z, q1),
        rotation(X, pi / 2),
        rotation(Y, q2),
        rotation(X, -pi / 2),
        rotation(Z, q4),
    )
    assert functions_of(transform(word)) == {cos(q1 + q2 + q4), sin(q1 + q2 + q4)}


def test_a_pair_that_cancels_leaves_no_function() -> None:
    word = (rotation(Z, q1), translation(X, a1), translation(X, -a1), rotation(Z, -q1))
    assert fuse(word) == ()
    assert transform(word) == eye(4)


def test_the_planar_position_has_one_term_a_link() -> None:
    word = (rotation(Z, q1), translation(X, a1), rotation(Z, q2), translation(X, a2))
    x, y, z = position(word)
    assert x == a1 * cos(q1) + a2 * cos(q1 + q2)
    assert y == a1 * sin(q1) + a2 * sin(q1 + q2)
    assert z == 0


# -- turns ----------------------------------------------------------------------------------------


def matrix_of(turn: Turn) -> np.ndarray:
    matrix = np.zeros((3, 3), dtype=int)
    for column, (axis, sign) in enumerate(turn.images):
        matrix[axis, column] = sign
    return matrix


def rotation_matrices() -> list[np.ndarray]:
    """Return the 24 signed permutation matrices of determinant 1."""
    found = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            matrix = np.zeros((3, 3), dtype=int)
            matrix[list(order), range(3)] = signs
            if round(np.linalg.det(matrix)) == 1:
                found.append(matrix)
    return found


def turn_of(matrix: np.ndarray) -> Turn:
    rows = [int(np.flatnonzero(matrix[:, column])[0]) for column in range(3)]
    first, second, third = ((Axis(row), int(matrix[row, c])) for c, row in enumerate(rows))
    return Turn((first, second, third))


TURNS = [turn_of(matrix) for matrix in rotation_matrices()]


def quarter_matrix(axis: Axis, quarters: int) -> np.ndarray:
    step = Step(MotionKind.ROTATION, axis, Amount(degrees=90 * quarters))
    return np.array([[round(float(x)) for x in row[:3]] for row in step.matrix()[:3]])


def test_there_are_24_turns() -> None:
    assert len(set(TURNS)) == 24
    assert IDENTITY in TURNS


def test_turns_multiply_as_their_matrices_do() -> None:
    for first, second in itertools.product(TURNS, repeat=2):
        both = first.then(second)
        assert both in TURNS
        assert (matrix_of(both) == matrix_of(first) @ matrix_of(second)).all()


def test_turns_are_a_group() -> None:
    for turn in TURNS:
        assert turn.then(IDENTITY) == IDENTITY.then(turn) == turn
        (undone,) = [other for other in TURNS if turn.then(other) == IDENTITY]
        assert undone.then(turn) == IDENTITY
        assert (matrix_of(undone) == matrix_of(turn).T).all()
    for first, second, third in itertools.product(TURNS[::3], TURNS[::2], TURNS[1::3]):
        assert first.then(second).then(third) == first.then(second.then(third))


@pytest.mark.parametrize("axis", Axis)
@pytest.mark.parametrize("quarters", range(-5, 6))
def test_quarters_about_an_axis(axis: Axis, quarters: int) -> None:
    turn = Turn.about(axis, quarters)
    assert (matrix_of(turn) == quarter_matrix(axis, quarters)).all()
    for each in Axis:
        image, sign = turn.image(each)
        column = quarter_matrix(axis, quarters)[:, each]
        assert column[image] == sign


@pytest.mark.parametrize("turn", TURNS, ids=lambda turn: str(TURNS.index(turn)))
def test_a_turn_is_written_with_as_few_rotations_as_can_be(turn: Turn) -> None:
    written = turn.zyx_quarters()
    assert [axis for axis, _ in written] == [Z, Y, X]
    product = np.eye(3, dtype=int)
    for axis, quarters in written:
        product = product @ quarter_matrix(axis, quarters)
    assert (product == matrix_of(turn)).all()
    used = sum(1 for _, quarters in written if quarters % 4)
    alternatives = [
        sum(1 for k in each if k)
        for each in itertools.product(range(4), repeat=3)
        if (
            quarter_matrix(Z, each[0]) @ quarter_matrix(Y, each[1]) @ quarter_matrix(X, each[2])
            == matrix_of(turn)
        ).all()
    ]
    assert used == min(alternatives)


@pytest.mark.parametrize(
    ("angle", "rest", "quarters"),
    [
        (q1, q1, 0),
        (q1 + pi / 2, q1, 1),
        (pi - q1, -q1, 2),
        (q1 - pi / 2, q1, 3),
        (q1 + 2 * pi, q1, 0),
        (-pi, Integer(0), 2),
        (5 * pi / 2, Integer(0), 1),
        (pi / 3, pi / 3, 0),
        (q1 + pi / 4, q1 + pi / 4, 0),
        (Rational(3, 2), Rational(3, 2), 0),
        (q1 + 1, q1 + 1, 0),
    ],
)
def test_quarters_are_split_off_exactly(angle: Expr, rest: Expr, quarters: int) -> None:
    assert split_quarters(rotation(Z, angle)) == (rotation(Z, rest), quarters)


# -- sizes ----------------------------------------------------------------------------------------


def operations(expression: Expr) -> int:
    """Count what stands in an expression tree: additions, multiplications, sines and cosines."""
    total = 0
    for node in preorder_traversal(expression):
        if isinstance(node, Add):
            total += len(node.args) - 1
        elif isinstance(node, Mul):
            total += sum(1 for factor in node.args if factor != -1) - 1
        elif isinstance(node, (cos, sin)):
            total += 1 - operations(node.args[0])  # sums inside an angle are not counted
    return total


def right_angled(count: int) -> Word:
    angles = symbols(f"t1:{count + 1}", real=True)
    word: Word = ()
    for k, angle in enumerate(angles):
        word += (rotation(Z, angle), rotation(X, (-1) ** k * pi / 2))
    return word


def skew(count: int) -> Word:
    word: Word = ()
    for k in range(1, count + 1):
        word += (
            rotation(Z, Symbol(f"t{k}", real=True)),
            rotation(X, Symbol(f"u{k}", real=True)),
        )
    return word


@pytest.mark.parametrize(
    "word",
    [
        (),
        (translation(X, a1),),
        (rotation(X, pi / 2),),
        (rotation(Z, q1),),
        (rotation(Z, q1), translation(X, a1), rotation(Z, q2)),
        (rotation(Z, q1), rotation(X, pi), rotation(Z, q2)),
        (rotation(X, q1), rotation(Y, q2), rotation(X, q3), rotation(Z, q4)),
        *(right_angled(count) for count in range(2, 9)),
        *(skew(count) for count in range(1, 5)),
    ],
    ids=lambda word: str(len(word)),
)
def test_the_size_is_counted_right_before_multiplying(word: Word) -> None:
    entries = [entry for column in orientation(word) for entry in column]
    assert closed_form_size(word) == sum(operations(entry) for entry in entries)


def test_the_counter_of_this_test_counts() -> None:
    assert operations(Integer(1)) == operations(-q1) == 0
    assert operations(cos(q1 + q2)) == operations(-sin(q1)) == 1
    assert operations(cos(q1) * sin(q2 - q3)) == 3
    assert operations(-(cos(q1) * cos(q2)) + sin(q1) * sin(q2)) == 7
    assert operations((cos(q1) + sin(q2) * cos(q3)) * cos(q4)) == 7


def test_the_size_of_a_very_long_word_takes_no_time() -> None:
    assert closed_form_size(skew(500)) > 10**100
