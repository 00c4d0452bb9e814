"""The free choices of a frame, checked against what the rules leave open."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Expr

from symdh.frames import vectors as v
from symdh.frames.exact import is_positive, is_zero
from symdh.frames.faults import AssignmentError, Fault
from symdh.frames.geometry import Line, Relation, is_small
from symdh.frames.placed import PlacedFrame
from symdh.frames.settle import Settled, checked_unit, shortened
from symdh.frames.story import OriginRule, Step, XRule
from symdh.mechanism import ZERO, FrameChoice, Mechanism, Vector


@dataclass(frozen=True, slots=True)
class Default:
    """What the rules say of a frame.

    Attributes
    ----------
    origin, x : Vector
    origin_rule, x_rule : OriginRule, XRule
    free_origin, free_x : bool
        Whether the origin may be anywhere on the z axis, and x anywhere at right angles to it;
        else x may only be turned round.
    """

    origin: Vector
    x: Vector
    origin_rule: OriginRule
    x_rule: XRule
    free_origin: bool = False
    free_x: bool = False


@dataclass(frozen=True)
class Chooser:
    """Places frames by the rules and by what was chosen."""

    mechanism: Mechanism
    settled: Settled

    def frame(
        self,
        number: int,
        default: Default,
        line: Line,
        relation: Relation | None = None,
        axes: tuple[int, int] | None = None,
        turn: Expr = ZERO,
    ) -> Step:
        """Return frame `number` on its z axis.

        Raises
        ------
        AssignmentError
            When a choice breaks a rule.
        """
        choice = self.mechanism.choice(number)
        origin, origin_rule = self._origin(number, choice, default, line, relation)
        x, x_rule = self._x(number, choice, default, line)
        if not self.settled.exact:
            origin, x = shortened(origin), shortened(x)
        bare = PlacedFrame(origin, x, line.direction)
        turn = ZERO if x_rule is XRule.CHOSEN else turn
        same = v.dot(x, default.x)
        reverse = not default.free_x and not is_positive(same)
        return Step(number, relation, axes, origin_rule, x_rule, reverse, bare, turn)

    def _origin(
        self,
        number: int,
        choice: FrameChoice,
        default: Default,
        line: Line,
        relation: Relation | None,
    ) -> tuple[Vector, OriginRule]:
        if choice.origin is None:
            return default.origin, default.origin_rule
        subject = ("frame", number, "origin")
        wanted = choice.origin
        if not default.free_origin:
            if self._same(wanted, default.origin):
                return default.origin, default.origin_rule
            message = f"the origin of frame {number} is not free: it is {shown(default.origin)}"
            raise AssignmentError([Fault(subject, message)])
        if relation is Relation.PARALLEL:
            return line.nearest(wanted), OriginRule.CHOSEN
        if not line.holds(wanted, self.settled.linear):
            message = f"this point is not on the z axis of frame {number}"
            raise AssignmentError([Fault(subject, message)])
        return line.nearest(wanted), OriginRule.CHOSEN

    def _x(
        self, number: int, choice: FrameChoice, default: Default, line: Line
    ) -> tuple[Vector, XRule]:
        if choice.x is None:
            reverse = choice.reverse_x
            rule = XRule.CHOSEN if reverse and default.free_x else default.x_rule
            return (v.negate(default.x) if reverse else default.x), rule
        subject = ("frame", number, "x")
        x, _ = checked_unit(choice.x, subject, self.settled.angular)
        limit = ZERO if self.settled.exact else self.settled.angular
        if not is_small(v.dot(x, line.direction), limit):
            message = f"x of frame {number} must be at right angles to its z axis"
            raise AssignmentError([Fault(subject, message)])
        crossed = v.cross(v.unit(default.x), x)
        if not default.free_x and not all(is_small(entry, limit) for entry in crossed):
            wanted = shown(v.unit(default.x))
            message = f"x of frame {number} lies along the common normal: {wanted} or its opposite"
            raise AssignmentError([Fault(subject, message)])
        return x, XRule.CHOSEN if default.free_x else default.x_rule

    def _same(self, a: Vector, b: Vector) -> bool:
        return all(is_small(entry, self.settled.linear) for entry in v.subtract(a, b))


def world_x(z: Vector) -> Vector:
    """Return the x axis that needs the shortest base word: the world's where that can be.

    Else it is at right angles to both z axes, so that the base turns about z and x alone.
    """
    if is_zero(v.dot(v.X, z)):
        return v.X
    return v.ray(v.cross(v.Z, z))


def shown(vector: Vector) -> str:
    """Write a vector for a message."""
    return f"[{', '.join(str(entry) for entry in vector)}]"
