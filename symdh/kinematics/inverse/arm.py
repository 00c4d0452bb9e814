"""The arm as the equations see it: letters for its lengths, the known offsets at both ends gone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from sympy import Expr, Integer, Symbol, pi

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import link_word
from symdh.motion import Word
from symdh.robot import Axis, Joint, JointType, Motion, MotionKind, Robot

_ZERO = Integer(0)
Offset = tuple[Expr, Expr, Expr]


@dataclass(frozen=True)
class InverseArm:
    """An arm prepared for inverse kinematics.

    Attributes
    ----------
    given : Robot
        The robot as the table has it, locked joints still moving.
    robot : Robot
        The same with a letter for every length that is no plain symbol and with locked joints
        fixed; its `values` hold the numbers of the new letters too.
    meanings : mapping of Symbol to Expr
        What the new letters stand for.
    locked : tuple of Symbol
        Joint variables that are held.
    rows : tuple of Word
        One word for each row, without the translations of `front` and `hand`; the base stands
        in front of the first one where `base_inside`, the tool at the end of the last one where
        `tool_inside`.
    front, hand : three Expr
        Known translations at both ends of the chain: the goal is
        ``w = p - front - R hand``.
    tool_inside : bool
        Whether the tool is part of the chain: so where the position alone is asked for.
    base_inside : bool
        Whether the base is part of the chain: so where some coordinates of the position are not
        given, for a base that is turned would mix them with those that are.
    """

    given: Robot
    robot: Robot
    meanings: Mapping[Symbol, Expr]
    locked: tuple[Symbol, ...]
    rows: tuple[Word, ...]
    front: Offset
    hand: Offset
    tool_inside: bool
    base_inside: bool

    @property
    def moving(self) -> tuple[int, ...]:
        """The rows, from 1, whose joints move."""
        return tuple(i for i, j in enumerate(self.robot.joints, start=1) if j.variable is not None)

    @property
    def turning(self) -> tuple[int, ...]:
        """The rows, from 1, whose joints turn."""
        joints = enumerate(self.robot.joints, start=1)
        return tuple(i for i, joint in joints if joint.type is JointType.REVOLUTE)

    @property
    def is_shifted(self) -> bool:
        """Whether an offset at one of the ends was taken to the known side."""
        return any(not part.is_zero for part in (*self.front, *self.hand))


def prepare(
    robot: Robot, locked: Iterable[Symbol] = (), *, whole_pose: bool, whole_position: bool
) -> InverseArm:
    """Return a robot as the equations see it.

    Parameters
    ----------
    robot : Robot
    locked : iterable of Symbol
        Joint variables to hold.
    whole_pose : bool
        Whether the goal is a whole pose: then the offset of the hand is known as well.
    whole_position : bool
        Whether all coordinates of the position are given, or none.

    Raises
    ------
    UnsupportedError
        When a variable to be locked is none of the robot's.
    """
    held = tuple(locked)
    inside = bool(robot.tool) and not whole_pose
    base_inside = bool(robot.base) and not whole_position
    lettered, meanings = _lettered(_fixed(robot, held), base=base_inside, tool=inside)
    rows = [link_word(lettered, i) for i in range(1, robot.n + 1)]
    if base_inside:
        rows[0] = lettered.base + rows[0]
    if inside:
        rows[-1] += lettered.tool
    moving = [k for k, joint in enumerate(lettered.joints) if joint.variable is not None]
    if not moving:
        why = "has every joint locked" if held else "has no joint that moves"
        raise UnsupportedError(f"{robot.name} {why}, so there is nothing to find")
    _gather(rows, range(moving[0] + 1), moving[0])
    rows[moving[0]], front = _without_lead(rows[moving[0]], lettered)
    hand = (_ZERO, _ZERO, _ZERO)
    if whole_pose:
        last = moving[-1]
        _gather(rows, range(last, len(rows)), last)
        turned, offset = _without_lead(_reversed(rows[last]), lettered)
        rows[last] = _reversed(turned)
        hand = (-offset[0], -offset[1], -offset[2])
    ends = inside, base_inside
    return InverseArm(robot, lettered, meanings, held, tuple(rows), front, hand, *ends)


def _gather(rows: list[Word], places: range, into: int) -> None:
    """Join the words of fixed rows at an end of the chain with that of their neighbour."""
    joined = tuple(motion for k in places for motion in rows[k])
    for k in places:
        rows[k] = ()
    rows[into] = joined


def _fixed(robot: Robot, locked: tuple[Symbol, ...]) -> Robot:
    for variable in locked:
        if variable not in robot.variables:
            known = ", ".join(v.name for v in robot.variables)
            raise UnsupportedError(
                f"{variable.name} is no joint variable of {robot.name}; these are: {known}"
            )
    joints = tuple(
        replace(joint, type=JointType.FIXED, variable=None) if joint.variable in locked else joint
        for joint in robot.joints
    )
    return replace(robot, joints=joints)


def _lettered(robot: Robot, *, base: bool, tool: bool) -> tuple[Robot, dict[Symbol, Expr]]:
    """Put a letter for every length that is a number or a formula, and nothing for zeros.

    Base and tool get letters where they are part of the chain.
    """
    letters = _Letters(robot)
    joints = tuple(
        replace(joint, a=letters.length(joint.a, f"a{i}"), d=letters.offset(joint, f"d{i}"))
        for i, joint in enumerate(_without_zeros(robot), start=1)
    )
    before = letters.of_end(robot.base, "b") if base else robot.base
    after = letters.of_end(robot.tool, "l") if tool else robot.tool
    known = dict(robot.values)
    for letter, meaning in letters.meanings.items():
        value = meaning.xreplace(known)
        if not value.free_symbols:
            known[letter] = value
    return replace(robot, joints=joints, base=before, tool=after, values=known), letters.meanings


def _without_zeros(robot: Robot) -> Iterable[Joint]:
    """Put zero for the parameters that the table says are zero."""
    parameters = set(robot.parameters)
    zeros = {s: _ZERO for s, v in robot.values.items() if v.is_zero and s in parameters}
    for joint in robot.joints:
        yield replace(
            joint,
            theta=joint.theta.xreplace(zeros),
            d=joint.d.xreplace(zeros),
            a=joint.a.xreplace(zeros),
            alpha=joint.alpha.xreplace(zeros),
        )


class _Letters:
    """Letters that the table does not use yet."""

    def __init__(self, robot: Robot) -> None:
        self.meanings: dict[Symbol, Expr] = {}
        self._used = {symbol.name for symbol in (*robot.variables, *robot.parameters)}

    def length(self, amount: Expr, name: str) -> Expr:
        """Return a length itself where it is zero or a symbol, else a letter for it."""
        if amount.is_zero or amount.is_Symbol or (-amount).is_Symbol:
            return amount
        return self._letter(amount, name)

    def offset(self, joint: Joint, name: str) -> Expr:
        """Return the d of a row, its constant part as a letter."""
        if joint.type is not JointType.PRISMATIC:
            return self.length(joint.d, name)
        constant = joint.d.xreplace({joint.variable: _ZERO})
        return joint.d - constant + self.length(constant, name)

    def of_end(self, word: Word, stem: str) -> Word:
        """Return the base or the tool with letters for its lengths."""
        return tuple(
            replace(motion, amount=self.length(motion.amount, f"{stem}{k}"))
            if motion.kind is MotionKind.TRANSLATION
            else motion
            for k, motion in enumerate(word, start=1)
        )

    def _letter(self, meaning: Expr, name: str) -> Symbol:
        while name in self._used:
            name = f"{name}_0"
        self._used.add(name)
        letter = Symbol(name, real=True)
        self.meanings[letter] = meaning
        return letter


def _without_lead(word: Word, robot: Robot) -> tuple[Word, Offset]:
    """Take the constant translations off the front of a word, through turns of 90 degrees."""
    offset: list[Expr] = [_ZERO, _ZERO, _ZERO]
    kept: list[Motion] = []
    for motion in word:
        slides = bool(motion.amount.free_symbols & set(robot.variables))
        through = None if slides else _carried(kept, motion)
        if through is None:
            kept.append(motion)
        else:
            offset[through.axis] += through.amount
    return tuple(kept), (offset[0], offset[1], offset[2])


def _carried(before: list[Motion], motion: Motion) -> Motion | None:
    """Carry a constant translation to the front; None where something is in its way."""
    if motion.kind is MotionKind.ROTATION or motion.amount.is_zero:
        return None
    axis, amount = motion.axis, motion.amount
    for earlier in reversed(before):
        if earlier.kind is MotionKind.TRANSLATION or earlier.axis is axis:
            continue
        quarters = earlier.amount * 2 / pi
        if not quarters.is_Integer:
            return None
        for _ in range(int(quarters) % 4):
            if (axis - earlier.axis) % 3 == 2:
                amount = -amount
            axis = Axis(3 - axis - earlier.axis)
    return Motion(motion.kind, axis, amount)


def _reversed(word: Word) -> Word:
    return tuple(replace(motion, amount=-motion.amount) for motion in reversed(word))
