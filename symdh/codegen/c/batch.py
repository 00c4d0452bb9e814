"""The statements of a C function that works on a pack of poses at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from symdh.codegen.c.body import BodyWriter, PackLocal, PackSinCos, Statement
from symdh.codegen.graph import Node, Op
from symdh.codegen.listing import Local
from symdh.codegen.names import Scope
from symdh.codegen.printer import Printer
from symdh.codegen.routine import Routine, reachable
from symdh.codegen.stages import Angle
from symdh.errors import UnsupportedError

#: What can be done to all poses of a pack at once.
_FOR_PACKS = frozenset({Op.ADD, Op.SUB, Op.MUL, Op.DIV, Op.NEG, Op.SIN, Op.COS})


@dataclass(frozen=True, slots=True)
class PackEntry:
    """An entry of the pose: its row by row place, its text, and whether poses differ in it."""

    place: int
    text: str
    varies: bool


@dataclass(frozen=True)
class Batch:
    """What the template of the batch functions is filled with.

    Attributes
    ----------
    soa_head, aos_head : str
        Heads of the functions, for a structure of arrays and an array of poses.
    body : PackBody or None
        None where sines and cosines are not inlined: then poses are taken one by one.
    reads : tuple of (int, str)
        Place in ``q`` and identifier of the joint variables that the body reads.
    unread : tuple of str
        Arguments that it never reads.
    """

    soa_head: str
    aos_head: str
    body: PackBody | None
    reads: tuple[tuple[int, str], ...]
    unread: tuple[str, ...]


@dataclass(frozen=True)
class PackBody:
    """A pose for a pack of joint values.

    Attributes
    ----------
    statements : tuple of Statement
    angles : tuple of str
        Those that the kernel is given; whoever calls it has to see that they are not too large.
    entries : tuple of PackEntry
        The 12 entries of the first three rows.
    """

    statements: tuple[Statement, ...]
    angles: tuple[str, ...]
    entries: tuple[PackEntry, ...]

    @property
    def loses(self) -> bool:
        """Whether any angle is a sum."""
        return any(s.lost is not None for s in self.statements if isinstance(s, PackSinCos))


class PackWriter(BodyWriter):
    """Writes the routine of a pose for packs.

    Parameters
    ----------
    stem, names, scope, printer, zero
        As for `BodyWriter`.
    varying : sequence of Node
        Inputs that each pose has its own of: the joint variables.
    """

    def __init__(
        self,
        stem: str,
        names: dict[Node, str],
        scope: Scope,
        printer: Printer,
        zero: str,
        varying: Sequence[Node],
    ) -> None:
        super().__init__(stem, names, scope, printer, zero)
        self._varying = set(varying)

    def body(self, routine: Routine) -> PackBody:
        """Write all of it.

        Raises
        ------
        UnsupportedError
            When a joint variable stands in a function of its own.
        """
        for node in reachable(output.node for output in routine.outputs):
            if any(arg in self._varying for arg in node.args):
                if node.op not in _FOR_PACKS:
                    raise UnsupportedError(f"{node.op.value} of a joint variable has no batch form")
                self._varying.add(node)
        statements = tuple(self.in_stages(routine))
        return PackBody(
            statements,
            tuple(s.angle for s in statements if isinstance(s, PackSinCos)),
            tuple(
                PackEntry(
                    4 * output.row + output.column,
                    self._printer.expression(output.node),
                    output.node in self._varying,
                )
                for output in routine.outputs
            ),
        )

    def _assigned(self, node: Node, name: str, text: str) -> Statement:
        return PackLocal(name, text) if node in self._varying else Local(name, text)

    def _summand(self, total: Node, part: Node) -> str:
        text = self._printer.expression(part)
        same = total not in self._varying or part in self._varying
        return text if same else f"{self._stem}_spread({text})"

    def _lost_function(self, total: Node) -> str:
        return f"{self._stem}_{'lost_wide' if total in self._varying else 'lost'}"

    def _turned(self, angles: Sequence[Angle]) -> Iterator[Statement]:
        for angle in angles:
            both = (angle.sine, angle.cosine)
            if angle.node not in self._varying:
                for assignment in both:
                    if assignment is not None:
                        self._names[assignment.node] = self._scope.take(assignment.name)
                        yield self._local(assignment.node)
                continue
            names = []
            label = next(a.name[1:] for a in both if a is not None)
            for letter, assignment in zip("sc", both, strict=True):
                names.append(self._scope.take(f"{letter}{label}"))
                if assignment is not None:
                    self._names[assignment.node] = names[-1]
            lost = self._lost.get(angle.node)
            yield PackSinCos(self._printer.expression(angle.node), lost, *names)
