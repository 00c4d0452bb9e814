"""LaTeX -> PDF with the TeX that is installed, in a fresh folder and within a time limit."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

from symdh.errors import LimitError, OutputError

#: In the order of preference; latexmk repeats runs as often as references need it.
ENGINES = ("latexmk", "pdflatex")

_FLAGS = ("-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape")
_INSTALL = "on Debian: apt install texlive-latex-recommended texlive-pictures lmodern"


def compile_pdf(tex: str, *, engine: str | None = None, time_limit: float = 60.0) -> bytes:
    """Typeset a standalone document.

    Parameters
    ----------
    tex : str
    engine : str, optional
        One of `ENGINES`; by default the first that is installed.
    time_limit : float
        Seconds for all of it.

    Returns
    -------
    bytes
        The PDF. The same document gives the same bytes.

    Raises
    ------
    OutputError
        When there is no TeX, or TeX refuses the document.
    LimitError
        When the time limit is reached; the TeX run has then been ended.
    """
    program = _find(engine)
    with tempfile.TemporaryDirectory(prefix="symdh-") as folder:
        source = Path(folder) / "handout.tex"
        source.write_text(tex, encoding="utf-8")
        _run(program, source, time_limit)
        result = source.with_suffix(".pdf")
        if not result.is_file():
            raise OutputError(f"{Path(program).name} made no PDF{_reason(source)}")
        return result.read_bytes()


def _find(engine: str | None) -> str:
    for name in (engine,) if engine else ENGINES:
        path = shutil.which(name)
        if path and (name != "latexmk" or shutil.which("pdflatex")):
            return path
    wanted = engine or "pdflatex"
    raise OutputError(f"{wanted} is not installed ({_INSTALL})")


def _run(program: str, source: Path, time_limit: float) -> None:
    if Path(program).name == "latexmk":
        command = [program, "-norc", "-pdf", *_FLAGS, source.name]
    else:
        command = [program, *_FLAGS, source.name]
    # The date would make two runs differ; TeX reads nothing from folders but its own.
    environment = {**os.environ, "SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"}
    environment |= {"openin_any": "p", "openout_any": "p"}
    process = subprocess.Popen(
        command,
        cwd=source.parent,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        status = process.wait(timeout=time_limit)
    except subprocess.TimeoutExpired:
        raise LimitError(
            f"{Path(program).name} did not end within {time_limit:g} s and was stopped"
        ) from None
    finally:
        _end(process)
    if status != 0:
        raise OutputError(f"{Path(program).name} failed{_reason(source)}")


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the run with all that it started; it leads a process group of its own."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _reason(source: Path) -> str:
    """Return the first error line of TeX's log."""
    try:
        log = source.with_suffix(".log").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    found = re.search(r"^! (.*)$", log, re.MULTILINE)
    return f": {found[1].strip()}" if found else ""
