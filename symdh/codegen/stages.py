"""A routine cut where sines and cosines are taken, so that a target can take several at once.

Sums of angles round: at 1e6 rad a sum of two is off by 1e-10 rad. What a sum loses is known exactly
(Knuth's two-sum), and a sine that takes it in is as good at 1e6 rad as at 1. So every sum that an
angle is made of gets a name here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import count

from symdh.codegen.graph import Node, Op
from symdh.codegen.routine import Assignment, Routine, reachable

_TRIGONOMETRIC = (Op.SIN, Op.COS)
_SUMS = (Op.ADD, Op.SUB)


@dataclass(frozen=True, slots=True)
class Angle:
    """An angle whose sine and cosine are wanted; one of the two may not be."""

    node: Node
    sine: Assignment | None
    cosine: Assignment | None


@dataclass(frozen=True, slots=True)
class Stage:
    """Assignments without sines and cosines, then the angles that can be turned into those.

    Attributes
    ----------
    assignments : tuple of Assignment
    angles : tuple of Angle
        What they are made of is assigned in this stage or before; none in the last stage.
    """

    assignments: tuple[Assignment, ...]
    angles: tuple[Angle, ...]


@dataclass(frozen=True)
class StagedRoutine:
    """A routine in stages.

    Attributes
    ----------
    routine : Routine
    stages : tuple of Stage
    sums : frozenset of Node
        The sums that angles are made of; each is assigned.
    """

    routine: Routine
    stages: tuple[Stage, ...]
    sums: frozenset[Node]


def cut_stages(routine: Routine) -> StagedRoutine:
    """Cut a routine where sines and cosines are taken."""
    nodes = reachable(output.node for output in routine.outputs)
    calls = [node for node in nodes if node.op in _TRIGONOMETRIC]
    sums = frozenset(part for call in calls for part in _sums_of(call.args[0]))
    assignments = _with_sums_assigned(routine, calls, sums)
    levels = _levels(nodes)
    stages = []
    for level in range(max(levels.values(), default=0) + 1):
        plain = tuple(
            a for a in assignments if levels[a.node] == level and a.node.op not in _TRIGONOMETRIC
        )
        taken = [
            a for a in assignments if levels[a.node] == level + 1 and a.node.op in _TRIGONOMETRIC
        ]
        stages.append(Stage(plain, _angles(taken)))
    return StagedRoutine(routine, tuple(stages), sums)


def _sums_of(node: Node) -> Iterator[Node]:
    if node.op in _SUMS:
        yield node
    if node.op in _SUMS or node.op is Op.NEG:
        for arg in node.args:
            yield from _sums_of(arg)


def _with_sums_assigned(
    routine: Routine, calls: Sequence[Node], sums: frozenset[Node]
) -> list[Assignment]:
    """Return the assignments of a routine and those of the sums, in the order of their nodes."""
    named = {assignment.node: assignment.name for assignment in routine.assignments}
    for call in calls:
        if call.args[0] in sums:
            # c23 and s23 are those of angle23.
            named.setdefault(call.args[0], f"angle{named[call][1:]}")
    parts = (f"part{number}" for number in count(1))
    for part in sorted(sums, key=lambda node: node.index):
        if part not in named:
            named[part] = next(parts)
    return [Assignment(name, node) for node, name in sorted(named.items(), key=_place)]


def _place(item: tuple[Node, str]) -> int:
    return item[0].index


def _levels(nodes: Sequence[Node]) -> dict[Node, int]:
    """Return how many sines or cosines, one inside the other, each node is made of."""
    levels: dict[Node, int] = {}
    for node in nodes:
        inside = max((levels[arg] for arg in node.args), default=0)
        levels[node] = inside + (node.op in _TRIGONOMETRIC)
    return levels


def _angles(taken: Sequence[Assignment]) -> tuple[Angle, ...]:
    """Pair the sines and cosines of one angle, in the order in which the angles come up."""
    found: dict[Node, dict[Op, Assignment]] = {}
    for assignment in taken:
        found.setdefault(assignment.node.args[0], {})[assignment.node.op] = assignment
    return tuple(Angle(node, both.get(Op.SIN), both.get(Op.COS)) for node, both in found.items())
