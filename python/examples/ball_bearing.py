"""Balls that move in space: stiffness for a rotor code, then a run with a load that a host changes, and what the balls do.

python ball_bearing.py [SCENE.json]
"""

import math
import sys

import cagedyn

scene = sys.argv[1] if len(sys.argv) > 1 else "scenes/angular_contact_70.json"
model = cagedyn.Model.from_file(scene)

# Friction of the balls themselves decides where they spin.
found = cagedyn.Equilibrium(model, "friction")
along = ", ".join(f"{1e-6 * found.stiffness[k, k]:.2f}" for k in range(3))
print(f"equilibrium: x = {1e6 * found.displacement[0]:.3f} um; stiffness along x, y, z: {along} N/um")

sim = cagedyn.Sim(model)
for step in range(4):
    sim.advance_to(4e-3 * step)
    inner, outer = (math.degrees(sim.output(f"ball[0].{race}_angle")) for race in ("inner", "outer"))
    force, orbit = sim.output("ball[0].inner_force"), sim.output("balls.orbit_ratio")
    print(
        f"{4.0 * step:4.1f} ms: contact angles {inner:.2f} and {outer:.2f} deg, {force:.2f} N, orbit {orbit:.4f} of rolling, "
        f"x = {1e6 * sim.output('inner_ring.x'):.3f} um"
    )
    # From here on the machine presses harder.
    sim.inputs["load.x"] = 900.0
print("the run kept its power balance" if sim.trusted else sim.doubts)
