"""What reads text from strangers, each with good and bad inputs to begin with: for fuzzing."""

from __future__ import annotations

import base64
from collections.abc import Callable, Iterator
from pathlib import Path

import yaml
from sympy import Rational

from symdh.kinematics.answers import judge
from symdh.notation.short_names import ShortNames
from symdh.render.interchange import export
from symdh.table import loads_table, parse_expression
from symdh.table.answers import blank_answers, read_answers
from symdh.table.axes import read_mechanism
from symdh.table.rotations import parse_rotations, read_rotation_sheet
from symdh.table.source import decode
from symdh.table.urdf import read_urdf_chain

DATA = Path(__file__).with_name("data")
KEPT = Path(__file__).with_name("fuzz_corpus")
EXAMPLES = Path(__file__).parent.parent / "examples"
EXAMINED = loads_table((EXAMPLES / "planar_2r.yaml").read_bytes()).robot


def read_expression(data: bytes) -> None:
    parse_expression(data.decode(errors="replace"))


def read_table(data: bytes) -> None:
    loads_table(data, "arm.yaml")


def read_csv(data: bytes) -> None:
    loads_table(data, "arm.csv")


def read_markdown(data: bytes) -> None:
    loads_table(data, "arm.md")


def read_and_judge_answers(data: bytes) -> None:
    sheet = read_answers(decode(data, "answers.yaml"), EXAMINED, ShortNames(EXAMINED))
    judge(EXAMINED, sheet)


def read_axes(data: bytes) -> None:
    read_mechanism(decode(data, "axes.yaml"))


def read_urdf(data: bytes) -> None:
    read_urdf_chain(decode(data, "arm.urdf"), None, Rational(1, 10**6))


def read_rotations(data: bytes) -> None:
    read_rotation_sheet(decode(data, "turns.yaml"))
    parse_rotations(data.decode(errors="replace"))


def tables() -> Iterator[bytes]:
    """Give good and bad tables."""
    for path in sorted((DATA / "tables").glob("*.yaml")):
        yield path.read_bytes()
    for case in yaml.safe_load((DATA / "bad_inputs.yaml").read_text()):
        if "input" in case:
            yield str(case["input"]).encode()
        if "input_base64" in case:
            yield base64.b64decode(case["input_base64"])


def tables_as(form: str) -> Iterator[bytes]:
    """Give the good tables in another form."""
    for path in sorted((DATA / "tables").glob("*.yaml")):
        yield export(loads_table(path.read_bytes()).robot, form).text.encode()


def files(folder: Path, pattern: str) -> Iterator[bytes]:
    for path in sorted(folder.glob(pattern)):
        yield path.read_bytes()


def expressions() -> Iterator[bytes]:
    yield from (
        b"a1*cos(theta1 + 90 deg)/2",
        b"-3.5 mm",
        b"2*pi/3 rad",
        b"sqrt(a^2 + b**2)",
        b"1e3",
    )


def answers() -> Iterator[bytes]:
    yield blank_answers(EXAMINED).encode()
    yield from files(EXAMPLES / "answers", "*.yaml")


#: What reads, and what to begin with.
TARGETS: dict[str, tuple[Callable[[bytes], None], Callable[[], Iterator[bytes]]]] = {
    "expression": (read_expression, expressions),
    "table": (read_table, tables),
    "csv": (read_csv, lambda: tables_as("csv")),
    "markdown": (read_markdown, lambda: tables_as("markdown")),
    "answers": (read_and_judge_answers, answers),
    "axes": (read_axes, lambda: files(EXAMPLES / "mechanisms", "*.yaml")),
    "urdf": (read_urdf, lambda: files(DATA / "urdf", "*.urdf")),
    "rotations": (read_rotations, lambda: files(EXAMPLES / "rotations", "*.yaml")),
}
