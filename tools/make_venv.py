"""Make a virtual environment and install this project into it: `python3 tools/make_venv.py DIR`.

Called by the Makefile. What is installed is the newest within the ranges of pyproject.toml, in CI
(CI=true) exactly what requirements-ci.txt lists, each file by its hash. Debian ships python3
without ensurepip; it is in the package python3-venv, which is installed here when the user is root,
so that nothing need be installed by hand.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

OLDEST = (3, 11)
LOCK = "requirements-ci.txt"
ADVICE = "python3 cannot make a virtual environment here: apt-get install python3-venv, then again"


def main(folder: str) -> None:
    """Make the environment in `folder`."""
    if sys.version_info < OLDEST:
        wanted = ".".join(map(str, OLDEST))
        sys.exit(f"symdh needs Python {wanted} or newer; this is {sys.version.split()[0]}")
    if not has_ensurepip():
        install_venv()
    python = Path(folder, "bin", "python")
    # A new process: this one has already looked for ensurepip and found nothing.
    if subprocess.run([sys.executable, "-m", "venv", folder]).returncode != 0:
        sys.exit(ADVICE)
    install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    for what in requirements():
        if subprocess.run([*install, *what]).returncode != 0:
            named = LOCK if in_ci() else "pyproject.toml"
            sys.exit(f"the packages named in {named} could not be installed: is there a network?")


def requirements() -> list[list[str]]:
    """Return what to ask of pip, one run after the other."""
    if not in_ci():
        return [["--editable", ".[dev]"]]
    # The build backend is in the lock file too, so that nothing comes from anywhere else.
    return [
        ["--require-hashes", "--requirement", LOCK],
        ["--no-deps", "--no-build-isolation", "--editable", "."],
    ]


def in_ci() -> bool:
    """Say whether this runs in continuous integration."""
    return os.environ.get("CI", "").lower() in ("1", "true")


def has_ensurepip() -> bool:
    """Say whether `venv` can put pip into an environment."""
    try:
        from ensurepip import version
    except ImportError:
        return False
    return bool(version())


def install_venv() -> None:
    """Install what Debian's python3 lacks, where this user may; else say what to type."""
    if os.geteuid() != 0 or shutil.which("apt-get") is None:
        sys.exit(ADVICE)
    print("installing Debian's python3-venv, which this python3 lacks", flush=True)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for arguments in (["update", "-qq"], ["install", "-qq", "--yes", "python3-venv"]):
        if subprocess.run(["apt-get", *arguments], env=environment).returncode != 0:
            sys.exit(ADVICE)


if __name__ == "__main__":
    main(sys.argv[1])
