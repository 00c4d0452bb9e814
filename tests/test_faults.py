"""Whatever fails, and whenever symdh is stopped: whole files, a clean message, no litter for long.

`SYMDH_FAULT_STEP=1` strikes at every call that changes the disk; by default at some of them.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from conftest import SYMDH, Runner

from tools import require_tool

FAULTS = Path(__file__).with_name("faults.py")
STEP = os.environ.get("SYMDH_FAULT_STEP", "7")
OLD = """\
convention: standard
name: arm
joints:
  - {theta: theta1, d: d1, a: a1, alpha: 90 deg}
  - {theta: theta2, d: 0, a: a2, alpha: 0}
"""
NEW = OLD.replace("a: a2", "a: a3")

Point = dict[str, Any]


@cache
def strikes(kind: str) -> tuple[Point, ...]:
    with TemporaryDirectory() as folder:
        Path(folder, "old.yaml").write_text(OLD)
        Path(folder, "new.yaml").write_text(NEW)
        printed = subprocess.run(
            [sys.executable, FAULTS, kind, "old.yaml", "new.yaml", STEP],
            cwd=folder,
            capture_output=True,
            text=True,
            check=True,
        ).stdout
    return tuple(json.loads(line) for line in printed.splitlines())


@pytest.mark.parametrize("kind", ["fail", "SIGINT", "SIGTERM", "SIGKILL"])
def test_files_are_whole_and_the_next_run_clears_up(kind: str) -> None:
    struck = strikes(kind)
    assert len(struck) >= (28 if kind == "fail" else 60) // int(STEP)
    for point in struck:
        assert point["whole"], point
        assert point["next"], point
        assert point["litter after the next run"] == [], point


def test_a_call_that_fails_is_reported_and_changes_nothing() -> None:
    for point in strikes("fail"):
        if point["status"] == 0:  # where another way led to the goal, or only clearing up failed
            assert (point["files"], point["said"]) == ("new", ""), point
        else:
            assert (point["status"], point["files"]) == (3, "old"), point
            assert point["said"].startswith("error: cannot write out"), point
            assert point["said"].count("\n") == 1, point
            assert point["litter"] == [], point


@pytest.mark.parametrize("kind", ["SIGINT", "SIGTERM"])
def test_a_signal_leaves_one_set_and_no_litter(kind: str) -> None:
    for point in strikes(kind):
        assert point["status"] == 128 + getattr(signal, kind), point
        assert point["files"] in ("old", "new"), point
        assert (point["said"], point["litter"]) == ("", []), point


def test_a_killed_run_was_killed() -> None:
    assert {point["status"] for point in strikes("SIGKILL")} == {128 + signal.SIGKILL}


def test_a_full_disk_keeps_the_earlier_files(tmp_path: Path, run_symdh: Runner) -> None:
    """A disk of one mebibyte: the first set fits, two sets at once do not."""
    if os.geteuid() != 0:
        pytest.skip("only root may mount a disk")
    mount = require_tool("mount")
    disk = tmp_path / "disk"
    disk.mkdir()
    (tmp_path / "old.yaml").write_text(OLD)
    (tmp_path / "new.yaml").write_text(NEW)
    made = subprocess.run([mount, "-t", "tmpfs", "-o", "size=900k", "tmpfs", disk], check=False)
    if made.returncode != 0:
        pytest.skip("this machine lets nobody mount a disk")
    try:
        assert run_symdh("derive", "old.yaml", "-o", disk).returncode == 0
        before = {each.name: each.read_bytes() for each in disk.iterdir()}
        ran = run_symdh("derive", "new.yaml", "-o", disk)
        assert ran.returncode == 3
        assert "no space left" in ran.stderr
        assert {each.name: each.read_bytes() for each in disk.iterdir()} == before
    finally:
        subprocess.run(["umount", disk], check=True)


def test_eight_processes_into_one_folder_leave_the_set_of_one_run(
    tmp_path: Path, run_symdh: Runner
) -> None:
    sets = []
    for number in range(8):
        table = OLD.replace("a: a2", f"a: b{number}")
        (tmp_path / f"{number}.yaml").write_text(table)
        assert run_symdh("derive", f"{number}.yaml", "-o", f"alone{number}").returncode == 0
        sets.append({p.name: p.read_bytes() for p in (tmp_path / f"alone{number}").iterdir()})
    for _ in range(2):
        running = [
            subprocess.Popen(
                [SYMDH, "derive", f"{number}.yaml", "-o", "out"],
                cwd=tmp_path,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
            )
            for number in range(8)
        ]
        ends = [(process.communicate()[1], process.returncode) for process in running]
        assert ends == [(b"", 0)] * 8
        assert {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()} in sets
