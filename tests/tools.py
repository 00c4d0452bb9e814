"""Programs and folders that tests need."""

from __future__ import annotations

import atexit
import functools
import os
import shutil
import tempfile
from pathlib import Path

import pytest


def find_tool(name: str) -> str:
    """Return the path of a program that nobody promises, not even CI; skip the test without it."""
    path = shutil.which(name)
    if path is None:
        pytest.skip(f"{name} is not installed")
    return path


def require_tool(name: str) -> str:
    """Return the path of a program; skip the test without it, and fail where CI promises it."""
    path = shutil.which(name)
    if path is None:
        message = f"{name} is not installed"
        if os.environ.get("CI", "").lower() in ("1", "true"):
            pytest.fail(message)
        pytest.skip(message)
    return path


#: The tool that runs each language, and whether CI promises it.
LANGUAGES = {
    "python": ("python3", True),
    "c": ("gcc", True),
    "cpp": ("g++", True),
    "matlab": ("octave-cli", True),
    "javascript": ("node", True),
    "rust": ("rustc", False),
    "julia": ("julia", False),
    "python-ext": ("gcc", True),
}


def require_language(target: str) -> None:
    """Skip a test where a language cannot be run; fail where CI promises it."""
    tool, promised = LANGUAGES[target]
    (require_tool if promised else find_tool)(tool)


def has_instructions(name: str) -> bool:
    """Say whether this machine runs an extension of its instruction set, as Linux calls it."""
    cpu = Path("/proc/cpuinfo")
    return cpu.exists() and name in cpu.read_text().split()


@functools.cache
def _scratch() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="symdh-tests-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def new_folder(name: str) -> Path:
    """Return a folder for what several tests share; it goes when the process ends."""
    return Path(tempfile.mkdtemp(prefix=name, dir=_scratch()))
