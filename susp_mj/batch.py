"""Many jobs side by side on the cores of this machine."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

from .errors import InputError

Job = TypeVar("Job")
Prepared = TypeVar("Prepared")
Worked = TypeVar("Worked")
Result = TypeVar("Result")
Progress = Callable[[float], None]


def usable_cores() -> int:
    """Number of processor cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def free_memory() -> float:
    """Memory [bytes] that programs can still take; infinite where the system does not tell."""
    try:
        text = Path("/proc/meminfo").read_text(encoding="ascii")
    except OSError:
        return math.inf
    kilobytes = next((line.split()[1] for line in text.splitlines() if line.startswith("MemAvailable:")), None)
    return math.inf if kilobytes is None else 1024.0 * int(kilobytes)


def side_by_side(
    jobs: Sequence[Job],
    prepare: Callable[[Job], Prepared],
    work: Callable[[Prepared, Progress], Worked],
    finish: Callable[[Worked], Result],
    *,
    workers: int | None = None,
    progress: Callable[[int, float], None] = lambda place, done: None,
) -> list[Result]:
    """``finish(work(prepare(job)))`` of every job, in the order of the jobs, whatever the number of workers.

    Threads do the work, which is to hold no Python lock, as the stepping loop does; nothing is copied. Meanwhile the
    calling thread prepares what comes next and finishes what is done.

    A job that cannot be prepared ends all work. One whose work fails ends that of the jobs after it, at their next word
    of progress; those before it are finished. So the error does not depend on the number of workers either.

    Args:
        prepare: what is quick and finds bad input.
        work: depends on what was prepared alone; calls its second argument with the fraction of the job done.
        finish: what Python does with the result.
        workers: at most so many jobs at a time; None takes the usable cores.
        progress: called by one thread at a time, with the place of the job that goes on and the fraction of all done.

    Raises:
        InputError: fewer than one worker.
        Exception: of the first job that cannot be prepared, or else of the first that fails later.
    """
    workers = usable_cores() if workers is None else workers
    if workers < 1:
        raise InputError(f"{workers} is not allowed; it must be at least 1", key="workers")
    board = _Board(len(jobs), progress)

    def one(place: int, prepared: Prepared) -> Worked:
        try:
            board.report(place, 0.0)
            return work(prepared, lambda done: board.report(place, done))
        except BaseException:
            board.end_after(place)
            raise

    with ThreadPoolExecutor(workers) as pool:
        try:
            under_way = [pool.submit(one, place, prepare(job)) for place, job in enumerate(jobs)]
            return [finish(future.result()) for future in under_way]
        finally:
            board.end_after(-1)  # the pool waits for what is under way, also when the user stops it


class _Ended(Exception):
    """Raised inside a job whose result nobody needs any more."""


class _Board:
    """What the workers tell each other: how far each job is, and after which one there is nothing to do."""

    def __init__(self, jobs: int, progress: Callable[[int, float], None]) -> None:
        self._done, self._last, self._progress = [0.0] * jobs, jobs, progress
        self._lock = threading.Lock()

    def report(self, place: int, done: float) -> None:
        """Note the fraction of a job done; ends the job if it is not needed."""
        with self._lock:
            if place > self._last:
                raise _Ended
            self._done[place] = done
            self._progress(place, sum(self._done) / len(self._done))

    def end_after(self, place: int) -> None:
        """Let no job after this one go on."""
        with self._lock:
            self._last = min(self._last, place)
