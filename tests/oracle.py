"""What the pose of a table is, worked out without symdh.

The oracle reads the YAML itself, evaluates the few expressions that the corpus uses, and multiplies
elementary 4x4 matrices one after another: no fusing, no symbols, nothing shared with the package.
It works in two arithmetics: extended precision, vectorised over poses, and mpmath at 50 digits.
Where it would have to guess (a bare non-zero angle, an unknown name) it raises instead.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import yaml

EPSILON = 2.0**-52
PRISMATIC_RANGE = 0.5
"""Half the travel of a prismatic joint in seeded poses, in the table's length unit."""

METRES = {"m": "1", "cm": "0.01", "mm": "0.001"}
ORDER = {
    "standard": (("Rz", "theta"), ("Tz", "d"), ("Tx", "a"), ("Rx", "alpha")),
    "modified": (("Rx", "alpha"), ("Tx", "a"), ("Rz", "theta"), ("Tz", "d")),
}
ANGLES = ("theta", "alpha")


@dataclass(frozen=True)
class Arithmetic:
    """A kind of number: how to read one or an array of them, and pi, cosine and sine in it."""

    number: Callable[[str], Any]
    array: Callable[[Any], Any]
    pi: Any
    cos: Callable[[Any], Any]
    sin: Callable[[Any], Any]
    dtype: Any


EXTENDED = Arithmetic(
    number=np.longdouble,
    array=lambda x: np.asarray(x, dtype=np.longdouble),
    pi=4 * np.arctan(np.longdouble(1)),
    cos=np.cos,
    sin=np.sin,
    dtype=np.longdouble,
)

_FIFTY_DIGITS = mpmath.mp.clone()
_FIFTY_DIGITS.dps = 50
FIFTY_DIGITS = Arithmetic(
    number=_FIFTY_DIGITS.mpf,
    array=np.vectorize(_FIFTY_DIGITS.mpf, otypes=[object]),
    pi=_FIFTY_DIGITS.pi + 0,
    cos=np.vectorize(_FIFTY_DIGITS.cos, otypes=[object]),
    sin=np.vectorize(_FIFTY_DIGITS.sin, otypes=[object]),
    dtype=object,
)


@dataclass(frozen=True)
class Arm:
    """A table as the oracle reads it: texts, and which name moves which row.

    Attributes
    ----------
    convention : str
    length : str
        The table's length unit.
    rows : tuple of dict
        The texts of theta, d, a and alpha.
    base, tool : tuple of (str, str)
        Kind and text of each elementary motion.
    variables : tuple of (str, bool)
        Name of each joint variable in chain order, and whether the joint turns.
    values : dict of str to str
    """

    convention: str
    length: str
    rows: tuple[dict[str, str], ...]
    base: tuple[tuple[str, str], ...]
    tool: tuple[tuple[str, str], ...]
    variables: tuple[tuple[str, bool], ...]
    values: dict[str, str]

    @property
    def n(self) -> int:
        return len(self.rows)

    def pose(
        self,
        variables: Mapping[str, Any],
        first: str | int = "base",
        last: str | int = "tool",
        arithmetic: Arithmetic = EXTENDED,
    ) -> Any:
        """Pose of frame `last` in frame `first`, `first` at or before `last`; (..., 4, 4).

        Parameters
        ----------
        variables : mapping of str to array_like
            Joint variables, radians or the table's length unit, all of one shape; also numbers
            for parameters to which the table gives no value.
        """
        scope = self._scope(arithmetic, variables)
        shape = np.shape(next(iter(variables.values()), 0.0))
        product = _identity(arithmetic, shape)
        for kind, text in self.word(first, last):
            amount = scope.evaluate(text, is_angle=kind.startswith("R"))
            product = product @ elementary(kind, amount, shape, arithmetic)
        return product

    def word(self, first: str | int, last: str | int) -> Iterator[tuple[str, str]]:
        """Elementary motions from one frame to a later one, each as its kind and its text."""
        if first == "base":
            yield from self.base
        begin = 0 if first == "base" else first
        end = self.n if last == "tool" else last
        assert isinstance(begin, int)
        assert isinstance(end, int)
        for row in self.rows[begin:end]:
            for kind, column in ORDER[self.convention]:
                yield kind, row[column]
        if last == "tool":
            yield from self.tool

    def seeded_poses(self, count: int, seed: int) -> np.ndarray:
        """Joint values (count, number of variables): +-pi where a joint turns, +-0.5 else."""
        bound = [np.pi if turns else PRISMATIC_RANGE for _, turns in self.variables]
        uniform = np.random.default_rng(seed).uniform(-1.0, 1.0, (count, len(bound)))
        return np.asarray(uniform * np.array(bound))

    def parameters(self) -> tuple[str, ...]:
        """Names without a value that are no joint variables, in the order of the chain."""
        texts = [text for _, text in self.base]
        texts += [row[column] for row in self.rows for column in ("theta", "d", "a", "alpha")]
        texts += [text for _, text in self.tool]
        known = {name for name, _ in self.variables} | set(self.values)
        return tuple(dict.fromkeys(n for text in texts for n in _names(text) if n not in known))

    def reach(self, parameters: Mapping[str, float] | None = None) -> float:
        """Longest the arm can be: the sum of all lengths, a prismatic joint fully out."""
        stretched = {name: PRISMATIC_RANGE for name, _ in self.variables}
        scope = self._scope(EXTENDED, stretched | dict(parameters or {}))
        lengths = (text for kind, text in self.word("base", "tool") if kind.startswith("T"))
        return float(sum(abs(scope.evaluate(text, is_angle=False)) for text in lengths))

    def _scope(self, arithmetic: Arithmetic, variables: Mapping[str, Any]) -> _Scope:
        numbers = {name: arithmetic.array(x) for name, x in variables.items()}
        scope = _Scope(arithmetic, self.length, numbers)
        for name, text in self.values.items():
            scope.numbers.setdefault(name, scope.evaluate(text, is_angle=False))
        return scope

    def tolerance(self, parameters: Mapping[str, float] | None = None) -> float:
        """Largest error of an entry of a pose that double precision excuses."""
        return (4 + 2 * self.n) * EPSILON * max(1.0, self.reach(parameters))


def read_arm(text: str) -> Arm:
    """Read a table in the long spelling."""
    table = yaml.load(text, Loader=yaml.BaseLoader)  # makes texts of all scalars, nothing else
    rows = tuple(table["joints"])
    values = table.get("values", {})
    return Arm(
        convention=table.get("convention", "standard"),
        length=table.get("units", {}).get("length", "m"),
        rows=rows,
        base=tuple(_motion(word) for word in table.get("base", [])),
        tool=tuple(_motion(word) for word in table.get("tool", [])),
        variables=tuple(v for row in rows if (v := _variable(row)) is not None),
        values=values,
    )


def read_arm_file(path: Path) -> Arm:
    """Read a table from a file."""
    return read_arm(path.read_text(encoding="utf-8"))


def elementary(kind: str, amount: Any, shape: tuple[int, ...], arithmetic: Arithmetic) -> Any:
    """One of Rx Ry Rz Tx Ty Tz as a homogeneous matrix, broadcast to `shape` + (4, 4)."""
    axis = "xyz".index(kind[1])
    matrix = _identity(arithmetic, shape)
    if kind[0] == "T":
        matrix[..., axis, 3] = amount
        return matrix
    # Turning about axis k carries axis k+1 toward axis k+2, in cyclic order.
    i, j = (axis + 1) % 3, (axis + 2) % 3
    cosine, sine = arithmetic.cos(amount), arithmetic.sin(amount)
    matrix[..., i, i] = cosine
    matrix[..., j, j] = cosine
    matrix[..., i, j] = -sine
    matrix[..., j, i] = sine
    return matrix


def rigid_inverse(pose: Any) -> Any:
    """Inverse of a pose, from the transpose of its rotation."""
    rotation = np.swapaxes(pose[..., :3, :3], -1, -2)
    inverse = np.array(pose)
    inverse[..., :3, :3] = rotation
    inverse[..., :3, 3] = -(rotation @ pose[..., :3, 3:])[..., 0]
    return inverse


def _identity(arithmetic: Arithmetic, shape: tuple[int, ...]) -> Any:
    unit = np.array([[arithmetic.number(str(int(i == j))) for j in range(4)] for i in range(4)])
    return np.array(np.broadcast_to(unit.astype(arithmetic.dtype), (*shape, 4, 4)))


def _motion(word: str) -> tuple[str, str]:
    kind, text = re.fullmatch(r"\s*([RT][xyz])\((.*)\)\s*", word).groups()  # type: ignore[union-attr]
    return kind, text


def _variable(row: Mapping[str, str]) -> tuple[str, bool] | None:
    """Name that moves a row and whether it turns it: theta's symbol, else d's, else none."""
    if row.get("type") == "fixed":
        return None
    for column, turns in (("theta", True), ("d", False)):
        names = _names(row[column])
        if names:
            (name,) = names
            return name, turns
    return None


def _names(text: str) -> list[str]:
    tree = ast.parse(_spell_products(text), mode="eval")
    names = (node.id for node in ast.walk(tree) if isinstance(node, ast.Name))
    return [name for name in names if name not in ("deg", "rad", "pi", *METRES)]


def _spell_products(text: str) -> str:
    """`100.0 deg` reads `(100.0*deg)`."""
    units = "|".join(("deg", "rad", *METRES))
    return re.sub(rf"(\d+(?:\.\d*)?)\s*({units})\b", r"(\1*\2)", text.strip())


class _Scope:
    """Names that have numbers, and the evaluation of a text in them."""

    def __init__(self, arithmetic: Arithmetic, length: str, numbers: Mapping[str, Any]) -> None:
        self.arithmetic = arithmetic
        self.numbers = dict(numbers)
        number = arithmetic.number
        self.units = {"deg": arithmetic.pi / 180, "rad": number("1"), "pi": arithmetic.pi}
        for unit, metres in METRES.items():
            self.units[unit] = number(metres) / number(METRES[length])

    def evaluate(self, text: str, *, is_angle: bool) -> Any:
        tree = ast.parse(_spell_products(text), mode="eval").body
        if is_angle and isinstance(tree, ast.Constant) and tree.value != 0:
            raise ValueError(f"the oracle does not guess the unit of the angle {text!r}")
        return self._node(tree)

    def _node(self, node: ast.expr) -> Any:
        match node:
            case ast.Constant(value=int() | float() as value):
                return self.arithmetic.number(repr(value))
            case ast.Name(id=name) if name in self.numbers:
                return self.numbers[name]
            case ast.Name(id=name):
                return self.units[name]
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -self._node(operand)
            case ast.BinOp(left=left, op=op, right=right):
                return _OPERATORS[type(op)](self._node(left), self._node(right))
        raise ValueError(f"the oracle cannot read {ast.unparse(node)!r}")


_OPERATORS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: lambda x, y: x + y,
    ast.Sub: lambda x, y: x - y,
    ast.Mult: lambda x, y: x * y,
    ast.Div: lambda x, y: x / y,
    ast.Pow: lambda x, y: x**y,
}
