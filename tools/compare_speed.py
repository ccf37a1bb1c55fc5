#!/usr/bin/env python3
"""Times two builds of the project in pairs.

    compare_speed.py before after [scene.json]

`before` and `after` are folders of checkouts that `cargo build --release --locked` was called in. Each runs the scene, its own
scenes/nu2310.json unless given, for its whole length: with `cagedyn run`, from the start of the process to its end, and with one
cagedyn_sim_advance_to() of the shared library. Printed is the time of `after` over that of `before`, median of 21 pairs.
"""

import ctypes as c
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

PAIRS = 21


def tool(root, scene, out):
    started = time.perf_counter()
    subprocess.run([root / "target/release/cagedyn", "run", scene, "--out", out], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return time.perf_counter() - started


def advance(library, scene):
    text = scene.read_bytes()
    model = c.c_void_p(library.cagedyn_model_from_json(text))
    sim = c.c_void_p(library.cagedyn_sim_new(model))
    if not sim:
        raise SystemExit(c.string_at(library.cagedyn_error_message()).decode())
    end = c.c_double(json.loads(text)["record"]["duration"])
    started = time.perf_counter()
    status = library.cagedyn_sim_advance_to(sim, end)
    elapsed = time.perf_counter() - started
    library.cagedyn_sim_free(sim)
    library.cagedyn_model_free(model)
    if status != 0:
        raise SystemExit(f"cagedyn_sim_advance_to: {status}")
    return elapsed


def load(root):
    library = c.CDLL(str(root / "target/release/libcagedyn.so"))
    for name in ("model_from_json", "sim_new", "error_message"):
        getattr(library, "cagedyn_" + name).restype = c.c_void_p
    return library


def main():
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__)
    roots = [pathlib.Path(path).resolve() for path in sys.argv[1:3]]
    scenes = [pathlib.Path(sys.argv[3]) if len(sys.argv) == 4 else root / "scenes/nu2310.json" for root in roots]
    libraries = [load(root) for root in roots]
    with tempfile.TemporaryDirectory() as out:
        ways = {
            "cagedyn run": lambda i: tool(roots[i], scenes[i], out),
            "one cagedyn_sim_advance_to()": lambda i: advance(libraries[i], scenes[i]),
        }
        for name, way in ways.items():
            way(0), way(1)
            pairs = [(way(0), way(1)) for _ in range(PAIRS)]
            before, after = (statistics.median(times) for times in zip(*pairs))
            ratio = statistics.median(b / a for a, b in pairs)
            print(f"{name}: {ratio:.2f}, {after:.3f} s over {before:.3f} s")


if __name__ == "__main__":
    main()
