"""Filling in a template: the user's where there is one, else symdh's."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from symdh.templating.catalogue import shipped
from symdh.templating.checking import checked
from symdh.templating.environments import environment_for
from symdh.templating.faults import fault
from symdh.templating.limits import bounded, limited
from symdh.templating.own import OwnTemplates, read_folder

_IN_FORCE: ContextVar[OwnTemplates | None] = ContextVar("own templates", default=None)


@contextmanager
def own_templates(folder: str) -> Iterator[OwnTemplates]:
    """Put the templates of a folder in the place of symdh's own, inside a ``with``.

    Parameters
    ----------
    folder : str
        Its files have the names of symdh's: ``FOLDER/latex/body.tex.jinja``.

    Yields
    ------
    OwnTemplates

    Raises
    ------
    ReadError
        When the folder cannot be read.
    UnsupportedError
        When something in it leads out of it.
    TableError
        With every template that jinja2 cannot read.
    LimitError
        When the folder holds too many files.
    """
    before = _IN_FORCE.get()
    own = before if before and before.folder == folder else checked(read_folder(folder))
    token = _IN_FORCE.set(own)
    try:
        yield own
    finally:
        _IN_FORCE.reset(token)


def folder_in_force() -> str | None:
    """Return the folder whose templates stand for symdh's at the moment."""
    own = _IN_FORCE.get()
    return own.folder if own else None


def render(name: str, /, **variables: object) -> str:
    """Fill in a template.

    Parameters
    ----------
    name : str
        ``latex/document.tex.jinja`` say.
    **variables
        What the template lays out; the comment at its head describes them.

    Raises
    ------
    TableError
        When a template of the user's (`own_templates`) is wrong, with its file and line.
    LimitError
        When one takes too long or writes too much.
    """
    own = _IN_FORCE.get()
    environment = environment_for(name, own)
    if own is None:
        return environment.get_template(name).render(variables)
    try:
        with limited():
            return "".join(bounded(environment.get_template(name).generate(variables)))
    except Exception as error:
        raise fault(error, name, own, variables) from None


def asset(name: str) -> str:
    """Return a style or script that goes into a page as it is, ``html/page.css`` say."""
    own = _IN_FORCE.get()
    if own is not None and name in own.files:
        return own.files[name].text
    return shipped()[name].text
