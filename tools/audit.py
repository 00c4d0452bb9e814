"""Check what symdh is made of beyond its own code: `make audit`.

Without a network: every package of requirements-ci.txt is pinned to one release and has hashes,
and is asked for by pyproject.toml or by something that is; what is installed, and what is locked,
lies within the ranges of pyproject.toml; the package imports nothing that it does not declare; and
what a user installs with it has a licence that lets it be used anywhere. With a network: pip-audit
looks the locked releases up among the known vulnerabilities. Exit status 1 when something is wrong.
"""

from __future__ import annotations

import ast
import json
import re
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from packaging.markers import default_environment
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parent.parent
LOCK = ROOT / "requirements-ci.txt"
PROJECT = ROOT / "pyproject.toml"
OURSELVES = "symdh"
#: Licences that ask for nothing but their own text to be kept.
PERMISSIVE = re.compile(r"\b(MIT|BSD|Apache|ISC|PSF|Python Software Foundation)\b", re.IGNORECASE)
#: Where a distribution is imported by another name.
IMPORTED_AS = {"pyyaml": "yaml"}
#: Imported though not declared: another dependency hands out its objects and requires it.
BROUGHT_BY = {"mpmath": "sympy", "markupsafe": "jinja2"}


@dataclass(frozen=True)
class Locked:
    """A release in the lock file.

    Attributes
    ----------
    requirement : Requirement
    hashes : int
        How many files of it are known.
    wanted_by : tuple of str
        The packages that ask for it, this project as ``symdh``.
    """

    requirement: Requirement
    hashes: int
    wanted_by: tuple[str, ...]

    @property
    def name(self) -> str:
        """The name in the one way that compares."""
        return canonicalize_name(self.requirement.name)


def read_lock(text: str) -> list[Locked]:
    """Read the lock file: requirements with their hashes, then what wants them in comments."""
    locked = []
    for part in re.split(r"^(?=[A-Za-z0-9])", text, flags=re.MULTILINE)[1:]:
        line = part.split("\\\n", 1)[0].split("\n", 1)[0].strip()
        comments = " ".join(re.findall(r"^    #\s*(?:via)?(.*)$", part, re.MULTILINE))
        wanted_by = tuple(comments.replace("(pyproject.toml)", "").split())
        locked.append(Locked(Requirement(line), part.count("--hash=sha256:"), wanted_by))
    return locked


def declared() -> dict[str, list[Requirement]]:
    """Return what pyproject.toml asks for: under '' at run time, and by the name of an extra."""
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    groups = {"": project["dependencies"], **project["optional-dependencies"]}
    return {name: [Requirement(each) for each in group] for name, group in groups.items()}


def unpinned(locked: list[Locked]) -> Iterator[str]:
    """Say what is not one release, or has no hash."""
    for each in locked:
        pins = [(pin.operator, "*" in pin.version) for pin in each.requirement.specifier]
        if pins != [("==", False)]:
            yield f"{each.requirement} is not pinned to one release"
        if not each.hashes:
            yield f"{each.requirement} has no hash"


def unwanted(locked: list[Locked]) -> Iterator[str]:
    """Say what is locked though nothing asks for it."""
    reached, before = {OURSELVES}, set()
    while reached != before:
        before = set(reached)
        reached |= {each.name for each in locked if reached & set(each.wanted_by)}
    yield from (f"{each.name}: nothing asks for it" for each in locked if each.name not in reached)


def out_of_range(locked: list[Locked]) -> Iterator[str]:
    """Say what pyproject.toml asks for and the lock file lacks, or has outside the range."""
    for wanted in (each for group in declared().values() for each in group):
        if not wanted.specifier or not re.search(r"<|==|~=", str(wanted.specifier)):
            yield f"{wanted}: the range in pyproject.toml is open"
        pins = [
            pin.version
            for each in locked
            if each.name == canonicalize_name(wanted.name)
            for pin in each.requirement.specifier
        ]
        if not pins:
            yield f"{wanted.name}: not in the lock file"
        for version in pins:
            if version not in wanted.specifier:
                yield f"{wanted.name} {version} is locked, outside {wanted.specifier}"


def installed_out_of_range() -> Iterator[str]:
    """Say which installed run-time dependency lies outside the range that is asked for."""
    for name, wanted in run_time():
        version = metadata.version(name)
        if version not in wanted.specifier:
            yield f"{name} {version} is installed, outside {wanted.specifier}"


def run_time() -> Iterator[tuple[str, Requirement]]:
    """Give what a user installs with symdh, what that needs included."""
    waiting, seen = list(declared()[""]), set()
    environment = {**default_environment(), "extra": ""}
    while waiting:
        wanted = waiting.pop(0)
        name = canonicalize_name(wanted.name)
        if wanted.marker and not wanted.marker.evaluate(environment):
            continue
        yield name, wanted
        if name not in seen:
            seen.add(name)
            waiting += map(Requirement, requires(name))


def requires(name: str) -> list[str]:
    """Return what an installed distribution asks for."""
    return metadata.requires(name) or []


def undeclared(package: Path = ROOT / OURSELVES) -> Iterator[str]:
    """Say which module is imported that is neither Python's, ours nor declared."""
    groups = declared()
    names = {canonicalize_name(each.name) for each in [*groups[""], *groups["pdf"]]}
    allowed = {IMPORTED_AS.get(name, name) for name in names} | {OURSELVES, *BROUGHT_BY}
    for module, carrier in BROUGHT_BY.items():
        if module not in {canonicalize_name(Requirement(each).name) for each in requires(carrier)}:
            yield f"{carrier} no longer requires {module}"
    for path in sorted(package.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_bytes())):
            modules: list[str] = []
            if isinstance(node, ast.Import):
                modules = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and not node.level:
                modules = [node.module or ""]
            for top in sorted({module.split(".", 1)[0] for module in modules}):
                if top not in allowed | sys.stdlib_module_names:
                    yield f"{path.relative_to(package.parent)} imports {top}"


def unlicensed() -> Iterator[str]:
    """Say which run-time dependency has a licence that is not known to be permissive."""
    for name in sorted({name for name, _ in run_time()}):
        about = metadata.metadata(name)
        said = [about.get("License-Expression") or "", *(about.get_all("Classifier") or [])]
        said = [each for each in said if each and ("::" not in each or "License ::" in each)]
        said.append((about.get("License") or "")[:60])
        if not any(PERMISSIVE.search(each) for each in said):
            yield f"{name}: licence not known: {' '.join(said).strip() or 'none given'}"


def vulnerabilities() -> tuple[list[str], str]:
    """Ask pip-audit; return what it found, and why it could not be asked."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        python = Path(folder, "bin", "python")
        install = [python, "-m", "pip", "install", "--quiet", "pip-audit>=2.7,<3"]
        if subprocess.run(install, capture_output=True, check=False).returncode != 0:
            return [], "pip-audit cannot be installed here"
        asked = [python, "-m", "pip_audit", "--disable-pip", "--require-hashes", "--format=json"]
        asked += ["--progress-spinner=off", "--timeout=15", "--requirement", LOCK]
        ran = subprocess.run(asked, capture_output=True, text=True, check=False)
    try:
        answer = json.loads(ran.stdout)
    except ValueError:
        said = ran.stderr.strip().splitlines()
        return [], f"no vulnerability service can be reached ({said[-1][:70] if said else '?'})"
    return [
        f"{each['name']} {each['version']}: {flaw['id']}"
        for each in answer["dependencies"]
        for flaw in each.get("vulns", ())
    ], ""


def main() -> int:
    """Print each check with what it found."""
    locked = read_lock(LOCK.read_text(encoding="utf-8"))
    checks: list[tuple[str, Callable[[], Iterator[str]]]] = [
        (f"{len(locked)} releases pinned, with hashes", lambda: unpinned(locked)),
        ("each is asked for", lambda: unwanted(locked)),
        ("locked within the ranges", lambda: out_of_range(locked)),
        ("installed within the ranges", installed_out_of_range),
        ("every import declared", undeclared),
        ("licences permissive", unlicensed),
    ]
    wrong = 0
    for what, check in checks:
        found = list(check())
        wrong += len(found)
        print(f"{what:36} {'; '.join(found) or 'yes'}", flush=True)
    found, why_not = vulnerabilities()
    wrong += len(found)
    print(f"{'no known vulnerability':36} {why_not or '; '.join(found) or 'yes'}")
    print(f"audit: {wrong} wrong" + (", vulnerabilities not looked up" if why_not else ""))
    return min(wrong, 1)


if __name__ == "__main__":
    sys.exit(main())
