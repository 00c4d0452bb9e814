"""Polynomials of one arm: cosines and sines of joint angles and their sums, slides, the goal.

Sums of the angles of neighbouring parallel joints are variables of their own, so that
``a_1 c_1 + a_2 c_{12}`` stays as short as it is written. Right-angle turns are carried through
the chain once; what is left are motions along fixed axes, and products of links are cheap.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Dummy, Expr, Integer, Mul, Rational, Symbol, cos, default_sort_key, sin
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.arm import InverseArm
from symdh.kinematics.inverse.clock import Clock
from symdh.motion.turn import IDENTITY, Turn
from symdh.motion.words import split_quarters
from symdh.robot import Axis, Motion, MotionKind

#: An element of a sympy ring; sympy has no public types to say so.
Element = Any
Rows = list[list[Element]]

#: A sum of joint angles: (row, sign), in row order, the first sign positive.
Form = tuple[tuple[int, int], ...]

ROTATION_NAMES = tuple(f"r_{r}{c}" for c in (1, 2, 3) for r in (1, 2, 3))
U_NAMES = ("u_x", "u_y", "u_z")

#: How many parts of a chain can be named while a solution is searched; twelve entries each.
PARTS = 2
_STEMS = (("e", "f"), ("g", "h"), ("m", "n"), ("known_e", "known_f"))


@dataclass(frozen=True, slots=True)
class Token:
    """A motion along an axis that does not turn with the right angles before it.

    Attributes
    ----------
    kind : MotionKind
    axis : Axis
    form : tuple of (row, sign)
        The joint that a rotation belongs to, one at most.
    amount : Expr
        The constant part of a rotation, the whole of a translation.
    """

    kind: MotionKind
    axis: Axis
    form: tuple[tuple[int, int], ...]
    amount: Expr


@dataclass(frozen=True, slots=True)
class Pose:
    """A rotation and a position whose entries are elements of a ring."""

    rotation: Rows
    position: list[Element]


class InverseRing:
    """The ring of one arm.

    Attributes
    ----------
    arm : InverseArm
    forms : tuple of Form
        Angle k has the generators 2k (cosine) and 2k + 1 (sine).
    slides : tuple of int
        The rows of prismatic joints; their generators follow those of the forms.
    constants : tuple of Expr
        Constant angles that are no multiples of 90 degrees.
    clock : Clock
        Looked at whenever a vector is turned, or an element reduced or evaluated.
    """

    def __init__(self, arm: InverseArm, clock: Clock | None = None) -> None:
        self.arm = arm
        self.clock = clock or Clock()
        self._rows = {arm.robot.joints[i - 1].variable: i for i in arm.moving}
        self.tokens, self.turns = self._tokens()
        self.forms = self._forms()
        self.slides = tuple(i for i in arm.moving if i not in arm.turning)
        self.unknowns = len(self.forms) + len(self.slides)
        self.lengths = self._lengths()
        self.constants = self._constants()
        self.goal_names = (*ROTATION_NAMES, *self.goal_position_names, *U_NAMES)
        self.letters = self._letters()
        self.ring = PolyRing([Dummy(f"g{k}") for k in range(len(self.letters))], QQ, lex)
        self.gens = self.ring.gens
        self.place = {letter: k for k, letter in enumerate(self.letters)}
        self.zero, self.one = self.ring.zero, self.ring.one
        self._form_place = {form: k for k, form in enumerate(self.forms)}
        self.vectors = [dict(form) for form in self.forms]
        self._pairs: dict[tuple[Form, Expr], tuple[Element, Element]] = {}
        first = 2 * len(self.forms) + len(self.slides)
        self.first_goal = first
        begin = first + len(self.goal_names) + len(self.lengths)
        self.first_name = begin + 2 * len(self.constants)
        self._sines = [
            *range(1, 2 * len(self.forms), 2),
            *range(begin + 1, begin + 2 * len(self.constants), 2),
        ]

    @property
    def goal_position_names(self) -> tuple[str, ...]:
        """Names of the known position: w where an offset was taken off it, else p."""
        letter = "w" if self.arm.is_shifted else "p"
        return tuple(f"{letter}_{axis}" for axis in "xyz")

    @property
    def unknown_gens(self) -> int:
        """How many generators stand for unknowns; they come first."""
        return 2 * len(self.forms) + len(self.slides)

    @property
    def first_lengths(self) -> range:
        """The generators of lengths and of constant angles: numbers of the table."""
        return range(self.first_goal + len(self.goal_names), self.first_name)

    def is_constant(self, element: Element) -> bool:
        """Say whether an element is made of numbers of the table alone."""
        lengths = self.first_lengths
        return all(k in lengths for powers in element for k, power in enumerate(powers) if power)

    def is_given(self, generator: int) -> bool:
        """Say whether a generator is an entry of the goal, or the name of a known part."""
        last = self.first_goal + len(self.goal_names)
        return self.first_goal <= generator < last or generator >= self.first_name

    def goal(self, name: str) -> Element:
        """Return an entry of the goal: a name in `goal_names`."""
        return self.gens[self.first_goal + self.goal_names.index(name)]

    def unknown_of(self, row: int) -> int:
        """Return the number of the unknown of a row: an angle's place, or that of a slide."""
        if row in self.slides:
            return len(self.forms) + self.slides.index(row)
        return self._form_place[((row, 1),)]

    def is_angle(self, unknown: int) -> bool:
        """Say whether an unknown is an angle, or a sum of angles."""
        return unknown < len(self.forms)

    def slide_gen(self, unknown: int) -> int:
        """Return the generator of a slide."""
        return len(self.forms) + unknown

    def unknown_expression(self, unknown: int) -> Expr:
        """Return a slide's variable, or the sum of joint variables that an angle is."""
        if self.is_angle(unknown):
            return self.angle(self.forms[unknown])
        variable = self.arm.robot.joints[self.slides[unknown - len(self.forms)] - 1].variable
        assert variable is not None
        return variable

    def angle(self, form: Form) -> Expr:
        """Return a form as a sum of joint variables."""
        joints = self.arm.robot.joints
        terms = ((sign, joints[row - 1].variable) for row, sign in form)
        return Add(*(sign * variable for sign, variable in terms if variable is not None))

    def expression(self, element: Element) -> Expr:
        """Return an element as an expanded expression."""
        return Add(
            *(
                Mul(
                    Rational(int(c.numerator), int(c.denominator)),
                    *(letter**e for letter, e in zip(self.letters, powers, strict=True) if e),
                )
                for powers, c in element.terms()
            )
        )

    def reduced(self, element: Element) -> Element:
        """Return an element with every sine to the first power at most."""
        self.clock.check()
        sines = {k for powers in element for k in self._sines if powers[k] > 1}
        for k in sorted(sines):
            element = self._reduced_in(element, k)
        return element

    def orthonormal(self, element: Element) -> Element:
        """Use that the columns of the goal's rotation are of unit length and orthogonal.

        Products of two entries of its third row are put by the other two rows.
        """
        third = [self.first_goal + 3 * c + 2 for c in range(3)]
        while True:
            square = next(
                ((m, c) for m, c in element.terms() if sum(m[k] for k in third) > 1), None
            )
            if square is None:
                return element
            powers, coefficient = square
            a, b = [k for k in third for _ in range(powers[k])][:2]
            rest = list(powers)
            rest[a] -= 1
            rest[b] -= 1
            product = self.one if a == b else self.zero
            product -= self.gens[a - 1] * self.gens[b - 1] + self.gens[a - 2] * self.gens[b - 2]
            monomial = self.ring.from_dict({tuple(powers): coefficient})
            element = element - monomial + self.ring.from_dict({tuple(rest): coefficient}) * product

    def product(self, i: int, j: int) -> Pose:
        """Return A_{i+1} .. A_j."""
        rotation, position = self._carry(self._slice(i, j))
        back = self.turns[i]
        return Pose(
            _rows_by(back, _columns_by(rotation, self.turns[j])), _rotated_back(back, position)
        )

    def inverse_product(self, i: int, j: int) -> Pose:
        """Return (A_{i+1} .. A_j)^-1."""
        rotation, position = self._carry(self._inverse_slice(i, j))
        back = self.turns[j]
        return Pose(
            _rows_by(back, _columns_by(rotation, self.turns[i])), _rotated_back(back, position)
        )

    def times(self, left: Pose, right: Pose) -> Pose:
        """Return the product of two poses."""
        rotation = [
            [self._dot(row, [right.rotation[k][c] for k in range(3)]) for c in range(3)]
            for row in left.rotation
        ]
        moved = [self._dot(row, right.position) for row in left.rotation]
        position = [self.reduced(x + y) for x, y in zip(moved, left.position, strict=True)]
        return Pose([[self.reduced(e) for e in row] for row in rotation], position)

    @property
    def goal_pose(self) -> Pose:
        """The goal: R and w."""
        rotation = [[self.goal(f"r_{r}{c}") for c in (1, 2, 3)] for r in (1, 2, 3)]
        return Pose(rotation, [self.goal(name) for name in self.goal_position_names])

    @property
    def inverse_goal(self) -> Pose:
        """The inverse of the goal: R^T and u = -R^T w."""
        rotation = [[self.goal(f"r_{c}{r}") for c in (1, 2, 3)] for r in (1, 2, 3)]
        return Pose(rotation, [self.goal(name) for name in U_NAMES])

    def pair(self, form: Sequence[tuple[int, int]], constant: Expr) -> tuple[Element, Element]:
        """Return cosine and sine of a sum of joint angles and a constant."""
        key = (tuple(form), constant)
        if key not in self._pairs:
            self._pairs[key] = self._pair(*key)
        return self._pairs[key]

    def _pair(self, form: Form, constant: Expr) -> tuple[Element, Element]:
        c, s = self.one, self.zero
        if form:
            k = 2 * self._form_place[canonical(form)]
            c, s = self.gens[k], form[0][1] * self.gens[k + 1]
        if constant.is_zero:
            return c, s
        c_0, s_0 = self._constant_pair(constant)
        return c * c_0 - s * s_0, s * c_0 + c * s_0

    def _constant_pair(self, constant: Expr) -> tuple[Element, Element]:
        if not _is_opaque(constant):
            c, s = cos(constant), sin(constant)
            return self.one * QQ(c.p, c.q), self.one * QQ(s.p, s.q)
        angle, sign = _without_sign(constant)
        begin = self.first_goal + len(self.goal_names) + len(self.lengths)
        k = begin + 2 * self.constants.index(angle)
        return self.gens[k], sign * self.gens[k + 1]

    def _carry(self, tokens: Sequence[Token]) -> tuple[Rows, list[Element]]:
        """Multiply out a slice of the chain; translations go along with sums of angles."""
        columns = [[self.one if r == c else self.zero for r in range(3)] for c in range(3)]
        for axis, form, constant in reversed(_turnings(tokens)):
            pair = self.pair(form, constant)
            columns = [self._rotate(axis, pair, column) for column in columns]
        point = [self.zero, self.zero, self.zero]
        for axis, stations in reversed(_runs(tokens)):
            *earlier, (form, constant, last) = stations
            arrived = [x + self._length(y) for x, y in zip(point, last, strict=True)]
            point = self._rotate(axis, self.pair(form, constant), arrived)
            for form, constant, offset in earlier:
                if any(not part.is_zero for part in offset):
                    moved = [self._length(part) for part in offset]
                    moved = self._rotate(axis, self.pair(form, constant), moved)
                    point = [x + y for x, y in zip(point, moved, strict=True)]
        rotation = [[columns[c][r] for c in range(3)] for r in range(3)]
        return [[self.reduced(e) for e in row] for row in rotation], [
            self.reduced(e) for e in point
        ]

    def _rotate(
        self, axis: Axis, pair: tuple[Element, Element], vector: list[Element]
    ) -> list[Element]:
        self.clock.check()
        first, second = (axis + 1) % 3, (axis + 2) % 3
        c, s = pair
        x, y = vector[first], vector[second]
        turned = list(vector)
        turned[first] = c * x - s * y
        turned[second] = s * x + c * y
        return turned

    def _length(self, amount: Expr) -> Element:
        element = self.zero
        for symbol, coefficient in amount.as_coefficients_dict().items():
            if not coefficient.is_zero:
                factor = QQ(coefficient.p, coefficient.q)
                element = element + self.gens[self.place[symbol]] * factor
        return element

    def _dot(self, a: Sequence[Element], b: Sequence[Element]) -> Element:
        total = self.zero
        for x, y in zip(a, b, strict=True):
            if x and y:
                total = total + x * y
        return total

    def _reduced_in(self, element: Element, sine: int) -> Element:
        square = self.one - self.gens[sine - 1] ** 2
        by_power: dict[int, Any] = {}
        for powers, coefficient in element.terms():
            pairs, left = divmod(powers[sine], 2)
            rest = (*powers[:sine], left, *powers[sine + 1 :])
            by_power.setdefault(pairs, {})[rest] = coefficient
        low = self.zero
        for pairs, part in by_power.items():
            low = low + self.ring.from_dict(part) * square**pairs
        return low

    def _slice(self, i: int, j: int) -> list[Token]:
        return [token for row in self.tokens[i:j] for token in row]

    def _inverse_slice(self, i: int, j: int) -> list[Token]:
        return [
            Token(t.kind, t.axis, tuple((row, -s) for row, s in t.form), -t.amount)
            for t in reversed(self._slice(i, j))
        ]

    def _tokens(self) -> tuple[list[list[Token]], list[Turn]]:
        """Carry right angles through the chain; return what is left and the turn at each frame."""
        turn, turns, rows = IDENTITY, [IDENTITY], []
        for word in self.arm.rows:
            row = []
            for motion in word:
                quarters = 0
                if motion.kind is MotionKind.ROTATION:
                    motion, quarters = split_quarters(motion)
                axis, sign = turn.image(motion.axis)
                token = self._token(motion, axis, sign)
                if token is not None:
                    row.append(token)
                turn = turn.then(Turn.about(motion.axis, quarters))
            rows.append(row)
            turns.append(turn)
        return rows, turns

    def _token(self, motion: Motion, axis: Axis, sign: int) -> Token | None:
        amount = sign * motion.amount
        if amount.is_zero:
            return None
        if motion.kind is MotionKind.TRANSLATION:
            return Token(motion.kind, axis, (), amount)
        form: tuple[tuple[int, int], ...] = ()
        for symbol in sorted(amount.free_symbols & set(self._rows), key=default_sort_key):
            coefficient = amount.coeff(symbol)
            if coefficient not in (1, -1):
                raise UnsupportedError(
                    f"row {self._rows[symbol]} turns by {amount}; inverse kinematics is for joints "
                    "that turn by their variable, with an offset and a sign"
                )
            form = ((self._rows[symbol], int(coefficient)),)
            amount = amount - coefficient * symbol
        return Token(motion.kind, axis, form, amount)

    def _forms(self) -> tuple[Form, ...]:
        """Return each joint angle, and each sum that the products of links hold."""
        found: dict[Form, None] = {((row, 1),): None for row in self.arm.turning}
        n = self.arm.robot.n
        for i in range(n):
            for j in range(i + 1, n + 1):
                tokens = self._slice(i, j)
                sums = [form for _, form, _ in _turnings(tokens)]
                sums += [form for _, stations in _runs(tokens) for form, _, _ in stations]
                found |= dict.fromkeys(canonical(form) for form in sums if form)
        return tuple(sorted(found, key=lambda form: (len(form), form)))

    def _lengths(self) -> tuple[Symbol, ...]:
        slides = {self.arm.robot.joints[row - 1].variable for row in self.slides}
        found = {
            symbol
            for row in self.tokens
            for token in row
            if token.kind is MotionKind.TRANSLATION
            for symbol in token.amount.free_symbols
        }
        return tuple(sorted(found - slides, key=default_sort_key))

    def _constants(self) -> tuple[Expr, ...]:
        """Return the constant angles in all products of links that have no rational cosine."""
        found: set[Expr] = set()
        n = self.arm.robot.n
        for i in range(n):
            for j in range(i + 1, n + 1):
                self.clock.check()
                # The sums within a parallel run are taken from its other end in an inverse.
                for tokens in (self._slice(i, j), self._inverse_slice(i, j)):
                    amounts = [amount for _, _, amount in _turnings(tokens)]
                    amounts += [a for _, stations in _runs(tokens) for _, a, _ in stations]
                    found |= {_without_sign(a)[0] for a in amounts if _is_opaque(a)}
        return tuple(sorted(found, key=default_sort_key))

    def _part_names(self) -> list[str]:
        """Return names for the entries of two parts: e_11 .. e_33, e_x, e_y, e_z, and f_11 .."""
        robot = self.arm.robot
        used = {symbol.name for symbol in (*robot.parameters, *robot.variables)}
        stems = next(pair for pair in _STEMS if not any(name.startswith(pair) for name in used))
        places = [f"{r}{c}" for r in (1, 2, 3) for c in (1, 2, 3)] + ["x", "y", "z"]
        return [f"{stem}_{place}" for stem in stems for place in places]

    def _letters(self) -> tuple[Expr, ...]:
        """Return what each generator stands for, in their order."""
        letters: list[Expr] = []
        for form in self.forms:
            letters += [cos(self.angle(form)), sin(self.angle(form))]
        for row in self.slides:
            letters.append(self.arm.robot.joints[row - 1].variable)
        letters += [Symbol(name, real=True) for name in self.goal_names]
        letters += self.lengths
        for angle in self.constants:
            letters += [cos(angle), sin(angle)]
        letters += [Symbol(name, real=True) for name in self._part_names()]
        return tuple(letters)


def canonical(form: Iterable[tuple[int, int]]) -> Form:
    """Return a form with its first sign positive."""
    terms = tuple(sorted(form))
    sign = terms[0][1]
    return tuple((row, sign * own) for row, own in terms)


def _turnings(
    tokens: Sequence[Token],
) -> list[tuple[Axis, tuple[tuple[int, int], ...], Expr]]:
    """Return the rotations of a slice, neighbours about one axis added."""
    found: list[tuple[Axis, tuple[tuple[int, int], ...], Expr]] = []
    for token in tokens:
        if token.kind is not MotionKind.ROTATION:
            continue
        if found and found[-1][0] is token.axis:
            axis, form, constant = found.pop()
            found.append((axis, _added(form, token.form), constant + token.amount))
        else:
            found.append((token.axis, token.form, token.amount))
    return found


Station = tuple[tuple[tuple[int, int], ...], Expr, list[Expr]]


def _runs(tokens: Sequence[Token]) -> list[tuple[Axis, list[Station]]]:
    """Cut a slice where the axis of rotation changes; in each run, what it moves by and where."""
    nothing: Station = ((), Integer(0), [Integer(0)] * 3)
    runs: list[tuple[Axis, list[Station]]] = []
    for token in tokens:
        if token.kind is MotionKind.ROTATION:
            if not runs or runs[-1][0] is not token.axis:
                leading = runs.pop()[1] if len(runs) == 1 and _only_slides(runs[0]) else [nothing]
                runs.append((token.axis, [*leading]))
            stations = runs[-1][1]
            form, constant, _ = stations[-1]
            turned = _added(form, token.form), constant + token.amount
            stations.append((*turned, [Integer(0)] * 3))
        else:
            if not runs:
                runs.append((token.axis, [((), Integer(0), [Integer(0)] * 3)]))
            offset = runs[-1][1][-1][2]
            offset[token.axis] = offset[token.axis] + token.amount
    return runs


def _only_slides(run: tuple[Axis, list[Station]]) -> bool:
    return len(run[1]) == 1


def _added(
    form: tuple[tuple[int, int], ...], more: tuple[tuple[int, int], ...]
) -> tuple[tuple[int, int], ...]:
    return tuple(sorted((*form, *more)))


def _is_opaque(angle: Expr) -> bool:
    """Say whether a constant angle has a cosine or a sine that is no rational number."""
    return not (cos(angle).is_Rational and sin(angle).is_Rational)


def _without_sign(angle: Expr) -> tuple[Expr, int]:
    return (-angle, -1) if angle.could_extract_minus_sign() else (angle, 1)


def _rows_by(turn: Turn, rotation: Rows) -> Rows:
    """Return turn^-1 times a rotation."""
    result: Rows = []
    for axis, sign in turn.images:
        result.append([sign * entry for entry in rotation[axis]])
    return result


def _columns_by(rotation: Rows, turn: Turn) -> Rows:
    """Return a rotation times a turn."""
    return [[sign * row[axis] for axis, sign in turn.images] for row in rotation]


def _rotated_back(turn: Turn, point: list[Element]) -> list[Element]:
    return [sign * point[axis] for axis, sign in turn.images]
