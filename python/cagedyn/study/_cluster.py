"""The workers of a study: processes of this machine, or whatever a scheduler of dask has."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import dask
from dask.system import CPU_COUNT
from distributed import Client, LocalCluster

from . import _build
from ._error import StudyError


#: What dask does many times a second beside the points, for its dashboard: it costs a tenth of a core.
_QUIET = {"distributed.worker.profile.enabled": False, "distributed.admin.tick.interval": "500ms"}


@contextlib.contextmanager
def local(workers: int | None = None) -> Iterator[Any]:
    """A client of so many processes of this machine, of one for each core by default, for several studies in turn;
    a context."""
    if workers is not None and (isinstance(workers, bool) or not isinstance(workers, int) or workers < 1):
        raise StudyError(f"workers: {workers!r} is not a whole number from 1 on")
    count = CPU_COUNT if workers is None else workers
    with (
        dask.config.set(_QUIET),
        LocalCluster(
            n_workers=count, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
        ) as cluster,  # type: ignore[no-untyped-call]
        Client(cluster, set_as_default=False) as client,  # type: ignore[no-untyped-call]
    ):
        yield client


@contextlib.contextmanager
def connected(client: Client | str | None, timeout: float) -> Iterator[Any]:
    """A client whose workers have the library of this process. What was made for it ends with it; what was given
    goes on.

    Raises StudyError where there is no scheduler within `timeout` in s, and for a worker with another build of the
    library.
    """
    with contextlib.ExitStack() as made:
        if client is None:
            client = made.enter_context(local())
        elif isinstance(client, str):
            client = made.enter_context(_at(client, timeout))
        elif not isinstance(client, Client) or client.asynchronous:
            raise StudyError(
                f"client: {client!r} is no address, and no distributed.Client that is not asynchronous"
            )
        _check_builds(client)
        yield client


def _at(address: str, timeout: float) -> Any:
    if not address:
        raise StudyError("client: '' is no address, such as 'tcp://host:8786'")
    try:
        return Client(address, timeout=timeout, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, TimeoutError):
        raise StudyError(f"client: there is no scheduler at {address!r} within {timeout:g} s") from None
    except ValueError as failure:
        raise StudyError(f"client: {address!r} is no address, such as 'tcp://host:8786': {failure}") from None


def _check_builds(client: Any) -> None:
    """Those that come later look for themselves, before every point."""
    wanted = _build.build()
    try:
        builds = client.run(_build.build)
    except Exception as failure:
        raise StudyError(
            f"client: a worker cannot load cagedyn.study: {type(failure).__name__}: {failure}"
        ) from None
    for worker, found in builds.items():
        if found != wanted:
            raise StudyError(f"client: the worker at {worker} {_build.differs(found, wanted)}")
