"""The steps of an inverse kinematics solution, told one by one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from sympy import Add, Expr, Integer, Symbol, atan2, cos, pi, sin, sqrt

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Display,
    EntryStep,
    EntrySteps,
    Inline,
    Paragraph,
)
from symdh.derivation.inverse_names import Writer, is_zero, listed, place
from symdh.kinematics.inverse.pool import Combination, Equation, Source
from symdh.kinematics.inverse.posture import Part
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.solution import ClosedForm, Rule, Step, Used
from symdh.notation import nodes
from symdh.notation.nodes import Call, Generic, Negative, Node, Sum
from symdh.notation.writing import weight
from symdh.robot import JointType

#: What is said of two values that the arm does not tell apart.
_WITHOUT_NAMES = {
    Rule.COSINE: "The first value is a positive angle, the second a negative one.",
    Rule.SINE: "The first value is at most 90 degrees from zero, the second farther.",
}
#: A side of an equation that has more to read than this does not stand in front.
_LONG = 7
#: Nor one of several, which would push the others to the right.
_LONG_AMONG_OTHERS = 5
#: The column of the position in a matrix, from 0.
_POSITION = 3
#: The entry of a known part that has more to read than this is not written out.
_TOO_LONG = 30
#: The sine and the cosine of an angle that have no more to read than this are put in.
_SHORT = 2


def step_chapter(writer: Writer, step: Step) -> Chapter:
    """Return the chapter on one step."""
    title = _title(writer, step)
    blocks = _Telling(writer, title, step).blocks()
    return Chapter(f"{title[0].upper()}{title[1:]}", tuple(blocks))


def _title(writer: Writer, step: Step) -> str:
    if step.definitions:
        return "what is known so far"
    ring = writer.form.ring
    if not ring.is_angle(step.unknown):
        row = ring.slides[step.unknown - len(ring.forms)]
        return f"joint {row}"
    rows = [row for row, _ in ring.forms[step.unknown]]
    if len(rows) == 1:
        return f"joint {rows[0]}"
    listed = f"{', '.join(map(str, rows[:-1]))} and {rows[-1]}"
    return f"the angles of joints {listed} together"


class _Telling:
    """Tells one step."""

    def __init__(self, writer: Writer, title: str, step: Step) -> None:
        self._writer = writer
        self._title = title
        self._step = step
        self._new: list[tuple[Symbol, Element]] = []
        self._written: set[tuple[Node, ...]] = set()

    def blocks(self) -> list[Block]:
        """Return all that is said of the step."""
        step = self._step
        if step.definitions:
            return self._names()
        if step.rule is Rule.SUM:
            return self._sum()
        told = [] if self._is_told else self._origin()
        solved = {
            Rule.RATIO: self._ratio,
            Rule.SINE: self._arc,
            Rule.COSINE: self._arc,
            Rule.SINE_COSINE: self._sine_cosine,
            Rule.PAIR: self._pair,
            Rule.SLIDE: self._slide,
            Rule.SLIDE_SQUARE: self._slide_square,
            Rule.HALF_ANGLE: self._half_angle,
        }[step.rule]()
        return [*told, *solved, *self._branches()]

    @property
    def _is_told(self) -> bool:
        """Whether the step before has introduced the equations of this one."""
        steps = self._writer.form.steps
        k = steps.index(self._step)
        return k > 0 and steps[k - 1].equations == self._step.equations != ()

    # ------------------------------------------------------------ where equations come from

    def _origin(self) -> list[Block]:
        """Say which matrices were moved and which entries compared, and give the equations."""
        blocks: list[Block] = []
        for sources, equations in _by_matrix(used.equation for used in self._step.equations):
            blocks += self._read_off(sources, equations)
        expanded = [used for used in self._step.equations if used.element != used.equation.element]
        if expanded:
            blocks += self._expanded(expanded)
        return blocks

    def _read_off(self, source: Source, equations: Sequence[Equation]) -> list[Block]:
        if equations[0].parents:
            return self._combined(equations[0])
        entries = [entry for equation in equations for entry in equation.source.entries]
        before = {self._writer.told.get(equation.source, "") for equation in equations}
        for equation in equations:
            self._writer.told.setdefault(equation.source, self._title)
        if len(before) == 1 and min(before) and not any(e.source.is_squared for e in equations):
            return [
                Paragraph(_compared_again(entries, min(before))),
                self._shown(side for each in equations for side in each.sides),
            ]
        blocks: list[Block] = [
            Paragraph(self._moved(source)),
            Display(self._writer.matrix_equation(source)),
        ]
        squared = [equation for equation in equations if equation.source.is_squared]
        plain = [equation for equation in equations if not equation.source.is_squared]
        if plain:
            entries = [entry for equation in plain for entry in equation.source.entries]
            blocks.append(Paragraph(_compared(entries)))
            blocks.append(self._shown(side for each in plain for side in each.sides))
        for equation in squared:
            blocks.append(Paragraph(_compared(equation.source.entries)))
            blocks.append(self._shown(equation.sides))
            self._remember(equation)
            blocks.append(Paragraph(("Squared and added, they give",)))
            blocks.append(self._as_equation(equation.element))
        return blocks

    def _remember(self, equation: Equation) -> None:
        """Entries that were squared and added have been compared one by one as well."""
        for entry in equation.source.entries:
            self._writer.told.setdefault(replace(equation.source, entries=(entry,)), self._title)

    def _moved(self, source: Source) -> tuple[Inline, ...]:
        writer = self._writer
        names = [*writer.links(source.base[0], source.i), *writer.links(source.j, source.base[1])]
        goal = writer.goal_matrix(source)
        if source.inverted:
            tail = (", and the links at its ends are moved over",) if names else ()
            return ("Both sides are inverted, so that the base is seen from the hand", *tail, ":")
        if not names:
            return ("The matrix equation is taken as it stands:",)
        verb = "are" if len(names) > 1 else "is"
        return (*listed(names), f" {verb} moved to the side of ", goal, ":")

    def _combined(self, equation: Equation) -> list[Block]:
        blocks: list[Block] = []
        for source, parents in _by_matrix(equation.parents):
            blocks += self._read_off(source, parents)
        how = equation.combination or Combination.RATIO
        return [
            *blocks,
            Paragraph((f"{how.value[0].upper()}{how.value[1:]}:",)),
            self._as_equation(equation.element),
        ]

    def _expanded(self, used: Sequence[Used]) -> list[Block]:
        text = "The sums of angles are expanded, since one part of each is known:"
        rows = [row for each in used for row in self._as_equation(each.element).entries]
        return [Paragraph((text,)), EntrySteps(tuple(rows))]

    def _shown(self, sides: Iterable[tuple[Element, Element]]) -> EntrySteps:
        """Return equations with the shorter side in front."""
        write = self._writer.element
        rows = []
        pairs = tuple(sides)
        longest = _LONG if len(pairs) == 1 else _LONG_AMONG_OTHERS
        for left, right in pairs:
            known, chain = write(left), write(right)
            front, behind = (known, chain) if weight(known) <= weight(chain) else (chain, known)
            if is_zero(front):
                front, behind = behind, front
            if weight(front) > longest:
                front, behind = write(left - left), write(left - right)
            rows.append(EntryStep(front, (behind,), None))
            self._written.add((front, behind))
        return EntrySteps(tuple(rows))

    def _stand_there(self, rows: Sequence[EntryStep]) -> bool:
        """Say whether equations have been written in this step as they are."""
        return all(
            {(row.name, row.forms[0]), (row.forms[0], row.name)} & self._written for row in rows
        )

    def _as_equation(self, element: Element) -> EntrySteps:
        """Return ``element = 0`` with what the goal gives on one side."""
        ring = self._writer.form.ring
        given: dict[tuple[int, ...], object] = {}
        rest: dict[tuple[int, ...], object] = {}
        for powers, coefficient in element.terms():
            goal = any(power and ring.is_given(k) for k, power in enumerate(powers))
            (given if goal else rest)[powers] = coefficient
        left, right = ring.ring.from_dict(given), -ring.ring.from_dict(rest)
        if right and all(coefficient < 0 for coefficient in right.values()) and left:
            left, right = -left, -right
        return self._shown([(left, right)])

    # ------------------------------------------------------------ how the unknown follows

    def _linear(self, coefficients: Sequence[Element]) -> tuple[Expr, Expr, Expr]:
        """Return A, B, C with letters for what is long: A s + B c = -C, so -C gets the letter."""
        a, b, c = coefficients
        short = self._writer.short
        return short(a, self._new), short(b, self._new), -short(-c, self._new)

    def _introduced(self) -> list[Block]:
        """Give what the new names stand for, once."""
        if not self._new:
            return []
        write = self._writer
        rows = [EntryStep(write.expression(k), (write.nested(e),), None) for k, e in self._new]
        self._new = []
        return [Paragraph(("With letters for what is known,",)), EntrySteps(tuple(rows))]

    def _restated(self, equation: Node) -> list[Block]:
        """Give the new names, and the equation with them; nothing where it stands there."""
        told = self._introduced()
        return [*told, Paragraph(("this is",)), Display(equation)] if told else []

    def _trigonometric(self) -> tuple[Expr, Expr]:
        unknown = self._step.unknown
        return self._writer.sine(unknown), self._writer.cosine(unknown)

    def _ratio(self) -> list[Block]:
        a, b, _ = self._linear((*self._step.coefficients[:2], self._writer.form.ring.zero))
        s, c = self._trigonometric()
        write = self._writer.expression
        first = self._writer.unknown(self._step.unknown, "1")
        second = Sum((first, self._writer.style.notation.angle(pi)))
        return [
            *self._restated(_equation(write(a * s + b * c), write(Integer(0)))),
            *self._solution(
                EntryStep(first, (write(atan2(-b, a)),), None),
                EntryStep(self._writer.unknown(self._step.unknown, "2"), (second,), None),
            ),
            *self._free(a, b),
        ]

    def _arc(self) -> list[Block]:
        """A sine or a cosine is known."""
        a, b, c = self._step.coefficients
        writer = self._writer
        s, cosine = self._trigonometric()
        of_cosine = self._step.rule is Rule.COSINE
        known = cosine if of_cosine else s
        value = writer.quotient_of(-c, b if of_cosine else a)
        other = sqrt(1 - known**2)
        pairs = (
            [(other, known), (-other, known)] if of_cosine else [(known, other), (known, -other)]
        )
        rows = [
            EntryStep(
                writer.unknown(self._step.unknown, str(k)),
                (writer.expression(atan2(y, x, evaluate=False)),),
                None,
            )
            for k, (y, x) in enumerate(pairs, start=1)
        ]
        function = "arccosine" if of_cosine else "arcsine"
        shown = writer.expression(known)
        return [
            Paragraph(("So",)),
            EntrySteps((EntryStep(shown, (value,), None),)),
            *self._solution(*rows, lead=f"and the {function}, written with atan2, is"),
            Paragraph(
                (
                    *("Where ", shown, " is ", writer.expression(Integer(1)), " or "),
                    *(writer.expression(Integer(-1)), ", both solutions are one"),
                    *(self._stretched(), "; beyond that the goal is out of reach."),
                )
            ),
        ]

    def _stretched(self) -> str:
        branching = self._writer.branches.of(self._step.unknown)
        feature = None if branching is None else branching.feature
        bent = feature is not None and feature.part is Part.ELBOW
        return ": the arm is stretched out or folded" if bent else ""

    def _sine_cosine(self) -> list[Block]:
        a, b, c = self._linear(self._step.coefficients)
        known = -c
        writer = self._writer
        s, cosine = self._trigonometric()
        rho, psi = writer.letter("rho"), writer.letter("psi")
        write = writer.expression
        unknown = writer.unknown(self._step.unknown)
        inner = Sum((unknown, Negative(write(psi))))
        root = sqrt(rho**2 - known**2)
        rows = [
            EntryStep(
                writer.unknown(self._step.unknown, str(k)),
                (_plus(write(psi), write(atan2(root, known, evaluate=False)), sign),),
                None,
            )
            for k, sign in ((1, 1), (2, -1))
        ]
        return [
            *self._restated(_equation(write(a * s + b * cosine), write(known))),
            *self._polar(rho, psi, a, b),
            Paragraph(("the left side is one cosine:",)),
            Display(_equation(nodes.Product((write(rho), Call("cos", (inner,)))), write(known))),
            *self._solution(*rows),
            Paragraph(
                (
                    *("Where ", write(rho**2), " is less than ", write(known**2)),
                    *(", the goal is out of reach; where they are equal, both solutions are one"),
                    *(self._stretched(), "."),
                )
            ),
            *self._free(a, b),
        ]

    def _polar(self, rho: Symbol, psi: Symbol, y: Expr, x: Expr) -> list[Block]:
        """Put ``rho sin psi`` and ``rho cos psi`` for two known parts."""
        write = self._writer.expression
        angle = write(psi)
        rows = (
            EntryStep(write(y), (nodes.Product((write(rho), Call("sin", (angle,)))),), None),
            EntryStep(write(x), (nodes.Product((write(rho), Call("cos", (angle,)))),), None),
        )
        values = (
            EntryStep(write(rho), (write(sqrt(y**2 + x**2)),), None),
            EntryStep(angle, (write(atan2(y, x, evaluate=False)),), None),
        )
        return [
            Paragraph(("With the known parts written as",)),
            EntrySteps(rows),
            Paragraph(("that is",)),
            EntrySteps(values),
        ]

    def _pair(self) -> list[Block]:
        apart = self._apart()
        if apart is not None:
            return self._both_known(*apart)
        first, second = self._step.coefficients[:3], self._step.coefficients[3:]
        rotated = _as_rotation(first, second)
        if rotated is not None:
            return self._rotation(*(self._writer.short(part, self._new) for part in rotated))
        return self._cramer(self._linear(first), self._linear(second))

    def _apart(self) -> tuple[Element, Element] | None:
        """Return the sine and the cosine where each equation gives one of them as it stands."""
        a_1, b_1, c_1, a_2, b_2, c_2 = self._step.coefficients
        one = self._writer.form.ring.one
        if not b_1 and not a_2 and a_1 in (one, -one) and b_2 in (one, -one):
            return -a_1 * c_1, -b_2 * c_2
        if not a_1 and not b_2 and a_2 in (one, -one) and b_1 in (one, -one):
            return -a_2 * c_2, -b_1 * c_1
        return None

    def _both_known(self, sine: Element, cosine: Element) -> list[Block]:
        """Give an angle whose sine and cosine stand there."""
        writer = self._writer
        s, c = self._trigonometric()
        write = writer.expression
        values = writer.element(sine), writer.element(cosine)
        rows = [
            EntryStep(write(name), (value,), None)
            for name, value in zip((s, c), values, strict=True)
        ]
        angle = [write(atan2(s, c, evaluate=False))]
        if all(weight(value) <= _SHORT for value in values):
            angle.append(Call("atan2", values))
        blocks: list[Block] = []
        if not self._stand_there(rows):
            blocks = [Paragraph(("So",)), EntrySteps(tuple(rows))]
        unknown = writer.unknown(self._step.unknown)
        return [*blocks, *self._solution(EntryStep(unknown, tuple(angle), None))]

    def _rotation(self, k_1: Expr, k_2: Expr, x: Expr, y: Expr) -> list[Block]:
        """Solve ``x = k_1 c - k_2 s`` and ``y = k_1 s + k_2 c`` by one angle psi."""
        writer = self._writer
        s, c = self._trigonometric()
        write = writer.expression
        rho, psi = writer.letter("rho"), writer.letter("psi")
        unknown = writer.unknown(self._step.unknown)
        inner = Sum((write(psi), Negative(unknown)))
        rows = (
            EntryStep(write(x), (write(k_1 * c - k_2 * s),), None),
            EntryStep(write(y), (write(k_1 * s + k_2 * c),), None),
        )
        turned = (
            EntryStep(write(x), (nodes.Product((write(rho), Call("sin", (inner,)))),), None),
            EntryStep(write(y), (nodes.Product((write(rho), Call("cos", (inner,)))),), None),
        )
        difference = _plus(write(psi), write(atan2(x, y, evaluate=False)), -1)
        blocks = self._introduced()
        if not self._stand_there(rows):
            blocks += [Paragraph(("these are" if blocks else "So",)), EntrySteps(rows)]
        return [
            *blocks,
            *self._polar(rho, psi, k_1, k_2),
            Paragraph(("these are",)),
            EntrySteps(turned),
            *self._solution(EntryStep(unknown, (difference,), None)),
            Paragraph(
                (
                    *("If ", write(rho), " is zero, both equations are empty and ", unknown),
                    *(" is free; ", self._meaning()),
                )
            ),
        ]

    def _cramer(
        self, first: tuple[Expr, Expr, Expr], second: tuple[Expr, Expr, Expr]
    ) -> list[Block]:
        writer = self._writer
        write = writer.expression
        s, c = self._trigonometric()
        (a_1, b_1, _), (a_2, b_2, _) = first, second
        unknown = writer.unknown(self._step.unknown)
        determinant = a_1 * b_2 - a_2 * b_1
        rows = self._rows((first, second), s, c)
        sine, cosine = _cramers_rule(first, second)
        solved = (
            EntryStep(write(s), (writer.quotient(*sine),), None),
            EntryStep(write(c), (writer.quotient(*cosine),), None),
        )
        told = self._introduced()
        blocks: list[Block] = [*told]
        apart = any((b.is_zero and p.is_zero) for b, p in ((b_1, a_2), (b_2, a_1)))
        if not apart:
            again = "Of the same two equations all else is known now:"
            lead = again if self._is_told else "these are" if told else "So"
            blocks += [Paragraph((lead,)), EntrySteps(rows)]
        blocks += [
            Paragraph(("So" if apart else "two linear equations, with the solution",)),
            EntrySteps(solved),
            *self._solution(EntryStep(unknown, (write(atan2(s, c, evaluate=False)),), None)),
        ]
        if determinant.could_extract_minus_sign():
            determinant = -determinant
        if determinant.is_Pow:
            determinant = determinant.base
        if determinant.atoms(cos, sin):
            shown = write(determinant)
            what: Inline = shown if weight(shown) <= _LONG else "the determinant of the two"
            where: tuple[Inline, ...] = ("Where ", what, " is zero, this pair says nothing about ")
            rest: tuple[Inline, ...] = (unknown, " and it is free; ", self._meaning())
            if self._step.alternatives:
                rest = (unknown, "; there another pair of entries serves.")
            blocks.append(Paragraph((*where, *rest)))
        return blocks

    def _slide(self) -> list[Block]:
        writer, ring = self._writer, self._writer.form.ring
        a, c = self._step.coefficients
        row = EntryStep(writer.unknown(self._step.unknown), (writer.quotient_of(-c, a),), None)
        blocks = self._solution(row)
        if not ring.is_constant(a):
            shown = writer.element(a)
            blocks.append(Paragraph(("Where ", shown, " is zero this says nothing.")))
        return blocks

    def _slide_square(self) -> list[Block]:
        writer = self._writer
        a, b, c = self._linear(self._step.coefficients)
        q = writer.form.ring.unknown_expression(self._step.unknown)
        write = writer.expression
        root = write(sqrt(b**2 - 4 * a * c))
        before = () if b.is_zero else (write(-b),)
        tops = [(*before, root), (*before, Negative(root))]
        rows = [
            EntryStep(
                writer.unknown(self._step.unknown, str(k)),
                (nodes.Fraction(Sum(top) if before else top[0], write(2 * a)),),
                None,
            )
            for k, top in enumerate(tops, start=1)
        ]
        return [
            *self._introduced(),
            Paragraph(("So",)),
            Display(_equation(write(a * q**2 + b * q + c), write(Integer(0)))),
            *self._solution(*rows),
            Paragraph(("Where the radicand is negative, the goal is out of reach.",)),
        ]

    def _half_angle(self) -> list[Block]:
        step, writer = self._step, self._writer
        write = writer.expression
        y, x = step.unknown, step.eliminated
        assert x is not None
        a_1, b_1, c_1 = self._linear(step.coefficients[:3])
        a_2, b_2, c_2 = self._linear(step.coefficients[3:])
        rows = self._rows(((a_1, b_1, c_1), (a_2, b_2, c_2)), writer.sine(x), writer.cosine(x))
        told = self._introduced()
        if told:
            told[0] = Paragraph(("In these, ", writer.unknown(y), " is the only unknown:"))
        if step.scales:
            l_1, l_2 = (writer.form.ring.expression(scale) for scale in step.scales)
            left: Node = Sum(
                tuple(_squared(writer.quotient(c, s)) for c, s in ((c_1, l_1), (c_2, l_2)))
            )
            p, q = (
                self._divided(element, a, l_1)
                for element, a in zip(step.coefficients, (a_1, b_1), strict=False)
            )
            right = write(p**2 + q**2)
            why = (
                *("The left sides are ", write(l_1), " and ", write(l_2)),
                *(" times the components of one vector along perpendicular directions. "),
                *(
                    "Divided by these, squared and added, they are its length, and ",
                    writer.unknown(x),
                ),
                " drops out:",
            )
        else:
            left = write((b_1 * c_2 - b_2 * c_1) ** 2 + (a_2 * c_1 - a_1 * c_2) ** 2)
            right = write((a_1 * b_2 - a_2 * b_1) ** 2)
            why = (
                *("Solved for the sine and the cosine of ", writer.unknown(x)),
                *(", whose squares add up to 1, these give"),
            )
        t = Generic("t")
        half = nodes.Fraction(writer.unknown(y), write(Integer(2)))
        degree = "quartic" if step.branches == 4 else f"polynomial of degree {step.branches}"
        return [
            Paragraph(("Both hold ", writer.unknown(x), " and ", writer.unknown(y), " alone:")),
            EntrySteps(rows),
            *told,
            Paragraph(why),
            EntrySteps((EntryStep(left, (right,), None),)),
            Paragraph(
                (
                    *("With ", _equation(t, Call("tan", (half,))), ", "),
                    *(_equation(write(writer.cosine(y)), _QUOTIENT_C), " and "),
                    *(_equation(write(writer.sine(y)), _QUOTIENT_S), ", this is a "),
                    *(f"{degree} in ", t, ". Each real root gives one value "),
                    _equation(
                        writer.unknown(y), nodes.Product((write(Integer(2)), Call("atan", (t,))))
                    ),
                    ".",
                )
            ),
        ]

    def _rows(
        self, equations: Sequence[tuple[Expr, Expr, Expr]], s: Expr, c: Expr
    ) -> tuple[EntryStep, ...]:
        """Return ``A s + B c = -C`` of each equation, with as few signs as can be."""
        write = self._writer.expression
        rows = []
        for a, b, rest in equations:
            left, right = write(a * s + b * c), write(-rest)
            if isinstance(left, Negative):
                left, right = left.node, write(rest)
            rows.append(EntryStep(left, (right,), None))
        return tuple(rows)

    def _divided(self, element: Element, name: Expr, by: Expr) -> Expr:
        """Divide a coefficient by a constant: term by term where it has no name."""
        whole = self._writer.form.ring.expression(element)
        return name / by if name != whole else Add(*(term / by for term in Add.make_args(whole)))

    def _sum(self) -> list[Block]:
        writer = self._writer
        terms = []
        for sign, part in self._step.parts:
            node = writer.unknown(part)
            terms.append(node if sign > 0 else Negative(node))
        terms.sort(key=lambda node: isinstance(node, Negative))
        row = EntryStep(writer.unknown(self._step.unknown), (Sum(tuple(terms)),), None)
        return [Paragraph(("Both parts are known:",)), EntrySteps((row,))]

    def _names(self) -> list[Block]:
        """Give the entries of a part whose pose is known now."""
        step, writer = self._step, self._writer
        assert step.part is not None
        i, j = step.part
        before = [other.part for other in writer.form.steps if other.part]
        place_now = before.index(step.part)
        base = before[place_now - 1] if place_now else None
        n = writer.form.arm.robot.n
        source = Source(i, j, (), base=base if base is not None else (0, n))
        shown = _printed(writer.form)
        rows = [
            EntryStep(writer.expression(writer.form.ring.letters[k]), (writer.nested(e),), None)
            for k, e in step.definitions
            if k in shown
        ]
        name = writer.part_name(step.part)
        equation = writer.matrix_equation(source)
        assert isinstance(equation, nodes.Equation)
        moved: list[Block] = [
            Paragraph(("The joints found so far are taken to the side of what is known,",)),
            Display(nodes.Equation((name, *equation.sides))),
        ]
        if any(weight(form) > _TOO_LONG for row in rows for form in row.forms):
            entries = listed([row.name for row in rows])
            text = (" are known numbers, row times column; written out they would fill the page.",)
            return [*moved, Paragraph(("of which ", *entries, *text))]
        return [
            *moved,
            Paragraph(("and the entries that are needed get names:",)),
            EntrySteps(tuple(rows)),
        ]

    # ------------------------------------------------------------ what is to be said of it

    def _solution(self, *rows: EntryStep, lead: str = "Hence") -> list[Block]:
        return [Paragraph((lead,)), EntrySteps(tuple(rows))]

    def _branches(self) -> list[Block]:
        """Name the branches."""
        branching = self._writer.branches.of(self._step.unknown)
        if branching is None:
            return []
        if branching.feature is None:
            text = _WITHOUT_NAMES.get(self._step.rule)
            return [Paragraph((text,))] if text else []
        first, second = branching.feature.names
        if branching.names:
            text = f"The two values: (1) {branching.names[0]}, (2) {branching.names[1]}. "
        else:
            text = f"One of the two values gives {first}, the other {second}; which is which "
            text += "depends on the steps before. " if self._settled else "depends on the goal. "
        text += branching.feature.meaning
        if self._writer.branches.assumed:
            text += " Lengths are taken as positive."
        return [Paragraph((text,))]

    @property
    def _settled(self) -> bool:
        """Whether the names of the branches of all steps together do not depend on the goal."""
        return len(self._writer.branches.together) == self._writer.form.most_solutions

    def _free(self, a: Expr, b: Expr) -> list[Block]:
        """Say when the angle is free, unless that depends on the arm's lengths alone."""
        ring, write = self._writer.form.ring, self._writer.expression
        if all(ring.is_constant(element) for element in self._step.coefficients[:2]):
            return []
        a, b = (-x if x.could_extract_minus_sign() else x for x in (a, b))
        unknown = self._writer.unknown(self._step.unknown)
        text: tuple[Inline, ...] = (
            *("Where ", write(a), " and ", write(b), " are both zero, ", unknown),
            *(" is free; ", self._meaning()),
        )
        return [Paragraph(text)]

    def _meaning(self) -> str:
        """Say what a free angle means for the arm."""
        form = self._writer.form
        moving, unknown = form.arm.moving, self._step.unknown
        if not form.ring.is_angle(unknown):
            return "it keeps the value that it has."
        rows = {row for row, _ in form.ring.forms[unknown]}
        lead = form.arm.robot.joints[moving[0] - 1].type is JointType.REVOLUTE
        if rows == {moving[0]} and lead and len(moving) > 1:
            return (
                "then the point that the other joints place lies on the axis of this one, turning "
                "it changes nothing, and it keeps the value that it has."
            )
        branching = self._writer.branches.of(unknown)
        feature = None if branching is None else branching.feature
        in_hand = rows <= set(moving[-3:]) and len(moving) >= 3
        if form.task.with_orientation and (in_hand or (feature and feature.part is Part.WRIST)):
            return (
                "then two axes of the hand are in line, only the sum or the difference of their "
                "angles is determined, and this one keeps the value that it has."
            )
        sources = [used.equation.source for used in self._step.equations]
        columns = {column for source in sources for _, column in source.entries}
        if columns == {_POSITION} and all(source.entries for source in sources):
            return (
                "then turning it does not move the point that is compared, and it keeps the value "
                "that it has."
            )
        return "it keeps the value that it has."


def _printed(form: ClosedForm) -> set[int]:
    """Return the generators that stand in what is printed of the steps."""
    elements: list[Element] = []

    def add(equation: Equation) -> None:
        elements.extend(side for pair in equation.sides for side in pair)
        elements.append(equation.element)
        for parent in equation.parents:
            add(parent)

    for step in form.steps:
        elements += step.coefficients
        elements += [element for _, element in step.definitions]
        for used in step.equations:
            add(used.equation)
    return {k for e in elements for powers in e for k, power in enumerate(powers) if power}


def _by_matrix(equations: Iterable[Equation]) -> list[tuple[Source, list[Equation]]]:
    """Group equations that were read off the same matrix equation."""
    groups: list[tuple[Source, list[Equation]]] = []
    for equation in equations:
        source = equation.source
        key = (source.i, source.j, source.inverted, source.base, bool(equation.parents))
        for other, members in groups:
            if not equation.parents and key == (
                *(other.i, other.j, other.inverted, other.base),
                bool(members[0].parents),
            ):
                members.append(equation)
                break
        else:
            groups.append((source, [equation]))
    return groups


def _compared(entries: Sequence[tuple[int, int]]) -> tuple[Inline, ...]:
    """Say which entries are compared."""
    places = listed([place(entry) for entry in entries])
    return ("The entries at ", *places, " on both sides are equal:")


def _compared_again(entries: Sequence[tuple[int, int]], title: str) -> tuple[Inline, ...]:
    """Say which entries are taken that an earlier step has compared."""
    return (f"As compared for {title}, at ", *listed([place(entry) for entry in entries]), ":")


def _as_rotation(
    first: Sequence[Element], second: Sequence[Element]
) -> tuple[Element, Element, Element, Element] | None:
    """Read two equations as ``x = k_1 c - k_2 s`` and ``y = k_1 s + k_2 c``, if they are that.

    Of the ways to do so the one with the fewest minus signs is taken.
    """
    found = []
    for one, other in ((first, second), (second, first)):
        for sign in (1, -1):
            for turn in (1, -1):
                a_1, b_1, c_1 = (sign * part for part in one)
                a_2, b_2, c_2 = (turn * part for part in other)
                if b_1 and b_2 and b_1 == a_2 and a_1 == -b_2:
                    found.append((b_1, b_2, -c_1, -c_2))
    return min(found, key=_minus_signs, default=None)


def _minus_signs(elements: Sequence[Element]) -> float:
    """Count the elements that have more minus signs than plus signs, and those that have both."""
    count = 0.0
    for element in elements:
        minus = sum(1 for coefficient in element.values() if coefficient < 0)
        count += 1 if 2 * minus > len(element) else minus / 100
    return count


def _cramers_rule(
    first: tuple[Expr, Expr, Expr], second: tuple[Expr, Expr, Expr]
) -> tuple[tuple[Expr, Expr], tuple[Expr, Expr]]:
    """Return numerator and denominator of the sine and of the cosine."""
    (a_1, b_1, c_1), (a_2, b_2, c_2) = first, second
    for (a, b, c), (p, q, r) in ((first, second), (second, first)):
        if b.is_zero and p.is_zero:
            return (-c, a), (-r, q)
    determinant = a_1 * b_2 - a_2 * b_1
    return (b_1 * c_2 - b_2 * c_1, determinant), (a_2 * c_1 - a_1 * c_2, determinant)


def _equation(left: Node, right: Node) -> nodes.Equation:
    return nodes.Equation((left, right))


def _squared(node: Node) -> Node:
    """Return the square of a node, whatever its sign."""
    return nodes.Power(node.node if isinstance(node, Negative) else node, Integer(2))


def _plus(first: Node, second: Node, sign: int) -> Node:
    return Sum((first, second if sign > 0 else Negative(second)))


_T = Generic("t")
_T_SQUARED = nodes.Power(_T, Integer(2))
_UNIT = nodes.Number(Integer(1))
_QUOTIENT_C = nodes.Fraction(Sum((_UNIT, Negative(_T_SQUARED))), Sum((_UNIT, _T_SQUARED)))
_QUOTIENT_S = nodes.Fraction(
    nodes.Product((nodes.Number(Integer(2)), _T)), Sum((_UNIT, _T_SQUARED))
)
