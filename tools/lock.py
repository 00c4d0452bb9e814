"""Renew requirements-ci.txt, which CI installs from: `make lock`.

The newest releases within the ranges of pyproject.toml, for every Python from the oldest supported
one on and every system, with the hash of each file. uv finds them; it is fetched into an
environment of its own.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from make_venv import LOCK, OLDEST

ROOT = Path(__file__).resolve().parent.parent
UV = "uv>=0.5,<1"


def main() -> None:
    """Write the lock file."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        programs = Path(folder, "bin")
        subprocess.run([programs / "python", "-m", "pip", "install", "--quiet", UV], check=True)
        command = [programs / "uv", "pip", "compile", "--quiet", "--no-config", "--upgrade"]
        command += ["--universal", "--python-version", ".".join(map(str, OLDEST))]
        command += ["--generate-hashes", "--all-extras", "--custom-compile-command", "make lock"]
        subprocess.run([*command, "pyproject.toml", "--output-file", LOCK], cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
