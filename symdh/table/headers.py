r"""The names of columns, as textbooks and spreadsheets print them.

``alpha_{i-1}``, ``$\theta_i$``, ``a [mm]``, ``Link length``: a header says which parameter stands
below it, and may say the unit of its bare numbers and, by its index, the convention.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from symdh.robot import Convention
from symdh.table.cells import scalar
from symdh.table.nodes import Node, ScalarNode, SequenceNode
from symdh.table.report import Report
from symdh.table.suggest import brief, did_you_mean
from symdh.table.units import ANGLE_UNITS, LENGTH_UNITS, UNIT_ALIASES, Unit

PARAMETERS = ("theta", "d", "a", "alpha")
TYPE = "type"
VARIABLE = "variable"
LABELS = ("i", "joint", "link", "notes")
"""Columns that are for people: read and left alone."""

COLUMNS = (*PARAMETERS, TYPE, VARIABLE, *LABELS)
COLUMN_ALIASES = {
    "twist": "alpha",
    "length": "a",
    "r": "a",
    "offset": "d",
    "angle": "theta",
    "q": "theta",
}
"""What people call a key of a row, for the "did you mean"."""

_OTHER_NAMES = {
    **dict.fromkeys(("th", "angle", "jointangle"), "theta"),
    **dict.fromkeys(("offset", "linkoffset", "jointoffset", "jointdistance"), "d"),
    **dict.fromkeys(("r", "l", "length", "linklength"), "a"),
    **dict.fromkeys(("twist", "linktwist", "twistangle", "linktwistangle"), "alpha"),
    **dict.fromkeys(("jointtype", "kind"), TYPE),
    **dict.fromkeys(("var", "jointvariable"), VARIABLE),
    **dict.fromkeys(("#", "n", "no", "no.", "nr", "nr.", "number", "index", "row", "axis"), "i"),
    **dict.fromkeys(("jointi", "joint#", "jointno", "jointno.", "jointnumber"), "joint"),
    **dict.fromkeys(("linki", "link#", "linkno", "linkno.", "linknumber"), "link"),
    **dict.fromkeys(("note", "comment", "comments", "remark", "remarks", "description"), "notes"),
}
"""Other names of columns; one of a parameter counts where no column has its proper name."""

MAX_HEADER = 60
_KHALIL = ["alpha", "d", "theta", "r"]
_SPELLING = {"θ": "theta", "ϑ": "theta", "α": "alpha", "−": "-", **dict.fromkeys("$\\ *`", "")}
_GREEK = str.maketrans(_SPELLING)
_INDEX = re.compile(r"(?:_?(?:\{i(?:[-−]1)?\}|\(i(?:[-−]1)?\)|i(?:[-−]1)?)|ᵢ(?:₋₁)?)\Z")
_ANY_INDEX = re.compile(
    r"(?:_?(?:\{([ijkn])(-1)?\}|\(([ijkn])(-1)?\)|([ijkn])(-1)?)|([ᵢⱼₖₙ])(₋₁)?)\Z"
)
_UNIT = re.compile(
    r"(?P<name>.+?)\s*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\)|/(?P<over>[^/]*)"
    r"|[_,\s]+(?P<after>[^_,\s]*)|(?P<sign>°))\s*"
)
_UNIT_GROUPS = ("square", "round", "over", "after", "sign")
_NO_MARKUP = str.maketrans("", "", "$\\*`")
_UNITS: dict[str, Unit] = {**ANGLE_UNITS, **LENGTH_UNITS}


@dataclass(frozen=True, slots=True)
class Header:
    """What the name of one column says.

    Attributes
    ----------
    column : str or None
        None when it is no name of a column.
    unit : str
        Of the bare numbers below, as it is written; empty when the header says none.
    convention : Convention or None
        What the index of a or alpha tells.
    proper : bool
        Whether this is a parameter's own name rather than one of `_OTHER_NAMES`.
    node : ScalarNode or None
        Where it stands.
    """

    column: str | None
    unit: str = ""
    convention: Convention | None = None
    proper: bool = True
    node: ScalarNode | None = None


@dataclass(frozen=True, slots=True)
class Columns:
    """The columns of a table.

    Attributes
    ----------
    names : tuple of str or None
        In the order of the file; None for one that is wrong and already noted.
    units : mapping of str to AngleUnit or LengthUnit
        Those that the headers say.
    teller : Header or None
        The first header whose index tells the convention.
    """

    names: tuple[str | None, ...] = ()
    units: Mapping[str, Unit] = field(default_factory=dict)
    teller: Header | None = None


def column_name(written: str) -> str | None:
    """Return the column that a key of a row means, or None.

    Accepts what textbooks print: ``θ``, ``theta_i``, ``alpha_{i-1}``, ``$a_{i-1}$``, ``αᵢ₋₁``.
    """
    name = written.translate(_GREEK)
    if name in COLUMNS:
        return name
    bare = _INDEX.sub("", name)
    return bare if bare in PARAMETERS else None


def read_header(written: str) -> Header:
    """Return what the name of a column says; see the examples at the top of this module."""
    if len(written) > MAX_HEADER:
        return Header(None)
    header = _without_unit(written)
    split = _UNIT.fullmatch(written.translate(_NO_MARKUP))
    if header.column is not None or split is None:
        return header
    named = _without_unit(split["name"])
    unit = next(filter(None, map(split.group, _UNIT_GROUPS)), "").strip()
    in_brackets = split["square"] or split["round"]
    if named.column in PARAMETERS and (in_brackets or _known_unit(unit)):
        return replace(named, unit=unit)
    return header


def _without_unit(written: str) -> Header:
    name = written.casefold().translate(_GREEK)
    if name in COLUMNS:
        return Header(name)
    other = _OTHER_NAMES.get(name.replace("_", "").replace("-", ""))
    if other is not None:
        return Header(other, proper=other not in PARAMETERS)
    index = _ANY_INDEX.search(name)
    bare = name[: index.start()] if index else ""
    if index is None or bare not in (*PARAMETERS, "r", "l"):
        return Header(None)
    column = bare if bare in PARAMETERS else "a"
    return Header(column, "", _told(column, *filter(None, index.groups())), bare == column)


def _told(column: str, letter: str, before: str = "") -> Convention | None:
    """Return the convention of a_i or a_{i-1}; that of a_j is open, as Khalil has it in both."""
    if column not in ("a", "alpha"):
        return None
    if before:
        return Convention.MODIFIED
    return Convention.STANDARD if letter in ("i", "ᵢ") else None


def _known_unit(unit: str) -> Unit | None:
    return _UNITS.get(UNIT_ALIASES.get(unit.casefold(), unit))


def read_columns(node: Node, report: Report) -> Columns:
    """Read the list of the names of columns, and note what is wrong with it."""
    if not isinstance(node, SequenceNode):
        report.error(node.place(), "columns must be a list such as [alpha, a, d, theta]")
        return Columns()
    headers = list(_headers(node, report))
    if not any(header.column for header in headers):
        report.error(node.place(), "there are no names of columns; name them theta, d, a, alpha")
        return Columns()
    proper = {header.column for header in headers if header.proper}
    names: list[str | None] = []
    for header in headers:
        names.append(_name(header, names, proper, report))
    _refuse_khalil(headers, report)
    missing = [name for name in PARAMETERS if name not in names]
    if missing and None not in names:
        noun = "column" if len(missing) == 1 else "columns"
        report.error(node.place(), f"missing {noun} {', '.join(missing)}")
    units = {header.column: _unit(header, report) for header in headers if header.unit}
    known = {column: unit for column, unit in units.items() if column and unit}
    return Columns(tuple(names), known, _teller(headers, report))


def _headers(node: SequenceNode, report: Report) -> Iterator[Header]:
    for number, item in enumerate(node.items):
        text = scalar(item, "the name of a column", report)
        if text is None:
            yield Header(None)
        elif number == 0 and not text.text:
            yield Header("i", node=text)  # as spreadsheets and data frames head row numbers
        else:
            yield replace(read_header(text.text), node=text)


def _name(
    header: Header, names: Sequence[str | None], proper: set[str | None], report: Report
) -> str | None:
    """Return the column that a header stands for; None, and an error, when it stands for none."""
    if header.node is None:
        return None
    written, column = brief(header.node.text), header.column
    if column is None:
        hint = did_you_mean(header.node.text, COLUMNS, COLUMN_ALIASES)
        report.error(header.node.place(), f"column {written or '(empty)'} unknown{hint}")
    elif not header.proper and column in proper:
        message = f"column {written} would be {column}, and there is a column {column}"
        report.error(header.node.place(), message)
        return None
    elif column in names and column not in LABELS:
        report.error(header.node.place(), f"column {column} is given twice")
    return column


def _unit(header: Header, report: Report) -> Unit | None:
    """Return the unit that a header says; None, and an error, when it is none of its parameter."""
    kind = ANGLE_UNITS if header.column in ("theta", "alpha") else LENGTH_UNITS
    unit = _known_unit(header.unit)
    if unit in kind.values():
        return unit
    assert header.node is not None  # where its unit was read
    message = f"unit {brief(header.unit)} of column {header.column} unknown"
    report.error(header.node.place(), f"{message}; use {', '.join(kind)}")
    return None


def _refuse_khalil(headers: Iterable[Header], report: Report) -> None:
    """Refuse alpha, d, theta, r: in books with this order d is a_{i-1}, and r is d_i."""
    kept = [(h.node, h) for h in headers if h.node is not None and h.column in PARAMETERS]
    names = ["r" if not h.proper and node.text[:1] in "rR" else h.column for node, h in kept]
    if names == _KHALIL:
        message = "r could be a or, with d for a, be d as Khalil has it; name the columns a and d"
        report.error(kept[-1][0].place(), message)


def _teller(headers: Iterable[Header], report: Report) -> Header | None:
    """Return the first header that tells the convention; note one that tells the other."""
    first: Header | None = None
    for header in headers:
        if header.convention is None or header.node is None:
            continue
        first = first or header
        if header.convention is not first.convention:
            message = (
                f"{brief(header.node.text)} is a column of the {header.convention.value} "
                "convention, and a column before it is of the other"
            )
            report.error(header.node.place(), message)
    return first
