"""What can be changed in a module of the package: one small change at one place of its text."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

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
#: Say nothing about what the program does: types, wrappers, and `strict=` of `zip`, a guard that
#: no input reaches. Places inside an f-string have no position of their own before Python 3.12.
_LEFT_ALONE = ("annotation", "returns", "decorator_list", "type_params", "type_comment")


@dataclass(frozen=True)
class Mutant:
    """A changed module.

    Attributes
    ----------
    module : Path
        In the package, from the root of the project.
    first, last : int
        The lines of the statement that was changed, or of its head.
    before, after : str
        What was changed, and into what.
    text : bytes
        The whole module.
    """

    module: Path
    first: int
    last: int
    before: str
    after: str
    text: bytes

    def __str__(self) -> str:
        return f"{self.module}:{self.first}: {self.before}  ->  {self.after}"


@dataclass(frozen=True)
class Place:
    """A node that can be changed, with the lines of its statement."""

    node: ast.expr | ast.stmt
    first: int
    last: int


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
        case ast.Expr(value=ast.Call()):
            return ast.Pass()
        case ast.Continue():
            return ast.Break()
        case _:
            return None
    return other


def places(tree: ast.AST) -> Iterator[Place]:
    """Give each place of a module that can change."""
    yield from _places(tree, 0, 0)


def _places(parent: ast.AST, first: int, last: int) -> Iterator[Place]:
    if isinstance(parent, ast.JoinedStr) or _is_left_alone(parent):
        return
    for name, value in ast.iter_fields(parent):
        if name in _LEFT_ALONE:
            continue
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST):
                continue
            begin, end = (
                (child.lineno, _head_end(child))
                if isinstance(child, ast.stmt)
                else (
                    first,
                    last,
                )
            )
            if isinstance(child, ast.expr | ast.stmt) and _is_place(parent, name, child):
                yield Place(child, begin, end)
            yield from _places(child, begin, end)


def _is_left_alone(node: ast.AST) -> bool:
    match node:
        case ast.keyword(arg="strict"):
            return True
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
    return False


def _is_place(parent: ast.AST, name: str, child: ast.expr | ast.stmt) -> bool:
    return (
        changed(child) is not None
        or (isinstance(parent, ast.If | ast.While) and name == "test")
        or (isinstance(parent, ast.Return) and not isinstance(child, ast.Constant))
    )


def _head_end(statement: ast.stmt) -> int:
    """Return the last line of a statement, without what is indented below it."""
    body = getattr(statement, "body", None)
    last = statement.end_lineno or statement.lineno
    return max(statement.lineno, body[0].lineno - 1) if body else last


def mutant(module: Path, source: bytes, place: Place) -> Mutant | None:
    """Make the change at a place; None where Python cannot read the result."""
    node = place.node
    other = changed(node)
    if other is not None:
        after = ast.unparse(other)
    elif _is_returned(source, node):
        after = "None"
    else:
        after = f"not ({ast.unparse(node)})"
    begin, end = (
        _offset(source, node.lineno, node.col_offset),
        _offset(source, node.end_lineno or 0, node.end_col_offset or 0),
    )
    written = after if isinstance(node, ast.stmt) else f"({after})"
    text = source[:begin] + written.encode() + source[end:]
    try:
        compile(text, str(module), "exec")
    except SyntaxError:
        return None
    before = ast.unparse(node)
    return Mutant(module, place.first, place.last, _short(before), _short(after), text)


def _is_returned(source: bytes, node: ast.expr | ast.stmt) -> bool:
    line = source.splitlines()[node.lineno - 1]
    return line[: node.col_offset].strip() in (b"return", b"return (")


def _offset(source: bytes, line: int, column: int) -> int:
    lines = source.splitlines(keepends=True)
    return sum(map(len, lines[: line - 1])) + column


def _short(text: str) -> str:
    first, *rest = text.splitlines()
    return first[:70] + ("…" if rest or len(first) > 70 else "")
