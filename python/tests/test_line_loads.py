"""Loads along rollers that move in space."""

from pathlib import Path

import cagedyn
import numpy as np
import pytest

SCENE = Path(__file__).parents[2] / "scenes" / "nu2310_space.json"


@pytest.fixture(scope="module")
def model():
    return cagedyn.Model.from_file(SCENE)


def test_of_a_simulation(model):
    sim = cagedyn.Sim(model)
    sim.advance_to(1e-3)
    contact = "roller[9].inner_raceway"
    loads = sim.line_loads(contact)
    assert loads.dtype.names == tuple(model.line_load_quantities)
    force = sim.contact_forces()[model.contacts.index(contact)]["normal_force"]
    assert force > 100.0
    assert np.sum(loads["line_load"] * loads["extent"]) == pytest.approx(force, rel=1e-12)
    assert np.all(np.diff(loads["place"]) > 0.0)
    assert len(sim.line_loads("roller[3].inner_raceway")) == 0
    with pytest.raises(KeyError):
        sim.line_loads("roller[99].inner_raceway")


def test_of_an_equilibrium(model):
    found = cagedyn.Equilibrium(model)
    assert found.line_loads.shape == (len(found.contact_names), len(found.line_load_places))
    means = 0.5 * (found.line_loads[:, 1:] + found.line_loads[:, :-1])
    forces = means @ np.diff(found.line_load_places)
    assert forces == pytest.approx(found.contacts["normal_force"], rel=1e-3, abs=1e-6)


def test_of_rollers_in_the_plane(model):
    found = cagedyn.Equilibrium(cagedyn.Model.from_file(SCENE.with_name("nu2310.json")))
    assert found.life["dynamic_load_rating"] == pytest.approx(120542, rel=1e-4)
    assert found.life["life_turns"] == pytest.approx(cagedyn.Equilibrium(model).life["life_turns"], rel=0.05)
    assert found.life_units["life_time"] == "s"
    assert found.line_loads.shape == (len(found.contact_names), 0)
