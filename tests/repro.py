"""The same table gives the same bytes: `make repro`.

Derives tables over 32 hash seeds, in locale C, another time zone, folder and user, with both ground
types of sympy, and with every minor version of sympy and numpy that pyproject.toml allows, each in
a virtual environment of its own. Prints each environment beside the first, and names every file
that differs. Exit status 1 when one does.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = sorted((ROOT / "examples").glob("*.yaml"))
CORPUS = sorted((ROOT / "tests" / "data" / "tables").glob("*.yaml"))
SYMPY = ("1.12.*", "1.13.*", "1.14.*")
NUMPY = ("1.26.*", "2.0.*", "2.1.*", "2.2.*", "2.3.*", "2.4.*", "2.5.*")
#: With each version: the examples, and those tables of the corpus that differ most from them.
SOME = [path for path in CORPUS if path.stem in ("franka_panda", "kinova_jaco", "gantry_ppp_wrist")]

#: Run in the environment that is looked at: derives and shows each table, prints a digest of each.
WORKER = """
import contextlib, hashlib, io, json, os, sys
from pathlib import Path
from symdh.cli.main import run
digests = {}
for table in sys.argv[1:]:
    path = Path(table)
    out = Path("out", path.stem)
    printed = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    with contextlib.redirect_stdout(printed):
        status = run(["derive", str(path), "-o", str(out)])
        status = status or run(["show", str(path), "--format", "json"])
    if status:
        sys.exit(f"{path.name}: exit status {status}")
    contents = {each.name: each.read_bytes() for each in out.iterdir()}
    printed.flush()
    contents["printed"] = printed.buffer.getvalue()
    for name, content in contents.items():
        digests[f"{path.stem}/{name}"] = hashlib.sha256(content).hexdigest()
print(json.dumps(digests))
"""


@dataclass(frozen=True)
class Place:
    """An environment to derive in.

    Attributes
    ----------
    name : str
    variables : dict of str to str
        Of the environment.
    packages : tuple of str
        What is installed into a virtual environment for it; none is made where this is empty.
    """

    name: str
    variables: dict[str, str] = field(default_factory=dict)
    packages: tuple[str, ...] = ()


def digests(place: Place, tables: list[Path]) -> dict[str, str] | None:
    """Derive the tables in a place, in an empty folder; return a digest of each file.

    None when the packages cannot be had for this Python.
    """
    with tempfile.TemporaryDirectory() as folder:
        python = Path(sys.executable)
        if place.packages:
            python = Path(folder, "venv", "bin", "python")
            if not installed(python, place.packages):
                return None
        variables = {"COLUMNS": "80", "HOME": folder, "PYTHONDONTWRITEBYTECODE": "1"}
        work = Path(folder, "work")
        work.mkdir()
        ran = subprocess.run(
            [python, "-c", WORKER, *map(str, tables)],
            cwd=work,
            env={**os.environ, **variables, **place.variables},
            capture_output=True,
            text=True,
            check=False,
        )
    if ran.returncode != 0:
        raise RuntimeError(f"{place.name}: {ran.stderr.strip()}")
    result: dict[str, str] = json.loads(ran.stdout)
    return result


def surroundings(count: int) -> Iterator[Place]:
    """Give the places that differ in the hash seed, and the ones with another surrounding."""
    for seed in range(count):
        yield Place(f"hash seed {seed}", {"PYTHONHASHSEED": str(seed)})
    bare = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    yield Place("locale C", bare)
    yield Place("time zone Pacific/Kiritimati", {"TZ": "Pacific/Kiritimati"})
    yield Place("another user", {"USER": "someone", "LOGNAME": "someone"})


def versions(*, quick: bool) -> Iterator[Place]:
    """Give a place for each ground type and each version of sympy and of numpy."""
    yield Place("sympy without gmpy2", packages=("sympy",))
    yield Place("sympy with gmpy2", packages=("sympy", "gmpy2"))
    if not quick:
        for version in SYMPY[:-1]:
            yield Place(f"sympy {version}", packages=(f"sympy=={version}",))
        for version in NUMPY:
            yield Place(f"numpy {version}", packages=(f"numpy=={version}",))


def installed(python: Path, packages: tuple[str, ...]) -> bool:
    """Make a virtual environment with symdh and some packages, if they are to be had."""
    subprocess.run([sys.executable, "-m", "venv", python.parent.parent], check=True)
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    wanted = (["--only-binary", ":all:", *packages], ["--editable", str(ROOT)])
    return all(
        subprocess.run([*pip, *what], capture_output=True, check=False).returncode == 0
        for what in wanted
    )


def differing(first: dict[str, str], other: dict[str, str]) -> list[str]:
    """Name what is not the same in two places."""
    return sorted(name for name in first.keys() | other if first.get(name) != other.get(name))


def main() -> int:
    """Derive everywhere and compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=32)
    parser.add_argument("--quick", action="store_true", help="no other versions of sympy, numpy")
    options = parser.parse_args()
    failed = compared = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for tables, places in (
            (EXAMPLES, [*surroundings(options.seeds)]),
            (EXAMPLES + ([] if options.quick else SOME), [*versions(quick=options.quick)]),
        ):
            here = Place("here")
            first, *others = pool.map(lambda place, t=tables: digests(place, t), [here, *places])
            assert first is not None
            for place, other in zip(places, others, strict=True):
                if other is None:
                    print(f"{place.name:40} not to be had for this Python: left out")
                    continue
                compared += 1
                wrong = differing(first, other)
                failed += bool(wrong)
                verdict = f"{len(wrong)} differ: {', '.join(wrong[:5])}" if wrong else "the same"
                print(f"{place.name:40} {len(first)} files: {verdict}", flush=True)
    print(f"{failed} of {compared} places differ")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
