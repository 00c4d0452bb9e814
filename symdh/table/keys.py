"""The keys of a mapping: those that are known, and what unknown ones were taken for."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from symdh.table.nodes import MappingNode, Node
from symdh.table.report import Report
from symdh.table.suggest import brief, nearest, question

EXTENSION = "x-"
"""Keys that start so belong to other tools and are left alone."""


@dataclass(frozen=True, slots=True)
class Keys:
    """What stands in a mapping.

    Attributes
    ----------
    nodes : dict of str to Node
        The values of known keys.
    meant : frozenset of str
        Known keys that unknown ones are taken for: misspelt, they are not missing.
    """

    nodes: dict[str, Node]
    meant: frozenset[str]

    def lack(self, *keys: str) -> bool:
        """Say whether none of these keys is there, nor one that is taken for it."""
        return self.meant.isdisjoint(keys) and not any(key in self.nodes for key in keys)


def read_keys(
    node: MappingNode,
    known: Collection[str],
    report: Report,
    aliases: Mapping[str, str],
    where: str = "",
) -> Keys:
    """Read the keys of a mapping, and note those that are unknown.

    Parameters
    ----------
    node : MappingNode
    known : collection of str
    report : Report
    aliases : mapping of str to str
        Lower-case words that people use, and the right word for each.
    where : str, optional
        Where a key is unknown, as `` in tool``.
    """
    nodes: dict[str, Node] = {}
    meant = set()
    for key, value in node.items:
        if key.text in known:
            nodes[key.text] = value
        elif not key.text.startswith(EXTENSION):
            right = nearest(key.text, known, aliases)
            meant.add(right)
            message = f"key {brief(key.text)} unknown{where}{question(right)}"
            report.error(key.place(), message)
    return Keys(nodes, frozenset(filter(None, meant)))
