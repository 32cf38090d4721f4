"""The twin: a model of the gyro, half-period by half-period, with the truth beside its signals."""

from __future__ import annotations

from typing import Optional

from . import _zlg
from ._zlg import ActuatorFrame, Motion, SensorFrame, TwinTruth
from .config import Config, resolved

__all__ = ["ActuatorFrame", "Motion", "SensorFrame", "Twin", "TwinTruth"]


class Twin:
    """A gyro that obeys actuator frames and answers with sensor frames.

    `motion` takes the place of the configuration's. Raises ConfigError, ValueError for a gyro that cannot be.
    """

    def __init__(self, config: Optional[Config] = None, motion: Optional[Motion] = None) -> None:
        self._twin = _zlg.Twin(resolved(config)[0], motion)

    def advance(self, actuator: ActuatorFrame) -> tuple[SensorFrame, TwinTruth]:
        """Live through the next half-period under `actuator`. Raises ValueError for a frame that hardware could not obey."""
        return self._twin.advance(actuator)
