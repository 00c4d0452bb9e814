"""The package's own rules: who may import whom, and what may not be used at all."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "symdh"

#: From left to right; a part imports itself and layers to its left.
LAYERS = (
    {"errors", "robot", "mechanism", "resources", "_version"},
    {"table", "motion"},
    {"kinematics"},
    {"frames"},
    {"notation", "templating"},
    {"derivation", "codegen"},
    {"render"},
    {"interface"},
    {"__init__"},
    {"cli"},
    {"__main__"},
)
RANK = {part: rank for rank, layer in enumerate(LAYERS) for part in layer}

#: What touches the outside world, and the parts that may use it.
USERS = {
    "click": {"cli"},
    "yaml": {"table"},
    "jinja2": {"templating"},
    "subprocess": {"render", "codegen"},
    "numpy": set(),
}

FORBIDDEN = {"sympify", "parse_expr", "lambdify", "eval", "exec", "simplify", "trigsimp"}

MODULES = sorted(PACKAGE.rglob("*.py"))


def part_of(path: Path) -> str:
    """Return the part of the package that a module belongs to."""
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported(tree: ast.AST) -> Iterator[str]:
    """Yield the dotted names of all that a module imports, wherever the import stands."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports hide the layers"
            if node.module == "symdh":
                yield from (f"symdh.{alias.name}" for alias in node.names)
            else:
                yield str(node.module)


def layer_faults(part: str, source: str) -> list[str]:
    """Return the imports of a module of `part` that the layers forbid."""
    faults = []
    for name in imported(ast.parse(source)):
        top, _, rest = name.partition(".")
        if top == "symdh":
            other = rest.partition(".")[0]
            # What is no part is a public name, which comes from the package's __init__.
            rank = RANK.get(other, RANK["__init__"])
            own = other == part or (rank == 0 and RANK[part] == 0)
            if not own and rank >= RANK[part]:
                faults.append(name)
        elif part not in USERS.get(top, {part}):
            faults.append(name)
    return faults


def forbidden_names(source: str) -> set[str]:
    """Return the forbidden names that a module mentions in code, aliases of imports included."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name):
                found.add(name)
            case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
                found |= {part for alias in aliases for part in alias.name.split(".")}
    return found & FORBIDDEN


def test_every_part_has_its_place() -> None:
    assert {part_of(path) for path in MODULES} <= set(RANK)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_imports_point_to_the_left(path: Path) -> None:
    assert layer_faults(part_of(path), path.read_text()) == []


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_nothing_forbidden_is_used(path: Path) -> None:
    assert forbidden_names(path.read_text()) == set()


@pytest.mark.parametrize(
    ("part", "source", "faults"),
    [
        ("render", "from symdh.derivation import Document", []),
        ("derivation", "from symdh.render import FORMATS", ["symdh.render"]),
        ("derivation", "import symdh.codegen.names", ["symdh.codegen.names"]),
        ("codegen", "def f():\n    from symdh import derivation", ["symdh.derivation"]),
        ("motion", "from symdh.table import load_table", ["symdh.table"]),
        ("kinematics", "from symdh import loads", ["symdh.loads"]),
        ("robot", "from symdh.errors import SymdhError", []),
        ("robot", "import symdh.motion", ["symdh.motion"]),
        ("render", "import click", ["click"]),
        ("derivation", "from jinja2 import Environment", ["jinja2"]),
        ("codegen", "import numpy", ["numpy"]),
    ],
)
def test_the_rule_sees_what_breaks_it(part: str, source: str, faults: list[str]) -> None:
    assert layer_faults(part, source) == faults


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("eval('1')", {"eval"}),
        ("from sympy import simplify as tidy", {"simplify"}),
        ("matrix.applyfunc(sympy.trigsimp)", {"trigsimp"}),
        ("from sympy.parsing.sympy_parser import parse_expr", {"parse_expr"}),
        ("number.evalf(40)  # not eval", set()),
    ],
)
def test_the_ban_sees_what_breaks_it(source: str, names: set[str]) -> None:
    assert forbidden_names(source) == names
