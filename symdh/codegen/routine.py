"""Straight-line programs: an ordered list of assignments, without branches or loops."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count

from symdh.codegen.graph import LEAVES, Node, Op

#: Nodes that never get a name: leaves have one, and a change of sign is written where it is used.
_UNNAMED = LEAVES | {Op.NEG}

#: Operations that one line of code may hold before a part of it gets a line of its own.
_LINE = 5


@dataclass(frozen=True, slots=True)
class Output:
    """An entry of a result: the matrix (T, J), its name (r11, px), its place, and its value."""

    matrix: str
    name: str
    row: int
    column: int
    node: Node


@dataclass(frozen=True, slots=True)
class Assignment:
    """A local value that gets a name, because it is used twice or would make a line too long.

    The name is a wish: a target changes it where its language, or a symbol, has taken it.
    """

    name: str
    node: Node


@dataclass(frozen=True)
class Routine:
    """A straight-line program in no particular language.

    Attributes
    ----------
    inputs : tuple of Node
        The joint variables and parameters that the program reads.
    assignments : tuple of Assignment
        In order: each uses inputs and what is assigned above it.
    outputs : tuple of Output
        What is not among them is constant: the last row of a pose, say.
    """

    inputs: tuple[Node, ...]
    assignments: tuple[Assignment, ...]
    outputs: tuple[Output, ...]

    def op_counts(self) -> dict[Op, int]:
        """Count the operations that one call makes, changes of sign aside."""
        return op_counts(output.node for output in self.outputs)


def schedule(outputs: Sequence[Output], names: Mapping[Node, str]) -> Routine:
    """Order the nodes that some outputs need, and give names to those that want one.

    Parameters
    ----------
    outputs : sequence of Output
    names : mapping of Node to str
        Readable names; they need not be unique, nor be there at all.
    """
    needed = reachable(output.node for output in outputs)
    # Of several outputs with one value, the first gives the name.
    readable = {**{output.node: output.name for output in reversed(outputs)}, **names}
    temporary = (f"t{number}" for number in count(1))
    assignments = tuple(
        Assignment(readable.get(node) or next(temporary), node)
        for node in _to_be_named(needed, outputs)
    )
    inputs = tuple(node for node in needed if node.op is Op.SYMBOL)
    return Routine(inputs, assignments, tuple(outputs))


def reachable(roots: Iterable[Node], there: Container[Node] = ()) -> list[Node]:
    """Return every node that some nodes need, themselves included, arguments first.

    What is `there` already is returned too, and what it needs is not.
    """
    seen: dict[int, Node] = {}
    waiting = list(roots)
    while waiting:
        node = waiting.pop()
        if node.index not in seen:
            seen[node.index] = node
            if node not in there:
                waiting.extend(node.args)
    return [seen[index] for index in sorted(seen)]


def op_counts(roots: Iterable[Node]) -> dict[Op, int]:
    """Count the operations that computing some nodes takes, changes of sign aside."""
    counts = Counter(node.op for node in reachable(roots))
    return {op: counts[op] for op in Op if counts[op] and op not in _UNNAMED}


def _to_be_named(needed: Sequence[Node], outputs: Sequence[Output]) -> Iterator[Node]:
    last = {output.node for output in outputs}
    uses = count_uses(needed, [output.node for output in outputs])
    sizes: dict[Node, int] = {}
    for node in needed:
        size = sum(sizes[arg] for arg in node.args) + (node.op not in _UNNAMED)
        too_long = size >= _LINE and node not in last
        wanted = uses[node] > 1 or too_long or node.op in (Op.SIN, Op.COS)
        if wanted and node.op not in _UNNAMED:
            yield node
            size = 0
        sizes[node] = size


def count_uses(needed: Sequence[Node], roots: Iterable[Node]) -> Counter[Node]:
    """Count how often each node is written, a change of sign as often as what it changes."""
    uses = Counter(roots)
    for node in reversed(needed):
        times = uses[node] if node.op is Op.NEG else 1
        for arg in node.args:
            uses[arg] += times
    return uses
