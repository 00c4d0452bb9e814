"""The templates that symdh ships: their names and what the comment at the head of each says."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from inspect import cleandoc

from symdh.resources import templates_dir

#: Written into templates of one's own to reach the original: ``symdh/latex/body.tex.jinja``.
ORIGINAL = "symdh/"

SUFFIX = ".jinja"
#: KaTeX is another project's, put into the page as it is.
_NOT_OURS = "html/katex/"
_HEAD_COMMENT = re.compile(r"\{#-? *(.*?)\s*-?#\}|<#-? *(.*?)\s*-?#>", re.DOTALL)
_HEAD_OF_ASSET = re.compile(r"/\* *(.*?)\s*\*/|((?://[^\n]*\n)+)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Template:
    """A template that symdh ships.

    Attributes
    ----------
    name : str
        Folder and file: ``latex/document.tex.jinja``.
    text : str
    """

    name: str
    text: str

    @property
    def is_filled_in(self) -> bool:
        """Whether it is a jinja template; else it is a style or script, taken as it is."""
        return self.name.endswith(SUFFIX)

    @property
    def description(self) -> str:
        """The comment at its head: what it lays out and which variables it gets."""
        found = (_HEAD_COMMENT if self.is_filled_in else _HEAD_OF_ASSET).match(self.text)
        comment = (found[1] or found[2]) if found else ""
        return cleandoc(comment.replace("// ", ""))

    @property
    def summary(self) -> str:
        """The first sentence of the description."""
        paragraph = " ".join(self.description.partition("\n\n")[0].split())
        return re.split(r"(?<=\.) (?=[A-Z])", paragraph)[0].removesuffix(".")


@cache
def shipped() -> dict[str, Template]:
    """Return every template of symdh by its name, in the order of the names."""
    root = templates_dir()
    paths = {path.relative_to(root).as_posix(): path for path in root.rglob("*") if path.is_file()}
    return {
        name: Template(name, paths[name].read_text(encoding="utf-8"))
        for name in sorted(paths)
        if not name.startswith(_NOT_OURS)
    }
