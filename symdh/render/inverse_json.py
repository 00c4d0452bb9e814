"""Inverse kinematics as JSON, for programs."""

from __future__ import annotations

import json
from typing import Any

from symdh.derivation.inverse import Solved
from symdh.kinematics.inverse.branches import Branches, Branching, branches_of
from symdh.kinematics.inverse.inverse import InverseKinematics, Method
from symdh.kinematics.inverse.judge import Answer
from symdh.kinematics.inverse.pool import Source
from symdh.kinematics.inverse.solution import ClosedForm, Step
from symdh.notation import Notation, Shorthand
from symdh.render.plain_math import PlainWriter


def inverse_json(found: InverseKinematics, solved: Solved | None = None) -> str:
    """Return the steps of a solution, and the answers for one goal.

    ``steps`` hold for each unknown its rule and its equations, expressions that are zero; names
    such as ``e_13`` are defined by the steps whose rule is names for known parts. ``branches`` of
    a step are the names of its values, in their order unless that depends on the goal or on the
    steps before; each solution has its own. Angles are radians.
    """
    form = found.form
    branches = None if form is None else branches_of(form, solved.values if solved else None)
    named = branches if found.method is Method.CLOSED_FORM else None
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
        "steps": [] if form is None or branches is None else _steps(form, branches),
        "goal": None if solved is None else [list(map(float, row)) for row in solved.goal[:3]],
        "solutions": None if solved is None else [_answer(named, each) for each in solved.answers],
    }
    return json.dumps(content, indent=2, ensure_ascii=False)


def _steps(form: ClosedForm, branches: Branches) -> list[dict[str, Any]]:
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
            "branches": _names(branches.of(step.unknown)),
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


def _names(branching: Branching | None) -> list[str]:
    """Return the names of a step's values; of a feature where they may come in either order."""
    if branching is None:
        return []
    return list(branching.names or (branching.feature.names if branching.feature else ()))


def _answer(branches: Branches | None, answer: Answer) -> dict[str, Any]:
    names: tuple[str, ...] = ()
    if branches is not None and answer.branches:
        names = branches.names(answer.branches, answer.q)
    return {
        "q": list(answer.q),
        "branches": list(names),
        "free": [variable.name for variable in answer.free],
        "error": answer.error,
        "within_limits": answer.within_limits,
    }
