"""Judged answers as JSON, for programs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from symdh.kinematics.answers import JudgedClaim, JudgedEntry, JudgedSheet
from symdh.render.answers_text import expected_text, remark_text
from symdh.robot import Robot


def answers_json(robot: Robot, sheets: Iterable[JudgedSheet], solution: bool = False) -> str:
    """Return all verdicts on all sheets; the right answers too where they are asked for."""
    content = [_sheet(robot, sheet, solution) for sheet in sheets]
    return json.dumps({"table": robot.name, "sheets": content}, indent=2, ensure_ascii=False)


def _sheet(robot: Robot, sheet: JudgedSheet, solution: bool) -> dict[str, Any]:
    return {
        "file": sheet.filename,
        "name": sheet.student,
        "right": sheet.right,
        "total": sheet.total,
        "answers": [_claim(robot, claim, solution) for claim in sheet.claims],
    }


def _claim(robot: Robot, claim: JudgedClaim, solution: bool) -> dict[str, Any]:
    return {
        "answer": claim.name,
        "right": claim.right,
        "total": len(claim.entries),
        "hint": claim.hint or None,
        "entries": [_entry(robot, each, solution) for each in claim.entries],
    }


def _entry(robot: Robot, each: JudgedEntry, solution: bool) -> dict[str, Any]:
    content: dict[str, Any] = {
        "entry": each.label,
        "line": each.entry.place.line,
        "written": each.entry.text,
        "verdict": each.verdict.name.lower(),
        "note": remark_text(robot, each) or None,
    }
    if solution:
        content["expected"] = expected_text(robot, each) or None
    return content
