"""The rig: twin and control in closed loop."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from . import _zlg
from ._columns import Progress, made_of
from ._shown import Columns
from .config import Config, checked, resolved
from .logs import RawLog
from .twin import Motion

__all__ = ["ClosedLoop", "Simulation", "calibrated_by_laser", "simulate"]


@dataclass(repr=False)
class Simulation(Columns):
    """Some halves of a closed loop; arrays of shape (halves,)."""

    raw: RawLog
    #: sum of the bits zlg.core.health_bits
    health: NDArray[np.uint32]
    #: rotation of the case in each half, arcsec
    truth_dtheta_arcsec: NDArray[np.float64]
    #: false angle that detuning adds to the counts, arcsec
    truth_false_relock_arcsec: NDArray[np.float64]
    #: true detuning at the end of each half, wavelengths
    truth_detuning_end_lambda: NDArray[np.float64]

    @property
    def true_tick_arcsec(self) -> NDArray[np.float64]:
        """Rotation of the case in each tick, arcsec, shape (halves//2,)."""
        whole = self.truth_dtheta_arcsec[: len(self.truth_dtheta_arcsec) // 2 * 2]
        return whole[0::2] + whole[1::2]


class ClosedLoop:
    """A gyro and its processor. `motion` takes the place of the configuration's. Raises ConfigError.

    What the configuration leaves open is decided as the program does it: the constants that [laser] implies, and the best
    interval. `warnings` says what contradicts itself in it; each is a UserWarning too.
    """

    def __init__(self, config: Optional[Config] = None, motion: Optional[Motion] = None) -> None:
        self._config, self.warnings = resolved(config)
        self._loop = _zlg.ClosedLoop(self._config, motion)

    def advance(self, halves: int, light: bool = False, progress: Progress = None) -> Simulation:
        """The next half-periods. light: keep the samples of the photodiodes too.

        Raises ValueError; RuntimeError while another thread advances this loop.
        """
        columns = self._loop.advance(halves, light, progress)
        raw = made_of(RawLog, columns)
        raw.settings = self._config.settings()
        raw.timer_hz = _zlg.timer_hz
        return made_of(Simulation, {**columns, "raw": raw})


def simulate(
    config: Optional[Config] = None, motion: Optional[Motion] = None, light: bool = False, progress: Progress = None
) -> Simulation:
    """A whole run of the twin in closed loop, of `run.duration_s`.

    Returns the raw log and the truth. Raises ConfigError.
    """
    loop = ClosedLoop(config, motion)
    return loop.advance(2 * _zlg.run_ticks(loop._config, motion), light, progress)


def calibrated_by_laser(config: Config) -> Config:
    """The configuration with bias, chi, discriminator and its curve as they follow from [laser]. Raises ConfigError."""
    return Config._of_checked(_zlg.calibrated_by_laser(checked(config)))
