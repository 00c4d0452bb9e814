"""What reaches the terminal: results on standard output, messages on standard error."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable, Sequence
from typing import TextIO

from click import style

from symdh.errors import Diagnostic, OutputError, Severity, SymdhError, TableError

_WIDTH_OFF_TERMINAL = 100


def use_utf8() -> None:
    """Make both streams speak UTF-8 with plain line ends, whatever the locale says."""
    for stream, errors in ((sys.stdout, "strict"), (sys.stderr, "backslashreplace")):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(encoding="utf-8", errors=errors, newline="\n")


def print_result(text: str) -> None:
    """Write a result to standard output, a line end added where it has none."""
    print_bytes((text if text.endswith("\n") else text + "\n").encode())


def print_bytes(content: bytes) -> None:
    """Write bytes to standard output.

    Raises
    ------
    OutputError
        When they cannot be written.
    BrokenPipeError
        When nobody reads them any more.
    """
    if sys.stdout is None:
        raise OutputError("cannot write to standard output: it is closed")
    try:
        sys.stdout.flush()
        sys.stdout.buffer.write(content)
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        raise stdout_failure(error) from error


def stdout_failure(error: OSError) -> OutputError:
    """Say that standard output takes no more."""
    return OutputError(f"cannot write to standard output: {(error.strerror or str(error)).lower()}")


def settle_stdout() -> None:
    """Flush standard output; where that fails, throw away what Python would complain of at exit."""
    if sys.stdout is None:
        return
    try:
        sys.stdout.flush()
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def note(text: str) -> None:
    """Write a message for people to standard error; if that is gone, nobody is there to tell."""
    if sys.stderr is None:
        return
    try:
        print(text, file=sys.stderr, flush=True)
    except OSError:
        sys.stderr = None


def show_diagnostics(diagnostics: Iterable[Diagnostic]) -> None:
    """Print diagnostics, each with its place, source line and caret."""
    coloured = _wants_colour(sys.stderr)
    for diagnostic in diagnostics:
        text = _printable(str(diagnostic))
        note(_in_colour(text, diagnostic) if coloured else text)


def show_error(error: SymdhError) -> None:
    """Print an error that symdh raised on purpose."""
    if isinstance(error, TableError):
        show_diagnostics(error.diagnostics)
        note(counted(error.diagnostics))
    else:
        label = style("error:", fg="red", bold=True) if _wants_colour(sys.stderr) else "error:"
        note(f"{label} {_printable(str(error))}")


def counted(diagnostics: Sequence[Diagnostic]) -> str:
    """Say how many there are: ``2 errors, 1 warning``."""
    errors = sum(1 for each in diagnostics if each.severity is Severity.ERROR)
    parts = [plural(errors, "error")] if errors else []
    if len(diagnostics) > errors:
        parts.append(plural(len(diagnostics) - errors, "warning"))
    return ", ".join(parts)


def plural(count: int, noun: str) -> str:
    """Return ``1 error``, ``2 errors``."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def width() -> int:
    """Return the width to print in: the terminal's, or a fixed one where there is none."""
    return shutil.get_terminal_size((_WIDTH_OFF_TERMINAL, 24)).columns


def _wants_colour(stream: TextIO | None) -> bool:
    """Colour is for a terminal, and for nobody who has asked for none (https://no-color.org)."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream is not None and stream.isatty()


def _in_colour(text: str, diagnostic: Diagnostic) -> str:
    """Colour the message by its severity and the caret, if there is one."""
    head, *excerpt = text.split("\n")
    place = _printable(f"{diagnostic.filename}:{diagnostic.line}:{diagnostic.column}:")
    colour = "red" if diagnostic.severity is Severity.ERROR else "yellow"
    lines = [style(place, bold=True) + style(head.removeprefix(place), fg=colour), *excerpt]
    if excerpt:
        lines[-1] = style(lines[-1], fg=colour, bold=True)
    return "\n".join(lines)


def _printable(text: str) -> str:
    """Replace what could steer a terminal, one character for one, so that carets stay in place."""
    return "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)
