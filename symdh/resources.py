"""Where symdh's own data files lie."""

from __future__ import annotations

from pathlib import Path

from symdh.errors import ReadError


def templates_dir() -> Path:
    """Return the folder of the templates.

    An installed package carries it inside (``symdh/templates``); a checkout has it beside the
    package.

    Raises
    ------
    ReadError
        When neither is there.
    """
    package = Path(__file__).resolve().parent
    for folder in (package / "templates", package.parent / "templates"):
        if folder.is_dir():
            return folder
    raise ReadError(f"{package / 'templates'}: no such folder; install symdh again")
