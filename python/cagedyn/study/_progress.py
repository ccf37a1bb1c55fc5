"""How far a study is."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable
from dataclasses import dataclass

#: Wall time between two calls of what is told, s.
_BETWEEN = 0.1


@dataclass(frozen=True)
class Progress:
    """How many points are known, done, and failed of these; those of earlier runs of the study are counted."""

    points: int
    done: int
    failed: int
    #: Points of this run per s of wall time, mean since its start.
    rate: float
    #: Threads of workers that run them; 0 as long as there are none.
    workers: int


def line(progress: Progress) -> None:
    """Shows progress as one line on the terminal that is standard error; if it is none, nothing."""
    if sys.stderr.isatty():
        p = progress
        text = (
            f"{p.done} of {p.points} points done, {p.failed} of them failed, {p.rate:.3g}/s on {p.workers} workers"
        )
        sys.stderr.write(f"\r{text}\x1b[K")
        sys.stderr.flush()


class Teller:
    """Calls `tell` with the progress at its start, at its end and some times a second between."""

    def __init__(self, tell: Callable[[Progress], object] | None) -> None:
        self._tell = line if tell is None else tell
        self._began = self._told = clock.monotonic()
        self._earlier = self._done = self._failed = self._points = self._workers = 0

    def begin(self, points: int, done: int, failed: int) -> None:
        """Tells where the study starts from."""
        self._earlier = self._done = done
        self._failed, self._points = failed, points
        self._now()

    def connected(self, workers: int) -> None:
        """Tells how many workers there are; the rate is from then on."""
        self._began, self._workers = clock.monotonic(), workers
        self._now()

    def arrived(self, points: int, failed: bool, workers: int) -> None:
        """Counts one more point that is done, of so many that are known, and tells if it is time."""
        self._done, self._failed, self._points = self._done + 1, self._failed + failed, points
        self._workers = workers
        if clock.monotonic() - self._told >= _BETWEEN:
            self._now()

    def end(self) -> None:
        """Tells how far the study came, and ends the line on a terminal."""
        self._now()
        if self._tell is line and sys.stderr.isatty():
            sys.stderr.write("\n")

    def _now(self) -> None:
        self._told = clock.monotonic()
        took = max(self._told - self._began, 1e-9)
        rate = (self._done - self._earlier) / took
        self._tell(Progress(self._points, self._done, self._failed, rate, self._workers))
