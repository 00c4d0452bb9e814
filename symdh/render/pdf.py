"""LaTeX or Typst -> PDF, in a fresh folder and within a time limit."""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from symdh.errors import LimitError, OutputError

#: For LaTeX, in the order of preference; latexmk repeats runs of pdflatex as often as needed.
ENGINES = ("latexmk", "pdflatex", "lualatex")
#: The Python package that typesets where there is no TeX.
TYPST = "typst"

_FLAGS = ("-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape")
#: LuaTeX without Lua's ways to start programs and to write files.
_SAFER = "-safer"
#: No dates (bits 32 and 64) and no number made of them (512) in what LuaTeX writes.
_LUATEX_UNDATED = r"\pdfvariable suppressoptionalinfo 608 \input{%s}"
_INSTALL_TYPST = "pip install 'symdh[pdf]'"
_INSTALL = (
    "on Debian: apt install texlive-latex-recommended texlive-pictures lmodern; "
    f"without TeX: {_INSTALL_TYPST}"
)
#: Typst runs in a process of its own, so that it can be ended.
_RUN_TYPST = """\
import sys, typst
try:
    typst.compile("handout.typ", "handout.pdf", root=".", ignore_system_fonts=True)
except typst.TypstError as error:
    print(error.message, file=sys.stderr)
    sys.exit(1)
"""
#: A package that a template of the user's imports is not fetched: nobody answers there.
_NO_NETWORK = dict.fromkeys(
    ("http_proxy", "https_proxy", "all_proxy", "HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"),
    "http://127.0.0.1:9",
)


def find_engine() -> str:
    """Return what a PDF is made with where nothing is asked for: TeX, without it Typst."""
    if shutil.which("pdflatex") is None and has_typst():
        return TYPST
    return "latexmk" if shutil.which("latexmk") else "pdflatex"


def has_typst() -> bool:
    """Say whether the package typst is installed; a folder of that name is none."""
    found = importlib.util.find_spec(TYPST)
    return found is not None and found.origin is not None


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
        _run_tex(program, source, time_limit)
        result = source.with_suffix(".pdf")
        if not result.is_file():
            raise OutputError(f"{Path(program).name} made no PDF{_reason(source)}")
        return result.read_bytes()


def compile_typst(text: str, *, time_limit: float = 60.0) -> bytes:
    """Typeset a document in Typst with the fonts that are part of it.

    Parameters
    ----------
    text : str
    time_limit : float
        Seconds.

    Returns
    -------
    bytes
        The PDF. The same document gives the same bytes.

    Raises
    ------
    OutputError
        When there is no Typst, or it refuses the document.
    LimitError
        When the time limit is reached; the run has then been ended.
    """
    if not has_typst():
        raise OutputError(f"typst is not installed ({_INSTALL_TYPST})")
    with tempfile.TemporaryDirectory(prefix="symdh-") as folder:
        source = Path(folder) / "handout.typ"
        source.write_text(text, encoding="utf-8")
        # -P: nothing in the folder is taken for a module.
        command = [sys.executable, "-P", "-c", _RUN_TYPST]
        log = Path(folder) / "errors"
        if _ended(TYPST, command, Path(folder), _NO_NETWORK, time_limit, log) != 0:
            raise OutputError(f"typst failed: {_last_line(log)}")
        return source.with_suffix(".pdf").read_bytes()


def _find(engine: str | None) -> str:
    for name in (engine,) if engine else ENGINES:
        path = shutil.which(name)
        if path and (name != "latexmk" or shutil.which("pdflatex")):
            return path
    wanted = engine or "pdflatex"
    raise OutputError(f"{wanted} is not installed ({_INSTALL})")


def _run_tex(program: str, source: Path, time_limit: float) -> None:
    name = Path(program).name
    if name == "latexmk":
        command = [program, "-norc", "-pdf", *_FLAGS, source.name]
    elif name == "lualatex":
        undated = _LUATEX_UNDATED % source.name
        command = [program, _SAFER, *_FLAGS, f"-jobname={source.stem}", undated]
    else:
        command = [program, *_FLAGS, source.name]
    # The date would make two runs differ; TeX reads nothing from folders but its own.
    settings = {"SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"}
    settings |= {"openin_any": "p", "openout_any": "p"}
    if _ended(name, command, source.parent, settings, time_limit, Path(os.devnull)) != 0:
        raise OutputError(f"{name} failed{_reason(source)}")


def _ended(
    name: str,
    command: Sequence[str],
    folder: Path,
    settings: Mapping[str, str],
    time_limit: float,
    errors: Path,
) -> int:
    """Run a command in a folder, its error messages into a file, and return its exit status.

    Raises
    ------
    LimitError
        When it does not end in time; it has then been ended with all that it started.
    """
    with errors.open("wb") as log:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, **settings},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=log,
            start_new_session=True,
        )
        try:
            return process.wait(timeout=time_limit)
        except subprocess.TimeoutExpired:
            raise LimitError(
                f"{name} did not end within {time_limit:g} s and was stopped"
            ) from None
        finally:
            _end(process)


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


def _last_line(log: Path) -> str:
    lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return lines[-1] if lines else "it said nothing"
