"""Simulations."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Iterator, MutableMapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._model import Model, SparsePattern
from ._native import Array, Error, check, counted, ffi, filled, last_error, lib, made, numbers, text

_PRESETS = ("draft", "engineering", "reference")

#: Wall time in s after which a running call looks whether Ctrl-C was pressed, and tells how far it is.
_PATIENCE = 0.1


def _named(count: Any, name: Any) -> list[str]:
    return [text(name(i)) for i in range(count())]


@dataclass(frozen=True)
class Interval:
    """What a watched output did between two times in s, in its unit."""

    begin: float
    end: float
    min: float
    max: float
    #: Over time; the integrals in that unit times s, the second of values above zero.
    mean: float
    integral: float
    positive_integral: float


class Inputs(MutableMapping[str, float]):
    """Values of the inputs by name. One that is set holds from then on; one that is deleted follows the scene again."""

    def __init__(self, sim: Sim) -> None:
        self._sim = sim

    def __getitem__(self, name: str) -> float:
        value = ffi.new("double *")
        check(lib.cagedyn_sim_get_input(self._sim._handle, self._sim.model.inputs.index(name), value))
        return float(value[0])

    def __setitem__(self, name: str, value: float) -> None:
        check(lib.cagedyn_sim_set_input(self._sim._handle, self._sim.model.inputs.index(name), value))

    def ramp(self, name: str, value: float, slope: float) -> None:
        """Lets an input go on from `value` with `slope` per second. A ring is moved by its rate: the slope of `inner_ring.vy` is its
        acceleration."""
        input = self._sim.model.inputs.index(name)
        check(lib.cagedyn_sim_set_input_slope(self._sim._handle, input, value, slope))

    def __delitem__(self, name: str) -> None:
        check(lib.cagedyn_sim_release_input(self._sim._handle, self._sim.model.inputs.index(name)))

    def __iter__(self) -> Iterator[str]:
        return iter(self._sim.model.inputs)

    def __len__(self) -> int:
        return len(self._sim.model.inputs)

    def __repr__(self) -> str:
        return f"Inputs({dict(self)!r})"


class _Teller:
    """Calls `progress`, if there is one, where its time has come."""

    def __init__(self, sim: Sim, progress: Callable[[Sim], object] | None) -> None:
        self._sim, self._progress = sim, progress
        self._due = clock.monotonic() + _PATIENCE

    def __call__(self) -> None:
        if clock.monotonic() >= self._due:
            self.arrived()
            self._due = clock.monotonic() + _PATIENCE

    def arrived(self) -> None:
        if self._progress is not None:
            self._progress(self._sim)


def _continued(kind: type[Sim], model: Model, preset: str | None, saved: Array) -> Sim:
    """The simulation that was saved."""
    sim = kind(model, preset)
    sim.restore(saved)
    return sim


class Sim:
    """A simulation of one model. May be used by one thread at a time.

    A copy, also one that was pickled for another process with the same build of the library, goes on with the same bits, without
    limit of wall time and with an interval that begins there.

    preset: "draft", "engineering" or "reference" instead of what the scene says: how accurate it is to be where the scene's
    method leaves that open.
    """

    def __init__(self, model: Model, preset: str | None = None) -> None:
        if preset is None:
            handle = lib.cagedyn_sim_new(model._handle)
        else:
            if preset not in _PRESETS:
                raise ValueError(f"preset: {preset!r} is none of {', '.join(_PRESETS)}")
            handle = lib.cagedyn_sim_new_with_preset(model._handle, _PRESETS.index(preset))
        #: What it simulates.
        self.model = model
        self._preset = preset
        #: Inputs by name.
        self.inputs = Inputs(self)
        self._handle = made(handle, lib.cagedyn_sim_free)
        self._deadline = math.inf

    def __reduce__(self) -> tuple[Any, ...]:
        return _continued, (type(self), self.model, self._preset, self.save())

    def __repr__(self) -> str:
        try:
            return f"Sim({self.model!r} at {self.time:.9g} s)"
        except Error as busy:
            return f"Sim({self.model!r}: {busy.name})"

    @property
    def time(self) -> float:
        """Simulated time, s."""
        value = ffi.new("double *")
        check(lib.cagedyn_sim_time(self._handle, value))
        return float(value[0])

    @property
    def state(self) -> Array:
        """The state in the order of `Model.states`: a copy, shape (states,)."""
        return filled(len(self.model.states), lambda p, n: lib.cagedyn_sim_get_state(self._handle, p, n))

    def set_state(self, time: float, state: ArrayLike) -> None:
        """Sets time in s and state, shape (states,). On failure nothing changes.

        The present ones change nothing, and a state next to the present one at the present time goes on at little cost. Any other
        begins anew with some thirty steps of controlled errors; where time has passed, the run is not judged from then on.
        """
        pointer, length, _keep = numbers(state)
        check(lib.cagedyn_sim_set_state(self._handle, time, pointer, length))

    def reset(self) -> None:
        """Back to the start of the scene; inputs follow it again, statistics start at zero."""
        check(lib.cagedyn_sim_reset(self._handle))

    def advance_to(self, t: float, progress: Callable[[Sim], object] | None = None) -> None:
        """Advances to time `t` in s.

        `progress` is called with this simulation ten times a second while it runs and once it is there, to ask it for time or
        outputs; what it raises stops the run after a step. Ctrl-C stops it after a step, as KeyboardInterrupt; it can then go on. Raises Error when it cannot go on; it is then at
        the last step that could be made.
        """
        tell = _Teller(self, progress)
        self._advance(t, tell)
        tell.arrived()

    def _advance(self, t: float, tell: _Teller) -> None:
        while True:
            left = self._deadline - clock.monotonic()
            check(lib.cagedyn_sim_set_wall_time_limit(self._handle, max(0.0, min(_PATIENCE, left))))
            status = lib.cagedyn_sim_advance_to(self._handle, t)
            # Here Python sees to signals. What stopped for that goes on with the same bits.
            if status == lib.CAGEDYN_ERR_OUT_OF_TIME and left > _PATIENCE:
                tell()
                continue
            check(status)
            return

    def step(self, dt: float) -> None:
        """Advances by `dt` >= 0 s, as `advance_to`."""
        if not dt >= 0.0:
            check(lib.cagedyn_sim_step(self._handle, dt))
        self.advance_to(self.time + dt)

    def set_wall_time_limit(self, seconds: float) -> None:
        """Lets it run for so many s of wall time from now; then advances raise Error until the limit is set again."""
        check(lib.cagedyn_sim_set_wall_time_limit(self._handle, seconds))
        self._deadline = clock.monotonic() + seconds

    def _renew_wall_time_limit(self) -> None:
        left = self._deadline - clock.monotonic()
        check(lib.cagedyn_sim_set_wall_time_limit(self._handle, max(0.0, left)))

    def outputs(self) -> dict[str, float]:
        """All outputs at the present state by name."""
        return dict(zip(self.model.outputs, self._outputs().tolist()))

    def _outputs(self) -> Array:
        return filled(len(self.model.outputs), lambda p, n: lib.cagedyn_sim_get_outputs(self._handle, p, n))

    def output(self, name: str) -> float:
        """One output at the present state."""
        value = ffi.new("double *")
        check(lib.cagedyn_sim_get_output(self._handle, self.model.outputs.index(name), value))
        return float(value[0])

    def record(
        self,
        until: float,
        interval: float,
        outputs: Sequence[str] | None = None,
        progress: Callable[[Sim], object] | None = None,
    ) -> NDArray[np.void]:
        """Runs to `until` in s and records outputs, now, every `interval` s after, and at the end.

        Returns a structured array with the field "time" and one per output, all of them unless some are named. `progress` is
        called as by `advance_to`. After a failure, an exception in `progress` or Ctrl-C the exception has what was recorded as
        its attribute `records`.
        """
        chosen = list(self.model.outputs if outputs is None else outputs)
        places = [self.model.outputs.index(name) for name in chosen]
        dtype = np.dtype([("time", float)] + [(name, float) for name in chosen])
        if not (interval > 0.0 and math.isfinite(until)):
            raise ValueError(f"until {until}, interval {interval}: must be a time and above zero")
        start, tell = self.time, _Teller(self, progress)
        last = max(0, math.ceil((until - start) / interval - 1e-9))
        rows, row, done = np.empty((last + 1, len(chosen) + 1)), np.empty(len(self.model.outputs)), 0
        pointer, length, _keep = numbers(row)
        time = ffi.new("double *")
        try:
            for i in range(last + 1):
                self._advance(min(start + i * interval, until), tell)
                check(lib.cagedyn_sim_get_outputs(self._handle, pointer, length))
                check(lib.cagedyn_sim_time(self._handle, time))
                rows[i, 0], rows[i, 1:], done = time[0], row[places], i + 1
                tell()
            tell.arrived()
        except BaseException as failure:
            failure.records = rows[:done].view(dtype)[:, 0]  # type: ignore[attr-defined]
            raise
        return rows.view(dtype)[:, 0]

    def begin_interval(self) -> None:
        """Begins the interval of `interval` now."""
        check(lib.cagedyn_sim_begin_interval(self._handle))

    def interval(self, output: str) -> Interval:
        """What a watched output did since `begin_interval`, from every step."""
        place = self.model.outputs.index(output)
        x = filled(7, lambda p, n: lib.cagedyn_sim_get_interval(self._handle, place, p, n))
        return Interval(*x.tolist())

    def accelerations(self) -> Array:
        """Accelerations at the present state, shape (velocities,)."""
        count = self.model.velocity_count
        return filled(count, lambda p, n: lib.cagedyn_sim_accelerations(self._handle, p, n))

    def contact_forces(self) -> NDArray[np.void]:
        """Forces of all contacts at the present state: a structured array, one row per contact, a field per quantity."""
        return self._contacts(lambda p, n: lib.cagedyn_sim_contact_forces(self._handle, p, n))

    def contact_forces_at(self, t: float, state: ArrayLike) -> NDArray[np.void]:
        """The same at any time in s and state."""
        x, length, _keep = numbers(state)
        return self._contacts(
            lambda p, n: lib.cagedyn_sim_contact_forces_at(self._handle, t, x, length, p, n)
        )

    def _contacts(self, fill: Any) -> NDArray[np.void]:
        names = self.model.contact_quantities
        values = filled(len(self.model.contacts) * len(names), fill)
        return values.view(np.dtype([(name, float) for name in names]))

    def line_loads(self, contact: str) -> NDArray[np.void]:
        """How a contact of a roller that moves in space is loaded along its length at the present state: a structured array, one row
        per place, a field per quantity: place (m), extent (m), line_load (N/m), largest_pressure (Pa), half_width (m).

        Empty where the surfaces are apart, and for contacts that are no lines.
        """
        place, names = self.model.contacts.index(contact), self.model.line_load_quantities
        rows = counted(lib.cagedyn_sim_line_load_count(self._handle, place))
        values = filled(
            rows * len(names), lambda p, n: lib.cagedyn_sim_line_loads(self._handle, place, p, n)
        )
        return values.view(np.dtype([(name, float) for name in names]))

    def body_forces(self) -> Array:
        """Forces on all bodies by source at the present state, shape (bodies, sources, components)."""
        return self._bodies(lambda p, n: lib.cagedyn_sim_body_forces(self._handle, p, n))

    def body_forces_at(self, t: float, state: ArrayLike) -> Array:
        """The same at any time in s and state."""
        x, length, _keep = numbers(state)
        return self._bodies(lambda p, n: lib.cagedyn_sim_body_forces_at(self._handle, t, x, length, p, n))

    def _bodies(self, fill: Any) -> Array:
        m = self.model
        shape = (len(m.bodies), len(m.force_sources), len(m.force_components))
        return filled(math.prod(shape), fill).reshape(shape)

    def outputs_at(self, t: float, state: ArrayLike) -> dict[str, float]:
        """All outputs at any time in s and state, with the forces of that state."""
        x, length, _keep = numbers(state)
        values = filled(
            len(self.model.outputs),
            lambda p, n: lib.cagedyn_sim_outputs_at(self._handle, t, x, length, p, n),
        )
        return dict(zip(self.model.outputs, values.tolist()))

    def energies_at(self, t: float, state: ArrayLike) -> dict[str, float]:
        """Kinetic, elastic and potential energy in J at any time in s and state."""
        x, length, _keep = numbers(state)
        names = _named(lib.cagedyn_energy_count, lib.cagedyn_energy_name)
        values = filled(
            len(names), lambda p, n: lib.cagedyn_sim_energies_at(self._handle, t, x, length, p, n)
        )
        return dict(zip(names, values.tolist()))

    def derivative(self, t: float, state: ArrayLike) -> Array:
        """Rate of a state at time `t` in s, shape (states,): right-hand side for any integrator."""
        x, length, _keep = numbers(state)
        return filled(length, lambda p, n: lib.cagedyn_sim_derivative(self._handle, t, x, p, n))

    def time_derivative(self, t: float, state: ArrayLike) -> Array:
        """Derivative over time of what `derivative` gives at a constant state, per s."""
        x, length, _keep = numbers(state)
        return filled(length, lambda p, n: lib.cagedyn_sim_time_derivative(self._handle, t, x, p, n))

    def jacobian(self, t: float, state: ArrayLike) -> Array:
        """Exact derivatives of what `derivative` gives over the state, shape (states, states): rate, then state."""
        x, length, _keep = numbers(state)
        by_columns = filled(
            length * length, lambda p, n: lib.cagedyn_sim_jacobian(self._handle, t, x, length, p, n)
        )
        return by_columns.reshape(length, length).T

    def input_jacobian(self, t: float, state: ArrayLike) -> Array:
        """Exact derivatives of what `derivative` gives over the inputs, shape (states, inputs)."""
        x, length, _keep = numbers(state)
        inputs = len(self.model.inputs)
        by_columns = filled(
            length * inputs, lambda p, n: lib.cagedyn_sim_input_jacobian(self._handle, t, x, length, p, n)
        )
        return by_columns.reshape(inputs, length).T

    def output_jacobian(self, t: float, state: ArrayLike) -> tuple[Array, Array]:
        """Derivatives of the outputs over states, shape (outputs, states), and over inputs, shape (outputs, inputs), good to some
        five digits."""
        x, length, _keep = numbers(state)
        outputs, inputs = len(self.model.outputs), len(self.model.inputs)
        over_states, over_inputs = np.empty(outputs * length), np.empty(outputs * inputs)
        pointers = [ffi.cast("double *", ffi.from_buffer(array)) for array in (over_states, over_inputs)]
        check(
            lib.cagedyn_sim_output_jacobian(
                self._handle, t, x, length, pointers[0], over_states.size, pointers[1], over_inputs.size
            )
        )
        return over_states.reshape(length, outputs).T, over_inputs.reshape(inputs, outputs).T

    def next_event(self, t: float) -> float:
        """The first time after `t` (s) at which an input that follows the scene jumps or has a kink; infinity without one."""
        event = ffi.new("double *")
        check(lib.cagedyn_sim_next_event(self._handle, t, event))
        return float(event[0])

    def sparse_jacobian(self, t: float, state: ArrayLike, pattern: SparsePattern) -> Array:
        """The same without what is always zero, in the order of `Model.jacobian_pattern`, shape (entries,)."""
        x, length, _keep = numbers(state)
        return filled(
            pattern.indices.size,
            lambda p, n: lib.cagedyn_sim_sparse_jacobian(self._handle, t, x, length, p, n),
        )

    def linearize(self, t: float, state: ArrayLike) -> None:
        """Evaluates the derivatives J that `factorize` uses."""
        x, length, _keep = numbers(state)
        check(lib.cagedyn_sim_linearize(self._handle, t, x, length))

    def factorize(self, gamma: float) -> None:
        """Factorizes I - gamma J, gamma > 0 in s, in time proportional to the number of rollers."""
        check(lib.cagedyn_sim_factorize(self._handle, gamma))

    def solve(self, b: ArrayLike) -> Array:
        """Solution x of (I - gamma J) x = b, shape (states,)."""
        x = np.array(b, dtype=np.float64)
        check(lib.cagedyn_sim_solve(self._handle, ffi.cast("double *", x.ctypes.data), x.size))
        return x

    def save(self) -> Array:
        """Everything that its future depends on, for `restore`."""
        length = counted(lib.cagedyn_sim_save_length(self._handle))
        return filled(length, lambda p, n: lib.cagedyn_sim_save(self._handle, p, n))

    def restore(self, saved: ArrayLike) -> None:
        """Continues from what `save` gave, with the same bits. On failure nothing changes."""
        pointer, length, _keep = numbers(saved)
        check(lib.cagedyn_sim_restore(self._handle, pointer, length))

    @property
    def doubts(self) -> str:
        """Why the run does not keep what its preset promises, or why that cannot be known; empty if it does."""
        status = lib.cagedyn_sim_trust(self._handle)
        if status in (lib.CAGEDYN_ERR_UNTRUSTED, lib.CAGEDYN_ERR_NOT_JUDGED):
            return str(last_error())
        check(status)
        return ""

    @property
    def trusted(self) -> bool | None:
        """Whether the run kept what its preset promises; None where `set_state` moved it on the way, so that the power balance
        cannot know."""
        status = lib.cagedyn_sim_trust(self._handle)
        if status == lib.CAGEDYN_ERR_NOT_JUDGED:
            return None
        if status != lib.CAGEDYN_ERR_UNTRUSTED:
            check(status)
        return bool(status == lib.CAGEDYN_OK)

    @property
    def report(self) -> str:
        """What the integration does and why, in one line for people."""
        return text(lib.cagedyn_sim_report(self._handle))

    @property
    def statistics(self) -> dict[str, float]:
        """Counts since creation or reset by name."""
        names = _named(lib.cagedyn_statistic_count, lib.cagedyn_statistic_name)
        values = filled(len(names), lambda p, n: lib.cagedyn_sim_statistics(self._handle, p, n))
        return dict(zip(names, values.tolist()))

    @property
    def law_evaluations(self) -> dict[str, float]:
        """How often each force law was evaluated, by name."""
        names = _named(lib.cagedyn_law_count, lib.cagedyn_law_name)
        values = filled(len(names), lambda p, n: lib.cagedyn_sim_law_evaluations(self._handle, p, n))
        return dict(zip(names, values.tolist()))

    @property
    def power_balance(self) -> dict[str, float]:
        """Works and gains of energy in J by name, and what is missing."""
        names = _named(lib.cagedyn_balance_count, lib.cagedyn_balance_name)
        values = filled(len(names), lambda p, n: lib.cagedyn_sim_power_balance(self._handle, p, n))
        return dict(zip(names, values.tolist()))
