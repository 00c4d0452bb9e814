"""Task vectors r = f(q), chosen by name or from the arm's structure, and dr/dq."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from math import pi

from sympy import Expr, Float, ImmutableMatrix, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.chain import chain_word
from symdh.kinematics.forward import transform
from symdh.kinematics.frame import Frame, first_frame, last_frame
from symdh.kinematics.numeric import check_values, pose
from symdh.kinematics.rotation import (
    SEQUENCES,
    Atan2,
    EulerSequence,
    euler_angles,
    euler_formulas,
    inverse_rates,
    named_sequence,
    nearest_rotation,
    rates,
    rates_vanish,
    read_off,
)
from symdh.kinematics.velocity import GeometricJacobian, jacobian
from symdh.motion import Word, rotations
from symdh.motion.words import fuse_to_turn
from symdh.robot import Axis, JointType, MotionKind, Robot

#: Sine (proper) or cosine (Tait-Bryan) of the second Euler angle below which a number for its rate
#: would be more rounding than rate.
SINGULAR = 1e-9

_DIGITS = 40
_EULER_NAMES = (("phi", "theta", "psi"), ("alpha", "beta", "gamma"), ("e1", "e2", "e3"))
_POSITION = re.compile(r"p?_?([xyz])")
_HEADING = re.compile(r"phi|alpha(?:_?([xyz]))?")


class Choice(Enum):
    """Why a task vector has the components that it has."""

    NAMED = "named"
    PARALLEL = "parallel"
    SLIDING = "sliding"
    WRIST = "wrist"
    POSITION = "position"
    POSE = "pose"


@dataclass(frozen=True, slots=True)
class Coordinate:
    """One coordinate of the last frame's origin, seen from the first frame."""

    axis: Axis
    value: Expr


@dataclass(frozen=True, slots=True)
class Heading:
    """The angle about the one direction that all revolute axes share.

    Attributes
    ----------
    axis : Axis
        That direction, an axis of the first frame.
    angle : Expr
        Radians; a sum of joint variables.
    planar : bool
        Whether the arm moves in one plane: then the angle is called phi, else alpha_z.
    """

    axis: Axis
    angle: Expr
    planar: bool


@dataclass(frozen=True, slots=True)
class EulerAngle:
    """One of three Euler angles.

    Attributes
    ----------
    place : int
        0, 1 or 2.
    symbol : Symbol
        The letter that stands for it in the rate matrix.
    value : Expr or Atan2
        Radians, a sum of joint variables where it can be read off the arm, else a formula.
    """

    place: int
    symbol: Symbol
    value: Expr | Atan2


Component = Coordinate | Heading | EulerAngle


@dataclass(frozen=True)
class TaskVector:
    """What an arm is asked for, as a function of its joint variables.

    Attributes
    ----------
    robot : Robot
    start, end : Frame
        The pose of `end` in `start` is described.
    components : tuple of Component
    choice : Choice
    sequence : EulerSequence or None
        That of the Euler angles, where there are any.
    orientation : ImmutableMatrix
        The exact 3x3 rotation that the Euler angles describe.
    left_out : Heading or None
        An angle that the arm has too few joints to be asked for as well.
    """

    robot: Robot
    start: Frame
    end: Frame
    components: tuple[Component, ...]
    choice: Choice
    sequence: EulerSequence | None
    orientation: ImmutableMatrix
    left_out: Heading | None = None

    @cached_property
    def angles(self) -> tuple[EulerAngle, ...]:
        """The Euler angles, all three or none."""
        return tuple(c for c in self.components if isinstance(c, EulerAngle))

    @property
    def is_read_off(self) -> bool:
        """Whether the Euler angles are sums of joint variables."""
        return all(isinstance(angle.value, Expr) for angle in self.angles)

    @property
    def vanishing(self) -> Expr | None:
        """What is zero where the Euler angles are singular; None without Euler angles.

        By joint variables where the angles are read off, else by the letter of the second angle.
        """
        if self.sequence is None:
            return None
        second = self.angles[1]
        value = second.value if isinstance(second.value, Expr) else second.symbol
        return rates_vanish(self.sequence, value)


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
        are singular in every pose.
    LimitError
        When the closed form would be too large.
    """
    return _Choosing(robot).named(text) if text is not None else _Choosing(robot).fitting()


class _Choosing:
    """The parts of one arm's pose, and choices among them."""

    def __init__(self, robot: Robot) -> None:
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
        if joints <= 3:
            return self._vector(self.moving, Choice.POSITION)
        return self._vector([*self.moving, *self._angles(named_sequence("zyx"))], Choice.POSE)

    def named(self, text: str) -> TaskVector:
        """Return the task vector that a text names."""
        components: list[Component] = []
        words = [word for word in re.split(r"[\s,;]+", text.strip().lower()) if word]
        for word in words:
            for component in self._named(word):
                self._refuse_twice(component, components, word)
                components.append(component)
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

    def _refuse_twice(self, new: Component, components: list[Component], word: str) -> None:
        if new in components:
            raise UnsupportedError(f"{word} stands twice in the task vector")
        rotating = (Heading, EulerAngle)
        clash = isinstance(new, rotating) and any(
            isinstance(c, rotating) and (type(c) is not type(new) or isinstance(new, Heading))
            for c in components
        )
        full = isinstance(new, EulerAngle) and sum(isinstance(c, EulerAngle) for c in components)
        if clash or (full and new.place == 0):
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


@dataclass(frozen=True)
class AnalyticJacobian:
    """The derivative of a task vector by the joint variables.

    Attributes
    ----------
    vector : TaskVector
    geometric : GeometricJacobian
        Of the same frames; its lower half takes joint rates to the angular velocity.
    matrix : ImmutableMatrix
        One row for each component, one column for each joint variable. In the rows of Euler
        angles that are not read off, the letters of the first two stand for those angles.
    rates, inverse_rates : ImmutableMatrix or None
        B with omega = B phi', and its inverse; None without Euler angles.
    """

    vector: TaskVector
    geometric: GeometricJacobian
    matrix: ImmutableMatrix
    rates: ImmutableMatrix | None
    inverse_rates: ImmutableMatrix | None

    @property
    def angular(self) -> ImmutableMatrix:
        """The lower half of the geometric Jacobian, 3 x m."""
        return ImmutableMatrix(self.geometric.matrix[3:, :])


def analytic_jacobian(vector: TaskVector) -> AnalyticJacobian:
    """Differentiate a task vector, exactly and in short form.

    A coordinate's row is that of the geometric Jacobian. An angle that is a sum of joint variables
    is differentiated as it stands. Other Euler angles follow from ``phi' = B^-1 omega``.

    Raises
    ------
    LimitError
        When the closed form would be too large.
    """
    geometric = jacobian(vector.robot, vector.end, None, vector.start)
    whole = geometric.matrix
    variables = vector.robot.variables
    rate_matrix = inverse = None
    if vector.sequence is not None:
        first, second = vector.angles[0].symbol, vector.angles[1].symbol
        rate_matrix = rates(vector.sequence, first, second)
        inverse = inverse_rates(vector.sequence, first, second)
    rows = []
    for component in vector.components:
        if isinstance(component, Coordinate):
            rows.append([whole[component.axis, k] for k in range(len(variables))])
        elif isinstance(component, Heading):
            rows.append([component.angle.diff(variable) for variable in variables])
        elif isinstance(component.value, Expr):
            rows.append([component.value.diff(variable) for variable in variables])
        else:
            assert inverse is not None
            row = inverse.row(component.place)
            rows.append([(row * whole[3:, k])[0, 0] for k in range(len(variables))])
    return AnalyticJacobian(vector, geometric, ImmutableMatrix(rows), rate_matrix, inverse)


@dataclass(frozen=True, slots=True)
class TaskNumbers:
    """A task vector and its derivative at one set of values.

    Attributes
    ----------
    vector : tuple of float
        Lengths in the table's unit, angles in radians, in (-pi, pi].
    jacobian : tuple of tuple of float
        One row for each component.
    """

    vector: tuple[float, ...]
    jacobian: tuple[tuple[float, ...], ...]


def task_numbers(whole: AnalyticJacobian, values: Mapping[Symbol, Expr]) -> TaskNumbers:
    """Return the numbers of a task vector and its derivative.

    Parameters
    ----------
    whole : AnalyticJacobian
    values : mapping of Symbol to Expr
        Exact numbers, radians and the table's length unit. They win over the table's own.

    Raises
    ------
    UnsupportedError
        When a symbol has no value, or the Euler angles are singular there.
    """
    vector = whole.vector
    robot = vector.robot
    known = {**robot.values, **values}
    check_values(chain_word(robot, vector.start, vector.end), known)
    reached = pose(robot, vector.start, vector.end, values)
    angles = dict(known)
    if vector.sequence is not None:
        angles |= _euler_numbers(vector, reached, known)
    numbers = [_component_number(c, reached, angles) for c in vector.components]
    rows = whole.matrix
    slopes = [
        tuple(_number(rows[r, c], angles) for c in range(rows.cols)) for r in range(rows.rows)
    ]
    return TaskNumbers(tuple(numbers), tuple(slopes))


def _euler_numbers(
    vector: TaskVector, reached: Sequence[Sequence[float]], known: Mapping[Symbol, Expr]
) -> dict[Symbol, Expr]:
    """Return numbers for the letters of the Euler angles; refuse where they are singular."""
    assert vector.sequence is not None
    rotation = nearest_rotation([row[:3] for row in reached[:3]])
    found = euler_angles(rotation, vector.sequence)
    if found.margin < SINGULAR:
        best = max(SEQUENCES, key=lambda s: round(euler_angles(rotation, s).margin, 6))
        raise UnsupportedError(
            f"the Euler angles {vector.sequence.name} are singular at these values: the first and "
            f"the third rotation are about one line (within {SINGULAR:g}), and the analytic "
            f"Jacobian does not exist there; take another sequence, such as {best.name}"
        )
    numbers = {}
    for angle, number in zip(vector.angles, found.angles, strict=True):
        exact = isinstance(angle.value, Expr)
        numbers[angle.symbol] = angle.value.xreplace(dict(known)) if exact else Float(number, 17)
    return numbers


def _component_number(
    component: Component, reached: Sequence[Sequence[float]], known: Mapping[Symbol, Expr]
) -> float:
    if isinstance(component, Coordinate):
        return reached[component.axis][3]
    expression = component.angle if isinstance(component, Heading) else component.symbol
    return _wrapped(_number(expression, known))


def _number(expression: Expr, known: Mapping[Symbol, Expr]) -> float:
    value = expression.xreplace(dict(known)).evalf(_DIGITS)
    return 0.0 if abs(value) < Float("1e-30") else float(value)


def _wrapped(angle: float) -> float:
    turned = angle - 2 * pi * round(angle / (2 * pi))
    return pi if turned == -pi else turned
