"""Exact numbers that stay short: a normal form, the question whether one is zero, roots, angles.

Everything stays exact. Where sympy has no decision procedure (constants such as
cos(70 deg) cos(20 deg) - sin(70 deg) sin(20 deg)), two numbers are taken to be equal when they
agree to `DIGITS` digits; with symbols, when they do so at two points. A form is replaced by a
shorter one, 0 in this case, on the same evidence alone.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache
from itertools import islice

from sympy import (
    Add,
    Dummy,
    Expr,
    Float,
    Integer,
    Mul,
    Pow,
    Rational,
    Symbol,
    atan2,
    cancel,
    cos,
    expand,
    factor,
    pi,
    preorder_traversal,
    sin,
    sqrt,
)

from symdh.errors import LimitError
from symdh.robot import in_name_order

DIGITS = 50
_WORKING = DIGITS + 15
_NOTHING = Float(10, _WORKING) ** -DIGITS

#: Shorter forms are looked for among quotients with denominators up to these.
_LARGEST_DENOMINATOR = 10**9
_FINEST_DEGREE = 720

#: Parts of an expression past which it is not multiplied out: no table could hold what follows,
#: and the next expressions would have a hundred times as many.
MAX_PARTS = 1_000
#: Under a root with more parts no square is looked for: factors can take minutes to find.
MAX_FACTORED = 150

_ZERO, _ONE = Integer(0), Integer(1)


def tidy(e: Expr) -> Expr:
    """Return a short form of an exact expression: multiplied out, sin² + cos² = 1 used up.

    Raises
    ------
    LimitError
        When it has more than `MAX_PARTS` parts.
    """
    if e.is_Rational:
        return e
    if _is_over(MAX_PARTS, e):
        raise LimitError(
            f"the exact frames are over the limit of {MAX_PARTS:,} numbers, symbols and operations "
            "in one coordinate; give directions that make rounder numbers, or rounded ones"
        )
    if not e.free_symbols:
        return _tidy_number(e)
    e = expand(e)
    if any(power.exp.is_negative and power.free_symbols for power in e.atoms(Pow)):
        e = _cancelled(e)
    e = expand(e.replace(_is_square_of_sine, _by_cosine))
    found: dict[Expr, Expr] = {}
    for term in Add.make_args(e):
        constant, rest = term.as_independent(*term.free_symbols, as_Add=False)
        found[rest] = found.get(rest, _ZERO) + constant
    return Add(*(tidy(constant) * rest for rest, constant in found.items()))


def _is_over(limit: int, e: Expr) -> bool:
    """Say whether an expression has more than so many numbers, symbols and operations."""
    return next(islice(preorder_traversal(e), limit, None), None) is not None


def _cancelled(e: Expr) -> Expr:
    """Cancel quotients, separately for each product of lengths that they stand before."""
    lengths = e.free_symbols - _symbols_of_angles(e)
    found: dict[Expr, Expr] = {}
    for term in Add.make_args(e):
        quotient, rest = term.as_independent(*lengths, as_Add=False)
        found[rest] = found.get(rest, _ZERO) + quotient
    return expand(Add(*(_shortest_quotient(q) * rest for rest, q in found.items())))


def _shortest_quotient(e: Expr) -> Expr:
    """Return a quotient cancelled as it stands, or with squares of cosines as those of sines."""
    forms = (cancel(e), cancel(e.replace(_is_square_of_cosine, _by_sine)))
    return min(forms, key=lambda form: int(form.count_ops()))


def _symbols_of_angles(e: Expr) -> set[Symbol]:
    return {symbol for function in e.atoms(sin, cos) for symbol in function.free_symbols}


def is_zero(e: Expr) -> bool:
    """Say whether an exact expression is zero; see the remark on top of this module."""
    if e.is_Rational:
        return bool(e == 0)
    return all(abs(value) < _NOTHING for value in samples(e))


def is_positive(e: Expr) -> bool:
    """Say whether an expression is positive where all its symbols are."""
    return bool(e > 0) if e.is_Rational else bool(samples(e)[0] > 0)


def samples(e: Expr) -> list[Float]:
    """Return the values of an expression at fixed points with positive symbols."""
    symbols = in_name_order(e.free_symbols)
    points = [
        {symbol: Rational(k + 7 * number + 13, 29 + 6 * number + k) for number, symbol in indexed}
        for k in ((2, 5) if symbols else (0,))
        for indexed in [tuple(enumerate(symbols))]
    ]
    return [e.xreplace(point).evalf(_WORKING) for point in points]


def root(e: Expr) -> Expr:
    """Return the positive square root, symbols taken as positive: sqrt(a²) is a."""
    if e.is_Rational:
        return sqrt(e)
    if not e.free_symbols:
        return _tidy_number(sqrt(e))
    # With c for cos(beta), 1 - c² is no square, and s² is one: the shorter of both is right.
    forms = (e, expand(e.replace(_is_square_of_cosine, _by_sine)))
    return min((_root_of_positive(form) for form in forms), key=_roots_left)


def angle(sine: Expr, cosine: Expr) -> Expr:
    """Return the angle in (-pi, pi] whose sine and cosine are proportional to these.

    A rational multiple of pi, a rational number of radians, or one of these with angles that are
    symbols in the expressions, where that is what it is; else an arc tangent.
    """
    sine, cosine = _primitive(sine, cosine)
    if sine == 0:
        return _ZERO if is_positive(cosine) else pi
    if cosine == 0:
        return pi / 2 if is_positive(sine) else -pi / 2
    if (sine / cosine).is_Rational:  # no angle but 45 degrees has a rational tangent (Niven)
        return atan2(sine, cosine) if sine.is_Rational else _arc_tangent(sine, cosine)
    guess = _guess_angle(sine, cosine)
    if guess is not None and is_zero(sine * cos(guess) - cosine * sin(guess)):
        return guess
    return atan2(sine, cosine)


def _arc_tangent(sine: Expr, cosine: Expr) -> Expr:
    """Return the angle of a sine and a cosine whose quotient is rational."""
    ratio = abs(sine / cosine)
    first, second = (_ONE if is_positive(e) else -_ONE for e in (sine, cosine))
    return atan2(first * ratio, second)


def common_factor(entries: Iterable[Expr]) -> Expr:
    """Return a positive factor that all entries share; 1 for plain numbers."""
    present = [e for e in entries if e != 0]
    if not present or not any(e.free_symbols for e in present):
        return _ONE
    shared: dict[Expr, Expr] | None = None
    for e in present:
        powers = factor(e).as_powers_dict()
        own = {base: power for base, power in powers.items() if _can_be_shared(base, power)}
        if shared is None:
            shared = own
        else:
            shared = {b: min(p, own[b]) for b, p in shared.items() if b in own}
    found = Mul(*(base**power for base, power in (shared or {}).items()))
    return found if is_positive(found) else -found


def _can_be_shared(base: Expr, power: Expr) -> bool:
    return bool(base.free_symbols) and bool(power.is_Integer) and bool(power > 0)


def _primitive(sine: Expr, cosine: Expr) -> tuple[Expr, Expr]:
    sine, cosine = tidy(sine), tidy(cosine)
    shared = common_factor((sine, cosine))
    if shared == 1:
        return sine, cosine
    return tidy(sine / shared), tidy(cosine / shared)


@lru_cache(maxsize=4096)
def _tidy_number(e: Expr) -> Expr:
    """Return a shorter form of a constant, if there is one that agrees with it."""
    e = expand(e)
    if e.is_Rational:
        return e
    value = e.evalf(_WORKING)
    if abs(value) < _NOTHING:
        return _ZERO
    rational = _near(value, _LARGEST_DENOMINATOR)
    if rational is not None:
        return rational
    square = _near(value**2, _LARGEST_DENOMINATOR)
    if square is not None:
        return sqrt(square) if value > 0 else -sqrt(square)
    if abs(value) < 1:
        turn = _near(_arc_cosine(value) / pi.evalf(_WORKING), _FINEST_DEGREE)
        if turn is not None:
            return cos(turn * pi)
    return e


def _arc_cosine(value: Float) -> Float:
    from sympy import acos

    return acos(value).evalf(_WORKING)


def _near(value: Float, largest: int) -> Rational | None:
    """Return the quotient with a denominator up to `largest` that a number stands for, if any."""
    close = Fraction(*_ratio(value)).limit_denominator(largest)
    found = Rational(close.numerator, close.denominator)
    return found if abs(found.evalf(_WORKING) - value) < _NOTHING * (1 + abs(value)) else None


def _ratio(value: Float) -> tuple[int, int]:
    exact = Rational(value)
    return int(exact.p), int(exact.q)


def _is_square_of_sine(e: Expr) -> bool:
    return isinstance(e, Pow) and isinstance(e.base, sin) and e.exp.is_Integer and e.exp >= 2


def _by_cosine(power: Expr) -> Expr:
    half, odd = divmod(int(power.exp), 2)
    return (1 - cos(power.base.args[0]) ** 2) ** half * power.base**odd


def _is_square_of_cosine(e: Expr) -> bool:
    return isinstance(e, Pow) and isinstance(e.base, cos) and e.exp.is_Integer and e.exp >= 2


def _by_sine(power: Expr) -> Expr:
    half, odd = divmod(int(power.exp), 2)
    return (1 - sin(power.base.args[0]) ** 2) ** half * power.base**odd


def _root_of_positive(e: Expr) -> Expr:
    """Return the root of an expression whose symbols, sines and cosines count as positive."""
    hidden = {atom: Dummy(positive=True) for atom in _atoms(e)}
    plain = e.xreplace(hidden)
    found = sqrt(plain if _is_over(MAX_FACTORED, e) else factor(plain))
    found = found.xreplace({dummy: atom for atom, dummy in hidden.items()})
    return found if is_positive(found) else -found


def _atoms(e: Expr) -> list[Expr]:
    functions = sorted(e.atoms(sin, cos), key=str)
    inside = {symbol for function in functions for symbol in function.free_symbols}
    return [*functions, *in_name_order(e.free_symbols - inside)]


def _roots_left(e: Expr) -> tuple[int, int]:
    left = [power for power in e.atoms(Pow) if power.exp == Rational(1, 2) and power.free_symbols]
    return len(left), int(e.count_ops())


def _guess_angle(sine: Expr, cosine: Expr) -> Expr | None:
    """Guess a sum of angles that are symbols, and a constant, from values at a few points."""
    inside = _symbols_of_angles(sine) | _symbols_of_angles(cosine)
    symbols = in_name_order(sine.free_symbols | cosine.free_symbols)
    start = {symbol: Rational(3 + number, 17 + 4 * number) for number, symbol in enumerate(symbols)}
    first = _value(sine, cosine, start)
    guess: Expr = _ZERO
    for symbol in in_name_order(inside):
        step = Rational(1, 64)
        moved = _value(sine, cosine, {**start, symbol: start[symbol] + step}) - first
        guess += Integer(round(float(moved / step))) * symbol
    rest = first - guess.xreplace(start).evalf(_WORKING)
    turn = _near(rest / pi.evalf(_WORKING), _FINEST_DEGREE)
    constant = turn * pi if turn is not None else _near(rest, _LARGEST_DENOMINATOR)
    if constant is None:
        return None
    if turn is not None:  # one turn more or less is the same angle
        constant -= 2 * pi * round((turn - Rational(1, 1000)) / 2)
    return guess + constant


def _value(sine: Expr, cosine: Expr, point: dict[Symbol, Expr]) -> Float:
    """Return the angle at a point, with the working precision."""
    return atan2(
        sine.xreplace(point).evalf(_WORKING), cosine.xreplace(point).evalf(_WORKING)
    ).evalf(_WORKING)
