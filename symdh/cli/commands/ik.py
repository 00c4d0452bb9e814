"""``symdh ik``: inverse kinematics, derived, and the solutions for one pose."""

from __future__ import annotations

import re
from math import radians
from typing import TYPE_CHECKING

import click

from symdh.cli import arguments, console, files, options, patience, tables
from symdh.errors import DerivationError, UnsupportedError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sympy import Expr, Symbol

    from symdh.derivation.blocks import Document
    from symdh.derivation.inverse import Solved
    from symdh.kinematics.inverse.inverse import InverseKinematics

#: Formats that go to a file of their own unless the user says otherwise.
_FILES = {"html": "_ik.html", "pdf": "_ik.pdf"}


@click.command(
    epilog=options.examples(
        "symdh ik puma560.yaml",
        'symdh ik planar_2r.yaml --pose "0.6 0.3"',
        'symdh ik ur5.yaml --set theta1="30 deg" --set theta2=10 ... --format json',
        "symdh ik iiwa.yaml --lock theta3 --check 1000",
    )
)
@options.table_argument
@click.option(
    "--task",
    "wanted",
    metavar="TASK",
    help="What is given: pose, orientation, or coordinates such as 'x y' and 'x y phi'. "
    "Default: what fits the arm.",
)
@click.option(
    "--lock",
    "locks",
    metavar="NAME",
    multiple=True,
    help="Hold a joint, for arms with more joints than the task needs. Repeatable.",
)
@click.option(
    "--pose",
    metavar="NUMBERS",
    help="Solve for a pose: 12 or 16 numbers by rows, or the coordinates of the task.",
)
@options.set_option(
    "Value of a symbol. With all joints set and no --pose, solves for the pose they give."
)
@click.option(
    "--near",
    "seeds",
    metavar="NAME=VALUE",
    multiple=True,
    help="Joint value that solutions should be near to; free joints take it. Repeatable.",
)
@click.option(
    "--check",
    "trials",
    type=click.IntRange(min=1),
    metavar="N",
    help="Solve for the poses of N random joint values and say whether they are found again.",
)
@options.time_limit_option(20.0, "Stop searching for a closed form after this CPU time.")
@options.format_option(
    "text",
    "latex",
    "html",
    "pdf",
    "json",
    what="Unicode to read, the handout as LaTeX, web page or PDF, or JSON for a program.",
)
@options.notation_option
@options.paper_option
@options.file_option("standard output; NAME_ik.html and NAME_ik.pdf for these two formats")
@options.templates_option
@options.force_option
def ik(
    table: str,
    wanted: str | None,
    locks: tuple[str, ...],
    pose: str | None,
    settings: tuple[str, ...],
    seeds: tuple[str, ...],
    trials: int | None,
    time_limit: float,
    form: str,
    notation: str,
    paper: str,
    output: str | None,
    force: bool,
) -> None:
    """Derive the inverse kinematics, or solve it for one pose.

    Says for each unknown which matrices are moved, which entries compared, what follows, how many
    values there are and where it fails. Where there is no closed form, says what was tried and
    solves by search.

    With --pose, or with --set for the joints that the table has no value for, prints all
    solutions of that pose.
    """
    from symdh.kinematics.inverse.inverse import inverse_kinematics

    robot = tables.read_robot(table)
    values = arguments.assignment(robot, settings)
    near = arguments.assignment(robot, seeds, "--near")
    locked = tuple(arguments.joint(robot, name) for name in locks)
    if trials is not None and (pose, output, form) != (None, None, "text"):
        raise UnsupportedError("--check prints a report: leave --pose, --format and -o out")
    with patience.telling(f"searching for the inverse kinematics of {robot.name}"):
        found = inverse_kinematics(robot, wanted, locked, time_limit)
    if trials is not None:
        console.print_result(_checked(found, trials, values))
        return
    solved = _solved(found, pose, values, near)
    if near and solved is None:
        raise UnsupportedError(
            "--near sorts the solutions of a pose: give --pose, or --set for every joint"
        )
    if output is None:
        from symdh.codegen.names import file_stem

        output = f"{file_stem(robot.name)}{_FILES[form]}" if form in _FILES else "-"
    content = _content(found, solved, form, notation, paper)
    files.save(output, content, force=force)


def _solved(
    found: InverseKinematics,
    pose: str | None,
    values: Mapping[Symbol, Expr],
    seeds: Mapping[Symbol, Expr],
) -> Solved | None:
    """Solve for the pose that was given, or that the joint values give; None without any.

    Raises
    ------
    UnsupportedError
        When some joints were given values and others have none.
    """
    from symdh.derivation.inverse import Solved
    from symdh.kinematics.frame import first_frame, last_frame
    from symdh.kinematics.inverse.goal import goal_of
    from symdh.kinematics.inverse.task import Kind
    from symdh.kinematics.numeric import pose as pose_of
    from symdh.robot import AngleUnit

    robot = found.robot
    if pose is not None:
        numbers = _numbers(pose)
        with_angle = found.task.kind is Kind.PLANAR and len(numbers) == len(found.task.axes) + 1
        if with_angle and robot.units.angle is not AngleUnit.RADIAN:
            numbers[-1] = radians(numbers[-1])
        goal = goal_of(found.task, numbers)
    elif set(values) & set(robot.variables) - set(found.locked):
        goal = pose_of(robot, first_frame(robot), last_frame(robot), values)
    else:
        return None
    seed = None
    if seeds:
        known = {**robot.values, **values, **seeds}
        seed = [float(known.get(variable, 0)) for variable in robot.variables]
    return Solved(goal, found.solver(values).solve(goal, seed), values)


def _numbers(text: str) -> list[float]:
    words = [word for word in re.split(r"[\s,;\[\]()]+", text) if word]
    wrong = ""
    try:
        return [float(wrong := word) for word in words]
    except ValueError:
        raise UnsupportedError(f"--pose takes plain numbers, and {wrong!r} is none") from None


def _checked(found: InverseKinematics, trials: int, values: Mapping[Symbol, Expr]) -> str:
    """Say what came of random poses.

    Raises
    ------
    DerivationError
        When a closed form has missed joint values that it should have found.
    """
    from symdh.kinematics.inverse.check import tried
    from symdh.kinematics.inverse.inverse import Method

    with patience.telling(f"solving for {trials} poses"):
        result = tried(found, trials, values)
    counts = ", ".join(f"{n} at {times}" for n, times in sorted(result.counts.items()))
    told = (
        f"method: {found.method.value}\n"
        f"random poses: {result.poses}; joint values found again at {result.found}\n"
        f"solutions: {counts}\n"
        f"largest error: {result.worst:.1e} (reach {result.reach:.4g})"
    )
    if result.found < trials and found.method is Method.CLOSED_FORM:
        missed = "; ".join(", ".join(f"{x:.6f}" for x in q) for q in result.missed)
        raise DerivationError(f"{told}\nnot found again (radians): {missed}")
    return told


def _content(
    found: InverseKinematics, solved: Solved | None, form: str, notation: str, paper: str
) -> bytes:
    """Return the derivation, and the solutions for a pose, in a format."""
    if form == "json":
        from symdh.render.inverse_json import inverse_json

        return f"{inverse_json(found, solved)}\n".encode()
    from symdh.derivation.inverse import inverse_document, numbers_chapter

    if form == "text":
        from symdh.render.terminal import render_chapters

        if solved is None:
            chapters = inverse_document(found, naming=notation).chapters
        else:
            chapters = (numbers_chapter(found, solved),)
        return f"{render_chapters(chapters, width=console.width())}\n".encode()
    document = inverse_document(found, solved, notation)
    if form == "html":
        from symdh.render.page.page import render_page

        return render_page(document, found.robot).encode()
    if form == "pdf":
        with patience.telling("typesetting"):
            return _pdf(document, paper)
    from symdh.render.latex import render_latex

    return render_latex(document, paper=paper).encode()


def _pdf(document: Document, paper: str) -> bytes:
    """Typeset the handout with TeX, without it with typst."""
    from symdh.render.pdf import TYPST, compile_pdf, compile_typst, find_engine

    if find_engine() == TYPST:
        from symdh.render.typst import render_typst

        return compile_typst(render_typst(document, paper))
    from symdh.render.latex import render_latex

    return compile_pdf(render_latex(document, paper=paper))
