"""Task vectors chosen by name, or from the structure of the arm."""

from __future__ import annotations

import re
from collections.abc import Sequence

from sympy import Expr, ImmutableMatrix, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.forward import transform
from symdh.kinematics.frame import first_frame, last_frame
from symdh.kinematics.rotation import (
    SEQUENCES,
    Atan2,
    EulerSequence,
    euler_formulas,
    named_sequence,
    rates_vanish,
    read_off,
)
from symdh.kinematics.task.vector import (
    Choice,
    Component,
    Coordinate,
    EulerAngle,
    Heading,
    TaskVector,
)
from symdh.motion import Word, rotations
from symdh.motion.words import fuse_to_turn
from symdh.robot import Axis, JointType, MotionKind, Robot

_EULER_NAMES = (("phi", "theta", "psi"), ("alpha", "beta", "gamma"), ("e1", "e2", "e3"))
_POSITION = re.compile(r"p?_?([xyz])")
_HEADING = re.compile(r"phi|alpha(?:_?([xyz]))?")


def task_vector(robot: Robot, text: str | None = None) -> TaskVector:
    """Return the task vector that a text names, or the one that fits the arm's structure.

    Parameters
    ----------
    robot : Robot
    text : str, optional
        Components separated by blanks or commas: ``x``, ``y``, ``z``; one of the 12 sequences of
        Euler angles such as ``zyz`` (three components; ``rpy`` is ``zyx``); ``phi`` or ``alpha_z``,
        the angle about the direction of all revolute axes.

    Returns
    -------
    TaskVector

    Raises
    ------
    UnsupportedError
        When there is no such component, or it does not exist for this arm, or the Euler angles
        are singular in every pose, or no joint moves.
    LimitError
        When the closed form would be too large.
    """
    return _Choosing(robot).named(text) if text is not None else _Choosing(robot).fitting()


class _Choosing:
    """The parts of one arm's pose, and choices among them."""

    def __init__(self, robot: Robot) -> None:
        if not robot.variables:
            raise UnsupportedError(f"{robot.name} has no joint that moves, so no task vector")
        self.robot = robot
        self.start, self.end = first_frame(robot), last_frame(robot)
        self.word = chain_word(robot, self.start, self.end)
        pose = transform(robot, self.start, self.end)
        self.orientation = ImmutableMatrix(pose[:3, :3])
        self.coordinates = [Coordinate(axis, pose[axis, 3]) for axis in Axis]
        self.moving = [c for c in self.coordinates if self.varies(c.value)]
        self.heading = self._heading()

    def varies(self, expression: Expr) -> bool:
        """Say whether an expression depends on a joint variable."""
        return bool(expression.free_symbols & set(self.robot.variables))

    def turning(self) -> Word:
        """Return the rotations of the fused orientation that joints change."""
        motions, _ = fuse_to_turn(rotations(self.word))
        return tuple(motion for motion in motions if self.varies(motion.amount))

    def _heading(self) -> Heading | None:
        """Return the one angle of an arm whose revolute axes are all parallel to an axis."""
        turning = self.turning()
        if len(turning) != 1:
            return None
        axis = turning[0].axis
        # The angle of the last frame's first perpendicular axis: other turns come behind it.
        sequence = EulerSequence(axis, Axis((axis + 2) % 3), Axis((axis + 1) % 3))
        angles = read_off(self.word, sequence)
        if angles is None or any(self.varies(angle) for angle in angles[1:]):
            return None
        planar = all(c.axis is not axis for c in self.moving)
        return Heading(axis, angles[0], planar)

    def fitting(self) -> TaskVector:
        """Return the task vector that the structure suggests."""
        joints = len(self.robot.variables)
        turning = self.turning()
        if not turning:
            return self._vector(self.moving, Choice.SLIDING)
        if self.heading is not None:
            whole: list[Component] = [*self.moving, self.heading]
            if len(whole) <= joints or not self.moving:
                return self._vector(whole, Choice.PARALLEL)
            return self._vector(self.moving, Choice.PARALLEL, left_out=self.heading)
        if joints <= 3 and self._meets_in_a_point() and len(turning) == 3:
            return self._vector(self._angles(self._wrist_sequence()), Choice.WRIST)
        if not self.moving:
            return self._vector(self._usual_angles(), Choice.TURNING)
        if joints <= 3:
            return self._vector(self.moving, Choice.POSITION)
        return self._vector([*self.moving, *self._usual_angles()], Choice.POSE)

    def _usual_angles(self) -> list[EulerAngle]:
        """Return roll, pitch and yaw, or ZYZ where these can be read off and those cannot.

        Either could be singular in every pose only if all axes were parallel.
        """
        usual = (named_sequence("zyx"), named_sequence("zyz"))
        return self._angles(min(usual, key=lambda s: read_off(self.word, s) is None))

    def named(self, text: str) -> TaskVector:
        """Return the task vector that a text names."""
        components: list[Component] = []
        words = [word for word in re.split(r"[\s,;]+", text.strip().lower()) if word]
        for word in words:
            new = self._named(word)
            self._refuse_twice(new, components, word)
            components += new
        if not components:
            raise UnsupportedError(f"the task vector {text!r} names no component: {_CHOICES}")
        return self._vector(components, Choice.NAMED)

    def _named(self, word: str) -> Sequence[Component]:
        coordinate, heading = _POSITION.fullmatch(word), _HEADING.fullmatch(word)
        if coordinate:
            return [self.coordinates["xyz".index(coordinate[1])]]
        if heading:
            return [self._named_heading(word, heading[1])]
        try:
            return self._angles(named_sequence(word))
        except UnsupportedError:
            if re.fullmatch(r"[xyz]{3}", word):
                raise
        raise UnsupportedError(f"there is no component {word!r} of a task vector: {_CHOICES}")

    def _named_heading(self, word: str, letter: str | None) -> Heading:
        if self.heading is None:
            raise UnsupportedError(
                f"{word} is one angle, which says the orientation only where all revolute axes are "
                f"parallel; {self.robot.name} has others: name a sequence such as zyz or zyx"
            )
        own = self.heading.axis.name.lower()
        if letter not in (None, own):
            raise UnsupportedError(
                f"the revolute axes of {self.robot.name} are parallel to {own}: "
                f"its angle is alpha_{own}, not {word}"
            )
        return Heading(self.heading.axis, self.heading.angle, planar=letter is None)

    def _refuse_twice(
        self, new: Sequence[Component], components: list[Component], word: str
    ) -> None:
        if any(component in components for component in new):
            raise UnsupportedError(f"{word} stands twice in the task vector")
        turning = any(not isinstance(c, Coordinate) for c in components)
        if turning and not isinstance(new[0], Coordinate):
            raise UnsupportedError(f"the orientation is described twice: {word} is one too many")

    def _angles(self, sequence: EulerSequence) -> list[EulerAngle]:
        read = read_off(self.word, sequence)
        found = read or euler_formulas(self.orientation, sequence)
        self._refuse_singular(sequence, read, found[0])
        symbols = _euler_symbols(self.robot)
        self.sequence = sequence
        return [
            EulerAngle(place, symbol, value)
            for place, (symbol, value) in enumerate(zip(symbols, found, strict=True))
        ]

    def _refuse_singular(
        self,
        sequence: EulerSequence,
        read: tuple[Expr, Expr, Expr] | None,
        first: Expr | Atan2,
    ) -> None:
        """Refuse angles whose second one is singular in whatever pose the arm is."""
        if read is not None:
            always = bool(rates_vanish(sequence, read[1]).is_zero)
        else:
            always = isinstance(first, Atan2) and bool(first.y.is_zero and first.x.is_zero)
        if always:
            others = [s.name for s in SEQUENCES if s.proper is not sequence.proper]
            raise UnsupportedError(
                f"{sequence.name} is singular in every pose of {self.robot.name}: its first and "
                f"third rotations are about one line; name another sequence, such as "
                f"{'zyx' if 'zyx' in others else 'zyz'}"
            )

    def _meets_in_a_point(self) -> bool:
        """Say whether all axes meet in one point: no slide between the outermost rotations."""
        motions, _ = fuse_to_turn(self.word)
        turns = [k for k, m in enumerate(motions) if self.varies(m.amount)]
        if any(joint.type is JointType.PRISMATIC for joint in self.robot.joints):
            return False
        inside = motions[turns[0] : turns[-1]]
        return all(motion.kind is MotionKind.ROTATION for motion in inside)

    def _wrist_sequence(self) -> EulerSequence:
        """Return the sequence in which a wrist's own rotations stand."""
        for sequence in (named_sequence("zyz"), named_sequence("zyx"), *SEQUENCES):
            if read_off(self.word, sequence) is not None:
                return sequence
        return named_sequence("zyx")

    def _vector(
        self, components: Sequence[Component], choice: Choice, left_out: Heading | None = None
    ) -> TaskVector:
        turned = any(isinstance(c, EulerAngle) for c in components)
        return TaskVector(
            self.robot,
            self.start,
            self.end,
            tuple(components),
            choice,
            self.sequence if turned else None,
            self.orientation,
            left_out,
        )


_CHOICES = (
    "there are x, y, z, the 12 sequences of Euler angles (zyz, zyx, xyz, ...), and phi or "
    "alpha_z where all revolute axes are parallel"
)


def _euler_symbols(robot: Robot) -> tuple[Symbol, ...]:
    """Return letters for three Euler angles that the table does not use itself."""
    used = {symbol.name for symbol in (*robot.variables, *robot.parameters)}
    names = next((each for each in _EULER_NAMES if not used & set(each)), _EULER_NAMES[-1])
    return tuple(Symbol(name, real=True) for name in names)
