"""Fuzz what reads text from strangers: `python tests/fuzz.py TARGET [--seconds 60]`.

Wants atheris, which `make` installs on Linux. Any input may be refused with a `SymdhError`;
anything else that is raised, more than a second of CPU or 300 MiB above what an empty run takes is
a finding: the input is kept in the working folder and the exit status is not 0. Starts from the
tables of tests/data, their bad inputs and what earlier runs kept in tests/fuzz_corpus/TARGET.
`--keep FOLDER` collects what reached new code, for `tests/keep_corpus.py` to choose from.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["symdh"]):
    from readers import KEPT, TARGETS

    from symdh.errors import SymdhError


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
    parser.add_argument("--seed", type=int, default=0, help="of what is tried; 0: any")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="collect what is found there")
    options = parser.parse_args()
    read, seeds = TARGETS[options.target]
    kept = KEPT / options.target
    with tempfile.TemporaryDirectory() as folder:
        for number, seed in enumerate(seeds()):
            Path(folder, f"seed{number}").write_bytes(seed)
        if kept.is_dir():
            shutil.copytree(kept, folder, dirs_exist_ok=True)
        read_all = judged(read)
        for path in sorted(Path(folder).iterdir()):
            read_all(path.read_bytes())  # what is loaded once is not counted against an input
        used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
        # libFuzzer adds to the first folder.
        found = options.keep or Path(tempfile.mkdtemp(dir=folder))
        found.mkdir(parents=True, exist_ok=True)
        arguments = [
            sys.argv[0],
            f"-max_total_time={options.seconds}",
            f"-rss_limit_mb={used + 300}",
            "-timeout=10",
            "-max_len=4096",
            f"-seed={options.seed}",
            "-print_final_stats=1",
            str(found),
            folder,
        ]
        atheris.Setup(arguments, read_all)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
