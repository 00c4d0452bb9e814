"""C99, also valid C++: ``void NAME_fk(const double q[n], double T[16])``, parameters between.

``NAME_jacobian`` fills ``double J[6 * n]``, ``NAME_fk_jacobian`` both.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from sympy import Expr, Symbol

from symdh.codegen.environment import render
from symdh.codegen.facts import facts_of
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.jacobian import forward_jacobian_routine, jacobian_routine
from symdh.codegen.listing import Entry, Listing, Local, write_listing
from symdh.codegen.literals import literal
from symdh.codegen.names import Scope, comment_text, file_stem, words
from symdh.codegen.routine import Routine
from symdh.codegen.targets import GeneratedFile
from symdh.robot import Robot

_FUNCTIONS = {
    Op.SIN: "sin",
    Op.COS: "cos",
    Op.TAN: "tan",
    Op.ASIN: "asin",
    Op.ACOS: "acos",
    Op.ATAN: "atan",
    Op.ATAN2: "atan2",
    Op.SQRT: "sqrt",
    Op.ABS: "fabs",
    Op.POW: "pow",
}

#: Keywords of C99 to C23 and of C++98 to C++20.
_KEYWORDS = words(
    """
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t
    char8_t class co_await co_return co_yield compl concept const const_cast consteval constexpr
    constinit continue decltype default delete do double dynamic_cast else enum explicit export
    extern false float for friend goto if inline int long mutable namespace new noexcept not not_eq
    nullptr operator or or_eq private protected public register reinterpret_cast requires restrict
    return short signed sizeof static static_assert static_cast struct switch template this
    thread_local throw true try typedef typeid typename typeof typeof_unqual union unsigned using
    virtual void volatile wchar_t while xor xor_eq
    """
)

#: Macros of the standard headers, and those that compilers and systems define besides.
_MACROS = words(
    """
    BUFSIZ CHAR_BIT CLOCKS_PER_SEC DOMAIN FILENAME_MAX FOPEN_MAX HUGE HUGE_VAL HUGE_VALF HUGE_VALL
    I INFINITY MAXFLOAT NAN NDEBUG NULL OVERFLOW PI PLOSS RAND_MAX SING TLOSS TMP_MAX UNDERFLOW
    X_TLOSS assert bool complex errno far fortran huge i386 imaginary interface linux
    math_errhandling max min near noreturn offsetof pascal signgam small stderr stdin stdout sun
    unix vax
    """
)
_MACRO_FAMILIES = re.compile(
    r"E[A-Z0-9]\w*|(M|FP|DBL|FLT|LDBL|DECIMAL|MATH|SIG|LC|SEEK|ATOMIC)_\w*"
    r"|(U?INT\w*|S?CHAR|UCHAR|U?SHRT|U?LONG|U?LLONG|SIZE|PTRDIFF|WCHAR|WINT)_(MIN|MAX|C)"
)


#: What is named after the stem of the files.
_OWN = ("fk", "jacobian", "fk_jacobian", "params", "N_JOINTS")

#: Longest line of generated code.
_WIDTH = 100


@dataclass(frozen=True, slots=True)
class _Assignment:
    """An element of a result and the text that it is set to."""

    place: str
    text: str


@dataclass(frozen=True, slots=True)
class _Function:
    """A function: its head without the semicolon, its lines, and the arguments it never reads."""

    head: str
    locals: tuple[Local, ...]
    unread: tuple[str, ...]
    assignments: tuple[_Assignment, ...]


def generate(robot: Robot) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.h`` and ``NAME.c`` (see `symdh.codegen.generate`).

    Parameters that have a value are compiled in; the others are fields of ``NAME_params``. C has
    no empty array, so a robot without joint variables gets no function for its Jacobian.
    """
    known = {s: robot.values[s] for s in robot.parameters if s in robot.values}
    writer = _Writer(robot, known)
    functions = {"fk": writer.function("fk", forward_routine(robot, known), {"T": 16})}
    if robot.variables:
        size = 6 * len(robot.variables)
        alone, both = jacobian_routine(robot, known), forward_jacobian_routine(robot, known)
        functions["jacobian"] = writer.function("jacobian", alone, {"J": size})
        functions["fk_jacobian"] = writer.function("fk_jacobian", both, {"T": 16, "J": size})
    facts = facts_of(robot)
    stem = writer.stem
    context = {
        "stem": stem,
        "facts": facts,
        "joint_lines": facts.joint_table("q[{}]"),
        "constants": [f"{comment_text(s.name)} = {literal(known[s])}" for s in known],
        "fields": [(field, comment_text(s.name)) for s, field in writer.fields.items()],
        "functions": functions,
    }
    return (
        GeneratedFile(f"{stem}.h", render("c/header.h.jinja", **context)),
        GeneratedFile(f"{stem}.c", render("c/source.c.jinja", **context)),
    )


class _Writer:
    """Writes the routines of one robot as functions.

    Attributes
    ----------
    stem : str
        What every name with external linkage begins with.
    fields : dict of Symbol to str
        The fields of ``NAME_params``.
    """

    def __init__(self, robot: Robot, known: Mapping[Symbol, Expr]) -> None:
        self.stem = file_stem(robot.name)
        self._robot = robot
        self._own = {f"{self.stem}_{name}" for name in _OWN}
        free = [parameter for parameter in robot.parameters if parameter not in known]
        # Fields only have to keep clear of keywords and macros; locals hide functions, arguments.
        self.fields = Scope(lambda n: n in self._own or _is_taken(n)).take_symbols(free)

    def function(self, name: str, routine: Routine, results: Mapping[str, int]) -> _Function:
        """Write a routine as a function that fills some arrays, given with their sizes."""
        scope = Scope(lambda n: n in self._own or _is_taken_locally(n))
        symbols = scope.take_symbols([*self.fields, *self._robot.variables])
        listing = write_listing(routine, _FUNCTIONS, symbols, scope)
        read = {"q": listing.inputs & set(self._robot.variables)}
        if self.fields:
            read["p"] = listing.inputs & set(self.fields)
        return _Function(
            head=self._head(name, results),
            # Results are written only after all arguments are read.
            locals=(*self._reads(listing, symbols), *listing.locals),
            unread=tuple(argument for argument, found in read.items() if not found),
            assignments=tuple(
                _Assignment(f"{matrix}[{place}]", text)
                for matrix, size in results.items()
                for place, text in enumerate(_elements(listing.entries, matrix, size))
            ),
        )

    def _head(self, name: str, results: Mapping[str, int]) -> str:
        n = len(self._robot.variables)
        arguments = [f"const double q[{n}]" if n else "const double *q"]
        if self.fields:
            arguments.append(f"const {self.stem}_params *p")
        arguments += [f"double {matrix}[{size}]" for matrix, size in results.items()]
        line = f"void {self.stem}_{name}({', '.join(arguments)})"
        if len(line) < _WIDTH:
            return line
        broken = ",\n    ".join(arguments)
        return f"void {self.stem}_{name}(\n    {broken})"

    def _reads(self, listing: Listing, symbols: Mapping[Symbol, str]) -> Iterator[Local]:
        places = {symbol: f"q[{place}]" for place, symbol in enumerate(self._robot.variables)}
        places |= {symbol: f"p->{field}" for symbol, field in self.fields.items()}
        for symbol, place in places.items():
            if symbol in listing.inputs:
                yield Local(symbols[symbol], place)


def _elements(entries: Iterable[Entry], matrix: str, size: int) -> list[str]:
    """Return the elements of a result, row by row; a pose ends in 0 0 0 1."""
    texts = ["0.0"] * size
    if matrix == "T":
        texts[-1] = "1.0"
    columns = 4 if matrix == "T" else size // 6
    for entry in entries:
        if entry.matrix == matrix:
            texts[columns * entry.row + entry.column] = entry.text
    return texts


def _is_taken(name: str) -> bool:
    return name in _KEYWORDS or name in _MACROS or _MACRO_FAMILIES.fullmatch(name) is not None


def _is_taken_locally(name: str) -> bool:
    return _is_taken(name) or name in {"q", "p", "T", "J", *_FUNCTIONS.values()}
