"""``symdh rotate``: compose rotations, and say what a rotation is in every way."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from symdh.cli import arguments, console, files, options, tables
from symdh.errors import UnsupportedError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sympy import Expr, ImmutableMatrix

    from symdh.derivation.rotation import RotationResult
    from symdh.kinematics.rotation import Description, EulerSequence
    from symdh.robot import Robot
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
@click.option(
    "--set",
    "settings",
    metavar="NAME=VALUE",
    multiple=True,
    help="Value of a symbol, with its unit. Repeatable.",
)
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
    type=click.FloatRange(min=0, max=0.1, min_open=True),
    default=1e-6,
    show_default=True,
    metavar="NUMBER",
    help="By how much the columns of a matrix may miss being orthonormal.",
)
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "latex", "json"]),
    default="text",
    show_default=True,
    help="Unicode to read, a LaTeX document, or JSON for a program.",
)
@options.file_option("standard output")
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
    from symdh.derivation.rotation import rotation_document

    sources = [given for given in (rotations, matrix, table) if given is not None]
    if len(sources) != 1:
        raise click.UsageError("Give rotations, a file of them, --matrix or --table; one of them.")
    if table is None and (start is not None or end is not None):
        raise click.UsageError("--from and --to need --table.")
    wanted = _sequences(sequences)
    if table is not None:
        found = _from_table(table, start, end, point, settings, symbolic, tolerance)
    else:
        found = _from_sheet(_sheet(rotations, matrix, point), settings, symbolic, tolerance)
    files.save(output or "-", _text(found, wanted, form, rotation_document).encode(), force=force)


def _text(
    found: RotationResult, wanted: Sequence[EulerSequence], form: str, document: object
) -> str:
    from symdh.derivation.rotation import rotation_document

    if form == "json":
        from symdh.render.rotation_json import rotation_json

        return rotation_json(found, wanted) + "\n"
    written = rotation_document(found, wanted)
    if form == "latex":
        from symdh.render.latex import render_latex

        return render_latex(written)
    from symdh.render.terminal import render_chapters

    return render_chapters(written.chapters, width=console.width()) + "\n"
