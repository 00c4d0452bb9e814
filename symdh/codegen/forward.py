"""Robot -> routine for its forward kinematics, built motion by motion from the fused word.

Everything is multiplied from the right, so that the work grows linearly with the joints: the
orientation carries columns, the position one point.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from sympy import Expr, Symbol

from symdh.codegen.chain import Chain, levers, lower_chain
from symdh.codegen.graph import Graph, Node, Op
from symdh.codegen.routine import Output, Routine, op_counts, schedule
from symdh.codegen.vectors import Columns, Vector, cross, rotate, unit
from symdh.motion import fuse_to_turn, rotations
from symdh.robot import Robot

#: What an operation costs beside a multiplication or addition, as libm and the hardware have it.
_COSTS = {Op.ADD: 1, Op.SUB: 1, Op.MUL: 1, Op.DIV: 4}
_CALL_COST = 20


def forward_routine(
    robot: Robot, values: Mapping[Symbol, Expr] | None = None, *, splits_sums: bool = False
) -> Routine:
    """Build the routine of a robot's pose, base to tool.

    Parameters
    ----------
    robot : Robot
    values : mapping of Symbol to Expr, optional
        Exact numbers to put in for some parameters; what they make zero or a right angle vanishes.
    splits_sums : bool
        Whether sines and cosines of sums are made of those of their terms (see `Lowering`).

    Returns
    -------
    Routine
        12 outputs of T: r11 .. r33, px, py, pz, row by row.

    Raises
    ------
    UnsupportedError
        When the table holds something that has no code.
    """
    chain = lower_chain(robot, values, splits_sums=splits_sums)
    point = end_point(chain)
    columns = cheapest(chain.graph, [columns_from_right(chain)], point)
    return schedule(pose_outputs(columns, point), chain.lowering.names)


def end_point(chain: Chain) -> Vector:
    """Return the origin of the last frame."""
    zero = chain.graph.zero
    return levers(chain)[0][0] if chain.runs else (zero, zero, zero)


def columns_from_right(chain: Chain) -> Columns:
    """Return the orientation of the last frame, each column multiplied out from the right.

    Rotations fuse among themselves, so this word is shorter than the pose's.
    """
    graph = chain.graph
    motions, turn = fuse_to_turn(rotations(chain.word))
    turned = [(motion.axis, chain.lowering.cos_sin(motion.amount)) for motion in motions]
    columns = []
    for axis, sign in turn.images:
        column = unit(graph, axis, sign)
        for axis_of_rotation, cos_sin in reversed(turned):
            column = rotate(graph, axis_of_rotation, cos_sin, column)
        columns.append(column)
    x, y, z = columns
    return x, y, z


def cheapest(graph: Graph, candidates: Iterable[Columns], *beside: Vector) -> Columns:
    """Choose the columns of an orientation that take the least work beside other vectors.

    Each candidate is tried as it is, and with one column as the cross product of the two others.
    """
    tried = [choice for columns in candidates for choice in _with_one_crossed(graph, columns)]
    return min(tried, key=lambda columns: _cost([*columns, *beside]))


def _with_one_crossed(graph: Graph, columns: Columns) -> Iterator[Columns]:
    x, y, z = columns
    yield columns
    yield cross(graph, y, z), y, z
    yield x, cross(graph, z, x), z
    yield x, y, cross(graph, x, y)


def _cost(vectors: Sequence[Vector]) -> int:
    counts = op_counts(entry for vector in vectors for entry in vector)
    return sum(_COSTS.get(op, _CALL_COST) * count for op, count in counts.items())


def pose_outputs(columns: Columns, point: Vector) -> list[Output]:
    """Name the 12 entries of a pose, row by row."""
    outputs = []
    for row in range(3):
        for column in range(3):
            name = f"r{row + 1}{column + 1}"
            outputs.append(_pose_entry(name, row, column, columns[column][row]))
        outputs.append(_pose_entry("p" + "xyz"[row], row, 3, point[row]))
    return outputs


def _pose_entry(name: str, row: int, column: int, node: Node) -> Output:
    return Output("T", name, row, column, node)
