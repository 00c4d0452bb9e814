"""Robot -> routine for its geometric Jacobian, alone or with the pose, sharing all they can.

The column of a joint that turns about axis k of a run is ``[z x l; z]``, with z the k-th column of
the orientation R before the run and l the lever from the joint to the end of the arm. In the run's
own axes ``e_k x l`` has two entries, so ``R (e_k x l)`` takes two columns of R and no cross
product. The column of a joint that slides is ``[z; 0]``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from sympy import Expr, Symbol

from symdh.codegen.chain import Chain, LoweredRun, levers, lower_chain, orientations
from symdh.codegen.forward import cheapest, columns_from_right, end_point, pose_outputs
from symdh.codegen.graph import Graph
from symdh.codegen.routine import Output, Routine, schedule
from symdh.codegen.vectors import Columns, Vector, combine, others, rotate, scale, unit, vector
from symdh.motion import is_rotation
from symdh.motion.turn import Turn
from symdh.robot import Motion, Robot


@dataclass(frozen=True, slots=True)
class JacobianColumn:
    """What the rate of one joint variable adds to the velocity of the last frame."""

    variable: Symbol
    linear: Vector
    angular: Vector


def jacobian_routine(
    robot: Robot, values: Mapping[Symbol, Expr] | None = None, *, splits_sums: bool = False
) -> Routine:
    """Build the routine of a robot's Jacobian.

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
        6 n outputs of J, row by row: the velocity of the origin of the last frame, tool included,
        then the angular velocity, both along the axes of the first frame, base included.

    Raises
    ------
    UnsupportedError
        When the table holds something that has no code.
    """
    chain = lower_chain(robot, values, splits_sums=splits_sums)
    columns = _columns(chain, robot, orientations(chain))
    return schedule(_outputs(robot, columns), chain.lowering.names)


def forward_jacobian_routine(
    robot: Robot, values: Mapping[Symbol, Expr] | None = None, *, splits_sums: bool = False
) -> Routine:
    """Build the routine of a robot's pose and Jacobian together.

    Parameters, exceptions : as `jacobian_routine`.

    Returns
    -------
    Routine
        The outputs of T, then those of J.
    """
    chain = lower_chain(robot, values, splits_sums=splits_sums)
    frames = orientations(chain)
    columns = _columns(chain, robot, frames)
    point = end_point(chain)
    # What the Jacobian needs anyway may make the orientation cheaper from the left.
    candidates = [columns_from_right(chain), _turned(chain.graph, frames[-1], chain.turn)]
    moved = [v for column in columns for v in (column.linear, column.angular)]
    pose = pose_outputs(cheapest(chain.graph, candidates, point, *moved), point)
    return schedule([*pose, *_outputs(robot, columns)], chain.lowering.names)


def _turned(graph: Graph, columns: Columns, turn: Turn) -> Columns:
    x, y, z = (combine(graph, columns, unit(graph, axis, sign)) for axis, sign in turn.images)
    return x, y, z


def _columns(chain: Chain, robot: Robot, frames: Sequence[Columns]) -> list[JacobianColumn]:
    """Return a column for each joint variable, in chain order."""
    columns = {
        column.variable: column
        for run, frame, ends in zip(chain.runs, frames[:-1], levers(chain), strict=True)
        for column in _run_columns(chain, robot.variables, run, frame, ends)
    }
    return [columns[variable] for variable in robot.variables]


def _run_columns(
    chain: Chain,
    variables: Sequence[Symbol],
    run: LoweredRun,
    frame: Columns,
    ends: Sequence[Vector],
) -> Iterator[JacobianColumn]:
    station = 0
    for motion in run.run.motions:
        if is_rotation(motion):
            station += 1
        for variable in variables:
            if motion.amount.has(variable):
                yield _column(chain, variable, motion, run, station, frame, ends[station])


def _column(
    chain: Chain,
    variable: Symbol,
    motion: Motion,
    run: LoweredRun,
    station: int,
    frame: Columns,
    lever: Vector,
) -> JacobianColumn:
    graph = chain.graph
    rate = chain.lowering.node(motion.amount.diff(variable))
    if is_rotation(motion):
        first, second = others(run.axis)
        swept = [graph.zero] * 3
        swept[first] = graph.neg(graph.mul(rate, lever[second]))
        swept[second] = graph.mul(rate, lever[first])
        axis = scale(graph, rate, frame[run.axis])
        return JacobianColumn(variable, combine(graph, frame, vector(swept)), axis)
    cos_sin, _ = run.stations[station]
    direction = rotate(graph, run.axis, cos_sin, unit(graph, motion.axis))
    still = (graph.zero, graph.zero, graph.zero)
    return JacobianColumn(variable, scale(graph, rate, combine(graph, frame, direction)), still)


def _outputs(robot: Robot, columns: Sequence[JacobianColumn]) -> list[Output]:
    """Name the entries row by row: vx1 is the velocity along x that the joint of row 1 gives."""
    rows = [i for i, joint in enumerate(robot.joints, 1) if joint.variable is not None]
    outputs = []
    for row, name in enumerate(("vx", "vy", "vz", "wx", "wy", "wz")):
        for place, (i, column) in enumerate(zip(rows, columns, strict=True)):
            entry = (*column.linear, *column.angular)[row]
            outputs.append(Output("J", f"{name}{i}", row, place, entry))
    return outputs
