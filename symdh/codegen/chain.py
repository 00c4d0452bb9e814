"""Robot -> the fused word of its chain in nodes: what the pose and the Jacobian are built from.

Angles of parallel joints are summed before their cosine is taken; positions are built from the
right, orientations from either side, so that the work grows linearly with the joints.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from sympy import Expr, Symbol

from symdh.codegen.graph import Graph
from symdh.codegen.lowering import Lowering
from symdh.codegen.vectors import (
    Columns,
    CosSin,
    Vector,
    add,
    rotate,
    turn_columns,
    unit,
    vector,
)
from symdh.kinematics.chain import chain_word
from symdh.motion import Run, Word, cut_runs, fuse_to_turn
from symdh.motion.turn import Turn
from symdh.robot import Axis, Motion, Robot
from symdh.table import with_values


@dataclass(frozen=True, slots=True)
class LoweredRun:
    """A run of the fused word, and for each of its stations the turn and the translation there."""

    run: Run
    stations: tuple[tuple[CosSin, Vector], ...]

    @property
    def axis(self) -> Axis:
        """The axis that the run turns about."""
        return self.run.axis

    @property
    def cos_sin(self) -> CosSin:
        """Cosine and sine of all that the run turns by."""
        return self.stations[-1][0]


@dataclass(frozen=True)
class Chain:
    """A robot from base to tool, in the nodes of one graph.

    Attributes
    ----------
    lowering : Lowering
    word : Word
        Not fused; values are put in.
    runs : tuple of LoweredRun
        The fused word of the pose.
    turn : Turn
        The right-angle turn behind it.
    """

    lowering: Lowering
    word: Word
    runs: tuple[LoweredRun, ...]
    turn: Turn

    @property
    def graph(self) -> Graph:
        """The graph that all nodes belong to."""
        return self.lowering.graph


def lower_chain(
    robot: Robot, values: Mapping[Symbol, Expr] | None = None, *, splits_sums: bool = False
) -> Chain:
    """Fuse the chain of a robot and turn it into nodes.

    Parameters
    ----------
    robot : Robot
    values : mapping of Symbol to Expr, optional
        Exact numbers to put in for some parameters; what they make zero or a right angle vanishes.
    splits_sums : bool
        Whether sines and cosines of sums are made of those of their terms (see `Lowering`).

    Raises
    ------
    UnsupportedError
        When the table holds something that has no code, or the values make an amount infinite or
        complex.
    """
    known = dict(values or {})
    word = tuple(_with_values(motion, known) for motion in chain_word(robot, "base", "tool"))
    rows = {j.variable: i for i, j in enumerate(robot.joints, 1) if j.variable is not None}
    lowering = Lowering(Graph(), rows, splits_sums=splits_sums)
    motions, turn = fuse_to_turn(word)
    # Angles are met in chain order, so that code reads c1, s1, c2, s2 ...
    runs = tuple(_lower_run(lowering, run) for run in cut_runs(motions))
    return Chain(lowering, word, runs, turn)


def _with_values(motion: Motion, known: dict[Symbol, Expr]) -> Motion:
    return replace(motion, amount=with_values(motion.amount, known))


def _lower_run(lowering: Lowering, run: Run) -> LoweredRun:
    stations = tuple(
        (lowering.cos_sin(station.angle), vector([lowering.node(x) for x in station.offset]))
        for station in run.stations
    )
    return LoweredRun(run, stations)


def levers(chain: Chain) -> list[list[Vector]]:
    """Return the end of the arm as each station sees it, nested from the last run to the first.

    Returns
    -------
    list of list of Vector
        For each run and each of its stations the vector from there to the end of the arm, along
        the axes at the start of the run. Within a run the arms simply add up,
        ``a_1 c_1 + a_2 c_{12}``, and each sum is a part of the one before it.
    """
    graph = chain.graph
    end: Vector = (graph.zero, graph.zero, graph.zero)
    result: list[list[Vector]] = []
    for run in reversed(chain.runs):
        *earlier, (cos_sin, offset) = run.stations
        sums = [rotate(graph, run.axis, cos_sin, add(graph, offset, end))]
        for turned, arm in reversed(earlier):
            sums.append(add(graph, rotate(graph, run.axis, turned, arm), sums[-1]))
        result.append(sums[::-1])
        end = sums[-1]
    return result[::-1]


def orientations(chain: Chain) -> list[Columns]:
    """Return the orientation before each run and behind the last, multiplied from the left."""
    graph = chain.graph
    frames: list[Columns] = [(unit(graph, Axis.X), unit(graph, Axis.Y), unit(graph, Axis.Z))]
    for run in chain.runs:
        frames.append(turn_columns(graph, frames[-1], run.axis, run.cos_sin))
    return frames
