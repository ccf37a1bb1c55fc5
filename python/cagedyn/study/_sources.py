"""Where the points of a study come from: a list, or an optimiser that is told what came of those before."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any, Protocol

from ._error import StudyError
from ._points import Points, Value, plain_point
from ._row import Row, flat
from ._store import Kept


class Optimiser(Protocol):
    """Whatever proposes points from what it is told of others."""

    def ask(self) -> Any:
        """A point, or a list of points that are wanted together; None or an empty list at the end."""

    def tell(self, point: Any, result: dict[str, Any], /) -> object:
        """Takes what came of a point that it asked for: results and ending by the names of columns, see
        `Results.table`."""


class Source(Protocol):
    """Hands out points that are not done, in their order."""

    @property
    def known(self) -> int:
        """Number of points that are known, done or not."""

    def next(self) -> tuple[int, Mapping[str, Value]] | None:
        """The next point to be run with its number; None if there is none at present."""

    def done(self, point: int, row: Row) -> None:
        """Takes what came of a point."""


class Listed:
    """Points that are known from the start."""

    def __init__(self, points: Points, rows: Mapping[int, Kept]) -> None:
        self.known = len(points)
        self._left = ((number, point) for number, point in enumerate(points) if number not in rows)

    def next(self) -> tuple[int, Mapping[str, Value]] | None:
        return next(self._left, None)

    def done(self, point: int, row: Row) -> None:
        pass


class Asked:
    """Points of an optimiser. It is asked and told in an order that does not depend on which point is done first,
    so that a study that goes on has the same points as one that was never stopped."""

    def __init__(self, optimiser: Optimiser, count: int, ahead: int) -> None:
        self._optimiser, self._count, self._ahead = optimiser, count, ahead
        self._asked: list[tuple[Any, dict[str, Value]]] = []
        self._left: deque[int] = deque()
        self._kept: Mapping[int, Kept] = {}
        self._rows: dict[int, Row] = {}
        self._told, self._ended = 0, False
        self._ask()
        if not self._asked:
            raise StudyError("optimiser: ask() gave no point")

    @property
    def first(self) -> dict[str, Value]:
        """The point that was asked for first."""
        return self._asked[0][1]

    def resume(self, rows: Mapping[int, Kept]) -> None:
        """Takes what is known from an earlier run."""
        self._kept = rows
        for number in list(self._left):
            self._recall(number)

    @property
    def known(self) -> int:
        return len(self._asked)

    def next(self) -> tuple[int, Mapping[str, Value]] | None:
        while not self._left:
            if not self._ended and len(self._asked) < self._count and len(self._asked) - self._told < self._ahead:
                self._ask()
            elif self._told in self._rows:
                point, _ = self._asked[self._told]
                self._optimiser.tell(point, flat(self._rows.pop(self._told)))
                self._told += 1
            else:
                return None
        number = self._left.popleft()
        return number, self._asked[number][1]

    def done(self, point: int, row: Row) -> None:
        self._rows[point] = row

    def _ask(self) -> None:
        points = self._optimiser.ask()
        points = [points] if isinstance(points, Mapping) else list(points or [])
        self._ended = not points
        for point in points:
            number = len(self._asked)
            where = f"optimiser: point {number}"
            values = plain_point(point, where)
            paths = list(self._asked[0][1]) if self._asked else list(values)
            if values.keys() != set(paths):
                raise StudyError(f"{where}: has {', '.join(values)}, not {', '.join(paths)} as the first point")
            self._asked.append((point, {path: values[path] for path in paths}))
            self._left.append(number)
            self._recall(number)

    def _recall(self, number: int) -> None:
        """Takes the row of a point that an earlier run has done."""
        if number not in self._kept:
            return
        values, row = self._kept[number]
        asked = self._asked[number][1]
        if list(values) != list(asked.values()):
            raise StudyError(
                f"optimiser: asks for {asked} as point {number}, where the folder has {list(values)}; begun anew"
                " it must ask for the same points, so give it the same seed"
            )
        self._left.remove(number)
        self._rows[number] = row
