"""Frames by the rules of the modified (proximal) convention: z_i on joint i."""

from __future__ import annotations

from sympy import Expr

from symdh.frames import vectors as v
from symdh.frames.choices import Chooser, Default, world_x
from symdh.frames.geometry import Pair, Relation, relate
from symdh.frames.settle import Settled
from symdh.frames.story import OriginRule, Step, XRule
from symdh.mechanism import JointAxis, Mechanism, Vector
from symdh.robot import JointType


def place_modified(mechanism: Mechanism, settled: Settled) -> list[Step]:
    """Return frames 0 .. n.

    Frame i, 0 < i < n, is on axis i where the common normal to axis i + 1 leaves it, its x along
    that normal. Frame {0} is frame {1} with the first variable at zero; frame {n} makes theta_n
    (revolute) or d_n (prismatic) its variable alone and the other one zero (Craig).

    Raises
    ------
    AssignmentError
        When a choice breaks a rule.
    """
    chooser = Chooser(mechanism, settled)
    steps: list[Step] = []
    # b_i, where x_{i-1} meets axis i: an origin there makes d_i zero.
    reached = settled.lines[0].point
    x = world_x(settled.lines[0].direction)
    for i in range(1, mechanism.n):
        line, after = settled.lines[i - 1], settled.lines[i]
        pair = relate(line, after, settled.angular, settled.linear)
        default = _default(pair, reached, x, first=i == 1)
        step = chooser.frame(i, default, line, pair.relation, (i, i + 1))
        steps.append(step)
        reached = pair.feet[1] if pair.feet else after.nearest(step.placed.origin)
        x = step.placed.x
    steps.append(_last(chooser, reached, x))
    return [_first(chooser, steps[0]), *steps]


def _default(pair: Pair, reached: Vector, x: Vector, first: bool) -> Default:
    """Return the frame on the first axis of a pair."""
    origin_rule = OriginRule.AXIS_POINT if first else OriginRule.THROUGH_PREVIOUS
    if pair.relation is Relation.COINCIDENT or pair.normal is None:
        x_rule = XRule.WORLD if first else XRule.SAME
        return Default(reached, x, origin_rule if first else OriginRule.SAME, x_rule, True, True)
    if pair.feet is None:
        return Default(reached, pair.normal, origin_rule, XRule.COMMON_NORMAL, free_origin=True)
    if pair.relation is Relation.INTERSECTING:
        return Default(pair.feet[0], pair.normal, OriginRule.MEETING, XRule.PLANE_NORMAL)
    return Default(pair.feet[0], pair.normal, OriginRule.FOOT, XRule.COMMON_NORMAL)


def _last(chooser: Chooser, reached: Vector, x: Vector) -> Step:
    """Return frame n, which differs from the one before by the variable alone, if that can be."""
    mechanism = chooser.mechanism
    axis, line = mechanism.axes[-1], chooser.settled.lines[-1]
    if mechanism.n == 1:
        default = Default(reached, x, OriginRule.AXIS_POINT, XRule.WORLD, True, True)
        return chooser.frame(1, default, line)
    slid, turn = home_motion(axis)
    reached = v.along(reached, slid, line.direction)
    default = Default(reached, x, OriginRule.NO_OFFSET, XRule.NO_ANGLE, True, True)
    return chooser.frame(mechanism.n, default, line, turn=turn)


def _first(chooser: Chooser, step: Step) -> Step:
    """Return frame 0: frame 1, moved back from home to where its variable is zero."""
    line = chooser.settled.lines[0]
    slid, turn = home_motion(chooser.mechanism.axes[0])
    default = Default(
        v.along(step.placed.origin, -slid, line.direction),
        step.placed.x,
        OriginRule.LIKE_FIRST,
        XRule.LIKE_FIRST,
        free_origin=True,
        free_x=True,
    )
    return chooser.frame(0, default, line, turn=-turn)


def home_motion(axis: JointAxis) -> tuple[Expr, Expr]:
    """Return how far a joint has slid and turned, along and about its frame's z, at home."""
    amount = axis.ratio * axis.home * (-1 if axis.reverse else 1)
    zero = amount * 0
    return (zero, amount) if axis.type is JointType.REVOLUTE else (amount, zero)
