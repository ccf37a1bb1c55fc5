#!/usr/bin/env python3
"""Compares two builds of the shared library number by number.

    compare_builds.py before.so after.so scene.json...

For every scene it runs 2 ms with each method, and asks both libraries for everything that they know: states, outputs,
contact and body forces, works, counts, and at states around the run rates and exact derivatives. It prints what is not equal
to the last bit, and the largest difference as a share of the largest number of its kind. Outputs, powers, counts and forces that
only one of them has are left out.
"""

import ctypes as c
import json
import pathlib
import random
import struct
import sys

METHODS = [{"auto": {}}, {"leapfrog": {}}, {"dormand_prince": {"tolerance": 1e-5}}, {"rosenbrock": {"tolerance": 1e-5}}]
STATES = 40
SCALE = 1e-3


class Library:
    def __init__(self, path):
        self.c = c.CDLL(str(path))
        for name in ("model_from_json", "sim_new", "error_message", "sim_report", "model_warning"):
            getattr(self.c, "cagedyn_" + name).restype = c.c_void_p
        for name in ("model_state_count", "model_output_count", "model_contact_count", "model_body_count",
                     "model_contact_quantity_count", "model_force_source_count", "model_velocity_count",
                     "statistic_count", "law_count", "balance_count"):
            getattr(self.c, "cagedyn_" + name).restype = c.c_int64

    def count(self, name, *args):
        return getattr(self.c, "cagedyn_" + name)(*args)

    def names(self, name, n, *args):
        function = getattr(self.c, "cagedyn_" + name)
        function.restype = c.c_char_p
        return [function(*args, c.c_int64(i)) for i in range(n)]

    def numbers(self, name, sim, n):
        out = (c.c_double * n)()
        status = getattr(self.c, "cagedyn_" + name)(sim, out, c.c_int64(n))
        return [float(status), *out]

    def listed(self, kind):
        """Names of what every model has of a kind, in their order."""
        return self.names(kind + "_name", self.count(kind + "_count"))

    def of_scene(self, kind, scene):
        """Names of what a scene has of a kind."""
        model = c.c_void_p(self.c.cagedyn_model_from_json(json.dumps(scene).encode()))
        names = self.names(kind + "_name", self.count(kind + "_count", model), model) if model else []
        self.c.cagedyn_model_free(model)
        return names

    def message(self):
        return c.string_at(self.c.cagedyn_error_message())


def states_around(start, rng):
    """The state itself, and others with every number changed by up to a thousandth, and by 1 um or 1e-4 of any."""
    for i in range(STATES):
        spread = 0.0 if i == 0 else SCALE * 10 ** rng.uniform(-3, 0)
        yield [x * (1 + spread * rng.uniform(-1, 1)) + spread * 2e-4 * rng.uniform(-1, 1) for x in start]


def shared(numbers, names, known):
    """The status and the numbers of those names that are known, each of as many numbers as the list has for a name."""
    status, *values = numbers
    size = max(len(values) // max(len(names), 1), 1)
    kept = [i for i, name in enumerate(names) if name in known]
    return [status] + [x for i in kept for x in values[i * size:(i + 1) * size]]


def everything(lib, scene, states, known):
    """Lists of numbers by what they are. `states`: those to differentiate at, filled when empty; `known`: names by kind of what both
    libraries have."""
    model = c.c_void_p(lib.c.cagedyn_model_from_json(json.dumps(scene).encode()))
    if not model:
        return {"error": lib.message()}
    n = lib.count("model_state_count", model)
    outputs = lib.count("model_output_count", model)
    contacts = lib.count("model_contact_count", model) * lib.count("model_contact_quantity_count", model)
    bodies = lib.count("model_body_count", model) * lib.count("model_force_source_count", model) * 3
    output_names = lib.names("model_output_name", outputs, model)
    found = {
        "names": lib.names("model_state_name", n, model)
        + [pair for pair in zip(output_names, lib.names("model_output_description", outputs, model))
           if pair[0] in known["model_output"]]
        + lib.names("model_contact_name", lib.count("model_contact_count", model), model)
        + lib.names("model_body_name", lib.count("model_body_count", model), model)
    }
    sim = c.c_void_p(lib.c.cagedyn_sim_new(model))
    if not sim:
        return {**found, "error": lib.message()}
    put = lambda kind, values: found.setdefault(kind, []).extend(values)
    sources = lib.names("model_force_source_name", lib.count("model_force_source_count", model), model)

    def named(kind, function):
        return shared(lib.numbers(function, sim, lib.count(kind + "_count")), lib.listed(kind), known[kind])

    for step in range(1, 11):
        put("status", [lib.c.cagedyn_sim_advance_to(sim, c.c_double(2e-4 * step))])
        put("state", lib.numbers("sim_get_state", sim, n))
        put("outputs", shared(lib.numbers("sim_get_outputs", sim, outputs), output_names, known["model_output"]))
        put("contacts", lib.numbers("sim_contact_forces", sim, contacts))
        status, *values = lib.numbers("sim_body_forces", sim, bodies)
        of_body = 3 * len(sources)
        for first in range(0, len(values), of_body):
            put("bodies", shared([status, *values[first:first + of_body]], sources, known["model_force_source"]))
        put("works", named("balance", "sim_power_balance"))
    put("counts", named("statistic", "sim_statistics"))
    put("counts", named("law", "sim_law_evaluations"))
    found["report"] = [c.string_at(lib.c.cagedyn_sim_report(sim))]
    if not states:
        state = lib.numbers("sim_get_state", sim, n)[1:]
        states.extend(states_around(state, random.Random(1)))
    rate, jacobian = (c.c_double * n)(), (c.c_double * (n * n))()
    for k, state in enumerate(states):
        x = (c.c_double * n)(*state)
        t = c.c_double(2e-3 + 1e-5 * k)
        status = lib.c.cagedyn_sim_derivative(sim, t, x, rate, c.c_int64(n))
        put("rates", [float(status), *rate])
        if k % 4 == 0:
            status = lib.c.cagedyn_sim_jacobian(sim, t, x, c.c_int64(n), jacobian, c.c_int64(n * n))
            put("jacobian", [float(status), *jacobian])
    lib.c.cagedyn_sim_free(sim)
    lib.c.cagedyn_model_free(model)
    return found


def bits(x):
    """Of a number; a text is itself."""
    return struct.pack("d", x) if isinstance(x, float) else x


def difference(before, after):
    """None if equal to the bit, else the largest difference relative to the largest number."""
    if before == after or len(before) == len(after) and all(a == b or bits(a) == bits(b) for a, b in zip(before, after)):
        return None
    if len(before) != len(after) or not all(isinstance(x, float) for x in before):
        return float("inf")
    size = max((abs(x) for x in before if x == x), default=1.0) or 1.0
    gaps = [abs(a - b) / size for a, b in zip(before, after) if a != b and not (a != a and b != b)]
    return max(gaps, default=0.0)


def main():
    before, after = Library(sys.argv[1]), Library(sys.argv[2])
    known = {kind: {*before.listed(kind)} & {*after.listed(kind)} for kind in ("balance", "statistic", "law")}
    unequal = total = compared = 0
    for path in sys.argv[3:]:
        scene = json.loads(pathlib.Path(path).read_text())
        for kind in ("model_force_source", "model_output"):
            known[kind] = {*before.of_scene(kind, scene)} & {*after.of_scene(kind, scene)}
        for method in METHODS:
            scene["solver"] = {"method": method}
            states = []
            a, b = everything(before, scene, states, known), everything(after, scene, states, known)
            total += 1
            if "error" in a and "error" in b:
                raise SystemExit(f"{path} {method}: both refuse it: {a['error']}")
            apart = {kind: difference(a.get(kind, []), b.get(kind, [])) for kind in sorted({*a, *b})}
            compared += sum(len(x) for x in a.values())
            apart = {kind: gap for kind, gap in apart.items() if gap is not None}
            if apart:
                unequal += 1
                text = ", ".join(f"{kind} {gap:.1e}" for kind, gap in apart.items())
                print(f"{pathlib.Path(path).name} {method}: {text}", flush=True)
    print(f"{total} runs, {compared} numbers and texts compared; {unequal} runs differ")
    return 1 if unequal else 0


if __name__ == "__main__":
    sys.exit(main())
