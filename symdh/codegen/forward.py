"""Robot -> routine for its forward kinematics, built motion by motion from the fused word.

Everything is multiplied from the right, so that the work grows linearly with the joints: the
orientation carries columns, the position one point. Angles of parallel joints are summed before
their cosine is taken.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce

from sympy import Expr, Integer, Symbol

from symdh.codegen.graph import Graph, Node, Op
from symdh.codegen.lowering import Lowering
from symdh.codegen.routine import Output, Routine, op_counts, schedule
from symdh.kinematics.chain import chain_word
from symdh.motion import Word, fuse_to_turn, rotations
from symdh.robot import Axis, Motion, MotionKind, Robot

Vector = tuple[Node, Node, Node]

#: What an operation costs beside a multiplication or addition, as libm and the hardware have it.
_COSTS = {Op.ADD: 1, Op.SUB: 1, Op.MUL: 1, Op.DIV: 4}
_CALL_COST = 20


def forward_routine(robot: Robot, values: Mapping[Symbol, Expr] | None = None) -> Routine:
    """Build the routine of a robot's pose, base to tool.

    Parameters
    ----------
    robot : Robot
    values : mapping of Symbol to Expr, optional
        Exact numbers to put in for some symbols; what they make zero or a right angle vanishes.

    Returns
    -------
    Routine
        12 outputs: r11 .. r33, px, py, pz, row by row.

    Raises
    ------
    UnsupportedError
        When the table holds something that has no code.
    """
    word = _with_values(chain_word(robot, "base", "tool"), values or {})
    rows = {j.variable: i for i, j in enumerate(robot.joints, 1) if j.variable is not None}
    lowering = Lowering(Graph(), rows)
    # The position meets the angles in chain order, so that code reads c1, s1, c2, s2 ...
    point = _position(lowering, word)
    columns = _cheapest(lowering.graph, _columns(lowering, word), point)
    return schedule(_outputs(columns, point), lowering.names)


def _with_values(word: Word, values: Mapping[Symbol, Expr]) -> Word:
    known = dict(values)
    return tuple(replace(motion, amount=motion.amount.xreplace(known)) for motion in word)


def _columns(lowering: Lowering, word: Word) -> tuple[Vector, ...]:
    """Return the columns of the orientation, each multiplied out from the right."""
    graph = lowering.graph
    motions, turn = fuse_to_turn(rotations(word))
    turned = [(motion.axis, lowering.cos_sin(motion.amount)) for motion in motions]
    columns = []
    for axis, sign in turn.images:
        entries = [graph.zero] * 3
        entries[axis] = graph.constant(Integer(sign))
        column = _vector(entries)
        for axis_of_rotation, cos_sin in reversed(turned):
            column = _rotate(graph, axis_of_rotation, cos_sin, column)
        columns.append(column)
    return tuple(columns)


def _cheapest(graph: Graph, columns: Sequence[Vector], point: Vector) -> Sequence[Vector]:
    """Replace one column by the cross product of the two others where that is less work."""
    candidates = [columns]
    for k in range(3):
        crossed = list(columns)
        crossed[k] = _cross(graph, columns[(k + 1) % 3], columns[(k + 2) % 3])
        candidates.append(crossed)
    return min(candidates, key=lambda candidate: _cost([*candidate, point]))


def _cost(vectors: Sequence[Vector]) -> int:
    counts = op_counts(entry for vector in vectors for entry in vector)
    return sum(_COSTS.get(op, _CALL_COST) * count for op, count in counts.items())


@dataclass
class _Run:
    """A stretch of a word whose rotations are all about one axis: parallel joints.

    `stations` holds, for each angle that the run passes through, the translation made there.
    """

    axis: Axis
    stations: list[tuple[Expr, list[Expr]]] = field(default_factory=list)

    def turn(self, angle: Expr) -> None:
        """Go on to a new station, turned by an angle from the last."""
        before = self.stations[-1][0] if self.stations else Integer(0)
        self.stations.append((before + angle, [Integer(0)] * 3))

    def move(self, motion: Motion) -> None:
        """Translate at the last station."""
        if not self.stations:
            self.turn(Integer(0))
        self.stations[-1][1][motion.axis] += motion.amount


def _runs(word: Word) -> list[_Run]:
    """Cut a word where the axis of rotation changes."""
    runs: list[_Run] = []
    for motion in word:
        is_rotation = motion.kind is MotionKind.ROTATION
        if not runs or (is_rotation and motion.axis is not runs[-1].axis):
            runs.append(_Run(motion.axis))
        if is_rotation:
            runs[-1].turn(motion.amount)
        else:
            runs[-1].move(motion)
    return runs


def _position(lowering: Lowering, word: Word) -> Vector:
    """Return the origin of the last frame: nested from the last run to the first.

    Within a run the arms simply add, ``a_1 c_1 + a_2 c_{12}``.
    """
    graph = lowering.graph
    lowered = [
        (
            run.axis,
            [
                (lowering.cos_sin(angle), _vector([lowering.node(x) for x in offset]))
                for angle, offset in run.stations
            ],
        )
        for run in _runs(fuse_to_turn(word)[0])
    ]
    point: Vector = (graph.zero, graph.zero, graph.zero)
    for axis, stations in reversed(lowered):
        *earlier, (cos_sin, last) = stations
        arms = [*earlier, (cos_sin, _add(graph, last, point))]
        point = reduce(
            lambda total, arm: _add(graph, total, arm),
            [_rotate(graph, axis, turned, arm) for turned, arm in arms],
        )
    return point


def _rotate(graph: Graph, axis: Axis, cos_sin: tuple[Node, Node], vector: Vector) -> Vector:
    """Rotate a vector about a coordinate axis."""
    first, second = (axis + 1) % 3, (axis + 2) % 3
    cosine, sine = cos_sin
    x, y = vector[first], vector[second]
    rotated = list(vector)
    rotated[first] = graph.sub(graph.mul(cosine, x), graph.mul(sine, y))
    rotated[second] = graph.add(graph.mul(sine, x), graph.mul(cosine, y))
    return _vector(rotated)


def _add(graph: Graph, a: Vector, b: Vector) -> Vector:
    return _vector([graph.add(x, y) for x, y in zip(a, b, strict=True)])


def _cross(graph: Graph, a: Vector, b: Vector) -> Vector:
    pairs = ((1, 2), (2, 0), (0, 1))
    return _vector([graph.sub(graph.mul(a[i], b[j]), graph.mul(a[j], b[i])) for i, j in pairs])


def _vector(entries: Sequence[Node]) -> Vector:
    x, y, z = entries
    return x, y, z


def _outputs(columns: Sequence[Vector], point: Vector) -> list[Output]:
    outputs = []
    for row in range(3):
        for column in range(3):
            name = f"r{row + 1}{column + 1}"
            outputs.append(Output(name, row, column, columns[column][row]))
        outputs.append(Output("p" + "xyz"[row], row, 3, point[row]))
    return outputs
