"""What a study found, as a table and by its dimensions."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._error import StudyError
from ._store import ROWS, STUDY, TABLE, read_rows

# Both are loaded where they are used: workers, which import this package too, need neither.
if TYPE_CHECKING:
    import pyarrow as pa  # type: ignore[import-untyped]
    import xarray as xr


@dataclass(frozen=True)
class Results:
    """The points of a study that are done."""

    #: Where they are kept.
    folder: Path
    #: What was varied.
    paths: tuple[str, ...]
    #: Number of values of each path, of a grid; else None.
    shape: tuple[int, ...] | None
    #: One row for each point, in order: its number, the varied values, results, and how the run ended. What is not
    #: known is null.
    table: pa.Table

    @property
    def dataset(self) -> xr.Dataset:
        """The same by dimensions: of a grid the paths that were varied, else `point` with the varied values as
        coordinates.

        Names are without units, which are their attribute `units`. Where something is not known, numbers are NaN,
        texts empty and flags false; so are those of points of a grid that are not done yet.
        """
        import xarray as xr

        points = self.table["point"].to_numpy()
        sides, dimensions = self.shape or (len(points),), self.paths
        if self.shape is None:
            places, dimensions = np.arange(len(points)), ("point",)
            coordinates = {"point": points} | {path: ("point", self._cells(path)) for path in self.paths}
        else:
            places = points
            coordinates = {path: (path, values) for path, values in zip(self.paths, self._axes())}
        names = [name for name in self.table.column_names if name not in ("point", *self.paths)]
        plain = [name.rpartition(" [")[0] if name.endswith("]") else name for name in names]
        variables = {}
        for name, short in zip(names, plain):
            cells = self._cells(name)
            values = np.full(math.prod(sides), np.nan if cells.dtype.kind == "f" else cells.dtype.type())
            values = values.astype(cells.dtype)
            values[places] = cells
            alone = plain.count(short) == 1
            units = {"units": name[len(short) + 2 : -1]} if alone and short != name else {}
            variables[short if alone else name] = (dimensions, values.reshape(sides), units)
        return xr.Dataset(variables, coordinates)

    def _cells(self, name: str) -> Any:
        """A column with something in the place of what is not known, shape (rows,)."""
        column = self.table[name]
        kind = str(column.type)
        if kind == "string":
            return np.array([text or "" for text in column.to_pylist()], dtype=str)
        if kind == "bool":
            return np.array([bool(flag) for flag in column.to_pylist()], dtype=bool)
        return column.to_numpy()

    def _axes(self) -> list[Any]:
        """Values of each path of a grid, each once."""
        from ._table import varied

        shape = self.shape or ()
        rows = json.loads((self.folder / STUDY).read_bytes())["points"]
        steps = [math.prod(shape[place + 1 :]) for place in range(len(shape))]
        axes = [
            [row[place] for row in rows[: step * side : step]]
            for place, (step, side) in enumerate(zip(steps, shape))
        ]
        return [varied(axis).to_numpy(zero_copy_only=False) for axis in axes]


def read(folder: str | os.PathLike[str]) -> Results:
    """The results of a study, also of one that is not done, or that runs.

    Raises StudyError for a folder that is none of a study.
    """
    from ._table import from_parquet, table_of

    folder = Path(folder)
    try:
        study = json.loads((folder / STUDY).read_bytes())
        paths, shape = tuple(study["paths"]), study["shape"]
    except (OSError, ValueError, KeyError, TypeError):
        raise StudyError(f"{folder}: is not the folder of a study") from None
    try:
        table = from_parquet((folder / TABLE).read_bytes())
    except FileNotFoundError:
        table = table_of(paths, read_rows(folder / ROWS))
    return Results(folder, paths, None if shape is None else tuple(shape), table)
