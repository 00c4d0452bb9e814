"""How an arm is to be drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from sympy import Expr, Symbol


@dataclass(frozen=True, slots=True)
class Choices:
    """How an arm is to be drawn.

    Attributes
    ----------
    azimuth, elevation : float or None
        The direction to look from, in degrees: about z from the x axis, and above the xy plane.
        Without either, a planar arm is drawn in its plane.
    to_scale : bool
        Keep the ratios of the lengths; by default short ones are drawn longer.
    y_axes : bool
        Draw the y axes too.
    feet : bool
        Mark the points b_k and draw the axes of the joints as lines.
    """

    azimuth: float | None = None
    elevation: float | None = None
    to_scale: bool = False
    y_axes: bool = False
    feet: bool = False


DEFAULT = Choices()
NO_VALUES: Mapping[Symbol, Expr] = MappingProxyType({})
