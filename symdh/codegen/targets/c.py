"""C99, also valid C++: ``void NAME_fk(const double q[n], double T[16])``, parameters between."""

from __future__ import annotations

import re
from collections.abc import Iterable

from sympy import Symbol

from symdh.codegen.environment import render
from symdh.codegen.facts import Facts, facts_of
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.listing import Entry, Listing, Local, write_listing
from symdh.codegen.literals import literal
from symdh.codegen.names import Scope, comment_text, file_stem, words
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


def generate(robot: Robot) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.h`` and ``NAME.c`` (see `symdh.codegen.generate`).

    Parameters that have a value are compiled in; the others are fields of ``NAME_params``.
    """
    known = {s: robot.values[s] for s in robot.parameters if s in robot.values}
    free = [parameter for parameter in robot.parameters if parameter not in known]
    # Fields only have to keep clear of keywords and macros; locals hide functions and arguments.
    stem = file_stem(robot.name)
    own = {f"{stem}_{name}" for name in ("fk", "params", "N_JOINTS")}
    fields = Scope(lambda name: name in own or _is_taken(name)).take_symbols(free)
    scope = Scope(lambda name: name in own or _is_taken_locally(name))
    symbols = scope.take_symbols([*free, *robot.variables])
    listing = write_listing(forward_routine(robot, known), _FUNCTIONS, symbols, scope)
    facts = facts_of(robot)
    context = {
        "stem": stem,
        "facts": facts,
        "joint_lines": facts.joint_table("q[{}]"),
        "constants": [f"{comment_text(s.name)} = {literal(known[s])}" for s in known],
        "fields": [(fields[s], comment_text(s.name)) for s in free],
        "locals": [*_reads(facts, listing, symbols, fields), *listing.locals],
        "matrix": _matrix(listing.entries),
        "reads_q": any(joint.symbol in listing.inputs for joint in facts.joints),
        "reads_p": any(symbol in listing.inputs for symbol in free),
    }
    return (
        GeneratedFile(f"{stem}.h", render("c/header.h.jinja", **context)),
        GeneratedFile(f"{stem}.c", render("c/source.c.jinja", **context)),
    )


def _is_taken(name: str) -> bool:
    return name in _KEYWORDS or name in _MACROS or _MACRO_FAMILIES.fullmatch(name) is not None


def _is_taken_locally(name: str) -> bool:
    return _is_taken(name) or name in {"q", "p", "T", *_FUNCTIONS.values()}


def _reads(
    facts: Facts, listing: Listing, symbols: dict[Symbol, str], fields: dict[Symbol, str]
) -> list[Local]:
    """Return the locals that arguments are read into; T is written only after all of them."""
    places = {joint.symbol: f"q[{place}]" for place, joint in enumerate(facts.joints)}
    places |= {symbol: f"p->{field}" for symbol, field in fields.items()}
    return [
        Local(symbols[symbol], place)
        for symbol, place in places.items()
        if symbol in listing.inputs
    ]


def _matrix(entries: Iterable[Entry]) -> list[str]:
    """Return the 16 entries of the result, row by row."""
    texts = ["0.0"] * 15 + ["1.0"]
    for entry in entries:
        texts[4 * entry.row + entry.column] = entry.text
    return texts
