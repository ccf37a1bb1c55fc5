"""A study whose program is killed twice, each time with SIGKILL, and goes on: nothing is lost, nothing is there
twice, and all rows have the bits of a loop in one process.

python killed_study.py [POINTS]
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from cagedyn import study
from cagedyn.study._build import build
from cagedyn.study._row import Job, compute, flat

SCENE = Path(__file__).parents[2] / "scenes" / "grease_guide.json"
OVERRIDES = {"record.duration": 0.1}

#: What a study that hangs fails by, s.
LONG = 3600.0


def points(count: int) -> study.Points:
    """Points of which one in so many fails."""
    ranges = {"inner_ring.speed.constant": (200.0, 400.0), "cage.mass": [0.012, 0.024, 0.012, 0.024, -1.0]}
    return study.latin(ranges, count, seed=3)


def drive(folder: str, count: int) -> None:
    """The program that is killed."""
    with study.local(2) as client:
        study.run(SCENE, points(count), folder, overrides=OVERRIDES, client=client)


def kept(folder: Path) -> list[int]:
    """Numbers of the points that are in the folder."""
    path = folder / "rows.jsonl"
    lines = path.read_bytes().split(b"\n")[:-1] if path.exists() else []
    return [json.loads(line)["point"] for line in lines]


def killed_twice(folder: Path, count: int) -> None:
    """Runs the program until a third, two thirds and all of the points are there."""
    for third in (1, 2, 3):
        program = subprocess.Popen([sys.executable, __file__, str(folder), str(count)], stderr=subprocess.DEVNULL)
        until = time.monotonic() + LONG
        while third < 3 and len(kept(folder)) < third * count // 3:
            assert program.poll() is None and time.monotonic() < until, "the study ended before it was killed"
            time.sleep(0.005)
        if third < 3:
            os.kill(program.pid, signal.SIGKILL)
            program.wait()
            there = kept(folder)
            assert third * count // 3 <= len(there) < count, there
            print(f"killed with {len(there)} of {count} points")
        else:
            assert program.wait(LONG) == 0


def check(folder: Path, count: int) -> None:
    """Compares what is in the folder with a loop."""
    assert sorted(kept(folder)) == list(range(count))
    rows = study.read(folder).table.to_pylist()
    job = Job(build(), SCENE.read_text(encoding="utf-8"), OVERRIDES)
    for number, (row, point) in enumerate(zip(rows, points(count), strict=True)):
        alone = {"point": number, **point, **flat(compute(job, point))}
        # Of texts: NaN is no other number than itself there, -0.0 is.
        assert {name: repr(x) for name, x in row.items() if x is not None} == {
            name: repr(x) for name, x in alone.items() if x is not None
        }, number
    failed = sum(row["error"] is not None for row in rows)
    print(f"{count} points, {failed} of them failed as they must: all as in one process, to the last bit")
    assert 0 < failed < count


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    with tempfile.TemporaryDirectory() as folder:
        killed_twice(Path(folder), count)
        check(Path(folder), count)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        drive(sys.argv[1], int(sys.argv[2]))
    else:
        main()
