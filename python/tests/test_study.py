"""Parameter studies over several processes."""

import importlib
import json
import math
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import cagedyn
import numpy as np
import pytest

pytest.importorskip("distributed")
pytest.importorskip("pyarrow")
pytest.importorskip("xarray")

import dask  # noqa: E402
import killed_study  # noqa: E402
import pyarrow.parquet  # noqa: E402
from cagedyn import study  # noqa: E402
from cagedyn.study import _build, _cluster, _store  # noqa: E402

SCENE = Path(__file__).parents[2] / "scenes" / "grease_guide.json"
SPEED, MASS = "inner_ring.speed.constant", "cage.mass"
SHORT = {"record.duration": 2e-3}


@pytest.fixture(scope="module")
def workers():
    """Two workers; a point that kills two of them one after another is given up."""
    with dask.config.set({"distributed.scheduler.allowed-failures": 1}), study.local(2) as client:
        yield client


def end(sim):
    """A function of a study."""
    sim.advance_to(2e-3)
    return {"y": sim.output("cage.y"), "steps": sim.statistics["steps"]}


def deadly(sim):
    """Kills its worker at one point."""
    if sim.model.scene["cage"]["mass"] == 0.03:
        os.kill(os.getpid(), signal.SIGKILL)
    return end(sim)


def stored(folder):
    return sorted(row["point"] for row in map(json.loads, (Path(folder) / "rows.jsonl").read_text().splitlines()))


def test_the_package_needs_no_dask():
    program = "import sys, cagedyn; sys.exit(any(name in sys.modules for name in ('dask', 'pyarrow', 'xarray')))"
    subprocess.run([sys.executable, "-c", program], check=True)


def test_grids_have_every_combination():
    points = study.grid({"a": np.array([1.0, 2.0]), "b": ["x", None, [1, 2]]})
    assert len(points) == 6 and points.shape == (2, 3)
    assert list(points)[:4] == [
        {"a": 1.0, "b": "x"},
        {"a": 1.0, "b": None},
        {"a": 1.0, "b": [1, 2]},
        {"a": 2.0, "b": "x"},
    ]
    assert type(points.rows[0][0]) is float


def test_hypercubes_have_one_point_in_every_layer():
    ranges = {"a": (2.0, 4.0), "b": (1.0, 1000.0, "log"), "c": ["x", "y"]}
    points = study.latin(ranges, 10, seed=7)
    a, b, c = zip(*points.rows)
    assert sorted(int(5.0 * (x - 2.0)) for x in a) == list(range(10))
    assert sorted(int(10.0 / 3.0 * math.log10(x)) for x in b) == list(range(10))
    assert sorted(c) == ["x"] * 5 + ["y"] * 5
    assert points == study.latin(ranges, 10, seed=7) != study.latin(ranges, 10, seed=8)


@pytest.mark.parametrize(
    "make, told",
    [
        (lambda: study.grid({}), "grid: no path is given"),
        (lambda: study.grid({"a": []}), "grid: a: has no values"),
        (lambda: study.grid({"a": "word"}), "grid: a: 'word' is no list of values"),
        (lambda: study.grid({"a": [1, 1.0]}), "grid: a: 1.0 is listed twice"),
        (lambda: study.grid({"a=b": [1]}), "grid: 'a=b' is no path"),
        (lambda: study.listed([]), "points: there are none"),
        (lambda: study.listed([3]), "points: number 0: 3 is no mapping"),
        (lambda: study.listed([{"a": 1}, {"b": 1}]), "points: number 1: has b, not a as the first point"),
        (lambda: study.listed([{"a": math.nan}]), "points: number 0: a: nan is no finite number"),
        (lambda: study.listed([{"a": 1j}]), "points: number 0: a: 1j is no finite number"),
        (lambda: study.listed([{"a": {1: 2}}]), "is no finite number, text, bool, None or list"),
        (lambda: study.latin({"a": (1.0, 2.0)}, 0), "latin: count 0 is not a whole number from 1 on"),
        (lambda: study.latin({"a": (1.0, 1.0)}, 3), r"latin: a: \(1.0, 1.0\) is no \(from, to\)"),
        (lambda: study.latin({"a": (-1.0, 1.0, "log")}, 3), "both ends must be above zero"),
    ],
)
def test_what_is_no_point_is_told(make, told):
    with pytest.raises(study.StudyError, match=told) as failure:
        make()
    assert "\n" not in str(failure.value)


def test_a_grid(workers, tmp_path):
    told = []
    points = study.grid({SPEED: [200.0, 300.0], MASS: [0.012, -1.0, 0.02]})
    results = study.run(SCENE, points, tmp_path, overrides=SHORT, client=workers, progress=told.append)
    found = results.dataset
    assert dict(found.sizes) == {SPEED: 2, MASS: 3} and list(found[MASS].values) == [0.012, -1.0, 0.02]
    assert found["complete"].values.tolist() == [[True, False, True]] * 2
    bad = found.sel({MASS: -1.0, SPEED: 300.0})
    assert str(bad["error code"].values) == "ERR_BAD_SCENE" and "cage.mass: -1.0 kg" in str(bad["error"].values)
    assert np.isnan(bad["cage.y mean"]) and not bad["trusted"]
    # The statistics are those of the records in the last third of the run.
    model = cagedyn.Model.from_file(SCENE, {**SHORT, SPEED: 300.0, MASS: 0.02})
    sim = cagedyn.Sim(model)
    radii = sim.record(2e-3, model.scene["record"]["interval"])["cage.whirl_radius"][14:]
    one = found.sel({MASS: 0.02, SPEED: 300.0})
    wanted = [radii.mean(), radii.std(), radii.min(), radii.max(), *np.percentile(radii, [5, 95])]
    names = [f"cage.whirl_radius {part}" for part in ("mean", "deviation", "min", "max", "5 %", "95 %")]
    assert [float(one[name]) for name in names] == pytest.approx(wanted, rel=1e-12)
    assert found["cage.whirl_radius mean"].attrs["units"] == "m" and bool(one["trusted"]) is sim.trusted
    assert (told[0].done, told[-1].points, told[-1].done, told[-1].failed) == (0, 6, 6, 2)
    table = pyarrow.parquet.read_table(tmp_path / "study.parquet")
    assert table["point"].to_pylist() == stored(tmp_path) == list(range(6)) and table.equals(results.table)
    assert table["trusted"].to_pylist()[1] is None


def test_same_bits_as_a_loop(workers, tmp_path):
    points = study.latin({SPEED: (200.0, 400.0), MASS: (0.01, 0.02)}, 20)
    found = study.run(SCENE, points, tmp_path, of_sim=end, client=workers).table.to_pylist()
    for row, point in zip(found, points, strict=True):
        alone = end(cagedyn.Sim(cagedyn.Model.from_file(SCENE, point)))
        assert (row["y"], row["steps"], row["simulated time [s]"]) == (alone["y"], alone["steps"], 2e-3)


def test_functions_of_models_and_their_failures(workers, tmp_path):
    def of_model(model):
        mass = model.scene["cage"]["mass"]
        return {"load": 1 / 0} if mass == 0.02 else {"load": "heavy"} if mass == 0.03 else {"mass": mass}

    points = [{MASS: mass} for mass in (0.01, 0.02, 0.03)]
    rows = study.run(SCENE, points, tmp_path, of_model=of_model, client=workers).table.to_pylist()
    assert rows[0]["mass"] == 0.01 and rows[0]["complete"] and rows[0]["trusted"] is None
    assert [row["error code"] for row in rows] == [None, "ZeroDivisionError", "TypeError"]
    assert "'heavy' for 'load'" in rows[2]["error"]


def test_functions_that_workers_cannot_have_are_told(workers, tmp_path, monkeypatch):
    (tmp_path / "of_the_driver.py").write_text("def f(sim):\n    return {}\n")
    monkeypatch.syspath_prepend(tmp_path)
    f = importlib.import_module("of_the_driver").f
    with pytest.raises(study.StudyError, match="a worker cannot run points: ModuleNotFoundError: .*of_the_driver"):
        study.run(SCENE, [{MASS: 0.01}], tmp_path / "a", of_sim=f, client=workers)
    lock = threading.Lock()
    with pytest.raises(study.StudyError, match="the function of the study cannot be sent: TypeError: .*lock"):
        study.run(SCENE, [{MASS: 0.01}], tmp_path / "b", of_sim=lambda sim: {"x": lock.locked()}, client=workers)


def test_outputs_that_are_named(workers, tmp_path):
    found = study.run(SCENE, [{MASS: 0.01}], tmp_path, overrides=SHORT, outputs=["cage.y"], client=workers).dataset
    assert [name for name in found if name.startswith("cage")] == [
        f"cage.y {part}" for part in ("mean", "deviation", "min", "max", "5 %", "95 %")
    ]
    assert dict(found.sizes) == {"point": 1} and found[MASS].values.tolist() == [0.01]


class Search:
    """An optimiser: halves its step where a point is no better. Asks for a pair of points at a time."""

    def __init__(self, seed=1):
        self.random, self.best, self.step, self.told = np.random.default_rng(seed), (math.inf, 0.02), 5e-3, []

    def ask(self):
        return [{MASS: self.best[1] + self.step * x} for x in self.random.uniform(-1.0, 1.0, 2)]

    def tell(self, point, result):
        self.told.append((point[MASS], result["y"], result["complete"]))
        if result["y"] < self.best[0]:
            self.best = result["y"], point[MASS]
        else:
            self.step *= 0.5


def test_optimisers_are_asked_and_told(workers, tmp_path):
    def search(optimiser, folder, count):
        study.optimise(SCENE, optimiser, tmp_path / folder, count=count, of_sim=end, client=workers)
        return optimiser.told

    at_once = search(Search(), "at once", 8)
    assert len(at_once) == 8 and all(complete for _, _, complete in at_once)
    # Going on, another one of the same seed is told what is known, and asks on from there.
    assert search(Search(), "in two", 4) == at_once[:4]
    assert search(Search(), "in two", 8) == at_once
    assert stored(tmp_path / "in two") == list(range(8))
    with pytest.raises(study.StudyError, match="as point 0, where the folder has .* the same seed"):
        search(Search(2), "in two", 8)


def test_optimisers_that_ask_ahead_are_told_in_order(workers, tmp_path):
    class Ahead:
        masses, calls = [0.01, 0.02, 0.03, 0.04, 0.05], []

        def ask(self):
            self.calls.append("ask")
            return {MASS: self.masses.pop(0)} if self.masses else None

        def tell(self, point, result):
            self.calls.append(point[MASS])

    one = Ahead()
    study.optimise(SCENE, one, tmp_path, count=9, ahead=3, of_sim=end, client=workers)
    assert one.calls == ["ask"] * 3 + [0.01, "ask", 0.02, "ask", 0.03, "ask", 0.04, 0.05]


def test_going_on(workers, tmp_path):
    class Stop(Exception):
        pass

    def stop(progress):
        if progress.done >= 3:
            raise Stop

    points = study.grid({MASS: np.linspace(0.01, 0.02, 12)})
    with pytest.raises(Stop):
        study.run(SCENE, points, tmp_path, overrides={"record.duration": 0.25}, client=workers, progress=stop)
    some = stored(tmp_path)
    assert 3 <= len(some) < 12 and study.read(tmp_path).table["point"].to_pylist() == some
    assert study.read(tmp_path).dataset["complete"].values.sum() == len(some)
    with (tmp_path / "rows.jsonl").open("a") as log:
        log.write('{"point": 11, "val')  # What a loss of power may leave.
    told = []
    again = study.run(
        SCENE, points, tmp_path, overrides={"record.duration": 0.25}, client=workers, progress=told.append
    )
    assert told[0].done == len(some) and stored(tmp_path) == list(range(12))
    # What is done needs no workers.
    same = study.run(SCENE, points, tmp_path, overrides={"record.duration": 0.25}, client="tcp://127.0.0.1:1")
    assert same.table.equals(again.table)


def test_folders_of_others_are_refused(workers, tmp_path):
    folder, points = tmp_path / "study", study.grid({MASS: [0.01, 0.02]})

    def run(scene=SCENE, points=points, **others):
        study.run(scene, points, folder, **{"of_sim": end, "client": workers} | others)

    run()
    scene = json.loads(SCENE.read_text())
    run(scene)  # The same one, by what it holds.
    refused = [
        (lambda: run({**scene, "title": "other"}), "the scene differs"),
        (lambda: run(points=study.grid({MASS: [0.01, 0.03]})), r"point 1 was \[0.02\], is \[0.03\]"),
        (lambda: run(points=study.grid({MASS: [0.01]})), "points: 2 before, 1 now|shape was"),
        (lambda: run(of_sim=deadly), "the function differs"),
        (lambda: run(overrides=SHORT), "overrides was {}, is"),
        (lambda: run(of_sim=None, outputs=["cage.y"]), "outputs was null|the function differs"),
    ]
    for name in ("build", "version"):
        other = json.dumps({**json.loads((folder / "study.json").read_text()), name: "0.0.9"})
        refused.append(
            (lambda other=other: ((folder / "study.json").write_text(other), run()), f'{name} was "?0.0.9"?')
        )
    for attempt, told in refused:
        with pytest.raises(study.StudyError, match=f"has another study .*({told})") as failure:
            attempt()
        assert "\n" not in str(failure.value)
    (tmp_path / "study.parquet").touch()
    with pytest.raises(study.StudyError, match="study.parquet: is not of a study"):
        study.run(SCENE, points, tmp_path, of_sim=end, client=workers)
    with pytest.raises(study.StudyError, match="is not the folder of a study"):
        study.read(tmp_path)
    with (
        _store.Store(tmp_path / "busy", {"schema": "x"}),
        pytest.raises(study.StudyError, match="another study is writing"),
    ):
        study.run(SCENE, points, tmp_path / "busy", of_sim=end, client=workers)


def test_damaged_rows_are_told(workers, tmp_path):
    points = study.grid({MASS: [0.01, 0.02]})
    study.run(SCENE, points, tmp_path, of_sim=end, client=workers)
    lines = (tmp_path / "rows.jsonl").read_text().splitlines(keepends=True)
    for damaged in (lines + lines[:1], ["{\n", *lines]):
        (tmp_path / "rows.jsonl").write_text("".join(damaged))
        with pytest.raises(study.StudyError, match="rows.jsonl: line [13] is damaged"):
            study.run(SCENE, points, tmp_path, of_sim=end, client=workers)


@pytest.mark.parametrize(
    "points, options, told",
    [
        ([{"cage.masss": 1.0}], {}, "cage.masss: unknown field `masss`"),
        ([{"cage.guide.ring": "outer_ring"}, {"cage.guide.ring": "rim"}], {}, "unknown variant `rim`"),
        (
            [{MASS: -1.0}, {MASS: -2.0}],
            {},
            "no point can be simulated; point 0 .cage.mass = -1.0.: cage.mass: -1.0 kg",
        ),
        ([{MASS: 0.1}], {"overrides": {MASS: 0.1}}, "points: cage.mass is what overrides replace, too"),
        ([{MASS: 0.1}], {"outputs": ["cage.yy"]}, "outputs: there is no 'cage.yy' among the .* names"),
        ([{MASS: 0.1}], {"outputs": ["cage.y"], "of_sim": end}, "outputs: cannot be used with of_sim"),
        ([{MASS: 0.1}], {"of_sim": math.sqrt}, "of_sim: .* must be a function whose source text is in a file"),
        (
            [{MASS: 0.1}],
            {"client": "tcp://127.0.0.1:1"},
            "there is no scheduler at 'tcp://127.0.0.1:1' within 0.5 s",
        ),
        ([{MASS: 0.1}], {"client": "what://"}, "client: 'what://' is no address"),
        ([{MASS: 0.1}], {"client": 3}, "client: 3 is no address"),
    ],
)
def test_what_cannot_be_run_is_told(tmp_path, points, options, told):
    with pytest.raises((study.StudyError, cagedyn.Error), match=told) as failure:
        study.run(SCENE, points, tmp_path, timeout=0.5, **options)
    assert "\n" not in str(failure.value)
    assert not (tmp_path / "rows.jsonl").exists() or stored(tmp_path) == []


def test_schedulers_by_address(workers, tmp_path):
    found = study.run(SCENE, [{MASS: 0.01}], tmp_path, of_sim=end, client=workers.scheduler.address).dataset
    assert found["complete"].values.tolist() == [True] and workers.status == "running"


def test_workers_with_another_build_are_refused(workers, tmp_path, monkeypatch):
    address = next(iter(workers.nthreads()))

    def other(text):
        _build.build.cache_clear()
        os.environ["CAGEDYN_LIBRARY"] = text

    library = os.environ.get("CAGEDYN_LIBRARY") or cagedyn._native._path()
    copy = tmp_path / "libother.so"
    copy.write_bytes(Path(library).read_bytes() + b"\0")
    workers.run(other, str(copy), workers=[address])
    points = study.grid({MASS: np.linspace(0.01, 0.02, 50)})
    try:
        with pytest.raises(
            study.StudyError, match=f"client: the worker at {address} has the library .*, not "
        ) as failure:
            study.run(SCENE, points, tmp_path / "study", of_sim=end, client=workers)
        assert "\n" not in str(failure.value)
        # One that comes when the study runs already sees it itself.
        monkeypatch.setattr(_cluster, "_check_builds", lambda client: None)
        workers.run(other, str(copy))
        with pytest.raises(study.StudyError, match="client: a worker has the library .* points are kept"):
            study.run(SCENE, points, tmp_path / "study", of_sim=end, client=workers)
    finally:
        workers.run(other, library)


def test_a_worker_that_dies_loses_nothing(workers, tmp_path):
    pids = list(workers.run(os.getpid).values())

    def kill(progress):
        if progress.done >= 5 and len(pids) == 2:
            os.kill(pids.pop(), signal.SIGKILL)

    points = study.grid({MASS: np.linspace(0.01, 0.02, 60)})
    overrides = {"record.duration": 0.03}
    found = study.run(SCENE, points, tmp_path, overrides=overrides, client=workers, progress=kill)
    assert len(pids) == 1 and stored(tmp_path) == list(range(60))
    assert found.dataset["complete"].values.all()


def test_a_point_that_kills_its_workers_is_a_row(workers, tmp_path):
    points = [{MASS: mass} for mass in (0.01, 0.02, 0.03, 0.04, 0.05)]
    rows = study.run(SCENE, points, tmp_path, of_sim=deadly, client=workers).table.to_pylist()
    assert [row["error code"] for row in rows] == [None, None, "KilledPoint", None, None]
    assert rows[2]["error"] == "2 workers died, one after another, that ran this point alone"


def test_a_program_that_is_killed_twice_goes_on(tmp_path):
    killed_study.killed_twice(tmp_path, 60)
    killed_study.check(tmp_path, 60)


def test_a_lost_scheduler_costs_nothing_that_was_done(tmp_path):
    with study.local(1) as client:
        closing = threading.Thread(target=client.cluster.close)

        def close(progress):
            if progress.done >= 2 and closing.ident is None:
                closing.start()

        points = study.grid({MASS: np.linspace(0.01, 0.02, 200)})
        with pytest.raises(study.StudyError, match="client: .* of 200 points are kept, and the same call goes on"):
            study.run(SCENE, points, tmp_path, overrides={"record.duration": 0.1}, client=client, progress=close)
    assert 2 <= len(stored(tmp_path)) < 200
