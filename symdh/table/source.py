"""From bytes to text whose lines and columns are those that an editor shows."""

from __future__ import annotations

import re
import stat
import sys
import unicodedata
from dataclasses import dataclass
from pathlib import Path

from symdh.errors import Diagnostic, ReadError, Severity, TableError

MAX_BYTES = 1 << 20
STDIN = "<stdin>"

# Everything but printable ASCII, tab and line feed; only these need a look at their category.
_SUSPECT = re.compile(r"[^\t\n\x20-\x7e]")
# Control, format, surrogate, private, unassigned, and the line and paragraph separators that YAML
# would count as line ends.
_REFUSED_CATEGORIES = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """A position in a file, counted from 1.

    Attributes
    ----------
    line, column : int
        The position as reported; inside a quoted value the quotes are not counted.
    caret : int
        The column of the character in its line, where the caret is drawn.
    """

    line: int
    column: int
    caret: int


START = Place(1, 1, 1)


@dataclass(frozen=True, slots=True)
class Source:
    """The text of a table and the name under which the user knows it."""

    filename: str
    text: str

    def diagnostic(
        self, place: Place, message: str, severity: Severity = Severity.ERROR
    ) -> Diagnostic:
        """Return `message` as a diagnostic at `place`, with the source line."""
        lines = self.text.split("\n")
        line = lines[place.line - 1] if place.line <= len(lines) else ""
        return Diagnostic(
            message=message,
            filename=self.filename,
            line=place.line,
            column=place.column,
            source=line,
            # Escapes in a quoted value make it longer in the file than its text.
            caret=min(place.caret, len(line) + 1),
            severity=severity,
        )

    def error(self, place: Place, message: str) -> TableError:
        """Return a table error with the one diagnostic `message` at `place`."""
        return TableError([self.diagnostic(place, message)])


def read_source(path: str) -> Source:
    """Read the table at `path`, or standard input for ``-``.

    Raises
    ------
    ReadError
        When the file cannot be read.
    TableError
        When it is not text in UTF-8 of at most 1 MiB.
    """
    if path == "-":
        return decode(_read_stdin(), STDIN)
    return decode(_read_file(path), path)


def decode(data: bytes, filename: str) -> Source:
    """Turn the bytes of a file into text with line feeds and without a byte order mark.

    Raises
    ------
    TableError
        When the file is too long, in another encoding, or holds a character that cannot be seen.
    """
    if len(data) > MAX_BYTES:
        raise Source(filename, "").error(START, "file is over 1 MiB; reading stopped there")
    if _looks_like_utf16(data):
        raise Source(filename, "").error(START, "file is UTF-16; save it as UTF-8")
    data = data.removeprefix(b"\xef\xbb\xbf")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as problem:
        shown = _with_line_feeds(data.decode("utf-8", errors="replace"))
        before = _with_line_feeds(data[: problem.start].decode("utf-8"))
        message = f"byte 0x{data[problem.start]:02X} is not UTF-8; save the file as UTF-8"
        raise Source(filename, shown).error(_end_of(before), message) from None
    return from_text(text, filename)


def from_text(text: str, filename: str) -> Source:
    """Check text that is already decoded; see `decode`."""
    if len(text) > MAX_BYTES:
        raise Source(filename, "").error(START, "text is over 1 MiB")
    source = Source(filename, _with_line_feeds(text.removeprefix("\ufeff")))
    match = find_refused(source.text)
    if match is not None:
        character, index = match
        raise source.error(
            _end_of(source.text[:index]), f"character {describe(character)} is not allowed"
        )
    return source


def find_refused(text: str) -> tuple[str, int] | None:
    """Return the first character of `text` that cannot be seen, with its index, or None."""
    for match in _SUSPECT.finditer(text):
        if unicodedata.category(match[0]) in _REFUSED_CATEGORIES:
            return match[0], match.start()
    return None


def describe(character: str) -> str:
    """Return the code point and Unicode name of a character: ``U+00B2 SUPERSCRIPT TWO``."""
    name = unicodedata.name(character, "")
    return f"U+{ord(character):04X} {name}".rstrip()


def _with_line_feeds(text: str) -> str:
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _end_of(text: str) -> Place:
    """Return the place just after `text`, which starts at 1:1."""
    column = len(text) - text.rfind("\n")
    return Place(text.count("\n") + 1, column, column)


def _looks_like_utf16(data: bytes) -> bool:
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return True
    # Without a byte order mark: every second byte of a Latin text is zero.
    zeros = [byte == 0 for byte in data[:4]]
    return zeros in ([False, True, False, True], [True, False, True, False])


def _read_stdin() -> bytes:
    if sys.stdin is None:
        raise ReadError(f"{STDIN}: standard input is closed")
    try:
        return sys.stdin.buffer.read(MAX_BYTES + 1)
    except OSError as problem:
        raise _read_error(STDIN, problem) from None


def _read_file(path: str) -> bytes:
    if not path:  # Path("") is the folder that symdh runs in
        raise ReadError("the name of a file to read is empty")
    try:
        # The kind is asked before opening: opening a named pipe waits for a writer.
        _refuse_kind(path, Path(path).stat().st_mode)
        with Path(path).open("rb") as file:
            return file.read(MAX_BYTES + 1)
    except OSError as problem:
        raise _read_error(path, problem) from None
    except ValueError:
        raise ReadError(f"{path!r}: not a file name") from None


def _refuse_kind(path: str, mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise ReadError(f"{path}: is a directory")
    # A character device such as /dev/zero is read like a file: up to the limit.
    if not (stat.S_ISREG(mode) or stat.S_ISCHR(mode)):
        raise ReadError(f"{path}: not a regular file (- reads standard input)")


def _read_error(path: str, problem: OSError) -> ReadError:
    if isinstance(problem, FileNotFoundError):
        return ReadError(f"{path}: no such file")
    return ReadError(f"{path}: {(problem.strerror or str(problem)).lower()}")
