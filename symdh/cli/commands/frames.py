"""``symdh frames``: from the joint axes of a mechanism to its table, frame by frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from symdh.cli import console, files, options

if TYPE_CHECKING:
    from symdh.frames import Assignment


@click.command(
    epilog=options.examples(
        "symdh frames scara_axes.yaml -o scara.yaml",
        "symdh frames scara_axes.yaml -o - | symdh derive -",
        "symdh frames scara_axes.yaml --convention modified --format latex",
        "symdh frames scara_axes.yaml --format html > scara.html",
    )
)
@click.argument("axes", type=click.Path(allow_dash=True, readable=False))
@click.option(
    "--convention",
    type=click.Choice(["standard", "modified"]),
    help="Rules to follow. Default: what the file says, else standard.",
)
@options.format_option(
    "text",
    "latex",
    "html",
    "json",
    what="How the story of the frames is printed: Unicode to read, a LaTeX document, a web page, "
    "or JSON for a program.",
)
@click.option(
    "-o",
    "--output",
    "output",
    metavar="FILE",
    help="Write the table; - prints the table and nothing else. Default: no table is written.",
)
@options.templates_option
@options.force_option
def frames(axes: str, convention: str | None, form: str, output: str | None, force: bool) -> None:
    """Assign frames to joint axes and give the table.

    AXES is a YAML file with a point and a direction for each joint in the home position, or - for
    standard input. Prints every frame with the rule that places it, and the parameters that are
    measured; -o writes the table that follows.
    """
    from symdh.render.table_yaml import table_yaml

    found = _assignment(axes, convention)
    written = table_yaml(found.robot, ["frames assigned to given joint axes"])
    if output == "-":
        console.print_result(written)
        return
    story = _story(found, form)
    if output is not None:
        files.save(output, written.encode(), force=force)
    console.print_result(story)


def _assignment(axes: str, convention: str | None) -> Assignment:
    """Read the axes and assign frames; what the rules refuse is reported at its place."""
    from symdh.frames import AssignmentError, assign_frames
    from symdh.robot import Convention
    from symdh.table.axes import located, read_mechanism
    from symdh.table.source import read_source

    loaded = read_mechanism(read_source(axes))
    console.show_diagnostics(loaded.warnings)
    try:
        found = assign_frames(loaded.mechanism, Convention(convention) if convention else None)
    except AssignmentError as problem:
        raise located(loaded, [(f.subject, f.message) for f in problem.faults]) from None
    for snap in found.snaps:
        length = found.robot.units.length
        unit = snap.unit(length.value if length else "")
        message = f"{snap.taken_as} within the tolerance, off by {snap.miss:.2g} {unit}".rstrip()
        console.show_diagnostics([loaded.warning(snap.subject, message)])
    return found


def _story(found: Assignment, form: str) -> str:
    if form == "json":
        from symdh.render.frames_json import frames_json

        return frames_json(found)
    from symdh.derivation.frames import frames_document

    document = frames_document(found)
    if form == "latex":
        from symdh.render.latex import render_latex

        return render_latex(document)
    if form == "html":
        from symdh.render.page.page import render_page

        return render_page(document, found.robot)
    from symdh.render.terminal import render_chapters

    return render_chapters(document.chapters, width=console.width())
