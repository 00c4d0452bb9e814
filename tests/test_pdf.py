r"""LaTeX to PDF: what is missing is named, what does not end is ended, what fails says why."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

import symdh
from symdh.derivation.derive import derive
from symdh.errors import LimitError, OutputError
from symdh.render import pdf
from symdh.render.latex import render_latex
from symdh.render.pdf import ENGINES, compile_pdf
from tools import require_tool

EXAMPLES = Path(__file__).parent.parent / "examples"
PREAMBLE = "\\documentclass{article}\n\\begin{document}\n"
SMALL = PREAMBLE + "Text.\n\\end{document}\n"

each_engine = pytest.mark.parametrize("engine", ENGINES)


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Temporary folders lie where the test can see them; afterwards nothing is left there."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    yield folder
    assert list(folder.iterdir()) == []
    assert_nothing_works_in(folder)


def assert_nothing_works_in(folder: Path) -> None:
    """Check that no process is left; one that was killed may take a moment to go."""
    deadline = time.monotonic() + 5
    while working_in(folder) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert working_in(folder) == []


def working_in(folder: Path) -> list[str]:
    """Return the processes that have their working folder below a folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if (process / "cwd").readlink().is_relative_to(folder):
                found.append((process / "cmdline").read_text())
        except OSError:
            continue
    return found


def program(folder: Path, name: str, script: str) -> None:
    """Put a program of our own into a folder."""
    folder.mkdir(exist_ok=True)
    path = folder / name
    path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    path.chmod(0o755)


@each_engine
def test_a_document_becomes_a_pdf(engine: str) -> None:
    require_tool(engine)
    pdf = compile_pdf(SMALL, engine=engine)
    assert pdf.startswith(b"%PDF-")
    assert pdf.rstrip().endswith(b"%%EOF")


@each_engine
def test_the_same_handout_gives_the_same_bytes(
    engine: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    require_tool(engine)
    tex = render_latex(derive(symdh.load(EXAMPLES / "planar_2r.yaml")))
    first = compile_pdf(tex, engine=engine)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1000000000")
    monkeypatch.setenv("TZ", "Pacific/Auckland")
    time.sleep(1.1)  # the date of a PDF counts seconds
    assert compile_pdf(tex, engine=engine) == first
    assert b"/CreationDate" not in first
    assert b"temporary" not in first


def test_a_document_of_ones_own_gives_the_same_bytes_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """It asks for nothing of the kind itself, so the run has to fix the date and the number."""
    require_tool("pdflatex")
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    first = compile_pdf(SMALL, engine="pdflatex")
    time.sleep(1.1)
    assert compile_pdf(SMALL, engine="pdflatex") == first


# -- what is missing ------------------------------------------------------------------------------


def test_without_tex_the_message_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(OutputError) as caught:
        compile_pdf(SMALL)
    assert str(caught.value).startswith("pdflatex is not installed")
    assert "apt install texlive-latex-recommended" in str(caught.value)
    assert caught.value.exit_status == 3


@each_engine
def test_an_engine_that_is_asked_for_and_missing_is_named(
    engine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(OutputError, match=f"{engine} is not installed"):
        compile_pdf(SMALL, engine=engine)


def test_latexmk_without_pdflatex_does_not_count(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program(tmp_path / "bin", "latexmk", "exit 0")
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    with pytest.raises(OutputError, match="pdflatex is not installed"):
        compile_pdf(SMALL)


def test_pdflatex_alone_will_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "bin"
    folder.mkdir()
    (folder / "pdflatex").symlink_to(require_tool("pdflatex"))
    monkeypatch.setenv("PATH", f"{folder}")
    assert shutil.which("latexmk") is None
    assert compile_pdf(SMALL).startswith(b"%PDF-")


# -- what does not end ----------------------------------------------------------------------------


@each_engine
def test_a_document_without_end_is_ended(engine: str) -> None:
    require_tool(engine)
    start = time.monotonic()
    with pytest.raises(LimitError) as caught:
        compile_pdf(PREAMBLE + r"\def\x{\x}\x \end{document}", engine=engine, time_limit=2.0)
    assert time.monotonic() - start < 6.0
    assert str(caught.value) == f"{engine} did not end within 2 s and was stopped"
    assert caught.value.exit_status == 4


def test_what_the_engine_started_is_ended_too(
    own_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wrapper that waits for a child of its own leaves neither behind."""
    sleep = require_tool("sleep")
    program(tmp_path / "bin", "pdflatex", f"{sleep} 60 & {sleep} 60")
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    with pytest.raises(LimitError):
        compile_pdf(SMALL, engine="pdflatex", time_limit=0.5)
    assert_nothing_works_in(own_folder)


def test_tex_does_not_wait_for_a_keyboard() -> None:
    require_tool("pdflatex")
    with pytest.raises(OutputError):
        compile_pdf(
            PREAMBLE + r"\read-1 to \answer \end{document}", engine="pdflatex", time_limit=20
        )


# -- what fails -----------------------------------------------------------------------------------


@each_engine
def test_the_error_of_tex_is_reported(engine: str) -> None:
    require_tool(engine)
    with pytest.raises(OutputError) as caught:
        compile_pdf(PREAMBLE + r"\nosuchmacro \end{document}", engine=engine)
    assert str(caught.value) == f"{engine} failed: Undefined control sequence."


def test_a_missing_package_is_named() -> None:
    require_tool("pdflatex")
    tex = SMALL.replace("\\begin", "\\usepackage{nosuchpackage}\n\\begin")
    with pytest.raises(OutputError, match=r"File `nosuchpackage\.sty' not found"):
        compile_pdf(tex, engine="pdflatex")


def test_a_document_without_pages_makes_no_pdf() -> None:
    require_tool("pdflatex")
    with pytest.raises(OutputError, match="pdflatex made no PDF"):
        compile_pdf(PREAMBLE + "\\end{document}\n", engine="pdflatex")


def test_an_engine_that_says_nothing_still_fails_with_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program(tmp_path / "bin", "pdflatex", "exit 7")
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    with pytest.raises(OutputError) as caught:
        compile_pdf(SMALL)
    assert str(caught.value) == "pdflatex failed"


# -- what a document may not do -------------------------------------------------------------------


def test_a_document_runs_no_programs(tmp_path: Path) -> None:
    require_tool("pdflatex")
    victim = tmp_path / "victim"
    compile_pdf(
        PREAMBLE + rf"Text.\immediate\write18{{touch {victim}}}" + "\n\\end{document}",
        engine="pdflatex",
    )
    assert not victim.exists()


def test_a_document_writes_only_beside_itself(tmp_path: Path) -> None:
    require_tool("pdflatex")
    victim = tmp_path / "victim.txt"
    writing = rf"\newwrite\w\immediate\openout\w={victim} \immediate\write\w{{x}}"
    with pytest.raises(OutputError, match="I can't write on file"):
        compile_pdf(PREAMBLE + writing + "Text.\n\\end{document}", engine="pdflatex")
    assert not victim.exists()


def lua(line: str) -> str:
    """Return a document that runs a line of Lua and prints what it gives."""
    return PREAMBLE + rf"\directlua{{{line}}}Text." + "\n\\end{document}"


@pytest.mark.parametrize(
    "line",
    [
        r"os.execute([[touch VICTIM]])",
        r"io.popen([[touch VICTIM]]):close()",
        r"os.spawn({[[touch]], [[VICTIM]]})",
        r"io.open([[VICTIM]], [[w]]):close()",
        r"lfs.mkdir([[VICTIM]])",
        r"require([[ffi]]).C.system([[touch VICTIM]])",
    ],
)
def test_lua_in_a_document_starts_nothing_and_writes_nothing(line: str, tmp_path: Path) -> None:
    require_tool("lualatex")
    victim = tmp_path / "victim"
    with suppress(OutputError):  # some calls raise, others only return nothing
        compile_pdf(lua(line.replace("VICTIM", str(victim))), engine="lualatex")
    assert not victim.exists()


def test_it_is_the_switch_that_stops_lua(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tool("lualatex")
    monkeypatch.setattr(pdf, "_SAFER", "-no-shell-escape")
    compile_pdf(lua(f"lfs.mkdir([[{tmp_path}/victim]])"), engine="lualatex")
    assert (tmp_path / "victim").is_dir()


def test_lua_reads_no_file_elsewhere(tmp_path: Path) -> None:
    require_tool("lualatex")
    (tmp_path / "secret").write_text("secret")
    reading = f"tex.print(io.open([[{tmp_path}/secret]]):read([[*a]]))"
    with pytest.raises(OutputError, match="lualatex failed"):
        compile_pdf(lua(reading), engine="lualatex")


def test_a_configuration_of_latexmk_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    require_tool("latexmk")
    (tmp_path / ".latexmkrc").write_text(f"system('touch {tmp_path}/victim');\n")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert compile_pdf(SMALL, engine="latexmk").startswith(b"%PDF-")
    assert not (tmp_path / "victim").exists()
