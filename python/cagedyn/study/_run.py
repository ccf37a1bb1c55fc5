"""Running studies."""

from __future__ import annotations

import hashlib
import inspect
import itertools
import json
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from distributed import Client

from .._model import Model
from .._native import Error, version
from .._sim import Sim
from . import _build
from ._cluster import connected
from ._error import StudyError
from ._flight import Flight
from ._points import Points, Value, is_number, listed, plain_point
from ._progress import Progress, Teller
from ._results import Results, read
from ._row import Job
from ._sources import Asked, Listed, Optimiser, Source
from ._statistics import chosen_outputs
from ._store import TABLE, Store, write

#: A file of a scene, or what it holds.
Scene = str | os.PathLike[str] | Mapping[str, Any]


def run(
    scene: Scene,
    points: Points | Iterable[Mapping[str, Value]],
    folder: str | os.PathLike[str],
    *,
    overrides: Mapping[str, Value] | None = None,
    outputs: Iterable[str] | None = None,
    of_sim: Callable[[Sim], Mapping[str, float]] | None = None,
    of_model: Callable[[Model], Mapping[str, float]] | None = None,
    client: Client | str | None = None,
    timeout: float = 10.0,
    progress: Callable[[Progress], object] | None = None,
) -> Results:
    """Runs a scene at every point that the folder does not have yet, and keeps each as it arrives.

    At a point the scene, with its values and with `overrides`, is run to the end of its record: kept are mean,
    deviation, extremes and percentiles of `outputs` over the averaging window, of all that are not of one element
    by default, and whether the run is to be trusted. Instead `of_sim`, given a simulation at its start, or
    `of_model` gives numbers by name. It is known by its name and source text: a folder whose results are of
    another is refused, but what it calls may change unseen.

    `client` is where points are run: a process for each core of this machine by default, the address of a
    scheduler as in "tcp://host:8786", that must answer within `timeout` in s, or a client of one. `progress` is
    called ten times a second; by default a line is shown on a terminal.

    A point that fails, or kills its workers, is a row with the reason. What stops the study costs no point that
    was done: the same call goes on. Results have the same bits on any number of workers.

    Raises StudyError for what cannot be run as a whole, Error for a path that the scene does not have and for a
    scene that is wrong at all points, OSError for files.
    """
    points = points if isinstance(points, Points) else listed(points)
    if not len(points):
        raise StudyError("points: there are none")
    job = _job(scene, overrides, outputs, of_sim, of_model)
    _check(job, points)
    identity = {**_identity(job), "paths": points.paths, "shape": points.shape, "points": points.rows}
    with Store(folder, identity) as store:
        return _drive(job, Listed(points, store.rows), store, points.paths, client, timeout, progress)


def optimise(
    scene: Scene,
    optimiser: Optimiser,
    folder: str | os.PathLike[str],
    *,
    count: int,
    ahead: int = 1,
    overrides: Mapping[str, Value] | None = None,
    outputs: Iterable[str] | None = None,
    of_sim: Callable[[Sim], Mapping[str, float]] | None = None,
    of_model: Callable[[Model], Mapping[str, float]] | None = None,
    client: Client | str | None = None,
    timeout: float = 10.0,
    progress: Callable[[Progress], object] | None = None,
) -> Results:
    """Runs a scene at points that an optimiser asks for, until there are `count` of them or it asks for no more.

    It is asked when fewer than `ahead` points have not been told yet, and told in the order of points. With 1 that
    is point by point, or list by list for one that asks for lists; one that can propose points before it knows
    those before keeps more workers busy with more. To go on, give an optimiser that asks for the same points
    again: it is told what the folder has. `count` may then be larger.

    Everything else is as in `run`.
    """
    for name, number in (("count", count), ("ahead", ahead)):
        if isinstance(number, bool) or not isinstance(number, int) or number < 1:
            raise StudyError(f"{name}: {number!r} is not a whole number from 1 on")
    job = _job(scene, overrides, outputs, of_sim, of_model)
    source = Asked(optimiser, count, ahead)
    _check(job, listed([source.first]))
    paths = tuple(source.first)
    with Store(folder, {**_identity(job), "paths": paths, "shape": None, "points": None}) as store:
        source.resume(store.rows)
        return _drive(job, source, store, paths, client, timeout, progress)


def _job(scene: Scene, overrides: Any, outputs: Iterable[str] | None, of_sim: Any, of_model: Any) -> Job:
    """What is the same at all points. Raises StudyError for arguments that do not fit together."""
    given = [
        name
        for name, what in (("outputs", outputs), ("of_sim", of_sim), ("of_model", of_model))
        if what is not None
    ]
    if len(given) > 1:
        raise StudyError(f"{given[0]}: cannot be used with {given[1]}")
    text = json.dumps(scene) if isinstance(scene, Mapping) else Path(scene).read_text(encoding="utf-8-sig")
    try:
        build = _build.build()
    except OSError as failure:
        raise StudyError(f"CAGEDYN_LIBRARY: must be the path of a file: {failure}") from None
    replaced = plain_point(overrides, "overrides") if overrides else {}
    return Job(build, text, replaced, None if outputs is None else list(outputs), of_sim, of_model)


def _check(job: Job, points: Points) -> None:
    """Refuses what no point can be run with: a path, a word or an output that the scene does not know. A value out
    of its range is told in the row of its point, unless all are."""
    for path in points.paths:
        if path in job.overrides:
            raise StudyError(f"points: {path} is what overrides replace, too")
    known: set[tuple[str, str]] = set()
    model, first = None, None
    for number, point in enumerate(points):
        words = {(path, json.dumps(value)) for path, value in point.items() if not is_number(value)}
        if model is not None and words <= known:
            continue
        known |= words
        try:
            model = job.model(point)
        except Error as failure:
            if failure.name != "ERR_BAD_SCENE":
                raise
            text = ", ".join(f"{path} = {json.dumps(value)}" for path, value in point.items())
            first = first or Error(
                failure.status, f"no point can be simulated; point {number} ({text}): {failure}"
            )
    if model is None and first is not None:
        raise first
    if model is not None and job.outputs is not None:
        try:
            chosen_outputs(model, job.outputs)
        except KeyError as failure:
            raise StudyError(f"outputs: {failure.args[0]}") from None


def _identity(job: Job) -> dict[str, Any]:
    """All that results depend on, but for the points."""
    try:
        scene = json.loads(job.scene)
    except ValueError as failure:
        raise StudyError(f"scene: {failure}") from None
    return {
        "schema": "cagedyn.study/1",
        "version": version(),
        "build": job.build,
        "scene": scene,
        "overrides": job.overrides,
        "outputs": job.outputs,
        "function": _function("of_sim", job.of_sim) or _function("of_model", job.of_model),
    }


def _function(argument: str, function: Any) -> str | None:
    """What a function of the user is known by."""
    if function is None:
        return None
    try:
        source = inspect.getsource(function)
    except (OSError, TypeError):
        raise StudyError(f"{argument}: {function!r} must be a function whose source text is in a file") from None
    return f"{argument} {function.__qualname__} {hashlib.sha256(source.encode()).hexdigest()}"


def _drive(
    job: Job,
    source: Source,
    store: Store,
    paths: tuple[str, ...],
    client: Client | str | None,
    timeout: float,
    progress: Callable[[Progress], object] | None,
) -> Results:
    """Runs what is left, and writes the table."""
    teller = Teller(progress)
    earlier = [row for _, row in store.rows.values()]
    teller.begin(source.known, len(earlier), sum(row.error is not None for row in earlier))
    first = source.next()
    if first is not None:  # What is done already needs no workers.
        with connected(client, timeout) as connection, Flight(connection, job) as flight:
            try:
                teller.connected(flight.workers)
                flight.send(itertools.chain([first], iter(source.next, None)))
                while flight.busy:
                    landed = flight.landed()
                    store.keep(landed)
                    for point, (_, row) in landed.items():
                        source.done(point, row)
                        teller.arrived(source.known, row.error is not None, flight.workers)
                    flight.send(iter(source.next, None))
            except StudyError as failure:
                kept = f"{len(store.rows)} of {source.known} points are kept"
                raise StudyError(f"{failure}; {kept}, and the same call goes on with the others") from None
            finally:
                teller.end()
    else:
        teller.end()
    from ._table import parquet, table_of  # Workers, which import this package too, do without pyarrow.

    write(store.folder / TABLE, parquet(table_of(paths, store.rows)))
    return read(store.folder)
