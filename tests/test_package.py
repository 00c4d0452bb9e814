"""The wheel stands alone: installed into a fresh environment it has its templates and works."""

from __future__ import annotations

import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest
from conftest import Runner

import symdh

ROOT = Path(__file__).parent.parent
ARM = """\
name: arm
convention: standard
joints:
  - {theta: theta1, d: 0, a: a1, alpha: 0}
  - {theta: theta2, d: 0, a: a2, alpha: 0}
"""
PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built from the checkout."""
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run([*PIP, "wheel", "--no-deps", "--wheel-dir", folder, ROOT], check=True)
    (built,) = folder.glob("symdh-*.whl")
    return built


def test_the_names_of_the_package_are_those_it_lists() -> None:
    assert dir(symdh) == sorted(symdh.__all__)
    for name in symdh.__all__:
        assert getattr(symdh, name) is not None
    with pytest.raises(AttributeError, match="module 'symdh' has no attribute 'inverse'"):
        _ = symdh.inverse  # type: ignore[attr-defined]


def test_the_module_runs_as_the_command(run_symdh: Runner) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "symdh", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout == run_symdh("--version").stdout == f"symdh {symdh.__version__}\n"


def test_the_wheel_holds_all_that_the_package_reads(wheel: Path) -> None:
    shipped = set(zipfile.ZipFile(wheel).namelist())
    templates = {
        f"symdh/{path.relative_to(ROOT)}" for path in (ROOT / "templates").rglob("*.jinja")
    }
    assert templates
    assert templates <= shipped
    assert {"symdh/table/schema.json", "symdh/py.typed"} <= shipped
    assert not any(name.startswith(("tests/", "examples/")) for name in shipped)


def test_the_wheel_works_in_a_fresh_environment(wheel: Path, tmp_path: Path) -> None:
    environment = tmp_path / "environment"
    venv.create(environment)
    python = environment / "bin" / "python"
    subprocess.run([*PIP, "--python", python, "install", wheel], check=True)
    work = tmp_path / "work"
    work.mkdir()
    (work / "arm.yaml").write_text(ARM)

    def run(*command: str | Path) -> str:
        return subprocess.run(
            command, cwd=work, capture_output=True, encoding="utf-8", check=True
        ).stdout

    where = run(python, "-I", "-c", "import symdh; print(symdh.__file__)")
    assert Path(where.strip()).is_relative_to(environment)
    run(environment / "bin" / "symdh", "derive", "arm.yaml")
    assert {path.name for path in (work / "arm").iterdir()} == {
        "arm.tex",
        "arm.html",
        "arm.py",
        "arm.h",
        "arm.c",
    }
    assert run(environment / "bin" / "symdh", "latex", "arm.yaml").startswith("%")
