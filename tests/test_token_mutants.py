"""Change any one token of a generated function, and the numeric oracle notices.

Says that the oracle looks at every entry, and that no generated line is without effect.
"""

from __future__ import annotations

import ctypes
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from oracle import read_arm_file

import symdh
from symdh.codegen import generate
from tools import require_tool

TABLES = Path(__file__).parent / "data" / "tables"
TOKEN = re.compile(r"\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|[A-Za-z_]\w*|\S")
OTHER_OPERATOR = {"+": "-", "-": "+", "*": "+", "/": "*"}
OTHER_FUNCTION = {"sin": "cos", "cos": "sin"}
#: Names that say what something is; another one would not compile.
WORDS = {"const", "double", "void", "q", "p", "T"}
POSES = 5


def function_body(source: str, name: str) -> str:
    """Return what stands between the braces of a function."""
    head = source.index(f"void {name}(")
    start = source.index("{", head) + 1
    return source[start : source.index("\n}", start)]


def mutants(body: str) -> Iterator[tuple[str, str]]:
    """Give what was changed, and the body with that change, for every token that has another."""
    declared: list[str] = []
    for line in re.finditer(r"[^;]*;", body):
        declares = re.search(r"double (\w+) =", line[0])
        for token in TOKEN.finditer(body, line.start(), line.end()):
            other = replacement(token[0], declared, declares)
            if other is not None and other != token[0]:
                what = f"{token[0]} -> {other} in {line[0].strip()}"
                yield what, body[: token.start()] + other + body[token.end() :]
        if declares:
            declared.append(declares[1])


def replacement(token: str, declared: list[str], declares: re.Match[str] | None) -> str | None:
    """Return what could stand in the place of a token; None where nothing else would compile."""
    if token in OTHER_OPERATOR:
        return OTHER_OPERATOR[token]
    if token in OTHER_FUNCTION:
        return OTHER_FUNCTION[token]
    if token[0].isdigit():
        return f"{float(token) + 1}" if "." in token else f"{1 - int(token) % 2}"
    if token in declared:
        others = [name for name in declared if name != token]
        return others[-1] if others else "0.25"
    return None


@pytest.mark.parametrize("robot", ["planar_2r", "scara_rrpr", "puma560"])
def test_the_oracle_kills_every_single_token_mutant(robot: str, tmp_path: Path) -> None:
    table = TABLES / f"{robot}.yaml"
    arm = read_arm_file(table)
    header, source = generate(symdh.load(table), "c", trig="libm")
    (tmp_path / header.name).write_text(header.text)
    stem = Path(header.name).stem
    body = function_body(source.text, f"{stem}_fk")
    changes, bodies = zip(*mutants(body), strict=True)
    assert len(changes) > 40
    run = compiled(stem, header.text, [body, *bodies], tmp_path)

    q = arm.seeded_poses(POSES, seed=1)
    names = [name for name, _ in arm.variables]
    parameters = {name: 0.3 + 0.1 * k for k, name in enumerate(arm.parameters())}
    expected = arm.pose({**dict(zip(names, q.T, strict=True)), **parameters}).astype(float)
    worst = [
        np.abs(run(place, q, list(parameters.values())) - expected).max()
        for place in range(len(bodies) + 1)
    ]
    tolerance = arm.tolerance(parameters)
    assert worst[0] <= tolerance
    # NaN, from an entry that was never written, is not within any tolerance.
    survivors = [
        change for change, error in zip(changes, worst[1:], strict=True) if error <= tolerance
    ]
    assert survivors == []


def compiled(stem: str, header: str, bodies: list[str], folder: Path):  # type: ignore[no-untyped-def]
    """Compile functions that differ in their bodies; return what calls one on some poses."""
    gcc = require_tool("gcc")
    head = re.search(rf"void {stem}_fk\(([^;]*)\);", header)
    assert head is not None
    functions = [f"void f{k}({head[1]})\n{{{body}\n}}\n" for k, body in enumerate(bodies)]
    text = f'#include "{stem}.h"\n#include <math.h>\n' + "".join(functions)
    source, library = folder / "mutants.c", folder / "mutants.so"
    source.write_text(text)
    subprocess.run([gcc, "-w", "-shared", "-fPIC", source, "-o", library, "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    as_double = ctypes.POINTER(ctypes.c_double)

    def run(place: int, q: np.ndarray, parameters: list[float]) -> np.ndarray:
        poses = np.full((len(q), 16), np.nan)
        between = [(ctypes.c_double * len(parameters))(*parameters)] if parameters else []
        for joints, pose in zip(np.ascontiguousarray(q), poses, strict=True):
            getattr(loaded, f"f{place}")(
                joints.ctypes.data_as(as_double), *between, pose.ctypes.data_as(as_double)
            )
        return poses.reshape(-1, 4, 4)

    return run
