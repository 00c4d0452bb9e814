"""Running text with formulas in it."""

from __future__ import annotations

from symdh.notation.nodes import Node

Inline = str | Node
Text = tuple[Inline, ...]
