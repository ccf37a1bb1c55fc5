"""Points that are with the workers."""

from __future__ import annotations

import math
import time as clock
import uuid
from collections.abc import Mapping
from concurrent.futures import CancelledError
from typing import Any

from distributed import KilledWorker, as_completed

from ._build import WrongBuild
from ._error import StudyError
from ._points import Value
from ._row import Job, Row, compute, failed

#: Wall time after which the number of workers is asked for again, s.
_PATIENCE = 1.0


def _same(job: Job) -> Job:
    """Brings what is the same at all points to the workers once, again to those that come later or come back."""
    return job


class KilledPoint(Exception):
    """A point that kills the worker that runs it."""


class Flight:
    """Sends points to workers, some more than they have threads so that none waits for the next; a context."""

    def __init__(self, client: Any, job: Job) -> None:
        self._client, self._job, self._address = client, job, client.scheduler.address
        self._name, self._sent = f"cagedyn-{uuid.uuid4().hex}", 0
        self._shared = self._submit(_same, job)
        self._flying: dict[Any, tuple[int, Mapping[str, Value]]] = {}
        self._landing = as_completed(loop=client.loop, with_results=True, raise_errors=False)  # type: ignore[no-untyped-call]
        #: Points at which a worker died, perhaps because of another point that it had.
        self._suspects: list[tuple[int, Mapping[str, Value]]] = []
        self._alone = False
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
    def full(self) -> bool:
        """Whether no more points should be sent now."""
        return self._alone or len(self._flying) >= 2 * self.workers + 2

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

    def send(self, point: int, values: Mapping[str, Value]) -> None:
        """Gives a point to the workers."""
        if self._shared.status in ("error", "cancelled", "lost"):
            self._shared = self._submit(_same, self._job)
        future = self._submit(compute, self._shared, values)
        self._flying[future] = (point, values)
        self._landing.add(future)  # type: ignore[no-untyped-call]

    def landed(self) -> dict[int, tuple[list[Value], Row]]:
        """Waits until points are done; values and rows of all that are. None may be, where a worker died and they
        are sent again.

        Raises StudyError where the scheduler is lost or a worker cannot run points at all.
        """
        if not self._flying:
            self._alone = True
            self.send(*self._suspects.pop(0))
        rows = {}
        arrived = [next(self._landing)]
        while self._landing.has_ready():  # type: ignore[no-untyped-call]
            arrived.append(next(self._landing))
        for future, result in arrived:
            point, values = self._flying.pop(future)
            row = self._row(point, values, result)
            if row is not None:
                rows[point] = (list(values.values()), row)
        if self._alone and not self._flying:
            self._alone = False
        return rows

    def _row(self, point: int, values: Mapping[str, Value], result: Any) -> Row | None:
        if isinstance(result, Row):
            return result
        failure = result[1] if isinstance(result, tuple) else result
        if isinstance(failure, KilledWorker):
            if not self._alone:
                self._suspects.append((point, values))
                return None
            deaths = failure.allowed_failures + 1
            return failed(KilledPoint(f"{deaths} workers died, one after another, that ran this point alone"))
        if isinstance(failure, CancelledError):
            raise self._lost()
        if isinstance(failure, WrongBuild):
            raise StudyError(f"client: a worker {failure}")
        raise StudyError(f"client: a worker cannot run points: {type(failure).__name__}: {failure}")

    def _lost(self) -> StudyError:
        return StudyError(f"client: the scheduler at {self._address} is lost")

    def _submit(self, function: Any, *arguments: Any) -> Any:
        self._sent += 1
        return self._client.submit(function, *arguments, key=(self._name, self._sent), pure=False)
