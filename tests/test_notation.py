"""How results are written: order, signs, short forms that read one way, and broken lines."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from fractions import Fraction

import pytest
from evaluate import Reader, number, value_of
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import (
    Expr,
    Integer,
    Rational,
    Symbol,
    acos,
    atan2,
    cos,
    pi,
    sin,
    sqrt,
    tan,
)

import symdh
from symdh.errors import DerivationError
from symdh.notation import Notation, Piece, Shorthand, break_lines, joined, total_width
from symdh.notation.names import GREEK, split_name
from symdh.notation.nodes import (
    Cross,
    Degrees,
    Dot,
    Equation,
    Generic,
    Juxtaposed,
    Listed,
    Matrix,
    Name,
    Node,
    Number,
    Operator,
    Pi,
    PoseName,
    Product,
    Rounded,
    Screw,
    Short,
    Sum,
    Transposed,
    Tuple,
    Unit,
    leaves,
    mapped,
)
from symdh.notation.numbers import decimal, figures
from symdh.notation.pieces import MathWriter
from symdh.render.latex_math import LatexWriter
from symdh.render.plain_math import PlainWriter
from symdh.render.unicode_math import UnicodeWriter
from symdh.robot import Axis, MotionKind
from symdh.table import parse_expression

HEAD = "name: arm\nconvention: standard\njoints:\n"
ARM = symdh.loads(
    HEAD
    + """
  - {theta: theta1, d: d1, a: a1, alpha: alpha1}
  - {theta: theta2, d: 0, a: a2, alpha: 0}
  - {theta: theta3, d: 0, a: a3, alpha: 90 deg}
tool: [Tx(L)]
"""
)
DECIMAL_ARM = symdh.loads(HEAD + "  - {theta: theta1, d: 0, a: 0.25, alpha: 0}\n")

t1, t2, t3 = ARM.variables
d1, a1, a2, a3, alpha1, L = (
    Symbol(name, real=True) for name in ("d1", "a1", "a2", "a3", "alpha1", "L")
)

PLAIN, UNICODE, LATEX = PlainWriter(), UnicodeWriter(), LatexWriter()


def plain(expression: Expr, notation: Notation | None = None) -> str:
    return PLAIN.text((notation or Notation(ARM)).write(expression))


def revolute_arm(*names: str) -> symdh.Robot:
    rows = "".join(f"  - {{theta: {name}, d: 0, a: 1, alpha: 0}}\n" for name in names)
    return symdh.loads(HEAD + rows)


# -- order and signs ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        # Numbers, parameters in chain order, functions in joint order, brackets.
        (cos(t3) * sin(t1 + t2), "s12*c3"),
        (cos(t3) * a2 * sin(t1), "a2*s1*c3"),
        (cos(t1) * a3 * a1 * 2, "2*a1*a3*c1"),
        (sin(t2) * cos(t2), "c2*s2"),
        (sin(t2 + t3) * cos(t1), "c1*s23"),
        ((a1 + a2) * cos(t1) * d1, "d1*c1*(a1 + a2)"),
        (cos(alpha1) * cos(t1), "c1*cos(alpha1)"),
        (L * d1 * a1, "a1*d1*L"),
        # Terms: products without a parameter by weight, then by parameter in chain order.
        (a2 * cos(t1 + t2) + a1 * cos(t1), "a1*c1 + a2*c12"),
        (cos(t1) * cos(t2) - sin(t1) * sin(t2), "c1*c2 - s1*s2"),
        (sin(t1) * cos(t2) + cos(t1) * sin(t2), "s1*c2 + c1*s2"),
        (L + a1 + d1, "a1 + d1 + L"),
        # A positive term leads where there is one; a common minus comes out of the bracket.
        (d1 - a1, "d1 - a1"),
        (-a1 * cos(t1) - a2 * sin(t2), "-(a1*c1 + a2*s2)"),
        (cos(t1) * (-a1 - a2), "-c1*(a1 + a2)"),
        (-(a1 + a2 * cos(t2)) * sin(t1), "-s1*(a1 + a2*c2)"),
        (cos(t1) * (a2 - a1), "c1*(a2 - a1)"),
        (-sin(t1), "-s1"),
        ((-a1 - a2) ** 2, "(a1 + a2)**2"),
        ((-a1 - a2) ** 3, "-(a1 + a2)**3"),
        # Quotients and powers.
        (a1 / a2, "a1/a2"),
        (a1 / (a1 + a2), "a1/(a1 + a2)"),
        (a1 / (a2 * a3), "a1/(a2*a3)"),
        (cos(t1) ** 2, "c1**2"),
        (a1 ** Rational(2, 3), "a1**(2/3)"),
        (1 / sqrt(a1), "1/sqrt(a1)"),
        (sqrt(a1**2 + a2**2), "sqrt(a1**2 + a2**2)"),
        # Numbers.
        (Integer(0), "0"),
        (Integer(-3), "-3"),
        (cos(t1) * Rational(1, 2), "1/2*c1"),
        (sqrt(2) / 2 * cos(t1), "sqrt(2)/2*c1"),
        (sqrt(6) / 4 - sqrt(2) / 4, "sqrt(6)/4 - sqrt(2)/4"),
        (-2 * pi / 3, "-2*pi/3"),
        # Functions that have no short form.
        (cos(2 * t1), "cos(2*theta1)"),
        (sin(t1 + pi / 3), "sin(theta1 + 60 deg)"),
        (cos(t1 + alpha1), "cos(theta1 + alpha1)"),
        (tan(alpha1), "tan(alpha1)"),
        (atan2(a1, -a2), "atan2(a1, -a2)"),
        (acos(a1 / a2), "acos(a1/a2)"),
        (abs(a1 - a2), "abs(a1 - a2)"),
    ],
)
def test_an_expression_is_written_as_books_print_it(expression: Expr, text: str) -> None:
    assert plain(expression) == text


def test_brackets_inside_brackets_are_told_apart() -> None:
    nested = cos(t1) * (a1 * (a2 * (a3 + L) + 1) - 2)
    assert UNICODE.text(Notation(ARM).write(nested)) == "c₁ (a₁ [1 + a₂ (a₃ + L)] - 2)"
    assert plain(nested) == "c1*(a1*(1 + a2*(a3 + L)) - 2)"


def test_raw_terms_keep_their_order() -> None:
    terms = [-sin(t1) * cos(t2), Integer(0), cos(t1), a2 * cos(t2)]
    assert PLAIN.text(Notation(ARM).sum(terms)) == "c1 - s1*c2 + a2*c2"
    assert PLAIN.text(Notation(ARM).sum([Integer(0), Integer(0)])) == "0"
    assert PLAIN.text(Notation(ARM).sum([-cos(t1)])) == "-c1"


@pytest.mark.parametrize(
    "unknown", [Symbol("x", real=True) ** Symbol("n", real=True), Integer(2) ** t1, sin(t1) > 0]
)
def test_what_has_no_notation_is_refused(unknown: Expr) -> None:
    with pytest.raises(DerivationError, match="there is no notation for"):
        Notation(ARM).write(unknown)


# -- constants ------------------------------------------------------------------------------------


def test_decimals_stand_where_the_table_has_them() -> None:
    half = Rational(1, 2) * cos(t1)
    assert plain(half, Notation(ARM)) == "1/2*c1"
    assert plain(half, Notation(DECIMAL_ARM)) == "0.5*c1"
    assert plain(half, Notation(ARM, decimals=True)) == "0.5*c1"
    assert plain(half, Notation(DECIMAL_ARM, decimals=False)) == "1/2*c1"
    assert plain(Rational(1, 3) * cos(t1), Notation(DECIMAL_ARM)) == "1/3*c1"


def test_degrees_stand_unless_the_table_counts_in_radians() -> None:
    radians = symdh.loads("units: {angle: rad}\n" + HEAD + "  - {theta: q, d: 0, a: 1, alpha: 0}\n")
    assert plain(cos(t1 + pi / 6), Notation(ARM)) == "cos(theta1 + 30 deg)"
    assert plain(cos(Symbol("q", real=True) + pi / 6), Notation(radians)) == "cos(q + pi/6)"
    assert plain(cos(t1 + pi / 6), Notation(ARM, degrees=False)) == "cos(theta1 + pi/6)"


@pytest.mark.parametrize(
    ("angle", "text"),
    [
        (Integer(0), "0"),
        (pi / 2, "90 deg"),
        (-pi / 8, "-22.5 deg"),
        (t1 - pi / 2, "theta1 - 90 deg"),
        (pi - t1, "180 deg - theta1"),
        (t1 + t2 - pi / 3, "theta1 + theta2 - 60 deg"),
        (pi / 3 - t1 - t2, "60 deg - (theta1 + theta2)"),
        (-pi / 3 - t1, "-theta1 - 60 deg"),
        (Rational(6, 5), "1.2"),
        (t1 + 1, "theta1 + 1"),
        (t1, "theta1"),
        # 180/7 degrees is no tidy number.
        (pi / 7, "pi/7"),
        (alpha1 + t1, "theta1 + alpha1"),
    ],
)
def test_an_angle_of_the_table(angle: Expr, text: str) -> None:
    assert PLAIN.text(Notation(ARM, decimals=True).angle(angle)) == text


# -- short forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("angle", "cosine", "sine"),
    [
        (t1, "c1", "s1"),
        (-t1, "c1", "-s1"),
        (t1 + t2, "c12", "s12"),
        (t1 - t2, "c_{1-2}", "s_{1-2}"),
        (t2 - t1, "c_{1-2}", "-s_{1-2}"),
        (-t1 - t3, "c13", "-s13"),
        (t1 - t2 + t3, "c_{1-2,3}", "s_{1-2,3}"),
        (t1 - t2 - t3, "c_{1-2-3}", "s_{1-2-3}"),
        (t1 + t2 - t3, "c_{12-3}", "s_{12-3}"),
        (t1 + pi / 2, "-s1", "c1"),
        (t1 + t2 + pi, "-c12", "-s12"),
        (pi / 2 - t1, "s1", "c1"),
    ],
)
def test_short_forms(angle: Expr, cosine: str, sine: str) -> None:
    assert (plain(cos(angle)), plain(sin(angle))) == (cosine, sine)


@pytest.mark.parametrize("angle", [2 * t1, t1 / 2, t1 + alpha1, alpha1, t1 + pi / 4, t1 + 1])
def test_what_is_no_sum_of_joint_variables_has_no_short_form(angle: Expr) -> None:
    assert not any(isinstance(leaf, Short) for leaf in leaves(Notation(ARM).write(cos(angle))))


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        (("theta1", "theta2"), (1, 2)),
        (("q4", "q2"), (4, 2)),
        (("theta_2", "q3"), (2, 3)),
        # Names that do not tell the joints apart give way to the rows.
        (("a", "b", "c"), (1, 2, 3)),
        (("x1", "y1"), (1, 2)),
        (("q7", "phi"), (1, 2)),
        (("q0", "q1"), (1, 2)),
        (("q01", "q02"), (1, 2)),
        (("q12", "q3"), (12, 3)),
        (("q1000", "q2"), (1, 2)),
    ],
)
def test_joints_are_numbered_by_name_or_by_row(
    names: tuple[str, ...], numbers: tuple[int, ...]
) -> None:
    robot = revolute_arm(*names)
    shorthand = Shorthand(robot)
    assert tuple(shorthand.number(variable) for variable in robot.variables) == numbers


def test_rows_count_sliding_joints_too() -> None:
    robot = symdh.loads(
        HEAD + "  - {theta: 0, d: s, a: 0, alpha: 0}\n  - {theta: phi, d: 0, a: 0, alpha: 0}\n"
    )
    assert plain(cos(robot.variables[1]), Notation(robot)) == "c2"


def test_twelve_joints_are_separated_by_commas() -> None:
    robot = revolute_arm(*(f"q{i}" for i in range(1, 13)))
    q = (Symbol("zero"), *robot.variables)
    notation = Notation(robot)
    assert plain(cos(q[12]), notation) == "c12"
    assert plain(cos(q[1] + q[2]), notation) == "c_{1,2}"
    assert plain(cos(q[1] - q[12]), notation) == "c_{1-12}"
    assert plain(cos(q[1] - q[1 + 1] + q[12]), notation) == "c_{1-2,12}"
    assert UNICODE.text(notation.write(sin(q[10] + q[11]))) == "s₁₀,₁₁"
    assert LATEX.text(notation.write(sin(q[10] + q[11]))) == "s_{10,11}"


@pytest.mark.parametrize(
    "names",
    [
        ("q1", "q2", "q3", "q4", "q5"),
        ("q1", "q2", "q3", "q12", "q23"),
        ("q1", "q10", "q11", "q110"),
    ],
)
def test_no_two_sums_read_alike(names: tuple[str, ...]) -> None:
    """Every sum and difference of the joints has a subscript of its own, and it reads back."""
    robot = revolute_arm(*names)
    notation, shorthand = Notation(robot), Shorthand(robot)
    joints = {shorthand.number(variable): variable.name for variable in robot.variables}
    point = {name: number(3**k) for k, name in enumerate(names)}
    seen: dict[str, Expr] = {}
    for signs in itertools.product((0, 1, -1), repeat=len(names)):
        angle = sum((s * v for s, v in zip(signs, robot.variables, strict=True)), Integer(0))
        if angle.is_zero:
            continue
        (short,) = leaves(notation.write(cos(angle)))
        assert isinstance(short, Short)
        assert seen.setdefault(short.label, cos(angle)) == cos(angle)
        read = Reader(point, joints).angle(short.label)
        assert abs(read) == abs(value_of(angle, point))
        assert shorthand.angle(short.label) in (angle, -angle)
    assert len(seen) == (3 ** len(names) - 1) // 2


@pytest.mark.parametrize("name", ["s1", "c12", "c_1", "s_2"])
def test_a_table_that_uses_such_names_gets_functions_spelt_out(name: str) -> None:
    robot = symdh.loads(
        HEAD + f"  - {{theta: q1, d: 0, a: {name}, alpha: 0}}\n"
        "  - {theta: q2, d: 0, a: 1, alpha: 0}\n"
    )
    q1, q2 = robot.variables
    assert plain(cos(q1 + q2), Notation(robot)) == "cos(q1 + q2)"
    shown = [
        leaf for row in Notation(robot).matrix(robot.T()).rows for x in row for leaf in leaves(x)
    ]
    assert not any(isinstance(leaf, Short) for leaf in shown)


@pytest.mark.parametrize("name", ["s", "c", "cs1", "S1", "s1a", "speed1"])
def test_other_names_leave_the_short_forms(name: str) -> None:
    robot = symdh.loads(HEAD + f"  - {{theta: q1, d: 0, a: {name}, alpha: 0}}\n")
    assert plain(cos(robot.variables[0]), Notation(robot)) == "c1"


def test_no_shorthand_spells_everything_out() -> None:
    spelt = Notation(ARM, Shorthand.none(ARM))
    assert plain(cos(t1 + t2) - sin(t3), spelt) == "cos(theta1 + theta2) - sin(theta3)"
    assert plain(cos(t1 + t2)) == "c12"


# -- written and read back ------------------------------------------------------------------------

ANGLES = (t1, t2, t3, t1 + t2, t2 + t3, t1 - t2, t1 - t2 + t3, t1 + t2 + t3, alpha1, t1 + pi / 3)
NUMBERS = (
    Integer(2),
    Integer(-1),
    Rational(1, 2),
    Rational(-3, 7),
    Rational(1, 4),
    sqrt(2) / 2,
    sqrt(3) / 2,
    (sqrt(6) + sqrt(2)) / 4,
    pi / 3,
    cos(pi / 7),
)
PARAMETERS = (a1, a2, a3, d1, L, a1**2, sqrt(a1), 1 / a2, a3 ** Rational(-2, 3))

LEAF = st.one_of(
    st.sampled_from([function(angle) for function in (cos, sin) for angle in ANGLES]),
    st.sampled_from(PARAMETERS),
    st.sampled_from(NUMBERS),
)


def deeper(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    several = st.lists(inner, min_size=2, max_size=4)
    return st.one_of(
        several.map(lambda terms: sum(terms, Integer(0))),
        several.map(lambda terms: terms[0] - sum(terms[1:], Integer(0))),
        st.tuples(inner, inner, inner).map(lambda f: f[0] * f[1] * f[2]),
        st.tuples(inner, inner).map(lambda f: -f[0] * f[1]),
        inner.map(lambda x: x**2),
        inner.map(lambda x: abs(x)),
        st.tuples(inner, inner).map(lambda x: atan2(x[0], 2 + x[1] ** 2)),
        inner.map(lambda x: sqrt(1 + x**2)),
        st.tuples(inner, inner).map(lambda x: x[0] / (3 + x[1] ** 2)),
    )


EXPRESSION = st.recursive(LEAF, deeper, max_leaves=12)
POINTS = [
    {
        name: number(text)
        for name, text in zip(
            ("theta1", "theta2", "theta3", "alpha1", "a1", "a2", "a3", "d1", "L"),
            texts,
            strict=True,
        )
    }
    for texts in (
        ("7/10", "-13/9", "11/4", "2/7", "8/5", "3/11", "5/3", "-9/4", "1/6"),
        ("-5/3", "9/7", "1/8", "-6/5", "1/3", "17/5", "2/9", "4/3", "-7/2"),
    )
]
DEGREES_OR_NOT = st.sampled_from([True, False])


def reads_alike(expression: Expr, other: Callable[[dict[str, object]], object]) -> bool:
    for point in POINTS:
        expected = value_of(expression, point)
        if abs(other(point) - expected) > number("1e-35") * (1 + abs(expected)):  # type: ignore[operator]
            return False
    return True


@settings(max_examples=250, deadline=None, derandomize=True)
@given(EXPRESSION, DEGREES_OR_NOT, DEGREES_OR_NOT)
def test_the_plain_form_reads_back(expression: Expr, degrees: bool, decimals: bool) -> None:
    spelt = Notation(ARM, Shorthand.none(ARM), degrees=degrees, decimals=decimals)
    back = parse_expression(plain(expression, spelt))
    assert reads_alike(expression, lambda point: value_of(back, point))


@settings(max_examples=250, deadline=None, derandomize=True)
@given(EXPRESSION, DEGREES_OR_NOT)
def test_the_nodes_are_worth_what_the_expression_is(expression: Expr, decimals: bool) -> None:
    node = Notation(ARM, decimals=decimals).write(expression)
    joints = {1: "theta1", 2: "theta2", 3: "theta3"}
    assert reads_alike(expression, lambda point: Reader(point, joints).value(node))


@settings(max_examples=150, deadline=None, derandomize=True)
@given(EXPRESSION)
def test_brackets_pair_in_every_alphabet(expression: Expr) -> None:
    node = Notation(ARM).write(expression)
    for writer in (PLAIN, UNICODE, LATEX):
        closing = {")": "(", "]": "[", "}": "{"}
        opened: list[str] = []
        for character in writer.text(node):
            if character in "([{":
                opened.append(character)
            elif character in closing:
                assert opened.pop() == closing[character]
        assert opened == []


@settings(max_examples=100, deadline=None, derandomize=True)
@given(EXPRESSION)
def test_writing_is_a_function_of_the_expression(expression: Expr) -> None:
    """Rebuilt from its parts, and so met in another order, an expression is written the same."""
    rebuilt = expression.func(*reversed(expression.args)) if expression.is_Add else expression
    assert plain(rebuilt) == plain(expression)
    assert plain(-1 * (-expression)) == plain(expression)


# -- leaves, numbers and names --------------------------------------------------------------------


def test_a_map_reaches_every_leaf_and_keeps_the_rest() -> None:
    node = Notation(ARM).write((a1 + 2 * cos(t1)) / (a2 * sqrt(a3)) - sin(2 * t2) ** 2)
    assert mapped(node, lambda leaf: leaf) == node
    marked = mapped(node, lambda leaf: Number(Integer(7)))
    assert len(leaves(marked)) == len(leaves(node)) > 6
    assert set(leaves(marked)) == {Number(Integer(7))}


@pytest.mark.parametrize(
    "around",
    [
        lambda a, b: Operator(MotionKind.ROTATION, Axis.X, Sum((a, b)), craig=True),
        lambda a, b: Juxtaposed((a, b)),
        lambda a, b: Equation((a, b)),
        Dot,
        Cross,
        lambda a, b: Product((Transposed(a), b)),
        lambda a, b: Tuple((a, b)),
        lambda a, b: Listed((a, b)),
        lambda a, b: Matrix(((a,), (b,))),
    ],
)
def test_a_map_reaches_the_leaves_of_formulas(around: Callable[[Node, Node], Node]) -> None:
    first, second, other = Name("a1"), Name("a2"), Number(Integer(7))
    assert leaves(around(first, second)) == (first, second)
    changed = mapped(around(first, second), lambda leaf: other if leaf == second else leaf)
    assert changed == around(first, other)


@pytest.mark.parametrize(
    ("node", "plain", "unicode"),
    [
        (Degrees(Rational(45, 2)), "22.5 deg", "22.5°"),
        (Pi(), "pi", "π"),
        (Product((Rounded("1.5"), Unit("mm"))), "1.5*mm", "1.5 mm"),
        (Generic("r", "31"), "r_{31}", "r₃₁"),
        (Generic("G"), "G", "G"),
        (Short("c", "12"), "c12", "c₁₂"),
        (Short("c", "1-2"), "c_{1-2}", "c₁₋₂"),
        (PoseName("0", "2", craig=False), "T(0,2)", "⁰T₂"),
        (Screw(Axis.Z), "Screw(z)", "Screw_z"),
        (Matrix(((Name("a"), Name("b")), (Pi(), Name("c")))), "[[a, b], [pi, c]]", "[a, b; π, c]"),
        (Listed((Name("a"), Name("b"))), "a, b", "a,   b"),
        (Dot(Name("a"), Name("b")), "a . b", "a · b"),
        (Cross(Name("a"), Name("b")), "a x b", "a × b"),
        (Transposed(Generic("J")), "J^T", "Jᵀ"),
        (Juxtaposed((Generic("A", "1"), Generic("A", "2"))), "A_{1}*A_{2}", "A₁ A₂"),
    ],
)
def test_nodes_that_are_no_expressions_have_a_plain_form_too(
    node: Node, plain: str, unicode: str
) -> None:
    assert (PLAIN.text(node), UNICODE.text(node)) == (plain, unicode)


@pytest.mark.parametrize("kind", MotionKind)
def test_a_plain_operator_is_spelt_as_in_a_table(kind: MotionKind) -> None:
    angle, length = Degrees(Rational(90)), Name("a1")
    amount = angle if kind is MotionKind.ROTATION else length
    text = PLAIN.text(Operator(kind, Axis.X, amount, craig=True))
    assert text == ("Rx(90 deg)" if kind is MotionKind.ROTATION else "Tx(a1)")
    head = "name: arm\nconvention: standard\njoints:\n  - {theta: q1, d: 0, a: 0, alpha: 0}\n"
    (motion,) = symdh.loads(f"{head}base: [{text}]\n").base
    assert (motion.kind, motion.axis) == (kind, Axis.X)


def test_numbers_in_latex() -> None:
    assert LATEX.text(Number(Rational(1, 3))) == r"\tfrac{1}{3}"
    assert LATEX.text(Product((Name("a1"), Number(Integer(3))))) == r"a_{1} \cdot 3"


@pytest.mark.parametrize("writer", [PLAIN, UNICODE, LATEX])
def test_a_node_that_a_writer_does_not_know_is_refused(writer: MathWriter) -> None:
    class Integral:
        pass

    with pytest.raises(TypeError, match=r"^no way to write Integral$"):
        writer.text(Sum((Name("a1"), Integral())))  # type: ignore[arg-type]


@given(st.fractions(max_denominator=10**6))
def test_an_exact_number_keeps_its_value(value: Fraction) -> None:
    text = decimal(Rational(value.numerator, value.denominator))
    assert Fraction(text) == value
    assert ("/" in text) == any(value.denominator % p == 0 for p in primes_but_2_and_5(value))


def primes_but_2_and_5(value: Fraction) -> list[int]:
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return [rest] if rest > 1 else []


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (-0.0, "0"),
        (1.0, "1"),
        (0.670632, "0.6706"),
        (13.88949, "13.889"),
        (-0.25, "-0.25"),
        (123456.0, "123456"),
        (1234567.0, "1234567"),
        (0.00005, "0.0001"),
        (0.00004, "4e-5"),
        (-1.23456789e-7, "-1.2346e-7"),
        (1.5e9, "1.5e9"),
        (99999.96, "100000"),
    ],
)
def test_figures_for_people(value: float, text: str) -> None:
    assert figures(value) == text


@given(st.floats(-1e12, 1e12, allow_nan=False))
def test_figures_are_near_the_number(value: float) -> None:
    assert abs(float(figures(value)) - value) <= 0.5001 * max(
        1e-4 * (abs(value) >= 5e-5), abs(value) * 1e-4
    )


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("theta1", ("theta", "1")),
        ("L_tool", ("L", "tool")),
        ("beta", ("beta", "")),
        ("errno", ("errno", "")),
        ("a_1_2", ("a", "1,2")),
        ("q12", ("q", "12")),
        ("x1y", ("x", "1y")),
        ("_", ("_", "")),
    ],
)
def test_a_name_splits_into_letter_and_subscript(name: str, parts: tuple[str, str]) -> None:
    assert split_name(name) == parts


def test_every_greek_letter_is_written_as_one() -> None:
    for name, letter in GREEK.items():
        symbol = Symbol(f"{name}3", real=True)
        node = Notation(ARM).write(symbol)
        assert UNICODE.text(node) == f"{letter}₃"
        assert LATEX.text(node) == ("o_{3}" if name == "omicron" else f"\\{name}_{{3}}")


# -- breaking lines -------------------------------------------------------------------------------

PIECES = st.lists(
    st.builds(
        Piece,
        text=st.text("abc", min_size=1, max_size=3),
        width=st.floats(0.5, 40),
        depth=st.sampled_from([None, None, 0, 0, 1, 2]),
    ),
    max_size=40,
)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(PIECES, st.floats(5, 150), st.floats(0, 20))
def test_breaking_loses_nothing(pieces: list[Piece], limit: float, indent: float) -> None:
    lines = break_lines(pieces, limit, indent)
    assert [piece for line in lines for piece in line] == pieces
    assert all(lines)
    for line in lines[1:]:
        assert line[0].depth is not None


@settings(max_examples=300, deadline=None, derandomize=True)
@given(PIECES, st.floats(5, 150), st.floats(0, 20))
def test_a_line_is_too_wide_only_where_nothing_breaks(
    pieces: list[Piece], limit: float, indent: float
) -> None:
    for position, line in enumerate(break_lines(pieces, limit, indent)):
        room = limit - (indent if position else 0.0)
        breaks = [k for k, piece in enumerate(line) if k and piece.depth is not None]
        assert total_width(line) <= room or not breaks


def test_outermost_breaks_come_first() -> None:
    pieces = LATEX.pieces(Notation(ARM).write(cos(t1) * (a1 + a2 + a3 + L) + sin(t1) * (a2 + a3)))
    outer, inner = (
        min(k for k, piece in enumerate(pieces) if piece.depth == depth) for depth in (0, 1)
    )
    assert inner < outer
    limit = total_width(pieces) - 1
    first, *_ = break_lines(pieces, limit)
    assert len(first) == outer
    assert joined(first) == r"c_{1} (a_{1} + a_{2} + a_{3} + L)"


def test_what_fits_is_not_broken() -> None:
    pieces = LATEX.pieces(Notation(ARM).write(a1 + a2 + a3))
    assert break_lines(pieces, total_width(pieces)) == [pieces]
    assert len(break_lines(pieces, total_width(pieces) - 0.01)) == 2


def test_nothing_breaks_into_nothing() -> None:
    assert break_lines([], 10.0) == []


def test_terms_with_leading_symbols_stand_in_front_squares_before_products() -> None:
    """What a goal gives, in the order asked for; the arm's own lengths behind it."""
    w_x, w_y = (Symbol(name, real=True) for name in ("w_x", "w_y"))
    a1, theta1 = ARM.joints[0].a, ARM.joints[0].variable
    assert theta1 is not None
    leading = Notation(ARM, leading=("w_x", "w_y"))
    whole = a1**2 + w_y**2 + w_x**2 - 2 * a1 * w_x * cos(theta1)
    assert plain(whole, leading) == "w_x**2 + w_y**2 - 2*a1*w_x*c1 + a1**2"
    assert plain(w_y * cos(theta1) + w_x * sin(theta1) - a1, leading) == "w_x*s1 + w_y*c1 - a1"
