"""The usual slips, each as the matrix that it leads to."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

from sympy import Float, Symbol

from symdh.kinematics.answers.numbers import (
    Matrix,
    Point,
    inverse,
    matrix,
    transposed,
    turned_back,
    value,
)
from symdh.kinematics.chain import chain_word, link_word
from symdh.kinematics.frame import Frame, place
from symdh.motion import Word
from symdh.robot import ZERO, Convention, Joint, MotionKind, Robot
from symdh.table.answers import Link

#: Rows past which the slips of single rows are not tried: there are too many to mean anything.
_MOST_ROWS = 12

#: Takes the numbers of the symbols to the matrix that a slip gives.
Outcome = Callable[[Point], Matrix]


@dataclass(frozen=True, slots=True)
class Slip:
    """A slip: what is said of it, and the matrix that it leads to."""

    message: str
    outcome: Outcome


def _of_word(word: Word) -> Outcome:
    return lambda point: matrix(word, point)


def link_slips(robot: Robot, link: Link) -> Iterator[Slip]:
    """Yield the slips in the matrix of one row, the likeliest first."""
    i = link.row
    right = link_word(robot, i)
    other = _other_convention(robot)
    yield Slip(
        f"this is A{i} of the {other.convention.value} convention; "
        f"the table is {robot.convention.value}",
        _of_word(link_word(other, i)),
    )
    for message, joint in row_slips(robot, i):
        yield Slip(message, _of_word(link_word(_with_row(robot, i, joint), i)))
    for message, moved in _neighbours(robot, i):
        yield Slip(message, _of_word(link_word(_with_row(robot, i, moved), i)))
        mixed = _with_row(other, i, moved)
        yield Slip(
            f"{message}, multiplied as in the {other.convention.value} convention",
            _of_word(link_word(mixed, i)),
        )
    for k in range(1, robot.n + 1):
        if k != i:
            yield Slip(f"this is A{k}: rows mixed up?", _of_word(link_word(robot, k)))
    yield from _turned(f"A{i}", right)
    for k in range(1, robot.n + 1):
        if k != i:
            yield Slip(
                f"this is A{k} of the {other.convention.value} convention",
                _of_word(link_word(other, k)),
            )


def pose_slips(robot: Robot, start: Frame, end: Frame) -> Iterator[Slip]:
    """Yield the slips in a pose, the likeliest first."""
    right = chain_word(robot, start, end)
    other = _other_convention(robot)
    yield Slip(
        f"these are the rows read in the {other.convention.value} convention; "
        f"the table is {robot.convention.value}",
        _of_word(chain_word(other, start, end)),
    )
    yield from _left_out_ends(robot, start, end)
    yield from _row_slips_of_pose(robot, start, end)
    yield from _other_frames(robot, start, end)
    yield from _turned("the pose", right)


def unit_slips(word: Word) -> Iterator[Slip]:
    """Yield what a calculator set to the wrong unit of angles makes of a pose."""
    degree = math.pi / 180
    for message, factor in (
        ("degrees taken for radians: set the calculator to degrees", 1 / degree),
        ("radians taken for degrees: set the calculator to radians", degree),
    ):
        moving = {
            symbol
            for motion in word
            if motion.kind is MotionKind.ROTATION
            for symbol in motion.amount.free_symbols
        }
        yield Slip(message, partial(_scaled_symbols, word, moving, factor))
        yield Slip(message, partial(_scaled_angles, word, factor))


def _scaled_symbols(word: Word, symbols: set[Symbol], factor: float, point: Point) -> Matrix:
    return matrix(word, {s: x * factor if s in symbols else x for s, x in point.items()})


def _scaled_angles(word: Word, factor: float, point: Point) -> Matrix:
    scaled = [
        replace(motion, amount=Float(value(motion.amount, point) * factor))
        if motion.kind is MotionKind.ROTATION
        else motion
        for motion in word
    ]
    return matrix(tuple(scaled), point)


def _other_convention(robot: Robot) -> Robot:
    standard = robot.convention is Convention.STANDARD
    return replace(robot, convention=Convention.MODIFIED if standard else Convention.STANDARD)


def _with_row(robot: Robot, i: int, joint: Joint) -> Robot:
    return replace(robot, joints=(*robot.joints[: i - 1], joint, *robot.joints[i:]))


def row_slips(robot: Robot, i: int) -> Iterator[tuple[str, Joint]]:
    """Yield what can go wrong with the parameters of one row, as the row that it makes."""
    j = robot.joints[i - 1]
    yield f"alpha and theta of row {i} exchanged", _exchanged(j, "alpha", "theta")
    yield f"a and d of row {i} exchanged", _exchanged(j, "a", "d")
    for name in ("theta", "d"):
        moved = _without_offset(j, name)
        if moved != j:
            yield f"the offset in {name} of row {i} is forgotten", moved
    for name in ("d", "a", "alpha"):
        if not getattr(j, name).is_zero:
            yield f"{name} of row {i} is forgotten", replace(j, **{name: ZERO})
    for name in ("alpha", "theta", "d", "a"):
        amount = getattr(j, name)
        if not amount.is_zero:
            yield f"{name} of row {i} has the wrong sign", replace(j, **{name: -amount})


def _exchanged(joint: Joint, first: str, second: str) -> Joint:
    return replace(joint, **{first: getattr(joint, second), second: getattr(joint, first)})


def _without_offset(joint: Joint, name: str) -> Joint:
    """Return a row whose theta, or d, is the variable alone; as it is where that does not move."""
    amount = getattr(joint, name)
    if joint.variable is None or joint.variable not in amount.free_symbols:
        return joint
    return replace(joint, **{name: amount.coeff(joint.variable) * joint.variable})


def _neighbours(robot: Robot, i: int) -> Iterator[tuple[str, Joint]]:
    """Yield a row with the a and alpha of the row above or below it."""
    j = robot.joints[i - 1]
    for k in (i - 1, i + 1):
        if 1 <= k <= robot.n:
            near = robot.joints[k - 1]
            message = f"a and alpha are those of row {k}: off by one row"
            yield message, replace(j, a=near.a, alpha=near.alpha)


def _left_out_ends(robot: Robot, start: Frame, end: Frame) -> Iterator[Slip]:
    first, last = place(robot, start), place(robot, end)
    if start == "base" and robot.base and last >= 0:
        yield Slip("the base is forgotten", _of_word(chain_word(robot, 0, end)))
    if end == "tool" and robot.tool and first <= robot.n:
        yield Slip("the tool is forgotten", _of_word(chain_word(robot, start, robot.n)))
    if start == "base" and end == "tool" and robot.base and robot.tool:
        yield Slip("base and tool are forgotten", _of_word(chain_word(robot, 0, robot.n)))


def _rows_between(robot: Robot, start: Frame, end: Frame) -> range:
    ends = sorted((place(robot, start), place(robot, end)))
    return range(max(ends[0], 0) + 1, min(ends[1], robot.n) + 1)


def _row_slips_of_pose(robot: Robot, start: Frame, end: Frame) -> Iterator[Slip]:
    rows = _rows_between(robot, start, end)
    if len(rows) > _MOST_ROWS:
        return
    for first, second in (("alpha", "theta"), ("a", "d")):
        exchange = partial(_exchanged, first=first, second=second)
        everywhere = _every_row(robot, rows, exchange)
        message = f"{first} and {second} exchanged in every row"
        yield Slip(message, _of_word(chain_word(everywhere, start, end)))
    for i in rows:
        for message, joint in row_slips(robot, i):
            changed = _with_row(robot, i, joint)
            yield Slip(message, _of_word(chain_word(changed, start, end)))
    plain = _every_row(robot, rows, lambda j: _without_offset(_without_offset(j, "theta"), "d"))
    if plain != robot:
        yield Slip("the offsets are forgotten", _of_word(chain_word(plain, start, end)))
    if place(robot, start) < place(robot, end):
        yield from _wrong_orders(robot, list(rows), start, end)


def _wrong_orders(robot: Robot, numbers: Sequence[int], start: Frame, end: Frame) -> Iterator[Slip]:
    """Yield products of the same links in another order."""
    for row, following in pairwise(numbers):
        order = [*numbers]
        at = order.index(row)
        order[at], order[at + 1] = following, row
        message = f"A{row} and A{following} multiplied in the wrong order"
        yield Slip(message, _of_word(_in_order(robot, order, start, end)))
    if len(numbers) > 2:
        word = _in_order(robot, numbers[::-1], start, end)
        yield Slip("the links are multiplied in reverse order", _of_word(word))


def _in_order(robot: Robot, rows: Sequence[int], start: Frame, end: Frame) -> Word:
    word: Word = robot.base if start == "base" else ()
    for row in rows:
        word += link_word(robot, row)
    return word + (robot.tool if end == "tool" else ())


def _every_row(robot: Robot, rows: Iterable[int], change: Callable[[Joint], Joint]) -> Robot:
    for i in rows:
        robot = _with_row(robot, i, change(robot.joints[i - 1]))
    return robot


def _other_frames(robot: Robot, start: Frame, end: Frame) -> Iterator[Slip]:
    """Yield poses of the frames one further or one nearer."""
    if not (isinstance(start, int) and isinstance(end, int)):
        return
    for first, last in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        s, e = start + first, end + last
        if 0 <= s <= robot.n and 0 <= e <= robot.n and s != e:
            yield Slip(f"this is T({s}, {e}): off by one frame", _of_word(chain_word(robot, s, e)))


def _turned(name: str, right: Word) -> Iterator[Slip]:
    yield Slip(f"{name} inverted", lambda point: inverse(matrix(right, point)))
    yield Slip(
        f"the rotation in {name} is transposed", lambda point: turned_back(matrix(right, point))
    )
    yield Slip(f"{name} transposed", lambda point: transposed(matrix(right, point)))
