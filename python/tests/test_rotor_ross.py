"""The host of rotors: its rule beside the exact response of springs, then with bearings; where ROSS is there, a rotor of it."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "python" / "examples" / "rotor_ross"))

from host import OwnedRing, simulate  # noqa: E402
from rotor import Rotor, Tangent, static_place, unbalance_response  # noqa: E402

SCENE = ROOT / "scenes" / "nu2310.json"
LOADS = np.array([[0.0, -4900.0], [0.0, -4900.0]])


def jeffcott(speed, disc_damping):
    """A disc between two ends of 3 kg on a shaft without mass; it tilts with the ends, by which y and z are coupled."""
    span, stiffness, disc, end = 0.6, 1.4e7, 40.0, 3.0
    bent, tilted = np.array([-0.5, 1.0, -0.5]), np.array([-1.0, 0.0, 1.0]) / span
    mass = np.diag([end, disc, end]) + 0.3 * np.outer(tilted, tilted)
    polar = 0.6 * np.outer(tilted, tilted)
    plane = np.eye(2)
    rows = np.eye(6).reshape(3, 2, 6)
    masses = np.kron(mass, plane)
    return Rotor(
        mass=masses,
        damping=np.kron(np.diag([3e3, disc_damping, 3e3]), plane),
        gyroscopic=np.kron(polar, np.array([[0.0, 1.0], [-1.0, 0.0]])),
        stiffness=np.kron(stiffness * np.outer(bent, bent), plane),
        speed=speed,
        load=-9.80665 * masses @ rows[:, 1].sum(axis=0),
        ends=rows[[0, 2]],
        discs=rows[[1, 2]],
        unbalance=np.array([2e-4, 0.5e-4j]),
    ).carrying(LOADS)


class Spring:
    """A bearing whose force is linear about a place."""

    cage = np.zeros(2)

    def __init__(self, place, stiffness, damping, load, start):
        self.load, self.stiffness, self.damping = load, stiffness, damping
        self.time, self.offset, self.velocity = 0.0, start - place, np.zeros(2)

    def moved(self, t, velocity, acceleration):
        h = t - self.time
        self.offset = self.offset + h * velocity + 0.5 * h**2 * acceleration
        self.time, self.velocity = t, velocity + h * acceleration
        return self.force

    @property
    def force(self):
        return -self.load - self.stiffness @ self.offset - self.damping @ self.velocity


@pytest.fixture(scope="module")
def tangent():
    return Tangent.mean(SCENE, 600.0, LOADS)


def on_springs(rotor, tangent, known, period):
    """Synchronous motion on springs that are the tangent, by a host that takes them for `known`."""
    start = static_place(rotor, tangent)
    of_springs = (tangent.place, tangent.stiffness, tangent.damping, tangent.load, rotor.ends @ start)
    springs = [Spring(*of_one) for of_one in zip(*of_springs, strict=True)]
    return simulate(rotor, known, springs, start, period, 40).synchronous(period, 4)


def test_trapezoidal_rule(tangent):
    """With the tangent that bearings have the rule has the exact response at the frequency 2/h tan(W h/2), as the trapezoidal rule
    has, also where the rings vibrate far faster than it steps."""
    rotor, period = jeffcott(600.0, 8e3), 20
    w = rotor.speed * period / np.pi * np.tan(np.pi / period)
    damping = rotor.damping + rotor.speed * rotor.gyroscopic + rotor.held(tangent.damping)
    dynamic = rotor.stiffness + rotor.held(tangent.stiffness) + 1j * w * damping - w**2 * rotor.mass
    exact = np.linalg.solve(dynamic, rotor.turning_force)
    assert np.abs(on_springs(rotor, tangent, tangent, period) - exact).max() < 1e-6 * np.abs(exact).max()


def test_order(tangent):
    """With a tangent that is far from what bearings do the error goes down with the square of the step."""
    rotor = jeffcott(600.0, 8e3)
    exact = unbalance_response(rotor, tangent)
    wrong = replace(tangent, stiffness=0.7 * tangent.stiffness, damping=0.0 * tangent.damping)
    periods = (200, 400, 800)
    errors = [np.abs(on_springs(rotor, tangent, wrong, period) - exact).max() / np.abs(exact).max() for period in periods]
    assert errors[0] < 2e-3, errors
    assert 3.5 < errors[0] / errors[1] < 4.5 and 3.5 < errors[1] / errors[2] < 4.5, errors


def test_bearings(tangent):
    """Small vibration on bearings is that on their mean compliance: within 1 % at the disc, 5 % at the rings."""
    rotor = jeffcott(600.0, 8e3)
    start = static_place(rotor, tangent)
    bearings = [OwnedRing(SCENE, rotor.speed, end @ start) for end in rotor.ends]
    period, turns = 200, 24
    run = simulate(rotor, tangent, bearings, start, period, 16 + turns)
    linear, ours = unbalance_response(rotor, tangent), run.synchronous(period, turns)
    for rows, tolerance in ((rotor.discs[0], 0.01), (rotor.ends[0], 0.05), (rotor.ends[1], 0.05)):
        apart = np.linalg.norm(rows @ (ours - linear)) / np.linalg.norm(rows @ linear)
        assert apart < tolerance, (tolerance, apart)
    assert all(bearing.sim.trusted for bearing in bearings)
    # The rings are where the host has them, and carry the load.
    places = [[bearing.sim.output("inner_ring.y"), bearing.sim.output("inner_ring.z")] for bearing in bearings]
    assert np.allclose(places, rotor.ends @ run.place[-1], rtol=0.0, atol=1e-15)
    assert np.allclose(run.force[-turns * period :].mean(axis=0), -LOADS, rtol=0.0, atol=5.0)


def test_backward_rotation_is_refused():
    with pytest.raises(ValueError, match="speed: -600.0 must be above 0 rad/s"):
        jeffcott(-600.0, 8e3)


def test_rotor_of_ross():
    """Its matrices in fewer coordinates have the response that ROSS finds itself, and on bearings within 1 % at the discs."""
    pytest.importorskip("ross")
    from case import case
    from ross_rotor import free

    found = case(7000)
    full = free(found.rotor.speed, found.unbalance)
    reduced = unbalance_response(found.rotor, found.tangent)
    for whole, ours, tolerance in ((full.discs, found.rotor.discs, 0.01), (full.ends, found.rotor.ends, 0.05)):
        of_ross = whole @ found.linear
        assert np.allclose(whole @ unbalance_response(full, found.tangent), of_ross, rtol=1e-9, atol=0.0)
        assert np.allclose(ours @ reduced, of_ross, rtol=1e-3, atol=0.0)
        apart = np.linalg.norm(ours @ found.synchronous - of_ross) / np.linalg.norm(of_ross)
        assert apart < tolerance, (tolerance, apart)
    assert found.trusted
