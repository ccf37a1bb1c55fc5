"""Units for the tests: made by the tool in $CAGEDYN_TOOL from scenes of the repository, with the library in $CAGEDYN_LIBRARY."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


class Units:
    """Makes units in a folder, each once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def make(self, scene: str, fmi: str, *sets: str) -> str:
        """Path of the unit of a scene of the repository with replaced values."""
        name = f"{scene}_{fmi[0]}_{abs(hash(sets)):x}"
        path = self.folder / f"{name}.fmu"
        if not path.exists():
            command = [os.environ["CAGEDYN_TOOL"], "fmu", f"scenes/{scene}.json", "--out", str(path), "--fmi", fmi]
            command += ["--library", os.environ["CAGEDYN_LIBRARY"]]
            for one in sets:
                command += ["--set", one]
            subprocess.run(command, check=True, cwd=ROOT, capture_output=True)
        return str(path)


@pytest.fixture(scope="session")
def units(tmp_path_factory: pytest.TempPathFactory) -> Units:
    return Units(tmp_path_factory.mktemp("units"))


def moved(y: float, z: float) -> str:
    """Motion of an inner ring that the host owns, from this place on."""
    motion = {"prescribed": {"y": {"constant": y}, "z": {"constant": z}}}
    return f"inner_ring.motion={json.dumps(motion)}"
