"""Chapter: the pose, as a matrix and entry by entry."""

from __future__ import annotations

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Entries,
    EntryStep,
    NamedMatrix,
    PoseResult,
    Text,
)
from symdh.derivation.legend import legend
from symdh.derivation.style import Style
from symdh.kinematics.forward import ForwardKinematics
from symdh.notation.nodes import Generic, Matrix

_COLUMNS = ("n", "s", "a", "p")


def chapter(style: Style, forward: ForwardKinematics) -> Chapter:
    """Return the chapter on the result; the forward kinematics must have a closed form."""
    name = style.pose_name(forward.start, forward.end)
    matrix = style.notation.matrix(forward.pose)
    explanation: Text = (
        "The columns are the normal, sliding and approach directions ",
        Generic("n"),
        ", ",
        Generic("s"),
        " and ",
        Generic("a"),
        " of the last frame, and its origin ",
        Generic("p"),
        ", all seen from the first:",
    )
    whole = NamedMatrix((name,), matrix)
    blocks: list[Block] = [PoseResult(whole, explanation, Entries(labelled(matrix)))]
    meanings = legend(style, [matrix])
    if meanings:
        blocks.append(meanings)
    return Chapter("The result", tuple(blocks))


def labelled(matrix: Matrix) -> tuple[tuple[EntryStep, ...], ...]:
    """Return the entries of a pose as the components of n, s, a and p."""
    return tuple(
        tuple(
            EntryStep(Generic(letter, "xyz"[row]), (matrix.rows[row][column],), None)
            for row in range(3)
        )
        for column, letter in enumerate(_COLUMNS)
    )
