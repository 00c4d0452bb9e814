"""Fuzz what reads text from strangers: `python tests/fuzz.py TARGET [--seconds 60]`.

Wants atheris (`pip install .[fuzz]`). Any input may be refused with a `SymdhError`; anything else
that is raised, more than a second of CPU or 300 MiB above what an empty run takes is a finding:
the input is kept in the working folder and the exit status is not 0. Starts from the tables of
tests/data, their bad inputs and what earlier runs kept in tests/fuzz_corpus/TARGET; with
`--keep`, adds there what reached new code.
"""

from __future__ import annotations

import argparse
import base64
import resource
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import atheris
import yaml

with atheris.instrument_imports(include=["symdh"]):
    from symdh.errors import SymdhError
    from symdh.kinematics.answers import judge
    from symdh.notation.short_names import ShortNames
    from symdh.table import loads_table, parse_expression
    from symdh.table.answers import blank_answers, read_answers
    from symdh.table.axes import read_mechanism
    from symdh.table.rotations import parse_rotations, read_rotation_sheet
    from symdh.table.source import decode
    from symdh.table.urdf import read_urdf_chain

from sympy import Rational

from symdh.render.interchange import export

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


def judged(read: Callable[[bytes], None]) -> Callable[[bytes], None]:
    """Let a reader refuse an input, within its time; anything else is a finding."""

    def judge(data: bytes) -> None:
        before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
        with suppress(SymdhError):
            read(data)
        spent = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
        if spent > 1:
            raise TimeoutError(f"{spent:.1f} s of CPU")

    return judge


def main() -> None:
    """Fuzz one reader for a while."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", choices=sorted(TARGETS))
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--keep", action="store_true", help="add to tests/fuzz_corpus")
    options = parser.parse_args()
    read, seeds = TARGETS[options.target]
    kept = KEPT / options.target
    if options.keep:
        kept.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for number, seed in enumerate(seeds()):
            Path(folder, f"seed{number}").write_bytes(seed)
        read_all = judged(read)
        for path in sorted(Path(folder).iterdir()):
            read_all(path.read_bytes())  # what is loaded once is not counted against an input
        used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
        places = [str(kept)] if kept.is_dir() else []
        if not options.keep:
            places.insert(0, tempfile.mkdtemp(dir=folder))
        arguments = [
            sys.argv[0],
            f"-max_total_time={options.seconds}",
            f"-rss_limit_mb={used + 300}",
            "-timeout=10",
            "-max_len=4096",
            "-print_final_stats=1",
            *places,
            folder,
        ]
        atheris.Setup(arguments, read_all)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
