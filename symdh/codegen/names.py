"""Identifiers for the names of a table: legal in the target's language, and never two alike."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from sympy import Symbol

from symdh.errors import UnsupportedError


def words(text: str) -> frozenset[str]:
    """Return the words of a text, for tables of reserved names."""
    return frozenset(text.split())


#: Names of C headers and Python modules. A file called so would be found in their place by the
#: compiler (``-I.``) or by Python, numpy's own imports included.
_FOREIGN_FILES = words(
    """
    assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign
    stdarg stdatomic stdbit stdbool stdckdint stddef stdint stdio stdlib stdnoreturn string tgmath
    threads time uchar wchar wctype memory
    abc array ast asyncio base64 bisect builtins calendar cmath code codecs collections contextlib
    contextvars copy csv ctypes dataclasses datetime decimal dis email enum fractions functools gc
    glob gzip hashlib heapq html http importlib inspect io itertools json keyword linecache logging
    marshal numbers numpy opcode operator os pathlib pickle platform posixpath pprint queue random
    re reprlib secrets select selectors shutil site socket ssl stat statistics struct subprocess
    symbol sys sysconfig tempfile test textwrap threading token tokenize trace traceback turtle
    types typing unittest urllib uuid venv warnings weakref zipfile zlib
    """
)

#: Python keywords; written down, because the list of the running Python changes with its version.
PYTHON_KEYWORDS = words(
    """
    False None True and as assert async await break class continue def del elif else except finally
    for from global if import in is lambda nonlocal not or pass raise return try while with yield
    """
)


def identifier(text: str, prefix: str = "x") -> str:
    """Turn a name into a legal identifier of C and Python: ASCII, no underscores in a row.

    (C++ reserves names with a double underscore, C those that start with one.) The prefix goes
    before a leading digit.
    """
    word = re.sub(r"[^A-Za-z0-9]+", "_", text).strip("_")
    return word if word[:1].isalpha() else prefix + word


def file_stem(name: str) -> str:
    """Return what the files and functions of a table are named after.

    Raises
    ------
    UnsupportedError
        When the name has no letter or digit that a file name could keep.
    """
    if not re.search(r"[A-Za-z0-9]", name):
        raise UnsupportedError(f"{name!r} has no letter that a file could be named after")
    stem = identifier(name, prefix="robot_")
    taken = stem.lower() in _FOREIGN_FILES or stem in PYTHON_KEYWORDS
    return f"{stem}_arm" if taken else stem


def comment_text(text: str) -> str:
    """Return a name as it may stand in any comment: what could end the comment is replaced."""
    return re.sub(r"[^A-Za-z0-9 _.\-]", "_", text)


class Scope:
    """A scope of a generated program: gives out identifiers, each one once.

    Parameters
    ----------
    is_reserved : callable
        Says whether the language, or the program itself, has a name already. Names that end with
        an underscore are the scope's own to fall back on; it does not ask about them.
    """

    def __init__(self, is_reserved: Callable[[str], bool]) -> None:
        self._is_reserved = is_reserved
        self._taken: set[str] = set()

    def take(self, wanted: str) -> str:
        """Return the identifier that is wanted; ``NAME_``, ``NAME_2_`` .. when it is not free."""
        wanted = identifier(wanted)
        name, number = wanted, 1
        while not self._is_free(name):
            name = f"{wanted}_" if number == 1 else f"{wanted}_{number}_"
            number += 1
        self._taken.add(name)
        return name

    def take_symbols(self, symbols: Sequence[Symbol]) -> dict[Symbol, str]:
        """Name symbols after themselves where that can be; the others give way to those."""
        given: dict[Symbol, str] = {}
        for symbol in sorted(symbols, key=lambda symbol: not self._may_keep(symbol.name)):
            given[symbol] = self.take(symbol.name)
        return {symbol: given[symbol] for symbol in symbols}

    def _may_keep(self, name: str) -> bool:
        return name == identifier(name) and self._is_free(name)

    def _is_free(self, name: str) -> bool:
        reserved = not name.endswith("_") and self._is_reserved(name)
        return name not in self._taken and not reserved
