"""What makes an arm solvable: axes that are parallel, axes that meet in a point."""

from __future__ import annotations

import random
from dataclasses import dataclass

from symdh.kinematics.inverse.lengths import random_chain
from symdh.kinematics.inverse.lines import Line, are_parallel, joint_lines, meet, meet_in_one_point
from symdh.robot import JointType, Robot


@dataclass(frozen=True)
class Structure:
    """Rows of the table whose axes stand in a special way to each other, at every pose.

    Attributes
    ----------
    parallel : tuple of tuple of int
        Runs of two or more neighbouring revolute joints with parallel axes.
    wrist, shoulder : tuple of int or None
        The last, and the first, three joints where their axes meet in one point.
    crossing : tuple of tuple of int
        Pairs of neighbouring revolute joints whose axes meet.
    """

    parallel: tuple[tuple[int, ...], ...]
    wrist: tuple[int, ...] | None
    shoulder: tuple[int, ...] | None
    crossing: tuple[tuple[int, int], ...]


def structure(robot: Robot) -> Structure:
    """Find the structure of an arm, at two random poses."""
    chain, drawn = random_chain(robot), random.Random(17)
    poses = [joint_lines(robot, chain.random_values(drawn)) for _ in range(2)]
    last = [lines[-3:] for lines in poses]
    first = [lines[:3] for lines in poses]
    return Structure(
        _parallel_runs(poses),
        _rows_of_meeting(last),
        _rows_of_meeting(first),
        tuple(
            (a.row, b.row)
            for k, (a, b) in enumerate(zip(poses[0], poses[0][1:], strict=False))
            if _turn(a, b) and all(meet(lines[k], lines[k + 1]) for lines in poses)
        ),
    )


def _rows_of_meeting(triples: list[tuple[Line, ...]]) -> tuple[int, ...] | None:
    for triple in triples:
        if len(triple) < 3 or not _turn(*triple) or not meet_in_one_point(*triple):
            return None
    return tuple(line.row for line in triples[0])


def _parallel_runs(poses: list[tuple[Line, ...]]) -> tuple[tuple[int, ...], ...]:
    """Return the runs of neighbours that turn about parallel axes; slides may stand between."""
    runs: list[list[int]] = []
    turning = [k for k, line in enumerate(poses[0]) if line.type is JointType.REVOLUTE]
    for place, k in enumerate(turning):
        before = turning[place - 1] if place else None
        if before is not None and all(are_parallel(lines[before], lines[k]) for lines in poses):
            runs[-1].append(poses[0][k].row)
        else:
            runs.append([poses[0][k].row])
    return tuple(tuple(run) for run in runs if len(run) > 1)


def _turn(*lines: Line) -> bool:
    return all(line.type is JointType.REVOLUTE for line in lines)
