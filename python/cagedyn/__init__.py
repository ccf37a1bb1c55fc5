"""Dynamics of the cage, the rolling elements and the rings of a rolling bearing.

SI units everywhere, angles in rad. y points right, z up, rotation is counter-clockwise positive.

>>> model = Model.from_file("scenes/nu2310.json")
>>> sim = Sim(model)
>>> sim.advance_to(0.01)
>>> sim.outputs()["cage.y_ratio"]
"""

from ._analysis import Equilibrium, HeatBalance, Motion, WhirlBranch, cage_motion, over_orbit
from ._batch import Batch, BatchError, Progress
from ._model import Model, Names, SparsePattern
from ._native import Error, version
from ._sim import Inputs, Interval, Sim

__all__ = [
    "Batch",
    "BatchError",
    "Equilibrium",
    "Error",
    "HeatBalance",
    "Inputs",
    "Interval",
    "Model",
    "Motion",
    "Names",
    "Progress",
    "Sim",
    "SparsePattern",
    "WhirlBranch",
    "cage_motion",
    "over_orbit",
    "version",
]
__version__ = version()
