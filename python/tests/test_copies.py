"""Copies, and what goes to other processes and comes back from them."""

import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import cagedyn
import numpy as np
import pytest

SCENE = Path(__file__).parents[2] / "scenes" / "nu2310.json"

#: What a process that hangs fails by, s.
LONG = 120.0


@pytest.fixture(scope="module")
def model():
    return cagedyn.Model.from_file(SCENE)


@pytest.fixture
def sim(model):
    sim = cagedyn.Sim(model, preset="draft")
    sim.advance_to(0.5e-3)
    sim.inputs["load.z"] = -1000.0
    return sim


def pickled(value):
    return pickle.loads(pickle.dumps(value))


def test_models(model):
    other = pickled(model)
    assert other.scene == model.scene and list(other.outputs) == list(model.outputs)
    assert copy.copy(model) is model and copy.deepcopy([model])[0] is model


@pytest.mark.parametrize("copied", [pickled, copy.copy, copy.deepcopy])
def test_simulations_go_on_with_the_same_bits(sim, copied):
    other = copied(sim)
    assert other.time == sim.time and other.inputs["load.z"] == -1000.0
    sim.advance_to(1e-3)
    assert other.time == 0.5e-3
    other.advance_to(1e-3)
    assert np.array_equal(sim.state, other.state) and other.statistics == sim.statistics
    assert other.power_balance == sim.power_balance


def test_batches(model, sim):
    batch = cagedyn.Batch([sim, cagedyn.Sim(model)])
    other = copy.deepcopy(batch)
    assert other.advance_to(1e-3) == batch.advance_to(1e-3) == [None, None]
    assert all(np.array_equal(a.state, b.state) for a, b in zip(batch.sims, other.sims))
    assert "at 0.001 s" in repr(batch)


def test_errors(model):
    with pytest.raises(cagedyn.Error) as failure:
        cagedyn.Model.from_json("{}")
    failure.value.records = 3
    for other in (pickled(failure.value), copy.copy(failure.value)):
        assert type(other) is cagedyn.Error and str(other) == str(failure.value)
        assert (other.status, other.name, other.records) == (failure.value.status, "ERR_BAD_JSON", 3)
    batch = cagedyn.Batch(cagedyn.Sim(model) for _ in range(2))
    batch[1].set_wall_time_limit(0.0)
    with pytest.raises(cagedyn.BatchError) as failure:
        batch.advance_to(1e-3)
    other = pickled(failure.value)
    assert type(other) is cagedyn.BatchError and str(other) == str(failure.value)
    assert other.failures[0] is None and other.failures[1].name == other.name == "ERR_OUT_OF_TIME"


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_a_bad_case_is_an_error_in_other_processes(model, sim, start):
    expected = copy.copy(sim).record(1e-3, 0.25e-3)
    processes = multiprocessing.get_context(start)
    with processes.Pool(1) as pool:
        cases = pool.map_async(cagedyn.Model.from_json, [model.scene, {"schema": "cagedyn.scene/1"}])
        with pytest.raises(cagedyn.Error, match="missing field"):
            cases.get(LONG)
        good = pool.apply_async(cagedyn.Model.from_json, (model.scene, {"rollers.count": 6})).get(LONG)
        assert len(good.contacts) == 24
        assert np.array_equal(pool.apply_async(cagedyn.Sim.record, (sim, 1e-3, 0.25e-3)).get(LONG), expected)
    with ProcessPoolExecutor(1, mp_context=processes) as pool:
        with pytest.raises(cagedyn.Error, match="before the current time") as failure:
            pool.submit(cagedyn.Sim.advance_to, sim, 0.1e-3).result(LONG)
        assert failure.value.name == "ERR_BAD_VALUE"
        assert np.array_equal(pool.submit(cagedyn.Sim.record, sim, 1e-3, 0.25e-3).result(LONG), expected)
