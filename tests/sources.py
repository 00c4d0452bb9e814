"""The files that measurements of the package depend on."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: What `make mutants` keeps for the next run, and what its last whole run came to.
MUTATION = ROOT / ".mutation"
MUTATED = MUTATION / "result"
_OURS = ("symdh", "*.py"), ("tests", "*.py"), ("templates", "*.jinja")


def sources() -> list[Path]:
    """Return the files of the package and of its tests, in the order of their names."""
    return sorted(file for folder, names in _OURS for file in (ROOT / folder).rglob(names))
