"""What can be said of a user's templates before any is filled in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from jinja2 import TemplateSyntaxError, meta

from symdh.errors import Diagnostic, LimitError, Severity, TableError
from symdh.table.source import START
from symdh.table.suggest import did_you_mean
from symdh.templating.catalogue import SUFFIX, shipped
from symdh.templating.environments import environment_for
from symdh.templating.faults import syntax_fault
from symdh.templating.limits import OutOfTimeError, limited
from symdh.templating.own import OwnTemplates


def checked(own: OwnTemplates) -> OwnTemplates:
    """Return the templates with a warning for each file that nothing uses.

    Raises
    ------
    TableError
        With every template that jinja2 cannot read.
    """
    used: set[str | None] = set(shipped())
    faults = []
    for name, source in own.files.items():
        if not name.endswith(SUFFIX):
            continue
        environment = environment_for(name, own)
        try:
            with limited():
                used.update(meta.find_referenced_templates(environment.parse(source.text, name)))
                environment.get_template(name)
        except TemplateSyntaxError as error:
            error.filename = source.filename
            faults.append(syntax_fault(error, own))
        except RecursionError:
            faults.append(source.diagnostic(START, "an expression is nested too deeply"))
        except (MemoryError, OutOfTimeError):
            raise LimitError(f"{source.filename}: the template takes too much to read") from None
    if faults:
        raise TableError(faults)
    return replace(own, warnings=tuple(_unused(own, used)))


def _unused(own: OwnTemplates, used: set[str | None]) -> Iterator[Diagnostic]:
    """Yield a warning for each file that neither replaces a template nor is included by one.

    Where a name is made at run time (None among the used), any file may be meant.
    """
    if None in used:
        return
    for name, source in own.files.items():
        if name not in used:
            message = f"replaces no template of symdh{did_you_mean(name, shipped())}"
            yield source.diagnostic(START, message, Severity.WARNING)
