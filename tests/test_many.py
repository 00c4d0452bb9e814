"""Many tables in one `derive`, and the processes that do the work."""

from __future__ import annotations

import os
import pty
import select
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import SYMDH, Runner

from symdh.cli import workers
from symdh.cli.main import run
from symdh.errors import LimitError

ARM = """\
name: {name}
convention: standard
joints:
  - {{theta: theta1, d: 0, a: a1, alpha: 0}}
"""
BAD = "convention: standard\njoints:\n  - {theta: q1, d: 0, a: 1 furlong, alpha: q2 +}\n"
ENDINGS = (".tex", ".html", ".py", ".h", ".c")


def arms(folder: Path, *names: str) -> list[str]:
    for name in names:
        (folder / f"{name}.yaml").write_text(ARM.format(name=name))
    return [f"{name}.yaml" for name in names]


def files_in(folder: Path) -> dict[str, bytes]:
    return {
        str(each.relative_to(folder)): each.read_bytes()
        for each in sorted(folder.rglob("*"))
        if each.is_file()
    }


def children_of(process: int) -> list[int]:
    path = Path(f"/proc/{process}/task/{process}/children")
    return [int(number) for number in path.read_text().split()] if path.exists() else []


def wait_until_gone(processes: list[int]) -> bool:
    """Wait for processes that are not ours to end; zombies are dead too."""
    for _ in range(600):
        left = [p for p in processes if (Path("/proc") / str(p)).exists() and not is_zombie(p)]
        if not left:
            return True
        time.sleep(0.1)
    return False


def is_zombie(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


# What a user sees


def test_each_table_gets_a_folder_whatever_the_number_of_processes(
    tmp_path: Path, run_symdh: Runner
) -> None:
    tables = arms(tmp_path, "c", "a", "b")
    ran = run_symdh("derive", *tables, "-o", "two", "-j", "2")
    assert (ran.returncode, ran.stderr) == (0, "3 tables: 3 derived\n")
    lines = ran.stdout.splitlines()
    assert [line.split()[:4] for line in lines] == [
        ["wrote", f"two/{name}/", "5", "files"] for name in ("c", "a", "b")
    ]
    one = run_symdh("derive", *tables, "-o", "one", "-j", "1")
    assert one.stdout == ran.stdout.replace("two/", "one/")
    assert files_in(tmp_path / "one") == files_in(tmp_path / "two")
    assert set(files_in(tmp_path / "one")) == {f"{n}/{n}{e}" for n in "abc" for e in ENDINGS}
    alone = run_symdh("derive", "b.yaml", "-o", "alone")
    assert alone.returncode == 0
    assert "⁰T₁" in alone.stdout
    assert files_in(tmp_path / "alone") == files_in(tmp_path / "one" / "b")
    again = run_symdh("derive", *tables, "-o", "two", "-j", "auto")
    assert [line.split()[0] for line in again.stdout.splitlines()] == ["kept"] * 3


def test_a_bad_table_stops_no_other(tmp_path: Path, run_symdh: Runner) -> None:
    good = arms(tmp_path, "first", "last")
    (tmp_path / "bad.yaml").write_text(BAD)
    (tmp_path / "warned.yaml").write_text(
        ARM.format(name="warned").replace("convention: standard\n", "")
    )
    tables = (good[0], "bad.yaml", "warned.yaml", "missing.yaml", good[1])
    ran = run_symdh("derive", *tables, "-j", "2")
    assert ran.returncode == 3  # the highest: a missing file is 3, a wrong one 2
    assert [line.split()[1] for line in ran.stdout.splitlines()] == ["first/", "warned/", "last/"]
    said = ran.stderr.splitlines()
    places = [line.split(": ")[0] for line in said if line.startswith(("bad", "warned", "error"))]
    assert places == ["bad.yaml:3:28", "bad.yaml:3:48", "warned.yaml:1:1", "error"]
    assert said[-3:] == [
        "5 tables: 3 derived, 2 failed",
        "  bad.yaml: 2 errors",
        "  missing.yaml: no such file",
    ]
    assert {each.name for each in tmp_path.iterdir() if each.is_dir()} == {
        "first",
        "warned",
        "last",
    }


def test_only_bad_tables(tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "bad.yaml").write_text(BAD)
    ran = run_symdh("derive", "bad.yaml", "bad.yaml")
    assert (ran.returncode, ran.stdout) == (2, "")
    assert "2 tables: 0 derived, 2 failed" in ran.stderr


@pytest.mark.parametrize("name", ["arm", "ARM", "a r m"])
def test_two_tables_of_one_name_are_refused_before_anything_is_written(
    name: str, tmp_path: Path, run_symdh: Runner
) -> None:
    tables = arms(tmp_path, "a_r_m" if " " in name else "arm", "other")
    (tmp_path / "twin.yaml").write_text(ARM.format(name=name))
    before = files_in(tmp_path)
    ran = run_symdh("derive", *tables, "twin.yaml", "-o", "out")
    assert (ran.returncode, ran.stdout) == (2, "")
    assert f"{tables[0]} and twin.yaml would" in ran.stderr
    assert files_in(tmp_path) == before


def test_a_file_of_someone_else_fails_its_table_alone(tmp_path: Path, run_symdh: Runner) -> None:
    tables = arms(tmp_path, "a", "b")
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "a.c").write_text("int mine;\n")
    ran = run_symdh("derive", *tables, "-j", "2")
    assert ran.returncode == 3
    assert "error: a.yaml: refuses to replace a/a.c" in ran.stderr
    assert set(files_in(tmp_path / "a")) == {"a.c"}
    assert set(files_in(tmp_path / "b")) == {f"b{ending}" for ending in ENDINGS}


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("-o", "-"), "-o - takes one table"),
        (("-j", "two"), "'two' is not a number"),
        (("-j", "-1"), "'-1' is not a number"),
    ],
)
def test_wrong_usage(
    options: tuple[str, ...], says: str, tmp_path: Path, run_symdh: Runner
) -> None:
    ran = run_symdh("derive", *arms(tmp_path, "a", "b"), *options)
    assert (ran.returncode, ran.stdout) == (2, "")
    assert says in ran.stderr


def test_standard_input_may_be_one_of_the_tables(tmp_path: Path, run_symdh: Runner) -> None:
    arms(tmp_path, "a")
    ran = run_symdh("derive", "a.yaml", "-", "-j", "2", input="theta_i,d_i,a_i,alpha_i\nq1,0,L,0\n")
    assert ran.returncode == 0
    assert set(files_in(tmp_path / "robot")) == {f"robot{ending}" for ending in ENDINGS}


def test_a_person_sees_a_progress_bar(tmp_path: Path) -> None:
    master, slave = pty.openpty()
    process = subprocess.Popen(
        [SYMDH, "derive", *arms(tmp_path, "a", "b"), "-j", "1"],
        cwd=tmp_path,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=slave,
        env={**os.environ, "TERM": "xterm"},
    )
    os.close(slave)
    shown = b""
    while select.select([master], [], [], 60)[0]:
        try:
            piece = os.read(master, 4096)
        except OSError:  # the other end is closed
            break
        if not piece:
            break
        shown += piece
    out, _ = process.communicate(timeout=60)
    os.close(master)
    assert process.returncode == 0
    assert b"deriving" in shown
    assert b"2/2" in shown
    assert shown.rstrip().endswith(b"2 tables: 2 derived")
    assert out.count(b"wrote") == 2


# Stopping


def started(folder: Path) -> subprocess.Popen[bytes]:
    """Start a run over many tables that has written one of them, and is at work on others."""
    process = subprocess.Popen(
        [SYMDH, "derive", *arms(folder, *(f"arm{k}" for k in range(40))), "-o", "out", "-j", "2"],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline().startswith(b"wrote out/arm0/")
    return process


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_all_quietly_and_leaves_whole_files(
    number: int, status: int, tmp_path: Path
) -> None:
    process = started(tmp_path)
    helpers = children_of(process.pid)
    # As a terminal does it: to all processes of the group.
    (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
    _, said = process.communicate(timeout=60)
    assert (process.returncode, said) == (status, b"")
    assert wait_until_gone(helpers)
    folders = list((tmp_path / "out").iterdir())
    assert 1 <= len(folders) < 40
    for folder in folders:
        assert set(files_in(folder)) == {f"{folder.name}{ending}" for ending in ENDINGS}


def test_processes_do_not_outlive_a_killed_run(tmp_path: Path) -> None:
    process = started(tmp_path)
    helpers = children_of(process.pid)
    assert len(helpers) >= 2
    process.kill()
    process.communicate(timeout=60)
    assert wait_until_gone(helpers)


# The processes


def number_of_process(job: object) -> int:
    return os.getpid()


def doubled(job: int) -> int:
    if job == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return 2 * job


def test_two_processes_do_the_work() -> None:
    found = dict(workers.results_of(number_of_process, range(4), 2))
    assert set(found) == {0, 1, 2, 3}
    assert len(set(found.values())) == 2
    assert os.getpid() not in found.values()


def test_one_process_is_this_one() -> None:
    assert dict(workers.results_of(number_of_process, [1, 2], 1)) == {
        0: os.getpid(),
        1: os.getpid(),
    }


def test_a_job_that_is_killed_is_lost_and_no_other() -> None:
    found = dict(workers.results_of(doubled, range(8), 2))
    assert found.pop(3) == workers.Lost(-signal.SIGKILL)
    assert found == {job: 2 * job for job in (0, 1, 2, 4, 5, 6, 7)}


def test_a_table_whose_process_is_killed_fails_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The kernel ends a process when memory runs out; the user is told which table it was."""
    tables = arms(tmp_path, "a", "b")
    monkeypatch.chdir(tmp_path)
    in_order = workers.results_of

    def second_is_killed(work: object, jobs: list[object], processes: int) -> Iterator[object]:
        yield from in_order(work, jobs[:1], 1)
        yield 1, workers.Lost(-9)

    monkeypatch.setattr(workers, "results_of", second_is_killed)
    assert run(["derive", *tables, "-o", "out"]) == LimitError.exit_status
    said = capsys.readouterr().err
    assert "b.yaml: its process was ended (status -9), for want of memory perhaps" in said
    assert "2 tables: 1 derived, 1 failed" in said
    assert (tmp_path / "out" / "a" / "a.py").is_file()
    assert not (tmp_path / "out" / "b").exists()
