"""Points that are with the workers."""

from __future__ import annotations

import itertools
import math
import time as clock
import uuid
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from typing import Any

from distributed import KilledWorker, as_completed

from ._build import WrongBuild
from ._error import StudyError
from ._points import Value
from ._row import Job, Row, compute_all, failed, packed

#: Wall time after which the number of workers is asked for again, s.
_PATIENCE = 1.0

#: Points that take less than this together are sent together, s, and how many at most: what they find is kept once
#: all are done.
_TOGETHER, _MOST_TOGETHER = 0.25, 50

#: A point with its number.
Numbered = tuple[int, Mapping[str, Value]]


def _same(job: bytes) -> bytes:
    """Brings what is the same at all points to each worker once, also to those that come later or come back."""
    return job


class KilledPoint(Exception):
    """A point that kills the worker that runs it."""


class Flight:
    """Sends points to workers, more of them than there are threads, so that none waits for the next, and short
    points several at a time; a context."""

    def __init__(self, client: Any, job: Job) -> None:
        """Raises StudyError for a function that cannot be sent."""
        self._client, self._address = client, client.scheduler.address
        try:
            self._job = packed(job)
        except Exception as failure:
            raise StudyError(
                f"the function of the study cannot be sent: {type(failure).__name__}: {failure}"
            ) from None
        self._name, self._sent = f"cagedyn-{uuid.uuid4().hex}", 0
        self._shared = self._submit(_same, self._job)
        self._flying: dict[Any, Sequence[Numbered]] = {}
        self._landing = as_completed(loop=client.loop, with_results=True, raise_errors=False)  # type: ignore[no-untyped-call]
        #: Points at which a worker died, perhaps because of another point that it had.
        self._suspects: list[Numbered] = []
        self._alone = False
        #: Wall time of the points that were run, s, and their number.
        self._took, self._ran = 0.0, 0
        self._workers, self._asked = 0, -math.inf

    def __enter__(self) -> Flight:
        return self

    def __exit__(self, *_: object) -> None:
        if self._flying and self._client.status == "running":
            self._client.cancel(list(self._flying))

    @property
    def busy(self) -> bool:
        """Whether there is something to wait for."""
        return bool(self._flying or self._suspects)

    @property
    def workers(self) -> int:
        """Number of threads that run points."""
        if clock.monotonic() - self._asked >= _PATIENCE:
            try:
                self._workers = sum(self._client.nthreads().values())
            except OSError:
                raise self._lost() from None
            self._asked = clock.monotonic()
        return self._workers

    def send(self, points: Iterator[Numbered]) -> None:
        """Gives as many of these points to the workers as they should have now."""
        free = 0 if self._alone else 2 * self.workers + 2 - len(self._flying)
        if free <= 0:
            return
        together = int(_TOGETHER * self._ran / self._took) if self._took > 0.0 else 1
        taken = list(itertools.islice(points, free * max(1, min(together, _MOST_TOGETHER))))
        parts = min(free, len(taken))
        for part in range(parts):
            self._send(taken[part::parts])

    def landed(self) -> dict[int, tuple[list[Value], Row]]:
        """Waits until points are done; values and rows of all that are. None may be, where a worker died and they
        are sent again.

        Raises StudyError where the scheduler is lost or a worker cannot run points at all.
        """
        if not self._flying:
            self._alone = True
            self._send([self._suspects.pop(0)])
        arrived = [next(self._landing)]
        while self._landing.has_ready():  # type: ignore[no-untyped-call]
            arrived.append(next(self._landing))
        rows = {}
        for future, result in arrived:
            points = self._flying.pop(future)
            for (number, values), row in zip(points, self._rows(points, result)):
                rows[number] = (list(values.values()), row)
        self._alone = self._alone and bool(self._flying)
        return rows

    def _rows(self, points: Sequence[Numbered], result: Any) -> Sequence[Row]:
        """Rows of points; none where they are to be sent again."""
        failure = result[1] if isinstance(result, tuple) else result
        if isinstance(failure, float):
            self._took, self._ran = self._took + failure, self._ran + len(points)
            rows: list[Row] = result[0]
            return rows
        if isinstance(failure, KilledWorker):
            if not self._alone:
                self._suspects.extend(points)
                return []
            deaths = failure.allowed_failures + 1
            return [failed(KilledPoint(f"{deaths} workers died, one after another, that ran this point alone"))]
        if isinstance(failure, CancelledError):
            raise self._lost()
        if isinstance(failure, WrongBuild):
            raise StudyError(f"client: a worker {failure}")
        raise StudyError(f"client: a worker cannot run points: {type(failure).__name__}: {failure}")

    def _send(self, points: Sequence[Numbered]) -> None:
        if self._shared.status in ("error", "cancelled", "lost"):
            self._shared = self._submit(_same, self._job)
        future = self._submit(compute_all, self._shared, [values for _, values in points])
        self._flying[future] = points
        self._landing.add(future)  # type: ignore[no-untyped-call]

    def _lost(self) -> StudyError:
        return StudyError(f"client: the scheduler at {self._address} is lost")

    def _submit(self, function: Any, *arguments: Any) -> Any:
        self._sent += 1
        return self._client.submit(function, *arguments, key=(self._name, self._sent), pure=False)
