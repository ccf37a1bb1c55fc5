"""The folder of a study: what it is of, and its points that are done, each of which is kept from the moment that
it arrives."""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ._build import short
from ._error import StudyError
from ._points import Value
from ._row import Row

#: What the study is of.
STUDY = "study.json"
#: One line of JSON for every point that is done, in the order of arrival.
ROWS = "rows.jsonl"
#: The same as a table in the order of points, once all of them are done.
TABLE = "study.parquet"
#: Held by the program that adds to the folder.
_LOCK = "lock"

#: Values of a point, and what is known of it.
Kept = tuple[Sequence[Value], Row]


class Store:
    """The folder of a study that this program has for itself; a context."""

    def __init__(self, folder: str | os.PathLike[str], identity: Mapping[str, Any]) -> None:
        """Makes the folder, or takes up a study that was stopped before its end. `identity` has all that results
        depend on.

        Raises StudyError for a folder that another program writes to, and for one of another study or of something
        else; OSError for one that cannot be written.
        """
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        begun = (self.folder / STUDY).exists()
        for name in (ROWS, TABLE):
            if not begun and (self.folder / name).exists():
                raise StudyError(f"{self.folder / name}: is not of a study; choose another folder or remove it")
        self._lock = (self.folder / _LOCK).open("a")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._lock.close()
            raise StudyError(f"{self.folder}: another study is writing to this folder") from None
        try:
            if begun:
                self._compare(identity)
            else:
                write(self.folder / STUDY, json.dumps(identity, indent=1).encode())
            # Of points that are done; what it says may soon not be all.
            (self.folder / TABLE).unlink(missing_ok=True)
            #: Points that are done.
            self.rows = self._recover()
            self._log = (self.folder / ROWS).open("ab")
        except BaseException:
            self._lock.close()
            raise

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self._log.close()
        self._lock.close()

    def keep(self, rows: Mapping[int, Kept]) -> None:
        """Keeps points: they are on the disk when this returns."""
        self._log.write(b"".join(_line(point, *kept) for point, kept in rows.items()))
        self._log.flush()
        os.fsync(self._log.fileno())
        self.rows.update(rows)

    def _compare(self, identity: Mapping[str, Any]) -> None:
        """Refuses the folder of another study, and tells in what it differs."""
        try:
            was = json.loads((self.folder / STUDY).read_bytes())
        except ValueError:
            was = None
        now = json.loads(json.dumps(identity))
        if was != now:
            raise StudyError(
                f"{self.folder}: has another study ({difference(was, now)}); choose another folder or remove it"
            )

    def _recover(self) -> dict[int, Kept]:
        """Rows of a study that was stopped, without the one that was being written."""
        path = self.folder / ROWS
        path.touch()
        _sync(self.folder)
        with path.open("r+b") as file:
            whole = file.read().rfind(b"\n") + 1
            file.truncate(whole)
        return read_rows(path)


def read_rows(path: Path) -> dict[int, Kept]:
    """Points that are done by their numbers. A last line that is not complete is left out.

    Raises StudyError for a file that is damaged.
    """
    rows: dict[int, Kept] = {}
    *lines, _ = path.read_bytes().split(b"\n")
    for number, text in enumerate(lines, 1):
        try:
            fields = json.loads(text)
            error = fields.pop("error")
            point, values = fields.pop("point"), fields.pop("values")
            row = Row(**fields, error=tuple(error) if error else None)
            if point in rows:
                raise ValueError
        except (ValueError, KeyError, TypeError):
            raise StudyError(f"{path}: line {number} is damaged; remove it, and its point is run again") from None
        rows[point] = (values, row)
    return rows


def difference(was: Any, now: Mapping[str, Any]) -> str:
    """In what two studies differ, in words."""
    if not isinstance(was, dict) or was.get("schema") != now["schema"]:
        return f"{STUDY} is none of this version"
    name = next(name for name in [*now, *was] if was.get(name) != now.get(name))
    before, after = was.get(name), now.get(name)
    if name in ("scene", "function"):
        return f"the {name} differs"
    if name == "build":
        return f"build was {short(str(before))}, is {short(str(after))}"
    if name == "points" and isinstance(before, list) and isinstance(after, list):
        if len(before) != len(after):
            return f"points: {len(before)} before, {len(after)} now"
        place = next(i for i, pair in enumerate(zip(before, after)) if pair[0] != pair[1])
        return f"point {place} was {before[place]}, is {after[place]}"
    if name == "points":
        return "its points came from a list before and from an optimiser now, or the other way round"
    return f"{name} was {json.dumps(before)}, is {json.dumps(after)}"


def write(path: Path, content: bytes) -> None:
    """Writes a file that is there as a whole or not at all, and on the disk when this returns."""
    beside = path.with_name(path.name + ".part")
    with beside.open("wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    beside.replace(path)
    _sync(path.parent)


def _sync(folder: Path) -> None:
    """Brings the names of the files of a folder to the disk."""
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def _line(point: int, values: Iterable[Value], row: Row) -> bytes:
    return json.dumps({"point": point, "values": list(values), **vars(row)}).encode() + b"\n"
