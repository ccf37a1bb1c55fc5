"""Instances of units by the functions of the standard, for both versions and interfaces alike."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

KINDS = {("2.0", False): FMU2Slave, ("2.0", True): FMU2Model, ("3.0", False): FMU3Slave, ("3.0", True): FMU3Model}


class Unit:
    """An instance of a unit, initialized at time 0 with these values of variables unless `run` is false."""

    def __init__(
        self,
        path: str,
        exchange: bool = False,
        start: dict[str, float] | None = None,
        run: bool = True,
        token: str | None = None,
    ) -> None:
        self.description = fmpy.read_model_description(path)
        self.folder = fmpy.extract(path)
        self.three = self.description.fmiVersion == "3.0"
        interface = self.description.modelExchange if exchange else self.description.coSimulation
        self.fmu: Any = KINDS[self.description.fmiVersion, exchange](
            guid=self.description.guid if token is None else token,
            unzipDirectory=self.folder,
            modelIdentifier=interface.modelIdentifier,
            instanceName="bearing",
        )
        self.fmu.instantiate()
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        for name, value in (start or {}).items():
            self.set([name], [value])
        if run:
            self.initialize()

    def initialize(self) -> None:
        if not self.three:
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def get(self, names: Sequence[str]) -> list[float]:
        references = [self.references[name] for name in names]
        return list(self.fmu.getFloat64(references) if self.three else self.fmu.getReal(references))

    def set(self, names: Sequence[str], values: Sequence[float]) -> None:
        references = [self.references[name] for name in names]
        (self.fmu.setFloat64 if self.three else self.fmu.setReal)(references, list(values))

    def step(self, t: float, h: float) -> None:
        self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=h)

    def names(self, causality: str) -> list[str]:
        return [v.name for v in self.description.modelVariables if v.causality == causality]

    def begin_continuous(self) -> None:
        """Of model exchange: from the initialization to the integration."""
        (self.fmu.updateDiscreteStates if self.three else self.fmu.newDiscreteStates)()
        self.fmu.enterContinuousTimeMode()

    def close(self) -> None:
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self) -> Unit:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
