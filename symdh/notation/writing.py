"""sympy expression -> nodes in the order and with the signs that a textbook prints.

Factors: numbers, parameters in chain order, trigonometric functions in joint order, brackets.
Terms: brackets and plain products by weight, then those that carry a parameter in chain order; a
positive one in front where there is one.
A minus is pulled out of a bracket whose terms are all negative.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Add, Expr, Integer, Mul, Pow, Rational, Symbol, cos, pi, sin
from sympy.core.function import Function
from sympy.utilities.iterables import sift

from symdh.errors import DerivationError
from symdh.notation.nodes import (
    Call,
    Degrees,
    Fraction,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Pi,
    Power,
    Product,
    Root,
    Short,
    Sum,
)
from symdh.notation.shorthand import JointSum, Shorthand
from symdh.robot import AngleUnit, Robot

_FUNCTIONS = {"sin", "cos", "tan", "asin", "acos", "atan", "atan2", "Abs"}
_LAST = 10**6

Key = tuple[Any, ...]


class Notation:
    """How the expressions of one robot are written.

    Parameters
    ----------
    robot : Robot
    shorthand : Shorthand, optional
        By default that of the robot.
    degrees : bool, optional
        Write constant angles in degrees; by default unless the table counts in radians.
    decimals : bool, optional
        Write 1/2 as 0.5; by default where the table itself holds decimal numbers, so that exact
        cosines such as 1/2 stay fractions in a table of symbols.
    leading : sequence of str, optional
        Symbols whose terms come first, in this order, as what is known of a goal does.
    """

    def __init__(
        self,
        robot: Robot,
        shorthand: Shorthand | None = None,
        *,
        degrees: bool | None = None,
        decimals: bool | None = None,
        leading: Sequence[str] = (),
    ) -> None:
        self.shorthand = shorthand or Shorthand(robot)
        self._place = _chain_places(robot)
        counts_degrees = robot.units.angle is not AngleUnit.RADIAN
        self._degrees = counts_degrees if degrees is None else degrees
        self._decimals = _holds_decimals(robot) if decimals is None else decimals
        self._leading = {name: place for place, name in enumerate(leading)}

    def write(self, expression: Expr) -> Node:
        """Return the node that an exact expression reads as.

        Raises
        ------
        DerivationError
            When the expression holds something that symdh has no notation for.
        """
        negative, node = self._signed(expression)
        return Negative(node) if negative else node

    def matrix(self, matrix: Any) -> Matrix:
        """Return the matrix whose entries are written one by one."""
        rows, columns = matrix.shape
        return Matrix(
            tuple(tuple(self.write(matrix[r, c]) for c in range(columns)) for r in range(rows))
        )

    def sum(self, terms: list[Expr]) -> Node:
        """Write a sum whose terms stay apart, in the order given: a raw row times a column.

        Only a minus in front moves back where there is a positive term to lead.
        """
        written = _positive_first([self.write(term) for term in terms if not term.is_zero])
        if not written:
            return Number(Integer(0))
        return written[0] if len(written) == 1 else Sum(tuple(written))

    def angle(self, expression: Expr) -> Node:
        """Write an angle; its constant part last, in degrees where they are used: ``q + 90 deg``.

        A minus in front moves back where there is a positive term to lead: ``90 deg - q``.
        """
        constant, rest = expression.as_independent(*expression.free_symbols, as_Add=True)
        if not expression.free_symbols:
            constant, rest = expression, Integer(0)
        parts = [] if rest.is_zero else _terms(self.write(rest))
        parts += [] if constant.is_zero else _terms(self._constant_angle(constant))
        if not parts:
            return Number(Integer(0))
        return parts[0] if len(parts) == 1 else Sum(tuple(_positive_first(parts)))

    def _constant_angle(self, constant: Expr) -> Node:
        degrees = constant * 180 / pi
        # A seventh of a turn has no tidy number of degrees; it stays a fraction of pi.
        if not (self._degrees and degrees.is_Rational and is_decimal(degrees)):
            return self.write(constant)
        node = Degrees(abs(degrees))
        return Negative(node) if degrees.is_negative else node

    def _signed(self, e: Expr) -> tuple[bool, Node]:
        """Return a node without an outer minus, and whether it had one."""
        if e.is_Rational:
            return bool(e.is_negative), self._rational(abs(e))
        if e is pi:
            return False, Pi()
        if e.is_Symbol:
            return False, Name(e.name)
        if isinstance(e, Add):
            return self._signed_sum(e)
        if isinstance(e, Mul):
            return self._signed_product(e)
        if isinstance(e, Pow):
            return self._signed_power(e)
        if isinstance(e, (cos, sin)):
            return self._signed_trig(e)
        if isinstance(e, Function) and type(e).__name__ in _FUNCTIONS:
            return False, Call(type(e).__name__.lower(), tuple(self.write(a) for a in e.args))
        raise DerivationError(f"there is no notation for {type(e).__name__} in {e}")

    def _rational(self, value: Rational) -> Node:
        if value.is_Integer or (self._decimals and is_decimal(value)):
            return Number(value)
        return Fraction(Number(Integer(value.p)), Number(Integer(value.q)))

    def _signed_sum(self, e: Expr) -> tuple[bool, Node]:
        signed = [(*self._signed(term), term) for term in Add.make_args(e)]
        signed.sort(key=lambda item: self._term_key(item[1], item[2]))
        negative = all(minus for minus, _, _ in signed)
        terms: list[Node] = [
            Negative(node) if minus != negative else node for minus, node, _ in signed
        ]
        return negative, Sum(tuple(_positive_first(terms)))

    def _signed_product(self, e: Expr) -> tuple[bool, Node]:
        numbers, others = sift(Mul.make_args(e), _is_coefficient, binary=True)
        coefficient = Mul(*numbers)
        negative = bool(coefficient.is_negative)
        over: list[tuple[Key, Node]] = []
        under: list[tuple[Key, Node]] = []
        for factor in others:
            inverted = isinstance(factor, Pow) and factor.exp.is_negative
            minus, node = self._signed(1 / factor if inverted else factor)
            negative ^= minus
            (under if inverted else over).append((self._factor_key(node, factor), node))
        leading = self._coefficient(abs(coefficient))
        rest = [Fraction(_product(over), _product(under))] if under else _in_order(over)
        factors = (*leading, *rest)
        return negative, factors[0] if len(factors) == 1 else Product(factors)

    def _coefficient(self, value: Expr) -> list[Node]:
        """Return a positive constant factor as one small fraction, or as its factors."""
        if value == 1:
            return []
        if value.is_Rational:
            return [self._rational(value)]
        top, bottom = value.as_numer_denom()
        factors = [self.write(f) for f in Mul.make_args(top)]
        if bottom == 1:
            return factors
        whole = factors[0] if len(factors) == 1 else Product(tuple(factors))
        return [Fraction(whole, self.write(bottom))]

    def _signed_power(self, e: Expr) -> tuple[bool, Node]:
        if e.exp.is_negative:
            return False, Fraction(Number(Integer(1)), self.write(1 / e))
        if e.exp == Rational(1, 2):
            return False, Root(self.write(e.base))
        if not e.exp.is_Rational:
            raise DerivationError(f"there is no notation for the power {e}")
        minus, base = self._signed(e.base)
        if minus and e.exp.is_Integer:
            return e.exp.p % 2 == 1, Power(base, e.exp)
        return False, Power(Negative(base) if minus else base, e.exp)

    def _signed_trig(self, e: Expr) -> tuple[bool, Node]:
        name = "c" if isinstance(e, cos) else "s"
        found = self.shorthand.joint_sum(e.args[0])
        if found is None:
            return False, Call(type(e).__name__, (self.angle(e.args[0]),))
        joints, sign = found
        return sign < 0 and name == "s", Short(name, self.shorthand.label(joints))

    def _factor_key(self, node: Node, factor: Expr) -> Key:
        match node:
            case Name(text=text):
                return (1, self._place.get(text, _LAST), text)
            case Root():
                return (3,)
            case Power() if not factor.has(cos, sin):
                names = sorted(self._place.get(s.name, _LAST) for s in factor.free_symbols)
                return (1, names[0] if names else _LAST, "")
            case Short() | Power():
                joints = self._joints(factor)
                return (4, joints.terms if joints else (), 0 if factor.has(cos) else 1)
            case Call():
                names = sorted(self._place.get(s.name, _LAST) for s in factor.free_symbols)
                return (5, tuple(names), str(node))
            case _:
                return (6, -weight(node))

    def _joints(self, factor: Expr) -> JointSum | None:
        for atom in factor.atoms(cos, sin):
            found = self.shorthand.joint_sum(atom.args[0])
            if found:
                return found[0]
        return None

    def _term_key(self, node: Node, term: Expr) -> Key:
        factors = node.factors if isinstance(node, Product) else (node,)
        names = [self._place.get(f.text, _LAST) for f in factors if isinstance(f, Name)]
        shorts = [f for f in factors if isinstance(f, Short)]
        # Sums that an angle-sum identity comes from: c1 c2 - s1 s2, but s1 c2 + c1 s2.
        any_sine = any(f.function == "s" for f in shorts)
        trig = tuple((f.label, f.function == "c") for f in shorts)
        lead = self._lead(term, any(place < _LAST for place in names))
        return (lead, bool(names), min(names, default=0), -weight(node), any_sine, trig, str(node))

    def _lead(self, term: Expr, with_length: bool) -> Key:
        """Return where a term stands by its leading symbols, behind those without a length."""
        places = [self._leading[s.name] for s in term.free_symbols if s.name in self._leading]
        return (0, with_length, min(places)) if places else (1,)


def weight(node: Node) -> int:
    """Return how much there is to read in a node: its leaves."""
    match node:
        case Negative(node=inner):
            return weight(inner)
        case Sum(terms=parts) | Product(factors=parts) | Call(arguments=parts):
            return sum(weight(part) for part in parts)
        case Fraction(numerator=top, denominator=bottom):
            return weight(top) + weight(bottom)
        case Power(base=base) | Root(radicand=base):
            return weight(base) + 1
        case _:
            return 1


def _positive_first(terms: list[Node]) -> list[Node]:
    """Move the first positive term to the front, if there is one; the others keep their order."""
    lead = next((i for i, term in enumerate(terms) if not isinstance(term, Negative)), 0)
    return [*terms[lead : lead + 1], *terms[:lead], *terms[lead + 1 :]]


def _terms(node: Node) -> list[Node]:
    return list(node.terms) if isinstance(node, Sum) else [node]


def is_decimal(value: Rational) -> bool:
    """Say whether a rational has a decimal form that ends, as numbers typed in a table do."""
    rest = int(value.q)
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return rest == 1


def _is_coefficient(factor: Expr) -> bool:
    """Say whether a factor is a plain constant: a rational, a root, pi; no sum and no cosine."""
    if factor.free_symbols:
        return False
    base = factor.base if isinstance(factor, Pow) else factor
    return bool(base.is_Rational or base is pi)


def _holds_decimals(robot: Robot) -> bool:
    lengths = (length for joint in robot.joints for length in (joint.a, joint.d))
    return any(
        not number.is_Integer and is_decimal(number)
        for length in lengths
        for number in length.atoms(Rational)
    )


def _in_order(keyed: list[tuple[Key, Node]]) -> list[Node]:
    return [node for _, node in sorted(keyed, key=lambda pair: pair[0])]


def _product(keyed: list[tuple[Key, Node]]) -> Node:
    if not keyed:
        return Number(Integer(1))
    nodes = _in_order(keyed)
    return nodes[0] if len(nodes) == 1 else Product(tuple(nodes))


def _chain_places(robot: Robot) -> dict[str, int]:
    """Number the symbols in the order in which the chain meets them, a before d in one row."""
    places: dict[str, int] = {}

    def meet(expression: Expr) -> None:
        symbols: list[Symbol] = sorted(expression.free_symbols, key=lambda s: s.name)
        for symbol in symbols:
            places.setdefault(symbol.name, len(places))

    for motion in robot.base:
        meet(motion.amount)
    for joint in robot.joints:
        for expression in (joint.a, joint.d, joint.theta, joint.alpha):
            meet(expression)
    for motion in robot.tool:
        meet(motion.amount)
    return places
