"""What goes wrong in a template, as a diagnostic with the template's file and line."""

from __future__ import annotations

import re
from collections.abc import Iterable
from types import TracebackType

from jinja2 import TemplateSyntaxError, UndefinedError

from symdh.errors import Diagnostic, LimitError, SymdhError, TableError
from symdh.table.source import Place, Source
from symdh.table.suggest import did_you_mean
from symdh.templating.catalogue import ORIGINAL, shipped
from symdh.templating.limits import OutOfTimeError, TooLongError
from symdh.templating.own import OwnTemplates

_QUOTED = re.compile(r"'([^']+)'")
_UNKNOWN = re.compile(r"'(\w+)' is undefined")


def syntax_fault(error: TemplateSyntaxError, own: OwnTemplates) -> Diagnostic:
    """Return the diagnostic of a template that jinja2 cannot read."""
    name = str(error.filename)
    source = _sources(own).get(name) or Source(name, "")
    return _diagnostic(source, error.lineno, error.message or "not a jinja2 template")


def fault(error: Exception, name: str, own: OwnTemplates, variables: Iterable[str]) -> SymdhError:
    """Return what to tell the user of an exception that a template ended with.

    Parameters
    ----------
    error : Exception
    name : str
        The template that was to be filled in.
    own : OwnTemplates
        The user's templates; the innermost line of theirs is blamed, where there is one.
    variables : iterable of str
        What the template was given.
    """
    if isinstance(error, TemplateSyntaxError):
        return TableError([syntax_fault(error, own)])
    if isinstance(error, TooLongError):
        return LimitError(f"{own.folder}: {name}: {error}")
    source, line = _blamed(error, name, own)
    diagnostic = _diagnostic(source, line, _message(error, variables))
    if isinstance(error, (OverflowError, MemoryError, RecursionError, OutOfTimeError)):
        return LimitError(str(diagnostic))
    return TableError([diagnostic])


def _message(error: Exception, variables: Iterable[str]) -> str:
    text = str(error)
    if isinstance(error, RecursionError):
        return "templates nested too deeply; does one include itself?"
    if isinstance(error, MemoryError):
        return "the template takes too much memory"
    if isinstance(error, UndefinedError):
        found = _UNKNOWN.fullmatch(text)
        return text + did_you_mean(found[1], variables) if found else text
    return text or type(error).__name__


def _blamed(error: Exception, name: str, own: OwnTemplates) -> tuple[Source, int]:
    """Return the innermost line of the user's templates that was at work, else of symdh's."""
    sources = _sources(own)
    reached = [
        (sources[frame.tb_frame.f_code.co_filename], frame.tb_lineno)
        for frame in _frames(error.__traceback__)
        if frame.tb_frame.f_code.co_filename in sources
    ]
    theirs = [each for each in reached if not each[0].filename.startswith(ORIGINAL)]
    first = own.files.get(name) or sources[ORIGINAL + name]
    return (theirs or reached or [(first, 1)])[-1]


def _frames(traceback: TracebackType | None) -> Iterable[TracebackType]:
    while traceback is not None:
        yield traceback
        traceback = traceback.tb_next


def _sources(own: OwnTemplates) -> dict[str, Source]:
    ours = {ORIGINAL + name: template.text for name, template in shipped().items()}
    return {name: Source(name, text) for name, text in ours.items()} | {
        source.filename: source for source in own.files.values()
    }


def _diagnostic(source: Source, line: int, message: str) -> Diagnostic:
    """Return a diagnostic at the word of the line that the message names; jinja2 knows no more."""
    lines = source.text.split("\n")
    text = lines[line - 1] if line <= len(lines) else ""
    start = len(text) - len(text.lstrip())
    for word in _QUOTED.findall(message):
        found = re.search(rf"(?<!\w){re.escape(word)}(?!\w)", text)
        if found:
            start = found.start()
            break
    return source.diagnostic(Place(line, start + 1, start + 1), message)
