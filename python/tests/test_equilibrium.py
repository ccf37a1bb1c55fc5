"""Equilibrium of balls and rollers: the numbers of the library, names, errors."""

from pathlib import Path

import cagedyn
import numpy as np
import pytest

SCENES = Path(__file__).parents[2] / "scenes"


def test_balls():
    model = cagedyn.Model.from_file(SCENES / "angular_contact_218.json")
    found = cagedyn.Equilibrium(model)
    assert found.coordinates == ("x", "y", "z", "tilt_y", "tilt_z") and found.warnings == ()
    assert abs(found.displacement[0] - 36.1e-6) < 0.05e-6 and abs(found.load[0] - 17800.0) < 1e-6
    assert found.contacts.shape == (32,) and found.contact_names[1] == "ball[0].inner_raceway"
    assert abs(np.degrees(found.contacts["contact_angle"][1]) - 41.50) < 0.005
    assert found.contact_units["largest_pressure"] == "Pa" and found.element_units["orbit_speed"] == "rad/s"
    stiffness = found.stiffness
    assert stiffness.shape == (5, 5) and np.allclose(stiffness, stiffness.T, rtol=0.0, atol=1e-9 * stiffness.max())


def test_race_control():
    model = cagedyn.Model.from_file(
        SCENES / "angular_contact_218.json",
        {"inner_ring.speed.constant": 1047.1975511965977, "inner_ring.motion.space.load.x.constant": 22250.0},
    )
    angles = {
        control: np.degrees(cagedyn.Equilibrium(model, control).contacts["contact_angle"][1::-1])
        for control in ("outer", "none", "friction")
    }
    assert np.allclose(angles["outer"], [48.74, 33.58], atol=0.005) and np.allclose(angles["none"], [47.75, 34.98], atol=0.005)
    assert np.allclose(angles["friction"], [47.90, 34.67], atol=0.05)
    with pytest.raises(cagedyn.Error, match="control: 'both' is not one of outer, inner, none, friction"):
        cagedyn.Equilibrium(model, "both")


def test_rollers():
    found = cagedyn.Equilibrium(cagedyn.Model.from_file(SCENES / "nu2310.json"))
    assert found.coordinates == ("y", "z") and found.stiffness[1, 1] > 5e8
    assert found.elements.shape == (12,) and found.contacts["normal_force"].max() > 1e3


def test_no_equilibrium():
    guide = cagedyn.Model.from_file(SCENES / "grease_guide.json")
    with pytest.raises(cagedyn.Error, match="kinematic_elements"):
        cagedyn.Equilibrium(guide)
