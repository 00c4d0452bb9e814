"""The user's own words in a message, and the "did you mean"."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches

MAX_SHOWN = 40
MAX_COMPARED = 100
"""Among more words than that, none is looked for that is like a wrong one: it takes too long."""


def brief(written: str) -> str:
    """Return what a user wrote, on one line and short enough to stand in a message."""
    line = " ".join(written.split())
    return line if len(line) <= MAX_SHOWN else f"{line[:MAX_SHOWN]}…"


def nearest(
    word: str,
    known: Iterable[str],
    aliases: Mapping[str, str] | None = None,
    likeness: float = 0.6,
) -> str | None:
    """Return the known word that is most like `word`, or None where none is like it.

    Parameters
    ----------
    word : str
        What the user wrote.
    known : iterable of str
        The words that would have been right.
    aliases : mapping of str to str, optional
        Lower-case words that people use, and the right word for each. They win over likeness.
    likeness : float, default 0.6
        How alike a known word must be, from 0 to 1; see `difflib.SequenceMatcher.ratio`.
    """
    folded = word.casefold()[: 2 * MAX_SHOWN]
    right = (aliases or {}).get(folded)
    if right is not None:
        return right
    by_folded = {name.casefold(): name for name in known}
    compared = by_folded if len(by_folded) <= MAX_COMPARED else ()
    close = get_close_matches(folded, compared, n=1, cutoff=likeness)
    return by_folded[close[0]] if close else None


def question(right: str | None) -> str:
    """Return ``"; did you mean X?"``, or ``""`` where there is no right word."""
    return f"; did you mean {right}?" if right else ""


def did_you_mean(
    word: str,
    known: Iterable[str],
    aliases: Mapping[str, str] | None = None,
    likeness: float = 0.6,
) -> str:
    """Return the `question` for the known word that is `nearest` to a word."""
    return question(nearest(word, known, aliases, likeness))


def did_you_mean_symbol(name: str, known: Iterable[str]) -> str:
    """Return `did_you_mean` for names of symbols, of which half may differ: q2 for q1."""
    return did_you_mean(name, known, likeness=0.5)
