"""Singularities: where the Jacobian of an arm loses rank, as factors that can be read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from math import comb

from sympy import Expr, Integer, Mul, Rational, Symbol, cos, sin

from symdh.errors import DerivationError, LimitError, UnsupportedError
from symdh.kinematics.frame import Frame, checked, last_frame
from symdh.kinematics.singular.conditions import alternatives
from symdh.kinematics.singular.determinant import factored_determinant
from symdh.kinematics.singular.factors import HalfAngles, Pieces
from symdh.kinematics.singular.naming import Meaning, Meanings
from symdh.kinematics.singular.screws import ScrewMatrix, moving_joints, sparsest
from symdh.kinematics.singular.short_form import parallel_runs, short_form
from symdh.kinematics.singular.solving import joint_angles, zeros
from symdh.kinematics.singular.trig_ring import Element, TooLargeError, TrigRing
from symdh.kinematics.velocity import ORIGIN
from symdh.robot import Robot

#: Joints past which an arm is not looked at: its minors would be far too many.
MAX_JOINTS = 8

#: Terms in all entries of a Jacobian past which its determinant is not worked out.
MAX_ENTRIES = 400

#: Minors past which a Jacobian that is not square is not taken apart.
MAX_MINORS = 60

#: Terms of a remaining condition, in half angles, past which none is written out.
MAX_SHOWN = 60


@dataclass(frozen=True, slots=True)
class Factor:
    """A factor whose zeros are singular.

    Attributes
    ----------
    expression : sympy.Expr
    power : int
        How often it divides the determinant.
    variables : tuple of Symbol
        The joint variables that it depends on, in chain order.
    zeros : tuple of Expr
        The values of the only variable at which it vanishes, angles in radians and up to whole
        turns; empty where the factor stays a condition.
    meaning : Meaning or None
        Its name, where the structure of the arm gives one.
    """

    expression: Expr
    power: int
    variables: tuple[Symbol, ...]
    zeros: tuple[Expr, ...]
    meaning: Meaning | None


@dataclass(frozen=True)
class Singularities:
    """Where an arm loses a direction of motion.

    Attributes
    ----------
    robot : Robot
    of : Frame
        The frame that moves.
    joints : tuple of int
        Rows of the joints that move it: the columns of the matrix.
    rows : tuple of int
        Rows of the Jacobian that are looked at, 0 .. 5 for v_x v_y v_z omega_x omega_y omega_z;
        the others are left out as the notes on `singularities` say.
    frame : int
        The frame whose axes the rows are along.
    point : Frame or None
        The frame whose origin the velocity is of; None for the point that was asked for.
    rank : int
        The rank at almost all poses.
    constant : Expr
        What stands before the factors: a number and lengths.
    factors : tuple of Factor or None
        None where the polynomials are over the stated limit.
    remaining : tuple of tuple of Expr
        Where the factors do not tell all: the rank drops also where all expressions of one of
        these vanish together.
    is_complete : bool
        Whether factors and `remaining` tell all. False where there is more, too long to write.
    """

    robot: Robot
    of: Frame
    joints: tuple[int, ...]
    rows: tuple[int, ...]
    frame: int
    point: Frame | None
    rank: int
    constant: Expr
    factors: tuple[Factor, ...] | None
    remaining: tuple[tuple[Expr, ...], ...]
    is_complete: bool = False

    @property
    def is_square(self) -> bool:
        """Whether the factors multiply to a determinant, not to a common divisor of minors."""
        return self.rank == len(self.rows) == len(self.joints)

    @property
    def product(self) -> Expr:
        """The determinant, or the greatest common divisor of the minors, as a product.

        Raises
        ------
        UnsupportedError
            When there are no factors.
        """
        if self.factors is None:
            raise UnsupportedError(f"the determinant of {self.robot.name} is over the limit")
        return Mul(self.constant, *(f.expression**f.power for f in self.factors))


def singularities(
    robot: Robot, of: Frame | None = None, at: Sequence[Expr] | None = None
) -> Singularities:
    """Find where the Jacobian of a frame loses rank.

    Parameters
    ----------
    robot : Robot
    of : Frame, optional
        The frame that moves; by default the last.
    at : three Expr, optional
        A point in it; by default its origin. It matters only where positions alone are looked at.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame, or no joint moves it.
    LimitError
        When more than `MAX_JOINTS` joints move it.

    Notes
    -----
    Up to three joints that can reach as many directions of v are looked at for the position of the
    point alone: rows v. All others for position and orientation: rows that vanish identically in
    the frame chosen are left out. Square: the determinant. Else: the greatest common divisor of
    the minors of the rank that the matrix has at almost all poses.
    """
    end = last_frame(robot) if of is None else checked(robot, of)
    joints = moving_joints(robot, end)
    if not joints:
        raise UnsupportedError(f"no joint of {robot.name} moves frame {end}")
    if len(joints) > MAX_JOINTS:
        raise LimitError(
            f"frame {end} of {robot.name} is moved by {len(joints)} joints, and singularities are "
            f"looked for with at most {MAX_JOINTS}; --of chooses a frame nearer to the base"
        )
    search = _Search(robot, end, joints, at)
    matrix, rows = search.matrix()
    rank = search.rank(matrix, rows)
    base = Singularities(
        *(robot, end, tuple(joints), rows, matrix.frame, matrix.point, rank),
        *(Integer(1), None, ()),
    )
    try:
        return search.factored(base, matrix)
    except TooLargeError:
        return base


class _Search:
    """The rings of one robot and what is computed in them."""

    def __init__(
        self, robot: Robot, of: Frame, joints: list[int], at: Sequence[Expr] | None
    ) -> None:
        self._robot = robot
        self._of = of
        self._point = ORIGIN if at is None else at
        self._joints = joints
        self._ring = TrigRing(robot, self._point)
        self._half_angles = HalfAngles(self._ring)
        self._runs = parallel_runs(self._ring, robot)
        self._meanings = Meanings(self._half_angles, robot, joints)

    def matrix(self) -> tuple[ScrewMatrix, tuple[int, ...]]:
        """Return the Jacobian and the rows of it that say what the arm is singular for."""
        if len(self._joints) <= 3:
            own = sparsest(self._ring, self._robot, self._of, self._point)
            rows = _rows(own, range(3))
            if rows and self.rank(own, rows) == len(self._joints):
                return own, rows
        free = sparsest(self._ring, self._robot, self._of, None)
        return free, _rows(free, range(6))

    def rank(self, matrix: ScrewMatrix, rows: Sequence[int]) -> int:
        """Return the rank at a generic pose, exactly, by rational numbers put in."""
        point = self._ring.generic_point()
        numbers = [[self._ring.value(column[r], point) for column in matrix.columns] for r in rows]
        return _rank(numbers)

    def factored(self, base: Singularities, matrix: ScrewMatrix) -> Singularities:
        """Return the result with its factors."""
        if sum(len(entry) for column in matrix.columns for entry in column) > MAX_ENTRIES:
            raise TooLargeError
        minors = self._minors(base, matrix)
        if base.is_square:
            (minor,) = minors
            common = self._half_angles.pieces(minor)
            factors = self._half_angles.factors(common)
            constant = self._constant(minor, factors)
            return self._read(base, constant, factors, [])
        pieces = [self._half_angles.pieces(minor) for minor in minors]
        common = pieces[0]
        for each in pieces[1:]:
            common = common & each
        rest = self._smallest([each - common for each in pieces])
        return self._read(base, Rational(1), self._half_angles.factors(common), rest)

    def _minors(self, base: Singularities, matrix: ScrewMatrix) -> list[list[Element]]:
        """Return the minors of the generic rank that are not zero, each as a list of factors."""
        rank, count = base.rank, len(matrix.columns)
        if comb(len(base.rows), rank) * comb(count, rank) > MAX_MINORS:
            raise TooLargeError
        found = []
        for rows in combinations(base.rows, rank):
            for columns in combinations(range(count), rank):
                entries = [[matrix.columns[c][r] for c in columns] for r in rows]
                minor = factored_determinant(self._ring, entries)
                if all(minor):
                    found.append(minor)
        return found

    def _smallest(self, cofactors: list[Pieces]) -> list[Pieces]:
        """Drop cofactors that vanish wherever another one does."""
        variables = set(self._robot.variables)
        kept: list[Pieces] = []
        for each in sorted((self._half_angles.moving(c, variables) for c in cofactors), key=_size):
            if not any(other.support <= each.support for other in kept):
                kept.append(each)
        return kept if all(each.support for each in kept) else []

    def _read(
        self,
        base: Singularities,
        constant: Expr,
        factors: list[tuple[Element, int]],
        remaining: list[Pieces],
    ) -> Singularities:
        found = []
        for element, power in factors:
            variables = self._variables(element)
            sign, expression = self._short(element)
            constant = constant * sign**power
            if not variables:
                constant = constant * expression**power
                continue
            solved = zeros(self._ring, element, variables[0]) if len(variables) == 1 else ()
            meaning = self._meanings.of(element)
            found.append(Factor(expression, power, variables, solved, meaning))
        order = {variable: k for k, variable in enumerate(self._robot.variables)}
        found.sort(key=lambda f: ([order[v] for v in f.variables], str(f.expression)))
        factored = replace(base, constant=constant, factors=tuple(found))
        return self._with_rest(factored, remaining, [element for element, _ in factors])

    def _with_rest(
        self, base: Singularities, remaining: list[Pieces], covered: list[Element]
    ) -> Singularities:
        """Add where all that is left of the minors vanishes together."""
        if any(each.terms > MAX_SHOWN for each in remaining):
            return base
        products = [[f for f, _ in self._half_angles.factors(each)] for each in remaining]
        try:
            found = alternatives(self._ring, products, covered) if products else []
        except TooLargeError:
            return base
        written = (tuple(sorted((self._short(f)[1] for f in each), key=str)) for each in found)
        rest = tuple(each for each in written if _is_possible(each))
        return replace(base, remaining=rest, is_complete=True)

    def _short(self, element: Element) -> tuple[int, Expr]:
        """Return a short form, its sign turned so that plus prevails, and that sign before it."""
        expression = short_form(self._ring, self._runs, element)
        minus = sum(1 for term in expression.as_ordered_terms() if term.could_extract_minus_sign())
        total = len(expression.as_ordered_terms())
        flip = 2 * minus > total or (2 * minus == total and expression.could_extract_minus_sign())
        return (-1, -expression) if flip else (1, expression)

    def _constant(self, minor: list[Element], factors: list[tuple[Element, int]]) -> Expr:
        """Return the number between a determinant and its factors.

        Raises
        ------
        DerivationError
            When the two differ by more than a number.
        """
        ratios = set()
        for shift in (0, 5):
            point = self._ring.generic_point(shift)
            ratio = Fraction(1)
            for element in minor:
                ratio *= self._ring.value(element, point)
            for element, power in factors:
                ratio /= self._ring.value(element, point) ** power
            ratios.add(ratio)
        if len(ratios) != 1:
            raise DerivationError(f"the factors of {self._robot.name} do not make its determinant")
        ratio = ratios.pop()
        return Rational(ratio.numerator, ratio.denominator)

    def _variables(self, element: Element) -> tuple[Symbol, ...]:
        used = {
            s for k in joint_angles(self._ring, element) for s in self._ring.angles[k].free_symbols
        }
        start = 2 * len(self._ring.angles)
        used |= {
            s
            for g, other in enumerate(self._ring.others, start=start)
            if any(powers[g] for powers in element)
            for s in other.free_symbols
        }
        return tuple(v for v in self._robot.variables if v in used)


def _rows(matrix: ScrewMatrix, rows: Sequence[int]) -> tuple[int, ...]:
    return tuple(r for r in rows if any(column[r] for column in matrix.columns))


def _is_possible(expressions: tuple[Expr, ...]) -> bool:
    """Say whether no angle is asked for a cosine and a sine that both vanish."""
    cosines = {e.args[0] for e in expressions if isinstance(e, cos)}
    return not any(isinstance(e, sin) and e.args[0] in cosines for e in expressions)


def _rank(matrix: list[list[Fraction]]) -> int:
    """Return the rank of a matrix of rational numbers by elimination."""
    rows = [list(row) for row in matrix]
    rank = 0
    for column in range(len(rows[0])):
        pivot = next((r for r in range(rank, len(rows)) if rows[r][column]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for r in range(rank + 1, len(rows)):
            ratio = rows[r][column] / rows[rank][column]
            rows[r] = [x - ratio * y for x, y in zip(rows[r], rows[rank], strict=True)]
        rank += 1
    return rank


def _size(pieces: Pieces) -> tuple[int, int]:
    terms = sum(len(piece) for piece in pieces.finite.elements())
    return terms + pieces.infinite.total(), pieces.finite.total()
