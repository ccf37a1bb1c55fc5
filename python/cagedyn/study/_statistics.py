"""Statistics of a run, by the names that the command `sweep` has for them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._analysis import cage_motion
from .._model import Model
from .._native import Array
from .._sim import Sim

#: Numbers of every output.
PARTS = ("mean", "deviation", "min", "max", "5 %", "95 %")

#: The window at the end of a run that statistics are over, where the scene has none: s, and its largest share of
#: the run.
_WINDOW, _LARGEST_SHARE = 0.1, 1.0 / 3.0

#: Share of the guide clearance below which the whirl speed says nothing.
_SMALLEST_WHIRL_RADIUS = 1e-3

#: Outputs that tell how a cage moves, in the order of `cage_motion`: about the centre of its guide, or of the
#: bearing without one.
_GUIDED = ("cage.y_ratio", "cage.z_ratio", "cage.whirl_speed", "cage.speed")
_FREE = ("cage.y", "cage.z", "cage.whirl_speed", "cage.speed")
_WHIRL_SPEED, _WHIRL_RADIUS = "cage.whirl_speed", "cage.whirl_radius"


def chosen_outputs(model: Model, outputs: list[str] | None) -> list[str]:
    """Outputs of a model whose statistics are taken: by default all that are not of one element.

    Raises KeyError for one that the model has not.
    """
    if outputs is None:
        return [name for name in model.outputs if "[" not in name]
    return [model.outputs[model.outputs.index(name)] for name in outputs]


def statistics(sim: Sim, outputs: list[str] | None) -> dict[str, float | str]:
    """Runs to the end of the record of the scene. Statistics over its averaging window, of outputs in their units,
    and of the motion of a cage where no outputs are named; NaN for what is not known."""
    model, names = sim.model, chosen_outputs(sim.model, outputs)
    clearance = model.geometry.get("guide_clearance", 0.0)
    centre = _GUIDED if clearance else _FREE
    moves = outputs is None and all(name in model.outputs for name in centre)
    also = [*(centre if moves else ()), *([_WHIRL_RADIUS] if _WHIRL_SPEED in names else ())]
    records = _window(sim, list(dict.fromkeys([*names, *also])))
    results: dict[str, float | str] = {}
    if moves:
        scale = clearance or 1.0
        y, z, *speeds = (np.ascontiguousarray(records[name]) for name in centre)
        results = _motion(records["time"], scale * y, scale * z, speeds, clearance)
        if "cage.x" in model.outputs:
            del results["velocity deviation [1]"]  # Its speed along the axis is not seen here.
    table = np.stack([records[name] for name in names], axis=1)
    spreads = dict(zip(names, spread(table).T.tolist(), strict=True))
    if _WHIRL_SPEED in spreads:
        radius = records[_WHIRL_RADIUS]
        known = radius >= _SMALLEST_WHIRL_RADIUS * (clearance or radius.max())
        spreads[_WHIRL_SPEED] = spread(records[_WHIRL_SPEED][known][:, None])[:, 0].tolist()
    for name, numbers in spreads.items():
        unit = model.outputs.units[model.outputs.index(name)]
        results.update((f"{name} {part} [{unit}]", x) for part, x in zip(PARTS, numbers, strict=True))
    return results


def _window(sim: Sim, names: list[str]) -> NDArray[np.void]:
    """Records of the averaging window."""
    record = sim.model.scene["record"]
    duration, interval = record["duration"], record["interval"]
    usual = max(min(_WINDOW, _LARGEST_SHARE * duration), interval)
    length = min(record.get("window", usual), duration)
    begin = max(duration - length - 1e-6 * interval, 0.0)
    # Steps do not depend on records, so that nothing needs to be recorded before.
    sim.advance_to(min(math.ceil(begin / interval) * interval, duration))
    return sim.record(duration, interval, names)


def spread(values: Array) -> Array:
    """The numbers of `PARTS` of each column of values, shape (records, columns); shape (parts, columns), NaN if
    there are no records."""
    count = len(values)
    if count == 0:
        return np.full((len(PARTS), values.shape[1]), np.nan)

    # Added up in their order: the bits of NumPy's own sums depend on the machine.
    def mean(x: Array) -> Array:
        total: Array = np.cumsum(x, axis=0)[-1]
        return total / count

    ordered = np.sort(values, axis=0)

    def percentile(share: float) -> Array:
        place = share * (count - 1.0)
        low = int(place)
        high = min(low + 1, count - 1)
        at: Array = ordered[low] + (place - low) * (ordered[high] - ordered[low])
        return at

    centre = mean(values)
    deviation = np.sqrt(mean((values - centre) * (values - centre)))
    return np.stack([centre, deviation, ordered[0], ordered[-1], percentile(0.05), percentile(0.95)])


def _motion(times: Any, y: Array, z: Array, speeds: list[Array], clearance: float) -> dict[str, float | str]:
    motion = cage_motion(np.ascontiguousarray(times), y, z, *speeds, clearance=clearance)
    return {
        "whirl speed mean [rad/s]": motion.mean_whirl_speed,
        "whirl speed 5 % [rad/s]": motion.p05_whirl_speed,
        "whirl speed 95 % [rad/s]": motion.p95_whirl_speed,
        "whirl radius mean [m]": motion.mean_radius,
        "turns [1]": motion.turns,
        "motion": motion.motion,
        "velocity deviation [1]": motion.velocity_deviation,
        "share of time: resting [1]": motion.resting_share,
        "share of time: stable [1]": motion.stable_share,
        "share of time: forward whirl [1]": motion.forward_share,
        "share of time: backward whirl [1]": motion.backward_share,
        "share of time: irregular [1]": motion.irregular_share,
    }
