"""Numbers as text: exact decimals, and figures rounded for people."""

from __future__ import annotations

from sympy import Rational


def decimal(number: Rational) -> str:
    """Return an exact rational as a decimal where that is exact, else as a quotient ``p/q``."""
    twos, rest = _power_of(2, int(number.q))
    fives, rest = _power_of(5, rest)
    if rest != 1:
        return f"{number.p}/{number.q}"
    places = max(twos, fives)
    digits = str(abs(int(number * 10**places))).rjust(places + 1, "0")
    sign = "-" if number.is_negative else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def figures(value: float, decimals: int = 4, significant: int = 5) -> str:
    """Round a number for people: at most `decimals` places and `significant` figures.

    0.67063 reads 0.6706, 13.88949 reads 13.889; trailing zeros and a zero's sign are dropped.
    """
    if value == 0:
        return "0"
    if abs(value) < 0.5 * 10**-decimals or abs(value) >= 10 ** (significant + 2):
        return _scientific(value, significant)
    whole = len(str(int(abs(value)))) if abs(value) >= 1 else 0
    places = max(0, min(decimals, significant - whole))
    text = f"{value:.{places}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _scientific(value: float, significant: int) -> str:
    mantissa, _, exponent = f"{value:.{significant - 1}e}".partition("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def _power_of(prime: int, number: int) -> tuple[int, int]:
    count = 0
    while number % prime == 0:
        number, count = number // prime, count + 1
    return count, number
