"""Nodes -> pieces of text in one output alphabet, each with its width and whether a line may break.

A writer subclasses `MathWriter` with its alphabet (LaTeX, Unicode, plain ASCII). What is shared is
the grammar: signs, brackets by height, and where a sum may be broken.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from symdh.notation.nodes import (
    Call,
    Cross,
    Degrees,
    Dot,
    Equation,
    Fraction,
    Generic,
    Juxtaposed,
    Listed,
    Matrix,
    Name,
    Negative,
    Node,
    Number,
    Operator,
    Pi,
    PoseName,
    Power,
    Product,
    Root,
    Rounded,
    Screw,
    Short,
    Sum,
    Transposed,
    Tuple,
    Unit,
    Words,
)


@dataclass(frozen=True, slots=True)
class Piece:
    """A stretch of output that is never broken.

    Attributes
    ----------
    text : str
    width : float
        In the writer's unit: points, or columns of a terminal.
    depth : int or None
        When a line may break before this piece: how many brackets enclose the place.
    """

    text: str
    width: float
    depth: int | None = None


Pieces = list[Piece]


class MathWriter(ABC):
    """Writes nodes as pieces; subclasses supply the alphabet."""

    def text(self, node: Node) -> str:
        """Return a node as one string."""
        return joined(self.pieces(node))

    def width(self, node: Node) -> float:
        """Return the width of a node written on one line."""
        return total_width(self.pieces(node))

    def pieces(self, node: Node) -> Pieces:
        """Return a node as pieces."""
        match node:
            case Sum(terms=terms):
                return self._sum(terms)
            case Product(factors=factors):
                return self._product(factors)
            case Negative(node=inner):
                return [self.sign(), *self._guarded(inner, Sum)]
            case Fraction(numerator=top, denominator=bottom):
                return self.fraction(top, bottom)
            case Power(base=base, exponent=exponent):
                guarded = self._guarded(base, Sum, Product, Negative, Fraction, Power, Call)
                return self.power(guarded, str(exponent), base)
            case Root(radicand=radicand):
                return self.root(self.pieces(radicand))
            case Call(function=function, arguments=arguments):
                return self.call(function, arguments)
            case Juxtaposed(items=items):
                return self.separated(items, replace(self.beside(), depth=0))
            case Equation(sides=sides):
                return self.separated(sides, self.equals())
            case Tuple(items=items):
                opening, closing = self.brackets(0)
                return [opening, *self.separated(items, self.comma()), closing]
            case Listed(items=items):
                return self.separated(items, self.gap())
            case Dot(left=left, right=right):
                return self.separated((left, right), self.dot())
            case Cross(left=left, right=right):
                return [*self._guarded(left, Sum), self.cross(), *self._guarded(right, Sum)]
            case Transposed(matrix=matrix):
                return [*self.pieces(matrix), self.transpose()]
            case _:
                return self.leaf(node)

    def leaf(self, node: Node) -> Pieces:
        """Return a node that holds no other node."""
        match node:
            case Number() | Rounded() | Degrees() | Unit() | Pi():
                return [self.quantity(node)]
            case Words(text=text):
                return [self.words(text)]
            case Name() | Generic() | Short():
                return [self.symbol(node)]
            case PoseName() | Screw():
                return [self.transform(node)]
            case Operator():
                return self.operator(node)
            case Matrix():
                return self.matrix(node)
            case _:
                raise TypeError(f"no way to write {type(node).__name__}")

    def separated(self, items: Iterable[Node], between: Piece) -> Pieces:
        """Return items with a piece between neighbours."""
        pieces: Pieces = []
        for item in items:
            if pieces:
                pieces.append(between)
            pieces += self.pieces(item)
        return pieces

    def bracketed(self, node: Node) -> Pieces:
        """Return a node in brackets whose shape tells their height; breaks inside lie deeper."""
        opening, closing = self.brackets(height(node))
        inner = [p if p.depth is None else replace(p, depth=p.depth + 1) for p in self.pieces(node)]
        return [opening, *inner, closing]

    def _sum(self, terms: Sequence[Node]) -> Pieces:
        pieces: Pieces = []
        for term in terms:
            negative = isinstance(term, Negative)
            inner = term.node if isinstance(term, Negative) else term
            if pieces:
                pieces.append(replace(self.plus_minus(negative), depth=0))
            elif negative:
                pieces.append(self.sign())
            pieces += self._guarded(inner, Sum)
        return pieces

    def _product(self, factors: Sequence[Node]) -> Pieces:
        pieces: Pieces = []
        for position, factor in enumerate(factors):
            if position:
                pieces += self.times(factors[position - 1], factor)
            pieces += self._guarded(factor, Sum, Negative)
        return pieces

    def _guarded(self, node: Node, *kinds: type) -> Pieces:
        return self.bracketed(node) if isinstance(node, kinds) else self.pieces(node)

    @abstractmethod
    def words(self, text: str) -> Piece:
        """Return running text in a formula."""

    @abstractmethod
    def quantity(self, node: Number | Rounded | Degrees | Unit | Pi) -> Piece:
        """Return a number, an angle in degrees, a unit or pi."""

    @abstractmethod
    def symbol(self, node: Name | Generic | Short) -> Piece:
        """Return a symbol."""

    @abstractmethod
    def transform(self, node: PoseName | Screw) -> Piece:
        """Return the name of a transform."""

    @abstractmethod
    def operator(self, node: Operator) -> Pieces:
        """Return an elementary motion as an operator."""

    @abstractmethod
    def matrix(self, node: Matrix) -> Pieces:
        """Return a matrix."""

    @abstractmethod
    def fraction(self, top: Node, bottom: Node) -> Pieces:
        """Return a quotient."""

    @abstractmethod
    def power(self, base: Pieces, exponent: str, node: Node) -> Pieces:
        """Return a power whose base is already guarded by brackets where it needs them."""

    @abstractmethod
    def root(self, radicand: Pieces) -> Pieces:
        """Return a square root."""

    @abstractmethod
    def call(self, function: str, arguments: Sequence[Node]) -> Pieces:
        """Return a function with its arguments."""

    @abstractmethod
    def times(self, left: Node, right: Node) -> Pieces:
        """Return what stands between two factors."""

    @abstractmethod
    def brackets(self, height: int) -> tuple[Piece, Piece]:
        """Return the opening and closing bracket around a node of this height."""

    @abstractmethod
    def plus_minus(self, negative: bool) -> Piece:
        """Return a binary sign with its spaces."""

    @abstractmethod
    def sign(self) -> Piece:
        """Return a leading minus."""

    @abstractmethod
    def equals(self) -> Piece:
        """Return an equality sign with its spaces."""

    @abstractmethod
    def comma(self) -> Piece:
        """Return a comma between numbers."""

    @abstractmethod
    def gap(self) -> Piece:
        """Return a comma and a wide space between formulas."""

    @abstractmethod
    def dot(self) -> Piece:
        """Return the sign of a scalar product."""

    @abstractmethod
    def cross(self) -> Piece:
        """Return the sign of a vector product."""

    @abstractmethod
    def transpose(self) -> Piece:
        """Return the mark of a transposed matrix."""

    @abstractmethod
    def beside(self) -> Piece:
        """Return the space between transforms that are multiplied."""


def height(node: Node) -> int:
    """Return how many pairs of brackets are nested inside a node."""
    match node:
        case Sum(terms=terms):
            return max(height(t) for t in terms)
        case Product(factors=factors):
            return max(height(f) + isinstance(f, Sum) for f in factors)
        case Negative(node=inner):
            return height(inner) + isinstance(inner, Sum)
        case Fraction(numerator=top, denominator=bottom):
            return max(height(top), height(bottom))
        case Power(base=base):
            return height(base) + isinstance(base, Sum)
        case Call(arguments=arguments):
            return 1 + max(height(a) for a in arguments)
        case _:
            return 0


def joined(pieces: Iterable[Piece]) -> str:
    """Return the text of pieces on one line."""
    return "".join(piece.text for piece in pieces)


def total_width(pieces: Iterable[Piece]) -> float:
    """Return the width of pieces on one line."""
    return sum(piece.width for piece in pieces)
