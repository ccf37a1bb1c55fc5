"""The rotor in ROSS: two discs on a steel shaft between two cylindrical roller bearings, and its linear analysis there."""

from __future__ import annotations

import numpy as np
import ross  # type: ignore[import-untyped]
from rotor import Array, Complex, Rotor, Tangent

#: Elements of the shaft, and its nodes with bearings and discs.
ELEMENTS = 12
BEARINGS = (0, ELEMENTS)
DISCS = (5, 8)
SPAN, DIAMETER = 0.6, 50e-3
#: Width and diameter of the discs, m, and of the inner rings, which turn and move with the shaft.
SIZES, RING = ((65e-3, 0.28), (40e-3, 0.20)), (40e-3, 65e-3)
#: Damping to the ground at each disc and at each inner ring, N s/m: assumed, that of the rings as in the scene of the bearing.
DAMPING = (1000.0, 500.0, 3e3, 3e3)
#: Phase of the unbalance of each disc, rad, and its share.
PHASES, SHARES = (0.0, 1.5), (1.0, 0.5)
GRAVITY = 9.80665
#: Of the six coordinates of a node: x, y and the angles about them.
LATERAL = (0, 1, 3, 4)


def assembled(stiffness: Array, damping: Array) -> ross.Rotor:
    """The rotor on bearings of these matrices, shape (2, 2, 2) in N/m and N s/m. ROSS's x and y are cagedyn's y and z."""
    steel = ross.Material("steel", rho=7830.0, E=206e9, G_s=206e9 / 2.6)
    shaft = [ross.ShaftElement(SPAN / ELEMENTS, 0.0, DIAMETER, material=steel) for _ in range(ELEMENTS)]
    discs = [
        ross.DiskElement.from_geometry(n=n, material=steel, width=width, i_d=DIAMETER, o_d=diameter)
        for n, (width, diameter) in zip(DISCS + BEARINGS, SIZES + (RING, RING), strict=True)
    ]
    bearings = [
        ross.BearingElement(
            n=n,
            **{f"k{i}{j}": k["xy".index(i), "xy".index(j)] for i in "xy" for j in "xy"},
            **{f"c{i}{j}": c["xy".index(i), "xy".index(j)] for i in "xy" for j in "xy"},
        )
        for n, k, c in zip(BEARINGS, stiffness, damping, strict=True)
    ]
    brakes = [ross.SealElement(n=n, kxx=0.0, cxx=c) for n, c in zip(DISCS + BEARINGS, DAMPING, strict=True)]
    return ross.Rotor(shaft, discs, bearings + brakes)


def free(speed: float, unbalance: float) -> Rotor:
    """The rotor without bearings for a host, under its weight, along y and z and about both: what stretches and twists the shaft
    is left out. `unbalance` in kg m is that of the first disc."""
    none = np.zeros((2, 2, 2))
    rotor = assembled(none, none)
    nodes, per_node = ELEMENTS + 1, rotor.number_dof
    kept = np.array([per_node * n + k for n in range(nodes) for k in LATERAL])
    mass, damping, gyroscopic, stiffness = (
        np.asarray(matrix)[np.ix_(kept, kept)] for matrix in (rotor.M(0.0), rotor.C(0.0), rotor.G(), rotor.K(0.0))
    )
    rows = np.eye(len(kept)).reshape(nodes, len(LATERAL), -1)
    return Rotor(
        mass,
        damping,
        gyroscopic,
        stiffness,
        speed=speed,
        load=-GRAVITY * mass @ rows[:, 1].sum(axis=0),
        ends=rows[list(BEARINGS), :2],
        discs=rows[list(DISCS), :2],
        unbalance=(unbalance * np.array(SHARES) * np.exp(1j * np.array(PHASES))).astype(np.complex128),
    )


def critical_speeds(tangent: Tangent, count: int = 4) -> Array:
    """The lowest undamped critical speeds by ROSS in rad/s, shape (count,)."""
    return np.sort(assembled(tangent.stiffness, tangent.damping).run_critical_speed(num_modes=24).wn())[:count]


def campbell(tangent: Tangent, speeds: Array, count: int = 4) -> Array:
    """The lowest damped natural frequencies by ROSS in rad/s, shape (speeds, count)."""
    return np.asarray(assembled(tangent.stiffness, tangent.damping).run_campbell(speeds, frequencies=count).wd)[:, :count]


def unbalance_response(tangent: Tangent, speed: float, unbalance: float) -> Complex:
    """Unbalance response by ROSS along the coordinates of `free`, shape (n,)."""
    rotor = assembled(tangent.stiffness, tangent.damping)
    found = rotor.run_unbalance_response(
        list(DISCS), [unbalance * share for share in SHARES], list(PHASES), np.array([speed])
    )
    return np.asarray(found.forced_resp).reshape(ELEMENTS + 1, rotor.number_dof)[:, LATERAL].reshape(-1)


def mass() -> float:
    """Mass of the rotor, kg."""
    none = np.zeros((2, 2, 2))
    return float(assembled(none, none).m)
