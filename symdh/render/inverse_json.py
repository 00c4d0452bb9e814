"""Inverse kinematics as JSON, for programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from symdh.kinematics.inverse.inverse import InverseKinematics, Method
from symdh.kinematics.inverse.judge import Answer
from symdh.kinematics.inverse.pool import Source
from symdh.kinematics.inverse.solution import ClosedForm, Step
from symdh.notation import Notation, Shorthand
from symdh.render.plain_math import PlainWriter


def inverse_json(
    found: InverseKinematics,
    goal: Sequence[Sequence[float]] | None = None,
    answers: Sequence[Answer] | None = None,
) -> str:
    """Return the steps of a solution, and the answers for one goal.

    ``steps`` hold for each unknown its rule and its equations, expressions that are zero; names
    such as ``e_13`` are defined by the steps whose rule is names for known parts. Angles are
    radians.
    """
    form = found.form
    content: dict[str, Any] = {
        "robot": found.robot.name,
        "variables": [variable.name for variable in found.robot.variables],
        "task": found.task.description,
        "method": found.method.value,
        "locked": [variable.name for variable in found.locked],
        "searched": None if found.searched is None else found.searched.name,
        "most_solutions": form.most_solutions
        if form is not None and found.method is Method.CLOSED_FORM
        else None,
        "steps": [] if form is None else _steps(form),
        "goal": None if goal is None else [list(map(float, row)) for row in goal[:3]],
        "solutions": None if answers is None else [_answer(found, each) for each in answers],
    }
    return json.dumps(content, indent=2, ensure_ascii=False)


def _steps(form: ClosedForm) -> list[dict[str, Any]]:
    robot = form.arm.robot
    notation = Notation(robot, Shorthand.none(robot), degrees=False)
    plain = PlainWriter()

    def text(element: Any) -> str:
        return plain.text(notation.write(form.ring.expression(element)))

    def step_content(step: Step) -> dict[str, Any]:
        if step.definitions:
            names = {str(form.ring.letters[k]): text(e) for k, e in step.definitions}
            return {"rule": step.rule.value, "names": names}
        return {
            "unknown": plain.text(notation.write(form.ring.unknown_expression(step.unknown))),
            "rule": step.rule.value,
            "branches": list(form.branch_names.get(step.unknown, ())),
            "from": [_source(used.equation.source) for used in step.equations],
            "equations": [text(used.element) for used in step.equations],
        }

    return [step_content(step) for step in form.steps]


def _source(source: Source) -> dict[str, Any]:
    """Return the product A_first .. A_last that stood alone, and the entries compared, from 1."""
    return {
        "first": source.i + 1,
        "last": source.j,
        "inverted": source.inverted,
        "entries": [[row + 1, column + 1] for row, column in source.entries],
    }


def _answer(found: InverseKinematics, answer: Answer) -> dict[str, Any]:
    names: list[str] = []
    if found.form is not None and found.method is Method.CLOSED_FORM and answer.branches:
        names = [
            found.form.branch_names[step.unknown][branch]
            for step, branch in zip(found.form.branching, answer.branches, strict=True)
        ]
    return {
        "q": list(answer.q),
        "branches": names,
        "free": [variable.name for variable in answer.free],
        "error": answer.error,
        "within_limits": answer.within_limits,
    }
