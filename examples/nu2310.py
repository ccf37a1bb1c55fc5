"""A cylindrical roller bearing from Python: read a scene, run it, print where the cage is."""

import sys

import cagedyn

model = cagedyn.Model.from_file(sys.argv[1] if len(sys.argv) > 1 else "scenes/nu2310.json")
sim = cagedyn.Sim(model)
for record in sim.record(until=0.02, interval=5e-3, outputs=["cage.y_ratio", "cage.z_ratio"]):
    time, y, z = record
    print(f"{1e3 * time:5.1f} ms: cage centre ({y:.3f}, {z:.3f}) of the guide clearance")
print("the run kept its power balance" if sim.trusted else sim.doubts)
