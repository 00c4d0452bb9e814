"""Keep of what a fuzzing run found the least that reaches as much: `keep_corpus.py TARGET FOLDER`.

Writes into tests/fuzz_corpus/TARGET those inputs of the folder, the shortest first, that take a
step from one line to the next in symdh's readers that neither the seeds nor those already kept
take. The name of a file is the SHA-1 of what it holds, as libFuzzer names them.
"""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import FrameType
from typing import Any

from readers import KEPT, TARGETS

from symdh.errors import SymdhError

Step = tuple[str, int, int]
LONGEST = 512


def steps(read: Callable[[bytes], None], data: bytes) -> set[Step]:
    """Return the steps between lines of the readers that an input takes."""
    taken: set[Step] = set()
    last: dict[FrameType, int] = {}

    def trace(frame: FrameType, event: str, argument: Any) -> Any:
        name = frame.f_code.co_filename
        if "/symdh/" not in name:
            return None
        if event == "line":
            taken.add((name, last.get(frame, 0), frame.f_lineno))
            last[frame] = frame.f_lineno
        return trace

    sys.settrace(trace)
    try:
        with suppress(SymdhError):
            read(data)
    finally:
        sys.settrace(None)
    return taken


def main(target: str, folder: str) -> None:
    """Keep what adds to the seeds."""
    read, seeds = TARGETS[target]
    kept = KEPT / target
    kept.mkdir(parents=True, exist_ok=True)
    known: set[Step] = set()
    for seed in [*seeds(), *(path.read_bytes() for path in sorted(kept.iterdir()))]:
        known |= steps(read, seed)
    found = {path.read_bytes() for path in Path(folder).iterdir()}
    added = 0
    for data in sorted(found, key=lambda each: (len(each), each)):
        new = steps(read, data) - known if len(data) <= LONGEST else set()
        if new:
            known |= new
            added += 1
            (kept / hashlib.sha1(data).hexdigest()).write_bytes(data)
    print(f"{target}: {added} kept of {len(found)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
