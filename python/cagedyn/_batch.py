"""Many simulations at once, on all cores."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from ._native import Error, check, counted, ffi, filled, last_error, lib, made, text
from ._sim import Sim


@dataclass(frozen=True)
class Progress:
    """How many simulations do what, and the share of the way that is done, from 0 to 1."""

    simulations: int
    waiting: int
    running: int
    arrived: int
    failed: int
    share: float


class BatchError(Error):
    """Some simulations of a batch failed; the others arrived. Code and message are those of the first of them."""

    def __init__(self, failures: list[Error | None]) -> None:
        failed = [(place, failure) for place, failure in enumerate(failures) if failure is not None]
        place, first = failed[0]
        super().__init__(first.status, f"{len(failed)} of {len(failures)} simulations failed; number {place}: {first}")
        #: The failure of each simulation, or None.
        self.failures = failures

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.failures,), self.__dict__


class Batch:
    """Simulations that advance together, each with the results that it has alone.

    The simulations belong to the batch from then on; they can be used as before while it does not run.
    """

    def __init__(self, sims: Iterable[Sim]) -> None:
        self._handle = made(lib.cagedyn_batch_new(), lib.cagedyn_batch_free)
        self._monitor = made(lib.cagedyn_monitor_new(self._handle), lib.cagedyn_monitor_free)
        #: The simulations in their order.
        self.sims: list[Sim] = []
        for sim in sims:
            counted(lib.cagedyn_batch_add(self._handle, sim._handle))
            # The batch frees it now; the simulation keeps the batch alive.
            ffi.gc(sim._handle, None)
            sim._owner = self._handle  # type: ignore[attr-defined]
            self.sims.append(sim)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.sims,)

    def __repr__(self) -> str:
        return f"Batch({self.sims!r})"

    def __len__(self) -> int:
        return len(self.sims)

    def __getitem__(self, place: int) -> Sim:
        return self.sims[place]

    @property
    def progress(self) -> Progress:
        """How far the running advance is, or how far the last one came. May be asked from any thread."""
        x = filled(6, lambda p, n: lib.cagedyn_monitor_progress(self._monitor, p, n))
        simulations, waiting, running, arrived, failed = (int(n) for n in x[:5])
        return Progress(simulations, waiting, running, arrived, failed, float(x[5]))

    def cancel(self) -> None:
        """Stops the running advance from another thread; all simulations can then go on."""
        check(lib.cagedyn_monitor_cancel(self._monitor))

    def advance_to(
        self,
        t: float,
        threads: int = 0,
        progress: Callable[[Progress], None] | None = None,
        check: bool = True,
    ) -> list[Error | None]:
        """Advances all to time `t` in s, on so many threads, on all cores for 0.

        Raises BatchError when some of them failed, after all others have arrived; with `check=False` returns the failure of each
        instead, or None. Raises Error when none may begin, as for a time that is not finite or a simulation in use. `progress` is
        called ten times a second while it runs. Ctrl-C stops all after a step, as KeyboardInterrupt; they can then go on.
        """
        if threads < 0:
            raise ValueError(f"threads: {threads} is not 0 or more")
        for sim in self.sims:
            sim._renew_wall_time_limit()
        done = threading.Event()
        ended: list[Error] = []

        def run() -> None:
            try:
                if lib.cagedyn_batch_advance_to(self._handle, t, threads) != 0:
                    ended.append(last_error())
            finally:
                done.set()

        t = float(t)
        worker = threading.Thread(target=run)
        worker.start()
        try:
            while not done.wait(0.1):
                if progress is not None:
                    progress(self.progress)
        except BaseException:
            # What has ended would keep the request for its next advance.
            if not done.is_set():
                self.cancel()
            done.wait()
            raise
        worker.join()
        failures: list[Error | None] = []
        for place in range(len(self.sims)):
            status = lib.cagedyn_batch_status(self._handle, place)
            message = text(lib.cagedyn_batch_message(self._handle, place))
            failures.append(Error(status, message) if status != 0 else None)
        if ended and all(failure is None for failure in failures):
            raise ended[0]  # The call itself was refused.
        if check and ended:
            raise BatchError(failures)
        return failures
