"""XML as a tree of elements with positions; nothing is defined, expanded or fetched.

A document type declaration is where entities are defined and other files are named, so it is
refused as such. The five entities of XML itself (``&lt;`` and its kin) are all that is expanded.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import accumulate
from typing import NoReturn
from xml.parsers import expat

from symdh.table.source import START, Place, Source
from symdh.table.suggest import brief

MAX_DEPTH = 64

_TAG_NAME = re.compile(r"<[^\s/>]+")
_ATTRIBUTE = re.compile(r"""\s*([^\s=<>/"']+)\s*=\s*("[^"]*"|'[^']*')""")


@dataclass(frozen=True, slots=True)
class Attribute:
    """The value of an attribute.

    Attributes
    ----------
    text : str
    source : Source
    start : int
        Where it starts in the text of the source.
    verbatim : bool
        Whether it stands there character by character, without any ``&amp;``.
    """

    text: str
    source: Source
    start: int
    verbatim: bool

    def place(self, offset: int = 0) -> Place:
        """Return the place of the character at `offset` in the text."""
        return _place(self.source, self.start + (offset if self.verbatim else 0))


@dataclass(frozen=True, slots=True)
class Element:
    """An element with what stands in it; text between elements is left out."""

    tag: str
    attributes: Mapping[str, Attribute]
    children: tuple[Element, ...]
    source: Source
    start: int

    def place(self) -> Place:
        """Return the place of its start tag."""
        return _place(self.source, self.start)

    def all(self, tag: str) -> Iterator[Element]:
        """Yield its own children with a tag, in the order of the file."""
        return (child for child in self.children if child.tag == tag)

    def first(self, tag: str) -> Element | None:
        """Return its first child with a tag, if there is one."""
        return next(self.all(tag), None)


def parse_xml(source: Source) -> Element:
    """Read the text of a file as XML.

    Raises
    ------
    TableError
        At the first place where the text is not XML, declares a document type, or is nested
        deeper than anything sensible.
    """
    return _Builder(source).parse()


@dataclass(slots=True)
class _Open:
    """An element whose end has not come yet."""

    tag: str
    attributes: Mapping[str, Attribute]
    start: int
    children: list[Element] = field(default_factory=list)


class _Builder:
    """Builds the tree from expat's events, with a stack of its own in place of recursion."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.stack: list[_Open] = []
        self.root: Element | None = None
        lengths = (len(line) + 1 for line in source.text.split("\n"))
        self.line_starts = list(accumulate(lengths, initial=0))
        # The text is decoded already, whatever an XML declaration says about its encoding.
        self.parser = expat.ParserCreate(encoding="utf-8")
        self.parser.StartElementHandler = self.opened
        self.parser.EndElementHandler = self.closed
        self.parser.StartDoctypeDeclHandler = self.refuse_doctype

    def parse(self) -> Element:
        if not self.source.text.strip():
            raise self.source.error(START, "file is empty")
        try:
            self.parser.Parse(self.source.text.encode(), True)
        except expat.ExpatError as problem:
            place = Place(problem.lineno, problem.offset + 1, problem.offset + 1)
            raise self.source.error(place, _plain_words(problem)) from None
        assert self.root is not None, "expat takes no document without a root"
        return self.root

    def opened(self, tag: str, attributes: dict[str, str]) -> None:
        start = self.here()
        if len(self.stack) >= MAX_DEPTH:
            raise self.source.error(
                _place(self.source, start), f"nested deeper than {MAX_DEPTH} levels"
            )
        self.stack.append(_Open(tag, self.located(attributes, start), start))

    def closed(self, tag: str) -> None:
        top = self.stack.pop()
        element = Element(top.tag, top.attributes, tuple(top.children), self.source, top.start)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element

    def refuse_doctype(self, name: str, *rest: object) -> NoReturn:
        place = _place(self.source, max(self.source.text.find("<!DOCTYPE"), 0))
        message = "a DOCTYPE is not allowed: it could define entities; take it out"
        raise self.source.error(place, message)

    def here(self) -> int:
        """Return where the event that is being reported starts."""
        return self.line_starts[self.parser.CurrentLineNumber - 1] + self.parser.CurrentColumnNumber

    def located(self, attributes: dict[str, str], start: int) -> dict[str, Attribute]:
        """Find the values of attributes in the text; expat says only where the tag starts."""
        found: dict[str, Attribute] = {}
        name = _TAG_NAME.match(self.source.text, start)
        offset = name.end() if name else start
        while match := _ATTRIBUTE.match(self.source.text, offset):
            text = attributes[match[1]]
            verbatim = len(text) == len(match[2]) - 2
            found[match[1]] = Attribute(text, self.source, match.start(2) + 1, verbatim)
            offset = match.end()
        return found


def _place(source: Source, index: int) -> Place:
    line_start = source.text.rfind("\n", 0, index) + 1
    column = index - line_start + 1
    return Place(source.text.count("\n", 0, index) + 1, column, column)


_PLAIN_WORDS = {
    "no element found": "the file ends before the last tag is closed",
    "mismatched tag": "this end tag does not close the tag that is open",
    "not well-formed (invalid token)": "not XML: unexpected character",
    "duplicate attribute": "an attribute is given twice in this tag",
    "undefined entity": "an entity that XML does not have; write the character itself",
    "junk after document element": "something stands behind the end of the root element",
    "unbound prefix": "a prefix that is not declared",
}


def _plain_words(problem: expat.ExpatError) -> str:
    words = expat.ErrorString(problem.code) or "not well-formed"
    return _PLAIN_WORDS.get(words, f"not XML: {brief(words)}")
