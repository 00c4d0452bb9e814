"""A limit on the CPU time of a search, looked at inside of its steps and not between them alone."""

from __future__ import annotations

from math import inf
from time import process_time


class OutOfTimeError(Exception):
    """The time of a search is used up; the search catches it."""


class Clock:
    """CPU time that is left.

    Parameters
    ----------
    seconds : float
        How long the search may take.
    """

    def __init__(self, seconds: float = inf) -> None:
        self._deadline = process_time() + seconds

    def check(self) -> None:
        """Raise where the time is used up.

        Raises
        ------
        OutOfTimeError
        """
        if process_time() > self._deadline:
            raise OutOfTimeError

    def stop(self) -> None:
        """End the limit: what is done with a solution later takes its own time."""
        self._deadline = inf
