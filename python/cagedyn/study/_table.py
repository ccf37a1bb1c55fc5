"""The table of a study."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]

from ._points import Value, is_number
from ._row import ENDING, ending
from ._store import Kept

#: Types of the columns behind the results.
_KINDS = dict(
    zip(ENDING, (pa.float64(), pa.bool_(), pa.bool_(), pa.string(), pa.string(), pa.string()), strict=True)
)


def table_of(paths: Sequence[str], rows: Mapping[int, Kept]) -> Any:
    """Points that are done, in their order, as a `pyarrow.Table`: number, varied values, results, how the run
    ended."""
    numbers = sorted(rows)
    values = [rows[number][0] for number in numbers]
    found = [rows[number][1] for number in numbers]
    columns = {"point": pa.array(numbers, pa.int64())}
    columns.update({path: varied([row[place] for row in values]) for place, path in enumerate(paths)})
    for name in dict.fromkeys(name for row in found for name in row.results):
        cells = [row.results.get(name) for row in found]
        texts = any(isinstance(cell, str) for cell in cells)
        columns[name] = pa.array(cells, pa.string() if texts else pa.float64())
    endings = [ending(row) for row in found]
    for place, (name, kind) in enumerate(_KINDS.items()):
        columns[name] = pa.array([cells[place] for cells in endings], kind)
    return pa.table(columns)


def varied(values: Sequence[Value]) -> Any:
    """Varied values as a `pyarrow.Array`: of numbers if all of them are, else of texts."""
    if all(map(is_number, values)):
        whole = all(isinstance(value, int) and abs(value) < 2**63 for value in values)
        return pa.array(values, pa.int64()) if whole else pa.array(list(map(float, values)), pa.float64())
    return pa.array([value if isinstance(value, str) else json.dumps(value) for value in values], pa.string())


def parquet(table: Any) -> bytes:
    """The table as a file."""
    buffer = pa.BufferOutputStream()
    pq.write_table(table, buffer)
    content: bytes = buffer.getvalue().to_pybytes()
    return content


def from_parquet(content: bytes) -> Any:
    """The table of a file."""
    return pq.read_table(pa.BufferReader(content))
