"""``symdh rotate``: compose rotations, and say what a rotation is in every way."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from symdh.cli import arguments, console, files, options, patience, tables

if TYPE_CHECKING:
    from sympy import Expr

    from symdh.kinematics.rotation import EulerSequence, RotationResult
    from symdh.robot import Units
    from symdh.table.rotations import RotationSheet


@click.command(
    epilog=options.examples(
        'symdh rotate "Rx(45 deg) body, Ry(60 deg) body, Rz(90 deg) fixed" --point 1,2,3',
        "symdh rotate rotations.yaml --format latex -o rotations.tex",
        'symdh rotate --matrix "0 -1 0; 1 0 0; 0 0 1" --euler zyz',
        "symdh rotate --table puma560.yaml --to 3 --symbolic",
    )
)
@click.argument("rotations", required=False)
@click.option("--point", metavar="X,Y,Z", help="A point of the body to carry along.")
@click.option("--matrix", metavar="NUMBERS", help="Nine numbers by rows, instead of rotations.")
@click.option(
    "--table",
    type=click.Path(allow_dash=True, readable=False),
    help="Take the rotation from a Denavit-Hartenberg table.",
)
@options.frame_options
@options.set_option("Value of a symbol, with its unit.")
@click.option("--symbolic", is_flag=True, help="Leave symbols without numbers: formulas alone.")
@click.option(
    "--euler",
    "sequences",
    metavar="SEQUENCE",
    multiple=True,
    help="Euler angles to print the formulas of: zyx, zyz, ... or all. Repeatable. "
    "Default: zyx and zyz.",
)
@click.option(
    "--tolerance",
    type=options.NumberRange(min=0, max=0.1, min_open=True),
    default=1e-6,
    show_default=True,
    metavar="NUMBER",
    help="By how much the columns of a matrix may miss being orthonormal.",
)
@options.format_option(
    "text", "latex", "json", what="Unicode to read, a LaTeX document, or JSON for a program."
)
@options.file_option("standard output")
@options.templates_option
@options.force_option
def rotate(
    rotations: str | None,
    point: str | None,
    matrix: str | None,
    table: str | None,
    start: str | None,
    end: str | None,
    settings: tuple[str, ...],
    symbolic: bool,
    sequences: tuple[str, ...],
    tolerance: float,
    form: str,
    output: str | None,
    force: bool,
) -> None:
    """Compose rotations and say what a rotation is.

    ROTATIONS are carried out in the order given: each about an axis of the body, which moves with
    it, or about a fixed axis. A YAML file (or - for standard input) can hold the same.

    Prints the matrix, where a point goes, Euler angles (formulas, all 12 sequences in numbers),
    axis and angle, and the quaternion.
    """
    sources = [given for given in (rotations, matrix, table) if given is not None]
    if len(sources) != 1:
        raise click.UsageError("Give rotations, a file of them, --matrix or --table; one of them.")
    if table is None and (start is not None or end is not None):
        raise click.UsageError("--from and --to need --table.")
    wanted = _sequences(sequences)
    with patience.telling("composing"):
        if table is not None:
            found = _from_table(table, start, end, point, settings, symbolic)
        else:
            sheet = _sheet(rotations, matrix, point)
            found = _from_sheet(sheet, settings, symbolic, tolerance)
        text = _text(found, wanted, form)
    files.save(output or "-", text.encode(), force=force)


def _sequences(names: tuple[str, ...]) -> tuple[EulerSequence, ...]:
    """Return the sequences of Euler angles that were asked for, each once."""
    from symdh.kinematics.rotation import SEQUENCES, named_sequence

    if any(name.strip().lower() == "all" for name in names):
        return SEQUENCES
    return tuple(dict.fromkeys(named_sequence(name) for name in names or ("zyx", "zyz")))


def _sheet(rotations: str | None, matrix: str | None, point: str | None) -> RotationSheet:
    """Read what was typed, or the file that was named."""
    from symdh.table.rotations import (
        RotationSheet,
        parse_matrix,
        parse_rotations,
        read_rotation_sheet,
    )
    from symdh.table.source import read_source

    if matrix is not None:
        sheet = RotationSheet(matrix=parse_matrix(arguments.as_utf8(matrix)))
    elif rotations == "-" or Path(rotations or "").suffix.lower() in (".yaml", ".yml"):
        sheet = read_rotation_sheet(read_source(str(rotations)))
    else:
        sheet = parse_rotations(arguments.as_utf8(str(rotations)))
    console.show_diagnostics(sheet.warnings)
    if point is None:
        return sheet
    return replace(sheet, point=_point(point, sheet.units))


def _point(text: str, units: Units) -> tuple[Expr, Expr, Expr]:
    from symdh.table import parse_point

    return parse_point(arguments.as_utf8(text), units, "--point")


def _from_sheet(
    sheet: RotationSheet, settings: tuple[str, ...], symbolic: bool, tolerance: float
) -> RotationResult:
    """Compose the rotations of a sheet, or take its matrix."""
    from symdh.kinematics.rotation import About, Step, of_matrix, of_steps, stand_in

    steps = [
        Step(each.axis, each.angle, About.FIXED if each.fixed else About.BODY)
        for each in sheet.rotations
    ]
    angles = [step.angle for step in steps]
    shown = sheet.point, sheet.units, sheet.values, sheet.title
    robot = stand_in(angles, *shown, entries=sheet.matrix or ())
    robot = replace(robot, values={**robot.values, **arguments.assignment(robot, settings)})
    if sheet.matrix is not None:
        return of_matrix(robot, sheet.matrix, sheet.point, symbolic, tolerance)
    return of_steps(robot, steps, sheet.point, symbolic)


def _from_table(
    table: str,
    start: str | None,
    end: str | None,
    point: str | None,
    settings: tuple[str, ...],
    symbolic: bool,
) -> RotationResult:
    """Take the orientation between two frames of an arm."""
    from symdh.kinematics.rotation import of_arm

    robot = tables.read_robot(table)
    first, last = tables.frames_between(robot, start, end)
    followed = None if point is None else _point(point, robot.units)
    values = arguments.assignment(robot, settings)
    robot = replace(robot, values={**robot.values, **values})
    return of_arm(robot, first, last, values, followed, symbolic)


def _text(found: RotationResult, wanted: tuple[EulerSequence, ...], form: str) -> str:
    if form == "json":
        from symdh.render.rotation_json import rotation_json

        return rotation_json(found) + "\n"
    from symdh.derivation.rotation import rotation_document

    document = rotation_document(found, wanted)
    if form == "latex":
        from symdh.render.latex import render_latex

        return render_latex(document)
    from symdh.render.terminal import render_chapters

    return render_chapters(document.chapters, width=console.width()) + "\n"
