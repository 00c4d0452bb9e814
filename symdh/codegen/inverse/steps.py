"""The steps of a closed form -> what they compute, in nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from sympy import Dummy, Expr, Symbol

from symdh.codegen.graph import Graph, Node, Op
from symdh.codegen.inverse.letters import Letters, letters_of
from symdh.codegen.inverse.polynomials import Polynomials
from symdh.codegen.inverse.program import Kind
from symdh.codegen.inverse.trigonometric import Trigonometry
from symdh.codegen.labels import angle_label
from symdh.codegen.lowering import Lowering
from symdh.codegen.names import comment_text
from symdh.codegen.routine import reachable
from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.kinematics.inverse.solution import ClosedForm, Rule, Step

#: How code finds the unknown of a rule; names and sums of what is known find none.
KINDS = {
    Rule.RATIO: Kind.LINE,
    Rule.SINE: Kind.LINE,
    Rule.COSINE: Kind.LINE,
    Rule.SINE_COSINE: Kind.LINE,
    Rule.PAIR: Kind.PAIR,
    Rule.SLIDE: Kind.SLIDE,
    Rule.SLIDE_SQUARE: Kind.SQUARE,
    Rule.HALF_ANGLE: Kind.ROOTS,
}
#: The coefficients that must not vanish.
_DECIDING = {Kind.LINE: (0, 1), Kind.PAIR: (0, 1, 3, 4), Kind.SLIDE: (0,), Kind.SQUARE: (0,)}
#: A step with more equations that stand by keeps these.
_MOST_OPTIONS = 3


@dataclass(frozen=True, slots=True)
class Equations:
    """Coefficients and scales of what gives an unknown, as `program.Option` has them."""

    coefficients: tuple[Node, ...]
    scales: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Found:
    """An unknown that is solved for; the fields are those of `program.Solve`."""

    kind: Kind
    name: str
    label: str
    options: tuple[Equations, ...]
    results: tuple[Node, ...]
    seed: tuple[tuple[int, int], ...]
    place: int
    opens: bool


@dataclass(frozen=True)
class LoweredSteps:
    """The steps of a closed form in nodes.

    Attributes
    ----------
    found : tuple of Found
        Sums of angles and names for known parts are nodes like any other and are not among them.
    values : tuple of Node
        The joint variables in chain order.
    letters : Letters
    names : dict of Node to str
        Readable names of nodes.
    """

    found: tuple[Found, ...]
    values: tuple[Node, ...]
    letters: Letters
    names: dict[Node, str]


def lower_steps(form: ClosedForm, known: Mapping[Symbol, Expr]) -> LoweredSteps:
    """Turn the steps of a closed form into nodes."""
    return _Steps(form, known).lowered()


class _Steps:
    def __init__(self, form: ClosedForm, known: Mapping[Symbol, Expr]) -> None:
        self._form, self._ring = form, form.ring
        robot = form.arm.given
        self._rows = {j.variable: i for i, j in enumerate(robot.joints, 1) if j.variable}
        self._places = {variable: k for k, variable in enumerate(robot.variables)}
        self._graph = Graph()
        lowering = Lowering(self._graph, self._rows)
        self._letters = letters_of(form, lowering, known)
        self._names = lowering.names
        sizes = dict.fromkeys(_lengths(form.ring), self._letters.reach)
        self._polynomials = Polynomials(
            self._graph, self._letters.nodes, form.ring.first_lengths, sizes
        )
        self._values: dict[int, Node] = {}

    def lowered(self) -> LoweredSteps:
        found = [one for step in self._form.steps if (one := self._step(step)) is not None]
        robot, ring = self._form.arm.given, self._ring
        unknown = {robot.joints[row - 1].variable: ring.unknown_of(row) for row in self._moving}
        values = tuple(
            self._values[unknown[v]] if v in unknown else self._graph.symbol(v)
            for v in robot.variables
        )
        return LoweredSteps(tuple(found), values, self._letters, self._names)

    @property
    def _moving(self) -> tuple[int, ...]:
        return self._form.arm.moving

    def _step(self, step: Step) -> Found | None:
        if step.rule is Rule.NAMES:
            for generator, element in step.definitions:
                node = self._polynomials.node(element)
                self._letters.nodes[generator] = node
                self._name(node, str(self._ring.letters[generator]))
            return None
        if step.rule is Rule.SUM:
            self._sum(step)
            return None
        return self._found(step)

    def _sum(self, step: Step) -> None:
        """Give a sum its value, its cosine and its sine from those of its parts."""
        graph, letters = self._graph, self._letters.nodes
        cosine, sine, value = graph.one, graph.zero, graph.zero
        for sign, part in step.parts:
            c, s = letters[2 * part], letters[2 * part + 1]
            assert c is not None
            assert s is not None
            signed = s if sign > 0 else graph.neg(s)
            cosine, sine = (
                graph.sub(graph.mul(cosine, c), graph.mul(sine, signed)),
                graph.add(graph.mul(sine, c), graph.mul(cosine, signed)),
            )
            own = self._values[part]
            value = graph.add(value, own if sign > 0 else graph.neg(own))
        self._give(step.unknown, cosine, sine, value)

    def _give(self, unknown: int, cosine: Node, sine: Node, value: Node) -> None:
        label = self._label(unknown)
        self._letters.nodes[2 * unknown : 2 * unknown + 2] = [cosine, sine]
        self._values[unknown] = value
        for node, name in ((cosine, "c"), (sine, "s"), (value, "angle")):
            self._name(node, name + label)

    def _found(self, step: Step) -> Found:
        kind = KINDS[step.rule]
        # Before the results have nodes: an equation cannot hold what it is to give.
        options = self._options(step, kind)
        ring, graph = self._ring, self._graph
        label = self._label(step.unknown)
        results: tuple[Node, ...]
        if ring.is_angle(step.unknown):
            results = graph.symbol(Dummy(f"c{label}")), graph.symbol(Dummy(f"s{label}"))
            self._give(step.unknown, *results, graph.call(Op.ATAN2, *reversed(results)))
            seed = tuple((sign, self._place(row)) for row, sign in ring.forms[step.unknown])
        else:
            results = (graph.symbol(Dummy(f"x{label}")),)
            self._letters.nodes[ring.slide_gen(step.unknown)] = results[0]
            self._values[step.unknown] = results[0]
            seed = ((1, self._place(ring.slides[step.unknown - len(ring.forms)])),)
        place = seed[-1][1]
        opens = step.branches > 1
        return Found(kind, self._spelt(seed), label, options, results, seed, place, opens)

    def _options(self, step: Step, kind: Kind) -> tuple[Equations, ...]:
        if kind is Kind.ROOTS:
            return (self._roots(step),)
        first = self._equations(kind, step.coefficients)
        if self._is_constant(kind, first):
            # As well conditioned at one pose as at any other.
            return (first,)
        others = step.alternatives[: _MOST_OPTIONS - 1]
        return (first, *(self._equations(kind, coefficients) for coefficients in others))

    def _is_constant(self, kind: Kind, equations: Equations) -> bool:
        """Say whether what is divided by depends on the table alone."""
        deciding = [equations.coefficients[k] for k in _DECIDING[kind]]
        parameters = set(self._form.arm.given.parameters)
        return all(node.exact in parameters for node in reachable(deciding) if node.op is Op.SYMBOL)

    def _equations(self, kind: Kind, elements: tuple[Element, ...]) -> Equations:
        graph, size = self._graph, self._polynomials.size
        nodes = tuple(self._polynomials.node(element) for element in elements)
        assert kind is not Kind.ROOTS, "these are eliminated first"
        match kind:
            case Kind.PAIR:
                first = graph.add(size(elements[0]), size(elements[1]))
                second = graph.add(size(elements[3]), size(elements[4]))
                return Equations(nodes, (graph.mul(first, second),))
            case Kind.SLIDE:
                return Equations(nodes, (size(elements[0]),))
            case Kind.SQUARE:
                return Equations(nodes, (size(elements[2]),))
            case Kind.LINE:
                both = graph.add(size(elements[0]), size(elements[1]))
                return Equations(nodes, (both, graph.add(both, size(elements[2]))))

    def _roots(self, step: Step) -> Equations:
        trigonometry = Trigonometry(self._polynomials)
        parts = tuple(trigonometry.of(e, step.unknown) for e in step.coefficients)
        scales = tuple(self._polynomials.node(scale) for scale in step.scales)
        left = trigonometry.eliminated(parts, scales)
        return Equations(trigonometry.real(left, 2), ())

    def _label(self, unknown: int) -> str:
        expression = self._ring.unknown_expression(unknown)
        terms = list(expression.as_ordered_terms())
        terms.sort(key=lambda term: min(self._rows[s] for s in term.free_symbols))
        return angle_label(terms, self._rows)

    def _place(self, row: int) -> int:
        variable = self._form.arm.given.joints[row - 1].variable
        assert variable is not None
        return self._places[variable]

    def _spelt(self, seed: tuple[tuple[int, int], ...]) -> str:
        """Return a sum of joint variables for a comment."""
        names = [comment_text(variable.name) for variable in self._form.arm.given.variables]
        text = "".join(f" {'+' if sign > 0 else '-'} {names[place]}" for sign, place in seed)
        return text.removeprefix(" + ").strip()

    def _name(self, node: Node, name: str) -> None:
        if node.op is not Op.NEG:
            self._names.setdefault(node, name.replace("_", ""))


def _lengths(ring: InverseRing) -> Iterator[int]:
    """Yield the generators that are lengths and no numbers of the table."""
    yield from range(2 * len(ring.forms), ring.first_goal)
    # The goal is nine entries of a rotation and w and u; a named part nine and a position.
    yield from range(ring.first_goal + 9, ring.first_goal + 15)
    for first in range(ring.first_name, len(ring.letters), 12):
        yield from range(first + 9, first + 12)
