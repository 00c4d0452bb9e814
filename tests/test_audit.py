"""What symdh is made of: locked, within the ranges, declared, free to use; and the audit bites."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import audit  # noqa: E402

LOCK = """\
# by make lock
click==8.1.7 \\
    --hash=sha256:00 \\
    --hash=sha256:11
    # via symdh (pyproject.toml)
mpmath==1.3.0 ; python_full_version < '3.12' \\
    --hash=sha256:22
    # via sympy
sympy==1.14.0 \\
    --hash=sha256:33
    # via
    #   other
    #   symdh (pyproject.toml)
"""


def test_nothing_is_wrong() -> None:
    locked = audit.read_lock(audit.LOCK.read_text(encoding="utf-8"))
    assert len(locked) > 30
    assert [*audit.unpinned(locked), *audit.unwanted(locked), *audit.out_of_range(locked)] == []
    assert [*audit.undeclared(), *audit.unlicensed(), *audit.installed_out_of_range()] == []


def test_a_lock_file_is_read_with_its_hashes_and_reasons() -> None:
    click, mpmath, sympy = audit.read_lock(LOCK)
    assert (click.name, click.hashes, click.wanted_by) == ("click", 2, ("symdh",))
    assert (mpmath.hashes, mpmath.wanted_by) == (1, ("sympy",))
    assert str(mpmath.requirement.marker) == 'python_full_version < "3.12"'
    assert sympy.wanted_by == ("other", "symdh")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("click==8.1.7", "click>=8.1.7", "click>=8.1.7 is not pinned to one release"),
        ("click==8.1.7", "click==8.1.*", "click==8.1.* is not pinned to one release"),
        ("sympy==1.14.0 \\\n    --hash=sha256:33", "sympy==1.14.0", "sympy==1.14.0 has no hash"),
    ],
)
def test_what_is_not_pinned_is_named(old: str, new: str, said: str) -> None:
    assert list(audit.unpinned(audit.read_lock(LOCK.replace(old, new)))) == [said]


def test_what_nothing_asks_for_is_named() -> None:
    assert list(audit.unwanted(audit.read_lock(LOCK))) == []
    stray = audit.read_lock(LOCK.replace("# via sympy", "# via nothing"))
    assert list(audit.unwanted(stray)) == ["mpmath: nothing asks for it"]


def test_what_is_out_of_range_or_missing_is_named() -> None:
    found = list(audit.out_of_range(audit.read_lock(LOCK.replace("1.14.0", "2.0"))))
    assert "sympy 2.0 is locked, outside <2,>=1.12" in found
    assert "numpy: not in the lock file" in found


def test_an_import_that_is_not_declared_is_named(tmp_path: Path) -> None:
    package = tmp_path / "package"
    package.mkdir()
    (package / "a.py").write_text("import os\nimport sympy.abc\nfrom . import b\n")
    (package / "b.py").write_text("def f():\n    from scipy.linalg import expm\n")
    assert list(audit.undeclared(package)) == ["package/b.py imports scipy"]


def test_a_licence_that_is_not_permissive_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(audit, "PERMISSIVE", audit.re.compile("MIT"))
    assert any(each.startswith("sympy: licence not known") for each in audit.unlicensed())
