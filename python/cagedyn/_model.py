"""Models: compiled scenes, their names and lengths."""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from ._native import check, counted, ffi, lib, made, text


class Names(Sequence[str]):
    """Names of the things of one kind in a model, in the order of their numbers."""

    def __init__(self, model: Any, kind: str) -> None:
        def all_of(what: str) -> list[str]:
            call = getattr(lib, f"cagedyn_model_{kind}_{what}", None)
            return [text(call(model, i)) for i in range(count)] if call is not None else []

        count = counted(getattr(lib, f"cagedyn_model_{kind}_count")(model))
        self._names = all_of("name")
        self._places = {name: i for i, name in enumerate(self._names)}
        #: SI units ("1" for ratios); empty where they have none.
        self.units: list[str] = all_of("unit")
        #: Meanings; empty where they have none.
        self.descriptions: list[str] = all_of("description")

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: Any) -> Any:
        return self._names[index]

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._places

    def index(self, value: Any, start: int = 0, stop: int | None = None) -> int:
        """Number of the thing of this name.

        Raises KeyError if there is none.
        """
        try:
            return self._places[value]
        except KeyError:
            near = difflib.get_close_matches(str(value), self._names, 1)
            hint = f"; the nearest is {near[0]!r}" if near else ""
            raise KeyError(f"there is no {value!r} among the {len(self._names)} names{hint}") from None

    def __repr__(self) -> str:
        return f"Names({self._names!r})"


@dataclass(frozen=True)
class SparsePattern:
    """Where a Jacobian can be other than zero: compressed sparse columns, counted from 0, as in scipy.sparse.csc_array."""

    #: Place among the rows where each column begins, and last their number; shape (states + 1,).
    indptr: NDArray[np.int64]
    #: Row of every entry, ascending in each column.
    indices: NDArray[np.int64]


def _plain(value: Any) -> Any:
    """NumPy's numbers and arrays as JSON has them."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"{value!r} is nothing that JSON has")


class Model:
    """A compiled scene. It can be shared by simulations and threads, and pickled: as the text of its scene."""

    def __init__(self, handle: Any) -> None:
        self._handle = handle
        #: The state vector: positions, then velocities.
        self.states = Names(handle, "state")
        #: What a host can set: speed, loads, temperature.
        self.inputs = Names(handle, "input")
        #: What can be asked for and recorded.
        self.outputs = Names(handle, "output")
        #: Rows of contact forces.
        self.contacts = Names(handle, "contact")
        #: Columns of contact forces.
        self.contact_quantities = Names(handle, "contact_quantity")
        #: Columns of the load along a roller.
        self.line_load_quantities = Names(handle, "line_load_quantity")
        #: Blocks of body forces.
        self.bodies = Names(handle, "body")
        #: Their rows.
        self.force_sources = Names(handle, "force_source")
        #: Their columns.
        self.force_components = Names(handle, "force_component")
        #: Number of positions in the state vector.
        self.position_count = counted(lib.cagedyn_model_position_count(handle))
        #: Number of velocities in the state vector.
        self.velocity_count = counted(lib.cagedyn_model_velocity_count(handle))

    @classmethod
    def from_json(cls, scene: str | Mapping[str, Any], overrides: Mapping[str, Any] | None = None) -> Model:
        """A model of a scene, given as JSON text or as what that holds, with some values replaced.

        `overrides` maps paths such as "inner_ring.radial_clearance" to values, also NumPy's numbers and arrays; None removes an
        optional block.

        Raises Error for a scene that is not well-formed or cannot be.
        """
        source = scene if isinstance(scene, str) else json.dumps(scene, default=_plain)
        lines = "\n".join(f"{path}={json.dumps(value, default=_plain)}" for path, value in (overrides or {}).items())
        made_of = lib.cagedyn_model_from_json_with(source.encode(), lines.encode())
        return cls(made(made_of, lib.cagedyn_model_free))

    @classmethod
    def from_file(cls, path: str | PathLike[str], overrides: Mapping[str, Any] | None = None) -> Model:
        """A model of a scene file, with some values replaced as in `from_json`.

        Raises OSError for a file that cannot be read, Error as `from_json`.
        """
        return cls.from_json(Path(path).read_text(encoding="utf-8"), overrides)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_json, (text(lib.cagedyn_model_scene_json(self._handle)),)

    def __copy__(self) -> Model:
        return self  # It never changes.

    def __deepcopy__(self, memo: dict[int, Any]) -> Model:
        return self

    def __repr__(self) -> str:
        lists = ("states", "inputs", "outputs", "contacts")
        counts = ", ".join(f"{len(getattr(self, name))} {name}" for name in lists)
        return f"Model({self.scene.get('title', '')!r}: {counts})"

    @property
    def scene(self) -> dict[str, Any]:
        """The scene with its replacements."""
        scene: dict[str, Any] = json.loads(text(lib.cagedyn_model_scene_json(self._handle)))
        return scene

    @property
    def warnings(self) -> list[str]:
        """Values of the scene that are legal and unlikely, one line each."""
        count = counted(lib.cagedyn_model_warning_count(self._handle))
        return [text(lib.cagedyn_model_warning(self._handle, i)) for i in range(count)]

    @property
    def geometry(self) -> dict[str, float]:
        """Lengths and counts of the bearing that follow from its scene, by name, in m or 1."""
        value = ffi.new("double *")
        lengths = {}
        for i, name in enumerate(Names(self._handle, "geometry")):
            check(lib.cagedyn_model_get_geometry(self._handle, i, value))
            lengths[name] = float(value[0])
        return lengths

    @property
    def watched(self) -> list[str]:
        """Outputs that are watched in every step: those that the scene names in record.extremes."""
        count = counted(lib.cagedyn_model_watched_count(self._handle))
        return [self.outputs[lib.cagedyn_model_watched_output(self._handle, i)] for i in range(count)]

    def jacobian_pattern(self) -> SparsePattern:
        """Places of what `Sim.sparse_jacobian` gives, the same at all states."""
        entries = lib.cagedyn_model_jacobian_entry_count(self._handle)
        return self._pattern(len(self.states), entries, lib.cagedyn_model_jacobian_pattern)

    def feedthrough_pattern(self) -> SparsePattern:
        """Which outputs (rows) may change at once with which inputs (columns), whatever the state."""
        entries = lib.cagedyn_model_feedthrough_entry_count(self._handle)
        return self._pattern(len(self.inputs), entries, lib.cagedyn_model_feedthrough_pattern)

    def _pattern(self, columns: int, entries: int, write: Any) -> SparsePattern:
        indptr, indices = (np.zeros(n, dtype=np.int64) for n in (columns + 1, counted(entries)))
        pointers = [ffi.cast("int64_t *", array.ctypes.data) for array in (indptr, indices)]
        check(write(self._handle, pointers[0], indptr.size, pointers[1], indices.size))
        return SparsePattern(indptr, indices)
