"""``symdh convert``: a table in the other convention or another format, and URDF into a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symdh.cli import console, files, options
from symdh.render.interchange import FORMATS

if TYPE_CHECKING:
    from symdh.frames.urdf_chain import ImportedChain
    from symdh.robot import Robot
    from symdh.table.source import Source
    from symdh.table.urdf import UrdfChain

_CONVENTIONS = ("standard", "modified")

#: Joints from which on it takes seconds.
_LONG = 15


@click.command(
    epilog=options.examples(
        "symdh convert puma560.yaml --to modified -o puma560_craig.yaml",
        "symdh convert scara.yaml --to urdf -o scara.urdf",
        "symdh convert arm.urdf --chain base_link tool0",
        "symdh convert arm.urdf --chain base_link tool0 --to modified",
    )
)
@click.argument("table", type=click.Path(allow_dash=True, readable=False))
@click.option(
    "--to",
    "wanted",
    type=click.Choice([*_CONVENTIONS, *(form.name for form in FORMATS)]),
    help="standard, modified: the table in that convention; "
    + "; ".join(f"{form.name}: {form.description}" for form in FORMATS)
    + ". Default for URDF: standard.",
)
@click.option(
    "--chain",
    nargs=2,
    metavar="BASE TIP",
    help="The two links of a URDF file that the arm lies between; needed where the robot branches.",
)
@click.option(
    "--tolerance",
    type=options.NumberRange(min=0, max=0.1),
    default=1e-5,
    show_default=True,
    metavar="NUMBER",
    help="What is nearer than this to a multiple of 15 deg, to parallel or to meeting counts as "
    "such in a URDF file, in radians and metres by metre; 0 takes every angle at its word.",
)
@options.file_option("standard output")
@options.templates_option
@options.force_option
def convert(
    table: str,
    wanted: str | None,
    chain: tuple[str, str] | None,
    tolerance: float,
    output: str | None,
    force: bool,
) -> None:
    """Write a table in another convention or format, or from URDF.

    The pose is the same for every q: base and tool take what the rows of the other convention
    have no place for. TABLE is a table or a URDF file, or - for standard input.
    """
    from symdh.table.source import read_source

    source = read_source(table)
    remarks: list[str] = []
    if _is_urdf(source):
        robot, remarks = _robot_of_urdf(source, wanted, chain or None, tolerance)
    elif chain:
        raise click.UsageError("--chain needs a URDF file.")
    elif wanted is None:
        raise click.UsageError("Say --to what the table is to be converted.")
    else:
        robot = _robot_of_table(source, wanted)
    text, notes = _written(robot, wanted or "standard", remarks)
    for note in notes:
        console.note(f"note: {note}")
    files.save(output or "-", text.encode(), force=force)


def _is_urdf(source: Source) -> bool:
    """Tell URDF from a table by its first character: only in Markdown a table may have it too."""
    name = source.filename.lower()
    if name.endswith((".md", ".markdown")):
        return False
    return source.text.lstrip().startswith("<") or name.endswith(".urdf")


def _robot_of_table(source: Source, wanted: str) -> Robot:
    from symdh.frames.conversion import convert as converted
    from symdh.robot import Convention
    from symdh.table.reader import read_table

    loaded = read_table(source)
    console.show_diagnostics(loaded.warnings)
    if wanted not in _CONVENTIONS:
        return loaded.robot
    return converted(loaded.robot, Convention(wanted))


def _robot_of_urdf(
    source: Source, wanted: str | None, ends: tuple[str, str] | None, tolerance: float
) -> tuple[Robot, list[str]]:
    """Assign frames to a chain; print what was taken for something else, and what it costs."""
    from sympy import Rational

    from symdh.frames.residual import residual
    from symdh.frames.urdf_chain import table_of_chain
    from symdh.robot import Convention
    from symdh.table.urdf import read_urdf_chain

    near = Rational(repr(tolerance))
    chain = read_urdf_chain(source, ends, near)
    console.show_diagnostics(chain.warnings)
    convention = Convention(wanted) if wanted in _CONVENTIONS else Convention.STANDARD
    if len(chain.joints) > _LONG:
        console.note(f"assigning frames to {console.plural(len(chain.joints), 'joint')} ...")
    found = table_of_chain(chain, convention, near)
    for line in _taken(chain, found):
        console.note(f"note: {line}")
    left = residual(chain, found.robot)
    shown = f"{left.position:.1e} m, {left.rotation:.1e} rad"
    console.note(f"residual, the largest of {left.poses} poses: {shown}")
    named = ", ".join(
        f"{variable} is {name}"
        for variable, name in zip(found.robot.variables, found.joint_names, strict=True)
    )
    return found.robot, [f"from {chain.start} to {chain.end} of a URDF file: {named}"]


def _taken(chain: UrdfChain, found: ImportedChain) -> list[str]:
    """Say which decimals and which axes were taken for something that they are only near to."""
    lines = []
    if chain.snaps:
        read = (
            f"{snap.written} as {snap.value}" + (f" ({snap.count} times)" if snap.count > 1 else "")
            for snap in chain.snaps
        )
        largest = max(snap.change for snap in chain.snaps)
        lines.append(f"read {', '.join(read)}; off by {largest:.1e} at most")
    for snap in found.snaps:
        off = f"{snap.miss:.1e} {snap.unit('m')}".rstrip()
        lines.append(f"{snap.taken_as} within the tolerance, off by {off}")
    return lines


def _written(robot: Robot, wanted: str, remarks: list[str]) -> tuple[str, tuple[str, ...]]:
    from symdh.render.interchange import export
    from symdh.render.table_yaml import table_yaml

    if wanted in (*_CONVENTIONS, "yaml"):
        return table_yaml(robot, remarks), ()
    exported = export(robot, wanted)
    return exported.text, exported.notes
