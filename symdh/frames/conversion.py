"""One convention into the other, exactly: the same word of motions, cut at other places.

Between two joint axes stand Tx(a_i) Rx(alpha_i). The standard table writes them into row i, the
modified one into row i + 1; what is left over at either end of the chain goes into the base or the
tool word. Nothing is computed, so the pose is the same for every q.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from sympy import Expr

from symdh.errors import LimitError
from symdh.motion import Word, rotation, translation
from symdh.robot import ZERO, Axis, Convention, Joint, Motion, MotionKind, Robot
from symdh.table.words import MAX_MOTIONS


@dataclass(frozen=True, slots=True)
class ScrewX:
    """A turn about the x axis with a slide along it; the order of the two does not matter.

    Attributes
    ----------
    alpha : Expr
        Radians.
    a : Expr
        The table's unit of length.
    """

    alpha: Expr = ZERO
    a: Expr = ZERO

    def word(self) -> Word:
        """Return the motions that do something."""
        motions = (translation(Axis.X, self.a), rotation(Axis.X, self.alpha))
        return tuple(motion for motion in motions if not motion.amount.is_zero)

    def then(self, motion: Motion) -> ScrewX:
        """Return this screw with one more motion about or along x."""
        if motion.kind is MotionKind.ROTATION:
            return replace(self, alpha=self.alpha + motion.amount)
        return replace(self, a=self.a + motion.amount)


def convert(robot: Robot, convention: Convention) -> Robot:
    """Write a table in the other convention.

    Parameters
    ----------
    robot : Robot
    convention : Convention
        The one that is wanted; a robot that has it already is returned as it is.

    Returns
    -------
    Robot
        With the same joint variables and, for every q, the same pose of the tool in the base.
        Joint values, limits, units and names are kept.

    Raises
    ------
    LimitError
        When a base or tool word would become longer than a table may have it.
    """
    if robot.convention is convention:
        return robot
    own = [ScrewX(joint.alpha, joint.a) for joint in robot.joints]
    if convention is Convention.MODIFIED:
        # Row 1 takes what the base ends with; what row n had goes to the tool.
        base, first = _without_tail(robot.base)
        return _rebuilt(robot, convention, base, [first, *own[:-1]], own[-1].word() + robot.tool)
    last, tool = _without_head(robot.tool)
    return _rebuilt(robot, convention, robot.base + own[0].word(), [*own[1:], last], tool)


def _rebuilt(
    robot: Robot, convention: Convention, base: Word, screws: Sequence[ScrewX], tool: Word
) -> Robot:
    for place, word in (("base", base), ("tool", tool)):
        if len(word) > MAX_MOTIONS:
            raise LimitError(f"{place} of {robot.name} would have over {MAX_MOTIONS} motions")
    joints = (_with(joint, screw) for joint, screw in zip(robot.joints, screws, strict=True))
    converted = replace(robot, convention=convention, joints=tuple(joints), base=base, tool=tool)
    # a4 of a row and Tx(-a4) of the tool cancel: a symbol may be gone, and its value with it.
    left = {*converted.variables, *converted.parameters}
    values = {symbol: value for symbol, value in robot.values.items() if symbol in left}
    return replace(converted, values=values)


def _with(joint: Joint, screw: ScrewX) -> Joint:
    return replace(joint, alpha=screw.alpha, a=screw.a)


def _without_tail(word: Word) -> tuple[Word, ScrewX]:
    """Cut the motions about and along x off the end of a word."""
    cut = len(word)
    while cut and word[cut - 1].axis is Axis.X:
        cut -= 1
    return word[:cut], _screw(word[cut:])


def _without_head(word: Word) -> tuple[ScrewX, Word]:
    """Cut the motions about and along x off the start of a word."""
    cut = 0
    while cut < len(word) and word[cut].axis is Axis.X:
        cut += 1
    return _screw(word[:cut]), word[cut:]


def _screw(motions: Word) -> ScrewX:
    screw = ScrewX()
    for motion in motions:
        screw = screw.then(motion)
    return screw
