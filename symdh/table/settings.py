"""The convention and the units of a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from symdh.robot import AngleUnit, Convention, LengthUnit, Units
from symdh.table.cells import scalar
from symdh.table.headers import Header
from symdh.table.nodes import MappingNode, Node
from symdh.table.report import Report
from symdh.table.source import START
from symdh.table.suggest import brief, did_you_mean
from symdh.table.units import ANGLE_UNITS, LENGTH_UNITS, UNIT_ALIASES, Unit

_T = TypeVar("_T")

_CONVENTIONS = {convention.value: convention for convention in Convention}
_CONVENTION_ALIASES = {
    "distal": "standard",
    "classic": "standard",
    "classical": "standard",
    "original": "standard",
    "dh": "standard",
    "sdh": "standard",
    "proximal": "modified",
    "craig": "modified",
    "mdh": "modified",
    "khalil": "modified",
}


def read_convention(
    node: Node | None, report: Report, teller: Header | None = None, advice: str = ""
) -> Convention:
    """Read the convention, which the key says, or else the index of a column: ``alpha_{i-1}``.

    A table that tells it in neither way is read as standard, with a warning that gives `advice`;
    with none where there is no advice to give.
    """
    told = teller.convention if teller else None
    if node is None and told is not None:
        return told
    if node is None:
        if advice:
            message = "no convention is given; read as standard (distal)"
            report.warning(START, f"{message}. {advice}")
        return Convention.STANDARD
    found = _word("convention", node, _CONVENTIONS, _CONVENTION_ALIASES, report)
    if teller and teller.node and found not in (None, told):
        message = f"the table says that it is {found.value}, and this column is of the other"
        report.warning(teller.node.place(), f"{message} convention")
    return found or Convention.STANDARD


def read_units(node: Node | None, report: Report) -> Units:
    """Read what a bare number means."""
    if node is None:
        return Units()
    if not isinstance(node, MappingNode):
        report.error(node.place(), "units must be a mapping such as {angle: deg, length: mm}")
        return Units()
    angle: AngleUnit | None = None
    length: LengthUnit | None = None
    for key, value in node.items:
        if key.text == "angle":
            angle = _word("unit of angle", value, ANGLE_UNITS, UNIT_ALIASES, report)
        elif key.text == "length":
            length = _word("unit of length", value, LENGTH_UNITS, UNIT_ALIASES, report)
        else:
            hint = did_you_mean(key.text, ("angle", "length"))
            report.error(key.place(), f"key {brief(key.text)} unknown in units{hint}")
    return Units(angle, length)


def units_of_columns(said: Units, columns: Mapping[str, Unit]) -> Units:
    """Complete what a table says with the units that all its columns of angles or lengths share."""
    angle = columns.get("theta") if columns.get("theta") is columns.get("alpha") else None
    length = columns.get("a") if columns.get("a") is columns.get("d") else None
    return Units(
        said.angle or (angle if isinstance(angle, AngleUnit) else None),
        said.length or (length if isinstance(length, LengthUnit) else None),
    )


def _word(
    what: str, node: Node, known: Mapping[str, _T], aliases: Mapping[str, str], report: Report
) -> _T | None:
    """Return what a word stands for; else None, and an error in the report."""
    text = scalar(node, f"a {what}", report)
    if text is None:
        return None
    word = text.text.strip()
    if word not in known:
        hint = did_you_mean(word, known, aliases) or f"; use {' or '.join(known)}"
        report.error(text.place(), f"{what} {brief(word)} unknown{hint}")
    return known.get(word)
