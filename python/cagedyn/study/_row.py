"""What a worker does: the run of one point, and what is kept of it."""

from __future__ import annotations

import functools
import time as clock
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import numpy as np

from .._model import Model
from .._native import Error
from .._sim import Sim
from . import _build
from ._points import Value
from ._statistics import statistics


@dataclass(frozen=True)
class Job:
    """What is the same at all points."""

    #: Build of the library that every worker must have.
    build: str
    #: Text of the scene.
    scene: str
    #: Values that replace those of the scene at all points.
    overrides: Mapping[str, Value]
    #: Outputs whose statistics are taken; None for all that are not of one element.
    outputs: list[str] | None = None
    #: What is computed instead, if one of them is given.
    of_sim: Callable[[Sim], Mapping[str, float]] | None = None
    of_model: Callable[[Model], Mapping[str, float]] | None = None

    def model(self, values: Mapping[str, Value]) -> Model:
        """The model of a point. Raises Error as `Model.from_json`."""
        return Model.from_json(self.scene, {**self.overrides, **values})


@dataclass(frozen=True)
class Row:
    """What is known of a point that is done."""

    results: Mapping[str, float | str]
    #: Where the run ended, s; None where there was none.
    simulated_time: float | None = None
    #: Whether the run kept what its preset promises; None where that is not known.
    trusted: bool | None = None
    #: What speaks against that.
    doubts: str = ""
    #: Name of the error of the library or of Python, and one line about it.
    error: tuple[str, str] | None = None


#: How a run ended: names of columns behind the results, as of the command `sweep`.
ENDING = ("simulated time [s]", "complete", "trusted", "doubts", "error code", "error")


def ending(row: Row) -> tuple[Any, ...]:
    """The cells of these columns; None for what is not known."""
    code, message = row.error or (None, None)
    return row.simulated_time, row.error is None, row.trusted, row.doubts or None, code, message


def flat(row: Row) -> dict[str, Any]:
    """Results and ending by the names of columns."""
    return {**row.results, **dict(zip(ENDING, ending(row)))}


def packed(job: Job) -> bytes:
    """What is the same at all points as it is sent. Raises whatever a function that cannot be sent gives."""
    content: bytes = cloudpickle.dumps(job)
    return content


@functools.lru_cache(maxsize=1)
def _unpacked(content: bytes) -> Job:
    job: Job = cloudpickle.loads(content)
    return job


def compute_all(content: bytes, points: Sequence[Mapping[str, Value]]) -> tuple[list[Row], float]:
    """Runs some points, one after the other; their rows, and the wall time of all, s.

    Raises WrongBuild as `compute`, and what a function gives that cannot be loaded here.
    """
    # Unpacked here and not by dask, which does not come back from what a worker cannot load.
    job, began = _unpacked(content), clock.perf_counter()
    return [compute(job, values) for values in points], clock.perf_counter() - began


def compute(job: Job, values: Mapping[str, Value]) -> Row:
    """Runs a point. Whatever fails is told in the row.

    Raises WrongBuild where the library of this process is not that of the study.
    """
    _build.check(job.build)
    sim: Sim | None = None
    try:
        model = job.model(values)
        if job.of_model is not None:
            return Row(_numbers(job.of_model(model), values))
        sim = Sim(model)
        results = _numbers(job.of_sim(sim), values) if job.of_sim is not None else statistics(sim, job.outputs)
        return Row(results, sim.time, sim.trusted, sim.doubts)
    except Exception as failure:
        return failed(failure, None if sim is None else sim.time)


def failed(failure: BaseException, simulated_time: float | None = None) -> Row:
    """The row of a point that failed."""
    name = failure.name if isinstance(failure, Error) else type(failure).__name__
    return Row({}, simulated_time, error=(name, " ".join(str(failure).split())))


def _numbers(results: Any, values: Mapping[str, Value]) -> dict[str, float | str]:
    """What a user's function gave, if that is numbers by names that are free."""
    if not isinstance(results, Mapping):
        raise TypeError(f"the function of the study gave {results!r}, which is no mapping from names to numbers")
    for name, value in results.items():
        if not isinstance(name, str) or not isinstance(value, (int, float, np.integer, np.floating, np.bool_)):
            raise TypeError(
                f"the function of the study gave {value!r} for {name!r}, which is no number for a name"
            )
        if name in ("point", *values, *ENDING):
            raise ValueError(f"the function of the study gave {name!r}, which is a column of the table already")
    return {name: float(value) for name, value in results.items()}
