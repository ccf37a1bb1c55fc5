"""The Python package: numbers of the library, names, errors, interruption, batches."""

import _thread
import math
import threading
from pathlib import Path

import cagedyn
import numpy as np
import pytest

SCENES = Path(__file__).parents[2] / "scenes"


@pytest.fixture(scope="module")
def model():
    return cagedyn.Model.from_file(SCENES / "nu2310.json")


@pytest.fixture
def sim(model):
    return cagedyn.Sim(model)


def test_names(model):
    assert model.states[2] == "cage.y" and model.states.units[2] == "m"
    assert model.states.index("cage.y") == 2 and "cage.y" in model.states and "wheel" not in model.states
    assert len(model.states) == model.position_count + model.velocity_count == 70
    assert all(len(names.descriptions) == len(names) for names in (model.states, model.inputs, model.outputs))
    assert model.geometry["element_radius"] == 7.5e-3
    assert model.warnings == [] and model.scene["rollers"]["count"] == 12
    with pytest.raises(KeyError, match="nearest is 'cage.y'"):
        model.states.index("cage.yy")


def test_scenes_and_overrides(model):
    small = cagedyn.Model.from_json(model.scene, {"rollers.count": 6, "cage.guide": None})
    assert len(small.contacts) == 24 and "guide.moment" not in small.outputs
    assert cagedyn.Model.from_json(small.scene).scene == small.scene
    with pytest.raises(cagedyn.Error, match="rollers.size") as failure:
        cagedyn.Model.from_json(model.scene, {"rollers.size": 6})
    assert failure.value.name == "ERR_BAD_JSON" and failure.value.status < 0
    with pytest.raises(OSError):
        cagedyn.Model.from_file("no such file")


def test_numpy_in_scenes_and_overrides(model):
    scene = model.scene
    plain = cagedyn.Model.from_json(
        scene, {"rollers.count": 6, "rollers.radius_deviations": {"each": [0.0, 1e-6, 0.0, 0.0, 0.0, 0.0]}}
    )
    scene["rollers"]["count"] = np.array(6)
    for each in (np.eye(6)[1] * 1e-6, [0, np.float64(1e-6), np.int8(0), np.uint16(0), 0, np.array(0)]):
        for count in (np.int64(6), np.float32(6).astype(int)):
            made = cagedyn.Model.from_json(
                scene, {"rollers.count": count, "rollers.radius_deviations": {"each": each}}
            )
            assert made.scene == plain.scene
    with pytest.raises(TypeError, match="nothing that JSON has"):
        cagedyn.Model.from_json(scene, {"rollers.count": {6}})


def test_what_is_shown(model, sim):
    assert repr(model) == f"Model({model.scene['title']!r}: 70 states, 3 inputs, {len(model.outputs)} outputs, 48 contacts)"
    sim.advance_to(0.25e-3)
    assert repr(sim) == f"Sim({model!r} at 0.00025 s)" and "'load.z': -4900.0" in repr(sim.inputs)
    with pytest.raises(cagedyn.Error) as failure:
        sim.step(-1.0)
    assert repr(failure.value) == f"Error(ERR_BAD_VALUE, {str(failure.value)!r})"


def test_running_and_recording(model, sim):
    records = sim.record(until=2e-3, interval=0.5e-3)
    assert records.shape == (5,) and records["time"].tolist() == [0.0, 0.5e-3, 1e-3, 1.5e-3, 2e-3]
    assert records["cage.y_ratio"][-1] == sim.output("cage.y_ratio") == sim.outputs()["cage.y_ratio"]
    whole = cagedyn.Sim(model, preset="engineering")
    whole.advance_to(2e-3)
    assert np.array_equal(whole.state, sim.state)
    few = sim.record(2.25e-3, 1e-4, ["cage.slip"])
    assert few.dtype.names == ("time", "cage.slip") and few["time"][-1] == 2.25e-3 and len(few) == 4
    assert sim.trusted and sim.doubts == "" and "leapfrog" in sim.report
    assert sim.statistics["steps"] > 100 and sim.law_evaluations["outer_raceway"] > 100
    assert abs(sim.power_balance["relative_residual"]) < 1e-3


def test_state_inputs_and_saving(sim):
    sim.advance_to(1e-3)
    saved, state = sim.save(), sim.state
    assert set(sim.inputs) == {"inner_ring.speed", "load.y", "load.z"} and sim.inputs["load.z"] == -4900.0
    sim.inputs["load.z"] = -1000.0
    sim.step(1e-3)
    assert sim.inputs["load.z"] == -1000.0 and not np.array_equal(sim.state, state)
    del sim.inputs["load.z"]
    assert sim.inputs["load.z"] == -4900.0
    sim.restore(saved)
    assert sim.time == 1e-3 and np.array_equal(sim.state, state)
    state[2] += 1e-6
    sim.set_state(0.5, state)
    assert sim.trusted is None and "set the state" in sim.doubts
    assert sim.time == 0.5 and np.array_equal(sim.state, state)
    sim.reset()
    assert sim.time == 0.0


def test_own_integrators(model, sim):
    sim.advance_to(1e-3)
    t, x = sim.time, sim.state
    n, q = len(x), model.position_count
    rate, jacobian = sim.derivative(t, x), sim.jacobian(t, x)
    assert np.array_equal(rate[:q], x[q : 2 * q]) and np.array_equal(rate[q:], sim.accelerations())
    step = np.zeros(n)
    step[2] = 1e-9
    difference = (sim.derivative(t, x + step) - sim.derivative(t, x - step)) / 2e-9
    assert np.allclose(jacobian[:, 2], difference, rtol=1e-5, atol=1e-4 * np.abs(difference).max())
    pattern = model.jacobian_pattern()
    values, sparse = sim.sparse_jacobian(t, x, pattern), np.zeros((n, n))
    for k in range(n):
        entries = slice(pattern.indptr[k], pattern.indptr[k + 1])
        sparse[pattern.indices[entries], k] = values[entries]
    assert np.array_equal(sparse, jacobian)
    sim.linearize(t, x)
    sim.factorize(1e-6)
    assert np.allclose((np.eye(n) - 1e-6 * jacobian) @ sim.solve(rate), rate, rtol=1e-8)
    assert not sim.time_derivative(t, x).any()
    over_inputs = sim.input_jacobian(t, x)
    load = model.inputs.index("load.z")
    assert over_inputs.shape == (n, len(model.inputs)) and np.count_nonzero(over_inputs[:, load]) == 1
    by_states, by_inputs = sim.output_jacobian(t, x)
    assert by_states.shape == (len(model.outputs), n) and by_inputs.shape == (len(model.outputs), len(model.inputs))
    assert np.isclose(by_states[model.outputs.index("cage.y"), 2], 1.0) and sim.next_event(t) == np.inf
    assert sim.outputs_at(t, x)["cage.y"] == x[2] and sim.energies_at(t, x)["kinetic"] > 0.0


def test_forces(model, sim):
    sim.advance_to(1e-3)
    contacts, bodies = sim.contact_forces(), sim.body_forces()
    assert np.array_equal(contacts, sim.contact_forces_at(sim.time, sim.state))
    assert np.array_equal(bodies, sim.body_forces_at(sim.time, sim.state))
    ring, source = model.bodies.index("inner_ring"), model.force_sources.index("inner_raceway")
    inner = ["inner_raceway" in name for name in model.contacts]
    down = (contacts["normal_force"] * contacts["normal_z"])[inner].sum()
    assert bodies[ring, source, 1] == pytest.approx(down, rel=0.05)


def test_watching():
    model = cagedyn.Model.from_file(SCENES / "nu2310.json", {"record.extremes": ["guide.moment"]})
    sim = cagedyn.Sim(model)
    assert model.watched == ["guide.moment"]
    sim.begin_interval()
    sim.advance_to(1e-3)
    moment = sim.interval("guide.moment")
    assert moment.begin == 0.0 and moment.min <= moment.mean <= moment.max
    with pytest.raises(cagedyn.Error):
        sim.interval("cage.slip")


def test_errors(model, sim):
    for call in (
        lambda: sim.step(-1.0),
        lambda: sim.step(math.nan),
        lambda: sim.advance_to(math.inf),
        lambda: sim.set_state(0.0, [1.0]),
        lambda: sim.derivative(0.0, np.full(70, math.nan)),
        lambda: sim.restore([0.0]),
        lambda: sim.factorize(1.0),
    ):
        with pytest.raises(cagedyn.Error) as failure:
            call()
        assert str(failure.value) and failure.value.name.startswith("ERR_")
    with pytest.raises(ValueError, match="shape"):
        sim.set_state(0.0, sim.state.reshape(2, -1))
    with pytest.raises(ValueError):
        cagedyn.Sim(model, preset="best")
    sim.set_wall_time_limit(0.25)
    with pytest.raises(cagedyn.Error) as failure:
        sim.record(1e3, 1e-4, ["cage.y"])
    records = failure.value.records
    assert failure.value.name == "ERR_OUT_OF_TIME" and len(records) > 10
    assert records["time"][-1] == pytest.approx(1e-4 * (len(records) - 1))
    with pytest.raises(cagedyn.Error):
        sim.step(1e-4)
    sim.set_wall_time_limit(math.inf)
    sim.step(1e-4)


def test_progress(model, sim):
    seen = []
    sim.advance_to(1.0, lambda running: seen.append((running is sim, running.time, running.output("cage.y"))))
    times = [time for same, time, _ in seen if same]
    assert len(times) == len(seen) > 1 and times == sorted(times) and 0.0 < times[0] < times[-1] == 1.0
    whole = cagedyn.Sim(model)
    whole.advance_to(1.0)
    assert np.array_equal(whole.state, sim.state)
    seen.clear()
    records = sim.record(1.4, 1e-3, ["cage.y"], progress=lambda running: seen.append(running.time))
    assert 1 < len(seen) < 100 and seen[-1] == 1.4 and len(records) == 401


def test_what_progress_raises_stops_and_it_goes_on(model, sim):
    def enough(running):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        sim.advance_to(1e3, enough)
    with pytest.raises(RuntimeError, match="enough") as failure:
        sim.record(1e3, 1e-4, ["cage.y"], enough)
    records = failure.value.records
    assert records.dtype.names == ("time", "cage.y") and 0 < len(records) and records["time"][-1] <= sim.time < 1e3
    sim.step(1e-4)
    other = cagedyn.Sim(model)
    other.advance_to(sim.time)
    assert np.array_equal(sim.state, other.state)


def test_ctrl_c_stops_after_a_step_and_it_goes_on(model, sim):
    threading.Timer(0.3, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        sim.advance_to(1e3)
    reached = sim.time
    assert 0.0 < reached < 1e3
    sim.advance_to(reached + 1e-4)
    other = cagedyn.Sim(model)
    other.advance_to(reached + 1e-4)
    assert np.array_equal(sim.state, other.state)


def test_batch(model):
    def start(k):
        sim = cagedyn.Sim(model)
        sim.inputs["load.z"] = -4900.0 - 100.0 * k
        return sim

    alone = [start(k) for k in range(4)]
    for sim in alone:
        sim.advance_to(1e-3)
    for threads in (0, 1, 3):
        batch, seen = cagedyn.Batch(start(k) for k in range(4)), []
        assert batch.advance_to(1e-3, threads, seen.append) == [None] * 4
        assert all(np.array_equal(a.state, b.state) for a, b in zip(alone, batch.sims))
        assert batch.progress.arrived == 4 and batch.progress.share == 1.0
        batch.advance_to(0.3, threads, seen.append)
        assert seen and all(0.0 <= progress.share <= 1.0 for progress in seen)
    batch[1].set_wall_time_limit(0.0)
    failures = batch.advance_to(0.31, check=False)
    assert [failure is None for failure in failures] == [True, False, True, True]
    assert failures[1].name == "ERR_OUT_OF_TIME" and batch[0].time == 0.31
    with pytest.raises(cagedyn.BatchError, match="1 of 4 .* number 1: ") as failure:
        batch.advance_to(0.31)
    assert failure.value.name == "ERR_OUT_OF_TIME" and failure.value.failures[0] is None
    with pytest.raises(cagedyn.Error):
        cagedyn.Batch([batch[0]])
    with pytest.raises(ValueError):
        batch.advance_to(0.32, threads=-1)
    for refused in (math.nan, math.inf, 1e7):
        with pytest.raises(cagedyn.Error, match="t: ") as failure:
            batch.advance_to(refused, check=False)
        assert failure.value.name == "ERR_BAD_VALUE"
    kept = batch[2]
    del batch
    assert kept.time == 0.31


def test_ctrl_c_stops_a_batch(model):
    batch = cagedyn.Batch(cagedyn.Sim(model) for _ in range(3))
    threading.Timer(0.3, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        batch.advance_to(1e3, 2)
    furthest = max(sim.time for sim in batch.sims)
    assert batch.advance_to(furthest + 1e-4) == [None] * 3
