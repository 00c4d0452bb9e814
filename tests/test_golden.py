"""Everything that symdh writes for the examples, byte for byte; `make golden` renews it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from conftest import Runner

from symdh.render.page.katex import katex_script, katex_style

ROOT = Path(__file__).parent.parent
GOLDEN = Path(__file__).parent / "golden"
EXAMPLES = sorted((ROOT / "examples").glob("*.yaml"))


def everything(example: Path, folder: Path, run_symdh: Runner) -> dict[str, str]:
    """Files of `derive`, and what `derive` and `show` print, by file name."""
    show = ["show", example, "--format"]
    commands = {
        "derive.txt": ["derive", example, "-o", "."],
        "show.txt": [*show, "text"],
        "show.json": [*show, "json"],
        "show.tex": [*show, "latex"],
    }
    texts = {}
    for name, command in commands.items():
        ran = run_symdh(*command, cwd=folder, env={"COLUMNS": "80"})
        assert (ran.returncode, ran.stderr) == (0, ""), ran.stderr
        texts[name] = ran.stdout
    for path in folder.iterdir():
        texts[path.name] = without_katex(path.read_text(encoding="utf-8"))
    return texts


def without_katex(text: str) -> str:
    """Leave out what every page carries and no change of ours changes: half a megabyte of KaTeX."""
    return text.replace(katex_script(), "").replace(katex_style(), "")


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_the_output_is_the_golden_one(
    example: Path, tmp_path: Path, run_symdh: Runner, update_golden: bool
) -> None:
    texts = everything(example, tmp_path, run_symdh)
    folder = GOLDEN / example.stem
    if update_golden:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8", newline="\n")
    golden = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    assert set(texts) == set(golden)
    for name, text in texts.items():
        assert text == golden[name], f"{example.stem}/{name}: run `make golden` and read the diff"


def test_every_golden_folder_has_its_example() -> None:
    assert {path.name for path in GOLDEN.iterdir()} == {path.stem for path in EXAMPLES}
