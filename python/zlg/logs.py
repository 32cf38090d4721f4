"""Raw and angle logs, as CSV or HDF5: read into arrays, and written from them."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _zlg
from ._columns import Progress, made_of, warn_each
from ._shown import Columns, axes_of
from .config import Config, checked

__all__ = ["AngleLog", "RawLog", "Switches", "kind", "read_angles", "read_raw", "write_angles", "write_raw"]

Path = Union[str, os.PathLike[str]]


@dataclass(repr=False)
class RawLog(Columns):
    """What a gyro's processor recorded: arrays of shape (halves,), one element per half of a bias period. None: not recorded."""

    counts: NDArray[np.int64]
    bias_sign: NDArray[np.int8]
    mode: NDArray[np.int8]
    loop_closed: NDArray[np.bool_]
    valid: Optional[NDArray[np.bool_]] = None
    #: mean over the half, wavelengths
    detuning_lambda: Optional[NDArray[np.float64]] = None
    #: mean of the square, wavelengths^2
    detuning_sq_lambda2: Optional[NDArray[np.float64]] = None
    piezo_v: Optional[NDArray[np.float64]] = None
    temperature_c: Optional[NDArray[np.float64]] = None
    #: shift of the reversal that ends the half, ticks of a timer of timer_hz
    edge_offset_ticks: Optional[NDArray[np.int32]] = None
    #: counts go over so many halves, this one the last; those before it have valid False, counts 0, span 1
    span: Optional[NDArray[np.int32]] = None
    #: place within the count at the end of the half, 0..65535 of 65536, nan where it is not known
    fringe: Optional[NDArray[np.float64]] = None
    #: both beams were lit and steady throughout the half: its counts are good, in an open loop too
    lit: Optional[NDArray[np.bool_]] = None
    #: photodiodes, shape (halves, samples)
    light_a: Optional[NDArray[np.float32]] = None
    light_b: Optional[NDArray[np.float32]] = None
    #: ticks per second of that timer, 1 .. 1e15 where there are shifts
    timer_hz: float = 0.0
    #: ("section.key", TOML text), as they stand above the rows
    settings: list[tuple[str, str]] = field(default_factory=list)
    #: which random numbers a seed in the settings names; None: of a log that does not say it
    format_version: Optional[int] = _zlg.format_version
    #: False: it is being written, or its writer was interrupted
    complete: bool = True

    def __len__(self) -> int:
        return len(self.counts)

    @property
    def config(self) -> Config:
        """The configuration that the settings say, over the defaults."""
        return Config.from_settings(self.settings)

    @property
    def tick_s(self) -> float:
        """Length of a tick, two halves; NaN where the settings do not say it."""
        config = self.config
        return config.gyro.tick_s if config.says("gyro.tick_s") else math.nan


@dataclass(repr=False)
class Switches(Columns):
    """Switches and what compensation made of them, arrays of shape (switches,); NaN where unknown."""

    tick: NDArray[np.int64]
    mode: NDArray[np.int32]
    miss_lambda: NDArray[np.float64]
    half_wave_v: NDArray[np.float64]
    gap_ticks: NDArray[np.int64]
    dp_arcsec: NDArray[np.float64]
    relock_arcsec: NDArray[np.float64]
    sigma_arcsec: NDArray[np.float64]
    true_error_arcsec: NDArray[np.float64]


@dataclass(repr=False)
class AngleLog(Columns):
    """What compensation made of a raw log: arrays of shape (ticks,), one element per tick."""

    #: as delivered in real time, arcsec
    dtheta_arcsec: NDArray[np.float64]
    #: the best increment known afterwards, arcsec
    dtheta_final_arcsec: NDArray[np.float64]
    #: one standard deviation of it; inf where unknown
    sigma_arcsec: NDArray[np.float64]
    mode: NDArray[np.int8]
    #: sum of the bits zlg.core.angle_flags
    flags: NDArray[np.uint32]
    #: what the twin turned, arcsec; None: not known
    truth_dtheta_arcsec: Optional[NDArray[np.float64]] = None
    #: length of a tick; NaN: not known
    tick_s: float = math.nan
    settings: list[tuple[str, str]] = field(default_factory=list)
    #: as in RawLog
    format_version: Optional[int] = _zlg.format_version
    complete: bool = True
    #: what `compensate` found; None: of a log that was read
    switches: Optional[Switches] = None

    _index = "t_s"

    def __len__(self) -> int:
        return len(self.flags)

    @property
    def t_s(self) -> NDArray[np.float64]:
        """End of each tick, s, shape (ticks,)."""
        ends: NDArray[np.float64] = np.multiply(self.tick_s, np.arange(1, len(self) + 1))
        return ends

    @property
    def measured(self) -> NDArray[np.bool_]:
        """False where the increment was bridged, guessed or distrusted, shape (ticks,)."""
        missing = np.uint32(_zlg.not_measured)
        measured: NDArray[np.bool_] = np.equal(self.flags & missing, 0)
        return measured

    @property
    def error_arcsec(self) -> NDArray[np.float64]:
        """Final less true angle since the start, arcsec, shape (ticks,). Raises ValueError without truth."""
        if self.truth_dtheta_arcsec is None:
            raise ValueError("the log has no true angle: it was not made by the twin")
        return np.cumsum(self.dtheta_final_arcsec - self.truth_dtheta_arcsec)

    def plot(self, ax: Any = None) -> Any:
        """The error of the angle over time, without truth the angle itself; on these axes of matplotlib, or on new ones, returned."""
        ax = axes_of(ax)
        known = self.truth_dtheta_arcsec is not None
        ax.plot(self.t_s, self.error_arcsec if known else np.cumsum(self.dtheta_final_arcsec))
        ax.set(xlabel="time, s", ylabel="angle error, arcsec" if known else "angle, arcsec")
        return ax


def kind(path: Path) -> str:
    """ "raw", "angles" or "unknown", by the content. Raises IoError, FormatError."""
    return _zlg.log_kind(os.fspath(path))


def read_raw(path: Path, light: bool = True, progress: Progress = None) -> RawLog:
    """A raw log, CSV or HDF5; light=False leaves its light samples on the disk.

    Warns of unknown columns, and of a last line without end. Raises IoError; FormatError: file, row, column, value, what is allowed.
    """
    columns = _zlg.read_raw(os.fspath(path), light, progress)
    warn_each(columns["warnings"])
    return made_of(RawLog, columns)


def write_raw(
    path: Path, log: RawLog, config: Optional[Config] = None, force: bool = False, progress: Progress = None
) -> None:
    """Write a raw log, in the format that the suffix says: .csv, .h5 or .hdf5.

    The settings are those of the log, or all of `config`. Raises IoError (a file is not overwritten without `force`), FormatError;
    ValueError for rows that no reader would accept.
    """
    settings = log.settings if config is None else checked(config).settings()
    _zlg.write_raw(os.fspath(path), vars(log), settings, log.timer_hz, force, progress)


def read_angles(path: Path, progress: Progress = None) -> AngleLog:
    """An angle log, CSV or HDF5; tick_s is NaN where it does not say it. Warns of unknown columns. Raises IoError, FormatError."""
    columns = _zlg.read_angles(os.fspath(path), progress)
    warn_each(columns["warnings"])
    known = dict(columns["settings"]).get("tick_s") or dict(columns["settings"]).get("gyro.tick_s")
    columns["tick_s"] = float(known) if known else math.nan
    return made_of(AngleLog, columns)


def write_angles(path: Path, log: AngleLog, force: bool = False, progress: Progress = None) -> None:
    """Write an angle log, .csv, .h5 or .hdf5; the truth is kept in HDF5. Raises IoError, FormatError."""
    _zlg.write_angles(os.fspath(path), vars(log), log.tick_s, log.settings, force, progress)
