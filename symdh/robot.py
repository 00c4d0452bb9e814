"""The domain model: a serial arm as Denavit-Hartenberg rows, without parsing and without printing.

Lengths are exact numbers in the table's length unit, angles are exact radians. Symbols are real.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum, IntEnum
from itertools import chain
from types import MappingProxyType

from sympy import Expr, Integer, Symbol


class Convention(Enum):
    """Which of the two Denavit-Hartenberg conventions a table is written in.

    ``STANDARD`` (distal):    A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i)
    ``MODIFIED`` (proximal):  A_i = Rx(alpha_{i-1}) Tx(a_{i-1}) Rz(theta_i) Tz(d_i)
    """

    STANDARD = "standard"
    MODIFIED = "modified"


class JointType(Enum):
    """What a joint does: turn, slide, or nothing."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    FIXED = "fixed"


class Axis(IntEnum):
    """A coordinate axis; the value indexes a 3-vector."""

    X = 0
    Y = 1
    Z = 2


class MotionKind(Enum):
    """Rotation about an axis or translation along it."""

    ROTATION = "R"
    TRANSLATION = "T"


@dataclass(frozen=True, slots=True)
class Motion:
    """An elementary motion: a rotation about, or a translation along, one coordinate axis.

    Attributes
    ----------
    kind : MotionKind
    axis : Axis
    amount : sympy.Expr
        Radians for a rotation, the table's length unit for a translation.
    """

    kind: MotionKind
    axis: Axis
    amount: Expr


@dataclass(frozen=True, slots=True)
class Joint:
    """One row of a table. In a modified table `a` and `alpha` mean a_{i-1} and alpha_{i-1}.

    Attributes
    ----------
    type : JointType
    theta, alpha : sympy.Expr
        Radians.
    d, a : sympy.Expr
        The table's length unit.
    variable : sympy.Symbol or None
        The joint variable; None exactly when the joint is fixed. It stands in `theta` of a
        revolute joint or in `d` of a prismatic one and nowhere else in the table.
    """

    type: JointType
    theta: Expr
    d: Expr
    a: Expr
    alpha: Expr
    variable: Symbol | None


class AngleUnit(Enum):
    """Units for angles."""

    DEGREE = "deg"
    RADIAN = "rad"


class LengthUnit(Enum):
    """Units for lengths."""

    METRE = "m"
    CENTIMETRE = "cm"
    MILLIMETRE = "mm"
    INCH = "in"
    FOOT = "ft"


@dataclass(frozen=True, slots=True)
class Units:
    """What a bare number means, and what numbers are shown in; None where the table is silent."""

    angle: AngleUnit | None = None
    length: LengthUnit | None = None


@dataclass(frozen=True, slots=True)
class Limits:
    """Lower and upper bound of a joint variable, exact, in radians or the table's length unit."""

    lower: Expr
    upper: Expr


@dataclass(frozen=True)
class Robot:
    """A serial arm: its rows, what stands before and after them, and the numbers that are known.

    Attributes
    ----------
    name : str
        Letters, digits, ``_ . -`` and spaces; files and functions are named after it.
    convention : Convention
    joints : tuple of Joint
        Row i of the table is ``joints[i - 1]``.
    base, tool : tuple of Motion
        Words of elementary motions applied before frame 0 and after frame n.
    values : mapping of Symbol to Expr
        Known numbers of parameters and joint variables, exact.
    limits : mapping of Symbol to Limits
    title : str or None
        Free text for people.
    units : Units
    """

    name: str
    convention: Convention
    joints: tuple[Joint, ...]
    base: tuple[Motion, ...] = ()
    tool: tuple[Motion, ...] = ()
    values: Mapping[Symbol, Expr] = field(default_factory=dict)
    limits: Mapping[Symbol, Limits] = field(default_factory=dict)
    title: str | None = None
    units: Units = Units()

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", MappingProxyType(dict(self.values)))
        object.__setattr__(self, "limits", MappingProxyType(dict(self.limits)))

    @property
    def n(self) -> int:
        """Number of rows, and of the last frame."""
        return len(self.joints)

    @property
    def variables(self) -> tuple[Symbol, ...]:
        """The joint variables in chain order; this is the order of ``q`` in generated code."""
        return tuple(j.variable for j in self.joints if j.variable is not None)

    @property
    def parameters(self) -> tuple[Symbol, ...]:
        """The other symbols, in the order in which the chain meets them, base to tool."""
        variables = set(self.variables)
        found: dict[Symbol, None] = {}
        for amount in self.amounts:
            for symbol in in_name_order(amount.free_symbols):
                if symbol not in variables:
                    found[symbol] = None
        return tuple(found)

    @property
    def amounts(self) -> tuple[Expr, ...]:
        """The angles and lengths of the chain, base to tool."""
        rows = ((joint.theta, joint.d, joint.a, joint.alpha) for joint in self.joints)
        return (
            *(motion.amount for motion in self.base),
            *chain.from_iterable(rows),
            *(motion.amount for motion in self.tool),
        )


def in_name_order(symbols: Iterable[Symbol]) -> list[Symbol]:
    """Sort symbols by name, numbers inside a name by value: a2 before a10."""
    return sorted(symbols, key=lambda symbol: natural_key(symbol.name))


def natural_key(name: str) -> tuple[tuple[str, int], ...]:
    """Sorting key under which a2 comes before a10."""
    return tuple((text, int(digits or -1)) for text, digits in re.findall(r"(\D+|^)(\d*)", name))


ZERO = Integer(0)
