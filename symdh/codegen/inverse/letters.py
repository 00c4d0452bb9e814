"""What the letters of an arm's ring stand for, as nodes: the goal and the numbers of the table."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from sympy import Dummy, Expr, Symbol

from symdh.codegen.graph import Graph, Node
from symdh.codegen.inverse.polynomials import magnitude
from symdh.codegen.lowering import Lowering
from symdh.kinematics.chain import chain_word
from symdh.kinematics.inverse.solution import ClosedForm
from symdh.motion import Word, is_rotation
from symdh.motion.matrices import inverse_transform

Matrix = list[list[Node]]


@dataclass(frozen=True)
class Letters:
    """The nodes that the generators of the ring start with.

    Attributes
    ----------
    nodes : list of Node or None
        One for each generator; None for unknowns and for names that steps give.
    goal : tuple of Node
        Symbols for the twelve entries of the pose that is asked for, row by row.
    reach : Node
        The sum of the lengths of the arm, 1 where it has none.
    """

    nodes: list[Node | None]
    goal: tuple[Node, ...]
    reach: Node


def letters_of(form: ClosedForm, lowering: Lowering, known: Mapping[Symbol, Expr]) -> Letters:
    """Lower the goal and the numbers that a closed form starts from.

    Parameters
    ----------
    form : ClosedForm
    lowering : Lowering
    known : mapping of Symbol to Expr
        Exact numbers to put in for some parameters.
    """
    ring, arm, graph = form.ring, form.arm, lowering.graph

    def number(expression: Expr) -> Node:
        return lowering.node(expression.xreplace(dict(arm.meanings)).xreplace(dict(known)))

    names = [f"r{r}{c}" if c < 4 else f"p{'xyz'[r - 1]}" for r in (1, 2, 3) for c in (1, 2, 3, 4)]
    goal = tuple(graph.symbol(Dummy(name)) for name in names)
    pose = [list(goal[4 * r : 4 * r + 4]) for r in range(3)]
    inner = pose
    if arm.given.base and not arm.base_inside:
        inner = _product(graph, _end(arm.given.base, number), pose)
    if arm.given.tool and form.task.whole_pose:
        inner = _product(graph, inner, _end(arm.given.tool, number))
    front, hand = [[number(part) for part in offset] for offset in (arm.front, arm.hand)]
    columns = [[inner[r][c] for r in range(3)] for c in range(3)]
    w = []
    for r in range(3):
        arm_only = graph.sub(inner[r][3], front[r])
        w.append(graph.sub(arm_only, _dot(graph, [inner[r][c] for c in range(3)], hand)))
    u = [graph.neg(_dot(graph, columns[c], w)) for c in range(3)]
    nodes: list[Node | None] = [None] * len(ring.letters)
    values = [entry for column in columns for entry in column] + w + u
    nodes[ring.first_goal : ring.first_goal + len(values)] = values
    for k in ring.first_lengths:
        nodes[k] = number(ring.letters[k])
    return Letters(nodes, goal, _reach(form, lowering, known))


def _reach(form: ClosedForm, lowering: Lowering, known: Mapping[Symbol, Expr]) -> Node:
    graph, robot = lowering.graph, form.arm.given
    still = dict.fromkeys(robot.variables, 0)
    total = graph.zero
    for motion in chain_word(robot, "base", "tool"):
        if not is_rotation(motion):
            length = motion.amount.subs(still).xreplace(dict(known))
            total = graph.add(total, magnitude(graph, lowering.node(length)))
    return graph.one if total is graph.zero else total


def _end(word: Word, number: Callable[[Expr], Node]) -> Matrix:
    """Return the inverse pose of the base or of the tool, three rows of four."""
    matrix = inverse_transform(word)
    return [[number(matrix[r, c]) for c in range(4)] for r in range(3)]


def _product(graph: Graph, a: Matrix, b: Matrix) -> Matrix:
    result = []
    for row in a:
        entries = [_dot(graph, row[:3], [b[k][c] for k in range(3)]) for c in range(4)]
        entries[3] = graph.add(entries[3], row[3])
        result.append(entries)
    return result


def _dot(graph: Graph, a: Sequence[Node], b: Sequence[Node]) -> Node:
    total = graph.zero
    for x, y in zip(a, b, strict=True):
        total = graph.add(total, graph.mul(x, y))
    return total
