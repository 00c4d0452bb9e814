"""Jacobians and singularities as JSON, for programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from sympy import Expr

from symdh.kinematics.singular import Factor, Singularities
from symdh.kinematics.velocity import GeometricJacobian
from symdh.notation import Notation, Shorthand
from symdh.render.plain_math import PlainWriter
from symdh.robot import Robot

_ROWS = ("v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z")


def jacobian_json(found: GeometricJacobian) -> str:
    """Return a geometric Jacobian: ``matrix`` in short form, ``expressions`` spelt out."""
    write = _Spelling(found.robot)
    matrix = found.matrix
    entries = [[matrix[r, c] for c in range(matrix.cols)] for r in range(matrix.rows)]
    content = {
        "of": found.of,
        "at": [write.spelt(part) for part in found.at],
        "in": found.in_,
        "rows": list(_ROWS),
        "variables": [
            column.joint.variable.name for column in found.columns if column.joint.variable
        ],
        "matrix": [[write.short(entry) for entry in row] for row in entries],
        "expressions": [[write.spelt(entry) for entry in row] for row in entries],
    }
    return _dump(content)


def singularities_json(found: Singularities) -> str:
    """Return singularities; expressions are spelt out and read back by symdh's own parser.

    ``constant`` and ``factors`` multiply to the determinant where ``square`` is true, else to what
    the minors have in common. ``factors`` is null where the polynomials are over the limit.
    ``zeros`` are radians or lengths. The rank also drops where all of one of ``remaining`` vanish;
    where ``complete`` is false, at more poses than are told.
    """
    write = _Spelling(found.robot)
    content: dict[str, Any] = {
        "of": found.of,
        "joints": list(found.joints),
        "rows": [_ROWS[row] for row in found.rows],
        "frame": found.frame,
        "point": found.point,
        "rank": found.rank,
        "square": found.is_square,
        "constant": write.spelt(found.constant),
        "factors": None
        if found.factors is None
        else [_factor(write, factor) for factor in found.factors],
        "remaining": [write.all_spelt(each) for each in found.remaining],
        "complete": found.is_complete,
    }
    return _dump(content)


def _factor(write: _Spelling, factor: Factor) -> dict[str, Any]:
    meaning = factor.meaning
    return {
        "short": write.short(factor.expression),
        "expression": write.spelt(factor.expression),
        "power": factor.power,
        "variables": [variable.name for variable in factor.variables],
        "zeros": write.all_spelt(factor.zeros),
        "name": meaning and meaning.kind.value,
        "axes": meaning and list(meaning.joints),
        "point": meaning and meaning.point,
    }


class _Spelling:
    """Writes expressions in short form, and as symdh's own parser reads them back."""

    def __init__(self, robot: Robot) -> None:
        self._short = Notation(robot)
        self._spelt = Notation(robot, Shorthand.none(robot), degrees=False)
        self._writer = PlainWriter()

    def short(self, expression: Expr) -> str:
        return self._writer.text(self._short.write(expression))

    def spelt(self, expression: Expr) -> str:
        return self._writer.text(self._spelt.write(expression))

    def all_spelt(self, expressions: Sequence[Expr]) -> list[str]:
        return [self.spelt(expression) for expression in expressions]


def _dump(content: dict[str, Any]) -> str:
    """Write one row of a list of lists a line."""
    parts = []
    for key, value in content.items():
        if isinstance(value, list) and value and isinstance(value[0], (list, dict)):
            rows = ",\n    ".join(json.dumps(row, ensure_ascii=False) for row in value)
            parts.append(f'  "{key}": [\n    {rows}\n  ]')
        else:
            parts.append(f'  "{key}": {json.dumps(value, ensure_ascii=False)}')
    return "{\n" + ",\n".join(parts) + "\n}"
