"""The jinja2 environment of the targets: templates lay out, Python decides."""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from symdh.resources import templates_dir


def render(template: str, **context: object) -> str:
    """Fill in a template of the ``templates`` folder, ``python/module.py.jinja`` say."""
    return _environment().get_template(template).render(**context)


@cache
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(templates_dir()),
        autoescape=False,  # program text, not HTML
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
