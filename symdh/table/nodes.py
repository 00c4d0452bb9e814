"""YAML as a tree of nodes with positions: every scalar stays text, nothing is looked up or built.

Only the events of PyYAML's parser are used, never its constructors, so neither YAML's own typing
(``NO``, ``010``, ``60:30``) nor its tags, aliases and merges can take effect.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NoReturn, TypeAlias

import yaml

from symdh.table.source import START, Place, Source, describe, find_refused
from symdh.table.suggest import brief
from symdh.table.yaml_problems import place_of, plain_words

MAX_DEPTH = 8
MAX_EVENTS = 20_000
MAX_SCALAR = 2_000


@dataclass(frozen=True, slots=True)
class ScalarNode:
    """A piece of text.

    Attributes
    ----------
    text : str
        Without quotes, escapes resolved.
    line, column : int
        Where it starts, at its quote if it has one.
    quoted : bool
    one_line : bool
        Whether it starts and ends on the same line of the file.
    offsets : tuple of int
        Where each character, and the end, stands after the start, when the file has more in it
        than the text: markup in a Markdown cell. Empty when it has not.
    """

    text: str
    line: int
    column: int
    quoted: bool = False
    one_line: bool = True
    offsets: tuple[int, ...] = ()

    def place(self, offset: int = 0) -> Place:
        """Return the place of the character at `offset` in the text."""
        if self.offsets:
            offset = self.offsets[min(offset, len(self.offsets) - 1)]
        column = self.column + offset
        return Place(self.line, column, column + int(self.quoted))


@dataclass(frozen=True, slots=True)
class MappingNode:
    """Keys and values in the order of the file; no key stands twice."""

    items: tuple[tuple[ScalarNode, Node], ...]
    line: int
    column: int

    def place(self) -> Place:
        """Return the place where the mapping starts."""
        return Place(self.line, self.column, self.column)


@dataclass(frozen=True, slots=True)
class SequenceNode:
    """A list of nodes."""

    items: tuple[Node, ...]
    line: int
    column: int

    def place(self) -> Place:
        """Return the place where the list starts."""
        return Place(self.line, self.column, self.column)


Node: TypeAlias = ScalarNode | MappingNode | SequenceNode


def parse_nodes(source: Source, text: str | None = None) -> MappingNode:
    """Read the text of a table as YAML.

    Parameters
    ----------
    source : Source
    text : str, optional
        What of it is YAML, with the same lines and columns; by default all of it.

    Returns
    -------
    MappingNode
        The top level.

    Raises
    ------
    TableError
        With the first place where the text is not YAML, or is YAML that a table may not use:
        aliases, anchors, tags, merge keys, duplicate keys, a second document, or too much of it.
    """
    builder = _Builder(source)
    events = yaml.parse(source.text if text is None else text, Loader=yaml.SafeLoader)
    try:
        for count, event in enumerate(events, start=1):
            if count > MAX_EVENTS:
                builder.fail(event, f"table has more than {MAX_EVENTS} items")
            builder.take(event)
    except yaml.MarkedYAMLError as problem:
        mark = problem.problem_mark or problem.context_mark
        raise source.error(place_of(mark), plain_words(problem)) from None
    root = builder.root
    if root is None or (isinstance(root, ScalarNode) and not root.text and not root.quoted):
        raise source.error(START, "file is empty; `symdh init` writes a table to start from")
    if not isinstance(root, MappingNode):
        raise source.error(root.place(), "top level must be a mapping of keys, such as `name: arm`")
    return root


@dataclass(slots=True)
class _OpenMapping:
    """A mapping whose end has not come yet."""

    line: int
    column: int
    items: list[tuple[ScalarNode, Node]] = field(default_factory=list)
    lines_of_keys: dict[str, int] = field(default_factory=dict)
    key: ScalarNode | None = None

    def closed(self) -> MappingNode:
        return MappingNode(tuple(self.items), self.line, self.column)


@dataclass(slots=True)
class _OpenSequence:
    """A list whose end has not come yet."""

    line: int
    column: int
    items: list[Node] = field(default_factory=list)

    def closed(self) -> SequenceNode:
        return SequenceNode(tuple(self.items), self.line, self.column)


class _Builder:
    """Builds the tree from events, with a stack of its own in place of recursion."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.root: Node | None = None
        self.stack: list[_OpenMapping | _OpenSequence] = []
        self.documents = 0

    def fail(self, event: yaml.Event, message: str) -> NoReturn:
        raise self.source.error(place_of(event.start_mark), message)

    def take(self, event: yaml.Event) -> None:
        if isinstance(event, yaml.DocumentStartEvent):
            self.documents += 1
            if self.documents > 1:
                self.fail(event, "more than one document; a file holds one table")
        elif isinstance(event, yaml.NodeEvent):
            self.refuse_references(event)
            self.take_node(event)
        elif isinstance(event, yaml.CollectionEndEvent):
            self.add(self.stack.pop().closed())

    def refuse_references(self, event: yaml.NodeEvent) -> None:
        if isinstance(event, yaml.AliasEvent):
            self.fail(
                event, f"alias *{brief(str(event.anchor))} is not allowed; quote it if it is a text"
            )
        if event.anchor is not None:
            self.fail(
                event, f"anchor &{brief(event.anchor)} is not allowed; quote it if it is a text"
            )
        tag = getattr(event, "tag", None)
        if tag is not None:
            self.fail(event, f"tag {brief(tag)} is not allowed")

    def take_node(self, event: yaml.NodeEvent) -> None:
        if isinstance(event, yaml.ScalarEvent):
            self.take_scalar(event)
            return
        if len(self.stack) >= MAX_DEPTH:
            self.fail(event, f"nested deeper than {MAX_DEPTH} levels")
        top = self.stack[-1] if self.stack else None
        if isinstance(top, _OpenMapping) and top.key is None:
            self.fail(event, "a key must be a text; quote a text that starts with { or [")
        place = place_of(event.start_mark)
        opened = _OpenMapping if isinstance(event, yaml.MappingStartEvent) else _OpenSequence
        self.stack.append(opened(place.line, place.column))

    def take_scalar(self, event: yaml.ScalarEvent) -> None:
        if len(event.value) > MAX_SCALAR:
            self.fail(event, f"text has {len(event.value)} characters, over {MAX_SCALAR}")
        # An escape in double quotes can bring in what the file itself may not hold.
        refused = find_refused(event.value)
        if refused is not None:
            self.fail(event, f"character {describe(refused[0])} is not allowed")
        place = place_of(event.start_mark)
        node = ScalarNode(
            text=event.value,
            line=place.line,
            column=place.column,
            quoted=event.style in ("'", '"'),
            one_line=place.line == place_of(event.end_mark).line,
        )
        self.add(node)

    def add(self, node: Node) -> None:
        """Put a finished node where it belongs: the root, a list, or a mapping's key or value."""
        if not self.stack:
            self.root = node
            return
        top = self.stack[-1]
        if isinstance(top, _OpenSequence):
            top.items.append(node)
        elif top.key is not None:
            top.items.append((top.key, node))
            top.key = None
        else:
            assert isinstance(node, ScalarNode)  # `take_node` has refused any other key
            self.refuse_key(node, top.lines_of_keys)
            top.lines_of_keys[node.text] = node.line
            top.key = node

    def refuse_key(self, key: ScalarNode, lines_of_keys: dict[str, int]) -> None:
        if key.text == "<<" and not key.quoted:
            raise self.source.error(key.place(), "merge key << is not allowed")
        first = lines_of_keys.get(key.text)
        if first is not None:
            message = (
                f"key {brief(key.text)} is given twice, on line {first} and on line {key.line}"
            )
            raise self.source.error(key.place(), message)
