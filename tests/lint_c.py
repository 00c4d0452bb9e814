"""`make lint-c`: compilers at their strictest and the linters over generated C of every table.

    python tests/lint_c.py [TABLE...]

Double and float, each with its batch functions and its inverse kinematics, on every core. Every
standard is tried as compilers come; where their options choose other lines of the kernel, one
standard of each compiler is. Exit status 1 with any finding. What is switched off contradicts
itself or the language.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import symdh
from symdh.codegen import generate

TABLES = Path(__file__).parent / "data" / "tables"

GCC = [
    *("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow"),
    *("-Wdouble-promotion", "-Wcast-align", "-Wcast-qual", "-Wfloat-conversion", "-Wformat=2"),
    *("-Wundef", "-Wwrite-strings", "-Wlogical-op", "-Wduplicated-cond", "-Wduplicated-branches"),
    *("-Wnull-dereference", "-Werror"),
]
GCC_C = ["-Wstrict-prototypes", "-Wmissing-prototypes", "-Wold-style-definition"]

CLANG_OFF = [
    "-Wno-declaration-after-statement",  # for C89; C99 has them
    "-Wno-unsafe-buffer-usage",  # forbids every array argument
    "-Wno-padded",  # remarks on the layout of structs
    "-Wno-unknown-warning-option",  # a clang that has not heard of one of these
]
CLANG_CPP_OFF = [
    "-Wno-c++98-compat-pedantic",  # one file serves C++98 to C++20
    "-Wno-old-style-cast",  # C has no other
    "-Wno-zero-as-null-pointer-constant",  # C has no nullptr
]
C = ("c99", "c11", "c17", "c2x")
CPP = ("c++98", "c++11", "c++14", "c++17", "c++20")
MODES = ([], ["-mavx"], ["-mavx512f"], ["-U__SSE2__"], ["-ffast-math"])

TIDY = (
    "-*,bugprone-*,cert-*,clang-analyzer-*,misc-*,performance-*,portability-*,"
    # Any two lengths side by side are a finding; they are what the function is about.
    "-bugprone-easily-swappable-parameters"
)
CPPCHECK = [
    "--enable=warning,style,performance,portability",
    "--inline-suppr",
    "--suppress=missingIncludeSystem",
    "--suppress=unusedFunction",  # who calls them is not in the file
    "--suppress=misra-c2012-8.7",  # the same
    "--suppress=misra-c2012-2.5",  # the macros of the header are for whoever includes it
    "--error-exitcode=1",
]


def commands(source: Path) -> Iterator[list[str]]:
    """Yield every check of one source; those whose program is missing are left out."""
    file = str(source)
    # Several sources of one folder are checked at the same time.
    out = ["-c", file, "-o", os.devnull]
    for mode in MODES:
        for standard in C if not mode else C[:1]:
            yield ["gcc", f"-std={standard}", "-O2", *GCC, *GCC_C, *mode, *out]
        for standard in CPP if not mode else CPP[-1:]:
            yield ["g++", "-x", "c++", f"-std={standard}", "-O2", *GCC, *mode, *out]
        clang = ["-O2", "-Weverything", "-Werror", *CLANG_OFF, *mode, *out]
        yield ["clang", "-std=c99", *clang]
        for standard in (CPP[0], CPP[-1]) if not mode else CPP[-1:]:
            yield ["clang++", "-x", "c++", f"-std={standard}", *CLANG_CPP_OFF, *clang]
    yield ["clang-tidy", "--quiet", f"--checks={TIDY}", "--warnings-as-errors=*", file, "--"]
    yield ["cppcheck", "--quiet", "--std=c99", "--addon=misra", *CPPCHECK, file]


def findings(source: Path, *, only: Sequence[str] = ()) -> list[str]:
    """Return what the checks of one source have to say."""
    found = []
    for command in commands(source):
        if shutil.which(command[0]) is None or (only and command[0] not in only):
            continue
        done = subprocess.run(
            command, cwd=source.parent, capture_output=True, text=True, check=False
        )
        if done.returncode != 0:
            found.append(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return found


def write_sources(table: Path, folder: Path) -> list[Path]:
    """Write double and float, each with its batch functions."""
    robot = symdh.load(table)
    sources = []
    for precision in ("double", "float"):
        for file in generate(robot, "c", precision=precision, batch=True):
            (folder / file.name).write_text(file.text)
        sources.append(folder / file.name)
    return sources


def checked(table: Path) -> list[str]:
    """Return what the checks of both sources of a table have to say."""
    with tempfile.TemporaryDirectory() as name:
        return [f for source in write_sources(table, Path(name)) for f in findings(source)]


def main(names: Sequence[str]) -> int:
    """Check the tables that are named, or all."""
    for program in ("gcc", "g++", "clang", "clang++", "clang-tidy", "cppcheck"):
        if shutil.which(program) is None:
            print(f"{program} is not installed, left out")
    tables = [Path(name) for name in names] or sorted(TABLES.glob("*.yaml"))
    with ProcessPoolExecutor() as pool:
        results = pool.map(checked, tables)
        failed = sum(map(_told, tables, results))
    print(f"{failed} of {len(tables)} tables with findings")
    return 1 if failed else 0


def _told(table: Path, found: list[str]) -> bool:
    """Print what was found in a table, and say whether that was anything."""
    print(f"{table.stem}: {len(found) or 'no'} finding{'' if len(found) == 1 else 's'}")
    for text in found:
        print(text[:3000])
    sys.stdout.flush()
    return bool(found)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
