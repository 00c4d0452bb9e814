"""The Python face: what README shows, with results worked out by hand."""

from __future__ import annotations

import re
from math import pi

import pytest
from sympy import Matrix, Rational, S, Symbol, cos, sin, symbols

import symdh

ARM = """
name: arm
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: a1, alpha: 0}
  - {theta: theta2, d: 0, a: a2, alpha: 0}
values: {a1: 1, a2: 1}
"""
THETA1, THETA2, A1, A2 = symbols("theta1 theta2 a1 a2", real=True)


@pytest.fixture(scope="module")
def arm() -> symdh.Robot:
    return symdh.loads(ARM)


@pytest.fixture(scope="module")
def inverse(arm: symdh.Robot) -> symdh.InverseKinematics:
    return symdh.inverse_kinematics(arm)


def test_every_public_name_is_there() -> None:
    for name in symdh.__all__:
        assert getattr(symdh, name) is not None
    with pytest.raises(AttributeError, match="has no attribute 'kinematics_forward'"):
        _ = symdh.kinematics_forward


def test_jacobian_is_the_derivative_of_the_position(arm: symdh.Robot) -> None:
    found = symdh.jacobian(arm)
    x = A1 * cos(THETA1) + A2 * cos(THETA1 + THETA2)
    y = A1 * sin(THETA1) + A2 * sin(THETA1 + THETA2)
    expected = Matrix([x, y]).jacobian([THETA1, THETA2])
    assert (found.matrix[:2, :] - expected).applyfunc(lambda entry: entry.expand()).is_zero_matrix
    assert list(found.matrix.row(5)) == [1, 1]


def test_jacobian_of_another_frame(arm: symdh.Robot) -> None:
    # The end of the first link does not feel the second joint; along its own axes it moves along y.
    assert symdh.jacobian(arm, of=1, in_=1).matrix[:3, :] == Matrix([[0, 0], [A1, 0], [0, 0]])


def test_singularities_are_the_stretched_and_the_folded_arm(arm: symdh.Robot) -> None:
    found = symdh.singularities(arm)
    assert found.factors is not None
    (factor,) = found.factors
    assert factor.expression.free_symbols == {THETA2}
    assert factor.expression.subs(THETA2, 0) == factor.expression.subs(THETA2, S.Pi) == 0


@pytest.mark.parametrize(
    "goal",
    [
        [1.0, 1.0],
        [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]],
        Matrix([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0]]),
    ],
    ids=["coordinates", "rows", "sympy"],
)
def test_solutions_of_a_goal(inverse: symdh.InverseKinematics, goal: list[float]) -> None:
    # Unit links to (1, 1): along x and then up, or up and then along x.
    answers = inverse.solve(goal, near=[0.1, 1.5])
    assert [answer.q for answer in answers] == [
        pytest.approx((0, pi / 2), abs=1e-12),
        pytest.approx((pi / 2, -pi / 2), abs=1e-12),
    ]


def test_numpy_array_is_a_goal(inverse: symdh.InverseKinematics) -> None:
    numpy = pytest.importorskip("numpy")
    goal = numpy.eye(4)
    goal[0, 3] = 2
    assert [answer.q for answer in inverse.solve(goal)] == [pytest.approx((0, 0), abs=1e-7)]
    goal[0, 3] = 2.5
    assert inverse.solve(goal) == []


def test_values_win_over_those_of_the_table(inverse: symdh.InverseKinematics) -> None:
    assert inverse.solve([5.0, 0.0]) == []
    (stretched,) = inverse.solve([5.0, 0.0], values={"a_1": 2.5, A2: Rational(5, 2)})
    assert stretched.q == pytest.approx((0, 0), abs=1e-7)


def test_locked_joints_may_be_named_in_any_spelling() -> None:
    rows = "".join(f"  - {{theta: theta{i}, d: 0, a: a{i}, alpha: 0}}\n" for i in (1, 2, 3))
    arm = symdh.loads(f"name: arm\nconvention: standard\njoints:\n{rows}")
    found = symdh.inverse_kinematics(arm, task="x y", lock=["θ_2"])
    assert found.locked == (Symbol("theta2", real=True),)
    with pytest.raises(symdh.UnsupportedError, match="theta9 is no joint variable of arm"):
        symdh.inverse_kinematics(arm, lock=["theta9"])


def test_words_in_formulas_are_for_mathjax(
    arm: symdh.Robot, inverse: symdh.InverseKinematics
) -> None:
    """A notebook's MathJax shows commands inside of text as they are written."""
    for result in (symdh.derive(arm), inverse):
        words = re.findall(r"\\text\{([^}]*)\}", result._repr_html_())
        assert words
        assert not any("\\" in text for text in words)


def test_results_show_themselves(arm: symdh.Robot, inverse: symdh.InverseKinematics) -> None:
    shown = {
        "c_{12}": symdh.jacobian(arm),
        "s_{2}": symdh.singularities(arm),
        "atan2": inverse,
        "a_{1}": symdh.derive(arm),
    }
    for text, result in shown.items():
        html = result._repr_html_()
        assert html.startswith('<div class="symdh">')
        assert text in html
