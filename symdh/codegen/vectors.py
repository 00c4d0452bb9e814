"""Three-vectors of nodes, and the few operations that arms are made of."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from sympy import Integer

from symdh.codegen.graph import Graph, Node
from symdh.robot import Axis

Vector = tuple[Node, Node, Node]
#: Cosine and sine of one angle.
CosSin = tuple[Node, Node]
#: The columns of an orientation: where the unit vectors along x, y and z go.
Columns = tuple[Vector, Vector, Vector]


def vector(entries: Sequence[Node]) -> Vector:
    """Make a vector of three entries."""
    x, y, z = entries
    return x, y, z


def unit(graph: Graph, axis: Axis, sign: int = 1) -> Vector:
    """Return the unit vector along an axis, or against it."""
    return vector([graph.constant(Integer(sign if k == axis else 0)) for k in Axis])


def others(axis: Axis) -> tuple[int, int]:
    """Return the two other axes in cyclic order, so that one formula serves each axis."""
    return (axis + 1) % 3, (axis + 2) % 3


def add(graph: Graph, a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return vector([graph.add(x, y) for x, y in zip(a, b, strict=True)])


def scale(graph: Graph, factor: Node, a: Vector) -> Vector:
    """Return a vector times a number."""
    return vector([graph.mul(factor, x) for x in a])


def cross(graph: Graph, a: Vector, b: Vector) -> Vector:
    """Return the cross product a x b."""
    pairs = ((1, 2), (2, 0), (0, 1))
    return vector([graph.sub(graph.mul(a[i], b[j]), graph.mul(a[j], b[i])) for i, j in pairs])


def rotate(graph: Graph, axis: Axis, cos_sin: CosSin, a: Vector) -> Vector:
    """Rotate a vector about a coordinate axis."""
    first, second = others(axis)
    cosine, sine = cos_sin
    x, y = a[first], a[second]
    rotated = list(a)
    rotated[first] = graph.sub(graph.mul(cosine, x), graph.mul(sine, y))
    rotated[second] = graph.add(graph.mul(sine, x), graph.mul(cosine, y))
    return vector(rotated)


def combine(graph: Graph, columns: Columns, a: Vector) -> Vector:
    """Return the columns of an orientation, weighted and added up: a vector turned by it."""
    # Column before weight: the joints nearer to the base are written first, s1 * c23.
    parts = [
        vector([graph.mul(entry, weight) for entry in column])
        for weight, column in zip(a, columns, strict=True)
    ]
    return reduce(lambda total, part: add(graph, total, part), parts)


def turn_columns(graph: Graph, columns: Columns, axis: Axis, cos_sin: CosSin) -> Columns:
    """Multiply an orientation from the right by a rotation about a coordinate axis."""
    images = [rotate(graph, axis, cos_sin, unit(graph, k)) for k in Axis]
    x, y, z = (combine(graph, columns, image) for image in images)
    return x, y, z
