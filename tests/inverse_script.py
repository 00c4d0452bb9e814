"""Generated inverse kinematics in JavaScript, MATLAB and Julia, run.

For node and Octave a driver asks for many poses in one process and prints a line for each: how many
answers, the joint values of all, and for each joint of each whether it is free. Julia's text is run
by the interpreter of `julia_subset`.
"""

from __future__ import annotations

import math
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from julia_subset import Module, julia_parser

from symdh.codegen import GeneratedFile
from tools import require_tool


@dataclass(frozen=True)
class Request:
    """A pose to reach, as `ik` takes it."""

    goal: np.ndarray
    seed: Sequence[float] | np.ndarray | None = None
    limits: bool = False


@dataclass(frozen=True)
class Reply:
    """Answers (count, n), and of each which joints are free."""

    q: np.ndarray
    free: np.ndarray


def write(files: Sequence[GeneratedFile], folder: Path) -> None:
    """Write generated files into a folder."""
    for file in files:
        (folder / file.name).write_text(file.text, encoding="utf-8")


def run(command: Sequence[str | Path], folder: Path) -> str:
    """Return what a program prints; it must print nothing on the other stream."""
    done = subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert (done.returncode, done.stderr) == (0, ""), done.stderr[:4000]
    return done.stdout


def javascript(
    stem: str, folder: Path, n: int, requests: Sequence[Request], values: Mapping[str, float]
) -> list[Reply]:
    """Ask the module of an arm."""
    asked = ",\n".join(
        f"  [{_rows(r.goal, '[', ']', 'Infinity')}, {{ seed: "
        f"{'null' if r.seed is None else _row(r.seed, 'Infinity')}, "
        f"limits: {str(r.limits).lower()}, ...values }}]"
        for r in requests
    )
    given = ", ".join(f"{name}: {value!r}" for name, value in values.items())
    script = f"""\
import {{ ik, ik_free }} from "./{stem}.mjs";
const values = {{ {given} }};
const asked = [
{asked},
];
for (const [T, options] of asked) {{
  const {{ q, free }} = ik_free(T, options);
  if (JSON.stringify(ik(T, options)) !== JSON.stringify(q)) throw new Error("ik is not ik_free");
  console.log(q.length, ...q.flat(), ...free.flat().map(Number));
}}
"""
    (folder / "ask.mjs").write_text(script, encoding="utf-8")
    return _replies(run([require_tool("node"), "ask.mjs"], folder), n, len(requests))


def matlab(
    stem: str, folder: Path, n: int, requests: Sequence[Request], values: Mapping[str, float]
) -> list[Reply]:
    """Ask the function file of an arm."""
    lines = ["1;\n", "p = struct();\n"]
    lines += [f"p.{name} = {value!r};\n" for name, value in values.items()]
    last = ", p" if values else ""
    for r in requests:
        seed = "[]" if r.seed is None else _row(r.seed, "Inf")
        goal = "[" + "; ".join(_row(row, "Inf") for row in r.goal) + "]"
        limits = str(r.limits).lower()
        lines.append(f"[q, free] = {stem}_ik({goal}, {seed}, {limits}{last});\n")
        lines.append("printf('%d ', size(q, 1)); printf('%.17g ', q'); printf('%d ', free');\n")
        lines.append("printf('\\n');\n")
    return _replies(octave("".join(lines), folder), n, len(requests))


def octave(script: str, folder: Path) -> str:
    """Run a script in Octave."""
    (folder / "ask.m").write_text(script, encoding="utf-8")
    return run([require_tool("octave-cli"), "--norc", "--no-history", "--quiet", "ask.m"], folder)


def julia(
    stem: str, folder: Path, n: int, requests: Sequence[Request], values: Mapping[str, float]
) -> list[Reply]:
    """Ask the module of an arm."""
    module = Module(julia_parser(), (folder / f"{stem}.jl").read_text(encoding="utf-8"))
    replies = []
    for r in requests:
        goal = np.array(r.goal, dtype=float)
        seed = None if r.seed is None else np.array(r.seed, dtype=float)
        q, free = module.call("ik_free", goal, seed=seed, limits=r.limits, **values)
        shape = (len(q), n)
        reply = Reply(np.array(q, dtype=float).reshape(shape), np.array(free, bool).reshape(shape))
        replies.append(reply)
    return replies


LANGUAGES = {"javascript": javascript, "matlab": matlab, "julia": julia}


def _number(x: float, infinity: str) -> str:
    if math.isnan(x):
        return "NaN"
    return repr(float(x)) if math.isfinite(x) else f"{'-' if x < 0 else ''}{infinity}"


def _row(values: Any, infinity: str) -> str:
    return "[" + ", ".join(_number(float(x), infinity) for x in values) + "]"


def _rows(matrix: np.ndarray, begin: str, end: str, infinity: str) -> str:
    return begin + ", ".join(_row(row, infinity) for row in matrix) + end


def _replies(output: str, n: int, count: int) -> list[Reply]:
    lines = output.splitlines()
    assert len(lines) == count
    replies = []
    for line in lines:
        first, *numbers = line.split()
        answers = int(first)
        assert len(numbers) == 2 * answers * n
        values = np.array(numbers, dtype=float).reshape(2, answers, n)
        assert set(values[1].ravel()) <= {0.0, 1.0}
        replies.append(Reply(values[0], values[1].astype(bool)))
    return replies
