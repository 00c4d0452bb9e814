"""What a joint does: named in its row, or read off the places of its symbols."""

from __future__ import annotations

from collections.abc import Mapping

from sympy import Symbol

from symdh.robot import JointType
from symdh.table.cells import Cell, scalar
from symdh.table.headers import TYPE
from symdh.table.nodes import ScalarNode
from symdh.table.report import Report
from symdh.table.rows import Row
from symdh.table.suggest import brief, did_you_mean

TYPES = {
    "revolute": JointType.REVOLUTE,
    "prismatic": JointType.PRISMATIC,
    "fixed": JointType.FIXED,
    # Words of the lectures: a revolute joint that turns about its own link, and two for sliding.
    "twisting": JointType.REVOLUTE,
    "linear": JointType.PRISMATIC,
    "sliding": JointType.PRISMATIC,
}
_ALIASES = {
    "rotary": "revolute",
    "rotational": "revolute",
    "rotation": "revolute",
    "rot": "revolute",
    "r": "revolute",
    "hinge": "revolute",
    "translational": "prismatic",
    "translation": "prismatic",
    "slider": "prismatic",
    "p": "prismatic",
    "none": "fixed",
    "f": "fixed",
}

HOMES = {JointType.REVOLUTE: "theta", JointType.PRISMATIC: "d"}
"""The parameter that holds the variable of a moving joint."""


def read_type(
    row: Row, cells: Mapping[str, Cell], variable: Symbol | None, report: Report
) -> JointType | None:
    """Return what a joint does.

    Parameters
    ----------
    row : Row
    cells : mapping of str to Cell
        Those of the row that could be read.
    variable : Symbol or None
        The variable that the row names, if it names one.
    report : Report

    Returns
    -------
    JointType or None
        None where the row has an error that leaves it open.
    """
    node = row.cells.get(TYPE)
    text = scalar(node, "the type of a joint", report) if node is not None else None
    # An empty cell of a compact table leaves the type to be read off.
    if text is not None and text.text.strip():
        return _of_word(text, report)
    return _of_symbols(cells, variable)


def _of_word(text: ScalarNode, report: Report) -> JointType | None:
    word = text.text.strip()
    kind = TYPES.get(word.lower())
    if kind is None:
        hint = did_you_mean(word, TYPES, _ALIASES) or f"; use {', '.join(TYPES)}"
        report.error(text.place(), f"type {brief(word)} unknown{hint}")
    return kind


def _of_symbols(cells: Mapping[str, Cell], variable: Symbol | None) -> JointType | None:
    for kind, home in HOMES.items():
        if home in cells and variable in cells[home].names:
            return kind
    for kind, home in HOMES.items():
        if home not in cells:
            return None
        if cells[home].names:
            return kind
    return JointType.FIXED
