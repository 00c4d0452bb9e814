"""How exact a number is that somebody wrote down."""

from __future__ import annotations

import re
from dataclasses import dataclass

#: Digits that a rounded number must have.
ENOUGH_DIGITS = 3
#: The least part of the size of a thing that its last digit may stand for, where digits are few.
_FINE = 1e-3
#: How near to the truth a wrong number counts as rounded too early.
_NEAR = 0.02
_EXACT = 1e-9

_DECIMAL = re.compile(
    r"\s*[-+]?(?P<whole>\d*)(?:\.(?P<part>\d*))?(?:[eE](?P<exponent>[-+]?\d+))?\s*(?P<unit>\w*|°)\s*"
)


@dataclass(frozen=True, slots=True)
class Written:
    """A number as it is written.

    Attributes
    ----------
    value : float
        In the table's units.
    last : float
        What one unit of its last digit is worth; 0 for an exact expression.
    digits : int
        How many digits of it count.
    """

    value: float
    last: float
    digits: int

    @classmethod
    def of(cls, text: str, value: float) -> Written:
        """Tell from a text how exact the number is that it was read as."""
        found = _DECIMAL.fullmatch(text)
        if found is None or not (found["whole"] or found["part"]):
            # A formula is exact, unless rounded numbers stand in it.
            rounded = re.search(r"\d\.\d|\.\d", text)
            return cls(value, 1e-3 * abs(value) if rounded else 0.0, ENOUGH_DIGITS)
        part = found["part"] or ""
        shown = float(f"{found['whole'] or 0}.{part or 0}e{found['exponent'] or 0}")
        last = 10.0 ** (int(found["exponent"] or 0) - len(part))
        # A unit scales the number and its last digit alike.
        scale = abs(value) / shown if shown else 1.0
        digits = len((found["whole"] + part).lstrip("0"))
        return cls(value, last * scale, digits)

    def agrees(self, truth: float) -> bool:
        """Say whether the truth rounds, or is cut, to this number."""
        return abs(self.value - truth) <= self.last * 1.0001 + _EXACT * (1 + abs(truth))

    def is_exact(self, truth: float) -> bool:
        """Say whether nothing was rounded at all."""
        return abs(self.value - truth) <= _EXACT * (1 + abs(truth))

    def is_fine(self, size: float) -> bool:
        """Say whether there are enough digits, for a thing of some size."""
        return self.digits >= ENOUGH_DIGITS or self.last <= _FINE * size

    def is_near(self, truth: float, size: float) -> bool:
        """Say whether this could be the truth but for rounding on the way."""
        return abs(self.value - truth) <= _NEAR * max(abs(truth), 0.1 * size)
