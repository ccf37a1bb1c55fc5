"""Steady whirl, temperatures and motions: the numbers of the library, names, errors."""

import _thread
import math
import threading
import time
from pathlib import Path

import cagedyn
import numpy as np
import pytest

SCENES = Path(__file__).parents[2] / "scenes"


@pytest.fixture(scope="module")
def guide():
    return cagedyn.Model.from_file(SCENES / "grease_guide.json")


def test_steady_whirl(guide):
    one = cagedyn.WhirlBranch(guide)
    assert one.points.shape == (1,) and one.end == "range" and one.why == "" and one.amplitudes.shape == (1, 0)
    assert -1963.0 < one.points["whirl_speed"][0] < -1961.0 and one.points["stable"][0] == 1.0
    assert one.eigenvalues.shape == (1, 5) and one.eigenvalues[0, 0].real == one.points["leading_rate"][0]


def test_branch(guide):
    branch = cagedyn.WhirlBranch(guide, "inner_ring.speed.constant", 314.16, 450.0)
    assert len(branch.points) > 2 and branch.points["parameter"][-1] == 450.0
    assert (np.diff(branch.points["whirl_speed"]) < 0.0).all()
    with pytest.raises(cagedyn.Error, match="sped"):
        cagedyn.WhirlBranch(guide, "inner_ring.sped", 1.0, 2.0)


def test_elastic_whirl():
    elastic = cagedyn.Model.from_file(SCENES / "grease_guide_elastic.json")
    assert cagedyn.WhirlBranch(elastic).amplitudes.shape == (1, len(range(2, 5)))


def after_ctrl_c(call):
    """The KeyboardInterrupt of a call that is interrupted after a tenth of a second, and how long it then took, s."""
    pressed = []

    def press():
        pressed.append(time.monotonic())
        _thread.interrupt_main()

    threading.Timer(0.1, press).start()
    with pytest.raises(KeyboardInterrupt) as caught:
        call()
    return caught.value, time.monotonic() - pressed[0]


def test_branch_that_is_ended():
    elastic = cagedyn.Model.from_file(SCENES / "grease_guide_elastic.json")
    path = "inner_ring.speed.constant"
    told = []
    # Long enough for a point, however slow the machine, and too short for the branch.
    branch, seconds = None, 0.02
    while branch is None:
        try:
            branch = cagedyn.WhirlBranch(
                elastic, path, 314.16, 900.0, wall_time=seconds, progress=lambda *now: told.append(now)
            )
        except cagedyn.Error as late:
            assert late.name == "ERR_OUT_OF_TIME"
            seconds *= 1.5
    assert branch.end == "out of time" and "wall time" in branch.why and len(branch.points) >= 1
    assert told and all(0.0 <= share <= 1.0 for share, _ in told)
    interrupt, seconds = after_ctrl_c(lambda: cagedyn.WhirlBranch(elastic, path, 314.16, 3000.0))
    assert seconds < 0.5
    assert interrupt.branch is None or interrupt.branch.end == "cancelled"
    with pytest.raises(cagedyn.Error, match="wall time") as late:
        cagedyn.WhirlBranch(elastic, wall_time=0.0)
    assert late.value.name == "ERR_OUT_OF_TIME"


def test_heat_that_is_ended():
    heat = cagedyn.HeatBalance(cagedyn.Model.from_file(SCENES / "nu2310_heat.json"))
    start = heat.temperatures
    _, seconds = after_ctrl_c(heat.settle)
    assert seconds < 0.5
    with pytest.raises(cagedyn.Error, match="wall time"):
        heat.settle(wall_time=0.1)
    with pytest.raises(RuntimeError, match="enough"):
        heat.settle(progress=_enough)
    # What bursts came to is kept, and more of them go on from there.
    assert heat.temperatures != start and heat.quantities["bursts"] >= 1.0
    kept = heat.temperatures
    heat.step(1.0)
    assert heat.temperatures != kept


def _enough(share, bursts):
    if bursts > 0:
        raise RuntimeError("enough")


def test_heat(guide):
    heat = cagedyn.HeatBalance(cagedyn.Model.from_file(SCENES / "grease_guide_heat.json"))
    assert "film" in heat.lumps and len(heat.links) == 8
    with pytest.raises(cagedyn.Error, match="no motion has been run"):
        _ = heat.into_lumps
    start = heat.temperatures
    heat.step(10.0)
    assert heat.temperatures["film"] > start["film"]
    heat.settle()
    assert abs(heat.temperatures["film"] - 330.95) < 0.3
    out = sum(
        flow * (second is None) - flow * (first is None)
        for (first, second), flow in zip(heat.links, heat.flows)
    )
    assert abs(out - sum(heat.into_lumps.values())) < 0.1 and sum(heat.source_heat.values()) > 0.0
    assert heat.quantities["whirl_speed"] < 0.0 and math.isnan(heat.quantities["radial_clearance"])
    heat.temperatures = {"film": 300.0}
    assert heat.temperatures["film"] == 300.0
    with pytest.raises(cagedyn.Error, match="2000 K of film"):
        heat.temperatures = {"film": 2000.0}
    with pytest.raises(KeyError, match="there is no lump 'oil'"):
        heat.temperatures = {"oil": 300.0}
    with pytest.raises(cagedyn.Error, match="heat: missing"):
        cagedyn.HeatBalance(guide)


def test_motion():
    t = 1e-4 * np.arange(1000)
    circle = 1e-4 * np.exp(-2000j * t)
    cage = {"whirl_speed": np.full(1000, -2000.0), "cage_speed": np.full(1000, 140.0)}
    motion = cagedyn.cage_motion(t, circle.real, circle.imag, **cage, clearance=2e-4, begin=0.05)
    assert motion.motion == "backward whirl" and motion.mean_whirl_speed == -2000.0
    assert motion.mean_radius == pytest.approx(1e-4) and motion.settling_time == 0.0
    assert motion.backward_share == 1.0 and motion.intermittent is False
    with pytest.raises(ValueError, match="of one length"):
        cagedyn.cage_motion(t, circle.real, circle.imag[1:], **cage, clearance=2e-4)
    with pytest.raises(cagedyn.Error, match="clearance: -1"):
        cagedyn.cage_motion(t, circle.real, circle.imag, **cage, clearance=-1.0)


def test_over_orbit():
    orbit = cagedyn.over_orbit([0.1, 0.2, 3.2], [1.0, -3.0, 5.0], 2)
    assert orbit["mean"].tolist() == [-1.0, 5.0] and orbit["peak"].tolist() == [3.0, 5.0]
    with pytest.raises(cagedyn.Error, match="sectors: 0"):
        cagedyn.over_orbit([0.1], [1.0], 0)
