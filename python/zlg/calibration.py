"""The constants of a gyro from logs of its laboratory."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _zlg
from ._columns import Progress, made_of, warn_each
from ._shown import Row
from .config import Config, checked
from .logs import Path, RawLog

__all__ = ["CalibratedLog", "Calibration", "Constant", "Discriminator", "Goodness", "calibrate"]


class Constant(Row):
    """A constant that the logs determine: key, "section.key", value, its sigma, and the unit of both, empty for a pure number."""


class Discriminator(Row):
    """The inverse discriminator: detuning_lambda, signal, and sigma_lambda of the detunings, arrays of shape (points,)."""


class Goodness(Row):
    """How well a law fits: name, value, and a meaning, what it is and what it should be."""


class CalibratedLog(Row):
    """What one log brought: path, duration_s, segments, relocks; temperature_c, lowest and highest, None: not recorded."""


class Calibration(Row):
    """What `calibrate` gives.

    not_determined    why a constant is not among them, by its key; a discriminator that is not is None
    bias_chi_higher   gyro.bias_chi_higher, with the bias_chi of `constants`; of a parabola none
    tick_s, scale_arcsec, reference_temperature_c  of the logs; to which the constants refer, degrees Celsius
    toml              the configuration that `to_toml` gives
    """

    constants: list[Constant]
    discriminator: Optional[Discriminator]
    goodness: list[Goodness]
    logs: list[CalibratedLog]

    def __getitem__(self, key: str) -> Constant:
        """The constant of a key, "gyro.bias_hz". Raises KeyError; where it was not determined, it says why."""
        for constant in self.constants:
            if constant.key == key:
                return constant
        raise KeyError(f"{key}: {self.not_determined.get(key, 'is no constant that logs determine')}")

    @property
    def config(self) -> Config:
        """The constants, with tick, scale and reference temperature, over the defaults.

        raw.config.with_(*calibration.settings()) has them over what a log says.
        """
        return Config.from_toml(self.toml, "the calibration")

    def settings(self) -> list[str]:
        """The same as "section.key=value", for `Config.with_`."""
        return [f"{key}={value}" for key, value in self.config.settings()]

    def to_toml(self) -> str:
        """The configuration that `zlg calibrate --out` writes: what was not determined stands there as a comment."""
        return self.toml

    def write(self, path: Path, force: bool = False) -> None:
        """Write it as a file. Raises IoError; a file is not overwritten without `force`."""
        _zlg.write_text(os.fspath(path), self.toml, force)


Log = Union[Path, RawLog]


def calibrate(
    logs: Union[Log, Sequence[Log]],
    config: Optional[Config] = None,
    rate_arcsec_s: float = 0.0,
    progress: Progress = None,
) -> Calibration:
    """What `zlg calibrate` finds: the constants that compensation presumes, each with its sigma, from raw logs of one gyro.

    logs           files, which are read row by row, or logs in memory
    config         what it was given goes over what the logs say; of the constants to be found, only these are presumed
    rate_arcsec_s  known rate at which the gyro was turned
    Warns of what the program warns of. Raises IoError; FormatError, also for logs of different ticks or scales; ConfigError, also
    for logs that do not go together; ValueError where there is no log.
    """
    each: Sequence[Log] = [logs] if isinstance(logs, (str, os.PathLike, RawLog)) else logs
    if not each:
        raise ValueError("logs: is empty; allowed is one log or more")
    names: list[str] = []
    held: dict[str, dict[str, Any]] = {}
    for place, log in enumerate(each):
        if isinstance(log, RawLog):
            if any(log is other for other in each[:place]):
                raise ValueError(f"logs: log {place} is named twice; each log counts once")
            names.append(f"log {place}")
            held[names[-1]] = vars(log)
        else:
            names.append(os.fspath(log))
    found = _zlg.calibrate(names, held, rate_arcsec_s, checked(config), progress)
    warn_each(found["warnings"])
    return made_of(Calibration, found)
