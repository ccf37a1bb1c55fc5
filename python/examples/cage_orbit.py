"""Orbit of the cage centre in its guide clearance: runs a scene and draws it with matplotlib.

python cage_orbit.py [SCENE.json] [PICTURE]
"""

import sys

import cagedyn
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

scene = sys.argv[1] if len(sys.argv) > 1 else "scenes/nu2310.json"
picture = sys.argv[2] if len(sys.argv) > 2 else "cage_orbit_python.png"

model = cagedyn.Model.from_file(scene)
sim = cagedyn.Sim(model)
records = sim.record(until=0.04, interval=0.1e-3, outputs=["cage.y_ratio", "cage.z_ratio"])
y, z = records["cage.y_ratio"], records["cage.z_ratio"]
print(f"cage centre after 40 ms: ({y[-1]:.3f}, {z[-1]:.3f}) of the guide clearance")
print("trusted" if sim.trusted else sim.doubts)

figure, axes = plt.subplots(figsize=(5, 5))
axes.add_patch(plt.Circle((0, 0), 1, fill=False, color="grey"))
axes.plot(y, z, linewidth=1)
axes.plot(y[-1], z[-1], "o")
axes.set(xlim=(-1.05, 1.05), ylim=(-1.05, 1.05), aspect="equal")
axes.set(xlabel="y over the guide clearance", ylabel="z over the guide clearance", title=model.scene.get("title"))
figure.savefig(picture, dpi=120)
