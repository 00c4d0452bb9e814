"""The structure of an arm, axes that are parallel or meet, in words."""

from __future__ import annotations

from collections.abc import Sequence

from symdh.derivation.blocks import (
    Text,
)
from symdh.kinematics.inverse.structure import Structure


def structure_notes(shape: Structure) -> list[Text]:
    """Return sentences on axes that are parallel or meet."""
    notes: list[Text] = []
    if shape.wrist is not None and shape.wrist == shape.shoulder:
        notes.append(
            (f"The axes of joints {_rows(shape.wrist)} meet in one point, which no joint moves.",)
        )
    elif shape.wrist is not None:
        notes.append(
            (
                f"The axes of joints {_rows(shape.wrist)} meet in one point, the centre of the "
                "wrist. Its position depends on the other joints only, so these come first and "
                "the orientation after them.",
            )
        )
    if shape.shoulder is not None and shape.shoulder != shape.wrist:
        notes.append(
            (
                f"The axes of joints {_rows(shape.shoulder)} meet in one point, the centre of the "
                "shoulder. Seen from the hand, its position depends on the other joints only.",
            )
        )
    for run in shape.parallel:
        notes.append(
            (f"The axes of joints {_rows(run)} are parallel: their angles occur as sums.",)
        )
    return notes


def _rows(rows: Sequence[int]) -> str:
    return ", ".join(map(str, rows[:-1])) + f" and {rows[-1]}"


def missing_structure(shape: Structure, joints: int) -> str:
    """Say which structure an arm lacks that would give a closed form.

    Parameters
    ----------
    shape : Structure
    joints : int
        How many joints are to be found.
    """
    has = " ".join(str(part) for note in structure_notes(shape) for part in note)
    needed = (
        "A closed form is known for six joints where three neighbouring axes meet in one point, "
        "as in a spherical wrist, or are parallel (Pieper); this arm has no such three at its ends "
        "or between them, and the general arm of six joints leads to a polynomial of degree 16."
    )
    if joints < 6:
        needed = "The rules that are known here do not settle every joint from what is given."
    elif shape.wrist or shape.shoulder or any(len(run) > 2 for run in shape.parallel):
        needed = "The structure that the arm has is not enough for the rules that are known here."
    return f"{has} {needed}".strip()
