"""Where the values of a program are computed: as far out as they can be, and only when needed.

What does not depend on the branches of a loop is computed before the loop; what an equation needs
that only stands by is computed when it is its turn.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import count

from symdh.codegen.graph import LEAVES, Node, Op
from symdh.codegen.inverse.program import Compute, Option, Propose, Solve, Statement
from symdh.codegen.inverse.steps import Equations, Found, LoweredSteps
from symdh.codegen.routine import Assignment, count_uses, reachable

#: Operations that one line of code may hold before a part of it gets a line of its own.
_LINE = 5
_UNNAMED = LEAVES | {Op.NEG}


def placed(lowered: LoweredSteps) -> tuple[Statement, ...]:
    """Return the statements of a program."""
    return tuple(_Placing(lowered).statements())


class _Placing:
    """Places nodes before statements; statement k is the k-th unknown, the last one proposes."""

    def __init__(self, lowered: LoweredSteps) -> None:
        self._lowered = lowered
        self._temporary = (f"t{number}" for number in count(1))
        self._depths = list(_depths(lowered.found))
        self._openers = [k for k, one in enumerate(lowered.found) if one.opens]
        roots = [_mandatory(one) for one in lowered.found] + [lowered.values]
        self._needed = reachable(node for nodes in roots for node in nodes)
        self._node_depths = self._depths_of(self._needed)
        self._places, self._uses = self._placed(roots)
        self._named = self._to_be_named()

    def statements(self) -> Iterator[Statement]:
        """Yield the statements in order."""
        by_place: dict[int, list[Assignment]] = {}
        for node in self._named:
            assignment = Assignment(self._name(node), node)
            by_place.setdefault(self._places[node], []).append(assignment)
        for k, depth in enumerate(self._depths):
            if k in by_place:
                yield Compute(depth, tuple(by_place[k]))
            if k < len(self._lowered.found):
                yield self._solve(k, depth, self._lowered.found[k])
            else:
                yield Propose(depth, self._lowered.values)

    def _solve(self, k: int, depth: int, one: Found) -> Solve:
        first, *others = one.options
        options = [Option((), first.coefficients, first.scales)]
        options += [self._option(k, option) for option in others]
        return Solve(
            depth,
            one.kind,
            one.name,
            one.label,
            tuple(options),
            one.results,
            one.seed,
            one.place,
            one.opens,
        )

    def _option(self, k: int, option: Equations) -> Option:
        """Give names to what an option needs and nobody has computed yet."""
        there = {node for node in self._named if self._places[node] <= k}
        roots = (*option.coefficients, *option.scales)
        needed = [node for node in reachable(roots, there) if node not in there]
        uses = count_uses(needed, roots)
        assignments = []
        sizes: dict[Node, int] = dict.fromkeys(there, 0)
        for node in needed:
            sizes[node] = _size(node, sizes)
            is_long = sizes[node] >= _LINE
            if node.op not in _UNNAMED and (uses[node] > 1 or is_long):
                assignments.append(Assignment(self._name(node), node))
                sizes[node] = 0
        return Option(tuple(assignments), option.coefficients, option.scales)

    def _name(self, node: Node) -> str:
        return self._lowered.names.get(node) or next(self._temporary)

    def _depths_of(self, nodes: Sequence[Node]) -> dict[Node, int]:
        """Return how many loops each node is inside of."""
        symbols = {
            node: depth + one.opens
            for one, depth in zip(self._lowered.found, self._depths, strict=False)
            for node in one.results
        }
        depths: dict[Node, int] = {}
        for node in nodes:
            inner = max((depths[arg] for arg in node.args), default=0)
            depths[node] = symbols.get(node, inner)
        return depths

    def _placed(self, roots: Sequence[Sequence[Node]]) -> tuple[dict[Node, int], Counter[Node]]:
        """Return before which statement each node is computed, and how often it is written."""
        places: dict[Node, int] = {}
        uses: Counter[Node] = Counter()
        for k, nodes in enumerate(roots):
            for node in nodes:
                uses[node] += 1
                self._use(places, node, k)
        for node in reversed(self._needed):
            times = uses[node] if node.op is Op.NEG else 1
            for arg in node.args:
                uses[arg] += times
                self._use(places, arg, places[node])
        return places, uses

    def _use(self, places: dict[Node, int], node: Node, k: int) -> None:
        depth = self._node_depths[node]
        own = k if self._depths[k] == depth else self._openers[depth]
        places[node] = min(own, places.get(node, own))

    def _to_be_named(self) -> list[Node]:
        """Return what is used twice, would make a line too long, or is moved out of a loop."""
        moved_out = {
            arg
            for node in self._needed
            for arg in node.args
            if self._places[arg] < self._places[node]
        }
        for k, one in enumerate(self._lowered.found):
            moved_out |= {node for node in _mandatory(one) if self._places[node] < k}
        last = len(self._depths) - 1
        moved_out |= {node for node in self._lowered.values if self._places[node] < last}
        # A change of sign has no name; what it changes is what is moved.
        moved_out |= {node.args[0] for node in moved_out if node.op is Op.NEG}
        sizes: dict[Node, int] = {}
        named = []
        for node in self._needed:
            sizes[node] = _size(node, sizes)
            wanted = self._uses[node] > 1 or sizes[node] >= _LINE or node in moved_out
            if node.op not in _UNNAMED and (wanted or node.op is Op.ATAN2):
                named.append(node)
                sizes[node] = 0
        return named


def _depths(found: Sequence[Found]) -> Iterator[int]:
    """Yield how many loops each statement is inside of, the one that proposes included."""
    depth = 0
    for one in found:
        yield depth
        depth += one.opens
    yield depth


def _mandatory(one: Found) -> tuple[Node, ...]:
    first = one.options[0]
    return (*first.coefficients, *first.scales)


def _size(node: Node, sizes: dict[Node, int]) -> int:
    return sum(sizes[arg] for arg in node.args) + (node.op not in _UNNAMED)
