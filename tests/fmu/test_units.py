"""Units of both versions, validated and run by FMPy, beside the library itself."""

from __future__ import annotations

import ctypes
import json
import os
import random

import cagedyn
import fmpy
import numpy as np
import pytest
from conftest import ROOT, Units, moved
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from slave import Unit

VERSIONS = ["2.0", "3.0"]
SCENES = [
    "nu2310",
    "nu2310_heat",
    "nu2310_space",
    "grease_guide",
    "grease_guide_elastic",
    "deep_groove_6206",
    "angular_contact_70_cage",
    "full_complement",
    "tapered_32210",
]


def sim_of(scene: str, **changes: object) -> cagedyn.Sim:
    data = json.loads((ROOT / "scenes" / f"{scene}.json").read_text())
    for path, value in changes.items():
        block, name = path.split("__")
        data[block][name] = value
    return cagedyn.Sim(cagedyn.Model.from_json(json.dumps(data)))


@pytest.mark.parametrize("fmi", VERSIONS)
@pytest.mark.parametrize("scene", SCENES)
def test_validated_without_a_word(units: Units, scene: str, fmi: str) -> None:
    assert validate_fmu(units.make(scene, fmi)) == []


@pytest.mark.parametrize("fmi", VERSIONS)
@pytest.mark.parametrize("scene", ["nu2310", "grease_guide", "deep_groove_6206"])
def test_co_simulation_has_the_bits_of_the_library(units: Units, scene: str, fmi: str) -> None:
    sim = sim_of(scene)
    with Unit(units.make(scene, fmi)) as unit:
        names = [name for name in unit.names("output") if name in sim.model.outputs]
        assert len(names) > 20
        t, h = 0.0, 1e-4
        for i in range(10):
            unit.step(t, h)
            t += h
            sim.advance_to(t)
            if i == 4:
                unit.set(["inner_ring.speed"], [-200.0])
                sim.inputs["inner_ring.speed"] = -200.0
            ours, values = sim.outputs(), unit.get(names)
            assert [ours[name] for name in names] == values
            assert unit.get(["time", "inner_ring.speed"]) == [t, -200.0 if i >= 4 else sim.inputs["inner_ring.speed"]]


@pytest.mark.parametrize("fmi", VERSIONS)
def test_simulated_by_fmpy_both_ways(units: Units, fmi: str) -> None:
    start = 'initial={"cage": {"y": 1e-5, "z": -3e-5}}'
    path = units.make("grease_guide", fmi, 'solver={"preset": "reference"}', start)
    output = ["cage.y", "cage.z", "cage.speed"]
    common = {"stop_time": 2e-3, "output": output, "output_interval": 1e-4}
    run = fmpy.simulate_fmu(path, fmi_type="CoSimulation", **common)
    exchange = fmpy.simulate_fmu(path, fmi_type="ModelExchange", relative_tolerance=1e-9, **common)
    for name in output:
        size = np.abs(run[name]).max()
        assert np.abs(run[name] - exchange[name]).max() < 1e-6 * size, name
    assert len(run) == 21


@pytest.mark.parametrize("exchange", [False, True])
@pytest.mark.parametrize("fmi", VERSIONS)
def test_rollback_gives_the_same_bits(units: Units, fmi: str, exchange: bool) -> None:
    """Random sequences of getting, setting, stepping, saving, serializing and going back."""
    sequences = 250
    rng = random.Random(7)
    path = units.make("nu2310", fmi, moved(1e-6, -26e-6))
    with Unit(path, exchange) as unit, Unit(path, exchange) as other:
        outputs = unit.names("output")
        n = len([name for name in unit.references if name.startswith("state.")])
        if exchange:
            unit.begin_continuous()
            other.begin_continuous()
        state = {"t": 0.0}

        def go_on(of: Unit, seed: int) -> list[float]:
            """Some random calls, and what they come to."""
            draw = random.Random(seed)
            t = state["t"]
            for _ in range(draw.randint(1, 3)):
                if draw.random() < 0.5:
                    of.set(["inner_ring.vz"], [draw.uniform(-1e-3, 1e-3)])
                if draw.random() < 0.5:
                    of.set(["inner_ring.speed"], [draw.uniform(-330.0, -300.0)])
                h = draw.choice([1e-6, 7e-6, 2e-5])
                if exchange:
                    values = (ctypes.c_double * n)()
                    rates = (ctypes.c_double * n)()
                    of.fmu.getContinuousStates(values, n)
                    (of.fmu.getContinuousStateDerivatives if of.three else of.fmu.getDerivatives)(rates, n)
                    for k in range(n):
                        values[k] += 1e-7 * rates[k]
                    of.fmu.setTime(t + 1e-7)
                    of.fmu.setContinuousStates(values, n)
                    of.fmu.completedIntegratorStep()
                    t += 1e-7
                else:
                    of.step(t, h)
                    t = of.get(["time"])[0]
            state["end"] = t
            return of.get(outputs) + of.get(["time", "inner_ring.speed", "inner_ring.z"])

        for i in range(sequences):
            kept = unit.fmu.getFMUState()
            if i % 3 == 0:
                data = unit.fmu.serializeFMUState(kept)
                unit.fmu.freeFMUState(kept)
                kept = unit.fmu.deserializeFMUState(data)
            first = go_on(unit, i)
            unit.fmu.setFMUState(kept)
            assert go_on(unit, i) == first, i
            if i % 10 == 0:
                # Another instance takes over from bytes.
                moved_over = other.fmu.deserializeFMUState(unit.fmu.serializeFMUState(kept))
                other.fmu.setFMUState(moved_over)
                assert go_on(other, i) == first, i
                other.fmu.freeFMUState(moved_over)
            if rng.random() < 0.4:
                unit.fmu.setFMUState(kept)
            else:
                state["t"] = state["end"]
            unit.fmu.freeFMUState(kept)


@pytest.mark.parametrize("fmi", VERSIONS)
def test_directional_derivatives_are_differences(units: Units, fmi: str) -> None:
    with Unit(units.make("nu2310", fmi, moved(1e-6, -26e-6)), exchange=True) as unit:
        unit.begin_continuous()
        states = [name for name in unit.references if name.startswith("state.")]
        rates = [f"der({name})" for name in states]
        n = len(states)
        here = (ctypes.c_double * n)()
        unit.fmu.getContinuousStates(here, n)
        start = list(here)

        def at(step: float, seed: list[float], along: list[str]) -> list[float]:
            moved_to = (ctypes.c_double * n)(*start)
            for name, size in zip(along, seed):
                if name in states:
                    moved_to[states.index(name)] += step * size
            unit.fmu.setContinuousStates(moved_to, n)
            inputs = [(name, size) for name, size in zip(along, seed) if name not in states]
            before = unit.get([name for name, _ in inputs])
            unit.set([name for name, _ in inputs], [x + step * size for x, (_, size) in zip(before, inputs)])
            found = unit.get(rates + ["inner_ring.force_z"])
            unit.set([name for name, _ in inputs], before)
            return found

        for along, seed in [(["state.roller[2].radial_offset"], [1e-9]), (["inner_ring.speed"], [1e-3]), (["inner_ring.z"], [1e-10])]:
            references = [unit.references[name] for name in rates + ["inner_ring.force_z"]]
            exact = unit.fmu.getDirectionalDerivative(references, [unit.references[name] for name in along], seed)
            ahead, behind = at(1.0, seed, along), at(-1.0, seed, along)
            difference = [(a - b) / 2 for a, b in zip(ahead, behind)]
            size = max(abs(x) for x in difference)
            assert size > 0
            assert max(abs(a - b) for a, b in zip(exact, difference)) < 2e-4 * size, along


def test_a_time_event_is_a_kink_of_the_scene(units: Units) -> None:
    ramp = 'inner_ring.speed={"ramp": {"from": -100, "to": -300, "start": 1e-3, "end": 2e-3}}'
    with Unit(units.make("grease_guide", "3.0", ramp), exchange=True) as unit:
        *_, defined, event = unit.fmu.updateDiscreteStates()
        assert (defined, event) == (True, 1e-3)
        unit.fmu.enterContinuousTimeMode()
        unit.fmu.setTime(1.5e-3)
        assert unit.get(["inner_ring.speed"]) == pytest.approx([-200.0])


@pytest.mark.parametrize("fmi", VERSIONS)
def test_parameters_are_numbers_of_the_scene(units: Units, fmi: str) -> None:
    name = "scene.inner_ring.radial_clearance"
    with Unit(units.make("nu2310", fmi), start={name: 5e-6}) as unit:
        sim = sim_of("nu2310", inner_ring__radial_clearance=5e-6)
        unit.step(0.0, 1e-3)
        sim.advance_to(1e-3)
        assert unit.get([name, "cage.y"]) == [5e-6, sim.output("cage.y")]
        # Whole numbers are the structure of a unit.
        assert not any(name.endswith((".count", ".order")) for name in unit.names("parameter"))


@pytest.mark.parametrize("fmi", VERSIONS)
def test_what_is_wrong_is_refused_in_one_line(units: Units, fmi: str, capfd: pytest.CaptureFixture[str]) -> None:
    path = units.make("nu2310", fmi, moved(1e-6, -26e-6))

    def refused(call: object, *words: str) -> None:
        capfd.readouterr()
        with pytest.raises((FMICallException, Exception)):
            call()  # type: ignore[operator]
        out = "".join(capfd.readouterr())
        lines = [line for line in out.splitlines() if "fmi" in line or "instantiation" in line]
        assert len(lines) == 1, out
        for word in words:
            assert word in lines[0], out

    refused(lambda: Unit(path, token="0"), "instantiationToken", "another build")
    with Unit(path, run=False) as unit:
        real = unit.fmu.getFloat64 if unit.three else unit.fmu.getReal
        refused(lambda: real([99999]), "99999", "0 to")
        refused(lambda: unit.step(0.0, 1e-4), "Instantiated", "Step")
        refused(lambda: unit.set(["inner_ring.speed"], [float("nan")]), "inner_ring.speed", "finite")
        refused(lambda: unit.set(["cage.y"], [0.0]), "cage.y", "follows")
        unit.set(["scene.inner_ring.radial_clearance"], [0.5])
        refused(unit.initialize, "inner_ring.radial_clearance", "0.5")
    with Unit(path) as unit:
        refused(lambda: unit.set(["inner_ring.z"], [0.02]), "inner_ring.z", "0.02")
        refused(lambda: unit.set(["inner_ring.z"], [-5e-3]), "inner_ring.z")
        refused(lambda: unit.step(0.5, 1e-4), "0.5", "not the time")
        refused(lambda: unit.step(0.0, -1.0), "communicationStepSize", "-1.0")
        refused(lambda: unit.set(["scene.rollers.radius"], [7e-3]), "scene.rollers.radius", "fixed")
        refused(lambda: unit.fmu.deserializeFMUState(b"12345678"), "serializedState")
        whole = unit.fmu.getInt32 if unit.three else unit.fmu.getInteger
        refused(lambda: whole([3]), "real numbers")
        before = unit.get(["cage.y", "inner_ring.z"])
        unit.step(0.0, 1e-4)
        assert before != unit.get(["cage.y", "inner_ring.z"])


def test_rotor_and_bearing_are_one(units: Units) -> None:
    """A rotor that the importer integrates, with the bearing as a unit, beside both in one simulation."""
    mass, damping, load, unbalance, speed = 3.0, 2e3, -4900.0, 4e-3, -314.0
    h, duration = 5e-8, 4e-4
    free = {
        "mass": mass,
        "support_damping": damping,
        "load": {"y": {"constant": 0.0}, "z": {"constant": load}},
        "unbalance": {"moment": unbalance},
    }
    data = json.loads((ROOT / "scenes/nu2310.json").read_text())
    data["inner_ring"].update(motion={"free": free}, speed={"constant": speed})
    data.update(gravity=None, solver={"preset": "reference"})
    whole = cagedyn.Sim(cagedyn.Model.from_json(json.dumps(data)))
    places, rates = ["inner_ring.y", "inner_ring.z"], ["inner_ring.vy", "inner_ring.vz"]
    x = np.array([whole.output(name) for name in places])
    sets = ["gravity=null", 'solver={"preset": "reference"}', f"inner_ring.speed={speed}", moved(*x)]
    unit = Unit(units.make("nu2310", "3.0", *sets))
    force = ["inner_ring.force_y", "inner_ring.force_z"]
    v, t, worst = np.zeros(2), 0.0, 0.0

    def acceleration() -> np.ndarray:
        turning = unbalance * speed**2 * np.array([np.cos(speed * t), np.sin(speed * t)])
        return (np.array(unit.get(force)) + [0.0, load] + turning - damping * v) / mass

    a = acceleration()
    for n in range(round(duration / h)):
        half = v + 0.5 * h * a
        unit.set(rates, list(half))
        unit.step(t, h)
        t = unit.get(["time"])[0]
        for _ in range(2):
            v = half + 0.5 * h * a
            unit.set(rates, list(v))
            a = acceleration()
        v = half + 0.5 * h * a
        if n % 100 == 99:
            x = np.array(unit.get(places))
            whole.advance_to(t)
            worst = max(worst, float(np.abs(x - [whole.output(name) for name in places]).max()))
    unit.close()
    size = float(np.abs(x).max())
    print(f"rotor by unit and in one: {worst:.1e} m apart of {size:.1e} m")
    assert size > 1e-6
    assert worst < 1e-6 * size


def test_nothing_is_no_instance(units: Units, capfd: pytest.CaptureFixture[str]) -> None:
    """Every function of the standard is there, and NULL is an error, as instance and as array."""
    library = ctypes.CDLL(os.environ["CAGEDYN_LIBRARY"])
    names = (ROOT / "tests/fmu/functions.txt").read_text().split()
    for name in names:
        function = getattr(library, name)
        if "Version" in name or "TypesPlatform" in name:
            function.restype = ctypes.c_char_p
            assert function() in (b"2.0", b"3.0", b"default")
        elif "FreeInstance" in name:
            function(None)
        elif "Instantiate" in name:
            function.restype = ctypes.c_void_p
            assert function(*[None] * 12) is None
        else:
            assert function(*[None] * 12) == 3, name
    with Unit(units.make("grease_guide", "3.0")) as unit:
        instance = unit.fmu.component
        for name in ["fmi3GetFloat64", "fmi3SetFloat64", "fmi3GetInt32"]:
            assert getattr(library, name)(ctypes.c_void_p(instance), None, ctypes.c_size_t(1), None, ctypes.c_size_t(1)) == 3
        for name in ["fmi3GetContinuousStates", "fmi3GetNominalsOfContinuousStates"]:
            assert getattr(library, name)(ctypes.c_void_p(instance), None, ctypes.c_size_t(6)) == 3
            assert getattr(library, name)(ctypes.c_void_p(instance), None, ctypes.c_size_t(5)) == 3
        assert library.fmi3GetFMUState(ctypes.c_void_p(instance), None) == 3
        assert library.fmi3SetFMUState(ctypes.c_void_p(instance), None) == 3
    assert "is NULL" in "".join(capfd.readouterr())
