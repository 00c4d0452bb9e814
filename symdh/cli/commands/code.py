"""``symdh code``: the numeric functions in one language, or in several."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from symdh.cli import arguments, console, files, options, tables
from symdh.cli.output import write_files
from symdh.codegen import TARGETS, GeneratedFile, generate

if TYPE_CHECKING:
    from symdh.robot import Robot

#: Exit status where the code does not give the exact pose.
_WRONG = 1


def _listing() -> str:
    """List the targets for the help text, one a line."""
    width = max(len(target.name) for target in TARGETS)
    lines = (f"  {target.name:{width}}  {target.description}" for target in TARGETS)
    return "\b\nTargets:\n" + "\n".join(lines)


@click.command(
    epilog=_listing()
    + "\n\n"
    + options.examples(
        "symdh code scara.yaml --target c -o src",
        "symdh code scara.yaml --target c --precision float --verify",
        "symdh code scara.yaml --target cpp --target rust",
        "symdh code iiwa.yaml --target c --lock theta3",
        "symdh code scara.yaml --target python-ext && pip install ./scara_ext",
    )
)
@options.table_argument
@click.option(
    "--target",
    "targets",
    type=click.Choice([target.name for target in TARGETS]),
    multiple=True,
    required=True,
    metavar="NAME",
    help="Language, one of the list below; may be given several times.",
)
@click.option(
    "--trig",
    type=click.Choice(["inline", "libm"]),
    help="C: sines and cosines of our own, inlined, or those of <math.h>. Default: inline.",
)
@click.option(
    "--precision",
    type=click.Choice(["double", "float"]),
    help="C: kind of all numbers; with float, names begin with NAME_float. Default: double.",
)
@click.option(
    "--batch",
    is_flag=True,
    default=None,
    help="C: also functions for the poses of many joint values; left out otherwise, so that the "
    "file stays small.",
)
@click.option(
    "--lock",
    "locks",
    metavar="JOINT",
    multiple=True,
    help="A joint that the inverse kinematics holds at what the seed says, for arms with more "
    "joints than a pose needs. Repeatable.",
)
@options.no_ik_option
@click.option(
    "--verify",
    is_flag=True,
    help="Also compile or run what was written, on 100 random poses, and print the largest error "
    "against the exact result at 50 digits, of the inverse kinematics too.",
)
@options.folder_option("the current one; for python-ext one of its own, NAME_ext")
@options.templates_option
@options.force_option
def code(
    table: str,
    targets: tuple[str, ...],
    trig: str | None,
    precision: str | None,
    batch: bool | None,
    locks: tuple[str, ...],
    no_ik: bool,
    verify: bool,
    folder: str | None,
    force: bool,
) -> None:
    """Write numeric functions in one language or several.

    The functions are of the whole chain, base to tool, and drop into another project.
    """
    if locks and no_ik:
        raise click.UsageError("--lock is for the inverse kinematics, which --no-ik leaves out")
    wanted = {
        "trig": trig,
        "precision": precision,
        "batch": batch,
        "lock": locks or None,
        "ik": False if no_ik else None,
    }
    chosen = {option: value for option, value in wanted.items() if value is not None}
    for option in chosen:
        _refuse_if_of_no_use(option, targets)
    from symdh.codegen.names import file_stem

    robot = tables.read_robot(table)
    if locks:
        chosen["lock"] = tuple(arguments.joint(robot, name) for name in locks)
    folders: dict[Path, dict[str, bytes]] = {}
    written: dict[str, tuple[GeneratedFile, ...]] = {}
    for target in TARGETS:
        if target.name in targets:
            given = {name: value for name, value in chosen.items() if target.takes(name)}
            place = Path(folder or target.folder.format(file_stem(robot.name)))
            generated = folders.setdefault(place, {})
            written[target.name] = generate(robot, target.name, **given)
            for file in written[target.name]:
                generated[file.name] = file.text.encode()
    for place, generated in folders.items():
        console.note(files.listing(write_files(place, generated, force=force)))
    if verify:
        right = [_verify(robot, name, made, chosen) for name, made in written.items()]
        if not all(right):
            raise click.exceptions.Exit(_WRONG)


def _verify(
    robot: Robot,
    target: str,
    generated: tuple[GeneratedFile, ...],
    chosen: Mapping[str, Any],
) -> bool:
    """Run one target's code, print how exact it is, and say whether it is right."""
    from symdh.codegen.verification import verify

    is_single = target == "c" and chosen.get("precision") == "float"
    of_ik = {option: chosen[option] for option in ("lock", "ik") if option in chosen}
    result = verify(robot, target, generated, is_single=is_single, **of_ik)
    console.print_result(
        f"{target}: largest error on {result.poses} poses {result.error:.2f} eps of reach, "
        f"at most {result.tolerance:.0f}: {_verdict(result.error <= result.tolerance)}"
    )
    if result.inverse is not None:
        inverse = result.inverse
        console.print_result(
            f"{target}: ik found the joints of {inverse.found} of {inverse.poses} poses again; "
            f"{inverse.answers} answers, largest error {inverse.error:.1e} of the reach, "
            f"at most {inverse.tolerance:.1e}: {_verdict(inverse.is_right)}"
        )
    return result.is_right


def _verdict(is_right: bool) -> str:
    return "right" if is_right else "WRONG"


def _refuse_if_of_no_use(option: str, targets: tuple[str, ...]) -> None:
    able = [target.name for target in TARGETS if target.takes(option)]
    if not set(able) & set(targets):
        spelt = "no-ik" if option == "ik" else option
        raise click.UsageError(f"--{spelt} is for --target {' or '.join(able)}")
