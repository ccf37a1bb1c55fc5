"""How speed and mass move a greased cage: a study over all cores, kept in a folder.

python study.py [FOLDER]

Run again it goes on where it was stopped, and at once when it is done.
"""

import sys
from pathlib import Path

from cagedyn import study

SCENE = Path(__file__).parents[2] / "scenes" / "grease_guide.json"


def main() -> None:
    folder = sys.argv[1] if len(sys.argv) > 1 else "out/study"
    points = study.grid({"inner_ring.speed.constant": [157.1, 314.2, 628.3], "cage.mass": [6e-3, 12e-3, 24e-3]})
    results = study.run(SCENE, points, folder, overrides={"record.duration": 0.05})
    found = results.dataset
    complete, trusted = (int(found[name].sum()) for name in ("complete", "trusted"))
    print(f"{complete} of {len(points)} points are complete, {trusted} to be trusted")
    for mass in found["cage.mass"].values:
        radii = found["cage.whirl_radius mean"].sel({"cage.mass": mass}).values
        print(
            f"{1e3 * mass:4.0f} g: mean whirl radius", ", ".join(f"{1e6 * radius:5.1f}" for radius in radii), "um"
        )


if __name__ == "__main__":  # Workers import this file.
    main()
