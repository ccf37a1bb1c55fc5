"""One speed of the rotor, by ROSS and by co-simulation."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import ross_rotor
from host import OwnedRing, Run, simulate
from rotor import Array, Complex, Rotor, Tangent, static_place

SCENE = Path(__file__).parents[3] / "scenes" / "nu2310.json"
#: Load of each bearing, N; unbalance of the first disc, kg m; modes between held bearings; steps per revolution.
LOAD, UNBALANCE, MODES, PERIOD = -4900.0, 1e-4, 8, 400
#: Revolutions of each of two windows, and time before them in s: that of some eight decays of the bending of the shaft.
WINDOW, SETTLING = 30, 0.5


@dataclass(frozen=True)
class Case:
    """One speed and unbalance, both ways."""

    rotor: Rotor
    tangent: Tangent
    run: Run
    #: Of the first disc, kg m.
    unbalance: float
    #: Steps per revolution, rollers of a bearing.
    period: int
    rollers: int
    #: Synchronous motion: of the full rotor by ROSS, and in the coordinates of `rotor` over the last window and over that before.
    linear: Complex
    synchronous: Complex
    before: Complex
    #: Whether the bearings kept their power balance.
    trusted: bool

    def last(self, values: Array) -> Array:
        """Those of the last window."""
        return values[-WINDOW * self.period :]

    def beside(self, row: Array) -> float:
        """What of a coordinate's motion over the last window is not synchronous, rms about its mean."""
        wave = (row @ self.synchronous) * np.exp(1j * self.rotor.speed * self.last(self.run.time))
        return float(np.std(self.last(self.run.place) @ row - wave.real))


def radians(rpm: float) -> float:
    """Speed in rad/s of one in rev/min."""
    return rpm * np.pi / 30.0


def case(
    rpm: int,
    unbalance: float = UNBALANCE,
    *,
    belt: bool = True,
    period: int = PERIOD,
    modes: int = MODES,
    predicts: bool = True,
) -> Case:
    """Both ways at a speed in rev/min. Without the belt the bearings carry the weight of the rotor alone; without `predicts` the
    host knows nothing of a bearing but its last force."""
    full = ross_rotor.free(radians(rpm), unbalance)
    if belt:
        full = full.carrying(np.array([[0.0, LOAD], [0.0, LOAD]]))
    tangent = Tangent.mean(SCENE, full.speed, full.end_loads)
    known = tangent if predicts else replace(tangent, stiffness=0.0 * tangent.stiffness, damping=0.0 * tangent.damping)
    rotor = full.in_modes(modes)
    start = static_place(rotor, tangent)
    bearings = [OwnedRing(SCENE, rotor.speed, end @ start) for end in rotor.ends]
    run = simulate(rotor, known, bearings, start, period, int(np.ceil(SETTLING * rpm / 60.0)) + 2 * WINDOW)
    return Case(
        rotor=rotor,
        tangent=tangent,
        run=run,
        unbalance=unbalance,
        period=period,
        rollers=bearings[0].sim.model.scene["rollers"]["count"],
        linear=ross_rotor.unbalance_response(tangent, rotor.speed, unbalance),
        synchronous=run.synchronous(period, WINDOW),
        before=run.synchronous(period, WINDOW, skipped=WINDOW),
        trusted=all(bearing.sim.trusted for bearing in bearings),
    )
