"""A host that integrates a rotor in time and owns the inner rings of its bearings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any

import cagedyn
import numpy as np
from rotor import Array, Complex, Rotor, Tangent


class OwnedRing:
    """A bearing whose inner ring the host moves."""

    def __init__(self, scene: str | PathLike[str], speed: float, place: Array) -> None:
        y, z = place.tolist()
        overrides: dict[str, Any] = {
            "inner_ring.speed.constant": speed,
            "inner_ring.motion": {"prescribed": {"y": y, "z": z}},
            "initial.inner_ring": "equilibrium",
        }
        self.sim = cagedyn.Sim(cagedyn.Model.from_file(scene, overrides))

    def moved(self, t: float, velocity: Array, acceleration: Array) -> Array:
        """Moves the ring to time `t` in s, from `velocity` on with a constant acceleration, arrays of shape (2,) in m/s and m/s^2.
        Returns the force on it there in N, shape (2,)."""
        rates = ("inner_ring.vy", "inner_ring.vz")
        for name, v, a in zip(rates, velocity.tolist(), acceleration.tolist(), strict=True):
            self.sim.inputs.ramp(name, v, a)
        self.sim.advance_to(t)
        return self.force

    @property
    def force(self) -> Array:
        """On the ring now, N, shape (2,)."""
        return np.array([self.sim.output("inner_ring.force_y"), self.sim.output("inner_ring.force_z")])

    @property
    def cage(self) -> Array:
        """Speed of the cage now in rad/s and its slip, shape (2,)."""
        return np.array([self.sim.output("cage.speed"), self.sim.output("cage.slip")])


@dataclass(frozen=True)
class Run:
    """What was recorded at every step but the first."""

    #: s, shape (steps,).
    time: Array
    #: Coordinates of the rotor, m and rad, shape (steps, n).
    place: Array
    #: Forces of the bearings on the rotor, N, shape (steps, bearings, 2).
    force: Array
    #: Speed of the cages in rad/s and their slip, shape (steps, bearings, 2).
    cage: Array

    def synchronous(self, period: int, turns: int, skipped: int = 0) -> Complex:
        """Motion once per revolution of `period` steps, over so many turns, which end some turns before the run: its real part
        times exp(i W t). Shape (n,)."""
        end = len(self.time) - skipped * period
        steps = np.arange(end - turns * period, end)
        wave = np.exp(-2.0j * np.pi * (steps + 1) / period)
        return np.asarray(2.0 / len(steps) * (wave @ self.place[steps]))


def simulate(
    rotor: Rotor, tangent: Tangent, bearings: Sequence[OwnedRing], start: Array, period: int, turns: int
) -> Run:
    """Motion from rest at `start` on, shape (n,), over so many revolutions of `period` steps each.

    The trapezoidal rule solves the rotor on the tangent of its bearings, whose stiffness is thus no limit of the step: it gives
    the acceleration at its end. The rings move with the mean of that and the one before, as the host's coordinates do. By what
    their forces then differ from the tangent the acceleration at the end is corrected, and with it the velocity, as velocity
    Verlet does. So no bearing moves twice over a step, and the rule is of second order whatever the tangent.
    """
    h = 2.0 * np.pi / (rotor.speed * period)
    damping = rotor.damping + rotor.speed * rotor.gyroscopic
    held, damped = rotor.held(tangent.stiffness), rotor.held(tangent.damping)
    inverse = np.linalg.inv(rotor.mass + 0.5 * h * (damping + damped) + 0.25 * h**2 * (rotor.stiffness + held))
    turning_force = rotor.turning_force
    explicit = np.linalg.inv(rotor.mass + 0.5 * h * damping)

    def acting(step: int, forces: Array) -> Array:
        turning = (turning_force * np.exp(2.0j * np.pi * step / period)).real
        return np.asarray(rotor.load + turning + np.einsum("bk,bkn->n", forces, rotor.ends))

    x, v = start.copy(), np.zeros_like(start)
    forces = np.array([bearing.force for bearing in bearings])
    a = np.linalg.solve(rotor.mass, acting(0, forces) - rotor.stiffness @ x)
    records = []
    for step in range(1, turns * period + 1):
        t = step * h
        # The tangent's forces at the end of the step, without what the unknown acceleration adds to them.
        near, fast = x + h * v + 0.25 * h**2 * a, v + 0.5 * h * a
        elastic, viscous = rotor.stiffness @ near + held @ (near - x), damping @ fast + damped @ (fast - v)
        predicted = inverse @ (acting(step, forces) - elastic - viscous)
        mean = 0.5 * (a + predicted)
        expected = acting(step, forces) - held @ (h * v + 0.5 * h**2 * mean) - damped @ (h * mean)
        forces = np.array(
            [bearing.moved(t, end @ v, end @ mean) for bearing, end in zip(bearings, rotor.ends, strict=True)]
        )
        x = x + h * v + 0.5 * h**2 * mean
        corrected = predicted + explicit @ (acting(step, forces) - expected)
        v = v + 0.5 * h * (a + corrected)
        a = corrected
        records.append((t, x, forces, [bearing.cage for bearing in bearings]))
    return Run(*(np.array(column) for column in zip(*records, strict=True)))
