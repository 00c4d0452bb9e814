"""Frames by the rules of the standard (distal) convention: z_i on joint i + 1."""

from __future__ import annotations

from sympy import Expr

from symdh.frames import vectors as v
from symdh.frames.choices import Chooser, Default, world_x
from symdh.frames.faults import AssignmentError, Fault
from symdh.frames.geometry import Line, Pair, Relation, is_small, number, plain, relate
from symdh.frames.placed import PlacedFrame
from symdh.frames.settle import ROUNDING, Settled, Snap, checked_unit
from symdh.frames.story import OriginRule, Step, XRule
from symdh.mechanism import Last, Mechanism, ToolFrame


def place_standard(mechanism: Mechanism, settled: Settled) -> tuple[list[Step], list[Snap]]:
    """Return frames 0 .. n, and what was snapped on the way.

    Frame 0 is on axis 1. Frame i, i < n, is where the common normal of axes i and i + 1 meets
    axis i + 1, its x along that normal (Denavit & Hartenberg 1955, Spong). Frame n is at the tool.

    Raises
    ------
    AssignmentError
        When a choice breaks a rule, or the tool is no frame that a row can reach.
    """
    chooser = Chooser(mechanism, settled)
    first = settled.lines[0]
    start = Default(
        first.point,
        world_x(first.direction),
        OriginRule.AXIS_POINT,
        XRule.WORLD,
        free_origin=True,
        free_x=True,
    )
    steps = [chooser.frame(0, start, first)]
    for i in range(1, mechanism.n):
        before, line = settled.lines[i - 1], settled.lines[i]
        pair = relate(before, line, settled.angular, settled.linear)
        default = _default(pair, steps[-1].placed)
        steps.append(chooser.frame(i, default, line, pair.relation, (i, i + 1)))
    last, snaps = _last(chooser, steps[-1].placed)
    return [*steps, last], snaps


def _default(pair: Pair, before: PlacedFrame) -> Default:
    """Return the frame on the second axis of a pair."""
    if pair.relation is Relation.COINCIDENT or pair.normal is None:
        origin = pair.second.nearest(before.origin)
        return Default(origin, before.x, OriginRule.SAME, XRule.SAME, True, True)
    if pair.feet is None:
        origin = pair.second.nearest(before.origin)
        rule = OriginRule.THROUGH_PREVIOUS
        return Default(origin, pair.normal, rule, XRule.COMMON_NORMAL, free_origin=True)
    if pair.relation is Relation.INTERSECTING:
        return Default(pair.feet[1], pair.normal, OriginRule.MEETING, XRule.PLANE_NORMAL)
    return Default(pair.feet[1], pair.normal, OriginRule.FOOT, XRule.COMMON_NORMAL)


def _last(chooser: Chooser, before: PlacedFrame) -> tuple[Step, list[Snap]]:
    """Return frame n: at the tool where a row reaches it, else on the last axis."""
    mechanism = chooser.mechanism
    n, line, tool = mechanism.n, chooser.settled.lines[-1], mechanism.tool
    if tool is not None and mechanism.last is not Last.JOINT:
        if tool.approach is None or tool.sliding is None:
            return _at_tip(chooser, before, tool), []
        aimed = tool_frame(tool, chooser.settled)
        misses = _misses(before, aimed)
        limits = (chooser.settled.angular, chooser.settled.linear)
        kept = [m for m, limit in zip(misses, limits, strict=True) if is_small(m, limit)]
        if len(kept) == len(misses):
            snaps = [
                Snap(("tool",), f"frame {n}: obeys the rules at the tool", size, angular)
                for m, angular in zip(misses, (True, False), strict=True)
                if (size := abs(float(number(m))) if not m.free_symbols else 0.0) > ROUNDING
            ]
            rules = (OriginRule.TOOL, XRule.TOOL_NORMAL)
            return Step(n, None, None, *rules, reversed_x=False, bare=aimed), snaps
        if mechanism.last is Last.TOOL:
            raise AssignmentError([Fault(("tool",), _why_out_of_reach(n, misses, limits))])
    origin = line.nearest(before.origin)
    default = Default(origin, before.x, OriginRule.NO_OFFSET, XRule.NO_ANGLE, True, True)
    return chooser.frame(n, default, line), []


def _at_tip(chooser: Chooser, before: PlacedFrame, tool: ToolFrame) -> Step:
    """Return frame n for a tool of which only the tip is known: z_n parallel to the last axis."""
    n, line = chooser.mechanism.n, chooser.settled.lines[-1]
    offset = v.subtract(tool.point, line.nearest(tool.point))
    on_axis = line.holds(tool.point, chooser.settled.linear)
    default = Default(
        tool.point,
        before.x if on_axis else v.ray(offset),
        OriginRule.TOOL,
        XRule.NO_ANGLE if on_axis else XRule.TOWARDS_TOOL,
        free_x=on_axis,
    )
    return chooser.frame(n, default, Line(tool.point, line.direction))


def tool_frame(tool: ToolFrame, settled: Settled) -> PlacedFrame:
    """Return the frame of a tool: x normal, y sliding, z approach (Schilling).

    Raises
    ------
    AssignmentError
        When its vectors are no unit vectors, or not at right angles.
    """
    assert tool.approach is not None
    assert tool.sliding is not None
    approach, _ = checked_unit(tool.approach, ("tool", "approach"), settled.angular)
    sliding, _ = checked_unit(tool.sliding, ("tool", "sliding"), settled.angular)
    cosine = v.dot(approach, sliding)
    if not is_small(cosine, settled.angular):
        message = "sliding must be at right angles to approach"
        raise AssignmentError([Fault(("tool", "sliding"), message)])
    return PlacedFrame(tool.point, v.cross(sliding, approach), approach)


def _misses(before: PlacedFrame, aimed: PlacedFrame) -> tuple[Expr, Expr]:
    """Return x_n . z_{n-1}, and how far the two lines pass each other: both zero for a row."""
    cosine = v.dot(before.z, aimed.x)
    across = v.cross(before.z, aimed.x)
    return cosine, v.dot(v.subtract(aimed.origin, before.origin), across)


def _why_out_of_reach(n: int, misses: tuple[Expr, Expr], limits: tuple[Expr, Expr]) -> str:
    cosine, distance = misses
    if not is_small(cosine, limits[0]):
        why = f"x_{n} (normal) is not perpendicular to z_{n - 1}: their product is {plain(cosine)}"
    else:
        apart = plain(abs(distance))
        why = f"x_{n} (normal) does not meet z_{n - 1}: they pass at a distance of {apart}"
    return f"no row reaches this tool, as {why}; write `last: joint` to reach it by a tool word"
