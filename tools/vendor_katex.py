"""Renew the copy of KaTeX under templates/html/katex: `python3 tools/vendor_katex.py [VERSION]`.

Called by `make vendor`. Takes the package from npm, keeps its licence, its version, the minified
script and style, and the fonts that symdh's formulas use.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path
from tempfile import TemporaryDirectory

TARGET = Path(__file__).resolve().parent.parent / "templates" / "html" / "katex"
FONTS = (
    *("Main-Regular", "Main-Bold", "Main-Italic", "Math-Italic"),
    *("Size1-Regular", "Size2-Regular", "Size3-Regular", "Size4-Regular"),
)


def main(version: str) -> None:
    """Fetch one version of the package and put what is needed of it into place."""
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        subprocess.run(["npm", "pack", f"katex@{version}"], cwd=folder, check=True)
        (archive,) = folder.glob("katex-*.tgz")
        with tarfile.open(archive) as package:
            package.extractall(folder, filter="data")
        install(folder / "package")


def install(package: Path) -> None:
    """Replace the vendored files by those of an unpacked package."""
    shutil.rmtree(TARGET, ignore_errors=True)
    (TARGET / "fonts").mkdir(parents=True)
    for name in ("katex.min.js", "katex.min.css"):
        shutil.copy(package / "dist" / name, TARGET)
    for font in FONTS:
        shutil.copy(package / "dist" / "fonts" / f"KaTeX_{font}.woff2", TARGET / "fonts")
    shutil.copy(package / "LICENSE", TARGET)
    version = json.loads((package / "package.json").read_text(encoding="utf-8"))["version"]
    (TARGET / "VERSION").write_text(f"{version}\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "latest")
