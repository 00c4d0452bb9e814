"""The command line as a user meets it: results, messages, exit statuses, help."""

from __future__ import annotations

import errno
import importlib
import io
import json
import math
import os
import pty
import re
import select
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from symdh.cli import console, files, patience
from symdh.cli.main import main, run
from symdh.cli.output import WrittenFile
from symdh.cli.program import COMMANDS, program
from symdh.codegen import TARGETS, verification
from symdh.errors import Diagnostic, Severity

EXAMPLES = Path(__file__).parent.parent / "examples"
ARM = """\
name: arm
convention: standard
units: {angle: deg, length: m}
joints:
  - {theta: theta1, d: 0, a: a1, alpha: 0}
  - {theta: theta2, d: 0, a: a2, alpha: 0}
values: {a1: 0.5, a2: 0.4}
"""
TWO_MISTAKES = """\
name: arm
convention: standard
joints:
  - {theta: theta1, d: 0, a: a1*, alpha: 0}
  - {theta: theta2, d: 1/0, a: a2, alpha: 0}
"""
#: For these, symdh must not load what it does not need.
HEAVY = ("sympy", "numpy", "jinja2", "yaml", "mpmath")

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A good table, in the folder that the test runs in."""
    monkeypatch.chdir(tmp_path)
    Path("arm.yaml").write_text(ARM)
    return Path("arm.yaml")


def names(folder: Path = Path()) -> set[str]:
    return {each.name for each in folder.iterdir()}


# -- help ------------------------------------------------------------------------------------------


def test_the_commands_are_those_of_the_design() -> None:
    designed = {"derive", "show", "eval", "latex", "pdf", "code", "check", "init", "completion"}
    later = {"html", "rotate", "task", "jacobian", "singular", "frames", "convert", "ik"}
    handouts = {"answer", "draw", "templates"}
    assert set(program.commands) == designed | later | handouts


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_help_has_one_line_of_purpose_and_an_example(command: object, capsys: Capture) -> None:
    name = command.name  # type: ignore[attr-defined]
    assert run([name, "--help"]) == 0
    shown = capsys.readouterr().out
    purpose = shown.split("\n")[2].strip()
    assert purpose.endswith(".")
    assert f"Example:\n    symdh {name}" in shown


def test_the_list_of_commands_cuts_no_purpose_short(capsys: Capture) -> None:
    assert run(["--help"]) == 0
    assert "..." not in capsys.readouterr().out.partition("Commands:")[2]


@pytest.mark.parametrize(
    "arguments", [["--help"], ["--version"], ["completion", "fish"], ["derive", "--help"]]
)
def test_help_loads_nothing_heavy(arguments: list[str]) -> None:
    script = (
        "import sys; from symdh.cli.main import run; status = run(sys.argv[1:]); "
        f"print([name for name in {HEAVY!r} if name in sys.modules], file=sys.stderr); "
        "sys.exit(status)"
    )
    ran = subprocess.run(
        [sys.executable, "-c", script, *arguments], capture_output=True, text=True, check=True
    )
    assert ran.stderr.splitlines()[-1] == "[]"


def test_version(capsys: Capture) -> None:
    assert run(["--version"]) == 0
    assert re.fullmatch(r"symdh \d+\.\d+\.\d+\n", capsys.readouterr().out)


@pytest.mark.parametrize(
    ("arguments", "advice"),
    [
        (["shwo", "arm.yaml"], "Did you mean show?"),
        (["arm.yaml"], "Did you mean symdh derive arm.yaml?"),
        (["derive", "arm.yaml", "--odrer", "left"], "--order"),
        (["derive"], "TABLE"),
        (["code", "arm.yaml", "--target", "fortran"], "python"),
        (["code", "arm.yaml"], "--target"),
        (["check"], "TABLE"),
        (["xyzzy"], "there is no command 'xyzzy'. The commands are init, check, derive"),
        (["derive", "arm.yaml", "-j", "many"], "'many' is not a number from 0 to 999"),
        (["derive", "arm.yaml", "other.yaml", "-o", "-"], "-o - takes one table."),
        (["answer", "arm.yaml", "a.yaml", "-o", "x"], "-o goes with --blank"),
        (["answer", "arm.yaml", "a.yaml", "--blank"], "--blank takes a table alone."),
        (["code", "arm.yaml", "--target", "python", "--trig", "libm"], "--trig is for --target c"),
        (["code", "arm.yaml", "--target", "c", "--lock", "q9"], "q9 is no joint variable of "),
    ],
)
def test_wrong_usage_is_told_and_costs_status_2(
    arguments: list[str], advice: str, arm: Path, capsys: Capture
) -> None:
    assert run(arguments) == 2
    shown = capsys.readouterr()
    assert advice in shown.err
    assert shown.out == ""
    assert names() == {"arm.yaml"}


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_prints_the_shell_s_script(shell: str, capsys: Capture) -> None:
    assert run(["completion", shell]) == 0
    assert f"_SYMDH_COMPLETE={shell}_complete" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "index", "completions"),
    [
        ("symdh co", 1, ["convert", "code", "completion"]),
        ("symdh code --target ", 3, [target.name for target in TARGETS]),
    ],
)
def test_the_shell_s_questions_are_answered(
    words: str,
    index: int,
    completions: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: Capture,
) -> None:
    monkeypatch.setenv("_SYMDH_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(index))
    assert run([]) == 0
    assert capsys.readouterr().out.split() == [f"plain,{name}" for name in completions]


def test_a_shell_that_nobody_knows_gets_no_answer(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.setenv("_SYMDH_COMPLETE", "tcsh_complete")
    assert run([]) == 1
    assert capsys.readouterr() == ("", "")


# -- streams --------------------------------------------------------------------------------------


class Terminal(io.StringIO):
    """What looks like a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_diagnostic_without_a_line_is_coloured_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setattr(sys, "stderr", Terminal())
    console.show_diagnostics([Diagnostic("odd", "f.yaml", 1, 1)])
    assert sys.stderr.getvalue() == "\x1b[1mf.yaml:1:1:\x1b[0m\x1b[31m odd\x1b[0m\n"


def test_messages_to_nobody_are_no_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    class Gone(io.StringIO):
        def write(self, text: str) -> int:
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stderr", Gone())
    console.note("who is there?")
    assert sys.stderr is None
    console.note("nobody")


def test_output_that_cannot_be_flushed_is_thrown_away(monkeypatch: pytest.MonkeyPatch) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "w") as stream:
        stream.write("a result")
        monkeypatch.setattr(sys, "stdout", stream)
        console.settle_stdout()
        stream.flush()  # to nowhere now
        monkeypatch.undo()


def test_a_person_is_told_what_takes_long(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", Terminal())
    with patience.telling("composing"):
        pass
    monkeypatch.setattr(patience, "PATIENCE", 0.0)
    told = threading.Event()
    say = console.note

    def note(text: str) -> None:
        say(text)
        told.set()

    monkeypatch.setattr(console, "note", note)
    with patience.telling("deriving"):
        assert told.wait(30)
    assert sys.stderr.getvalue() == "deriving ...\n"


def test_sizes_for_people() -> None:
    sizes = (999, 1000, 2_540_000)
    told = files.listing([WrittenFile(Path("a"), size, True) for size in sizes])
    assert [line.split(maxsplit=2)[2] for line in told.splitlines()] == [
        "999 B",
        "1.0 kB",
        "2.5 MB",
    ]


def test_code_that_is_wrong_costs_status_1(
    arm: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = verification.verify

    def verify(*arguments: object, **named: object) -> object:
        return replace(real(*arguments, **named), error=math.inf)  # type: ignore[arg-type]

    monkeypatch.setattr(verification, "verify", verify)
    assert run(["code", str(arm), "--target", "python", "--verify"]) == 1
    forward, inverse = capsys.readouterr().out.splitlines()
    assert forward.startswith("python: largest error")
    assert forward.endswith("WRONG")
    assert inverse.endswith("right")


# -- derive ----------------------------------------------------------------------------------------


def test_derive_writes_everything_and_prints_the_result(arm: Path, capsys: Capture) -> None:
    assert run(["derive", str(arm)]) == 0
    shown = capsys.readouterr()
    assert names() == {"arm.yaml", "arm"}
    assert names(Path("arm")) == {"arm.tex", "arm.html", "arm.py", "arm.h", "arm.c"}
    assert "a₁ c₁ + a₂ c₁₂" in shown.out
    for name in names(Path("arm")):
        size = (Path("arm") / name).stat().st_size
        listed = f"{size / 1000:.1f} kB" if size >= 1000 else f"{size} B"
        assert re.search(rf"wrote arm/{re.escape(name)} +{re.escape(listed)}\n", shown.out)
    assert shown.err == ""


def test_a_second_run_says_that_nothing_has_changed(arm: Path, capsys: Capture) -> None:
    assert run(["derive", str(arm), "-o", "out"]) == 0
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in Path("out").iterdir()}
    capsys.readouterr()
    assert run(["derive", str(arm), "-o", "out"]) == 0
    assert capsys.readouterr().out.count("(unchanged)") == 5
    after = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in Path("out").iterdir()}
    assert after == before


def test_derive_to_standard_output_writes_no_file(arm: Path, capsys: Capture) -> None:
    assert run(["derive", str(arm), "-o", "-"]) == 0
    assert "\\end{document}" in capsys.readouterr().out
    assert names() == {"arm.yaml"}


def test_every_option_of_a_document_reaches_it(arm: Path, capsys: Capture) -> None:
    def latex(*options: str) -> str:
        assert run(["latex", str(arm), *options]) == 0
        return capsys.readouterr().out

    plain = latex()
    assert "letterpaper" in latex("--paper", "letter")
    assert "\\documentclass" not in latex("--fragment")
    others = [latex("--order", "left"), latex("--notation", "craig")]
    assert len({plain, *others}) == 3
    assert latex("--order", "right", "--notation", "auto", "--paper", "a4") == plain


@pytest.mark.parametrize(
    "command",
    [
        "draw arm.yaml --azimuth",
        "draw arm.yaml --elevation",
        "ik arm.yaml --time-limit",
        "pdf arm.yaml --time-limit",
        "convert arm.yaml --to modified --tolerance",
        "rotate Rz(1) --tolerance",
    ],
)
@pytest.mark.usefixtures("arm")
def test_what_is_no_number_is_in_no_range(command: str, capsys: Capture) -> None:
    assert run([*command.split(), "nan"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "'nan' is not a number." in printed.err
    assert names() == {"arm.yaml"}


# -- show and eval ---------------------------------------------------------------------------------


def test_show_json(arm: Path, capsys: Capture) -> None:
    assert run(["show", str(arm), "--format", "json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert (shown["from"], shown["to"]) == (0, 2)
    assert shown["matrix"][0] == ["c12", "-s12", "0", "a1*c1 + a2*c12"]
    assert "cos(theta1 + theta2)" in shown["expressions"][0][0]


@pytest.mark.parametrize("form", ["text", "latex"])
def test_show_takes_frames(form: str, arm: Path, capsys: Capture) -> None:
    assert run(["show", str(arm), "--from", "0", "--to", "1", "--format", form]) == 0
    one = capsys.readouterr().out
    assert run(["show", str(arm), "--from", "1", "--to", "0", "--format", form]) == 0
    back = capsys.readouterr().out
    assert one.strip()
    assert one != back
    assert not re.search("a₂|a_2|a_{2}", one + back)


@pytest.mark.parametrize("frame", ["3", "-1", "hand", "1.0", ""])
def test_a_frame_that_is_not_there(frame: str, arm: Path, capsys: Capture) -> None:
    assert run(["show", str(arm), "--to", frame]) == 2
    assert "arm has base, 0 to 2, tool" in capsys.readouterr().err


def test_show_fits_the_width_that_the_terminal_has(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    assert run(["show", str(EXAMPLES / "puma560.yaml")]) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) <= 60


def test_eval_takes_the_values_of_the_table_and_of_the_command(arm: Path, capsys: Capture) -> None:
    settings = ["--set", "theta1=90", "--set", "θ2 = 0 rad", "--set", "a1=0.25"]
    assert run(["eval", str(arm), *settings, "--format", "json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert (shown["from"], shown["to"]) == (0, 2)
    expected = [[0, -1, 0, 0], [1, 0, 0, 0.65], [0, 0, 1, 0], [0, 0, 0, 1]]
    assert shown["matrix"] == [pytest.approx(row, abs=1e-15) for row in expected]


def test_eval_prints_numbers(capsys: Capture) -> None:
    assert run(["eval", str(EXAMPLES / "planar_2r_modified.yaml")]) == 0
    shown = capsys.readouterr().out
    for number in ("-0.2588", "-0.9659", "0.6706", "13.88"):
        assert number in shown


@pytest.mark.parametrize(
    ("setting", "says"),
    [
        ("theta3=1", "theta3 is not in the table"),
        ("theta1", "missing ="),
        ("theta1=", "--set:1:"),
        ("theta1=q", "--set:1:"),
        ("theta1=1/0", "division by zero"),
        ("a1=30 deg", "--set:1:"),
    ],
)
def test_a_wrong_setting(setting: str, says: str, arm: Path, capsys: Capture) -> None:
    assert run(["eval", str(arm), "--set", setting]) == 2
    assert says in capsys.readouterr().err


def test_eval_names_what_has_no_value(arm: Path, capsys: Capture) -> None:
    assert run(["eval", str(arm)]) == 2
    assert "theta1, theta2 have no value" in capsys.readouterr().err


# -- code, latex, pdf ------------------------------------------------------------------------------


@pytest.mark.parametrize(("target", "files"), [("python", {"arm.py"}), ("c", {"arm.h", "arm.c"})])
def test_code_writes_one_target(target: str, files: set[str], arm: Path, capsys: Capture) -> None:
    assert run(["code", str(arm), "--target", target]) == 0
    assert names() == {"arm.yaml", *files}
    shown = capsys.readouterr()
    assert shown.out == ""
    assert all(name in shown.err for name in files)


def test_code_into_a_folder_keeps_what_is_not_ours(arm: Path, capsys: Capture) -> None:
    Path("src").mkdir()
    Path("src/arm.c").write_text("int mine;\n")
    assert run(["code", str(arm), "--target", "c", "-o", "src"]) == 3
    assert "src/arm.c" in capsys.readouterr().err
    assert names(Path("src")) == {"arm.c"}
    assert run(["code", str(arm), "--target", "c", "-o", "src", "--force"]) == 0
    assert names(Path("src")) == {"arm.c", "arm.h"}


def test_latex_to_a_file_and_again(arm: Path, capsys: Capture) -> None:
    assert run(["latex", str(arm), "-o", "sheet.tex"]) == 0
    assert run(["latex", str(arm), "-o", "sheet.tex", "--paper", "letter"]) == 0
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.count("wrote sheet.tex") == 2
    assert "letterpaper" in Path("sheet.tex").read_text()


def test_pdf_without_tex_keeps_the_latex(
    arm: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("symdh.render.pdf.has_typst", lambda: False)
    assert run(["pdf", str(arm)]) == 3
    shown = capsys.readouterr().err
    assert "texlive-latex-recommended" in shown
    assert "arm.tex" in shown
    assert "\\end{document}" in Path("arm.tex").read_text()
    assert names() == {"arm.yaml", "arm.tex"}


# -- check and init --------------------------------------------------------------------------------


def test_check_reads_every_file_and_sums_up(arm: Path, capsys: Capture) -> None:
    Path("bad.yaml").write_text(TWO_MISTAKES)
    assert run(["check", str(arm), "bad.yaml", str(arm)]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert [line for line in shown.err.splitlines() if "bad.yaml:" in line] == [
        line for line in shown.err.splitlines() if line.startswith(("bad.yaml:4:", "bad.yaml:5:"))
    ]
    assert "2 errors" in shown.err.splitlines()
    assert shown.err.splitlines()[-1] == "3 files: 2 good, 1 with errors"


def test_check_tells_a_file_that_is_not_there_from_a_wrong_one(arm: Path, capsys: Capture) -> None:
    assert run(["check", "missing.yaml", str(arm)]) == 3
    assert "missing.yaml: no such file" in capsys.readouterr().err
    Path("bad.yaml").write_text(TWO_MISTAKES)
    assert run(["check", "missing.yaml", "bad.yaml"]) == 2


def test_check_of_good_tables(capsys: Capture) -> None:
    tables = sorted(map(str, EXAMPLES.glob("*.yaml")))
    assert len(tables) == 9
    assert run(["check", *tables]) == 0
    assert capsys.readouterr().err == "9 files: 9 good\n"


def test_every_command_refuses_a_wrong_table(arm: Path, capsys: Capture) -> None:
    Path("arm.yaml").write_text(TWO_MISTAKES)
    for command in ("derive", "show", "eval", "latex", "pdf", "code --target c"):
        name, *options = command.split()
        assert run([name, "arm.yaml", *options]) == 2
        lines = capsys.readouterr().err.splitlines()
        assert [line.split(": ")[0] for line in lines if line.startswith("arm.yaml")] == [
            "arm.yaml:4:33",
            "arm.yaml:5:25",
        ]
        assert lines[-1] == "2 errors"
    assert names() == {"arm.yaml"}


def test_a_caret_stands_below_the_mistake(arm: Path, capsys: Capture) -> None:
    Path("arm.yaml").write_text(TWO_MISTAKES)
    assert run(["check", "arm.yaml"]) == 2
    lines = capsys.readouterr().err.splitlines()
    (place,) = (k for k, line in enumerate(lines) if line.startswith("arm.yaml:5:"))
    assert lines[place + 1][lines[place + 2].index("^")] == "/"


def test_a_warning_is_printed_and_does_not_stop_the_work(arm: Path, capsys: Capture) -> None:
    Path("arm.yaml").write_text(ARM.replace("convention: standard\n", ""))
    assert run(["show", "arm.yaml"]) == 0
    shown = capsys.readouterr()
    assert shown.err.startswith("arm.yaml:1:1: warning: no convention is given")
    assert "warning" not in shown.out


def test_init_writes_a_table_that_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["init"]) == 0
    assert "symdh derive dh_table.yaml" in capsys.readouterr().err
    assert run(["check", "dh_table.yaml"]) == 0
    assert "warning" not in capsys.readouterr().err
    Path("dh_table.yaml").write_text("mine")
    assert run(["init"]) == 3
    assert Path("dh_table.yaml").read_text() == "mine"
    assert run(["init", "--force"]) == 0
    assert Path("dh_table.yaml").read_text() != "mine"


def test_init_prints_the_table_or_the_schema(capsys: Capture) -> None:
    assert run(["init", "-"]) == 0
    assert "convention: standard" in capsys.readouterr().out
    assert run(["init", "--schema"]) == 0
    assert "draft-07" in json.loads(capsys.readouterr().out)["$schema"]


def test_a_table_from_standard_input(
    run_symdh: Callable[..., subprocess.CompletedProcess[str]],
) -> None:
    ran = run_symdh("show", "-", "--format", "json", input=ARM)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert json.loads(ran.stdout)["to"] == 2
    wrong = run_symdh("show", "-", input=TWO_MISTAKES)
    assert wrong.returncode == 2
    assert wrong.stderr.startswith("<stdin>:4:33: ")


# -- the process -----------------------------------------------------------------------------------

COMMAND = [sys.executable, "-m", "symdh"]


def test_a_closed_pipe_is_no_error(arm: Path) -> None:
    for arguments in ("derive arm.yaml -o -", "latex arm.yaml", "--help"):
        ran = subprocess.run(
            f"set -o pipefail; {sys.executable} -m symdh {arguments} | true",
            shell=True,
            executable="/bin/bash",
            stderr=subprocess.PIPE,
            check=False,
        )
        assert ran.returncode in (0, 141)
        assert ran.stderr == b""


@pytest.mark.parametrize("arguments", ["derive arm.yaml -o -", "show arm.yaml", "--help"])
def test_a_full_device(arguments: str, arm: Path) -> None:
    with Path("/dev/full").open("wb") as full:
        ran = subprocess.run(
            [*COMMAND, *arguments.split()], stdout=full, stderr=subprocess.PIPE, check=False
        )
    assert ran.returncode == 3
    assert ran.stderr == b"error: cannot write to standard output: no space left on device\n"


def test_closed_streams(arm: Path) -> None:
    closed = subprocess.run(
        f"{sys.executable} -m symdh show arm.yaml >&-",
        shell=True,
        stderr=subprocess.PIPE,
        check=False,
    )
    assert (closed.returncode, b"Traceback" in closed.stderr) == (3, False)
    mute = subprocess.run(
        f"{sys.executable} -m symdh check missing.yaml 2>&-", shell=True, check=False
    )
    assert mute.returncode == 3


def test_a_locale_without_letters_changes_no_byte(arm: Path) -> None:
    def shown(**environment: str) -> bytes:
        settings = ["--set", "θ1=30 deg", "--set", "θ2=0"]
        commands = ([*COMMAND, "show", "arm.yaml"], [*COMMAND, "eval", "arm.yaml", *settings])
        runs = [
            subprocess.run(
                command, env={**os.environ, **environment}, capture_output=True, check=True
            )
            for command in commands
        ]
        return b"".join(ran.stdout for ran in runs)

    ascii_only = shown(LC_ALL="C", PYTHONUTF8="0", PYTHONCOERCECLOCALE="0")
    assert ascii_only == shown(LC_ALL="C.UTF-8")
    assert "θ" in ascii_only.decode() or "₁" in ascii_only.decode()


WAITING = """
import sys, time
import symdh.table
from symdh.cli.main import main

def wait(path):
    try:
        print("loading", flush=True)
        time.sleep(60)
    finally:
        print("clearing up", flush=True)
        sys.stdin.read()
        print("cleared up", flush=True)

symdh.table.load_table = wait
sys.argv = ["symdh", "derive", "arm.yaml"]
main()
"""


@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)], ids=["INT", "TERM"]
)
def test_a_signal_stops_without_a_word(number: int, status: int, arm: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", WAITING],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        for expected in (b"loading\n", b"clearing up\n"):
            assert process.stdout.readline() == expected
            process.send_signal(number)  # the second one does not cut the clearing up short
        out, err = process.communicate(timeout=20)
    assert (process.returncode, out, err) == (status, b"cleared up\n", b"")
    assert names() == {"arm.yaml"}


def on_a_terminal(*arguments: str, **environment: str) -> str:
    """Run symdh with a terminal for its standard error and return what that shows."""
    master, slave = pty.openpty()
    base = {key: value for key, value in os.environ.items() if key != "NO_COLOR"}
    process = subprocess.Popen(
        [*COMMAND, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=slave,
        stderr=slave,
        env={**base, "TERM": "xterm", **environment},
    )
    os.close(slave)
    shown = b""
    while select.select([master], [], [], 30)[0]:
        try:
            piece = os.read(master, 4096)
        except OSError as error:
            assert error.errno == errno.EIO
            break
        if not piece:
            break
        shown += piece
    process.wait(timeout=20)
    os.close(master)
    return shown.decode()


def test_colour_is_for_terminals(arm: Path) -> None:
    Path("bad.yaml").write_text(TWO_MISTAKES)
    assert "\x1b[31m" in on_a_terminal("check", "bad.yaml")
    assert "\x1b[31m" in on_a_terminal("check", "missing.yaml").replace(
        "\x1b[31m\x1b[1m", "\x1b[31m"
    )
    assert "\x1b" not in on_a_terminal("check", "bad.yaml", NO_COLOR="1")
    assert "\x1b" not in on_a_terminal("check", "bad.yaml", TERM="dumb")
    piped = subprocess.run(
        [*COMMAND, "check", "bad.yaml"],
        capture_output=True,
        env={**os.environ, "TERM": "xterm"},
        check=False,
    )
    assert b"\x1b" not in piped.stderr


def test_what_a_file_holds_cannot_steer_the_terminal(capsys: Capture) -> None:
    hostile = Diagnostic("bad \x1b[2J", "a\x1b]0;x\x07.yaml", 1, 1, "\u202ex\x1b[0m", 2)
    console.show_diagnostics([hostile])
    shown = capsys.readouterr().err
    assert not re.search("[\x00-\x09\x0b-\x1f\u202e]", shown)
    assert shown.splitlines()[2].index("^") == 5


@pytest.mark.parametrize(
    ("errors", "warnings", "text"),
    [(1, 0, "1 error"), (2, 1, "2 errors, 1 warning"), (0, 2, "2 warnings")],
)
def test_the_count_of_diagnostics(errors: int, warnings: int, text: str) -> None:
    severities = [Severity.ERROR] * errors + [Severity.WARNING] * warnings
    found = [Diagnostic("x", "f", 1, 1, severity=severity) for severity in severities]
    assert console.counted(found) == text


@pytest.mark.parametrize(
    ("failure", "status", "says"),
    [
        (ValueError("odd"), 70, "internal error: ValueError: odd"),
        (MemoryError(), 4, "out of memory"),
        (RecursionError(), 4, "nested too deeply"),
        (KeyboardInterrupt(), 130, ""),
    ],
)
def test_what_nobody_expects_is_told_without_a_traceback(
    failure: BaseException,
    status: int,
    says: str,
    arm: Path,
    capsys: Capture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(path: str) -> None:
        raise failure

    monkeypatch.setattr("symdh.table.load_table", fail)
    assert run(["show", str(arm)]) == status
    shown = capsys.readouterr().err
    assert says in shown
    assert "Traceback" not in shown
    if status == 70:
        monkeypatch.setenv("SYMDH_DEBUG", "1")
        assert run(["show", str(arm)]) == 70
        assert "Traceback" in capsys.readouterr().err


# ------------------------------------------------------------------------ a table is never replaced


@pytest.mark.parametrize("command", [("latex",), ("convert", "--to", "modified"), ("html",)])
@pytest.mark.parametrize("spelling", ["arm.yaml", "./arm.yaml", "link/arm.yaml"])
def test_what_a_command_reads_is_not_replaced(
    command: tuple[str, ...],
    spelling: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Not even a table that symdh wrote, and which a user may have gone on with."""
    monkeypatch.chdir(tmp_path)
    Path("link").symlink_to(tmp_path)
    table = f"# written by symdh\n{ARM}"
    Path("arm.yaml").write_text(table)
    assert run([*command, "arm.yaml", "-o", spelling]) == 3
    assert f"refuses to replace {Path(spelling)}: it is read here" in capsys.readouterr().err
    assert Path("arm.yaml").read_text() == table


def test_a_preamble_is_not_replaced_either(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.yaml").write_text(ARM)
    Path("own.tex").write_text("% like those written by symdh\n")
    assert run(["latex", "arm.yaml", "--preamble", "own.tex", "-o", "own.tex"]) == 3
    assert Path("own.tex").read_text() == "% like those written by symdh\n"


def test_force_replaces_what_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.yaml").write_text(ARM)
    assert run(["convert", "arm.yaml", "--to", "modified", "-o", "arm.yaml", "--force"]) == 0
    assert "convention: modified" in Path("arm.yaml").read_text()


# ------------------------------------------------------------------------------- what is said


def test_to_import_the_main_module_runs_nothing() -> None:
    """A process that is spawned imports it."""
    assert importlib.import_module("symdh.__main__").main is main


@pytest.mark.parametrize("output", [(), ("-o", "-")])
def test_a_blank_answer_file_goes_to_standard_output(
    output: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "arm.yaml").write_text(ARM)
    assert run(["answer", str(tmp_path / "arm.yaml"), "--blank", *output]) == 0
    printed = capsys.readouterr().out
    assert "\nA1:\n  - [_, _, _, _]\n" in printed
    assert "\nT02:\n  - [_, _, _, _]\n" in printed
    assert [each.name for each in tmp_path.iterdir()] == ["arm.yaml"]


@pytest.mark.parametrize(("option", "lines"), [((), 2), (("--no-ik",), 1)])
def test_verify_says_of_ik_what_there_is(
    option: tuple[str, ...], lines: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "arm.yaml").write_text(ARM)
    command = ["code", str(tmp_path / "arm.yaml"), "--target", "python", "--verify", *option]
    assert run([*command, "-o", str(tmp_path)]) == 0
    said = [line for line in capsys.readouterr().out.splitlines() if line.startswith("python: ")]
    assert len(said) == lines
    assert ("ik found" in said[-1]) == (not option)
