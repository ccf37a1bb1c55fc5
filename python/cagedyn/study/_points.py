"""Points of a study: every combination of values, a list, or a Latin hypercube."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._error import StudyError

#: A value of a scene as JSON has it.
Value = Any


@dataclass(frozen=True)
class Points:
    """Points that all have values for the same paths. Iterating gives each as a mapping."""

    #: What varies, as paths of the scene.
    paths: tuple[str, ...]
    #: Values of every point, in the order of the paths.
    rows: tuple[tuple[Value, ...], ...]
    #: Number of values of each path, of a grid, whose last path varies fastest; None of other points.
    shape: tuple[int, ...] | None = None

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Value]]:
        return (dict(zip(self.paths, row)) for row in self.rows)


def grid(values: Mapping[str, Iterable[Value]]) -> Points:
    """Every combination of the values that each path takes, the last path varying fastest.

    Raises StudyError for a path without values, for one that is listed twice, and for what is no value of a scene.
    """
    levels = {path: _levels(path, items) for path, items in _paths(values, "grid").items()}
    shape = tuple(len(items) for items in levels.values())
    return Points(tuple(levels), tuple(itertools.product(*levels.values())), shape)


def listed(points: Iterable[Mapping[str, Value]]) -> Points:
    """The points of a list, each of which maps the same paths to values.

    Raises StudyError for an empty list, for a point with other paths than the first, and for what is no value of a
    scene.
    """
    rows: list[tuple[Value, ...]] = []
    paths: tuple[str, ...] = ()
    for number, point in enumerate(points):
        where = f"points: number {number}"
        checked = plain_point(point, where)
        paths = paths or tuple(checked)
        if checked.keys() != set(paths):
            raise StudyError(f"{where}: has {', '.join(checked)}, not {', '.join(paths)} as the first point")
        rows.append(tuple(checked[path] for path in paths))
    if not rows:
        raise StudyError("points: there are none")
    return Points(paths, tuple(rows))


def latin(ranges: Mapping[str, Any], count: int, seed: int = 0) -> Points:
    """`count` points of a Latin hypercube: of `count` layers of every range each holds one point.

    A range is a tuple (from, to), or (from, to, "log") for layers of equal ratio; of a list every item is taken as
    often. The same seed gives the same points.

    Raises StudyError for what is no range, and for a count below 1.
    """
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
        raise StudyError(f"latin: count {count!r} is not a whole number from 1 on")
    random = np.random.default_rng(seed)
    columns = []
    for path, given in _paths(ranges, "latin").items():
        shares = (random.permutation(count) + random.random(count)) / count
        columns.append(_at(path, given, shares))
    return Points(tuple(ranges), tuple(zip(*columns)))


def plain(value: Any, where: str) -> Value:
    """A value of a scene as JSON has it, also of NumPy's numbers and arrays. Raises StudyError for anything else."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, float) and math.isfinite(value):
        return value
    if isinstance(value, (list, tuple)):
        return [plain(item, where) for item in value]
    raise StudyError(f"{where}: {value!r} is no finite number, text, bool, None or list of these")


def plain_point(point: Any, where: str) -> dict[str, Value]:
    """A point with values as JSON has them. Raises StudyError for what is no point."""
    if not isinstance(point, Mapping):
        raise StudyError(f"{where}: {point!r} is no mapping from paths to values")
    return {path: plain(value, f"{where}: {path}") for path, value in _paths(point, where).items()}


def _paths(mapping: Mapping[str, Any], where: str) -> Mapping[str, Any]:
    """The same, if its keys can be paths of a scene."""
    if not mapping:
        raise StudyError(f"{where}: no path is given")
    for path in mapping:
        if not isinstance(path, str) or not path or any(mark in path for mark in "=\r\n"):
            raise StudyError(f"{where}: {path!r} is no path of a scene, such as 'cage.mass'")
    return mapping


def _levels(path: str, items: Any) -> list[Value]:
    if isinstance(items, (str, Mapping)) or not isinstance(items, Iterable):
        raise StudyError(f"grid: {path}: {items!r} is no list of values")
    levels = [plain(item, f"grid: {path}") for item in items]
    if not levels:
        raise StudyError(f"grid: {path}: has no values")
    known: set[str] = set()
    for level in levels:
        # 1 and 1.0 are one place of an axis, 1 and True are not.
        text = repr(float(level)) if is_number(level) else json.dumps(level)
        if text in known:
            raise StudyError(f"grid: {path}: {level!r} is listed twice")
        known.add(text)
    return levels


def _at(path: str, given: Any, shares: np.ndarray[Any, Any]) -> Sequence[Value]:
    """What lies at shares from 0 to below 1 of a range or list."""
    where = f"latin: {path}"
    if isinstance(given, list) and given:
        items = [plain(item, where) for item in given]
        return [items[int(share * len(items))] for share in shares]
    ends = [plain(end, where) for end in given[:2]] if isinstance(given, tuple) else []
    log = ends and given[2:] == ("log",)
    if len(ends) != 2 or not all(map(is_number, ends)) or ends[0] == ends[1] or not (log or given[2:] == ()):
        raise StudyError(f'{where}: {given!r} is no (from, to), no (from, to, "log") and no list of values')
    start, stop = map(float, ends)
    if not log:
        return [start + (stop - start) * share for share in shares.tolist()]
    if start * stop <= 0.0:
        raise StudyError(f"{where}: {given!r}: both ends must be above zero, or both below")
    return [start * (stop / start) ** share for share in shares.tolist()]


def is_number(value: Value) -> bool:
    """Whether a value of a scene is a number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
