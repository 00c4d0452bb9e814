"""A robot as data for the page's picture: its motions as functions of the sliders' values."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from sympy import Expr, Symbol, pi

from symdh.codegen.calls import JAVASCRIPT
from symdh.codegen.graph import Graph
from symdh.codegen.lowering import Lowering
from symdh.codegen.printer import Printer
from symdh.derivation.drawing.numbers import UNKNOWN_LENGTH, known_numbers, stand_ins
from symdh.derivation.numbers import angles
from symdh.kinematics.chain import segment
from symdh.kinematics.frame import first_frame, last_frame, place
from symdh.notation import Notation
from symdh.notation.nodes import Name
from symdh.render.unicode_math import UnicodeWriter
from symdh.robot import AngleUnit, Convention, JointType, Motion, MotionKind, Robot

_LETTERS = {("R", 2): "θ", ("T", 2): "d", ("T", 0): "a", ("R", 0): "α"}


def arm_script(robot: Robot) -> str:
    """Return the robot as a JavaScript object literal.

    Attributes of the object: ``start`` (name of the first frame), ``segments`` (one a frame, each
    with its motions ``[kind, axis, amount(values), label]``) and ``sliders``.
    """
    first, last = place(robot, first_frame(robot)), place(robot, last_frame(robot))
    segments = ",\n".join(_segment(robot, k) for k in range(first, last))
    sliders = ",\n".join(f"  {json.dumps(s, ensure_ascii=True)}" for s in _sliders(robot))
    start = json.dumps(str(first_frame(robot)))
    return f"{{start: {start},\nsegments: [\n{segments}\n],\nsliders: [\n{sliders}\n]}}"


def _segment(robot: Robot, k: int) -> str:
    """Return one segment of the chain: the base words, a link, or the tool words."""
    row = k + 1 if 0 <= k < robot.n else None
    kind = robot.joints[k].type if row else JointType.FIXED
    # The joint acts at the start of a standard link and behind the twist of a modified one.
    at = 2 if row and robot.convention is Convention.MODIFIED else 0
    frame = "tool" if k == robot.n else str(k + 1)
    motions = ", ".join(_motion(robot, motion, row) for motion in segment(robot, k))
    head = f"frame: {json.dumps(frame)}, type: {json.dumps(kind.value)}, joint: {at}"
    return f"  {{{head}, motions: [{motions}]}}"


def _motion(robot: Robot, motion: Motion, row: int | None) -> str:
    kind, axis = motion.kind.value, int(motion.axis)
    label = json.dumps(_label(robot, motion, row), ensure_ascii=True)
    return f'["{kind}", {axis}, (v) => {_code(robot, motion.amount)}, {label}]'


def _label(robot: Robot, motion: Motion, row: int | None) -> str:
    """Return what a dimension is called: its symbol, or its letter and its number."""
    notation, writer = Notation(robot), UnicodeWriter()
    turning = motion.kind is MotionKind.ROTATION
    node = notation.angle(motion.amount) if turning else notation.write(motion.amount)
    text = writer.text(node)
    if row is None or isinstance(node, Name):
        return text
    letter = _LETTERS[motion.kind.value, int(motion.axis)]
    shift = robot.convention is Convention.MODIFIED and letter in "aα"
    return f"{letter}{_subscript(row - shift)} = {text}"


def _subscript(number: int) -> str:
    return "".join(chr(ord("₀") + int(digit)) for digit in str(number))


def _code(robot: Robot, amount: Expr) -> str:
    graph = Graph()
    node = Lowering(graph, {}).node(amount)
    names = {
        graph.symbol(symbol): f"v[{json.dumps(symbol.name)}]" for symbol in amount.free_symbols
    }
    return Printer(JAVASCRIPT, names).expression(node)


def _sliders(robot: Robot) -> Iterable[dict[str, Any]]:
    turning = angles(robot)
    writer, notation = UnicodeWriter(), Notation(robot)
    values = _values(robot)
    reach = sum(abs(values[s]) for s in robot.parameters if s not in turning) or UNKNOWN_LENGTH
    for symbol in (*robot.variables, *robot.parameters):
        angle = symbol in turning
        low, high = _range(robot, symbol, values[symbol], angle, reach)
        degrees = angle and robot.units.angle is not AngleUnit.RADIAN
        unit = "°" if degrees else (" rad" if angle else _length_unit(robot))
        yield {
            "name": symbol.name,
            "label": writer.text(notation.write(symbol)),
            "low": low,
            "high": high,
            "value": min(max(values[symbol], low), high),
            "degrees": degrees,
            "unit": unit,
        }


def _values(robot: Robot) -> dict[Symbol, float]:
    """Return where the sliders start: what is known, else joints at zero or as near as they get."""
    known = known_numbers(robot, {})
    values = {**stand_ins(robot, known), **known}
    for symbol in robot.variables:
        if symbol not in known:
            low, high = _limits(robot, symbol) or (0.0, 0.0)
            values[symbol] = min(max(0.0, low), high)
    return values


def _limits(robot: Robot, symbol: Symbol) -> tuple[float, float] | None:
    if symbol not in robot.limits:
        return None
    limits = robot.limits[symbol]
    return float(limits.lower.evalf()), float(limits.upper.evalf())


def _range(
    robot: Robot, symbol: Symbol, value: float, angle: bool, reach: float
) -> tuple[float, float]:
    limits = _limits(robot, symbol)
    if limits is not None:
        return limits
    if angle:
        bound = max(float(pi), abs(value))
        return -bound, bound
    if symbol in robot.variables:
        bound = max(reach, abs(value))
        return -bound, bound
    return (2 * value, 0.0) if value < 0 else (0.0, 2 * value or reach)


def _length_unit(robot: Robot) -> str:
    return f" {robot.units.length.value}" if robot.units.length else ""
