"""Change the package at random places and see whether the tests notice: `python mutation.py`.

Draws places in table, motion, kinematics and codegen with a fixed seed, makes one small change at
each (an operator, a comparison, a number, a condition, a result), and runs the tests of that layer
on a copy of the tree until one fails. Prints each survivor, to be read, and the part that was
killed. `--count` says how many places, `--layer` and `--module` where.
"""

from __future__ import annotations

import argparse
import ast
import copy
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from queue import Queue

ROOT = Path(__file__).resolve().parent.parent
GOAL = 90
PYTEST = ("-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist")

#: The tests of each layer, the quickest to fail first.
TESTS = {
    "table": (
        "expression",
        "table",
        "bad_inputs",
        "tabular",
        "urdf",
        "frames",
        "rotation",
        "answer",
    ),
    "motion": ("motion", "kinematics", "lectures", "random_tables"),
    "kinematics": (
        "kinematics",
        "velocity",
        "singularity",
        "task",
        "rotation",
        "inverse",
        "answer",
    ),
    "codegen": ("codegen", "codegen_jacobian", "token_mutants", "golden", "targets"),
}
#: Narrower choices, by folder or module.
NARROWER = {
    "kinematics/inverse": ("inverse", "codegen_inverse"),
    "kinematics/singular": ("singularity",),
    "kinematics/task": ("task",),
    "kinematics/rotation": ("rotation",),
    "kinematics/answers": ("answer",),
    "codegen/inverse": ("codegen_inverse",),
    "codegen/jacobian": ("codegen_jacobian",),
    "table/answers": ("answer",),
    "table/urdf": ("urdf",),
    "table/xml": ("urdf",),
    "table/axes": ("frames",),
    "table/rotations": ("rotation",),
}

_ARITHMETIC: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Add,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.BitOr: ast.BitAnd,
    ast.BitAnd: ast.BitOr,
    ast.Pow: ast.Mult,
}
_COMPARISONS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}


@dataclass(frozen=True)
class Mutant:
    """A changed module.

    Attributes
    ----------
    module : Path
        In the package.
    line : int
    before, after : str
        The changed statement or expression.
    text : str
        The whole module.
    """

    module: Path
    line: int
    before: str
    after: str
    text: str

    def __str__(self) -> str:
        return f"{self.module}:{self.line}: {self.before}  ->  {self.after}"


def changed(node: ast.AST) -> ast.AST | None:
    """Return a node with one small change, None where there is none to make."""
    other = copy.deepcopy(node)
    match other:
        case ast.BinOp(op=op) if type(op) in _ARITHMETIC:
            other.op = _ARITHMETIC[type(op)]()
        case ast.Compare(ops=[op]):
            other.ops = [_COMPARISONS[type(op)]()]
        case ast.BoolOp(op=op):
            other.op = ast.Or() if isinstance(op, ast.And) else ast.And()
        case ast.UnaryOp(op=ast.Not() | ast.USub()):
            return other.operand
        case ast.Constant(value=bool() as value):
            other.value = not value
        case ast.Constant(value=int() as value):
            other.value = value + 1
        case ast.IfExp():
            other.body, other.orelse = other.orelse, other.body
        case ast.If():
            other.test = ast.UnaryOp(ast.Not(), other.test)
        case ast.Return(value=ast.expr() as value) if not isinstance(value, ast.Constant):
            other.value = ast.Constant(None)
        case ast.Expr(value=ast.Call()):
            return ast.Pass()
        case ast.Continue():
            return ast.Break()
        case _:
            return None
    return other


def places(tree: ast.Module) -> Iterator[tuple[ast.AST, str, int | None, ast.AST]]:
    """Give each place that can change: its parent, field and index there, and the node."""
    waiting: list[ast.AST] = [tree]
    while waiting:
        parent = waiting.pop()
        for name, value in ast.iter_fields(parent):
            if name in ("annotation", "returns", "decorator_list", "type_params"):
                continue
            children = value if isinstance(value, list) else [value]
            for index, child in enumerate(children):
                if isinstance(child, ast.AST):
                    waiting.append(child)
                    if hasattr(child, "lineno") and changed(child) is not None:
                        yield parent, name, index if isinstance(value, list) else None, child


def mutant_of(module: Path, drawn: random.Random) -> Mutant | None:
    """Change a module at one place of those it has."""
    tree = ast.parse((ROOT / module).read_text())
    found = list(places(tree))
    if not found:
        return None
    parent, name, index, node = drawn.choice(found)
    other = changed(node)
    assert other is not None
    before, after = short(node), short(other)
    if index is None:
        setattr(parent, name, other)
    else:
        getattr(parent, name)[index] = other
    text = ast.unparse(ast.fix_missing_locations(tree))
    return Mutant(module, node.lineno, before, after, text)  # type: ignore[attr-defined]


def short(node: ast.AST) -> str:
    return ast.unparse(node).splitlines()[0][:70]


def tests_for(module: Path) -> list[str]:
    """Return the files that test a module."""
    inside = module.relative_to("symdh").with_suffix("").as_posix()
    layer = inside.split("/", 1)[0]
    named = next((t for start, t in NARROWER.items() if inside.startswith(start)), TESTS[layer])
    files = (f"tests/test_{name}.py" for name in named)
    return [file for file in files if (ROOT / file).exists()]


def is_killed(mutant: Mutant, tree: Path) -> bool:
    """Run the tests of a mutant in a copy of the tree, which is then mended."""
    (tree / mutant.module).write_text(mutant.text)
    try:
        ran = subprocess.run(
            [sys.executable, *PYTEST, *tests_for(mutant.module)],
            cwd=tree,
            env={**os.environ, "PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True,
            timeout=600,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return True
    finally:
        shutil.copy2(ROOT / mutant.module, tree / mutant.module)
    return ran.returncode != 0


def main() -> int:
    """Draw mutants, run them on every core, print the survivors."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--layer", choices=sorted(TESTS), action="append")
    parser.add_argument("--module", help="part of a path")
    options = parser.parse_args()
    layers = options.layer or sorted(TESTS)
    modules = [
        path.relative_to(ROOT)
        for layer in layers
        for path in sorted((ROOT / "symdh" / layer).rglob("*.py"))
        if not options.module or options.module in path.as_posix()
    ]
    sizes = [len(list(places(ast.parse((ROOT / module).read_text())))) for module in modules]
    drawn = random.Random(options.seed)
    chosen = drawn.choices(modules, weights=sizes, k=options.count)
    mutants = [mutant for module in chosen if (mutant := mutant_of(module, drawn))]
    with tempfile.TemporaryDirectory() as folder:
        trees: Queue[Path] = Queue()
        workers = os.cpu_count() or 1
        for number in range(workers):
            tree = Path(folder, str(number))
            ignored = shutil.ignore_patterns(".*", "out", "__pycache__")
            shutil.copytree(ROOT, tree, ignore=ignored)
            trees.put(tree)

        def judged(mutant: Mutant) -> bool:
            tree = trees.get()
            try:
                return is_killed(mutant, tree)
            finally:
                trees.put(tree)

        killed = 0
        with ThreadPoolExecutor(workers) as pool:
            for mutant, dead in zip(mutants, pool.map(judged, mutants), strict=True):
                killed += dead
                if not dead:
                    print(f"survived  {mutant}", flush=True)
    part = 100 * killed / len(mutants)
    verdict = "met" if part >= GOAL else "NOT MET"
    print(f"killed {killed} of {len(mutants)} = {part:.1f} %   at least {GOAL} %   {verdict}")
    return int(part < GOAL)


if __name__ == "__main__":
    sys.exit(main())
