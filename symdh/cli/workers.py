"""Jobs in processes of their own: as many at a time as there are cores, none stopped by another."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from types import FrameType
from typing import Any, NoReturn

_TERMINATED = 128 + signal.SIGTERM


@dataclass(frozen=True, slots=True)
class Lost:
    """A job whose process ended under it, killed for want of memory, say.

    Attributes
    ----------
    status : int or None
        Of the process; negative for the number of a signal.
    """

    status: int | None


def cores() -> int:
    """Return the number of cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def results_of(
    work: Callable[[Any], Any], jobs: Sequence[object], processes: int
) -> Iterator[tuple[int, Any]]:
    """Do jobs and yield each one's index and result, in the order in which they are done.

    Closing the iterator, or an exception in its midst, ends the processes at once.

    Parameters
    ----------
    work : callable
        A function of a module, for it is sent to other processes, as are jobs and results. What it
        raises is lost: it turns exceptions into results.
    jobs : sequence
    processes : int
        With 1, all jobs are done in this process.

    Yields
    ------
    index : int
    result : object
        What `work` returned, or a `Lost`.
    """
    processes = min(processes, len(jobs))
    if processes <= 1:
        for index, job in enumerate(jobs):
            yield index, work(job)
        return
    queue = iter(enumerate(jobs))
    team: dict[Any, _Worker] = {}
    try:
        for _ in range(processes):
            _add_worker(team, work, next(queue))
        while team:
            for connection in wait(list(team)):
                worker = team[connection]
                index, result = worker.index, worker.result()
                task = next(queue, None)
                if isinstance(result, Lost) or task is None:
                    del team[connection]
                    worker.dismiss()
                    if task is not None:
                        _add_worker(team, work, task)
                else:
                    worker.give(*task)
                yield index, result
    finally:
        for worker in team.values():
            worker.process.terminate()
        for worker in team.values():
            worker.dismiss()


def _add_worker(
    team: dict[Any, _Worker], work: Callable[[Any], Any], task: tuple[int, object]
) -> None:
    worker = _Worker(work)
    team[worker.connection] = worker
    worker.give(*task)


class _Worker:
    """A process that does one job after another, as long as somebody listens to it."""

    def __init__(self, work: Callable[[Any], Any]) -> None:
        # A forked process would hold the pipes of the others open, and could not tell when this
        # one is gone.
        context = get_context("spawn")
        self.connection, other = context.Pipe()
        self.process = context.Process(target=_serve, args=(other, work), daemon=True)
        self.index = -1
        with _interrupts_ignored():
            self.process.start()
        other.close()

    def give(self, index: int, job: object) -> None:
        self.index = index
        # If the process is gone, `result` says so.
        with suppress(OSError):
            self.connection.send(job)

    def result(self) -> Any:
        try:
            return self.connection.recv()
        except (EOFError, OSError):
            self.process.join()
            return Lost(self.process.exitcode)

    def dismiss(self) -> None:
        self.connection.close()
        self.process.join()


def _serve(connection: Connection, work: Callable[[Any], Any]) -> None:
    """Do jobs until the other end of the pipe is closed, as it is when its process has ended."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _stop)
    with suppress(EOFError, OSError):
        while True:
            connection.send(work(connection.recv()))


def _stop(number: int, frame: FrameType | None) -> NoReturn:
    """End this process, and let every clean-up run."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise SystemExit(_TERMINATED)


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Start processes that ignore Ctrl-C from their first moment: it is for the one that waits."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
