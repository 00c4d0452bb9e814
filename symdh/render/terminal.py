"""Results as Unicode text that fits the width of a terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Display,
    Entries,
    EntryStep,
    EntrySteps,
    Figure,
    Fitting,
    MatrixRow,
    NamedMatrix,
    Paragraph,
    ParameterTable,
)
from symdh.derivation.legend import legend
from symdh.derivation.numbers import rounded
from symdh.derivation.recursion import chapter as recursion_chapter
from symdh.derivation.style import Naming, Style
from symdh.kinematics.forward import has_closed_form, transform
from symdh.kinematics.frame import Frame
from symdh.kinematics.numeric import NumericMatrix
from symdh.notation import break_lines, joined, total_width
from symdh.notation.nodes import Equation, PoseName
from symdh.render.entries import named_entries
from symdh.render.unicode_math import UnicodeWriter
from symdh.robot import Robot

_MATH = UnicodeWriter()
_INDENT = 4


def render_result(
    robot: Robot, start: Frame, end: Frame, width: int = 80, naming: Naming | str = Naming.AUTO
) -> str:
    """Return the exact pose of `end` in `start` as text.

    As a matrix where that fits into `width` columns, else entry by entry; where the closed form
    would be too large, the recursion that gives it.

    Raises
    ------
    UnsupportedError
        When the robot has no such frame.
    """
    style = Style(robot, naming=Naming(naming))
    if not has_closed_form(robot, start, end):
        return _chapter(recursion_chapter(style, start, end), width)
    matrix = style.notation.matrix(transform(robot, start, end))
    text = _named_matrix(NamedMatrix((style.pose_name(start, end),), matrix), width)
    meanings = legend(style, [matrix])
    return text if meanings is None else f"{text}\n\n{_paragraph(meanings, width)}"


def render_numbers(start: Frame, end: Frame, numbers: NumericMatrix) -> str:
    """Return a numeric pose as text."""
    name = PoseName(str(start), str(end), craig=False)
    return _named_matrix(NamedMatrix((name,), rounded(numbers)), width=80)


def render_chapters(chapters: Iterable[Chapter], width: int = 80) -> str:
    """Return chapters as text, each under its title."""
    return "\n\n".join(
        f"{chapter.title}\n{'─' * len(chapter.title)}\n\n{_chapter(chapter, width)}"
        for chapter in chapters
    )


def _named_matrix(block: NamedMatrix, width: int) -> str:
    name = _MATH.text(Equation(block.names))
    lines = _MATH.matrix_lines(block.matrix)
    gap = " " * (len(name) + 3)
    if len(gap) + len(lines[0]) <= width:
        heads = [f"{name} = " if row == (len(lines) - 1) // 2 else gap for row in range(len(lines))]
        return "\n".join(head + line for head, line in zip(heads, lines, strict=True))
    if len(lines[0]) + 2 <= width:
        return "\n".join([f"{name} =", *(f"  {line}" for line in lines)])
    return "\n".join(
        [f"{name}:", *_entries(named_entries(block.matrix, block.names[0]), width - 2, "  ")]
    )


def _entries(steps: Iterable[EntryStep], width: int, lead: str = "") -> list[str]:
    lines: list[str] = []
    for step in steps:
        name = _MATH.text(step.name)
        room = max(width - len(name) - 3, 20)
        forms = [_MATH.pieces(form) for form in step.forms]
        whole = [piece for form in forms for piece in (_MATH.equals(), *form)][1:]
        if len(forms) == 1 or total_width(whole) <= room:
            forms = [whole]
        begin = f"{name} = "
        for form in forms:
            broken = break_lines(form, room, _INDENT)
            lines.append(lead + begin + joined(broken[0]))
            gap = " " * (len(name) + 3 + _INDENT)
            lines += [lead + gap + joined(line).lstrip() for line in broken[1:]]
            begin = " " * len(name) + " = "
    return lines


def _chapter(chapter: Chapter, width: int) -> str:
    return "\n\n".join(_blocks(chapter.blocks, width))


def _blocks(blocks: Iterable[Block], width: int) -> list[str]:
    parts: list[str] = []
    for block in blocks:
        match block:
            case Paragraph():
                parts.append(_paragraph(block, width))
            case Display(formula=formula):
                parts.append(f"  {_MATH.text(formula)}")
            case EntrySteps(entries=steps):
                parts.append("\n".join(_entries(steps, width - 2, "  ")))
            case Entries(groups=groups):
                parts += ["\n".join(_entries(steps, width - 2, "  ")) for steps in groups]
            case NamedMatrix():
                parts.append(_named_matrix(block, width))
            case Fitting(whole=whole, otherwise=otherwise):
                fits = len(_MATH.matrix_lines(whole.matrix)[0]) + 2 <= width
                parts += _blocks((whole,) if fits else otherwise, width)
            case MatrixRow(matrices=matrices):
                parts += [_named_matrix(matrix, width) for matrix in matrices]
            case ParameterTable():
                parts.append(_table(block, width))
            case Figure():
                pass  # a terminal has no room for it; symdh draw makes it
            case _:
                raise TypeError(f"no terminal text for {type(block).__name__}")
    return parts


def _table(block: ParameterTable, width: int) -> str:
    rows = [[_MATH.text(node) for node in row] for row in (block.header, *block.rows)]
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    head, *body = (_row(row, widths) for row in rows)
    notes = [_paragraph(Paragraph(note), width) for note in block.notes]
    return "\n".join([head, "  " + "─" * (len(head) - 2), *body, *notes])


def _row(cells: Sequence[str], widths: Sequence[int]) -> str:
    # The first column names the row; the others are numbers.
    first, *rest = zip(cells, widths, strict=True)
    return "   ".join([f"  {first[0]:{first[1]}}", *(f"{cell:>{size}}" for cell, size in rest)])


def _paragraph(block: Paragraph, width: int) -> str:
    # Formulas are kept whole: their spaces come back after the text is wrapped.
    text = "".join(
        part if isinstance(part, str) else _MATH.text(part).replace(" ", "\u00a0")
        for part in block.content
    )
    wrapped = textwrap.fill(text, max(width, 20), break_long_words=False, break_on_hyphens=False)
    return wrapped.replace("\u00a0", " ")
