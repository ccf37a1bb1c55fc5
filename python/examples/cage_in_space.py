"""A cage that tilts among balls: how far, where it is and how fast it turns, and the contact angles of a ball.

python cage_in_space.py [SCENE.json]
"""

import math
import sys

import cagedyn

scene = sys.argv[1] if len(sys.argv) > 1 else "scenes/angular_contact_70_cage.json"
sim = cagedyn.Sim(cagedyn.Model.from_file(scene))
for step in range(5):
    sim.advance_to(5e-3 * step)
    tilt, off, speed = (sim.output(f"cage.{name}") for name in ("tilt", "eccentricity", "speed"))
    inner, outer = (math.degrees(sim.output(f"ball[0].{race}_angle")) for race in ("inner", "outer"))
    print(
        f"{5.0 * step:3.0f} ms: cage tilts by {1e3 * tilt:.3f} mrad, is off by {off:.3f} of its clearance, "
        f"turns at {speed:.2f} rad/s; ball 0 at {inner:.2f} and {outer:.2f} deg"
    )
print("the run kept its power balance" if sim.trusted else sim.doubts)
