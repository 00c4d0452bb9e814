"""What formulas are worth: sympy trees and notation nodes, worked out in mpmath.

Nothing is shared with the package but the types of the trees. Subscripts such as ``1-2`` are read
here once more, from the table's joint variables.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import mpmath
import numpy as np
from sympy import (
    Abs,
    Add,
    Expr,
    Mul,
    Pow,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    pi,
    sin,
    tan,
)

from symdh.notation.nodes import (
    Call,
    Degrees,
    Fraction,
    Generic,
    Juxtaposed,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Operator,
    Pi,
    Power,
    Product,
    Root,
    Rounded,
    Short,
    Sum,
    Unit,
)
from symdh.robot import MotionKind

MP = mpmath.mp.clone()
MP.dps = 50

_SYMPY_FUNCTIONS = {
    cos: MP.cos,
    sin: MP.sin,
    tan: MP.tan,
    acos: MP.acos,
    asin: MP.asin,
    atan: MP.atan,
    atan2: MP.atan2,
    Abs: abs,
}
_NODE_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{kind.__name__: function for kind, function in _SYMPY_FUNCTIONS.items()},
    "abs": abs,
}


def number(text: object) -> Any:
    """Return a number of 50 digits from a text, a fraction or a double."""
    if isinstance(text, str) and "/" in text:
        top, bottom = text.split("/")
        return MP.mpf(top) / MP.mpf(bottom)
    return MP.mpf(text)


def value_of(expression: Expr, point: Mapping[str, Any]) -> Any:
    """Work out an exact expression; `point` has a number for each name."""
    if expression.is_Rational:
        return MP.mpf(expression.p) / expression.q
    if expression is pi:
        return +MP.pi
    if isinstance(expression, Symbol):
        return point[expression.name]
    parts = [value_of(part, point) for part in expression.args]
    if isinstance(expression, Add):
        return MP.fsum(parts)
    if isinstance(expression, Mul):
        return MP.fprod(parts)
    if isinstance(expression, Pow):
        return MP.power(*parts)
    return _SYMPY_FUNCTIONS[type(expression)](*parts)


@dataclass
class Reader:
    """Reads nodes as a person would who knows the numbers.

    Attributes
    ----------
    point : mapping of str to mpf
        Numbers of the table's names.
    joints : mapping of int to str
        The joint variable that each number in a subscript stands for.
    generic : dict of (letter, index, stage) to mpf
        Numbers of the symbols with a running index, and of a recursion.
    letters : function or None
        When given, sines and cosines are what it makes of their text, numbers that lie on no
        circle: two forms then agree only if they are equal by algebra alone.
    """

    point: Mapping[str, Any]
    joints: Mapping[int, str] = field(default_factory=dict)
    generic: dict[tuple[str, str, str], Any] = field(default_factory=dict)
    letters: Callable[[str], Any] | None = None

    def value(self, node: Node) -> Any:
        match node:
            case Number(value=value):
                return MP.mpf(value.p) / value.q
            case Degrees(value=value):
                return MP.mpf(value.p) / value.q * MP.pi / 180
            case Rounded(text=text):
                return MP.mpf(text)
            case Unit():
                return MP.mpf(1)
            case Pi():
                return +MP.pi
            case Name(text=text):
                return self.point[text]
            case Generic(letter=letter, index=index, stage=stage):
                return self.generic[letter, index, stage]
            case Short(function=function, label=label):
                if self.letters is not None:
                    return self.letters(f"{function} {label}")
                return {"c": MP.cos, "s": MP.sin}[function](self.angle(label))
            case Call(function=function, arguments=arguments):
                if self.letters is not None and function in ("cos", "sin"):
                    return self.letters(repr(node))
                return _NODE_FUNCTIONS[function](*(self.value(each) for each in arguments))
            case Power(base=base, exponent=exponent):
                return MP.power(self.value(base), MP.mpf(exponent.p) / exponent.q)
            case Root(radicand=radicand):
                return MP.sqrt(self.value(radicand))
            case Fraction(numerator=top, denominator=bottom):
                return self.value(top) / self.value(bottom)
            case Product(factors=factors):
                return MP.fprod(self.value(each) for each in factors)
            case Negative(node=inner):
                return -self.value(inner)
            case Sum(terms=terms):
                return MP.fsum(self.value(each) for each in terms)
        raise TypeError(f"no number for {type(node).__name__}")

    def matrix(self, matrix: Matrix) -> np.ndarray:
        return np.array([[self.value(x) for x in row] for row in matrix.rows], dtype=object)

    def operators(self, chain: Juxtaposed) -> np.ndarray:
        """Multiply elementary motions out."""
        product = identity()
        for operator in chain.items:
            assert isinstance(operator, Operator)
            product = product @ self.motion(operator)
        return product

    def motion(self, operator: Operator) -> np.ndarray:
        matrix = identity()
        amount, axis = self.value(operator.amount), "XYZ".index(operator.axis.name)
        if operator.kind is MotionKind.TRANSLATION:
            matrix[axis, 3] = amount
            return matrix
        i, j = (axis + 1) % 3, (axis + 2) % 3
        cosine, sine = MP.cos(amount), MP.sin(amount)
        matrix[i, i] = matrix[j, j] = cosine
        matrix[i, j], matrix[j, i] = -sine, sine
        return matrix

    def angle(self, label: str) -> Any:
        return MP.fsum(sign * self.point[self.joints[k]] for k, sign in self.label(label))

    def label(self, label: str) -> list[tuple[int, int]]:
        """Read a subscript: digit by digit below ten joints, with commas from ten on."""
        digits = r"\d+" if any(k > 9 for k in self.joints) else r"\d"
        assert re.fullmatch(rf"{digits}(?:[-,]?{digits})*", label), label
        found = re.findall(rf"([-,]?)({digits})", label)
        return [(int(k), -1 if mark == "-" else 1) for mark, k in found]


def identity() -> np.ndarray:
    return np.array([[MP.mpf(int(r == c)) for c in range(4)] for r in range(4)], dtype=object)
