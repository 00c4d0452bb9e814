"""Results as JSON, for programs."""

from __future__ import annotations

import json
from typing import Any

from symdh.kinematics.forward import transform
from symdh.kinematics.frame import Frame
from symdh.kinematics.numeric import NumericMatrix
from symdh.notation import Notation, Shorthand
from symdh.render.plain_math import PlainWriter
from symdh.robot import Robot


def show_json(robot: Robot, start: Frame, end: Frame) -> str:
    """Return the exact pose: ``matrix`` in short form, ``expressions`` spelt out.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    LimitError
        When the closed form would be too large.
    """
    exact = transform(robot, start, end)
    short = _strings(exact, Notation(robot))
    spelt = _strings(exact, Notation(robot, Shorthand.none(robot), degrees=False))
    return _dump({"from": start, "to": end, "matrix": short, "expressions": spelt})


def eval_json(start: Frame, end: Frame, numbers: NumericMatrix) -> str:
    """Return the numeric pose; every number has the digits that read back as the same double."""
    return _dump({"from": start, "to": end, "matrix": [list(row) for row in numbers]})


def _strings(matrix: Any, notation: Notation) -> list[list[str]]:
    writer = PlainWriter()
    rows, columns = matrix.shape
    return [
        [writer.text(notation.write(matrix[r, c])) for c in range(columns)] for r in range(rows)
    ]


def _dump(content: dict[str, Any]) -> str:
    """Write one matrix row a line."""
    parts = []
    for key, value in content.items():
        if isinstance(value, list):
            rows = ",\n    ".join(json.dumps(row, ensure_ascii=False) for row in value)
            parts.append(f'  "{key}": [\n    {rows}\n  ]')
        else:
            parts.append(f'  "{key}": {json.dumps(value)}')
    return "{\n" + ",\n".join(parts) + "\n}"
