"""What the tests share: the folders of the project, and running symdh as a user does."""

from __future__ import annotations

import os
import subprocess
import sysconfig
from collections.abc import Callable
from pathlib import Path

import pytest

SYMDH = Path(sysconfig.get_path("scripts")) / "symdh"
Runner = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def update_golden() -> bool:
    """Whether `make golden` asks to write the golden files instead of comparing with them."""
    return os.environ.get("SYMDH_UPDATE_GOLDEN") == "1"


@pytest.fixture
def run_symdh(tmp_path: Path) -> Runner:
    """Run `symdh ARGUMENTS` as a process of its own, in the test's empty folder by default."""

    def run(
        *arguments: str | Path,
        cwd: Path = tmp_path,
        env: dict[str, str] | None = None,
        input: str | None = None,
        preexec_fn: Callable[[], None] | None = None,
    ) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [SYMDH, *map(str, arguments)],
            cwd=cwd,
            env={**os.environ, **(env or {})},
            input=input,
            stdin=subprocess.DEVNULL if input is None else None,
            capture_output=True,
            encoding="utf-8",
            timeout=60,
            preexec_fn=preexec_fn,
            check=False,
        )

    return run
