"""Breaking a long entry over lines: before the outermost plus or minus that fills a line well."""

from __future__ import annotations

from symdh.notation.pieces import Piece, total_width

#: A line shorter than this part of the limit looks torn; deeper breaks are taken instead.
_FILLED = 0.45


def break_lines(pieces: list[Piece], limit: float, indent: float = 0.0) -> list[list[Piece]]:
    """Break pieces into lines no wider than `limit`.

    Parameters
    ----------
    pieces : list of Piece
    limit : float
        Width of a line, in the unit of the pieces.
    indent : float
        What every line after the first is indented by.

    Returns
    -------
    list of list of Piece
        A line that has no place to break is left too wide.
    """
    lines: list[list[Piece]] = []
    rest = pieces
    while rest:
        room = limit - (indent if lines else 0.0)
        cut = _cut(rest, room)
        lines.append(rest[:cut])
        rest = rest[cut:]
    return lines


def _cut(pieces: list[Piece], room: float) -> int:
    """Return how many pieces go on this line."""
    if total_width(pieces) <= room:
        return len(pieces)
    best: tuple[bool, int, float, int] | None = None
    width = 0.0
    for position, piece in enumerate(pieces):
        if position and piece.depth is not None:
            fits = width <= room
            if not fits and best is not None:
                break
            # Outermost first; among equals the fullest line; torn lines only when nothing else.
            filled = width >= _FILLED * room
            candidate = (filled, -piece.depth, width, position)
            best = candidate if best is None else max(best, candidate)
            if not fits:
                break
        width += piece.width
    return best[3] if best else len(pieces)
