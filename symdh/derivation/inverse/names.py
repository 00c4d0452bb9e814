"""How the parts of an inverse kinematics derivation are called and written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from sympy import Add, Expr, Integer, Mul, Symbol

from symdh.derivation.blocks import EntryStep
from symdh.derivation.inverse.formulas import beside, inverses
from symdh.derivation.style import Style
from symdh.kinematics.inverse.branches import Branches
from symdh.kinematics.inverse.pool import Source
from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.notation.names import split_name
from symdh.notation.nodes import (
    Equation,
    Fraction,
    Generic,
    Name,
    Negative,
    Node,
    Number,
)
from symdh.notation.writing import weight
from symdh.robot import Robot

_ONE = Integer(1)
#: Letters for a sum of joint angles.
_SUM_LETTERS = ("sigma", "tau", "chi")
#: A coefficient that has more to read than this gets a name.
_SHORT = 2


def goal_letters(form: ClosedForm) -> tuple[str, ...]:
    """Return the letters for known parts and what the goal gives, in the order of reading."""
    ring = form.ring
    names = [str(letter) for k, letter in enumerate(ring.letters) if ring.is_given(k)]
    order = {f"{stem}_{axis}": k for stem in "pwu" for k, axis in enumerate("xyz")}
    names.sort(key=lambda name: (name[-2] != "_", order.get(name, 9), name))
    return (*(f"k_{count}" for count in range(1, 100)), *names)


def unknown_name(style: Style, ring: InverseRing, unknown: int, stage: str = "") -> Node:
    """Name an unknown: theta_1, or theta_{23} for a sum of joint angles.

    A sum of joints that have several letters, or no short forms, has a letter of its own:
    sigma_{23}.

    Parameters
    ----------
    style : Style
    ring : InverseRing
    unknown : int
    stage : str
        Which of its values is meant.
    """
    expression = ring.unknown_expression(unknown)
    if expression.is_Symbol:
        letter, index = split_name(expression.name)
        return Generic(letter, index, stage) if stage else Name(expression.name)
    shorthand = style.notation.shorthand
    found = shorthand.joint_sum(expression)
    if found is None:
        return Generic(_sum_letter(style.robot), _rows_label(ring.forms[unknown]), stage)
    letters = {split_name(symbol.name)[0] for symbol in expression.free_symbols}
    letter = letters.pop() if len(letters) == 1 else _sum_letter(style.robot)
    return Generic(letter, shorthand.label(found[0]), stage)


def _sum_letter(robot: Robot) -> str:
    """Return a letter for sums that the table does not use."""
    used = {split_name(s.name)[0] for s in (*robot.variables, *robot.parameters)}
    return next((letter for letter in _SUM_LETTERS if letter not in used), _SUM_LETTERS[0])


def _rows_label(form: Iterable[tuple[int, int]]) -> str:
    """Return the rows of a sum as an index: 2,3 or 2,-3."""
    return ",".join(str(sign * row) for row, sign in form)


@dataclass(frozen=True)
class Worked:
    """A part of the derivation that has a number once a goal is given.

    Attributes
    ----------
    title : str
        Of the chapter that finds it; empty for what is found before the first.
    name : Node
    expression : Expr
        In joint variables, parameters, entries of the goal, and what was worked out before.
    turns : bool
        Whether it is an angle.
    symbol : Symbol or None
        By which later parts refer to it.
    """

    title: str
    name: Node
    expression: Expr
    turns: bool = False
    symbol: Symbol | None = None


class Writer:
    """Writes the elements, unknowns and matrices of one solution.

    Attributes
    ----------
    style : Style
        Of the robot whose lengths have letters.
    form : ClosedForm
    branches : Branches
        What the branches of the steps are called.
    told : dict of Source to str
        The title of the step in which entries were compared for the first time.
    worked : list of Worked
        What a worked example gives a number for, in order.
    """

    def __init__(self, style: Style, form: ClosedForm, branches: Branches) -> None:
        self.style = style
        self.form = form
        self.branches = branches
        self.told: dict[Source, str] = {}
        self.worked: list[Worked] = []
        self._ring = form.ring
        robot = form.arm.robot
        self._used = {s.name for s in (*robot.parameters, *robot.variables)}
        self._named: dict[Element, Symbol] = {}
        self._divisors: dict[Symbol, Element] = {}
        self._counts: dict[str, int] = {}
        self._introduced: dict[Element, Symbol] = {}

    def expression(self, expression: Expr) -> Node:
        """Write an expression."""
        return self.style.notation.write(expression)

    def element(self, element: Element) -> Node:
        """Write an element."""
        return self.expression(self._ring.expression(element))

    def introduction(self, letter: Symbol, element: Element, title: str) -> EntryStep:
        """Return what a letter stands for; from now on it may be used."""
        by = self._divisors.get(letter)
        whole = self._ring.expression(element)
        self.work(title, letter, whole if by is None else whole / self._ring.expression(by))
        node = self.nested(element) if by is None else self.quotient_of(element, by)
        self._introduced[element] = letter
        return EntryStep(self.expression(letter), (node,), None)

    def work(self, title: str, symbol: Symbol, expression: Expr, turns: bool = False) -> None:
        """Keep what a symbol stands for, for a worked example."""
        self.worked.append(Worked(title, self.expression(symbol), expression, turns, symbol))

    def nested(self, element: Element) -> Node:
        """Write an element with common factors taken out: ``(r_13 c_1 + r_23 s_1) c_23 + ..``."""
        return self.expression(self._nested(element))

    def _nested(self, element: Element) -> Expr:
        """Take out the letter that most terms share, and go on with both parts."""
        for known, sign in ((element, 1), (-element, -1)):
            if known in self._introduced:
                return sign * self._introduced[known]
        counts = Counter(k for powers in element for k, power in enumerate(powers) if power)
        goal = [k for k in counts if self._ring.is_given(k)]
        for k in goal:
            del counts[k]
        if not counts or max(counts.values()) < 2:
            return self._ring.expression(element)
        lengths = self._ring.first_lengths
        letter = max(counts, key=lambda k: (counts[k], k in lengths, k))
        make = self._ring.ring.from_dict
        inside, outside = {}, {}
        for powers, coefficient in element.terms():
            if powers[letter]:
                inside[(*powers[:letter], powers[letter] - 1, *powers[letter + 1 :])] = coefficient
            else:
                outside[powers] = coefficient
        factored = Mul(self._ring.letters[letter], self._nested(make(inside)))
        return Add(factored, self._nested(make(outside)))

    def cosine(self, unknown: int) -> Expr:
        """Return the cosine of an angle."""
        return self._ring.letters[2 * unknown]

    def sine(self, unknown: int) -> Expr:
        """Return the sine of an angle."""
        return self._ring.letters[2 * unknown + 1]

    def unknown(self, unknown: int, stage: str = "") -> Node:
        """Write an unknown; `stage` tells solutions apart (see `unknown_name`)."""
        return unknown_name(self.style, self._ring, unknown, stage)

    def is_sum(self, unknown: int) -> bool:
        """Say whether an unknown is a sum of joint angles."""
        return not self._ring.unknown_expression(unknown).is_Symbol

    def short(
        self, element: Element, new: list[tuple[Symbol, Element]], longest: int = _SHORT
    ) -> Expr:
        """Return an element as it is where it is short, else a name for it.

        A new name is appended to `new` with what it stands for.
        """
        expression = self._ring.expression(element)
        node = self.expression(expression)
        if weight(node) <= longest:
            return expression
        for known, sign in ((element, 1), (-element, -1)):
            if known in self._named:
                return sign * self._named[known]
        sign = -1 if isinstance(node, Negative) else 1
        letter = self.letter("k")
        self._named[sign * element] = letter
        new.append((letter, sign * element))
        return sign * letter

    def quotient_letter(
        self, top: Element, bottom: Element, new: list[tuple[Symbol, Element]]
    ) -> Symbol:
        """Return a name for a quotient of two elements."""
        letter = self.letter("k")
        self._divisors[letter] = bottom
        new.append((letter, top))
        return letter

    def letter(self, stem: str) -> Symbol:
        """Return a letter with a number, such as k_3, that nothing else has."""
        while True:
            count = self._counts[stem] = self._counts.get(stem, 0) + 1
            if not {f"{stem}_{count}", f"{stem}{count}"} & self._used:
                return Symbol(f"{stem}_{count}", real=True)

    def quotient(self, top: Expr, bottom: Expr) -> Node:
        """Write a quotient as one fraction whose denominator is positive in its first term."""
        whole = top / bottom
        if whole.as_numer_denom()[1] == 1:
            return self.expression(whole)
        over, under = self.expression(top), self.expression(bottom)
        if isinstance(under, Negative):
            over, under = self.expression(-top), under.node
        if isinstance(under, Number) and under.value == 1:
            return over
        if isinstance(over, Negative):
            return Negative(Fraction(over.node, under))
        return Fraction(over, under)

    def quotient_of(self, top: Element, bottom: Element) -> Node:
        """Write a quotient of two elements, what the goal gives in front."""
        under = self.expression(self._ring.expression(bottom))
        if isinstance(under, Negative):
            top, under = -top, under.node
        negative = self.is_negative(top)
        over = self.nested(-top if negative else top)
        if isinstance(over, Negative):
            negative, over = not negative, over.node
        if not (isinstance(under, Number) and under.value == 1):
            over = Fraction(over, under)
        elif negative:
            return self.nested(top)
        return Negative(over) if negative else over

    def is_negative(self, element: Element) -> bool:
        """Say whether more is taken away than added of what the goal gives, or else of all."""
        given = [c for powers, c in element.terms() if self._holds_given(powers)]
        signs = given or [c for _, c in element.terms()]
        return 2 * sum(1 for c in signs if c < 0) > len(signs)

    def sign_of(self, element: Element) -> int:
        """Return the sign of a product of lengths; those without a value are positive."""
        values = self.form.arm.robot.values
        powers = element.LM
        negative = [
            k
            for k, power in enumerate(powers)
            if power % 2 and values.get(self._ring.letters[k], _ONE).is_negative
        ]
        return -1 if (element.LC < 0) != (len(negative) % 2 == 1) else 1

    def _holds_given(self, powers: tuple[int, ...]) -> bool:
        return any(power and self._ring.is_given(k) for k, power in enumerate(powers))

    def goal_matrix(self, source: Source) -> Node:
        """Return the name of the matrix that an equation starts from: G, or that of a part."""
        return self.part_name(source.base)

    def part_name(self, base: tuple[int, int]) -> Node:
        """Return G for the whole chain, E and F for the parts that were named."""
        parts = [step.part for step in self.form.steps if step.part]
        if base not in parts:
            return Generic("G")
        stem = str(self._ring.letters[self._ring.first_name]).partition("_")[0]
        second = str(self._ring.letters[self._ring.first_name + 12]).partition("_")[0]
        return Generic((stem, second)[parts.index(base)].upper())

    def links(self, i: int, j: int) -> tuple[Node, ...]:
        """Return the names of A_{i+1} .. A_j."""
        return tuple(self.style.link_name(k) for k in range(i + 1, j + 1))

    def matrix_equation(self, source: Source) -> Node:
        """Return the matrix equation that an equation was read off."""
        i_0, j_0 = source.base
        if source.inverted:
            before, after = self.links(source.j, j_0), self.links(i_0, source.i)
            left = (*before, *inverses((self.goal_matrix(source),)), *after)
            right = inverses(self.links(source.i, source.j))
        else:
            before, after = self.links(i_0, source.i), self.links(source.j, j_0)
            left = (*inverses(before), self.goal_matrix(source), *inverses(after))
            right = self.links(source.i, source.j)
        return Equation((beside(left), beside(right)))
