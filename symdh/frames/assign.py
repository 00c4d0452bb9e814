"""Joint axes -> frames -> a table."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from sympy import Expr, Integer, pi

from symdh.errors import UnsupportedError
from symdh.frames import vectors as v
from symdh.frames.exact import is_zero, tidy
from symdh.frames.faults import AssignmentError
from symdh.frames.geometry import Line, number
from symdh.frames.modified import home_motion, place_modified
from symdh.frames.placed import Measured, PlacedFrame, measure, seen_from, word_to
from symdh.frames.reading import check_frames, placed, read_frames
from symdh.frames.settle import Settled, rounded, settle, shortened
from symdh.frames.standard import place_standard, tool_frame
from symdh.frames.story import Assignment, OriginRule, Step, XRule
from symdh.mechanism import ZERO, JointAxis, Mechanism
from symdh.motion import Word, rotation
from symdh.robot import Axis, Convention, Joint, JointType, MotionKind, Robot

#: Rounded numbers below this are what rounding left of zero (times the mechanism's unit).
_NOISE = 1e-12
#: Rounded angles nearer than this to a whole half degree are that angle.
_NEAR_HALF_DEGREE = 1e-9


def assign(mechanism: Mechanism, convention: Convention | None = None) -> Robot:
    """Return the table of a mechanism, base and tool words included.

    Parameters
    ----------
    mechanism : Mechanism
    convention : Convention, optional
        By default the mechanism's own, else standard.

    Raises
    ------
    AssignmentError
        When a direction is no unit vector, a choice breaks a rule, or the tool is out of reach of
        the last row (only with ``last=Last.TOOL``).
    UnsupportedError
        When there is no joint.
    """
    return assign_frames(mechanism, convention).robot


def assign_frames(mechanism: Mechanism, convention: Convention | None = None) -> Assignment:
    """Return the table of a mechanism with the frames that lead to it; see `assign`."""
    if not mechanism.axes:
        raise UnsupportedError("a mechanism needs at least one joint")
    convention = convention or mechanism.convention or Convention.STANDARD
    if mechanism.poses:
        return _of_given_frames(mechanism, convention)
    settled = settle(mechanism)
    snaps = list(settled.snaps)
    if convention is Convention.STANDARD:
        steps, more = place_standard(mechanism, settled)
        snaps += more
    else:
        steps = place_modified(mechanism, settled)
    exact = settled.exact and not snaps
    measured = [
        measure(before.placed, after.placed, convention) for before, after in pairwise(steps)
    ]
    if not exact:
        measured = [_neat(each, settled) for each in measured]
    robot = _table(mechanism, convention, steps, measured, settled, exact)
    return Assignment(
        mechanism, convention, robot, tuple(steps), tuple(measured), tuple(snaps), exact
    )


def _of_given_frames(mechanism: Mechanism, convention: Convention) -> Assignment:
    """Return the table of frames that are given outright, the axes read off them."""
    tolerance = mechanism.tolerance
    measured = read_frames(mechanism.poses, convention, tolerance)
    exact = _obeys_exactly(mechanism, convention)
    frames = [placed(pose) for pose in mechanism.poses]
    own = frames[:-1] if convention is Convention.STANDARD else frames[1:]
    axes = tuple(
        replace(axis, point=frame.origin, direction=v.negate(frame.z) if axis.reverse else frame.z)
        for axis, frame in zip(mechanism.axes, own, strict=True)
    )
    mechanism = replace(mechanism, axes=axes)
    rules = (OriginRule.GIVEN, XRule.GIVEN)
    steps = [Step(i, None, None, *rules, False, frame) for i, frame in enumerate(frames)]
    lines = tuple(Line(axis.point, axis.direction) for axis in axes)
    settled = Settled(lines, (), tolerance, ZERO, exact)
    rows = list(measured) if exact else [_neat(each, settled) for each in measured]
    robot = _table(mechanism, convention, steps, rows, settled, exact)
    return Assignment(mechanism, convention, robot, tuple(steps), tuple(rows), (), exact)


def _obeys_exactly(mechanism: Mechanism, convention: Convention) -> bool:
    try:
        check_frames(mechanism.poses, convention)
    except AssignmentError:
        return False
    return True


def _table(
    mechanism: Mechanism,
    convention: Convention,
    steps: list[Step],
    measured: list[Measured],
    settled: Settled,
    exact: bool,
) -> Robot:
    base = word_to(steps[0].bare if exact else _short(steps[0].bare))
    base = _joined(base, (rotation(Axis.Z, steps[0].turn),))
    tool = _tool_word(mechanism, steps[-1].bare, settled, exact)
    tool = _joined((rotation(Axis.Z, -steps[-1].turn),), tool) if mechanism.tool else ()
    if not exact:
        base, tool = (_neat_word(word) for word in (base, tool))
    robot = Robot(
        name=mechanism.name,
        convention=convention,
        joints=tuple(_row(axis, each) for axis, each in zip(mechanism.axes, measured, strict=True)),
        base=base,
        tool=tool,
        title=mechanism.title,
        units=mechanism.units,
    )
    symbols = {*robot.variables, *robot.parameters}
    return replace(
        robot,
        values={s: value for s, value in mechanism.values.items() if s in symbols},
        limits=mechanism.limits,
    )


def _joined(first: Word, second: Word) -> Word:
    """Return two words after each other; turns about one axis that meet are added."""
    first, second = (tuple(m for m in word if not is_zero(m.amount)) for word in (first, second))
    if first and second:
        last, then = first[-1], second[0]
        if (last.kind, last.axis) == (then.kind, then.axis):
            together = replace(last, amount=last.amount + then.amount)
            return _joined((*first[:-1], together), second[1:])
    return first + second


def _row(axis: JointAxis, measured: Measured) -> Joint:
    """Return a row: what was measured at home, and the variable with the offset from there."""
    slid, turn = home_motion(axis)
    factor = -axis.ratio if axis.reverse else axis.ratio
    theta, d = measured.theta, measured.d
    if axis.type is JointType.REVOLUTE:
        theta = factor * axis.variable + _principal(tidy(theta - turn))
    else:
        d = factor * axis.variable + tidy(d - slid)
    return Joint(axis.type, theta, d, measured.a, measured.alpha, axis.variable)


def _principal(offset: Expr) -> Expr:
    """Return a constant angle in (-pi, pi]; whole turns of an offset say nothing."""
    turns = offset / (2 * pi)
    if not turns.is_Rational:
        return offset
    return offset - 2 * pi * (turns - Integer(1) / 2).ceiling()


def _tool_word(mechanism: Mechanism, last: PlacedFrame, settled: Settled, exact: bool) -> Word:
    """Return the word from frame n, not yet turned to its home, to the tool."""
    tool = mechanism.tool
    if tool is None:
        return ()
    if tool.approach is None or tool.sliding is None:
        aimed = PlacedFrame(tool.point, last.x, last.z)
    else:
        aimed = tool_frame(tool, settled)
    inside = seen_from(last, aimed)
    return word_to(inside if exact else _short(inside))


def _short(frame: PlacedFrame) -> PlacedFrame:
    return PlacedFrame(shortened(frame.origin), shortened(v.unit(frame.x)), shortened(frame.z))


def _neat(measured: Measured, settled: Settled) -> Measured:
    """Return rounded measures, near-right angles and near-zero lengths as what they mean."""
    return replace(
        measured,
        theta=_neat_angle(measured.theta, settled.angular),
        alpha=_neat_angle(measured.alpha, settled.angular),
        d=_neat_length(measured.d),
        a=_neat_length(measured.a),
    )


def _neat_word(word: Word) -> Word:
    neat = (
        replace(
            motion,
            amount=_neat_angle(motion.amount, Integer(0))
            if motion.kind is MotionKind.ROTATION
            else _neat_length(motion.amount),
        )
        for motion in word
    )
    return tuple(motion for motion in neat if not is_zero(motion.amount))


def _neat_angle(amount: Expr, limit: Expr) -> Expr:
    if amount.free_symbols or (amount / pi).is_Rational:
        return amount
    value = float(number(amount))
    quarter = round(value / float(number(pi / 2)))
    if abs(value - float(number(quarter * pi / 2))) <= limit:
        return Integer(quarter) * pi / 2
    halves = round(value / float(number(pi / 360)))
    if abs(value - float(number(halves * pi / 360))) < _NEAR_HALF_DEGREE:
        return Integer(halves) * pi / 360
    return rounded(amount)


def _neat_length(amount: Expr) -> Expr:
    if amount.free_symbols:
        return amount
    return Integer(0) if abs(float(number(amount))) < _NOISE else rounded(amount)
