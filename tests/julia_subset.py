"""A small interpreter for the plain Julia that symdh generates, where there is no Julia.

It reads the syntax tree of tree-sitter-julia and follows Julia's rules where the generated code
could break them: elements are counted from 1 and none is beyond the end, what a loop assigns first
lives no longer than its turn, a condition is a Bool, functions get as many arguments and the
keywords that they have, fields of a struct have their types, and what is neither defined nor
listed here as a function of Base is an error. It is no Julia: types of arguments are not looked
at, and Base is what this file says.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest


def julia_parser() -> Callable[[bytes], Any]:
    """Return a parser of Julia; skip the test without one."""
    tree_sitter = pytest.importorskip("tree_sitter")
    grammar = pytest.importorskip("tree_sitter_julia")
    parse: Callable[[bytes], Any] = tree_sitter.Parser(
        tree_sitter.Language(grammar.language())
    ).parse
    return parse


class JuliaError(Exception):
    """What Julia would throw, or this interpreter does not know."""


class _Return(Exception):  # noqa: N818 - it is none
    def __init__(self, value: Any) -> None:
        self.value = value


class _Break(Exception):  # noqa: N818 - it is none
    pass


@dataclass(frozen=True)
class _Type:
    """A type, with its parameters; called, it converts."""

    name: str
    parameters: tuple[Any, ...] = ()

    def __call__(self, value: Any) -> float:
        if self.name != "Float64" or isinstance(value, complex):
            raise JuliaError(f"{self.name}({value!r})")
        return float(value)


class _Named(dict[str, Any]):
    """A named tuple."""


@dataclass(frozen=True)
class _Range:
    first: int
    last: int
    step: int = 1

    def __iter__(self) -> Iterator[int]:
        return iter(range(self.first, self.last + (1 if self.step > 0 else -1), self.step))


class _Scope:
    def __init__(self, outer: _Scope | None) -> None:
        self.names: dict[str, Any] = {}
        self.outer = outer

    def holder(self, name: str) -> _Scope | None:
        scope: _Scope | None = self
        while scope is not None and name not in scope.names:
            scope = scope.outer
        return scope


@dataclass
class _Struct:
    name: str
    fields: dict[str, str]


class _Record:
    """An instance of a mutable struct."""

    def __init__(self, struct: _Struct, values: Sequence[Any]) -> None:
        if len(values) != len(struct.fields):
            raise JuliaError(f"{struct.name} has {len(struct.fields)} fields, not {len(values)}")
        self.struct, self.values = struct, {}
        for field, value in zip(struct.fields, values, strict=True):
            self.set(field, value)

    def set(self, field: str, value: Any) -> None:
        if field not in self.struct.fields:
            raise JuliaError(f"{self.struct.name} has no field {field}")
        kind = {"Float64": float, "Int": int, "Bool": (bool, np.bool_)}.get(
            self.struct.fields[field]
        )
        if kind is not None and (not isinstance(value, kind) or (kind is int and value is True)):
            raise JuliaError(f"{field} is no {self.struct.fields[field]}: {value!r}")
        self.values[field] = value


@dataclass
class _Function:
    name: str
    positional: list[str]
    keywords: dict[str, Any]
    rest: str | None
    body: list[Any]
    is_expression: bool


class Module:
    """A generated module, run."""

    def __init__(self, parse: Callable[[bytes], Any], text: str) -> None:
        root = parse(text.encode()).root_node
        if root.has_error:
            raise JuliaError("the text is no Julia")
        (module,) = [node for node in root.children if node.type == "module_definition"]
        self._globals = _Scope(None)
        # What stands later in a module is known by the time that a function is called.
        for node in module.named_children[1:]:
            self._top(node)

    def call(self, name: str, /, *arguments: Any, **keywords: Any) -> Any:
        """Call a function of the module; matrices and vectors are numpy arrays."""
        return self._apply(self._globals.names[name], list(arguments), keywords)

    # -- statements

    def _top(self, node: Any) -> None:
        match node.type:
            case "function_definition":
                signature, *body = [n for n in node.named_children if n.type != "line_comment"]
                function = self._function(signature.named_children[0], body, False)
                self._globals.names[function.name] = function
            case "assignment" if node.named_children[0].type == "call_expression":
                head, _, value = node.named_children
                function = self._function(head, [value], True)
                self._globals.names[function.name] = function
            case "struct_definition":
                self._struct(node)
            case "const_statement":
                self._run(node.named_children[0], self._globals)
            case "export_statement" | "string_literal" | "line_comment":
                pass
            case other:
                raise JuliaError(f"{other} in a module")

    def _function(self, head: Any, body: list[Any], is_expression: bool) -> _Function:
        name, arguments = head.named_children
        positional: list[str] = []
        keywords: dict[str, Any] = {}
        rest, semicolon = None, False
        for node in arguments.children:
            if node.type == ";":
                semicolon = True
            elif node.type == "splat_expression":
                rest = _text(node.named_children[0])
            elif node.type == "named_argument":
                assert semicolon
                target = node.named_children[0]
                keywords[_typed_name(target)] = node.named_children[-1]
            elif node.is_named and semicolon:
                keywords[_typed_name(node)] = None
            elif node.is_named:
                positional.append(_typed_name(node))
        return _Function(_text(name), positional, keywords, rest, body, is_expression)

    def _struct(self, node: Any) -> None:
        head, *fields = [n for n in node.named_children if n.type != "line_comment"]
        name = _text(head).partition("{")[0]
        kinds = {}
        for field in fields:
            target, kind = field.named_children
            kinds[_text(target)] = _text(kind)
        self._globals.names[name] = _Struct(name, kinds)

    def _block(self, nodes: Iterable[Any], scope: _Scope) -> Any:
        value = None
        for node in nodes:
            if node.type != "line_comment":
                value = self._run(node, scope)
        return value

    def _run(self, node: Any, scope: _Scope) -> Any:
        match node.type:
            case "assignment":
                target, _, value = node.named_children
                result = self._value(value, scope)
                self._assign(target, result, scope)
                return result
            case "compound_assignment_expression":
                return self._compound(node, scope)
            case "return_statement":
                raise _Return(self._value(node.named_children[0], scope))
            case "break_statement":
                raise _Break
            case "if_statement":
                return self._if(node, scope)
            case "for_statement":
                return self._for(node, scope)
        return self._value(node, scope)

    def _compound(self, node: Any, scope: _Scope) -> None:
        target, operator, value = node.named_children
        sign, amount = _text(operator), self._value(value, scope)
        if sign.startswith("."):
            array = self._value(target, scope)
            array[...] = _binary(sign[:-1], array, amount)
        else:
            self._assign(target, _binary(sign[:-1], self._value(target, scope), amount), scope)

    def _if(self, node: Any, scope: _Scope) -> None:
        condition, *rest = node.named_children
        if _truth(self._value(condition, scope)):
            body = (n for n in rest if n.type not in ("elseif_clause", "else_clause"))
            self._block(body, scope)
            return
        for clause in rest:
            if clause.type == "elseif_clause":
                test, *body = clause.named_children
                if _truth(self._value(test, scope)):
                    self._block(body, scope)
                    return
            elif clause.type == "else_clause":
                self._block(clause.named_children, scope)
                return

    def _for(self, node: Any, scope: _Scope) -> None:
        bindings = [n for n in node.named_children if n.type == "for_binding"]
        body = [n for n in node.named_children if n.type != "for_binding"]
        try:
            for inner in self._turns(bindings, scope):
                self._block(body, inner)
        except _Break:
            pass

    def _turns(self, bindings: Sequence[Any], scope: _Scope) -> Iterator[_Scope]:
        """Yield a scope for each turn of a loop over the first binding, then the next inside."""
        if not bindings:
            yield _Scope(scope)
            return
        target, _, over = bindings[0].named_children
        for value in _elements(self._value(over, scope)):
            inner = _Scope(scope)
            self._bind(target, value, inner)
            yield from self._turns(bindings[1:], inner)

    def _bind(self, target: Any, value: Any, scope: _Scope) -> None:
        if target.type == "identifier":
            scope.names[_text(target)] = value
            return
        for part, one in zip(target.named_children, _elements(value), strict=True):
            self._bind(part, one, scope)

    def _assign(self, target: Any, value: Any, scope: _Scope) -> None:
        match target.type:
            case "identifier":
                holder = scope.holder(_text(target))
                if holder is self._globals and scope is not self._globals:
                    holder = None
                (holder or scope).names[_text(target)] = value
            case "open_tuple":
                for part, one in zip(target.named_children, _elements(value), strict=True):
                    self._assign(part, one, scope)
            case "field_expression":
                record, field = target.named_children
                self._value(record, scope).set(_text(field), value)
            case "index_expression":
                array, places = target.named_children
                where = self._value(array, scope)
                indices = [self._value(n, scope) for n in places.named_children]
                where[_places(where, indices)] = value
            case other:
                raise JuliaError(f"{other} is assigned to")

    # -- expressions

    def _value(self, node: Any, scope: _Scope) -> Any:
        method = getattr(self, f"_{node.type}", None)
        if method is None:
            raise JuliaError(f"{node.type}: {_text(node)}")
        return method(node, scope)

    def _identifier(self, node: Any, scope: _Scope) -> Any:
        name = _text(node)
        holder = scope.holder(name)
        if holder is not None:
            return holder.names[name]
        if name in _BASE:
            return _BASE[name]
        raise JuliaError(f"{name} is not defined")

    def _float_literal(self, node: Any, scope: _Scope) -> float:
        return float(_text(node))

    def _integer_literal(self, node: Any, scope: _Scope) -> int:
        return int(_text(node))

    def _boolean_literal(self, node: Any, scope: _Scope) -> bool:
        return _text(node) == "true"

    def _string_literal(self, node: Any, scope: _Scope) -> str:
        return "".join(
            _text(part)
            if part.type == "content"
            else str(self._value(part.named_children[0], scope))
            for part in node.named_children
        )

    def _operator(self, node: Any, scope: _Scope) -> Any:
        """``!(a > b)``, ``-(a + b)`` and ``^(a, b)`` are calls; a colon alone is a whole axis."""
        if _text(node) == ":":
            return _COLON
        return {
            "!": lambda value: not _truth(value),
            "-": lambda value: -value,
            "^": lambda base, exponent: base**exponent,
        }[_text(node)]

    def _parenthesized_expression(self, node: Any, scope: _Scope) -> Any:
        (inner,) = node.named_children
        return self._run(inner, scope)

    def _open_tuple(self, node: Any, scope: _Scope) -> tuple[Any, ...]:
        return tuple(self._value(part, scope) for part in node.named_children)

    def _tuple_expression(self, node: Any, scope: _Scope) -> Any:
        parts = node.named_children
        if parts and parts[0].type == "named_field":
            pairs = [part.named_children for part in parts]
            return _Named({_text(name): self._value(value, scope) for name, value in pairs})
        return tuple(self._value(part, scope) for part in parts)

    def _vector_expression(self, node: Any, scope: _Scope) -> Any:
        return _vector([self._value(part, scope) for part in node.named_children])

    def _comprehension_expression(self, node: Any, scope: _Scope) -> Any:
        bindings, values = self._generated(node, scope)
        if len(bindings) == 1:
            return _vector(values)
        sizes = [len(list(_elements(self._value(b.named_children[2], scope)))) for b in bindings]
        # The last binding turns fastest here, the first in Julia; each has its own axis.
        return np.array(values).reshape(sizes)

    def _generated(self, node: Any, scope: _Scope) -> tuple[list[Any], list[Any]]:
        """Values of ``expression for ... if ...``, in a vector or among arguments."""
        expression, clause, *tests = [n for n in node.named_children if n.type != "line_comment"]
        values = []
        for inner in self._turns(clause.named_children, scope):
            if all(_truth(self._value(test.named_children[0], inner)) for test in tests):
                values.append(self._value(expression, inner))
        return clause.named_children, values

    def _arrow_function_expression(self, node: Any, scope: _Scope) -> Callable[[Any], Any]:
        target, body = node.named_children

        def call(value: Any) -> Any:
            inner = _Scope(scope)
            self._bind(target, value, inner)
            return self._value(body, inner)

        return call

    def _range_expression(self, node: Any, scope: _Scope) -> _Range:
        first, last = node.named_children
        if first.type == "range_expression":
            begin, step = (self._value(n, scope) for n in first.named_children)
            return _Range(begin, self._value(last, scope), step)
        return _Range(self._value(first, scope), self._value(last, scope))

    def _ternary_expression(self, node: Any, scope: _Scope) -> Any:
        condition, yes, no = node.named_children
        return self._value(yes if _truth(self._value(condition, scope)) else no, scope)

    def _unary_expression(self, node: Any, scope: _Scope) -> Any:
        operator, operand = node.named_children
        value = self._value(operand, scope)
        if _text(operator) == "!":
            return not _truth(value)
        return {"-": lambda: -value, "+": lambda: value}[_text(operator)]()

    def _binary_expression(self, node: Any, scope: _Scope) -> Any:
        left, operator, right = node.named_children
        sign = _text(operator)
        if sign in ("&&", "||"):
            first = _truth(self._value(left, scope))
            if first == (sign == "||"):
                return first
            return self._run(right, scope)
        if sign in _COMPARISONS and left.type == "binary_expression":
            _, inner, middle = left.named_children
            if _text(inner) in _COMPARISONS:
                value = self._value(middle, scope)
                return self._value(left, scope) and _binary(sign, value, self._value(right, scope))
        return _binary(sign, self._value(left, scope), self._value(right, scope))

    def _field_expression(self, node: Any, scope: _Scope) -> Any:
        if _text(node).startswith("Base."):
            return _BASE[_text(node)]
        record, field = node.named_children
        value = self._value(record, scope)
        if isinstance(value, _Named):
            return value[_text(field)]
        return value.values[_text(field)]

    def _parametrized_type_expression(self, node: Any, scope: _Scope) -> _Type:
        head, curly = node.named_children
        parameters = tuple(self._value(n, scope) for n in curly.named_children)
        return _Type(_text(head), parameters)

    def _index_expression(self, node: Any, scope: _Scope) -> Any:
        array, places = node.named_children
        where = self._value(array, scope)
        if isinstance(where, _Type):
            values = self._value(places, scope)
            return _typed(where, values)
        indices = [self._value(n, scope) for n in places.named_children]
        return _item(where, indices)

    def _call_expression(self, node: Any, scope: _Scope) -> Any:
        head, argument_list = node.named_children
        function = self._value(head, scope)
        arguments: list[Any] = []
        keywords: dict[str, Any] = {}
        if any(n.type == "for_clause" for n in argument_list.named_children):
            return self._apply(function, [self._generated(argument_list, scope)[1]], {})
        for part in argument_list.named_children:
            if part.type == "splat_expression":
                keywords |= self._value(part.named_children[0], scope)
            elif part.type == "named_argument":
                keywords[_text(part.named_children[0])] = self._value(
                    part.named_children[-1], scope
                )
            elif part.type != "line_comment":
                arguments.append(self._value(part, scope))
        return self._apply(function, arguments, keywords)

    def _apply(self, function: Any, arguments: list[Any], keywords: dict[str, Any]) -> Any:
        if isinstance(function, _Struct):
            return _Record(function, arguments)
        if not isinstance(function, _Function):
            return function(*map(self._callable, arguments), **keywords)
        scope = _Scope(self._globals)
        if len(arguments) != len(function.positional):
            raise JuliaError(f"{function.name} takes {len(function.positional)} arguments")
        scope.names |= zip(function.positional, arguments, strict=True)
        others = {name: keywords[name] for name in keywords if name not in function.keywords}
        if function.rest is not None:
            scope.names[function.rest] = _Named(others)
        elif others:
            raise JuliaError(f"{function.name} has no keyword {', '.join(others)}")
        for name, default in function.keywords.items():
            if name not in keywords and default is None:
                raise JuliaError(f"{function.name}: keyword {name} is not given")
            given = keywords.get(name)
            scope.names[name] = given if name in keywords else self._value(default, scope)
        try:
            value = self._block(function.body, scope)
        except _Return as result:
            return result.value
        return value

    def _callable(self, value: Any) -> Any:
        """Make a function of the module one that Base can call."""
        if not isinstance(value, _Function):
            return value
        return lambda *arguments: self._apply(value, list(arguments), {})


_COMPARISONS = {"<", ">", "<=", ">=", "==", "!="}


def _text(node: Any) -> str:
    text: str = node.text.decode()
    return text


def _typed_name(node: Any) -> str:
    return _text(node.named_children[0] if node.type == "typed_expression" else node)


def _truth(value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise JuliaError(f"a condition must be a Bool, not {value!r}")
    return bool(value)


def _elements(value: Any) -> Iterator[Any]:
    if isinstance(value, np.ndarray):
        return (one.item() for one in value.ravel(order="F"))
    return iter(value)


def _vector(values: list[Any]) -> Any:
    """Numbers as a numpy array; anything else, and no elements at all, as a list."""
    if values and all(isinstance(x, (bool, np.bool_)) for x in values):
        return np.array(values, dtype=bool)
    if values and all(isinstance(x, (int, float, complex)) for x in values):
        return np.array(values)
    return values


def _typed(kind: _Type, values: Any) -> Any:
    known = {"Float64": float, "Bool": bool}
    if kind.name not in known:
        return list(values)
    for value in _elements(values):
        if kind.name == "Float64" and isinstance(value, complex):
            raise JuliaError("a complex number is no Float64")
    return np.array(list(_elements(values)), dtype=known[kind.name])


def _place(index: Any, size: int) -> Any:
    if isinstance(index, _Range):
        assert index.step == 1
        _place(index.first, size)
        _place(index.last, size)
        return slice(index.first - 1, index.last)
    if isinstance(index, (np.ndarray, list)):
        if len(index) and isinstance(index[0], (bool, np.bool_)):
            return np.asarray(index)
        return np.array([_place(int(k), size) for k in index], dtype=int)
    if not isinstance(index, int) or isinstance(index, bool) or not 1 <= index <= size:
        raise JuliaError(f"index {index!r} of {size}")
    return index - 1


def _places(array: np.ndarray, indices: list[Any]) -> Any:
    if len(indices) != array.ndim:
        raise JuliaError(f"{len(indices)} indices of an array with {array.ndim} axes")
    found = []
    for axis, index in enumerate(indices):
        whole = index is _COLON
        found.append(slice(None) if whole else _place(index, array.shape[axis]))
    return tuple(found)


def _item(array: Any, indices: list[Any]) -> Any:
    if isinstance(array, np.ndarray):
        found = array[_places(array, indices)]
        return found.copy() if isinstance(found, np.ndarray) and found.ndim else found.item()
    (index,) = indices
    if isinstance(index, (list, np.ndarray)):
        if len(index) and isinstance(index[0], (bool, np.bool_)):
            return [x for x, chosen in zip(array, index, strict=True) if chosen]
        return [array[_place(int(k), len(array))] for k in index]
    return array[_place(index, len(array))]


def _binary(sign: str, a: Any, b: Any) -> Any:
    dotted = sign.startswith(".")
    plain = sign.removeprefix(".")
    arrays = isinstance(a, np.ndarray) or isinstance(b, np.ndarray)
    if arrays and not dotted and plain in "*/^" and isinstance(b, np.ndarray):
        raise JuliaError(f"{plain} of arrays is another thing in Julia")
    match plain:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/":
            return _quotient(a, b)
        case "^":
            return a**b
        case "%":
            return math.fmod(a, b) if isinstance(a, float) else int(math.fmod(a, b))
        case "==":
            return a == b
        case "!=":
            return a != b
        case "===":
            return a is b
        case "!==":
            return a is not b
        case "<":
            return a < b
        case ">":
            return a > b
        case "<=":
            return a <= b
        case ">=":
            return a >= b
        case "in":
            return a in list(_elements(b))
    raise JuliaError(f"operator {sign}")


def _quotient(a: Any, b: Any) -> Any:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray) or b != 0:
        return a / b
    return math.nan if a == 0 or a != a else math.copysign(math.inf, a) * math.copysign(1.0, b)


def _sqrt(x: float) -> float:
    if x < 0:
        raise JuliaError("DomainError: sqrt of a negative number")
    return math.sqrt(x)


def _angle_function(function: Callable[[float], float]) -> Callable[[float], float]:
    def call(x: float) -> float:
        if math.isinf(x):
            raise JuliaError("DomainError: an infinite angle")
        return function(x)

    return call


_sin, _cos = _angle_function(math.sin), _angle_function(math.cos)


def _sum(first: Any, values: Any = None) -> Any:
    if values is None:
        return sum(_elements(first))
    return sum(first(x) for x in _elements(values))


def _maximum(first: Any, values: Any = None) -> Any:
    found = list(_elements(first) if values is None else map(first, _elements(values)))
    if not found:
        raise JuliaError("maximum of nothing")
    return math.nan if any(x != x for x in found) else max(found)


def _max(*values: Any) -> Any:
    return math.nan if any(x != x for x in values) else max(values)


def _mapped(function: Callable[[Any], Any], values: Any) -> Any:
    if isinstance(values, _Named):
        return _Named({name: function(x) for name, x in values.items()})
    return _vector([function(x) for x in values])


def _foreach(function: Callable[[Any], Any], values: Any) -> None:
    for x in values:
        function(x)


def _collect(kind: _Type, values: Any) -> np.ndarray:
    return _typed(kind, list(_elements(np.asarray(values)))).copy()


def _all(first: Any, values: Any = None) -> bool:
    if values is None:
        return all(_truth(x) for x in _elements(first))
    return all(_truth(first(x)) for x in _elements(values))


def _enumerate(values: Any) -> Iterator[tuple[int, Any]]:
    return iter(enumerate(_elements(values), 1))


def _vcat(*parts: Any) -> np.ndarray:
    return np.concatenate(parts)


def _reshape(values: Any, *sizes: int) -> np.ndarray:
    return np.array(values).reshape(sizes, order="F")


def _copy(values: Any) -> Any:
    return values.copy()


def _product(values: list[Any]) -> Any:
    total = values[0]
    for x in values[1:]:
        total = total * x
    return total


def _sort(values: np.ndarray) -> np.ndarray:
    values.sort()
    return values


def _fill(values: np.ndarray, x: Any) -> np.ndarray:
    values[...] = x
    return values


def _sortperm(values: Any) -> np.ndarray:
    return np.argsort(np.asarray(values), kind="stable") + 1


def _throw(problem: Any) -> None:
    raise JuliaError(problem)


def _size(array: np.ndarray) -> tuple[int, ...]:
    return array.shape


_COLON = object()
_BASE: dict[str, Any] = {
    **{name: _Type(name) for name in ("Float64", "Bool", "Int", "Vector", "Matrix", "Tuple")},
    "nothing": None,
    "pi": math.pi,
    "Inf": math.inf,
    "Base.require_one_based_indexing": lambda *arrays: True,
    "DimensionMismatch": lambda text: f"DimensionMismatch: {text}",
    "abs": abs,
    "abs2": lambda x: abs(x) ** 2,
    "acos": math.acos,
    "all": _all,
    "angle": cmath.phase,
    "asin": math.asin,
    "atan": lambda *x: math.atan2(*x) if len(x) == 2 else math.atan(*x),
    "ceil": lambda x: math.nan if x != x else float(math.ceil(x)),
    "cis": lambda x: complex(math.cos(x), math.sin(x)),
    "collect": _collect,
    "complex": complex,
    "conj": lambda z: z.conjugate(),
    "copy": _copy,
    "copysign": math.copysign,
    "cos": _cos,
    "div": lambda a, b: int(a / b),
    "enumerate": _enumerate,
    "fill!": _fill,
    "foreach": _foreach,
    "imag": lambda z: z.imag,
    "isempty": lambda values: len(values) == 0,
    "length": len,
    "map": _mapped,
    "max": _max,
    "maximum": _maximum,
    "prod": _product,
    "push!": lambda values, x: values.append(x),
    "real": lambda z: z.real,
    "reshape": _reshape,
    "reverse": lambda values: values[::-1],
    "sin": _sin,
    "sincos": lambda x: (_sin(x), _cos(x)),
    "size": _size,
    "sort!": _sort,
    "sortperm": _sortperm,
    "sqrt": _sqrt,
    "sum": _sum,
    "tan": math.tan,
    "throw": _throw,
    "vcat": _vcat,
    "zeros": lambda *sizes: np.zeros(sizes),
}
