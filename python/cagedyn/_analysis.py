"""Without simulating: steady whirl, temperatures, and what records say of a motion."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._model import Model
from ._native import Array, Error, check, counted, ffi, filled, last_error, lib, made, numbers, text

_MOTIONS = ("resting", "stable", "forward whirl", "backward whirl", "irregular")


def _names(count: int, name: Any) -> list[str]:
    return [text(name(i)) for i in range(count)]


#: Told the share of the way that is done, from 0 to 1, and how many whirls or bursts of motion there are.
Progress = Callable[[float, int], None]

#: Wall time in s between looks whether Ctrl-C was pressed.
_PATIENCE = 0.1


def _search(call: Any, good: Any, wall_time: float, progress: Progress | None) -> tuple[Any, BaseException | None]:
    """What `call(watch)` gives in a thread of its own, with what has ended it early.

    Ctrl-C, or a failure of `progress`, ends it; `good(result)` tells whether the library has a result, which may be one of a search that was ended.
    """
    watch = made(lib.cagedyn_watch_new(), lib.cagedyn_watch_free)
    check(lib.cagedyn_watch_set_wall_time_limit(watch, wall_time))
    results: list[tuple[Any, Error | None]] = []
    done = threading.Event()

    def run() -> None:
        try:
            result = call(watch)
            # The error belongs to the thread.
            results.append((result, None if good(result) else last_error()))
        finally:
            done.set()

    # A daemon: whoever presses Ctrl-C twice does not wait.
    worker = threading.Thread(target=run, daemon=True)
    worker.start()
    stopped: BaseException | None = None
    try:
        while not done.wait(_PATIENCE):
            if progress is not None:
                x = filled(2, lambda p, n: lib.cagedyn_watch_progress(watch, p, n))
                progress(float(x[0]), int(x[1]))
    except BaseException as interrupt:
        stopped = interrupt
        check(lib.cagedyn_watch_cancel(watch))
        done.wait()
    worker.join()
    result, error = results[0]
    return result, stopped or error


class WhirlBranch:
    """Steady whirls of a model's scene without its gravity, found without time stepping: one, or a branch over a number of the scene.

    path: of that number, as in overrides, for example "inner_ring.speed.constant"; it goes from `start` to `stop`, around folds.

    Raises Error where there is no whirl at the start. Where the branch ends later, `end` and `why` tell. An elastic cage can take
    minutes; it ends after `wall_time` in s with the points so far, if there is one. `progress` is called ten times a second. Ctrl-C ends
    it, as KeyboardInterrupt, whose attribute `branch` has the points so far, or None.
    """

    #: One record per point: parameter, whirl_speed (rad/s), eccentricity (m), lead (rad), leading_rate (1/s), leading_frequency
    #: (rad/s), arcs; stable, fold, hopf and grazed are 1 or 0.
    points: NDArray[np.void]
    #: Amplitudes of the waves of an elastic cage from order 2 on, m; shape (points, waves).
    amplitudes: Array
    #: Rate in 1/s plus i times frequency in rad/s, the largest rate first; shape (points, eigenvalues).
    eigenvalues: NDArray[np.complex128]
    #: "range", "length", "lost", "cancelled" or "out of time".
    end: str
    #: Why it ends before its range does; empty where it does not.
    why: str

    def __init__(
        self,
        model: Model,
        path: str | None = None,
        start: float = 0.0,
        stop: float = 0.0,
        *,
        wall_time: float = math.inf,
        progress: Progress | None = None,
    ) -> None:
        name, start, stop = None if path is None else path.encode(), float(start), float(stop)

        def call(watch: Any) -> Any:
            if name is None:
                return lib.cagedyn_whirl_steady_with_watch(model._handle, watch)
            return lib.cagedyn_whirl_follow_with_watch(model._handle, name, start, stop, watch)

        handle, stopped = _search(call, lambda handle: handle != ffi.NULL, wall_time, progress)
        if handle != ffi.NULL:
            self._read(ffi.gc(handle, lib.cagedyn_whirl_free))
        if stopped is not None:
            if not isinstance(stopped, Error):
                stopped.branch = None if handle == ffi.NULL else self  # type: ignore[attr-defined]
            raise stopped

    def _read(self, handle: Any) -> None:
        count = counted(lib.cagedyn_whirl_point_count(handle))
        columns = _names(lib.cagedyn_whirl_quantity_count(), lib.cagedyn_whirl_quantity_name)
        rows = [filled(len(columns), lambda p, n, i=i: lib.cagedyn_whirl_point(handle, i, p, n)) for i in range(count)]
        self.points = np.array([tuple(row) for row in rows], dtype=[(name, np.float64) for name in columns])
        waves = counted(lib.cagedyn_whirl_wave_count(handle))
        self.amplitudes = np.array(
            [filled(waves, lambda p, n, i=i: lib.cagedyn_whirl_amplitudes(handle, i, p, n)) for i in range(count)]
        ).reshape(count, waves)
        self.eigenvalues = np.array([_eigenvalues(handle, i) for i in range(count)])
        self.end = text(lib.cagedyn_whirl_end(handle))
        self.why = text(lib.cagedyn_whirl_why(handle))


class Equilibrium:
    """The equilibrium of a bearing at the start of its model's scene, found without time stepping.

    control: what balls follow at speed: the hypothesis that the "outer" or the "inner" race controls them, axes parallel to that of the
    bearing with "none", or their own "friction" in steady motion.

    Raises Error where there is none, or none was found.
    """

    def __init__(self, model: Model, control: str = "outer") -> None:
        handle = made(lib.cagedyn_equilibrium_find(model._handle, control.encode()), lib.cagedyn_equilibrium_free)

        def names(part: str, field: str = "name") -> tuple[str, ...]:
            count = counted(getattr(lib, f"cagedyn_equilibrium_{part}_count")(handle))
            return tuple(_names(count, lambda i: getattr(lib, f"cagedyn_equilibrium_{part}_{field}")(handle, i)))

        def table(part: str, count: int, read: Any) -> NDArray[np.void]:
            columns = names(f"{part}_quantity")
            rows = [filled(len(columns), lambda p, n, i=i: read(handle, i, p, n)) for i in range(count)]
            return np.array([tuple(row) for row in rows], dtype=[(name, np.float64) for name in columns])

        #: Coordinates of the inner ring: x, y, z, tilt_y and tilt_z of a ring in space, y and z of one in the plane.
        self.coordinates: tuple[str, ...] = names("coordinate")
        n = len(self.coordinates)
        #: Over these, m and rad.
        self.displacement: Array = filled(n, lambda p, n: lib.cagedyn_equilibrium_displacement(handle, p, n))
        #: Over these, N and N m: what the bearing carries.
        self.load: Array = filled(n, lambda p, n: lib.cagedyn_equilibrium_load(handle, p, n))
        #: Derivatives of the load over the displacement, N/m and its kin; shape (coordinates, coordinates).
        self.stiffness: Array = filled(n * n, lambda p, n: lib.cagedyn_equilibrium_stiffness(handle, p, n)).reshape(n, n)
        #: One record per element.
        self.elements: NDArray[np.void] = table(
            "element", counted(lib.cagedyn_equilibrium_element_count(handle)), lib.cagedyn_equilibrium_element
        )
        #: Names of the contacts, those of an element together.
        self.contact_names: tuple[str, ...] = names("contact")
        #: One record per contact: normal_force (N), approach (m), largest_pressure (Pa) and more, by kind of bearing.
        self.contacts: NDArray[np.void] = table("contact", len(self.contact_names), lib.cagedyn_equilibrium_contact)
        places = counted(lib.cagedyn_equilibrium_line_load_count(handle))
        #: Places along every roller that may tilt, from its middle, m; of others none.
        self.line_load_places: Array = filled(
            places, lambda p, n: lib.cagedyn_equilibrium_line_load_places(handle, p, n)
        )
        loads = [
            filled(places, lambda p, n, i=i: lib.cagedyn_equilibrium_line_loads(handle, i, p, n))
            for i in range(len(self.contact_names))
        ]
        #: Loads per length of all contacts there, N/m; shape (contacts, places).
        self.line_loads: Array = np.array(loads).reshape(len(loads), places)
        values = filled(
            counted(lib.cagedyn_equilibrium_life_quantity_count(handle)), lambda p, n: lib.cagedyn_equilibrium_life(handle, p, n)
        )
        #: Reference life of rollers after ISO/TS 16281 and what it follows from, by name: life_turns, life_time (s), reference_load (N) and more; empty
        #: of balls and without load.
        self.life: dict[str, float] = dict(zip(names("life_quantity"), values.tolist()))
        #: SI units of these.
        self.life_units: dict[str, str] = dict(zip(names("life_quantity"), names("life_quantity", "unit")))
        #: SI units of what is known of elements.
        self.element_units: dict[str, str] = dict(zip(names("element_quantity"), names("element_quantity", "unit")))
        #: SI units of what is known of contacts.
        self.contact_units: dict[str, str] = dict(zip(names("contact_quantity"), names("contact_quantity", "unit")))
        count = counted(lib.cagedyn_equilibrium_warning_count(handle))
        #: What is amiss without preventing the equilibrium, one line each.
        self.warnings: tuple[str, ...] = tuple(_names(count, lambda i: lib.cagedyn_equilibrium_warning(handle, i)))


def _eigenvalues(handle: Any, point: int) -> NDArray[np.complex128]:
    count = counted(lib.cagedyn_whirl_eigenvalue_count(handle))
    rates, frequencies = np.zeros(count), np.zeros(count)
    pointers = [ffi.cast("double *", array.ctypes.data) for array in (rates, frequencies)]
    check(lib.cagedyn_whirl_eigenvalues(handle, point, *pointers, count))
    return rates + 1j * frequencies


class HeatBalance:
    """Temperatures of a bearing whose scene has `heat`. May be used by one thread at a time.

    Raises Error for a scene without.
    """

    def __init__(self, model: Model) -> None:
        handle = made(lib.cagedyn_heat_new(model._handle), lib.cagedyn_heat_free)
        self._handle = handle
        #: Names of the lumps, as in the scene.
        self.lumps = _names(
            counted(lib.cagedyn_heat_lump_count(handle)), lambda i: lib.cagedyn_heat_lump_name(handle, i)
        )
        #: Names of the powers of the motion that warm lumps.
        self.sources = _names(
            counted(lib.cagedyn_heat_source_count(handle)), lambda i: lib.cagedyn_heat_source_name(handle, i)
        )
        ends = ffi.new("int64_t[2]")
        #: Lumps that each link joins; None stands for the surroundings.
        self.links: list[tuple[str | None, str | None]] = []
        for i in range(counted(lib.cagedyn_heat_link_count(handle))):
            check(lib.cagedyn_heat_link(handle, i, ends, 2))
            first, second = (None if lump < 0 else self.lumps[lump] for lump in ends)
            self.links.append((first, second))

    def settle(self, *, wall_time: float = math.inf, progress: Progress | None = None) -> None:
        """Finds the temperatures at which the bearing stays, from bursts of motion. On failure nothing changes.

        Raises Error after `wall_time` in s, and KeyboardInterrupt within a step of the motion after Ctrl-C: temperatures are then those of
        the last whole burst, and another call goes on from there. `progress` is called ten times a second.
        """
        self._move(lambda watch: lib.cagedyn_heat_settle_with_watch(self._handle, watch), wall_time, progress)

    def step(
        self, duration: float, *, wall_time: float = math.inf, progress: Progress | None = None
    ) -> None:
        """Warms up for `duration` in s with the heat of one burst of motion: the longer, the more roughly. Ends early as `settle`."""
        duration = float(duration)
        self._move(
            lambda watch: lib.cagedyn_heat_step_with_watch(self._handle, duration, watch), wall_time, progress
        )

    def _move(self, call: Any, wall_time: float, progress: Progress | None) -> None:
        _, stopped = _search(call, lambda status: status == 0, wall_time, progress)
        if stopped is not None:
            raise stopped

    def _by(self, names: list[str], call: Any) -> dict[str, float]:
        values = filled(len(names), lambda p, n: call(self._handle, p, n))
        return dict(zip(names, values.tolist()))

    @property
    def temperatures(self) -> dict[str, float]:
        """Temperature of each lump, K. Some or all of them can be set."""
        return self._by(self.lumps, lib.cagedyn_heat_temperatures)

    @temperatures.setter
    def temperatures(self, values: dict[str, float]) -> None:
        unknown = [name for name in values if name not in self.lumps]
        if unknown:
            raise KeyError(f"there is no lump {unknown[0]!r} among {', '.join(self.lumps)}")
        pointer, length, _keep = numbers(list((self.temperatures | values).values()))
        check(lib.cagedyn_heat_set_temperatures(self._handle, pointer, length))

    @property
    def into_lumps(self) -> dict[str, float]:
        """Heat that went into each lump in the last burst of motion, W. Raises Error before the first."""
        return self._by(self.lumps, lib.cagedyn_heat_into_lumps)

    @property
    def flows(self) -> Array:
        """Heat through each of the `links` after the last burst, from its first lump to its second, W; shape (links,)."""
        return filled(len(self.links), lambda p, n: lib.cagedyn_heat_flows(self._handle, p, n))

    @property
    def source_heat(self) -> dict[str, float]:
        """Heat of each of the `sources` in the last burst, W."""
        return self._by(self.sources, lib.cagedyn_heat_sources)

    @property
    def quantities(self) -> dict[str, float]:
        """What else the last burst came to: viscosity (Pa s), radial_clearance (m), whirl_speed (rad/s), heat in W, standard_error (K)."""
        names = _names(lib.cagedyn_heat_quantity_count(), lib.cagedyn_heat_quantity_name)
        return self._by(names, lib.cagedyn_heat_quantities)


@dataclass(frozen=True)
class Motion:
    """Class and statistics of the motion of a cage. What is not known is NaN."""

    #: "resting", "stable", "forward whirl" (in the sense of the cage's rotation), "backward whirl" or "irregular".
    motion: str
    #: Mean and percentiles, rad/s; not of a centre next to that of the guide.
    mean_whirl_speed: float
    p05_whirl_speed: float
    p95_whirl_speed: float
    #: Mean distance from the centre of the guide, m.
    mean_radius: float
    #: Net turns about it, counter-clockwise positive.
    turns: float
    #: From which on the whirl speed stays within 15 % of its mean, s.
    settling_time: float
    #: Standard deviation of the speed of the centre over its mean, from one record to the next.
    velocity_deviation: float
    #: Share of the time in each class, stretch by stretch.
    resting_share: float
    stable_share: float
    forward_share: float
    backward_share: float
    irregular_share: float
    #: Whether a whirl comes and goes.
    intermittent: bool


def cage_motion(
    times: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    whirl_speed: ArrayLike,
    cage_speed: ArrayLike,
    *,
    clearance: float,
    begin: float = 0.0,
) -> Motion:
    """Class and statistics of the motion of a cage from time `begin` in s on.

    Arrays of one shape (records,): times in s, centre of the cage relative to that of its guide in m, its angular speed about that
    centre and the rotation speed of the cage in rad/s. `clearance` is the radial guide clearance in m; 0 for a cage without a guide.
    The wobble of a cage in space is that of its tilts times the pitch radius in the place of `y` and `z`.
    """
    rows = [numbers(row) for row in (times, y, z, whirl_speed, cage_speed)]
    count = _one_length([length for _, length, _ in rows])
    pointers = [pointer for pointer, _, _ in rows]
    x = filled(
        lib.cagedyn_motion_count(),
        lambda p, n: lib.cagedyn_cage_motion(*pointers, count, clearance, begin, p, n),
    )
    kind, *numbers_of, comes_and_goes = x.tolist()
    names = _names(lib.cagedyn_motion_count(), lib.cagedyn_motion_name)[1:-1]
    values: dict[str, float] = dict(zip(names, numbers_of))
    return Motion(motion=_MOTIONS[int(kind)], intermittent=bool(comes_and_goes), **values)


def over_orbit(angles: ArrayLike, values: ArrayLike, sectors: int) -> dict[str, Array]:
    """What samples of elements are in each of so many equal sectors of their orbit: mean, p95, peak and positive_share by name.

    `angles` in rad, of any number of turns, counter-clockwise from y, and `values` have one shape (samples,); results have shape
    (sectors,), NaN where there is no sample.
    """
    (at, count, _angles), (of, other, _values) = numbers(angles), numbers(values)
    count = _one_length([count, other])
    names = _names(lib.cagedyn_over_orbit_count(), lib.cagedyn_over_orbit_name)
    # A wrong number of sectors is refused by the library before it looks at the array.
    width = sectors if 0 < sectors <= 1 << 20 else 0
    out = filled(len(names) * width, lambda p, n: lib.cagedyn_over_orbit(at, of, count, sectors, p, n))
    return dict(zip(names, out.reshape(len(names), width)))


def _one_length(lengths: list[int]) -> int:
    if len(set(lengths)) != 1:
        raise ValueError(f"arrays of one length are needed, not of {', '.join(map(str, lengths))}")
    return lengths[0]
