"""The generated Python extension: built, installed, called, and compared with the oracles."""

from __future__ import annotations

import gc
import importlib.util
import math
import os
import re
import subprocess
import sys
import sysconfig
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from generated import STRICT_C
from test_codegen import (
    HOSTILE_PARAMETERS,
    PUMA,
    SCARA,
    STILL,
    STILL_NUMBERS,
    assert_poses,
    open_parameters,
    random_joints,
    write_all,
)
from test_codegen_jacobian import column_tolerances, exact_results

from symdh.codegen import generate
from symdh.robot import Robot
from tools import require_tool

ROBOTS = [PUMA, SCARA, STILL, STILL_NUMBERS, replace(HOSTILE_PARAMETERS, name="hostile names")]


def build(robot: Robot, folder: Path, **options: object) -> ModuleType:
    """Compile the extension with all warnings, as setup.py does without them, and import it."""
    gcc = require_tool("gcc")
    write_all(generate(robot, "python-ext", **options), folder)
    (source,) = folder.glob("*_ext.c")
    built = folder / f"{source.stem}{sysconfig.get_config_var('EXT_SUFFIX')}"
    # What the headers of Python and NumPy warn of themselves is theirs.
    includes = ["-isystem", sysconfig.get_paths()["include"], "-isystem", np.get_include()]
    # CPython's slots hold a function in a pointer to data, which -Wpedantic does not like.
    warnings = [flag for flag in STRICT_C if flag != "-Wpedantic"]
    command = [gcc, "-std=c11", "-O2", *warnings, "-shared", "-fPIC"]
    sources = [str(source), str(source).replace("_ext.c", ".c")]
    ran = subprocess.run(
        [*command, *includes, *sources, "-o", str(built), "-lm"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ran.returncode, ran.stderr) == (0, "")
    spec = importlib.util.spec_from_file_location(source.stem, built)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def scara(tmp_path_factory: pytest.TempPathFactory) -> ModuleType:
    return build(SCARA, tmp_path_factory.mktemp("scara"))


def keywords(function: Callable[..., Any]) -> list[str]:
    """The parameters that a function needs, as its signature has them."""
    text = str(function.__text_signature__)
    return re.findall(r"\w+", text.partition("*")[2])


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)
def test_extension_agrees_with_the_oracle(robot: Robot, tmp_path: Path) -> None:
    module = build(robot, tmp_path)
    q = random_joints(robot)[:4]
    names = keywords(module.fk)
    given = dict(zip(names, open_parameters(robot), strict=True))
    assert len(robot.variables) == module.N_JOINTS
    assert_poses(robot, q, module.fk(q, **given))
    if not robot.variables:
        assert not hasattr(module, "jacobian")
        return
    expected = [exact_results(robot, row)[1] for row in q[:2]]
    T, J = module.fk_jacobian(q, **given)
    assert_poses(robot, q, T)
    for found in (J[:2], module.jacobian(q[:2], **given)):
        assert (np.abs(found - expected) <= column_tolerances(robot, q[:2])).all()


def test_extension_takes_what_the_module_takes(scara: ModuleType) -> None:
    q = np.linspace(-1.0, 1.0, 24).reshape(2, 3, 4)
    T, J = scara.fk_jacobian(q)
    assert (T.shape, J.shape) == ((2, 3, 4, 4), (2, 3, 6, 4))
    one = scara.fk(q[1, 2])
    assert np.abs(one - T[1, 2]).max() < 1e-15
    for same in (q[1, 2].tolist(), tuple(q[1, 2]), np.asfortranarray(q), q[..., ::-1][..., ::-1]):
        found = scara.fk(same)
        assert (found if found.ndim == 2 else found[1, 2]).tolist() == one.tolist()
    assert (scara.fk([0, 0, 0, 0]) == scara.fk(np.zeros(4, dtype=np.float32))).all()
    assert scara.fk(np.zeros((0, 4))).shape == (0, 4, 4)
    assert (scara.fk(q=q) == scara.fk(q, None)).all()


def test_extension_fills_what_it_is_given(scara: ModuleType) -> None:
    q = np.linspace(-1.0, 1.0, 8).reshape(2, 4)
    T, J = np.full((2, 4, 4), np.nan), np.full((2, 6, 4), np.nan)
    assert scara.fk(q, T) is T
    assert (scara.fk(q) == T).all()
    assert scara.jacobian(q, out=J) is J
    filled = scara.fk_jacobian(q, out=(T, J))
    assert filled[0] is T
    assert filled[1] is J


@pytest.mark.parametrize(
    ("arguments", "named", "message"),
    [
        ((), {}, r"fk\(\) missing the argument 'q'"),
        ((0.0,), {}, r"q must have shape \(\.\.\., 4\), not \(\)"),
        (([0.0] * 3,), {}, r"q must have shape \(\.\.\., 4\), not \(3,\)"),
        ((["a"] * 4,), {}, "could not convert string"),
        (([0.0] * 4, None, 1.0), {}, "takes q and out by position"),
        (([0.0] * 4,), {"a1": 1.0}, "unexpected keyword argument 'a1'"),
        (([0.0] * 4,), {"q": 1.0}, "multiple values for argument 'q'"),
        (([0.0] * 4, np.zeros((2, 4, 4))), {}, r"end in \(4, 4\)"),
        (([0.0] * 4, np.zeros((4, 4), np.float32)), {}, "writable C-contiguous array of float64"),
        (([0.0] * 4, np.zeros((4, 8))[:, ::2]), {}, "writable C-contiguous array of float64"),
        (([0.0] * 4, [[0.0] * 4] * 4), {}, "writable C-contiguous array of float64"),
    ],
)
def test_extension_says_what_is_wrong(
    arguments: tuple[Any, ...], named: dict[str, Any], message: str, scara: ModuleType
) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        scara.fk(*arguments, **named)


def test_extension_never_writes_what_is_read_only(scara: ModuleType) -> None:
    locked = np.zeros((4, 4))
    locked.flags.writeable = False
    with pytest.raises(TypeError, match="writable"):
        scara.fk([0.0] * 4, locked)
    with pytest.raises(TypeError, match=r"out must be a tuple \(T, J\)"):
        scara.fk_jacobian([0.0] * 4, out=np.zeros((4, 4)))
    assert not locked.any()


def test_extension_needs_what_the_table_leaves_open(tmp_path: Path) -> None:
    module = build(PUMA, tmp_path)
    with pytest.raises(TypeError, match="missing the argument 'd4'"):
        module.fk(np.zeros(6))
    with pytest.raises(TypeError, match="must be real number"):
        module.fk(np.zeros(6), d4="long")
    assert module.fk(np.zeros(6), d4=0.5)[2, 3] == pytest.approx(0.5)
    assert ">>> T = fk(np.zeros(6), d4=1.0)" in str(module.__doc__)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_extension_gives_nan_for_what_is_no_angle(bad: float, scara: ModuleType) -> None:
    pose = scara.fk([0.1, bad, 0.05, 0.3])
    assert np.isnan(pose[:2, :2]).all()
    assert (pose[3] == [0.0, 0.0, 0.0, 1.0]).all()


def test_extension_keeps_no_memory(scara: ModuleType) -> None:
    """Neither references nor blocks stay behind, whatever way a call ends."""
    q, T, J = np.zeros((3, 4)), np.zeros((3, 4, 4)), np.zeros((3, 6, 4))
    numbers = [0.25, 0.5, 0.75, 1.5]

    def call() -> None:
        for arguments in ((q,), (numbers,), (q[:, ::-1],), (q, T), ([[0, 0, 0, 0]],)):
            scara.fk(*arguments)
        scara.fk_jacobian(q, out=(T, J))
        for wrong in ((q, J), (q[:, :3],), (["a"] * 4,), (numbers, None, 0)):
            with pytest.raises((TypeError, ValueError)):
                scara.fk(*wrong)
        with pytest.raises(ValueError, match="end in"):
            scara.fk_jacobian(q, out=(T, T))

    held = (q, T, J, numbers, *numbers)
    for _ in range(3):
        call()
    counts = [sys.getrefcount(each) for each in held]
    gc.collect()
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(200):
        call()
    gc.collect()
    grown = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert [sys.getrefcount(each) for each in held] == counts
    assert grown < 20_000


def test_extension_is_installed_by_pip(tmp_path: Path) -> None:
    require_tool("gcc")
    project, target = tmp_path / "project", tmp_path / "target"
    project.mkdir()
    write_all(generate(SCARA, "python-ext"), project)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    ran = subprocess.run(
        [*pip, "--no-build-isolation", "--target", str(target), str(project)],
        capture_output=True,
        text=True,
        env={**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1"},
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    check = "import SCARA_ext as m; print(m.fk([0.0] * 4)[0, 3])"
    ran = subprocess.run(
        [sys.executable, "-c", check],
        cwd=target,
        capture_output=True,
        text=True,
        check=True,
    )
    assert float(ran.stdout) == pytest.approx(1 / 4 + 1 / 3)
    (told,) = target.glob("*.dist-info")
    assert (told / "METADATA").read_text().count("numpy>=1.23") == 1
