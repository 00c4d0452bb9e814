"""The grammar of expressions, read by precedence climbing (Pratt 1973) into exact quantities.

The grammar, from loose to tight: sums, products, signs, powers (to the right), units. So
``-L1**2/2`` is ``-(L1**2)/2``, and ``2*45 deg`` is ``2*(45 deg)``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NoReturn

from sympy import Rational, Symbol, pi

from symdh.robot import Units
from symdh.table import quantity as algebra
from symdh.table.budget import OF_NUMBERS, Budget
from symdh.table.extent import extent
from symdh.table.functions import apply
from symdh.table.lexer import MAX_EXPRESSION, ExpressionError, Token, TokenKind, tokenize
from symdh.table.names import CONSTANT, FUNCTION_NAMES, canonical_name, why_reserved
from symdh.table.quantity import Quantity
from symdh.table.suggest import did_you_mean
from symdh.table.units import LENGTH_UNITS, UNIT_ALIASES, UNIT_NAMES

MAX_NESTING = 32
MAX_DIGITS = 40
MAX_DECIMAL_EXPONENT = 30

_SUM, _PRODUCT, _SIGN, _POWER = 10, 20, 25, 40
_BINARY = {"+": _SUM, "-": _SUM, "*": _PRODUCT, "/": _PRODUCT, "**": _POWER, "^": _POWER}
_NOT_A_NUMBER = re.compile(r"\s*[-+]?\.?(?:inf|infinity|nan)\s*", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Remark:
    """A warning about the character at `offset` of an expression."""

    offset: int
    message: str


@dataclass(frozen=True, slots=True)
class ParsedExpression:
    """An expression whose bare numbers still wait for what is measured there.

    Attributes
    ----------
    quantity : Quantity
    names : mapping of Symbol to int
        The symbols with the offset at which each stands first.
    remarks : tuple of Remark
    has_length_unit : bool
        Whether some number in it carries a unit of length.
    """

    quantity: Quantity
    names: Mapping[Symbol, int]
    remarks: tuple[Remark, ...]
    has_length_unit: bool


def parse(
    text: str, units: Units, longest: int = MAX_EXPRESSION, budget: Budget | None = None
) -> ParsedExpression:
    """Read an expression.

    Parameters
    ----------
    text : str
    units : Units
        What a bare angle inside ``sin``, ``cos``, ``tan`` means, and the unit that lengths are
        converted to; metre when there is none.
    longest : int
        How many characters it may have.
    budget : Budget, optional
        What is left for this and other expressions; by default this one has it alone.

    Raises
    ------
    ExpressionError
        At the first place where the text is not an expression.
    """
    if _NOT_A_NUMBER.fullmatch(text):
        raise ExpressionError(0, f"{text.strip()} is reserved and not a number")
    try:
        return _Parser(text, units, longest, budget or Budget()).parse()
    except ValueError:  # sympy 1.14 fails to factor some products of two large primes
        message = "a root here cannot be taken exactly: the factors of the number are too large"
        raise ExpressionError(0, message) from None


@dataclass(slots=True)
class _Parser:
    """One pass over the tokens of one expression."""

    text: str
    units: Units
    longest: int
    budget: Budget
    tokens: list[Token] = field(init=False)
    index: int = 0
    depth: int = 0
    names: dict[Symbol, int] = field(default_factory=dict)
    remarks: list[Remark] = field(default_factory=list)
    has_length_unit: bool = False

    def __post_init__(self) -> None:
        self.tokens = tokenize(self.text, self.longest)
        self.budget.spend(len(self.tokens), 0)

    def peek(self) -> Token:
        return self.tokens[self.index]

    def take(self) -> Token:
        token = self.peek()
        self.index += 1
        return token

    def at(self, *texts: str) -> bool:
        return self.peek().text in texts

    def parse(self) -> ParsedExpression:
        if self.peek().kind is TokenKind.END:
            raise ExpressionError(0, "expression is empty; write 0 for zero")
        value = self.expression(0)
        if self.peek().kind is not TokenKind.END:
            self.refuse(self.peek())
        # Powers of powers stand for no more than an expression without powers can hold.
        most = self.longest // 2
        if extent(value.total, lambda leaf: int(leaf.is_Symbol)) > most:
            message = f"written out without its powers, this has over {most} symbols"
            raise ExpressionError(0, message)
        return ParsedExpression(value, self.names, tuple(self.remarks), self.has_length_unit)

    def expression(self, binding: int) -> Quantity:
        """Read what binds tighter than `binding`."""
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise ExpressionError(self.peek().offset, f"nested deeper than {MAX_NESTING}")
        start = self.peek().offset
        value = self.operand()
        while _BINARY.get(self.peek().text, 0) > binding:
            value = self.binary(value, start)
        self.depth -= 1
        return value

    def binary(self, left: Quantity, start: int) -> Quantity:
        """Read an operator and its right side; the left side starts at `start`."""
        operator = self.take()
        if operator.text in ("**", "^"):
            # A sign may stand in an exponent, and powers group to the right: 2**-1, 2**3**2.
            exponent = self.expression(_SIGN)
            if not exponent.total.is_integer:
                self.spend_on([left], operator.offset)
            return algebra.power(left, exponent, operator.offset)
        right_token = self.peek()
        right = self.expression(_BINARY[operator.text])
        if operator.text == "/":
            self.refuse_unit_of_divisor(right_token, start)
            return algebra.divide(left, right, operator.offset)
        if operator.text == "*":
            return algebra.multiply(left, right, operator.offset)
        if operator.text == "-":
            right = algebra.negate(right, right.start)
        return algebra.add(left, right, operator.offset)

    def refuse_unit_of_divisor(self, divisor: Token, start: int) -> None:
        """Refuse ``1/2 deg``, which reads as ``(1/2) deg`` and as ``1/(2 deg)``."""
        last = self.tokens[self.index - 1]
        if last.text not in UNIT_NAMES or last is divisor:
            return
        dividend = self.text[start : divisor.offset].strip()
        number = self.text[divisor.offset : last.offset].strip()
        raise ExpressionError(
            start,
            f"ambiguous: write ({dividend}{number}) {last.text} "
            f"or {dividend}({number} {last.text})",
        )

    def operand(self) -> Quantity:
        """Read a number, a name, a call, a bracket or a sign, and the unit behind it."""
        token = self.take()
        if token.text in ("-", "+"):
            value = self.expression(_SIGN)
            return algebra.negate(value, token.offset) if token.text == "-" else value
        if token.kind is TokenKind.NUMBER:
            value = Quantity(bare=_number(token), start=token.offset)
        elif token.kind is TokenKind.NAME:
            value = self.name(token)
        elif token.text == "(":
            value = self.bracket()
        elif token.kind is TokenKind.END:
            raise ExpressionError(token.offset, "expression ends early; something is missing here")
        else:
            self.refuse(token)
        return self.unit(value, token.offset)

    def unit(self, value: Quantity, start: int) -> Quantity:
        """Read the unit behind an operand that starts at `start`, if there is one."""
        if self.peek().text not in UNIT_NAMES:
            return value
        unit = self.take().text
        self.has_length_unit |= unit in LENGTH_UNITS
        return algebra.with_unit(value, unit, self.units, start)

    def bracket(self) -> Quantity:
        value = self.expression(0)
        self.close()
        return value

    def close(self) -> None:
        if self.at(")"):
            self.take()
        elif self.peek().kind is TokenKind.END:
            raise ExpressionError(self.peek().offset, "missing )")
        else:
            self.refuse(self.peek())

    def name(self, token: Token) -> Quantity:
        name = canonical_name(token.text)
        if self.at("("):
            return self.call(name, token)
        if name == CONSTANT:
            return Quantity(rest=pi, start=token.offset)
        reason = why_reserved(name)
        if reason is not None:
            raise ExpressionError(token.offset, reason)
        symbol = Symbol(name, real=True)
        self.names.setdefault(symbol, token.offset)
        return Quantity(rest=symbol, start=token.offset)

    def call(self, name: str, token: Token) -> Quantity:
        if name not in FUNCTION_NAMES:
            hint = did_you_mean(name, FUNCTION_NAMES, _FUNCTION_ALIASES)
            if not hint:
                hint = f"; write {token.text}*(...) for a product"
            raise ExpressionError(token.offset, f"{token.text} is not a known function{hint}")
        self.take()
        arguments = [self.expression(0)]
        while self.at(","):
            self.take()
            arguments.append(self.expression(0))
        self.close()
        self.spend_on(arguments, token.offset)
        value, remark = apply(name, arguments, self.units, token.offset)
        if remark:
            self.remarks.append(Remark(arguments[0].start, remark))
        return value

    def spend_on(self, operands: list[Quantity], offset: int) -> None:
        """Count what a function or a root costs beyond its signs."""
        if not any(each.total.free_symbols for each in operands):
            self.budget.spend(OF_NUMBERS, offset)

    def refuse(self, token: Token) -> NoReturn:
        """Raise the error for a token that cannot stand where it does."""
        raise ExpressionError(token.offset, self.why_unexpected(token))

    def why_unexpected(self, token: Token) -> str:
        if token.text == ",":
            return "unexpected , (the decimal point is .)"
        before = self.tokens[self.index - 1] if token is self.peek() else None
        if before is None or token.text == ")" or token.text.startswith("."):
            return f"unexpected {token.text}"
        if before.kind is TokenKind.NUMBER and token.kind is TokenKind.NAME:
            return _why_no_unit(token.text)
        return f"unexpected {token.text}; write * for a product"


def _why_no_unit(word: str) -> str:
    """Say what is wrong with a word that follows a number and is no unit."""
    hint = did_you_mean(word, UNIT_NAMES, UNIT_ALIASES)
    # One or two letters are like some unit by chance; they rather are a symbol.
    if hint and word.isalpha() and len(word) > 2:
        return f"unknown unit {word}{hint}"
    return f"unexpected {word}; write * for a product (units: {', '.join(UNIT_NAMES)})"


_FUNCTION_ALIASES = {
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
    "arctan2": "atan2",
    "tg": "tan",
    "sen": "sin",
    "root": "sqrt",
    "c": "cos",
    "s": "sin",
}


def _number(token: Token) -> Rational:
    """Return the exact value of a decimal: ``0.4318`` is 2159/5000."""
    if len(token.text) > MAX_DIGITS:
        message = f"number has {len(token.text)} characters, over {MAX_DIGITS}"
        raise ExpressionError(token.offset, message)
    exponent = token.text.lower().partition("e")[2]
    if exponent and abs(int(exponent)) > MAX_DECIMAL_EXPONENT:
        raise ExpressionError(token.offset, f"decimal exponent over {MAX_DECIMAL_EXPONENT}")
    return Rational(token.text)
