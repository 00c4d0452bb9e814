"""Rows that a student read off a figure, against the rows of the table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from sympy import Expr, expand, pi

from symdh.kinematics.answers.equality import Sameness, compare
from symdh.kinematics.answers.numbers import Point, close, matrix
from symdh.kinematics.answers.slips import row_slips
from symdh.kinematics.answers.verdicts import Finding, JudgedClaim, JudgedEntry, Verdict
from symdh.kinematics.chain import chain_word
from symdh.robot import Convention, Joint, Robot
from symdh.table.answers import Entry, RowClaim
from symdh.table.headers import PARAMETERS

_ANGLES = ("theta", "alpha")
_MISTAKES = (Verdict.WRONG, Verdict.SIGN)
_RIGHT = Finding(Verdict.RIGHT)
_NO_ROW = Finding(Verdict.WRONG, "the table has no such row")
_OTHER_FRAMES = "another choice of frames with the same pose of the last one"


def judge_rows(robot: Robot, rows: Sequence[RowClaim], points: Sequence[Point]) -> JudgedClaim:
    """Judge rows cell by cell; other rows that give the same pose for all joints are right too.

    Frames may be laid in more than one way, so rows that differ from the table's are not wrong
    when their product is the same.
    """
    judged = [_judged(robot, row, points) for row in rows]
    judged += [_missing(robot, number, rows) for number in range(len(rows) + 1, robot.n + 1)]
    mistakes = any(each.verdict in _MISTAKES for row in judged for each in row)
    hint = ""
    if mistakes and _same_pose(robot, rows, points):
        judged = [[replace(each, finding=_RIGHT) for each in row] for row in judged]
        hint = _OTHER_FRAMES
    elif mistakes or len(rows) != robot.n:
        hint = "; ".join(_hints(robot, rows, points))
    return JudgedClaim("rows", tuple(each for row in judged for each in row), 4, hint)


def _missing(robot: Robot, number: int, rows: Sequence[RowClaim]) -> list[JudgedEntry]:
    """Return the cells of a row that is not there as blanks, placed at the last row that is."""
    (near, *_) = rows[-1].cells.values()
    joint = robot.joints[number - 1]
    return [
        JudgedEntry(
            f"{name} of row {number}",
            Entry(number - 1, column, None, "", near.place),
            Finding(Verdict.BLANK),
            getattr(joint, name),
        )
        for column, name in enumerate(PARAMETERS)
    ]


def _judged(robot: Robot, row: RowClaim, points: Sequence[Point]) -> list[JudgedEntry]:
    judged = []
    for name in PARAMETERS:
        entry = row.cells[name]
        label = f"{name} of row {row.number}"
        if row.number > robot.n:
            judged.append(JudgedEntry(label, entry, _NO_ROW))
            continue
        right: Expr = getattr(robot.joints[row.number - 1], name)
        judged.append(_judged_cell(label, entry, right, name in _ANGLES, points))
    return judged


def _judged_cell(
    label: str, entry: Entry, right: Expr, angle: bool, points: Sequence[Point]
) -> JudgedEntry:
    if entry.value is None:
        return JudgedEntry(label, entry, Finding(Verdict.BLANK), right)
    if _equal(entry.value, right, angle, points):
        return JudgedEntry(label, entry, Finding(Verdict.RIGHT), right)
    if _equal(-entry.value, right, angle, points):
        return JudgedEntry(label, entry, Finding(Verdict.SIGN), right)
    note = ""
    if angle and _equal(entry.value * pi / 180, right, True, points):
        note = "degrees given where radians are meant"
    elif angle and _equal(entry.value * 180 / pi, right, True, points):
        note = "radians given where degrees are meant"
    return JudgedEntry(label, entry, Finding(Verdict.WRONG, note), right)


def _equal(given: Expr, right: Expr, angle: bool, points: Sequence[Point]) -> bool:
    """Say whether two parameters are equal; angles, up to whole turns."""
    turns = expand(given - right) / (2 * pi)
    if angle and turns.is_Integer:
        return True
    return compare(given, right, points) is not Sameness.DIFFERENT


def _same_pose(robot: Robot, rows: Sequence[RowClaim], points: Sequence[Point]) -> bool:
    """Say whether complete rows give the pose of frame n that the table gives."""
    joints = _joints(robot, rows)
    if joints is None:
        return False
    given, right = (chain_word(each, 0, robot.n) for each in (replace(robot, joints=joints), robot))
    return all(
        close(x, y)
        for point in points
        for ours, theirs in zip(matrix(right, point), matrix(given, point), strict=True)
        for x, y in zip(ours, theirs, strict=True)
    )


def _joints(robot: Robot, rows: Sequence[RowClaim]) -> tuple[Joint, ...] | None:
    """Return the rows as joints, each moved by the variable of the table's; None if incomplete."""
    if len(rows) != robot.n:
        return None
    joints = []
    for row, joint in zip(rows, robot.joints, strict=True):
        cells = _values(row.cells)
        if len(cells) != len(PARAMETERS):
            return None
        joints.append(replace(joint, **cells))
    return tuple(joints)


def _values(cells: Mapping[str, Entry]) -> dict[str, Expr]:
    return {name: entry.value for name, entry in cells.items() if entry.value is not None}


def _hints(robot: Robot, rows: Sequence[RowClaim], points: Sequence[Point]) -> Iterator[str]:
    if len(rows) != robot.n:
        noun = "row" if robot.n == 1 else "rows"
        yield f"the table has {robot.n} {noun}, and here are {len(rows)}"
    joints = _joints(robot, rows)
    shifted = _shifted(robot)
    if joints is not None and _alike(joints, shifted, points):
        other = "modified" if robot.convention is Convention.STANDARD else "standard"
        yield f"a and alpha stand one row off, as in the {other} convention"
        return
    for row in rows[: robot.n]:
        cells, right = _values(row.cells), robot.joints[row.number - 1]
        if all(_equal(cells[n], getattr(right, n), n in _ANGLES, points) for n in cells):
            continue
        for message, slipped in _slips(robot, row.number):
            if cells and all(
                _equal(cells[n], getattr(slipped, n), n in _ANGLES, points) for n in cells
            ):
                yield message
                break


def _alike(given: Sequence[Joint], right: Sequence[Joint], points: Sequence[Point]) -> bool:
    return all(
        _equal(getattr(g, name), getattr(r, name), name in _ANGLES, points)
        for g, r in zip(given, right, strict=True)
        for name in PARAMETERS
    )


def _shifted(robot: Robot) -> tuple[Joint, ...]:
    """Return the rows with a and alpha where the other convention has them."""
    joints = robot.joints
    step = -1 if robot.convention is Convention.STANDARD else 1
    return tuple(
        replace(
            joint,
            a=joints[k + step].a if 0 <= k + step < len(joints) else joint.a * 0,
            alpha=joints[k + step].alpha if 0 <= k + step < len(joints) else joint.alpha * 0,
        )
        for k, joint in enumerate(joints)
    )


def _slips(robot: Robot, number: int) -> Iterator[tuple[str, Joint]]:
    for k, other in enumerate(robot.joints, start=1):
        if k != number:
            yield f"row {number} is row {k} of the table", other
    yield from row_slips(robot, number)
