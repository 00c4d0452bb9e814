"""Runs: the stretches of a word whose rotations are all about one axis, parallel joints say."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from sympy import Expr, Integer

from symdh.motion.words import Word
from symdh.robot import Axis, Motion, MotionKind


@dataclass(frozen=True, slots=True)
class Station:
    """A place within a run: how far the run has turned there, and how far it then moves.

    Attributes
    ----------
    angle : Expr
        Sum of the run's rotations so far, in radians.
    offset : three Expr
        The translation made there, along the axes that have turned by `angle`.
    """

    angle: Expr
    offset: tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Run:
    """A stretch of a word whose rotations are all about one axis."""

    axis: Axis
    motions: Word

    @property
    def stations(self) -> tuple[Station, ...]:
        """The stations of the run: where it starts, and one after each of its rotations."""
        angles: list[Expr] = [Integer(0)]
        offsets: list[list[Expr]] = [[Integer(0)] * 3]
        for motion in self.motions:
            if is_rotation(motion):
                angles.append(angles[-1] + motion.amount)
                offsets.append([Integer(0)] * 3)
            else:
                offsets[-1][motion.axis] += motion.amount
        return tuple(
            Station(angle, (x, y, z)) for angle, (x, y, z) in zip(angles, offsets, strict=True)
        )


def cut_runs(word: Iterable[Motion]) -> tuple[Run, ...]:
    """Cut a fused word where the axis of rotation changes."""
    motions = tuple(word)
    starts = [0]
    axis: Axis | None = None
    for k, motion in enumerate(motions):
        if is_rotation(motion):
            if axis is not None and motion.axis is not axis:
                starts.append(k)
            axis = motion.axis
    pieces = [motions[a:b] for a, b in pairwise([*starts, len(motions)])]
    return tuple(Run(_axis_of(piece), piece) for piece in pieces if piece)


def is_rotation(motion: Motion) -> bool:
    """Say whether a motion turns."""
    return motion.kind is MotionKind.ROTATION


def _axis_of(piece: Word) -> Axis:
    return next((m.axis for m in piece if is_rotation(m)), Axis.Z)
