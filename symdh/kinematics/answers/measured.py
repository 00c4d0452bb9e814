"""Numbers that somebody worked out, against the true ones."""

from __future__ import annotations

import math

from symdh.kinematics.answers.figures import Written
from symdh.kinematics.answers.numbers import Point, value
from symdh.kinematics.answers.verdicts import Finding, JudgedEntry, Verdict
from symdh.table.answers import Entry


def judged_number(entry: Entry, truth: float, size: float, point: Point) -> JudgedEntry:
    """Judge a number, rounded or exact, for a thing of some size."""
    label = f"[{entry.row + 1},{entry.column + 1}]"
    if entry.value is None:
        return JudgedEntry(label, entry, Finding(Verdict.BLANK), truth)
    written = Written.of(entry.text, value(entry.value, point))
    return JudgedEntry(label, entry, _finding(written, truth, size), truth)


def _finding(written: Written, truth: float, size: float) -> Finding:
    if not math.isfinite(written.value):
        return Finding(Verdict.WRONG, "it has no real value")
    if written.is_exact(truth):
        return Finding(Verdict.RIGHT)
    if written.agrees(truth):
        if written.is_fine(size):
            return Finding(Verdict.RIGHT)
        return Finding(Verdict.COARSE, "right as far as it goes; give at least three digits")
    if abs(truth) > 1e-9 and Written(-written.value, written.last, written.digits).agrees(truth):
        return Finding(Verdict.SIGN)
    if written.is_near(truth, size):
        return Finding(Verdict.COARSE, "near, but not to the digits written: rounded too early?")
    for power in (1, 2, 3):
        for factor in (10.0**power, 10.0**-power):
            scaled = Written(written.value * factor, written.last * factor, written.digits)
            if abs(truth) > 1e-9 and scaled.is_fine(size) and scaled.agrees(truth):
                return Finding(
                    Verdict.WRONG, f"off by a factor of {10**power}: another unit of length?"
                )
    return Finding(Verdict.WRONG)
