"""Templates of a user's own: they replace symdh's by name, can do no harm, and fail at a line."""

from __future__ import annotations

import errno
import gc
import os
import re
import resource
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import SYMDH, Runner
from jinja2 import meta

import symdh
from symdh.codegen import generate
from symdh.derivation.derive import derive
from symdh.errors import LimitError, ReadError, SymdhError, TableError, UnsupportedError
from symdh.render.latex import render_latex
from symdh.render.page.page import render_page
from symdh.resources import templates_dir
from symdh.templating import folder_in_force, limits, own_templates, render
from symdh.templating.catalogue import shipped
from symdh.templating.environments import environment_for
from tools import require_tool

ROOT = Path(__file__).parent.parent
TABLE = ROOT / "examples" / "planar_2r.yaml"
BODY = "latex/body.tex.jinja"
HEADER = "c/header.h.jinja"


@pytest.fixture(scope="module")
def robot() -> symdh.Robot:
    return symdh.load(TABLE)


@pytest.fixture
def own(tmp_path: Path) -> Path:
    """An empty folder for templates, as a relative and short name would be."""
    folder = tmp_path / "own"
    folder.mkdir()
    return folder


@pytest.fixture
def no_garbage() -> Iterator[None]:
    """No collection of garbage, in which an alarm of the test would be lost with a warning."""
    gc.disable()
    yield
    gc.enable()


def put(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def latex_with(folder: Path, robot: symdh.Robot) -> str:
    with own_templates(str(folder)):
        return render_latex(derive(robot))


def header_with(folder: Path, robot: symdh.Robot) -> str:
    with own_templates(str(folder)):
        return generate(robot, "c")[0].text


def refusal(folder: Path, robot: symdh.Robot) -> str:
    """What is said of a C header, whose template is wrong."""
    with pytest.raises(SymdhError) as caught:
        header_with(folder, robot)
    return str(caught.value)


# -- in the place of symdh's ----------------------------------------------------------------------


def test_a_template_replaces_the_one_of_its_name(own: Path, robot: symdh.Robot) -> None:
    before = generate(robot, "c")
    put(own, HEADER, "/* Written by symdh for {{ facts.name }}. */\n")
    assert header_with(own, robot) == "/* Written by symdh for planar_2r. */\n"
    assert generate(robot, "c") == before


def test_a_template_builds_on_the_original(own: Path, robot: symdh.Robot) -> None:
    plain = generate(robot, "c")[0].text
    put(
        own,
        HEADER,
        '{% extends "symdh/c/header.h.jinja" %}\n{% block banner %}\n/* Ours. */\n{% endblock %}\n',
    )
    assert header_with(own, robot) == "/* Ours. */\n" + plain


def test_a_part_that_several_templates_include_is_replaced_in_all(
    own: Path, robot: symdh.Robot
) -> None:
    put(own, BODY, "<< title >> and << chapters | length >> chapters\n")
    document = derive(robot)
    expected = f"Planar arm with two revolute joints and {len(document.chapters)} chapters"
    with own_templates(str(own)):
        for fragment in (True, False):
            text = render_latex(document, fragment=fragment)
            assert expected in text
            assert r"\section" not in text


def test_helpers_of_ones_own_are_included_without_a_warning(own: Path, robot: symdh.Robot) -> None:
    put(own, "firm/licence.jinja", "/* {{ facts.name }}: free */\n")
    put(own, HEADER, '{% include "firm/licence.jinja" %}\n')
    with own_templates(str(own)) as templates:
        assert templates.warnings == ()
    assert header_with(own, robot) == "/* planar_2r: free */\n"


def test_a_style_is_replaced_as_it_is(own: Path, robot: symdh.Robot) -> None:
    put(own, "html/page.css", "body { content: '{{ title }}'; }")
    with own_templates(str(own)):
        page = render_page(derive(robot), robot)
    assert "body { content: '{{ title }}'; }" in page
    assert "color-scheme: light dark" not in page


def test_a_page_is_escaped_and_code_is_not(own: Path) -> None:
    put(own, "html/page.html.jinja", "{{ title }}")
    put(own, HEADER, "{{ facts.name ~ ' < & >' }}")
    arm = symdh.loads(TABLE.read_text().replace("title: Planar", "title: <b> Planar"))
    with own_templates(str(own)):
        assert render_page(derive(arm), arm).startswith("&lt;b&gt; Planar")
        assert generate(arm, "c")[0].text == "planar_2r < & >"


def test_the_same_templates_serve_many_tables_in_many_processes(
    own: Path, tmp_path: Path, run_symdh: Runner
) -> None:
    put(own, BODY, '<% extends "symdh/latex/body.tex.jinja" %><% block head %>OURS<% endblock %>')
    tables = [ROOT / "examples" / f"{name}.yaml" for name in ("planar_2r", "scara")]
    ran = run_symdh("derive", *tables, "-o", "out", "-j", "2", "--templates", "own")
    assert ran.returncode == 0, ran.stderr
    for table in tables:
        assert "OURS" in (tmp_path / "out" / table.stem / f"{table.stem}.tex").read_text()


def test_templates_are_in_force_inside_the_with_alone(own: Path) -> None:
    assert folder_in_force() is None
    with pytest.raises(ZeroDivisionError), own_templates(str(own)):
        assert folder_in_force() == str(own)
        raise ZeroDivisionError
    assert folder_in_force() is None


@pytest.mark.parametrize(
    "command",
    [["latex"], ["html"], ["code", "--target", "c"], ["derive"], ["convert", "--to", "urdf"]],
    ids=lambda command: command[0],
)
def test_every_command_that_fills_in_templates_takes_them(
    command: list[str], own: Path, run_symdh: Runner
) -> None:
    urdf = "interchange/arm.urdf.jinja"
    for name in ("latex/document.tex.jinja", "html/page.html.jinja", HEADER, urdf):
        wrong = "<< nmae >>" if "tex" in name else "{{ nmae }}"
        put(own, name, wrong)
    ran = run_symdh(*command, TABLE, "--templates", "own")
    assert ran.returncode == 2
    assert re.match(r"own/\S+:1:4: 'nmae' is undefined", ran.stderr)
    assert ran.stdout == ""
    assert sorted(path.name for path in own.parent.iterdir()) == ["own"]


# -- what goes wrong has a place ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("\n  {{ stme }}\n", "2:6", "'stme' is undefined; did you mean stem?"),
        ("{{ facts.nmae }}", "1:10", "there is no 'nmae' here; did you mean name?"),
        ("{% for x in facts %}{% endfor %}", "1:1", "not iterable"),
        ("a\n{% nonsense %}", "2:4", "Encountered unknown tag 'nonsense'"),
        ("a\n\n{{ stem ", "3:1", "unexpected end of template"),
        ("{# never\nended", "1:1", "Missing end of comment tag"),
        ("{{ 1 / 0 }}", "1:1", "division by zero"),
        ("{{ stem }}\n{{ stem | uper }}", "2:11", "No filter named 'uper'"),
        ('{% extends "symdh/c/haeder.h.jinja" %}', "1:13", "did you mean c/header.h.jinja?"),
        ('{% include "nothing" %}', "1:13", "there is no template 'nothing'"),
        ("{{ facts.joints.append(1) }}", "1:17", "'append'"),
        ("{{ 'a'.no.more }}", "1:8", "there is no 'no' here"),
    ],
)
def test_a_fault_is_told_with_its_place(
    text: str, place: str, says: str, own: Path, robot: symdh.Robot
) -> None:
    path = put(own, HEADER, text)
    told = refusal(own, robot)
    assert told.startswith(f"{path}:{place}: ")
    assert says in told.split("\n")[0]
    assert len(told.split("\n")) == 3, "the line of the template, and a caret below it"


def test_a_macro_that_is_missing_is_named(own: Path, robot: symdh.Robot) -> None:
    put(own, "latex/blocks.tex.jinja", "<% macro paragrph(text) %><< text >><% endmacro %>")
    with pytest.raises(TableError, match=r"latex/blocks.tex.jinja.* has no macro '\w+'"):
        latex_with(own, robot)


def test_every_template_that_jinja_cannot_read_is_named_at_once(own: Path) -> None:
    put(own, HEADER, "{% if %}")
    put(own, BODY, "<% endfor %>")
    with pytest.raises(TableError) as caught, own_templates(str(own)):
        pass
    assert len(caught.value.diagnostics) == 2


def test_what_jinja_cannot_read_of_a_style_is_told_when_it_is_included(
    own: Path, robot: symdh.Robot
) -> None:
    """A style goes into a page as it is, so it is read as a template only where one includes it."""
    style = put(own, "html/page.css", "p { }\n<% if %>\n")
    put(own, BODY, '<% include "html/page.css" %>')
    with pytest.raises(TableError) as caught:
        latex_with(own, robot)
    assert str(caught.value).startswith(f"{style}:2:1: ")


def test_a_file_that_replaces_nothing_is_warned_of(own: Path) -> None:
    put(own, "latex/boddy.tex.jinja", "")
    put(own, "latex/document.tex", "the suffix is forgotten")
    put(own, "README.md", "no template, nobody minds")
    put(own, ".hidden/secret.jinja", "")
    with own_templates(str(own)) as templates:
        messages = {str(each).split("\n")[0] for each in templates.warnings}
    start = "warning: replaces no template of symdh; did you mean"
    assert messages == {
        f"{own}/latex/boddy.tex.jinja:1:1: {start} {BODY}?",
        f"{own}/latex/document.tex:1:1: {start} latex/document.tex.jinja?",
    }


def test_a_byte_that_is_no_text_has_a_place_too(own: Path) -> None:
    put(own, HEADER, "").write_bytes(b"a\n\xff")
    says = r"header.h.jinja:2:1: byte 0xFF is not UTF-8"
    with pytest.raises(TableError, match=says), own_templates(str(own)):
        pass


def test_a_folder_that_is_not_there(tmp_path: Path, run_symdh: Runner) -> None:
    ran = run_symdh("latex", TABLE, "--templates", "nowhere")
    assert (ran.returncode, ran.stdout) == (3, "")
    assert ran.stderr == "error: nowhere: no such folder\n"
    with pytest.raises(ReadError, match="not a folder"), own_templates(str(TABLE)):
        pass


# -- what a template may not do -------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        '{{ cycler.__init__.__globals__.os.popen("id").read() }}',
        "{{ ''.__class__.__mro__[1].__subclasses__() }}",
        "{{ facts['__class__'] }}",
        "{{ facts | attr('__class__') }}",
        "{{ [facts] | map(attribute='__class__') | join }}",
        "{{ render.__globals__ }}{{ lipsum.__globals__ }}",
        "{{ self._TemplateReference__context }}",
        "{{ facts.joints[0].symbol.subs('print(1)', 1) }}",
        "{{ '{0.__class__}'.format(facts) }}",
        "{{ ('%s' | format)(facts.__dict__) }}",
    ],
)
def test_the_sandbox_holds(text: str, own: Path, robot: symdh.Robot) -> None:
    path = put(own, HEADER, text)
    assert refusal(own, robot).startswith(f"{path}:1:")


@pytest.mark.parametrize(
    "name", ["../../../etc/passwd", "/etc/passwd", "c/../../../../etc/passwd", "symdh/../x", ".."]
)
def test_no_file_outside_is_read(name: str, own: Path, robot: symdh.Robot) -> None:
    put(own, HEADER, f'{{% include "{name}" %}}')
    assert f"there is no template {name!r}" in refusal(own, robot)


def test_links_out_of_the_folder_are_refused(own: Path, tmp_path: Path) -> None:
    secret = put(tmp_path, "elsewhere/header.h.jinja", "secret")
    (own / "c").mkdir()
    (own / HEADER).symlink_to(secret)
    says = r"header\.h\.jinja: a link out of"
    with pytest.raises(UnsupportedError, match=says), own_templates(str(own)):
        pass
    (own / HEADER).unlink()
    (own / "c").rmdir()
    (own / "c").symlink_to(secret.parent)
    with pytest.raises(UnsupportedError, match="a link to a folder"), own_templates(str(own)):
        pass


def test_a_link_inside_the_folder_is_followed(own: Path, robot: symdh.Robot) -> None:
    put(own, "shared.jinja", "ours")
    (own / "c").mkdir()
    (own / HEADER).symlink_to(own / "shared.jinja")
    assert header_with(own, robot) == "ours"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("{% for i in range(10**9) %}x{% endfor %}", "Range too big"),
        ("{{ 'x' * 10**11 }}", "too much memory"),
        ("{{ 9 ** (9 ** 9) }}", "a number would be too large"),
        ("{% set ns = namespace(x=7**9999) %}{{ ns.x * ns.x * ns.x * ns.x }}", "too large"),
        ('{% include "c/header.h.jinja" %}', "does one include itself?"),
        ("{% macro m() %}{{ m() }}{% endmacro %}{{ m() }}", "nested too deeply"),
        ("{{ '%1000000000d' | format(1) }}{{ '%3000000000d' | format(1) }}", "memory"),
    ],
)
def test_what_would_not_end_is_a_limit(text: str, says: str, own: Path, robot: symdh.Robot) -> None:
    put(own, HEADER, text)
    with pytest.raises(LimitError, match=re.escape(says)) as caught:
        header_with(own, robot)
    assert f"{own / HEADER}:1:" in str(caught.value)


def test_loops_end_at_a_time_limit(
    own: Path, robot: symdh.Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "TIME_LIMIT", 0.5)
    loop = "{% for i in range(99999) %}\n"
    put(own, HEADER, 3 * loop + 3 * "{% endfor %}")
    start = time.monotonic()
    with pytest.raises(LimitError, match=r"header.h.jinja:\d:1: .*did not end within 0.5 s"):
        header_with(own, robot)
    assert time.monotonic() - start < 5


def test_reading_ends_at_a_time_limit(
    own: Path, monkeypatch: pytest.MonkeyPatch, no_garbage: None
) -> None:
    monkeypatch.setattr(limits, "TIME_LIMIT", 0.05)
    path = put(own, HEADER, 50_000 * "{{ a + b }}\n")
    with (
        pytest.raises(LimitError, match=f"^{path}: the template takes too much to read$"),
        own_templates(str(own)),
    ):
        pass


def test_what_was_stopped_in_vain_is_stopped_again(
    monkeypatch: pytest.MonkeyPatch, no_garbage: None
) -> None:
    """An exception ends nothing where something catches it, as a collector of garbage does."""
    monkeypatch.setattr(limits, "TIME_LIMIT", 0.05)
    monkeypatch.setattr(limits, "_AGAIN", 0.05)
    start, caught = time.monotonic(), 0
    with pytest.raises(limits.OutOfTimeError), limits.limited():
        while time.monotonic() - start < 5:
            try:
                time.sleep(5)
            except limits.OutOfTimeError:
                caught += 1
                if caught == 2:
                    raise
    assert time.monotonic() - start < 2


def test_output_ends_at_a_length_limit(
    own: Path, robot: symdh.Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "LENGTH_LIMIT", 1_000_000)
    put(own, HEADER, "{% for i in range(99999) %}0123456789ab{% endfor %}")
    with pytest.raises(LimitError, match="writes over 1 million signs"):
        header_with(own, robot)


def test_limits_are_lifted_afterwards(own: Path, robot: symdh.Robot) -> None:
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_AS)
    put(own, HEADER, "{{ 'x' * 10**11 }}")
    refusal(own, robot)
    assert resource.getrlimit(resource.RLIMIT_AS) == before


def test_no_limit_of_memory_is_raised_or_guessed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A lower limit of the user's own stays, and a system that tells no size gets none."""
    changed: list[object] = []
    monkeypatch.setattr(resource, "setrlimit", lambda *arguments: changed.append(arguments))
    with monkeypatch.context() as lower:
        lower.setattr(resource, "getrlimit", lambda which: (1 << 20, 1 << 30))
        with limits.limited():
            pass
    with monkeypatch.context() as elsewhere:
        elsewhere.setattr(limits, "Path", lambda name: tmp_path / "no" / name.strip("/"))
        with limits.limited():
            pass
    assert changed == []


def test_templates_are_filled_in_threads_too(own: Path, robot: symdh.Robot) -> None:
    """The clock of a process is its main thread's alone; the result is the same."""
    put(own, HEADER, "/* {{ 6 * 7 }} */")
    found: list[str] = []
    thread = threading.Thread(target=lambda: found.append(header_with(own, robot)))
    thread.start()
    thread.join()
    assert found == [header_with(own, robot)]
    assert "42" in found[0]


def test_an_expression_that_is_nested_too_deeply(own: Path, robot: symdh.Robot) -> None:
    path = put(own, HEADER, "{{ " + "(" * 20_000 + "1" + ")" * 20_000 + " }}")
    assert refusal(own, robot).startswith(f"{path}:1:1: an expression is nested too deeply")


def test_a_name_made_at_run_time_may_mean_any_file(own: Path, robot: symdh.Robot) -> None:
    put(own, HEADER, '{% set part = "c/" ~ "note.txt.jinja" %}{% include part %}')
    put(own, "c/note.txt.jinja", "a note")
    with own_templates(str(own)) as loaded:
        assert generate(robot, "c")[0].text.strip() == "a note"
    assert not loaded.warnings


def test_hidden_files_are_left_alone(own: Path, robot: symdh.Robot) -> None:
    put(own, ".header.h.jinja", "{% broken")
    assert header_with(own, robot) == generate(robot, "c")[0].text


def test_a_folder_that_cannot_be_listed(own: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def scandir(path: object) -> None:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))

    monkeypatch.setattr(os, "scandir", scandir)
    with pytest.raises(ReadError, match=r"own: permission denied$"), own_templates(str(own)):
        pass


def test_a_folder_of_everything_is_refused(own: Path) -> None:
    for number in range(1001):
        (own / str(number)).touch()
    with pytest.raises(LimitError, match="is it a folder of templates"), own_templates(str(own)):
        pass


# -- symdh templates ------------------------------------------------------------------------------


def test_the_list_names_each_template_on_a_line(run_symdh: Runner) -> None:
    ran = run_symdh("templates")
    lines = ran.stdout.splitlines()
    paths = {
        path.relative_to(templates_dir()).as_posix()
        for path in templates_dir().rglob("*")
        if path.is_file() and "katex" not in path.parts
    }
    assert [line.split()[0] for line in lines] == sorted(paths)
    assert all(len(line.split()) > 3 for line in lines), "a name and what it is"


@pytest.mark.parametrize("name", list(shipped()))
def test_the_head_of_a_template_tells_its_variables(name: str) -> None:
    template = shipped()[name]
    assert len(template.summary) > 20, "the first line of the head says what the template is"
    if not template.is_filled_in:
        return
    tree = environment_for(name, None).parse(template.text)
    # Imported, defined or set outside the blocks and macros that use them.
    own = {"blocks", "laid_out", *re.findall(r"\bset (\w+)", template.text)}
    missing = {
        variable
        for variable in meta.find_undeclared_variables(tree) - own
        if not re.search(rf"\b{variable}\b", template.description)
    }
    assert missing == set()


def test_a_template_is_described(run_symdh: Runner) -> None:
    ran = run_symdh("templates", BODY)
    assert ran.stdout.startswith(f"{BODY}\n\nTitle and chapters of the handout")
    assert "chapters : list of (heading, items)" in ran.stdout


def test_templates_are_copied_and_give_the_same_bytes(
    tmp_path: Path, run_symdh: Runner, robot: symdh.Robot
) -> None:
    ran = run_symdh("templates", "--export", "copy")
    assert ran.returncode == 0
    document = derive(robot)
    before = render_latex(document), render_page(document, robot), generate(robot, "c")
    with own_templates(str(tmp_path / "copy")) as own:
        assert own.warnings == ()
        after = render_latex(document), render_page(document, robot), generate(robot, "c")
    assert after == before


def test_a_copy_is_never_replaced_unasked(tmp_path: Path, run_symdh: Runner) -> None:
    edited = put(tmp_path, f"own/{BODY}", "Written by symdh, edited by me")
    for names in ([BODY], ["latex"], []):
        ran = run_symdh("templates", "--export", "own", *names)
        assert ran.returncode == 3
        assert f"refuses to replace own/{BODY}" in ran.stderr
        assert [path for path in tmp_path.rglob("*") if path.is_file()] == [edited]
    assert edited.read_text() == "Written by symdh, edited by me"
    assert run_symdh("templates", "--export", "own", "latex", "--force").returncode == 0
    assert edited.read_text() == shipped()[BODY].text


def test_a_name_that_is_wrong_is_put_right(run_symdh: Runner) -> None:
    ran = run_symdh("templates", "latex/boddy.tex.jinja")
    assert (ran.returncode, ran.stdout) == (2, "")
    assert f"did you mean {BODY}?" in ran.stderr


# -- the example ----------------------------------------------------------------------------------

EXAMPLE = ROOT / "examples" / "templates"


def test_the_example_puts_a_course_above_and_a_licence_on_top(
    tmp_path: Path, run_symdh: Runner
) -> None:
    ran = run_symdh("derive", TABLE, "-o", "out", "--templates", EXAMPLE)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert r"University of Example \hfill" in (tmp_path / "out" / "planar_2r.tex").read_text()
    assert "<span>University of Example</span>" in (tmp_path / "out" / "planar_2r.html").read_text()
    for suffix in "hc":
        text = (tmp_path / "out" / f"planar_2r.{suffix}").read_text()
        assert text.startswith("/* Copyright Example Motion Ltd. Internal use only. */\n")
    again = run_symdh("derive", TABLE, "-o", "out", "--templates", EXAMPLE)
    assert again.stdout.count("(unchanged)") == 5


@pytest.mark.parametrize("engine", ["pdflatex", "typst"])
def test_the_head_of_the_example_is_on_the_paper(
    engine: str, tmp_path: Path, run_symdh: Runner
) -> None:
    if engine == "pdflatex":
        require_tool("pdflatex")
    options = ("--engine", engine, "--templates", EXAMPLE)
    ran = run_symdh("pdf", TABLE, "-o", "sheet.pdf", *options)
    assert ran.returncode == 0, ran.stderr
    text = subprocess.run(
        [require_tool("pdftotext"), "-layout", "sheet.pdf", "-"],
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout
    first = text.split("\n")[0]
    assert re.fullmatch(r"\s*University of Example\s+Robotics 1, winter term\s*", first)


def test_what_a_stray_name_costs_nothing() -> None:
    """A run without --templates does not even look for the limits of the sandbox."""
    code = "import sys, symdh.cli.program; print('jinja2' in sys.modules)"
    ran = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True
    )
    assert ran.stdout == "False\n"
    assert SYMDH.exists()


def test_a_defect_of_our_own_template_is_not_blamed_on_the_user() -> None:
    with pytest.raises(Exception, match="undefined") as caught:
        render("latex/document.tex.jinja")
    assert not isinstance(caught.value, SymdhError)
