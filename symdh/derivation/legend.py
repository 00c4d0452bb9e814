"""What the short forms of a set of formulas stand for."""

from __future__ import annotations

from collections.abc import Iterable

from symdh.derivation.blocks import Paragraph
from symdh.derivation.style import Style
from symdh.notation.names import split_name
from symdh.notation.nodes import Call, Equation, Generic, Node, Short, leaves

_FUNCTION = {"c": "cos", "s": "sin"}


def legend(style: Style, formulas: Iterable[Node], known: Iterable[Node] = ()) -> Paragraph | None:
    """Return a paragraph that introduces each short form in `formulas` that is not in `known`.

    Returns
    -------
    Paragraph or None
        None when there is nothing to introduce.
    """
    before = set(_labels(known))
    labels = [label for label in _labels(formulas) if label not in before]
    if not labels:
        return None
    alike = _alike(style, labels)
    meanings: list[Node] = []
    if alike:
        angle = Generic(_letter(style, alike[0]), "i")
        meanings += [
            Equation((Generic(letter, "i"), Call(name, (angle,))))
            for letter, name in _FUNCTION.items()
        ]
    meanings += [
        Equation((Short(letter, label), Call(name, (_angle(style, label),))))
        for label in labels
        if label not in alike
        for letter, name in _FUNCTION.items()
    ]
    content: list[str | Node] = ["Here "]
    for position, meaning in enumerate(meanings):
        if position:
            content.append(" and " if position == len(meanings) - 1 else ", ")
        content.append(meaning)
    return Paragraph((*content, "."))


def _alike(style: Style, labels: list[str]) -> list[str]:
    """Return the single joints that ``c_i = cos theta_i`` says in one line, if that pays."""
    angles = {label: style.notation.shorthand.angle(label) for label in labels}
    singles = [
        label
        for label, angle in angles.items()
        if angle.is_Symbol and split_name(angle.name)[1] == label
    ]
    letters = {_letter(style, label) for label in singles}
    return singles if len(singles) > 2 and len(letters) == 1 else []


def _letter(style: Style, label: str) -> str:
    return split_name(style.notation.shorthand.angle(label).name)[0]


def _angle(style: Style, label: str) -> Node:
    return style.notation.write(style.notation.shorthand.angle(label))


def _labels(formulas: Iterable[Node]) -> list[str]:
    """Return the labels in the formulas, single joints first."""
    found = {leaf.label for node in formulas for leaf in leaves(node) if isinstance(leaf, Short)}
    return sorted(found, key=lambda label: (len(label), label))
