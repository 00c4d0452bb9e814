"""The jinja2 environments of the templates; the only place that makes them."""

from __future__ import annotations

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from symdh.resources import templates_dir


def latex_environment() -> Environment:
    """Return the environment for LaTeX: ``<< >>``, ``<% %>`` and ``<# #>``, free in TeX text."""
    return Environment(
        loader=FileSystemLoader(templates_dir() / "latex"),
        undefined=StrictUndefined,
        block_start_string="<%",
        block_end_string="%>",
        variable_start_string="<<",
        variable_end_string=">>",
        comment_start_string="<#",
        comment_end_string="#>",
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # TeX has no use for HTML escapes; text is escaped by `latex_text`
    )


def html_environment() -> Environment:
    """Return the environment for the web page; every text is escaped unless marked as markup."""
    return Environment(
        loader=FileSystemLoader(templates_dir() / "html"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=True,
    )
