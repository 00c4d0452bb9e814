"""Hostile and broken tables, and faults: each case of the corpus meets its stated outcome.

A case with an input is written to arm.yaml in an empty folder and derived there by a process of
its own. A case with an action has a test of its own below. A case that symdh does not build yet
stands in WAITS with the issue that will.
"""

from __future__ import annotations

import base64
import ctypes
import inspect
import os
import resource
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from conftest import SYMDH, Runner
from generated import STRICT_C, compile_file, import_file
from oracle import FIFTY_DIGITS, Arm, read_arm

from tools import require_tool

ROOT = Path(__file__).parent.parent
CASES: dict[str, dict[str, Any]] = {
    case["id"]: case
    for case in yaml.safe_load((Path(__file__).parent / "data" / "bad_inputs.yaml").read_text())
}

WAITS = {
    "EN01": "never: symdh has no --simplify",
    "EN07": "issue 8: every supported release of sympy",
    "GC08": "issue 8: mutants of generated code",
    "OU05": "issue 8: a full disk under the output folder",
    "OU09": "issue 8: SIGINT at every write",
    "OU10": "issue 8: SIGTERM at every write",
    "OU11": "issue 8: SIGKILL at every write",
    "OU12": "issue 8: many processes into one folder",
    "OU15": "issue 8: every system call failing in turn",
    "TX11": "issue 8: lualatex",
}

GOOD = """\
convention: standard
name: arm
joints:
  - {theta: theta1, d: d1, a: a1, alpha: 90 deg}
  - {theta: theta2, d: 0, a: a2, alpha: 0}
"""
WRITTEN = {"arm.tex", "arm.html", "arm.py", "arm.h", "arm.c"}


def has_input(case: dict[str, Any]) -> bool:
    return any(key.startswith("input") for key in case)


def input_of(case: dict[str, Any]) -> bytes:
    if "input" in case:
        return str(case["input"]).encode()
    if "input_base64" in case:
        return base64.b64decode(case["input_base64"])
    return str(eval(case["input_python"])).encode()  # noqa: S307  (text of our own corpus)


def inputs(*outcomes: str, category: str | None = None) -> pytest.MarkDecorator:
    """Parametrize over the cases that have an input and one of these outcomes."""
    chosen = [
        case
        for case in CASES.values()
        if has_input(case)
        and case["id"] not in WAITS
        and case["expected"]["outcome"] in outcomes
        and category in (None, case["category"])
    ]
    return pytest.mark.parametrize("case", chosen, ids=lambda case: case["id"])


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    """A good table in the test's folder."""
    table = tmp_path / "arm.yaml"
    table.write_text(GOOD)
    return table


ACTIONS: set[str] = set()


def action(identifier: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Mark a test as the one that does what an action case says."""
    assert not has_input(CASES[identifier])
    ACTIONS.add(identifier)
    return lambda test: test


def test_no_case_is_forgotten() -> None:
    with_input = {name for name, case in CASES.items() if has_input(case)}
    assert len(CASES) == 120
    assert not set(WAITS) & ACTIONS
    assert with_input | ACTIONS | set(WAITS) == set(CASES)


# ---------------------------------------------------------------------------------- the tables


@inputs("error")
def test_a_bad_table_is_refused_at_its_place(
    case: dict[str, Any], tmp_path: Path, run_symdh: Runner
) -> None:
    (tmp_path / "arm.yaml").write_bytes(input_of(case))
    before = contents(tmp_path)
    ran = run_symdh("derive", "arm.yaml")
    assert ran.returncode == case["expected"]["exit"]
    assert_clean_message(ran)
    assert ran.stdout == ""
    assert f"arm.yaml:{case['expected']['where']}: " in ran.stderr
    assert contents(tmp_path) == before


@inputs("ok", "warn")
def test_an_odd_table_is_derived(case: dict[str, Any], tmp_path: Path, run_symdh: Runner) -> None:
    text = input_of(case)
    (tmp_path / "arm.yaml").write_bytes(text)
    ran = run_symdh("derive", "arm.yaml", "-o", "out")
    assert ran.returncode == 0
    assert_clean_message(ran)
    if case["expected"]["outcome"] == "warn":
        assert "arm.yaml:8:12: warning: " in ran.stderr
    name = yaml.load(text, Loader=yaml.BaseLoader)["name"]
    written = {f"{name}.{ending}" for ending in ("tex", "html", "py", "h", "c")}
    assert set(contents(tmp_path / "out")) == written
    plain = plainly_named(case, text.decode())
    assert_code_agrees(tmp_path / "out", name, read_arm(plain))


def plainly_named(case: dict[str, Any], text: str) -> str:
    """The table of a case, spelt so that the oracle can read it: its symbol called p."""
    if case["id"] == "AR35":
        return text.replace("1.5708", "1.5708 rad")
    if case["category"] != "symbol name":
        return text.replace("\r\n", "\n")
    head, tail = text.split("    a: ")
    return f"{head}    a: p\n{tail.split(chr(10), 1)[1]}"


def assert_code_agrees(folder: Path, name: str, arm: Arm) -> None:
    """Call the generated Python and C at seeded poses and compare with the oracle."""
    q = arm.seeded_poses(20, seed=1)
    free = arm.parameters()
    numbers = dict(zip(free, np.linspace(0.3, 0.7, len(free)), strict=True))
    variables = {symbol: q[:, k] for k, (symbol, _) in enumerate(arm.variables)}
    expected = arm.pose(variables | numbers)
    tolerance = arm.tolerance(numbers)

    fk = import_file(folder / f"{name}.py").fk
    _, *keywords = inspect.signature(fk).parameters
    poses = fk(q, **dict(zip(keywords, numbers.values(), strict=True)))
    assert np.abs(poses - expected).max() <= tolerance

    compiled = compile_file(folder / f"{name}.c", n=len(arm.variables))
    poses = compiled(q, list(numbers.values()) or None)
    assert np.abs(poses - expected).max() <= tolerance


@inputs("ok", category="symbol name")
def test_odd_names_are_valid_cpp_too(
    case: dict[str, Any], tmp_path: Path, run_symdh: Runner
) -> None:
    (tmp_path / "arm.yaml").write_bytes(input_of(case))
    assert run_symdh("code", "arm.yaml", "--target", "c").returncode == 0
    command = [require_tool("g++"), "-std=c++98", *STRICT_C, "-x", "c++", "-c", "demo.c"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (0, "")


@inputs("ok", category="latex")
def test_a_title_is_printed_as_text(
    case: dict[str, Any], tmp_path: Path, run_symdh: Runner
) -> None:
    require_tool("pdflatex")
    (tmp_path / "arm.yaml").write_bytes(input_of(case))
    ran = run_symdh("pdf", "arm.yaml", "-o", "arm.pdf")
    assert (ran.returncode, ran.stdout) == (0, "")
    title = yaml.safe_load(input_of(case))["title"]
    assert squeeze(title) in squeeze(text_of_pdf(tmp_path / "arm.pdf"))


def test_line_ends_do_not_matter(tmp_path: Path, run_symdh: Runner) -> None:
    for name, end in (("lf", "\n"), ("crlf", "\r\n"), ("cr", "\r")):
        (tmp_path / f"{name}.yaml").write_bytes(GOOD.replace("\n", end).encode())
        assert run_symdh("derive", f"{name}.yaml", "-o", name).returncode == 0
    expected = contents(tmp_path / "lf")
    assert set(expected) == WRITTEN
    assert contents(tmp_path / "crlf") == expected
    assert contents(tmp_path / "cr") == expected


COST = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss)
"""


def cost_of(arguments: list[str], folder: Path) -> tuple[float, int]:
    """Run symdh; return its seconds of CPU and the most memory that it had, in KiB.

    A process is charged for the memory of the one that forked it, so a small one stands between.
    """
    printed = subprocess.run(
        [sys.executable, "-I", "-S", "-c", COST, SYMDH, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    return float(printed[0]), int(printed[1])


def test_fifty_joints_stay_within_their_budget(tmp_path: Path, run_symdh: Runner) -> None:
    """TA13: 5 s of CPU, 300 MiB, and code that grows linearly."""
    table = input_of(CASES["TA13"]).decode().splitlines(keepends=True)
    sizes = {}
    for joints in (25, 50):
        (tmp_path / "arm.yaml").write_text("".join(table[: 2 + joints]))
        seconds, kibibytes = cost_of(["derive", "arm.yaml", "-o", str(joints)], tmp_path)
        assert seconds < 5
        assert kibibytes < 300 * 1024
        sizes[joints] = {name: len(text) for name, text in contents(tmp_path / str(joints)).items()}
    for name, size in sizes[50].items():
        assert size < 2.3 * sizes[25][name], name


# ----------------------------------------------------------------------------- reading a file


@action("BO16")
def test_an_endless_file_is_read_up_to_the_limit(tmp_path: Path, run_symdh: Runner) -> None:
    refused(run_symdh("derive", "/dev/zero"), 2, "1 MiB", tmp_path)


@action("FI06")
def test_a_missing_file(tmp_path: Path, run_symdh: Runner) -> None:
    refused(run_symdh("derive", "missing.yaml"), 3, "missing.yaml: no such file", tmp_path)


@action("FI07")
def test_a_directory_for_a_table(tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "a-directory").mkdir()
    refused(run_symdh("derive", "a-directory"), 3, "a-directory: is a directory", tmp_path)


@action("FI08")
def test_a_table_that_may_not_be_read(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    arm.chmod(0)
    ran = run_symdh("derive", "arm.yaml", preexec_fn=obey_permissions)
    refused(ran, 3, "arm.yaml: permission denied", tmp_path)


@action("FI09")
def test_a_fifo_for_a_table_returns_at_once(tmp_path: Path, run_symdh: Runner) -> None:
    os.mkfifo(tmp_path / "p")
    refused(run_symdh("derive", "p"), 3, "p: not a regular file", tmp_path)


# ---------------------------------------------------------------------------- writing the files


@action("NA15")
def test_names_that_differ_only_in_case_do_not_share_a_folder(
    tmp_path: Path, run_symdh: Runner
) -> None:
    (tmp_path / "upper.yaml").write_text(GOOD.replace("name: arm", "name: Arm"))
    (tmp_path / "lower.yaml").write_text(GOOD)
    assert run_symdh("derive", "upper.yaml", "-o", "out").returncode == 0
    before = contents(tmp_path)
    ran = run_symdh("derive", "lower.yaml", "-o", "out")
    refused(ran, 2, "Arm.", tmp_path)
    assert contents(tmp_path) == before


@action("OU01")
def test_a_read_only_output_folder(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    out = tmp_path / "out"
    out.mkdir(mode=0o555)
    ran = run_symdh("derive", arm, "-o", out, preexec_fn=obey_permissions)
    refused(ran, 3, "permission denied", tmp_path)
    assert str(out) in ran.stderr
    assert contents(out) == {}


@action("OU02")
def test_a_file_where_a_folder_is_wanted(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "out").write_text("mine")
    before = contents(tmp_path)
    refused(run_symdh("derive", arm, "-o", "out"), 3, "not a directory", tmp_path)
    assert contents(tmp_path) == before


@action("OU03")
def test_a_link_is_not_replaced(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "victim").write_text("mine")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "arm.c").symlink_to(tmp_path / "victim")
    before = contents(tmp_path)
    for force in ([], ["--force"]):
        refused(run_symdh("derive", arm, "-o", "out", *force), 3, "link", tmp_path)
        assert contents(tmp_path) == before
        assert (tmp_path / "out" / "arm.c").is_symlink()


@action("OU04")
def test_a_folder_where_a_file_is_wanted(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "out" / "arm.c").mkdir(parents=True)
    for force in ([], ["--force"]):
        refused(run_symdh("derive", arm, "-o", "out", *force), 3, "directory", tmp_path)
        assert [path.name for path in (tmp_path / "out").iterdir()] == ["arm.c"]


@pytest.mark.undisturbed
@action("OU06")
def test_a_file_that_may_not_grow(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    arm.write_text(GOOD.replace("a: a2", "a: a3"))
    before = contents(tmp_path)
    ran = run_symdh(
        "derive",
        arm,
        "-o",
        "out",
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024)),
    )
    refused(ran, 3, "too large", tmp_path)
    assert contents(tmp_path) == before


@action("OU07")
def test_standard_output_on_a_full_device(arm: Path) -> None:
    with Path("/dev/full").open("w") as full:
        ran = subprocess.run(
            [SYMDH, "derive", str(arm), "-o", "-"],
            stdout=full,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            check=False,
        )
    assert ran.returncode == 3
    assert "no space left" in ran.stderr.lower()
    assert "Traceback" not in ran.stderr
    assert "Exception ignored" not in ran.stderr


@action("OU08")
def test_a_closed_pipe_is_a_quiet_end(arm: Path) -> None:
    process = subprocess.Popen(
        [SYMDH, "derive", str(arm), "-o", "-"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.close()
    message = process.stderr.read()
    process.stderr.close()
    assert process.wait(60) in (0, 141)
    assert message == ""


@action("OU13")
def test_a_second_run_rewrites_nothing(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    first = contents(tmp_path / "out")
    assert set(first) == WRITTEN
    for path in (tmp_path / "out").iterdir():
        os.utime(path, (1, 1))
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    assert contents(tmp_path / "out") == first
    assert {path.stat().st_mtime for path in (tmp_path / "out").iterdir()} == {1}


@action("OU14")
def test_a_file_of_someone_else_is_kept(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "arm.c").write_text("int mine;\n")
    before = contents(tmp_path)
    ran = run_symdh("derive", arm, "-o", "out")
    refused(ran, 3, "--force", tmp_path)
    assert contents(tmp_path) == before
    assert run_symdh("derive", arm, "-o", "out", "--force").returncode == 0
    assert "arm_fk" in (tmp_path / "out" / "arm.c").read_text()


# -------------------------------------------------------------------------------- environment


def derived(
    folder: Path, run_symdh: Runner, table: Path, **options: Any
) -> dict[str, bytes | None]:
    """Everything that one run of derive gives: its files, and what it prints."""
    ran = run_symdh("derive", table, "-o", folder, **options)
    assert ran.returncode == 0, ran.stderr
    printed = ran.stdout.replace(str(folder), "FOLDER").encode()
    return {**contents(folder), "printed": printed}


@action("EN02")
def test_a_6r_arm_in_400_megabytes(tmp_path: Path, run_symdh: Runner) -> None:
    limit = 400_000 * 1024
    given = derived(
        tmp_path / "out",
        run_symdh,
        ROOT / "examples" / "puma560.yaml",
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )
    assert "puma560.c" in given


@action("EN03")
def test_thirty_two_hash_seeds(tmp_path: Path, run_symdh: Runner) -> None:
    table = ROOT / "examples" / "minimover_5r.yaml"

    def run(seed: int) -> dict[str, bytes | None]:
        return derived(tmp_path / str(seed), run_symdh, table, env={"PYTHONHASHSEED": str(seed)})

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        first, *others = pool.map(run, range(32))
    assert all(other == first for other in others)


@action("EN04")
@pytest.mark.parametrize(
    "env",
    [{"SYMPY_GROUND_TYPES": "python"}, {"SYMPY_USE_CACHE": "no"}, {"PYTHONOPTIMIZE": "2"}],
    ids=lambda env: next(iter(env)),
)
def test_the_settings_of_sympy_and_python(
    env: dict[str, str], tmp_path: Path, run_symdh: Runner
) -> None:
    table = ROOT / "examples" / "puma560.yaml"
    expected = derived(tmp_path / "plain", run_symdh, table)
    assert derived(tmp_path / "set", run_symdh, table, env=env) == expected
    (tmp_path / "arm.yaml").write_bytes(input_of(CASES["AR01"]))
    ran = run_symdh("derive", "arm.yaml", env=env)
    assert (ran.returncode, "arm.yaml:8:13: " in ran.stderr) == (2, True)


@action("EN05")
def test_a_greek_title_in_the_c_locale(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    arm.write_text(GOOD + "title: Βραχίονας θ₁\n", encoding="utf-8")
    expected = derived(tmp_path / "plain", run_symdh, arm)
    assert "θ" in str(expected["printed"], "utf-8")
    ascii_only = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    assert derived(tmp_path / "c", run_symdh, arm, env=ascii_only) == expected


@action("EN06")
def test_time_user_and_folder_do_not_show(tmp_path: Path, run_symdh: Runner) -> None:
    table = ROOT / "examples" / "scara.yaml"
    expected = derived(tmp_path / "plain", run_symdh, table)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    changed = {"TZ": "Asia/Kolkata", "USER": "nobody", "HOSTNAME": "other", "HOME": str(elsewhere)}
    assert derived(tmp_path / "set", run_symdh, table, env=changed, cwd=elsewhere) == expected


# --------------------------------------------------------------------------------------- TeX


@action("TX08")
def test_no_tex_is_said_in_one_line_and_the_source_is_kept(
    arm: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    (tmp_path / "bin").mkdir()
    options = ("--engine", "pdflatex")  # by default the package typst would do
    ran = run_symdh("pdf", arm, "-o", "arm.pdf", *options, env={"PATH": str(tmp_path / "bin")})
    refused(ran, 3, "pdflatex", tmp_path)
    (line,) = (line for line in ran.stderr.splitlines() if "pdflatex" in line)
    assert "texlive-latex-recommended" in line
    assert "arm.tex" in line
    assert r"\end{document}" in (tmp_path / "arm.tex").read_text(encoding="utf-8")
    assert not (tmp_path / "arm.pdf").exists()


@action("TX09")
def test_a_preamble_that_never_ends_is_stopped(
    arm: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    require_tool("pdflatex")
    own = tmp_path / "own.tex"
    own.write_text("\\def\\x{\\x}\\x\n")
    options = ("--preamble", str(own), "--time-limit", "2")
    refused(run_symdh("pdf", arm, "-o", "arm.pdf", *options), 4, "2 s", tmp_path)
    assert not (tmp_path / "arm.pdf").exists()


def test_tex_that_never_ends_is_stopped(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    (tmp_path / "bin").mkdir()
    endless = tmp_path / "bin" / "pdflatex"
    endless.write_text("#!/bin/sh\nexec /bin/sleep 50\n")
    endless.chmod(0o755)
    options = ("--engine", "pdflatex", "--time-limit", "1")
    path = {"PATH": f"{endless.parent}:/usr/bin:/bin"}
    ran = run_symdh("pdf", arm, "-o", "arm.pdf", *options, env=path)
    refused(ran, 4, "1 s", tmp_path)
    assert not (tmp_path / "arm.pdf").exists()


@action("TX10")
def test_a_class_file_in_the_folder_is_not_picked_up(
    arm: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    require_tool("pdflatex")
    (tmp_path / "article.cls").write_text(r"\errmessage{picked up}\stop")
    ran = run_symdh("pdf", arm, "-o", "arm.pdf")
    assert (ran.returncode, ran.stdout) == (0, "")
    assert (tmp_path / "arm.pdf").read_bytes().startswith(b"%PDF-")


# --------------------------------------------------------------------------------- templates


@action("TE01")
def test_a_template_in_a_name_or_title_is_text(
    arm: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    arm.write_text(GOOD.replace("name: arm", "name: '{{7*7}}'"))
    refused(run_symdh("derive", arm), 2, ":2:7: ", tmp_path)
    arm.write_text(GOOD + "title: 'worth {{7*7}}'\n")
    ran = run_symdh("derive", arm, "-o", "out")
    assert ran.returncode == 0
    assert r"worth \{\{7*7\}\}" in (tmp_path / "out" / "arm.tex").read_text()
    texts = [*contents(tmp_path / "out").values(), ran.stdout.encode()]
    assert not any(b"worth 49" in text for text in texts if text is not None)


def with_template(text: str, folder: Path, run_symdh: Runner) -> subprocess.CompletedProcess[str]:
    """Derive the arm with a C header of the user's own, after other text on the first line."""
    own = folder / "own" / "c" / "header.h.jinja"
    own.parent.mkdir(parents=True)
    own.write_text(f"/* Ours. */\n{text}\n")
    before = contents(folder)
    ran = run_symdh("derive", "arm.yaml", "-o", "out", "--templates", "own")
    assert contents(folder) == before
    return ran


@action("TE02")
def test_a_template_cannot_leave_the_sandbox(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    text = '{{ cycler.__init__.__globals__.os.popen("id").read() }}'
    ran = with_template(text, tmp_path, run_symdh)
    refused(ran, 2, "own/c/header.h.jinja:2:11: access to attribute '__init__'", tmp_path)
    assert "uid=" not in ran.stderr


@action("TE03")
def test_a_misspelt_variable_is_no_empty_string(
    arm: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    ran = with_template("{{ stme }}", tmp_path, run_symdh)
    says = "own/c/header.h.jinja:2:4: 'stme' is undefined; did you mean stem?"
    refused(ran, 2, says, tmp_path)


@action("TE04")
def test_a_template_reads_no_other_file(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    ran = with_template('{% include "../../../etc/passwd" %}', tmp_path, run_symdh)
    refused(ran, 2, "own/c/header.h.jinja:2:13: there is no template", tmp_path)
    assert "root:" not in ran.stderr


@action("TE05")
def test_a_loop_without_end_is_a_limit(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    ran = with_template("{% for i in range(10**9) %}x{% endfor %}", tmp_path, run_symdh)
    refused(ran, 4, "own/c/header.h.jinja:2:1: Range too big", tmp_path)


@action("TE06")
def test_code_is_not_escaped_for_the_web(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    arm.write_text(GOOD + "title: a < b & c\n")
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    assert "#include <math.h>" in (tmp_path / "out" / "arm.c").read_text()
    for path in (tmp_path / "out").iterdir():
        text = path.read_text(encoding="utf-8")
        for escaped in ("&lt;", "&amp;"):
            assert (escaped in text) == (path.suffix == ".html"), path.name


# ---------------------------------------------------------------------------- generated code


@pytest.mark.parametrize("value", [pytest.param(np.nan, id="nan"), pytest.param(np.inf, id="inf")])
@action("GC01")
def test_a_pose_that_hangs_on_a_bad_number_is_nan(
    value: float, tmp_path: Path, run_symdh: Runner
) -> None:
    arm = ROOT / "tests" / "data" / "tables" / "scara_rrpr.yaml"
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    q = np.array([0.1, 0.2, 0.3, value])
    rotation = np.zeros((4, 4), dtype=bool)
    rotation[:2, :2] = True
    compiled = compile_file(tmp_path / "out" / "scara_rrpr.c", n=4)
    imported = import_file(tmp_path / "out" / "scara_rrpr.py")
    with np.errstate(invalid="ignore"):
        poses = [compiled(q), imported.fk(q)]
    for pose in poses:
        assert np.array_equal(np.isnan(pose), rotation)


SANITIZED_CALL = """
#include "scara_rrpr.h"
#include <math.h>

int main(void)
{
    double guarded[18];
    double q[4] = {0.1, INFINITY, NAN, 0.4};
    guarded[0] = guarded[17] = 42.0;
    scara_rrpr_fk(q, guarded + 1);
    return guarded[0] == 42.0 && guarded[17] == 42.0 && isnan(guarded[1]) ? 0 : 1;
}
"""


@action("GC02")
def test_bad_numbers_trap_nothing_and_write_nothing_outside(
    tmp_path: Path, run_symdh: Runner
) -> None:
    gcc = require_tool("gcc")
    arm = ROOT / "tests" / "data" / "tables" / "scara_rrpr.yaml"
    assert run_symdh("code", arm, "--target", "c", "-o", ".").returncode == 0
    (tmp_path / "call.c").write_text(SANITIZED_CALL)
    sanitizers = "-fsanitize=float-cast-overflow,undefined,address"
    compiler = [gcc, "-std=c99", "-g", sanitizers, "-fno-sanitize-recover=all"]
    subprocess.run(
        [*compiler, "call.c", "scara_rrpr.c", "-o", "call", "-lm"],
        cwd=tmp_path,
        check=True,
    )
    ran = subprocess.run([tmp_path / "call"], capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (0, "")


@action("GC03")
def test_angles_of_a_million_radians_cost_no_digits(tmp_path: Path, run_symdh: Runner) -> None:
    table = ROOT / "tests" / "data" / "tables" / "puma560.yaml"
    assert run_symdh("code", table, "--target", "c", "-o", ".").returncode == 0
    arm = read_arm(table.read_text(encoding="utf-8"))
    q = np.random.default_rng(3).choice([-1e6, 1e6, 999_999.9], (8, 6))
    joints = {name: FIFTY_DIGITS.array(q[:, k]) for k, (name, _) in enumerate(arm.variables)}
    exact = arm.pose(joints, arithmetic=FIFTY_DIGITS)
    found = compile_file(tmp_path / "puma560.c", n=6)(q)
    assert float(np.max(np.abs(found - exact))) <= 8 * 2.0**-52 * max(1.0, arm.reach())


@action("GC04")
def test_float_code_never_widens(tmp_path: Path, run_symdh: Runner) -> None:
    gcc = require_tool("gcc")
    table = ROOT / "tests" / "data" / "tables" / "puma560.yaml"
    ran = run_symdh("code", table, "--target", "c", "--precision", "float", "-o", ".")
    assert ran.returncode == 0
    command = [gcc, "-std=c99", "-O2", *STRICT_C, "-S", "puma560_float.c", "-o", "-"]
    built = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (built.returncode, built.stderr) == (0, "")
    assert "cvtss2sd" not in built.stdout


@action("GC05")
def test_seventeen_degrees_need_no_pi(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    arm.write_text(GOOD.replace("90 deg", "17 deg"))
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    assert "M_PI" not in (tmp_path / "out" / "arm.c").read_text()
    assert_code_agrees(tmp_path / "out", "arm", read_arm(arm.read_text()))


@action("GC06")
def test_a_huge_length_is_a_floating_literal(arm: Path, tmp_path: Path, run_symdh: Runner) -> None:
    arm.write_text(GOOD.replace("d: d1", "d: 10**30"))
    assert run_symdh("derive", arm, "-o", "out").returncode == 0
    assert_code_agrees(tmp_path / "out", "arm", read_arm(arm.read_text()))


@pytest.mark.parametrize(
    ("compiler", "standard"),
    [("gcc", "c99"), ("gcc", "c11"), *(("g++", f"c++{year}") for year in ("98", "11", "17", "20"))],
)
@action("GC07")
def test_the_header_twice_in_c_and_cpp(
    compiler: str, standard: str, arm: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    tool = require_tool(compiler)
    assert run_symdh("code", arm, "--target", "c", "-o", ".").returncode == 0
    ending = "c" if compiler == "gcc" else "cpp"
    (tmp_path / f"user.{ending}").write_text('#include "arm.h"\n#include "arm.h"\n')
    language = "c" if compiler == "gcc" else "c++"
    for source in (f"user.{ending}", "arm.c"):
        command = [tool, f"-std={standard}", *STRICT_C, "-x", language, "-c", source]
        ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert (ran.returncode, ran.stderr) == (0, "")


# ------------------------------------------------------------------------------------- helpers


def contents(folder: Path) -> dict[str, bytes | None]:
    """Every path below a folder with its bytes; None for what is not a regular file."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
    }


def assert_clean_message(ran: subprocess.CompletedProcess[str]) -> None:
    for stream in (ran.stdout, ran.stderr):
        assert "Traceback" not in stream
        assert "internal error" not in stream


def refused(ran: subprocess.CompletedProcess[str], status: int, says: str, folder: Path) -> None:
    """A run that ended as it should, said why, and left no temporary file behind."""
    assert ran.returncode == status, ran.stderr
    assert_clean_message(ran)
    assert ran.stdout == ""
    assert says.lower() in ran.stderr.lower()
    assert not [path for path in folder.rglob("*") if path.name.startswith(".symdh")]


def squeeze(text: str) -> str:
    return "".join(text.split())


def text_of_pdf(path: Path) -> str:
    ran = subprocess.run(
        [require_tool("pdftotext"), str(path), "-"], capture_output=True, check=True
    )
    return ran.stdout.decode()


def obey_permissions() -> None:
    """In a child process of root, before it starts symdh: give up the right to pass by modes.

    A process of another user would do as well, but could not reach an interpreter in root's home.
    """
    if os.getuid() != 0:
        return
    drop_from_bounding_set = 24
    dac_override, dac_read_search = 1, 2
    for capability in (dac_override, dac_read_search):
        if ctypes.CDLL(None).prctl(drop_from_bounding_set, capability, 0, 0, 0) != 0:
            raise OSError("prctl cannot drop a capability")
