"""Chapter: what the four parameters measure, and why four of them are enough."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Integer

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Definition,
    Definitions,
    Display,
    Paragraph,
    Text,
)
from symdh.derivation.style import Style
from symdh.notation.nodes import (
    Call,
    Dot,
    Equation,
    Generic,
    Listed,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Sum,
    Tuple,
)
from symdh.robot import Convention

_I = Generic("i")
_X, _X_BEFORE = Generic("x", "i", hat=True), Generic("x", "i-1", hat=True)
_Z, _Z_BEFORE = Generic("z", "i", hat=True), Generic("z", "i-1", hat=True)


@dataclass(frozen=True)
class _Measure:
    """What one parameter measures: from one axis to the next, about or along a third."""

    parameter: Generic
    angle: bool
    first: Node
    second: Node
    axis: Node

    def definition(self) -> Definition:
        what, how = ("angle", "about") if self.angle else ("distance", "along")
        meaning = (f"{what} from ", self.first, " to ", self.second, f", {how} ", self.axis)
        return Definition(self.parameter, meaning)


@dataclass(frozen=True)
class _Geometry:
    """Where a convention puts its frames, and what follows for one link transform.

    Attributes
    ----------
    placing : Text
        Where frame i sits.
    measures : tuple of _Measure
        The parameters in the order of the operator sequence.
    normal, crossed : Node
        The x axis that obeys the two rules, and the z axis that it obeys them with.
    zero : str
        The entry of the rotation matrix that the first rule makes zero.
    unit_vectors : str
        The column and the row that have two entries left.
    pairs : tuple of (entries, angle)
        Those entries, cosine first, and the angle that they are the cosine and sine of.
    sine : int
        The sign of the sine in those pairs.
    """

    placing: Text
    measures: tuple[_Measure, ...]
    normal: Node
    crossed: Node
    zero: str
    unit_vectors: str
    pairs: tuple[tuple[tuple[str, str], Generic], ...]
    sine: int


def chapter(style: Style) -> Chapter:
    """Return the chapter on the parameters of the table's convention."""
    standard = style.robot.convention is Convention.STANDARD
    return Chapter(
        "What the four parameters measure", _blocks(_STANDARD if standard else _MODIFIED)
    )


def _blocks(geometry: _Geometry) -> tuple[Block, ...]:
    normal, crossed = geometry.normal, geometry.crossed
    return (
        Paragraph(geometry.placing),
        Definitions(tuple(measure.definition() for measure in geometry.measures)),
        Paragraph(
            (
                "Two frames anywhere in space differ by six numbers. Here four are enough, "
                "because ",
                *(normal, " obeys two rules. First, ", normal, " is perpendicular to ", crossed),
                ", so the entry where they meet in the rotation matrix vanishes:",
            )
        ),
        Display(Equation((Generic("r", geometry.zero), Dot(normal, crossed), Number(Integer(0))))),
        Paragraph((f"{geometry.unit_vectors} are unit vectors, which leaves two angles:",)),
        *(Display(_unit_pair(entries, angle, geometry.sine)) for entries, angle in geometry.pairs),
        Paragraph(
            (
                *("Second, ", normal, " meets ", crossed),
                ", so the new origin is reached by one slide along each, which leaves two lengths:",
            )
        ),
        Display(Equation((Generic("p"), _slides(geometry)))),
    )


def _slides(geometry: _Geometry) -> Node:
    lengths = [measure for measure in geometry.measures if not measure.angle]
    return Sum(tuple(Product((length.parameter, length.axis)) for length in lengths))


def _unit_pair(entries: tuple[str, str], angle: Generic, sign: int) -> Node:
    """Return ``r11^2 + r21^2 = 1`` and ``(r11, r21) = (cos theta, sin theta)``."""
    first, second = (Generic("r", entry) for entry in entries)
    sine: Node = Call("sin", (angle,))
    squares = Sum((Power(first, Integer(2)), Power(second, Integer(2))))
    values = Tuple((Call("cos", (angle,)), sine if sign > 0 else Negative(sine)))
    return Listed(
        (
            Equation((squares, Number(Integer(1)))),
            Equation((Tuple((first, second)), values)),
        )
    )


_STANDARD = _Geometry(
    placing=(
        *("Frame ", _I, " sits at the far end of link ", _I, ": joint ", _I),
        *(" moves about or along ", _Z_BEFORE, ", and ", _X),
        *(" lies on the common normal from ", _Z_BEFORE, " to ", _Z, "."),
    ),
    measures=(
        _Measure(Generic("theta", "i"), True, _X_BEFORE, _X, _Z_BEFORE),
        _Measure(Generic("d", "i"), False, _X_BEFORE, _X, _Z_BEFORE),
        _Measure(Generic("a", "i"), False, _Z_BEFORE, _Z, _X),
        _Measure(Generic("alpha", "i"), True, _Z_BEFORE, _Z, _X),
    ),
    normal=_X,
    crossed=_Z_BEFORE,
    zero="31",
    unit_vectors="The first column and the last row",
    pairs=((("11", "21"), Generic("theta", "i")), (("33", "32"), Generic("alpha", "i"))),
    sine=1,
)

_MODIFIED = _Geometry(
    placing=(
        *("Frame ", _I, " sits on joint ", _I, ", which moves about or along ", _Z),
        *("; ", _X_BEFORE, " lies on the common normal from ", _Z_BEFORE, " to ", _Z, "."),
    ),
    measures=(
        _Measure(Generic("alpha", "i-1"), True, _Z_BEFORE, _Z, _X_BEFORE),
        _Measure(Generic("a", "i-1"), False, _Z_BEFORE, _Z, _X_BEFORE),
        _Measure(Generic("d", "i"), False, _X_BEFORE, _X, _Z),
        _Measure(Generic("theta", "i"), True, _X_BEFORE, _X, _Z),
    ),
    normal=_X_BEFORE,
    crossed=_Z,
    zero="13",
    unit_vectors="The first row and the last column",
    pairs=((("11", "12"), Generic("theta", "i")), (("33", "23"), Generic("alpha", "i-1"))),
    sine=-1,
)
