"""A rotation as JSON, for programs: angles in radians, expressions that symdh reads back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import Expr

from symdh.kinematics.rotation import Description, RotationResult
from symdh.notation import Notation, Shorthand
from symdh.render.json_text import json_text
from symdh.render.plain_math import PlainWriter


def rotation_json(result: RotationResult) -> str:
    """Return one rotation.

    ``expressions`` is the exact 3x3 matrix, ``point`` and ``moved`` the exact point before and
    after, ``matrix`` the numbers; ``euler`` has an entry for each of the 12 sequences with
    ``angles`` in the order of the product, ``other`` for the other solution and ``degenerate``;
    ``quaternion`` is w, x, y, z. What has no value is null.
    """
    notation = Notation(result.robot, Shorthand.none(result.robot), degrees=False)
    writer = PlainWriter()

    def spelt(expressions: Sequence[Expr] | None) -> list[str] | None:
        if expressions is None:
            return None
        return [writer.text(notation.write(each)) for each in expressions]

    exact = result.matrix
    rows = None if exact is None else [spelt(list(exact.row(r))) for r in range(3)]
    content: dict[str, Any] = {
        "expressions": rows,
        "point": spelt(result.point),
        "moved": spelt(result.moved),
        **_numbers(result.numbers),
    }
    return json_text(content)


def _numbers(found: Description | None) -> dict[str, Any]:
    if found is None:
        return dict.fromkeys(("matrix", "euler", "axis", "angle", "quaternion"))
    turned = found.quaternion
    return {
        "matrix": [list(row) for row in found.matrix],
        "euler": {
            each.sequence.name: {
                "angles": list(each.angles),
                "other": list(each.other),
                "degenerate": each.degenerate,
            }
            for each in found.euler
        },
        "axis": found.axis_angle.axis and list(found.axis_angle.axis),
        "angle": found.axis_angle.angle,
        "quaternion": [turned.w, *turned.vector],
    }
