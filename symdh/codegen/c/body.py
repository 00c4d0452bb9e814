"""The statements of a C function that takes its sines and cosines from the inlined kernel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from symdh.codegen.graph import Node, Op
from symdh.codegen.listing import Local
from symdh.codegen.names import Scope
from symdh.codegen.printer import Printer
from symdh.codegen.routine import Routine
from symdh.codegen.stages import Angle, cut_stages


@dataclass(frozen=True, slots=True)
class SinCos:
    """A call that fills an array with the sine and cosine of two or four angles, in turn.

    Attributes
    ----------
    array : str
        A local that is declared here.
    angles, lost : tuple of str
        The angles, and what the sums that they are have lost to rounding.
    """

    array: str
    angles: tuple[str, ...]
    lost: tuple[str, ...]

    @property
    def width(self) -> int:
        """Number of angles: 2 or 4."""
        return len(self.angles)


@dataclass(frozen=True, slots=True)
class PackLocal:
    """A local that has a value for each pose of a pack."""

    name: str
    text: str
    is_pack: bool = True


@dataclass(frozen=True, slots=True)
class PackSinCos:
    """Sine and cosine of an angle that has a value for each pose of a pack.

    Attributes
    ----------
    angle : str
    lost : str or None
        What the angle, a sum, has lost to rounding.
    sine, cosine : str
        Locals that are declared here.
    """

    angle: str
    lost: str | None
    sine: str
    cosine: str


Statement = Local | SinCos | PackLocal | PackSinCos


class BodyWriter:
    """Writes a routine in stages as statements of C.

    Parameters
    ----------
    stem : str
        What the names of the kernel's functions begin with.
    names : dict of Node to str
        Identifiers of what the routine reads; those of its locals are added.
    scope : Scope
        Where the locals live.
    printer : Printer
        Writes nodes with `names`.
    zero : str
        Literal of 0.
    """

    def __init__(
        self, stem: str, names: dict[Node, str], scope: Scope, printer: Printer, zero: str
    ) -> None:
        self._stem = stem
        self._names = names
        self._scope = scope
        self._printer = printer
        self._zero = zero
        self._lost: dict[Node, str] = {}

    def in_line(self, routine: Routine) -> Iterator[Statement]:
        """Write a routine with calls of the library."""
        for assignment in routine.assignments:
            self._names[assignment.node] = self._scope.take(assignment.name)
            yield self._local(assignment.node)

    def in_stages(self, routine: Routine) -> Iterator[Statement]:
        """Write a routine with calls of the kernel."""
        staged = cut_stages(routine)
        for stage in staged.stages:
            for assignment in stage.assignments:
                self._names[assignment.node] = self._scope.take(assignment.name)
                yield self._local(assignment.node)
                if assignment.node in staged.sums:
                    yield self._loss(assignment.node)
            yield from self._turned(stage.angles)

    def _local(self, node: Node) -> Statement:
        return self._assigned(node, self._names[node], self._printer.definition(node))

    def _assigned(self, node: Node, name: str, text: str) -> Statement:
        """Declare a local for what belongs to a node."""
        return Local(name, text)

    def _summand(self, total: Node, part: Node) -> str:
        return self._printer.expression(part)

    def _lost_function(self, total: Node) -> str:
        return f"{self._stem}_lost"

    def _turned(self, angles: Sequence[Angle]) -> Iterator[Statement]:
        """Take the sines and cosines of some angles."""
        for start in range(0, len(angles), 4):
            yield from self._sines_and_cosines(angles[start : start + 4])

    def _loss(self, total: Node) -> Statement:
        """Write what a sum has lost, what its parts had lost already included."""
        name = self._names[total]
        first, second = total.args
        sign = "-" if total.op is Op.SUB else "+"
        left, right = self._summand(total, first), self._summand(total, second)
        if sign == "-":
            right = f"-({right})" if " " in right else f"-{right}"
        text = f"{self._lost_function(total)}({left}, {right}, {name})"
        text += self._inherited(first, "+") + self._inherited(second, sign)
        label = name.removeprefix("angle")
        self._lost[total] = self._scope.take(f"lost{label}" if label != name else f"lost_{name}")
        return self._assigned(total, self._lost[total], text)

    def _inherited(self, part: Node, sign: str) -> str:
        """Write what a part of a sum has lost itself; the graph has no sums with a -part."""
        return f" {sign} {self._lost[part]}" if part in self._lost else ""

    def _sines_and_cosines(self, group: Sequence[Angle]) -> Iterator[Statement]:
        width = 2 if len(group) <= 2 else 4
        filled = [*group, *[group[-1]] * (width - len(group))]
        array = self._scope.take(f"sc{self._labels(group)}")
        yield SinCos(
            array,
            tuple(self._printer.expression(angle.node) for angle in filled),
            tuple(self._lost.get(angle.node, self._zero) for angle in filled),
        )
        for place, angle in enumerate(group):
            for offset, assignment in enumerate((angle.sine, angle.cosine)):
                if assignment is not None:
                    self._names[assignment.node] = self._scope.take(assignment.name)
                    element = f"{array}[{2 * place + offset}]"
                    yield Local(self._names[assignment.node], element)

    def _labels(self, group: Sequence[Angle]) -> str:
        first = group[0].sine or group[0].cosine
        assert first is not None
        return first.name[1:]


def takes_losses(statements: Sequence[Statement]) -> bool:
    """Say whether any angle is a sum."""
    return any(isinstance(s, Local) and "_lost(" in s.text for s in statements)


def widths(statements: Sequence[Statement]) -> frozenset[int]:
    """Return how many sines and cosines are taken at once, of all calls."""
    return frozenset(s.width for s in statements if isinstance(s, SinCos))
