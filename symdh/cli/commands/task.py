"""``symdh task``: a task vector as a function of the joints, and its derivative."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symdh.cli import arguments, console, files, options, patience, tables

if TYPE_CHECKING:
    from sympy import Expr, Symbol

    from symdh.kinematics.task import AnalyticJacobian, TaskNumbers


@click.command(
    epilog=options.examples(
        "symdh task scara.yaml",
        'symdh task puma560.yaml --vector "x y z zyz"',
        'symdh task planar_2r.yaml --vector "x y phi" --numeric --set theta1="30 deg"',
    )
)
@options.table_argument
@click.option(
    "--vector",
    metavar="COMPONENTS",
    help="x, y, z, one of the 12 Euler sequences (zyz, zyx, ...), phi or alpha_z. "
    "Default: what fits the arm.",
)
@click.option("--numeric", is_flag=True, help="Numbers for the values that the table gives.")
@options.set_option("Value of a symbol, with or without its unit; asks for numbers.")
@options.format_option(
    "text", "latex", "json", what="Unicode to read, a LaTeX document, or JSON for a program."
)
@options.file_option("standard output")
@options.templates_option
@options.force_option
def task(
    table: str,
    vector: str | None,
    numeric: bool,
    settings: tuple[str, ...],
    form: str,
    output: str | None,
    force: bool,
) -> None:
    """Print a task vector r = f(q) and its derivative.

    Without --vector the components follow from the arm: a position and one angle where all
    revolute axes are parallel, else a position with Euler angles.
    """
    from symdh.kinematics.task import analytic_jacobian, task_numbers, task_vector

    robot = tables.read_robot(table)
    values = arguments.assignment(robot, settings)
    with patience.telling(f"deriving the task vector of {robot.name}"):
        found = analytic_jacobian(task_vector(robot, vector))
        numbers = task_numbers(found, values) if numeric or settings else None
        text = _text(found, numbers, values, form)
    files.save(output or "-", text.encode(), force=force)


def _text(
    found: AnalyticJacobian,
    numbers: TaskNumbers | None,
    values: dict[Symbol, Expr],
    form: str,
) -> str:
    if form == "json":
        from symdh.render.task_json import task_json

        return task_json(found, numbers) + "\n"
    from symdh.derivation.task import task_document

    document = task_document(found, numbers, values)
    if form == "latex":
        from symdh.render.latex import render_latex

        return render_latex(document)
    from symdh.render.terminal import render_chapters

    return render_chapters(document.chapters, width=console.width()) + "\n"
