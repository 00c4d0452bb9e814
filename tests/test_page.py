"""The web page, in a real browser: typeset, quiet, offline, and in step with the exact pose."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hostile import TITLES
from oracle import read_arm_file

from symdh.derivation.derive import derive
from symdh.render.page.page import render_page
from symdh.robot import Robot
from symdh.table import load_table
from tools import require_tool

EXAMPLES = Path(__file__).parent.parent / "examples"
ARMS = ("planar_2r_modified", "stanford", "puma560")

#: Moves every slider to a place of its own and says where it stands.
MOVE = """
<script>
const told = {};
document.querySelectorAll("#controls input[type=range]").forEach((input, k) => {
  const low = Number(input.min), high = Number(input.max);
  input.value = low + (high - low) * (0.2 + (0.37 * k) % 0.6);
  input.dispatchEvent(new Event("input"));
  told[input.id.replace("slider-", "")] = Number(input.value);
});
document.body.dataset.told = JSON.stringify(told);
</script>
</body>
"""


def page_of(name: str) -> tuple[Robot, str]:
    robot = load_table(str(EXAMPLES / f"{name}.yaml")).robot
    return robot, render_page(derive(robot), robot)


class Dom(HTMLParser):
    """Counts what the tests ask for in a rendered page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.formulas = self.typeset = self.errors = 0
        self.pose: list[float] = []
        self.told: dict[str, float] = {}
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        known = dict(attrs)
        classes = (known.get("class") or "").split()
        self.formulas += "data-tex" in known
        self.typeset += "katex" in classes
        self.errors += "katex-error" in classes
        if "data-pose" in known:
            self.pose = json.loads(known["data-pose"] or "")
        if "data-told" in known:
            self.told = json.loads(known["data-told"] or "")


def browse(page: str, folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    chromium = require_tool("chromium")
    file = folder / "page.html"
    file.write_text(page, encoding="utf-8")
    return subprocess.run(
        [
            chromium,
            *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
            *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
            f"--user-data-dir={folder / 'profile'}",
            "--enable-logging=stderr",
            "--virtual-time-budget=5000",
            *options,
            file.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )


@pytest.mark.parametrize("name", ARMS)
def test_every_formula_is_typeset_and_the_console_is_quiet(name: str, tmp_path: Path) -> None:
    _, page = page_of(name)
    ran = browse(page, tmp_path, "--dump-dom")
    dom = Dom(ran.stdout)
    assert dom.formulas > 50
    assert dom.typeset >= dom.formulas
    assert dom.errors == 0
    assert "CONSOLE" not in ran.stderr, ran.stderr


@pytest.mark.parametrize("name", ARMS)
def test_sliders_move_the_arm_as_the_oracle_does(name: str, tmp_path: Path) -> None:
    robot, page = page_of(name)
    dom = Dom(browse(page.replace("</body>", MOVE), tmp_path, "--dump-dom").stdout)
    assert set(dom.told) == {s.name for s in (*robot.variables, *robot.parameters)}
    arm = read_arm_file(EXAMPLES / f"{name}.yaml")
    expected = arm.pose(dom.told)
    assert [round(x, 9) for x in dom.pose] == pytest.approx(
        [float(x) for row in expected for x in row], abs=1e-8
    )


@pytest.mark.parametrize("name", ARMS)
def test_the_page_is_small_and_asks_for_nothing(name: str) -> None:
    _, page = page_of(name)
    assert len(page.encode()) < 700_000
    assert "default-src 'none'" in page
    fetched = re.findall(r"""(?:src|href)\s*=\s*["']([^"'#]+)""", page.split("<script>")[0])
    assert not fetched
    assert not re.findall(r"url\((?!data:)", page)


@pytest.mark.parametrize("width", [360, 1400])
def test_nothing_hangs_over_the_side(width: int, tmp_path: Path) -> None:
    """The page itself never scrolls sideways; wide formulas scroll in boxes of their own."""
    _, page = page_of("puma560")
    # Headless windows have a least width, so the page is put into a frame of the wanted one.
    probe = (
        "<script>document.body.dataset.told = JSON.stringify({over: "
        "document.documentElement.scrollWidth - document.documentElement.clientWidth});</script>"
        "</body>"
    )
    narrow = page.replace("<body>", f'<body style="max-width: {width}px">').replace(
        "</body>", probe
    )
    dom = Dom(browse(narrow, tmp_path, "--dump-dom", f"--window-size={max(width, 500)},900").stdout)
    assert dom.told["over"] <= 0


class Headings(HTMLParser):
    """Holds the title and the heading of a page, and what elements it has."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[str] = []
        self.texts = {"title": "", "h1": ""}
        self.open = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(tag)
        self.open = tag

    def handle_endtag(self, tag: str) -> None:
        self.open = ""

    def handle_data(self, data: str) -> None:
        if self.open in self.texts:
            self.texts[self.open] += data


def test_a_hostile_title_prints_as_text() -> None:
    robot = load_table(str(EXAMPLES / "planar_2r.yaml")).robot
    document = derive(robot)
    plain = Headings(render_page(document, robot))
    for title in TITLES:
        page = Headings(render_page(replace(document, title=title), replace(robot, title=title)))
        assert page.texts["h1"] == title
        assert title in page.texts["title"]
        assert page.elements == plain.elements
