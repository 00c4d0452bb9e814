"""The same table gives the same bytes, whatever the hash seed, locale, time zone and folder."""

from __future__ import annotations

from pathlib import Path

import pytest
from conftest import Runner

ROOT = Path(__file__).parent.parent
PLACES = (
    {"PYTHONHASHSEED": "0"},
    {"PYTHONHASHSEED": "1", "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    {"PYTHONHASHSEED": "2", "TZ": "Pacific/Kiritimati"},
    {"PYTHONHASHSEED": "3", "LC_ALL": "C.UTF-8", "TZ": "America/St_Johns"},
)


@pytest.mark.parametrize("example", ["scara", "rrp_modified", "puma560"])
def test_output_depends_on_the_table_alone(example: str, tmp_path: Path, run_symdh: Runner) -> None:
    table = ROOT / "examples" / f"{example}.yaml"
    given = []
    for number, env in enumerate(PLACES):
        folder = tmp_path / f"place {number}"
        folder.mkdir()
        printed = []
        for command in (
            ("derive", table, "-o", "."),
            ("show", table, "--format", "json"),
        ):
            ran = run_symdh(*command, cwd=folder, env={"COLUMNS": "80", **env})
            assert ran.returncode == 0, ran.stderr
            printed.append(ran.stdout)
        files = {path.name: path.read_bytes() for path in folder.iterdir()}
        assert len(files) == 5
        given.append((printed, files))
    assert all(other == given[0] for other in given[1:])
