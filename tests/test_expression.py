"""The expression parser: exact values, units, and the place of every error.

Expected values are typed by hand as sympy objects or numbers; nothing here is read back from the
parser's own output.
"""

from __future__ import annotations

import math
import operator
import time
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import (
    Abs,
    Expr,
    Float,
    Integer,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    pi,
    sin,
    sqrt,
    tan,
)

from symdh.errors import TableError
from symdh.robot import AngleUnit, LengthUnit, Units
from symdh.table import ANGLE, LENGTH, parse_expression, parse_quantity
from symdh.table.lexer import ExpressionError
from symdh.table.parser import parse
from symdh.table.quantity import resolve
from symdh.table.units import Dimension

DEG_MM = Units(AngleUnit.DEGREE, LengthUnit.MILLIMETRE)
RAD_M = Units(AngleUnit.RADIAN, LengthUnit.METRE)
SILENT = Units()


def sym(name: str) -> Symbol:
    return Symbol(name, real=True)


q1, theta1, theta2, L1, L2, k = map(sym, ("q1", "theta1", "theta2", "L1", "L2", "k"))


def read(text: str, dimension: Dimension | None, units: Units = DEG_MM) -> Expr:
    return resolve(parse(text, units).quantity, dimension, units)[0]


def error_of(text: str, dimension: Dimension | None = ANGLE, units: Units = SILENT) -> tuple:
    with pytest.raises(ExpressionError) as caught:
        read(text, dimension, units)
    return caught.value.offset, caught.value.message


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", Integer(0)),
        ("010", Integer(10)),
        ("0.4318", Rational(4318, 10_000)),
        (".5", Rational(1, 2)),
        ("2.", Integer(2)),
        ("1e3", Integer(1000)),
        ("2.5E-3", Rational(1, 400)),
        ("1e30", Integer(10) ** 30),
        ("-L1**2/2", -(L1**2) / 2),
        ("2**3**2", Integer(512)),
        ("2^-1", Rational(1, 2)),
        ("-2**2", Integer(-4)),
        ("7 - 2 - 1", Integer(4)),
        ("8/4/2", Integer(1)),
        ("(L1 + L2)/2", L1 / 2 + L2 / 2),
        ("--1", Integer(1)),
        ("+L1", L1),
        ("2*-3", Integer(-6)),
        ("cos(theta1 + theta2)", cos(theta1 + theta2)),
        ("sin(pi/6)", Rational(1, 2)),
        ("tan(pi/3)", sqrt(3)),
        ("asin(1/2)", pi / 6),
        ("acos(L1)", acos(L1)),
        ("atan(1)", pi / 4),
        ("atan2(1, -1)", 3 * pi / 4),
        ("((2^32)^4)^(3/2)", Integer(2) ** 192),
        ("atan2(0, -1)", pi),
        ("atan2(-1, 0)", -pi / 2),
        ("atan2(L1, L2)", atan2(L1, L2)),
        ("abs(-L1)", Abs(L1)),
        ("sqrt(8)", 2 * sqrt(2)),
        ("sqrt(L1**2 + L2**2)", sqrt(L1**2 + L2**2)),
        ("\tL1 *\t2 ", 2 * L1),
    ],
)
def test_plain_expressions_are_exact(text: str, value: Expr) -> None:
    assert parse_expression(text) == value
    assert not parse_expression(text).has(Float)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("90", pi / 2),
        ("90 deg", pi / 2),
        ("90°", pi / 2),
        ("90deg", pi / 2),
        ("1.2 rad", Rational(6, 5)),
        ("pi/2", pi / 2),
        ("π/2", pi / 2),
        ("theta1 + 90", theta1 + pi / 2),
        ("90 - theta1", pi / 2 - theta1),
        ("90 deg - theta1", pi / 2 - theta1),
        ("theta1 - pi/2", theta1 - pi / 2),
        ("2*theta1", 2 * theta1),
        ("theta1/2 + 45", theta1 / 2 + pi / 4),
        ("2*(theta1 + 45)", 2 * theta1 + pi / 2),
        ("-(30 + 60)", -pi / 2),
        ("2*45", pi / 2),
        ("2*45 deg", pi / 2),
        ("(1/2) deg", pi / 360),
        ("1/(2 deg)*(2 deg)*90", pi / 2),
        ("q1 + atan2(3, 4)", q1 + atan(Rational(3, 4))),
        ("atan2(0.3 m, 400)", atan(Rational(3, 4))),
        ("acos(sin(30))", pi / 3),
        ("90*cos(60)", pi / 4),
        ("abs(-90)", pi / 2),
        ("17", 17 * pi / 180),
    ],
)
def test_angles_in_a_table_in_degrees(text: str, value: Expr) -> None:
    assert read(text, ANGLE) == value


@pytest.mark.parametrize(
    ("text", "millimetres"),
    [
        ("250", Integer(250)),
        ("0.25 m", Integer(250)),
        ("25 cm", Integer(250)),
        ("250 mm", Integer(250)),
        ("1 in", Rational(254, 10)),
        ("1 ft", Rational(3048, 10)),
        ("0.5 m + 20", Integer(520)),
        ("L1 + 0.1 m", L1 + 100),
        ("L1/2", L1 / 2),
        ("2*L1*cos(30 deg)", sqrt(3) * L1),
        ("sqrt((0.3 m)**2 + (0.4 m)**2)", Integer(500)),
        ("0.2 m*sin(k)", 200 * sin(k)),
        ("L1*cos(60)", L1 / 2),
        ("0.3 m * 2 in / (1 in)", Integer(600)),
        ("2*pi*L1", 2 * pi * L1),
    ],
)
def test_lengths_in_a_table_in_millimetres(text: str, millimetres: Expr) -> None:
    assert read(text, LENGTH) == millimetres


def test_every_length_unit_in_every_other() -> None:
    metres = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
    for name, size in metres.items():
        for target in LengthUnit:
            units = Units(None, target)
            value = read(f"3 {name}", LENGTH, units)
            assert float(value) == pytest.approx(3 * size / metres[target.value], rel=1e-15)


@pytest.mark.parametrize(
    "spelling", ["theta1", "theta_1", "θ1", "θ_1", "θ₁", "theta₁", "theta_₁", "ϑ1"]
)
def test_spellings_of_one_symbol(spelling: str) -> None:
    assert parse_expression(spelling) == theta1


@pytest.mark.parametrize(
    ("spelling", "name"),
    [("α", "alpha"), ("Δθ_2", "Deltatheta2"), ("λ", "lambda"), ("µ", "mu"), ("π2", "pi2")],
)
def test_greek_letters_are_spelt_out(spelling: str, name: str) -> None:
    assert parse_expression(spelling) == sym(name)


@pytest.mark.parametrize("name", ["a_1_2", "a__1", "x_", "alpha12", "Delta", "M_PI", "L_max2"])
def test_canonical_names_stay_as_they_are(name: str) -> None:
    assert parse_expression(name) == sym(name)


@pytest.mark.parametrize(
    "name",
    [
        "I",
        "E",
        "S",
        "N",
        "O",
        "Q",
        "beta",
        "gamma",
        "zeta",
        "lambda",
        "class",
        "pi2",
        "errno",
        "q",
        "t0",
        "s1",
        "c1",
        "oo",
        "zoo",
        "None",
        "exec",
        "if",
        "diff",
        "Symbol",
        "T",
        "e",
        "j",
    ],
)
def test_other_names_are_plain_symbols(name: str) -> None:
    symbol = parse_expression(name)
    assert symbol == sym(name)
    assert type(symbol) is Symbol
    assert symbol.is_real


@pytest.mark.parametrize(
    ("text", "offset", "words"),
    [
        ("", 0, "empty"),
        ("  ", 0, "empty"),
        ("__import__('os')", 0, "unexpected character _"),
        ("open('x')", 5, "unexpected character '"),
        ("open(1)", 0, "open is not a known function"),
        ("arcsin(1)", 0, "did you mean asin?"),
        ("lambda: 1", 6, "unexpected character :"),
        ("q1.free", 2, "unexpected character ."),
        ("q1[0]", 2, "unexpected character ["),
        ("q1 if q1", 3, "unexpected if"),
        ("9**9**9**9", 4, "exponent"),
        ("2**100000000", 1, "exponent"),
        ("2**33", 1, "exponent"),
        ("q1**q1", 2, "exponent must be a constant"),
        ("2**(1 deg)", 1, "exponent must be a constant"),
        ("10**16*10**16*10**16*10**16*10**16", 27, "256 bits"),
        ("1e99999999", 0, "decimal exponent over 30"),
        ("1e31", 0, "decimal exponent over 30"),
        ("1" * 41, 0, "41 characters"),
        ("x" * 41, 0, "41 characters"),
        ("(" * 600, 500, "longer than 500"),
        ("-" * 400 + "1", 32, "nested deeper than 32"),
        ("(" * 400, 32, "nested deeper than 32"),
        ("1/0", 1, "division by zero"),
        ("1/(q1 - q1)", 1, "division by zero"),
        ("0**-1", 1, "division by zero"),
        ("tan(pi/2)", 0, "not finite"),
        ("atan2(0,0)", 0, "not finite"),
        ("sqrt(-1)", 0, "not real"),
        ("sqrt(-L1**2)", 0, "not real"),
        ("asin(2)", 0, "not real"),
        ("(-8)**(1/3)", 4, "not real"),
        ("-inf", 0, "not a number"),
        (".inf", 0, "not a number"),
        (".NaN", 0, "not a number"),
        ("q1 + nan", 5, "not a number"),
        ("q1 q2", 3, "write * for a product"),
        ("2 q1", 2, "write * for a product"),
        ("2q1", 1, "write * for a product"),
        ("(q1)(q2)", 4, "write * for a product"),
        ("q1(2)", 0, "write q1*(...) for a product"),
        ("sin q1", 0, "a function needs parentheses"),
        ("sin", 0, "a function needs parentheses"),
        ("sin()", 4, "unexpected )"),
        ("sin(1, 2)", 0, "takes 1 argument"),
        ("atan2(1)", 0, "takes 2 arguments"),
        ("(q1", 3, "missing )"),
        ("q1)", 2, "unexpected )"),
        ("q1 +", 4, "ends early"),
        ("*q1", 0, "unexpected *"),
        ("1,5", 1, "decimal point is ."),
        ("1_000", 1, "unexpected character _"),
        ("q1 = 2", 3, "unexpected character ="),
        ("1.2.3", 3, "unexpected .3"),
        ("60:30", 2, "unexpected character :"),
        ("q1 // 2", 4, "unexpected /"),
        ("90 degrees", 3, "did you mean deg?"),
        ("5 metres", 2, "did you mean m?"),
        ("3 furlongs", 2, "units: deg"),
        ("1/2 deg", 0, "write (1/2) deg or 1/(2 deg)"),
        ("q1 + 1/2 deg", 5, "ambiguous"),
        ("pi/2 rad", 0, "ambiguous"),
        ("(1)/(2) deg", 0, "ambiguous"),
        ("pi deg", 0, "write 180 deg or pi"),
        ("(pi/2) deg", 0, "write 90 deg or pi/2"),
        ("(sqrt(2)*pi) deg", 0, "pi is already radians; take deg away"),
        ("(10**20)**32", 8, "value is over the limit of 256 bits"),
        ("q1 deg", 0, "a unit follows a number"),
        ("(30 deg) deg", 0, "already has a unit"),
        ("deg", 0, "deg is a unit"),
        ("th\u0435ta1", 2, "U+0435 CYRILLIC SMALL LETTER IE"),
        ("q1\u00b2", 2, "write **2"),
        ("q1\u00a0+ 1", 2, "U+00A0 NO-BREAK SPACE"),
        ("\u22121", 0, "write -"),
        ("2\u00d7q1", 1, "write *"),
    ],
)
def test_errors_and_their_places(text: str, offset: int, words: str) -> None:
    found = error_of(text)
    assert found[0] == offset
    assert words in found[1]


@pytest.mark.parametrize(
    ("text", "dimension", "offset", "words"),
    [
        ("0.5 m", ANGLE, 0, "this is a length, where an angle is wanted"),
        ("q1 + 0.5 m", ANGLE, 0, "this is a length"),
        ("90 deg", LENGTH, 0, "this is an angle, where a length is wanted"),
        ("0.5 m * 1 m", LENGTH, 0, "neither an angle nor a length"),
        ("0.5 m + 30 deg", LENGTH, 6, "cannot add a length and an angle"),
        ("sin(0.5 m)", None, 0, "sin takes an angle"),
        ("asin(0.5 m)", None, 0, "asin takes a number"),
        ("atan2(1 m, 1 deg)", ANGLE, 0, "atan2 of a length and an angle"),
        ("90", ANGLE, 0, "write 90 deg or pi/2"),
        ("-90", ANGLE, 0, "write -90 deg or -pi/2"),
        ("31", ANGLE, 0, "write 31 deg or 31 rad"),
        ("sqrt(2)", ANGLE, 0, "write it with deg or rad"),
        ("theta1 + 90", ANGLE, 9, "write 90 deg or pi/2"),
        ("k*(theta1 + 90)", ANGLE, 1, "could be an angle or a factor"),
        ("(theta1 + 90)**2", ANGLE, 13, "could be an angle or a factor"),
    ],
)
def test_units_that_do_not_fit(
    text: str, dimension: Dimension | None, offset: int, words: str
) -> None:
    found = error_of(text, dimension)
    assert found[0] == offset
    assert words in found[1]


def test_bare_sine_argument_without_unit_is_an_error() -> None:
    offset, message = error_of("L1*sin(30)", LENGTH)
    assert (offset, "write 30 deg" in message) == (7, True)


def test_zero_needs_no_unit() -> None:
    assert read("0", ANGLE, SILENT) == 0
    assert read("q1 + 0", ANGLE, SILENT) == q1
    assert read("sin(0)", LENGTH, SILENT) == 0


def test_a_factor_beside_a_symbol_is_clear_in_radians() -> None:
    assert read("k*(theta1 + 2)", ANGLE, RAD_M) == k * (theta1 + 2)
    assert read("L1*(1 + k)", LENGTH, DEG_MM) == L1 * (1 + k)


@pytest.mark.parametrize(
    ("text", "multiple", "difference"),
    [
        ("1.5708", "pi/2 but not equal (3.7e-6); write pi/2 or 90 deg", 3.7e-6),
        ("-1.5708", "-pi/2", 3.7e-6),
        ("3.14", "pi but", 1.6e-3),
        ("theta1 + 0.5236", "pi/6", 1.2e-6),
        ("2.356", "3*pi/4", 2e-4),
    ],
)
def test_decimals_near_a_common_angle(text: str, multiple: str, difference: float) -> None:
    parsed = parse(text, SILENT)
    value, remark = resolve(parsed.quantity, ANGLE, SILENT)
    assert multiple in remark
    assert parsed.quantity.start == text.find(text.split()[-1])
    offset = float(value.subs(theta1, 0))
    nearest = round(offset / (math.pi / 12)) * math.pi / 12
    assert abs(offset - nearest) == pytest.approx(difference, rel=0.05)


@pytest.mark.parametrize("text", ["1.6", "0.01", "0.26", "100.53"])
def test_other_decimals_are_not_taken_for_one(text: str) -> None:
    assert "needs a unit" in error_of(text)[1]


def test_a_decimal_in_degrees_that_looks_like_radians() -> None:
    value, remark = resolve(parse("1.5708", DEG_MM).quantity, ANGLE, DEG_MM)
    assert value == Rational(15708, 10_000) * pi / 180
    assert "read as degrees; did you mean pi/2 or 90 deg?" in remark


def test_parse_quantity() -> None:
    assert parse_quantity("30", DEG_MM, ANGLE) == pi / 6
    assert parse_quantity("0.5 m", DEG_MM, LENGTH) == 500
    assert parse_quantity("30", DEG_MM, None) == 30
    with pytest.raises(TableError, match=r"^--set:1:5: a number is wanted here, and q1 is a name"):
        parse_quantity("2 + q1", DEG_MM, ANGLE)


def test_parse_expression_names_its_place() -> None:
    with pytest.raises(TableError, match=r"^<expression>:1:4: unexpected q2"):
        parse_expression("q1 q2")


def test_bombs_end_at_once() -> None:
    begin = time.process_time()
    for text in ("9**9**9**9", "2**100000000", "(" * 10_000, "sqrt(" * 100, "1e400", "9" * 500):
        with pytest.raises(ExpressionError):
            parse(text, SILENT)
    assert time.process_time() - begin < 0.5


# Trees of arithmetic, written as text and at the same time worked out by Python's own fractions.
_NUMBERS = st.integers(0, 99).map(lambda n: (str(n), Fraction(n)))
_OPERATORS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def _joined(children: st.SearchStrategy) -> st.SearchStrategy:
    def combine(parts: tuple) -> tuple[str, Fraction]:
        (left, x), sign, (right, y) = parts
        sign = "+" if sign == "/" and y == 0 else sign
        return f"({left}){sign}({right})", _OPERATORS[sign](x, y)

    pairs = st.tuples(children, st.sampled_from(sorted(_OPERATORS)), children)
    return pairs.map(combine) | children.map(lambda child: (f"-({child[0]})", -child[1]))


@settings(max_examples=150, deadline=None)
@given(st.recursive(_NUMBERS, _joined, max_leaves=8))
def test_arithmetic_agrees_with_python(tree: tuple[str, Fraction]) -> None:
    text, value = tree
    found = parse_expression(text)
    assert (found.p, found.q) == (value.numerator, value.denominator)


@settings(max_examples=400, deadline=None)
@given(st.text(alphabet="01.5e+-*/^(), °dgmpi q1θ₁sinatan2_²\u200bé", max_size=30))
def test_any_text_is_a_value_or_an_error_inside_it(text: str) -> None:
    try:
        value = read(text, ANGLE, DEG_MM)
    except ExpressionError as problem:
        assert 0 <= problem.offset <= len(text)
        assert problem.message
    else:
        assert not value.has(Float)


def test_functions_of_symbols_stay_exact() -> None:
    text = "atan2(sin(q1), cos(q1)) + asin(k)*tan(theta2)"
    assert parse_expression(text) == atan2(sin(q1), cos(q1)) + asin(k) * tan(theta2)
