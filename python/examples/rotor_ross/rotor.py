"""A rotor as any rotor code gives it, M x'' + (C + W G) x' + K x = f, and its linear response on springs for bearings.

Everything is in SI units; the speed W in rad/s is counter-clockwise positive, y points right and z up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from os import PathLike

import cagedyn
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: Shares of the pitch of the rollers at which bearings are looked at.
PHASES = tuple((k + 0.5) / 24 for k in range(24))


@dataclass(frozen=True)
class Rotor:
    """A rotor of n coordinates without its bearings at one speed."""

    #: M, C, G, K, shape (n, n) each.
    mass: Array
    damping: Array
    gyroscopic: Array
    stiffness: Array
    #: rad/s, above zero.
    speed: float
    #: Constant forces along the coordinates, shape (n,).
    load: Array
    #: What coordinates move bearings along y and z, shape (bearings, 2, n), and the places with unbalance, shape
    #: (unbalances, 2, n).
    ends: Array
    discs: Array
    #: In kg m, with its phase as that of a complex number, shape (unbalances,).
    unbalance: Complex

    def __post_init__(self) -> None:
        if not self.speed > 0.0:
            raise ValueError(f"speed: {self.speed} must be above 0 rad/s")

    @property
    def turning_force(self) -> Complex:
        """Force of the unbalance, whose real part times exp(i W t) acts; shape (n,)."""
        turning = self.speed**2 * np.outer(self.unbalance, [1.0, -1.0j])
        return np.asarray(np.einsum("dk,dkn->n", turning, self.discs))

    def held(self, matrices: Array) -> Array:
        """What matrices of the bearings, shape (bearings, 2, 2), add to those of the rotor, shape (n, n)."""
        return np.asarray(np.einsum("bkn,bkl,blm->nm", self.ends, matrices, self.ends))

    def _between_held_ends(self, forces: Array, places: Array) -> tuple[Array, Array]:
        """Where columns of forces, shape (n, k), leave the rotor whose bearings are held at columns of places, shape
        (2 bearings, k), and what it then loads them with."""
        ends = self.ends.reshape(-1, len(self.mass))
        bordered = np.block([[self.stiffness, ends.T], [ends, np.zeros((len(ends), len(ends)))]])
        found = np.linalg.solve(bordered, np.vstack([forces, places]))
        return found[: len(self.mass)], found[len(self.mass) :]

    @property
    def end_loads(self) -> Array:
        """What the constant forces load the inner rings with, N, shape (bearings, 2): two bearings, by statics alone."""
        ends = self.ends.shape[0] * 2
        _, loads = self._between_held_ends(self.load[:, None], np.zeros((ends, 1)))
        return loads.reshape(-1, 2)

    def carrying(self, loads: Array) -> Rotor:
        """The same with forces beside the bearings, as those of belts, by which the inner rings are loaded with `loads`."""
        return replace(self, load=self.load + np.einsum("bk,bkn->n", loads - self.end_loads, self.ends))

    def in_modes(self, count: int) -> Rotor:
        """The same in fewer coordinates, after Craig and Bampton: places of the bearings, with the rotor at rest between them,
        and so many of its lowest modes with the bearings held."""
        ends = self.ends.reshape(-1, len(self.mass))
        shapes, _ = self._between_held_ends(np.zeros((len(self.mass), len(ends))), np.eye(len(ends)))
        inner = np.linalg.qr(ends.T, mode="complete").Q[:, len(ends) :]
        root = np.linalg.inv(np.linalg.cholesky(inner.T @ self.mass @ inner))
        _, vectors = np.linalg.eigh(root @ inner.T @ self.stiffness @ inner @ root.T)
        modes = np.hstack([shapes, inner @ root.T @ vectors[:, :count]])
        return replace(
            self,
            mass=modes.T @ self.mass @ modes,
            damping=modes.T @ self.damping @ modes,
            gyroscopic=modes.T @ self.gyroscopic @ modes,
            stiffness=modes.T @ self.stiffness @ modes,
            load=modes.T @ self.load,
            ends=self.ends @ modes,
            discs=self.discs @ modes,
        )


def over_pitch(
    scene: str | PathLike[str], speed: float, load: Array, phases: Sequence[float] = PHASES
) -> tuple[Array, Array]:
    """Equilibria of a bearing whose inner ring bears `load` in N, shape (2,), with the rollers moved on by shares of their pitch:
    places of the ring in m, shape (phases, 2), and stiffness in N/m, shape (phases, 2, 2)."""
    count = cagedyn.Model.from_file(scene).scene["rollers"]["count"]
    # A ring whose own weight is nothing beside the load.
    ring = {"mass": 1e-6, "load": {"y": {"constant": load[0]}, "z": {"constant": load[1]}}}
    found = [
        cagedyn.Equilibrium(
            cagedyn.Model.from_file(
                scene,
                {
                    "inner_ring.speed.constant": speed,
                    "inner_ring.motion": {"free": ring},
                    "initial.first_roller_angle": 2.0 * np.pi / count * phase,
                },
            )
        )
        for phase in phases
    ]
    return np.array([one.displacement for one in found]), np.array([one.stiffness for one in found])


@dataclass(frozen=True)
class Tangent:
    """What bearings do to small motions about the places where they carry the load."""

    #: Loads on the inner rings, N, and their places, m; shape (bearings, 2).
    load: Array
    place: Array
    #: Shape (bearings, 2, 2), N/m and N s/m.
    stiffness: Array
    damping: Array

    @classmethod
    def mean(cls, scene: str | PathLike[str], speed: float, loads: Array) -> Tangent:
        """Of the same bearing at all places, with `loads` on the inner rings in N, shape (bearings, 2): means over a pitch of the
        rollers. A shaft that is soft beside its bearings brings forces, so the mean is that of compliances, and the stiffness is
        the inverse of it. The damping is that of the relaxation time which the scene gives the contacts of the raceways."""
        found = [over_pitch(scene, speed, load) for load in loads]
        place = np.array([places.mean(axis=0) for places, _ in found])
        stiffness = np.array([np.linalg.inv(np.linalg.inv(each).mean(axis=0)) for _, each in found])
        relaxation = cagedyn.Model.from_file(scene).scene["raceways"]["contact"]["damping"]["relaxation_time"]
        return cls(loads, place, stiffness, relaxation * stiffness)


def unbalance_response(rotor: Rotor, tangent: Tangent) -> Complex:
    """Linear response, shape (n,): the motion is the real part of it times exp(i W t) about `static_place`."""
    w = rotor.speed
    dynamic = (
        rotor.stiffness
        + rotor.held(tangent.stiffness)
        + 1j * w * (rotor.damping + w * rotor.gyroscopic + rotor.held(tangent.damping))
        - w**2 * rotor.mass
    )
    return np.asarray(np.linalg.solve(dynamic, rotor.turning_force))


def static_place(rotor: Rotor, tangent: Tangent) -> Array:
    """Where the rotor rests with its inner rings next to the places of the tangent, shape (n,)."""
    at_rest = np.einsum("bkl,bl->bk", tangent.stiffness, tangent.place) - tangent.load
    force = rotor.load + np.einsum("bk,bkn->n", at_rest, rotor.ends)
    return np.asarray(np.linalg.solve(rotor.stiffness + rotor.held(tangent.stiffness), force))
