"""Judged answers for people: all of one sheet, a line a sheet, or a grade book."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from symdh.kinematics.answers import JudgedClaim, JudgedEntry, JudgedSheet, Verdict
from symdh.notation import Notation
from symdh.notation.numbers import figures
from symdh.render.plain_math import PlainWriter
from symdh.robot import Robot

_MARKS = {
    Verdict.RIGHT: "✓",
    Verdict.SIGN: "±",
    Verdict.SWAPPED: "⇄",
    Verdict.COARSE: "≈",
    Verdict.WRONG: "✗",
    Verdict.BLANK: "·",
}
_LONGEST = 60
#: What a spreadsheet takes for the start of a formula.
_FORMULA = ("=", "+", "-", "@")


def sheet_text(robot: Robot, sheet: JudgedSheet, solution: bool = False) -> str:
    """Return all verdicts on one sheet.

    Parameters
    ----------
    robot : Robot
    sheet : JudgedSheet
    solution : bool
        Also give the right answer beside each wrong one.
    """
    who = f" ({sheet.student})" if sheet.student else ""
    parts = [f"{sheet.filename}{who}: {sheet.right} of {sheet.total} right"]
    width = max((len(claim.name) for claim in sheet.claims), default=0)
    parts += [_claim(robot, claim, width, solution) for claim in sheet.claims]
    used = {verdict for claim in sheet.claims for verdict in claim.counts} - {Verdict.RIGHT}
    if used:
        meanings = [f"{_MARKS[v]} {v.value}" for v in Verdict if v in used]
        parts.append(f"✓ right, {', '.join(meanings)}")
    return "\n\n".join(["\n".join(parts[: len(sheet.claims) + 1]), *parts[len(sheet.claims) + 1 :]])


def summary_text(sheets: Iterable[JudgedSheet]) -> str:
    """Return a line a sheet: file, name, how many are right, and what is not all right."""
    rows = []
    for sheet in sheets:
        share = f"{100 * sheet.right // max(sheet.total, 1)} %"
        faults = [f"{c.name} {c.right}/{len(c.entries)}" for c in sheet.claims if _faulty(c)]
        score = f"{sheet.right}/{sheet.total}"
        rows.append((sheet.filename, sheet.student, score, share, ", ".join(faults)))
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return "\n".join(
        f"{row[0]:{widths[0]}}  {row[1]:{widths[1]}}  {row[2]:>{widths[2]}}  "
        f"{row[3]:>{widths[3]}}  {row[4]}".rstrip()
        for row in rows
    )


def sheets_csv(sheets: Sequence[JudgedSheet]) -> str:
    """Return a grade book: a row a sheet, a column for each thing that was answered."""
    names = list(dict.fromkeys(claim.name for sheet in sheets for claim in sheet.claims))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["file", "name", "right", "total", *map(_cell, names)])
    for sheet in sheets:
        scores = {claim.name: claim.right for claim in sheet.claims}
        who = map(_cell, (sheet.filename, sheet.student))
        marks = (scores.get(name, "") for name in names)
        writer.writerow([*who, sheet.right, sheet.total, *marks])
    return text.getvalue()


def _cell(text: str) -> str:
    """Return a cell that no spreadsheet takes for a formula: the names come from outside."""
    return f"'{text}" if text.startswith(_FORMULA) else text


def _faulty(claim: JudgedClaim) -> bool:
    return claim.right < len(claim.entries)


def _claim(robot: Robot, claim: JudgedClaim, width: int, solution: bool) -> str:
    counts = claim.counts
    blank = f", {counts[Verdict.BLANK]} blank" if counts[Verdict.BLANK] else ""
    mark = "✗" if _faulty(claim) else "✓"
    lines = [f"{mark} {claim.name:{width}}  {claim.right} of {len(claim.entries)} right{blank}"]
    several = len(claim.entries) > 1
    if _faulty(claim) and several and counts[Verdict.BLANK] < len(claim.entries):
        marks = [_MARKS[each.verdict] for each in claim.entries]
        columns = claim.columns if claim.columns > 1 else len(marks)
        rows = [marks[k : k + columns] for k in range(0, len(marks), columns)]
        lines += [f"      {' '.join(row)}" for row in rows]
    lines += [
        f"    {_entry(robot, each, several, solution)}"
        for each in claim.entries
        if each.verdict not in (Verdict.RIGHT, Verdict.BLANK) or each.finding.note
    ]
    if claim.hint:
        lines.append(f"    hint: {claim.hint}")
    return "\n".join(lines)


def _entry(robot: Robot, each: JudgedEntry, several: bool, solution: bool) -> str:
    where = f"{each.label} = " if several else ""
    text = each.entry.text
    shown = text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
    remark = remark_text(robot, each)
    verdict = each.verdict.value + (f" ({remark})" if remark else "")
    right = ""
    if solution and each.verdict is not Verdict.RIGHT and each.expected is not None:
        right = f"; right is {expected_text(robot, each)}"
    return f"{_MARKS[each.verdict]} {where}{shown}: {verdict}{right}"


def remark_text(robot: Robot, each: JudgedEntry) -> str:
    """Return what there is to say beside the verdict."""
    if each.finding.term is None:
        return each.finding.note
    return f"of the term {PlainWriter().text(Notation(robot).write(each.finding.term))}"


def expected_text(robot: Robot, each: JudgedEntry) -> str:
    """Return the right answer in short form, a number rounded for people."""
    if each.expected is None:
        return ""
    if isinstance(each.expected, float):
        return figures(each.expected)
    return PlainWriter().text(Notation(robot).write(each.expected))
