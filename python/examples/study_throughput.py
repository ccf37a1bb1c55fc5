"""Throughput of a study on two workers beside the command `sweep --jobs 2` at the same points, one after the other.

python study_throughput.py TOOL [POINTS] [ROUNDS]
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

from cagedyn import study
from distributed import Client

SCENE = Path(__file__).parents[2] / "scenes" / "grease_guide.json"
PATH, FROM, TO = "inner_ring.speed.constant", 200.0, 400.0

#: A point takes some 0.1 s.
DURATION = 0.25


def of_tool(tool: str, count: int, folder: Path) -> float:
    """Wall time of the sweep, s."""
    began = time.perf_counter()
    vary, length = f"{PATH}={FROM}:{TO}:{count}", f"record.duration={DURATION}"
    options = ["--vary", vary, "--set", length, "--jobs", "2", "--out", str(folder)]
    subprocess.run([tool, "sweep", str(SCENE), *options], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def of_study(client: Client, count: int, folder: Path) -> float:
    """Wall time of the study, s."""
    began = time.perf_counter()
    points = study.grid({PATH: [FROM + (TO - FROM) * i / (count - 1) for i in range(count)]})
    results = study.run(SCENE, points, folder, overrides={"record.duration": DURATION}, client=client)
    assert all(results.dataset["complete"])
    return time.perf_counter() - began


def main() -> None:
    tool, *numbers = sys.argv[1:]
    count, rounds = (int(text) for text in (numbers + ["200", "3"][len(numbers) :]))
    began = time.perf_counter()
    swept, studied = [], []
    with study.local(2) as client:
        print(f"two workers start in {time.perf_counter() - began:.1f} s")
        for _ in range(rounds):
            with tempfile.TemporaryDirectory() as folder:
                swept.append(count / of_tool(tool, count, Path(folder, "sweep")))
                studied.append(count / of_study(client, count, Path(folder, "study")))
            ratio = studied[-1] / swept[-1]
            print(f"{count} points: sweep {swept[-1]:.2f}/s, study {studied[-1]:.2f}/s, ratio {ratio:.3f}", flush=True)
    best = max(studied) / max(swept)
    print(f"best of {rounds}: sweep {max(swept):.2f}/s, study {max(studied):.2f}/s, ratio {best:.3f}")


if __name__ == "__main__":
    main()
