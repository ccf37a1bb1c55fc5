"""Parameter studies: a scene at many points, over the cores of this machine or the machines of a cluster, by
`dask.distributed`.

A point maps paths of the scene to values. What a study finds is kept in a folder as it arrives, so that the same
call goes on where one before was stopped by anything.

>>> points = grid({"inner_ring.speed.constant": [200.0, 300.0], "cage.mass": [0.012, 0.024]})
>>> results = run("scenes/grease_guide.json", points, "out/speeds")
>>> results.dataset["cage.eccentricity mean"]

Needs what `pip install "cagedyn[study]"` brings. Workers are processes that import the script that starts them:
what it does itself belongs below `if __name__ == "__main__":`.
"""

from ._cluster import local
from ._error import StudyError
from ._points import Points, grid, latin, listed
from ._progress import Progress, line
from ._results import Results, read
from ._run import optimise, run
from ._sources import Optimiser

__all__ = [
    "Optimiser",
    "Points",
    "Progress",
    "Results",
    "StudyError",
    "grid",
    "latin",
    "line",
    "listed",
    "local",
    "optimise",
    "read",
    "run",
]
