"""What fuzzing found worth keeping is read or refused, quietly; no run of the fuzzer is needed."""

from __future__ import annotations

import hashlib
from contextlib import suppress

import pytest
from readers import KEPT, TARGETS

from symdh.errors import SymdhError


@pytest.mark.parametrize("target", sorted(TARGETS))
def test_what_was_kept_is_read_or_refused(target: str) -> None:
    read, _ = TARGETS[target]
    inputs = sorted((KEPT / target).iterdir())
    assert inputs
    for path in inputs:
        data = path.read_bytes()
        assert path.name == hashlib.sha1(data).hexdigest()
        with suppress(SymdhError):
            read(data)


def test_the_corpora_are_small() -> None:
    assert sum(path.stat().st_size for path in KEPT.rglob("*") if path.is_file()) < 500_000
