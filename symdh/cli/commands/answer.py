"""``symdh answer``: a student's answers checked."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from symdh.cli import console, failures, files, options, patience, tables
from symdh.errors import OutputError, SymdhError

if TYPE_CHECKING:
    from symdh.kinematics.answers import JudgedSheet
    from symdh.robot import Robot

#: Exit status when something could be read and is not right.
_WRONG = 1


_FORMAT = """\b
What an answer file may hold:
  A1: [[c1, -s1, 0, a1*c1], [s1, c1, 0, a1*s1], [0, 0, 1, 0], [0, 0, 0, 1]]
  0T2: ...                  a pose; also T02 or T(0, 2), 3 or 4 rows
  T02[1,4]: a1*c1 + a2*c12  one entry; px, r11, T02.px are names of entries too
  p: [..., ..., ...]        origin of the whole chain; R its rotation, J the Jacobian
  rows: [{theta: theta1, d: 0, a: a1, alpha: 0}, ...]
  numbers:                  rounded numbers, for the table's values or those under at
    at: {theta1: 60 deg}
    px: 0.146
"""


@click.command(
    epilog=f"{_FORMAT}\n"
    + options.examples(
        "symdh answer arm.yaml --blank -o anna.yaml",
        "symdh answer arm.yaml anna.yaml",
        "symdh answer arm.yaml handed_in/*.yaml --format csv > grades.csv",
    )
)
@options.table_argument
@click.argument("answers", nargs=-1, type=click.Path(allow_dash=True, readable=False))
@click.option("--blank", is_flag=True, help="Write an answer file to fill in; check nothing.")
@options.format_option(
    "text", "json", "csv", what="How verdicts are printed; csv is a grade book, one line a file."
)
@click.option("--solution", is_flag=True, help="Print the right answer beside each wrong one.")
@click.option("--details", is_flag=True, help="Print every verdict also for several files.")
@options.file_option("standard output; for --blank only")
@options.force_option
def answer(
    table: str,
    answers: tuple[str, ...],
    blank: bool,
    form: str,
    solution: bool,
    details: bool,
    output: str | None,
    force: bool,
) -> None:
    """Check a student's answers to a table, entry by entry.

    An answer counts as right when it is equal to the right one, whatever its form. Of a wrong one
    it is said where the usual slips lead to it: a sign, sine for cosine, the other convention,
    alpha for theta, a forgotten offset, degrees for radians, a row too far.

    TABLE is the table; ANSWERS are YAML files as below, or - for standard input.

    Several files give a line each. Exit status: 0 all right, 1 something is wrong or blank, 2 a
    file cannot be read as answers.
    """
    if blank:
        _write_blank(table, answers, output, force)
        return
    if not answers:
        raise click.UsageError("Missing argument 'ANSWERS...'; --blank writes a file to fill in.")
    if output is not None:
        raise click.UsageError("-o goes with --blank; verdicts go to standard output.")
    robot = tables.read_robot(table)
    sheets: list[JudgedSheet] = []
    failed: list[SymdhError] = []
    with patience.telling(f"checking {console.plural(len(answers), 'file')}"):
        for path in answers:
            try:
                sheets.append(_judged(robot, path))
            except Exception as error:
                failed.append(failures.as_symdh_error(error))
                failures.show(failed[-1])
    if sheets or form == "json":
        console.print_result(_report(robot, sheets, form, solution, details or len(answers) == 1))
    if failed:
        if len(answers) > 1:
            console.note(f"{len(failed)} of {len(answers)} files could not be checked")
        raise click.exceptions.Exit(max(error.exit_status for error in failed))
    if any(sheet.right < sheet.total for sheet in sheets):
        raise click.exceptions.Exit(_WRONG)


def _judged(robot: Robot, path: str) -> JudgedSheet:
    from symdh.kinematics.answers import judge
    from symdh.notation.short_names import ShortNames
    from symdh.table.answers import read_answers
    from symdh.table.source import read_source

    return judge(robot, read_answers(read_source(path), robot, ShortNames(robot)))


def _report(
    robot: Robot, sheets: list[JudgedSheet], form: str, solution: bool, details: bool
) -> str:
    from symdh.render.answers_json import answers_json
    from symdh.render.answers_text import sheet_text, sheets_csv, summary_text

    if form == "json":
        return answers_json(robot, sheets, solution)
    if form == "csv":
        return sheets_csv(sheets)
    if details:
        return "\n\n".join(sheet_text(robot, sheet, solution) for sheet in sheets)
    return summary_text(sheets)


def _write_blank(table: str, answers: tuple[str, ...], output: str | None, force: bool) -> None:
    from symdh.table.answers import blank_answers

    if answers:
        raise click.UsageError("--blank takes a table alone.")
    text = blank_answers(tables.read_robot(table))
    if output in (None, "-"):
        console.print_result(text)
        return
    assert output is not None
    if Path(output).exists() and not force:
        raise OutputError(f"{output} is there already; --force replaces it")
    # An answer file is the student's own from now on, so it carries no mark that symdh made it.
    files.save(output, text.encode(), force=True)
