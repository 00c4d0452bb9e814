"""An assignment of frames as JSON, for programs: angles in radians, expressions read back."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sympy import Expr

from symdh.frames import Assignment
from symdh.frames.placed import Measured, crossing
from symdh.frames.story import Step
from symdh.frames.vectors import unit
from symdh.notation import Notation, Shorthand
from symdh.render.interchange.table import table_text
from symdh.render.json_text import json_text
from symdh.render.plain_math import PlainWriter


def frames_json(found: Assignment) -> str:
    """Return how a table came about, and the table.

    ``frames`` has an entry for each frame: its ``origin``, ``x`` and ``z`` seen from the world,
    and the names of the rules that placed it. ``rows`` has what was measured in the home position
    and the point ``b`` of each row (Schilling's b_k). ``snaps`` are relations that were taken for
    exact, ``table`` is what `symdh.loads` reads.
    """
    return json_text(_Writer(found).content())


class _Writer:
    """Writes one assignment."""

    def __init__(self, found: Assignment) -> None:
        self._found = found
        robot = found.robot
        self._notation = Notation(robot, Shorthand.none(robot), degrees=False)
        self._math = PlainWriter()

    def content(self) -> dict[str, Any]:
        found = self._found
        return {
            "name": found.robot.name,
            "convention": found.convention.value,
            "exact": found.exact,
            "frames": {str(step.frame): self._frame(step) for step in found.steps},
            "rows": {str(k): self._row(k, row) for k, row in enumerate(found.measured, start=1)},
            "snaps": [{"taken_as": snap.taken_as, "off_by": snap.miss} for snap in found.snaps],
            "table": table_text(found.robot).sections(),
        }

    def _frame(self, step: Step) -> dict[str, Any]:
        return {
            "origin": self._vector(step.placed.origin),
            "x": self._vector(unit(step.placed.x)),
            "z": self._vector(step.placed.z),
            "axes": list(step.axes) if step.axes else None,
            "relation": step.relation.name.lower() if step.relation else None,
            "origin_rule": step.origin_rule.name.lower(),
            "x_rule": step.x_rule.name.lower(),
            "x_reversed": step.reversed_x,
        }

    def _row(self, k: int, row: Measured) -> dict[str, Any]:
        before, after = (step.placed for step in self._found.steps[k - 1 : k + 1])
        return {
            "theta": self._spelt(row.theta),
            "d": self._spelt(row.d),
            "a": self._spelt(row.a),
            "alpha": self._spelt(row.alpha),
            "b": self._vector(crossing(before, after, self._found.convention)),
        }

    def _vector(self, vector: Iterable[Expr]) -> list[str]:
        return [self._spelt(entry) for entry in vector]

    def _spelt(self, expression: Expr) -> str:
        return self._math.text(self._notation.write(expression))
