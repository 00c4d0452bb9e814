"""The jinja2 environments: sandboxed, strict about names, escaping where the format asks for it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from jinja2 import BaseLoader, Environment, StrictUndefined, TemplateNotFound, pass_context
from jinja2.environment import TemplateModule
from jinja2.runtime import Context
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import missing

from symdh.table.suggest import did_you_mean
from symdh.templating.catalogue import ORIGINAL, shipped
from symdh.templating.own import OwnTemplates

#: Braces mean something in these, so their templates have ``<< >>``, ``<% %>`` and ``<# #>``.
_BRACED = (".tex.jinja", ".typ.jinja")
_MARKUP = (".html.jinja", ".svg.jinja")

_ANGLED = {
    "block_start_string": "<%",
    "block_end_string": "%>",
    "variable_start_string": "<<",
    "variable_end_string": ">>",
    "comment_start_string": "<#",
    "comment_end_string": "#>",
}
_MAX_BITS = 100_000
#: Packages whose objects a template may look into.
_KNOWN = frozenset({"builtins", "jinja2", "markupsafe", "symdh"})


def environment_for(name: str, own: OwnTemplates | None) -> Environment:
    """Return the environment of a template, by the format that its name tells."""
    return _environment(name.endswith(_BRACED), name.endswith(_MARKUP), own)


@cache
def _environment(braced: bool, markup: bool, own: OwnTemplates | None) -> Environment:
    # Escapes are for the web; LaTeX and code have their own, made before a template gets a text.
    return _Sandbox(
        loader=_Loader(own),
        undefined=_Undefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=markup,
        # jinja2 would work out constants while it reads a template, before any line is at work.
        optimized=False,
        finalize=_as_it_is,
        **(_ANGLED if braced else {}),
    )


@pass_context
def _as_it_is(context: Context, value: object) -> object:
    """Return what is printed; that this hangs on the context keeps it from being a constant."""
    return value


class _Loader(BaseLoader):
    """Finds a template in the user's folder, else among symdh's; never anywhere else."""

    def __init__(self, own: OwnTemplates | None) -> None:
        self._own = own.files if own else {}

    def get_source(
        self, environment: Environment, template: str
    ) -> tuple[str, str, Callable[[], bool]]:
        """Return the text, the name under which errors mention it, and that it never changes."""
        if template in self._own:
            source = self._own[template]
            return source.text, source.filename, lambda: True
        original = template.removeprefix(ORIGINAL)
        if original not in shipped():
            raise TemplateNotFound(template, _not_found(template, self._own))
        return shipped()[original].text, ORIGINAL + original, lambda: True


def _not_found(name: str, own: Mapping[str, object]) -> str:
    known = [*own, *shipped()]
    return f"there is no template {name!r}{did_you_mean(name.removeprefix(ORIGINAL), known)}"


class _Sandbox(ImmutableSandboxedEnvironment):
    """A sandbox for plain data, in which no product of numbers takes longer than anybody waits."""

    intercepted_binops = frozenset({"*", "**"})

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:
        """Refuse to look into objects of other packages; sympy's would run text as Python."""
        package = type(obj).__module__.partition(".")[0]
        return package in _KNOWN and super().is_safe_attribute(obj, attr, value)

    def call_binop(self, context: Context, operator: str, left: Any, right: Any) -> Any:
        """Multiply or raise to a power, unless the number would be huge."""
        if isinstance(left, int) and isinstance(right, int):
            small = left.bit_length() + right.bit_length()
            bits = small if operator == "*" else left.bit_length() * abs(right)
            if bits > _MAX_BITS:
                raise OverflowError("a number would be too large")
        return super().call_binop(context, operator, left, right)


class _Undefined(StrictUndefined):
    """What is not there, with what may have been meant."""

    @property
    def _undefined_message(self) -> str:
        thing, name = self._undefined_obj, self._undefined_name
        if self._undefined_hint or thing is missing or not isinstance(name, str):
            return super()._undefined_message
        if isinstance(thing, TemplateModule):
            known = [each for each in vars(thing) if not each.startswith("_")]
            return f"{thing!r} has no macro {name!r}{did_you_mean(name, known)}"
        known = list(thing) if isinstance(thing, Mapping) else dir(thing)
        public = [each for each in map(str, known) if not each.startswith("_")]
        return f"there is no {name!r} here{did_you_mean(name, public)}"
