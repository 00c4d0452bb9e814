"""Mathematics as it is to be read: ordered, signs pulled out, free of any output format.

A renderer turns these nodes into LaTeX, HTML or terminal text; nothing here knows which.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from sympy import Rational

from symdh.robot import Axis, MotionKind


@dataclass(frozen=True, slots=True)
class Number:
    """A number that is not negative; `value` is exact."""

    value: Rational


@dataclass(frozen=True, slots=True)
class Rounded:
    """A rounded number as text, with its sign: ``-0.2588``."""

    text: str


@dataclass(frozen=True, slots=True)
class Degrees:
    """An angle in degrees; not negative."""

    value: Rational


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measure after a number."""

    text: str


@dataclass(frozen=True, slots=True)
class Words:
    """Running text where a formula is expected, as in a cell of a table."""

    text: str


@dataclass(frozen=True, slots=True)
class Pi:
    """The number pi."""


@dataclass(frozen=True, slots=True)
class Name:
    """A symbol of the table, by its canonical name.

    `starred` marks a joint variable in a table, `dotted` the rate of one.
    """

    text: str
    starred: bool = False
    dotted: bool = False


@dataclass(frozen=True, slots=True)
class Generic:
    """A symbol of a general formula: a letter with a running index (alpha_{i-1}, r_{31}, p_x).

    `stage` is a superscript in brackets that tells the steps of a recursion apart; `hat` marks
    the direction of an axis, `dotted` a rate.
    """

    letter: str
    index: str = ""
    stage: str = ""
    hat: bool = False
    dotted: bool = False


@dataclass(frozen=True, slots=True)
class Short:
    """``c_{12}`` or ``s_{1-2}``: cosine or sine of a sum of joint variables.

    `label` holds the joint numbers as they are to be read.
    """

    function: str
    label: str


@dataclass(frozen=True, slots=True)
class Call:
    """A function written with its argument: ``cos(alpha_1)``."""

    function: str
    arguments: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Power:
    """A base raised to a positive rational exponent."""

    base: Node
    exponent: Rational


@dataclass(frozen=True, slots=True)
class Root:
    """A square root."""

    radicand: Node


@dataclass(frozen=True, slots=True)
class Fraction:
    """A quotient."""

    numerator: Node
    denominator: Node


@dataclass(frozen=True, slots=True)
class Product:
    """Factors in reading order."""

    factors: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Negative:
    """A node with a minus sign before it."""

    node: Node


@dataclass(frozen=True, slots=True)
class Sum:
    """Terms in reading order; a `Negative` term is subtracted."""

    terms: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Matrix:
    """A matrix by rows."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True, slots=True)
class PoseName:
    """The name of a transform between two frames: 0T3, written Craig's way or with T_3."""

    start: str
    end: str
    craig: bool


@dataclass(frozen=True, slots=True)
class Operator:
    """An elementary motion as an operator: ``R_x(alpha)``, ``D_z(d)``, ``Rot(z, theta)``."""

    kind: MotionKind
    axis: Axis
    amount: Node
    craig: bool


@dataclass(frozen=True, slots=True)
class Screw:
    """Rotation about and translation along one axis together: ``Screw_z``."""

    axis: Axis


@dataclass(frozen=True, slots=True)
class Juxtaposed:
    """Transforms written side by side: their product."""

    items: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Equation:
    """Sides joined by equality signs."""

    sides: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Dot:
    """The scalar product of two directions."""

    left: Node
    right: Node


@dataclass(frozen=True, slots=True)
class Cross:
    """The vector product of two vectors."""

    left: Node
    right: Node


@dataclass(frozen=True, slots=True)
class Transposed:
    """The transpose of a matrix that has a name."""

    matrix: Node


@dataclass(frozen=True, slots=True)
class Tuple:
    """Numbers that belong together: ``(r_{11}, r_{21})``."""

    items: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Listed:
    """Formulas beside each other, with commas between."""

    items: tuple[Node, ...]


Node = (
    Number
    | Rounded
    | Degrees
    | Unit
    | Words
    | Pi
    | Name
    | Generic
    | Short
    | Call
    | Power
    | Root
    | Fraction
    | Product
    | Negative
    | Sum
    | Matrix
    | PoseName
    | Operator
    | Screw
    | Juxtaposed
    | Equation
    | Dot
    | Cross
    | Transposed
    | Tuple
    | Listed
)


def mapped(node: Node, change: Callable[[Node], Node]) -> Node:
    """Return a node with `change` applied to each of its leaves."""

    def each(nodes: tuple[Node, ...]) -> tuple[Node, ...]:
        return tuple(mapped(part, change) for part in nodes)

    match node:
        case Sum(terms=terms):
            return Sum(each(terms))
        case Product(factors=factors):
            return Product(each(factors))
        case Negative(node=inner):
            return Negative(mapped(inner, change))
        case Fraction(numerator=top, denominator=bottom):
            return Fraction(mapped(top, change), mapped(bottom, change))
        case Power(base=base, exponent=exponent):
            return Power(mapped(base, change), exponent)
        case Root(radicand=radicand):
            return Root(mapped(radicand, change))
        case Call(function=function, arguments=arguments):
            return Call(function, each(arguments))
        case Matrix(rows=rows):
            return Matrix(tuple(each(row) for row in rows))
        case Operator(kind=kind, axis=axis, amount=amount, craig=craig):
            return Operator(kind, axis, mapped(amount, change), craig)
        case Juxtaposed(items=items):
            return Juxtaposed(each(items))
        case Equation(sides=sides):
            return Equation(each(sides))
        case Dot(left=left, right=right):
            return Dot(mapped(left, change), mapped(right, change))
        case Cross(left=left, right=right):
            return Cross(mapped(left, change), mapped(right, change))
        case Transposed(matrix=matrix):
            return Transposed(mapped(matrix, change))
        case Tuple(items=items):
            return Tuple(each(items))
        case Listed(items=items):
            return Listed(each(items))
        case _:
            return change(node)


def leaves(node: Node) -> tuple[Node, ...]:
    """Return the leaves of a node in reading order."""
    found: list[Node] = []

    def note(leaf: Node) -> Node:
        found.append(leaf)
        return leaf

    mapped(node, note)
    return tuple(found)
